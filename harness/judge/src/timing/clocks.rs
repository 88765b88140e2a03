//! How far the clocks of several logs are apart, from the messages that went both ways.
//!
//! ```text
//!   clock of A   ──sent──────────────heard──►      there = delay there + offset
//!                    ╲              ╱
//!   clock of B   ─────heard────sent───────►        back  = delay back  - offset
//! ```
//!
//! The offset lies between `-back` and `there`, since no message arrives before it is sent. The shortest of each bound
//! it best; the estimate is their middle, and half their distance is what it can be wrong by. It is right where
//! the shortest way there takes as long as the shortest way back (as in RFC 5905, section 8). A clock that is put or
//! drifts in mid-run shows as a message that arrives before it is sent.

use std::collections::{BTreeMap, HashMap};
use std::hash::{DefaultHasher, Hash, Hasher};

use crossguard_protocol::StationId;
use serde::Serialize;

use crossguard_robot::trace::{Entry, Record};

/// How many messages are kept in mind; those after them do not improve the estimate.
const MESSAGES: usize = 200_000;

/// The clocks of the logs of a run, each log with one.
#[derive(Debug, Default)]
pub(super) struct Clocks {
    /// Which log each station is in.
    homes: BTreeMap<StationId, usize>,
    /// By the digest of its octets: what is known of a message.
    messages: HashMap<u64, PassedMessage>,
    /// By the logs of sender and receiver: the least that a message took, and how many did.
    ways: BTreeMap<(usize, usize), Way>,
}

/// A message: its first transmission, and its receptions before that is known, each by log and time.
#[derive(Debug, Default)]
struct PassedMessage {
    sent: Option<(usize, u64)>,
    heard: Vec<(usize, u64)>,
}

/// Messages from one log to another.
#[derive(Clone, Copy, Debug)]
struct Way {
    /// The least difference of reception and transmission, each by its own clock, in µs.
    shortest_us: i64,
    messages: usize,
}

/// By how much one clock is ahead of another.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Offset {
    /// By so much, in µs.
    pub offset_us: i64,
    /// The estimate is wrong by no more than this, in µs; 0 for robots that share a clock.
    pub bound_us: i64,
    /// How many messages of the one were heard by the other.
    pub there: usize,
    /// How many of the other were heard by the one.
    pub back: usize,
}

/// Why the offset of two clocks is not known.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
pub enum NoOffset {
    /// Nothing that one of them sent is in the log of the other.
    #[error("no message went both ways, so the difference of their clocks is not known")]
    OneWay,
    /// A message took less than no time.
    #[error(
        "a message arrived {0} µs before any offset allows: one of the clocks was put, or drifted, in mid-run"
    )]
    Unsteady(i64),
}

impl Clocks {
    /// Takes note of a record of a log, at a time on the log's clock in µs.
    pub(super) fn record(&mut self, log: usize, at_us: u64, record: &Record) {
        match &record.entry {
            Entry::Started { station, .. } => {
                self.homes.insert(*station, log);
            }
            Entry::Step { state, .. } => {
                self.homes.insert(state.station(), log);
            }
            Entry::Sent { octets, .. } => self.sent(log, at_us, octets),
            Entry::Heard { octets, .. } => self.heard(log, at_us, octets),
            Entry::Dropped { .. }
            | Entry::Unrecorded { .. }
            | Entry::Stopped { .. }
            | Entry::Zone(_)
            | Entry::People(_)
            | Entry::Around(_)
            | Entry::Channel(_)
            | Entry::Clock(_)
            | Entry::Hindered { .. } => {}
        }
    }

    /// Of a message that is repeated, the first transmission counts: a reception of a later one only
    /// seems to have taken longer, and does not touch the shortest.
    fn sent(&mut self, log: usize, at_us: u64, octets: &[u8]) {
        let Some(message) = self.message(octets) else {
            return;
        };
        if message.sent.is_none() {
            message.sent = Some((log, at_us));
            for (at, heard_us) in std::mem::take(&mut message.heard) {
                self.took((log, at_us), (at, heard_us));
            }
        }
    }

    fn heard(&mut self, log: usize, at_us: u64, octets: &[u8]) {
        let Some(message) = self.message(octets) else {
            return;
        };
        match message.sent {
            Some(sent) => self.took(sent, (log, at_us)),
            // Its receiver's clock is behind.
            None => message.heard.push((log, at_us)),
        }
    }

    fn message(&mut self, octets: &[u8]) -> Option<&mut PassedMessage> {
        let mut hasher = DefaultHasher::new();
        octets.hash(&mut hasher);
        let digest = hasher.finish();
        if self.messages.len() >= MESSAGES && !self.messages.contains_key(&digest) {
            return None;
        }
        Some(self.messages.entry(digest).or_default())
    }

    fn took(&mut self, (from, sent_us): (usize, u64), (to, heard_us): (usize, u64)) {
        if from == to {
            return;
        }
        let took_us = heard_us.wrapping_sub(sent_us).cast_signed();
        let way = self.ways.entry((from, to)).or_insert(Way {
            shortest_us: i64::MAX,
            messages: 0,
        });
        way.shortest_us = way.shortest_us.min(took_us);
        way.messages += 1;
    }

    /// The logs that two stations are in.
    pub(super) fn logs(&self, stations: (StationId, StationId)) -> Option<(usize, usize)> {
        Some((*self.homes.get(&stations.0)?, *self.homes.get(&stations.1)?))
    }

    /// By how much the clock of the log `to` is ahead of the clock of the log `from`.
    pub(super) fn offset(&self, (from, to): (usize, usize)) -> Result<Offset, NoOffset> {
        if from == to {
            return Ok(Offset::default());
        }
        let way = |key| self.ways.get(&key).copied().ok_or(NoOffset::OneWay);
        let (there, back) = (way((from, to))?, way((to, from))?);
        let around_us = there.shortest_us.saturating_add(back.shortest_us);
        if around_us < 0 {
            return Err(NoOffset::Unsteady(-around_us));
        }
        Ok(Offset {
            offset_us: (there.shortest_us - back.shortest_us) / 2,
            bound_us: around_us / 2,
            there: there.messages,
            back: back.messages,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Messages with these delays there and back, the clock of the second log ahead by `ahead_us`.
    fn clocks(ahead_us: i64, there: &[i64], back: &[i64]) -> Clocks {
        let mut clocks = Clocks::default();
        let own = |at_us: i64| at_us.cast_unsigned();
        for (place, delay_us) in (0_u8..).zip(there) {
            let sent_us = 1_000_000 * (1 + i64::from(place));
            clocks.sent(0, own(sent_us), &[0, place]);
            clocks.heard(1, own(sent_us + delay_us + ahead_us), &[0, place]);
        }
        for (place, delay_us) in (0_u8..).zip(back) {
            let sent_us = 1_000_000 * (1 + i64::from(place));
            // In the order in which logs are merged, a reception may come first.
            clocks.heard(0, own(sent_us + delay_us), &[1, place]);
            clocks.sent(1, own(sent_us + ahead_us), &[1, place]);
        }
        clocks
    }

    #[test]
    fn the_shortest_way_there_and_back_bound_the_offset() {
        let clocks = clocks(-700_000, &[9_000, 4_000, 30_000], &[2_000, 50_000]);
        let offset = clocks.offset((0, 1)).unwrap();
        assert_eq!((offset.offset_us, offset.bound_us), (-699_000, 3_000));
        assert_eq!((offset.there, offset.back), (3, 2));
        assert_eq!(clocks.offset((1, 0)).unwrap().offset_us, 699_000);
        assert_eq!(clocks.offset((1, 1)), Ok(Offset::default()));
    }

    #[test]
    fn a_message_that_is_sent_again_does_not_shorten_its_way() {
        let mut clocks = clocks(0, &[5_000], &[5_000]);
        clocks.sent(0, 1_004_900, &[0, 0]);
        clocks.heard(1, 1_005_900, &[0, 0]);
        assert_eq!(clocks.offset((0, 1)).unwrap().bound_us, 5_000);
    }

    #[test]
    fn one_way_alone_tells_nothing_and_a_clock_that_was_put_is_noticed() {
        assert_eq!(clocks(0, &[5], &[]).offset((0, 1)), Err(NoOffset::OneWay));
        let mut put = clocks(0, &[5_000], &[5_000]);
        put.sent(0, 9_000_000, &[7]);
        put.heard(1, 7_000_000, &[7]);
        assert_eq!(put.offset((0, 1)), Err(NoOffset::Unsteady(1_995_000)));
    }
}
