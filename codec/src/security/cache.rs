//! The tickets of other stations, and what was heard under each: bounded, and safe against replays
//! also where something had to be forgotten.

use std::collections::{HashMap, VecDeque};

use super::certificate::Certificate;
use super::crypto::Digest;
use super::hashed_id::HashedId8;
use super::rejected::Rejected;
use super::time::Time64;

/// How many tickets are remembered: more than there are stations within the reach of a radio in a town.
pub const TICKETS_MAX: usize = 1_024;
/// How long somebody is silent before its place may be given to somebody else; longer than any lease.
const SILENCE_US: u64 = 10_000_000;
/// How many messages are remembered of each; a robot sends fewer in the 2 s that a message is fresh.
pub const MESSAGES_MAX: usize = 128;

/// The tickets of other stations, by id.
#[derive(Clone, Debug, Default)]
pub(super) struct Cache {
    tickets: HashMap<HashedId8, Known>,
    /// Under tickets that were forgotten, messages up to this time may have been heard.
    forgotten: Time64,
    /// Counts up with every message.
    clock: u64,
}

/// A ticket whose chain has been checked, and what was heard under it.
#[derive(Clone, Debug)]
struct Known {
    ticket: Certificate,
    heard: VecDeque<(Time64, [u8; 8])>,
    /// Messages up to this time that are not among `heard` may have been heard.
    forgotten: Time64,
    used: u64,
}

impl Known {
    /// When the newest message was generated that may have been heard.
    fn newest(&self) -> Time64 {
        let newest = self.heard.iter().map(|(generated, _)| *generated).max();
        newest.unwrap_or_default().max(self.forgotten)
    }
}

/// The first octets of a digest. A station that could find two messages with the same could only
/// have its own second one ignored.
fn short(digest: &Digest) -> [u8; 8] {
    let mut octets = [0; 8];
    octets.copy_from_slice(&digest[..8]);
    octets
}

impl Cache {
    pub(super) fn ticket(&self, id: HashedId8) -> Option<&Certificate> {
        self.tickets.get(&id).map(|known| &known.ticket)
    }

    /// Checks that a message was not heard already, and that there is a place for its ticket: no station that is heard
    /// is forgotten for a new one.
    pub(super) fn check(
        &self,
        id: HashedId8,
        generated: Time64,
        digest: &Digest,
    ) -> Result<(), Rejected> {
        let (forgotten, is_known) = match self.tickets.get(&id) {
            Some(known) => {
                let message = (generated, short(digest));
                (known.forgotten, known.heard.contains(&message))
            }
            None if self.is_full_at(generated) => return Err(Rejected::TooManyStations),
            None => (self.forgotten, false),
        };
        if is_known || generated <= forgotten {
            return Err(Rejected::Replayed);
        }
        Ok(())
    }

    /// Remembers a message that was verified. What was generated before `fresh` need not be
    /// remembered, because it will be rejected as too old.
    pub(super) fn remember(
        &mut self,
        ticket: &Certificate,
        generated: Time64,
        digest: &Digest,
        fresh: Time64,
    ) {
        let id = ticket.id();
        if !self.tickets.contains_key(&id) && self.tickets.len() == TICKETS_MAX {
            self.forget_oldest();
        }
        self.clock += 1;
        let known = self.tickets.entry(id).or_insert_with(|| Known {
            ticket: ticket.clone(),
            heard: VecDeque::new(),
            forgotten: self.forgotten,
            used: 0,
        });
        known.used = self.clock;
        // A clock that is put back makes old messages fresh again: that something was forgotten is remembered.
        let forgotten = &mut known.forgotten;
        known.heard.retain(|(generated, _)| {
            let is_fresh = *generated >= fresh;
            if !is_fresh {
                *forgotten = (*forgotten).max(*generated);
            }
            is_fresh
        });
        if known.heard.len() == MESSAGES_MAX
            && let Some((dropped, _)) = known.heard.pop_front()
        {
            known.forgotten = known.forgotten.max(dropped);
        }
        known.heard.push_back((generated, short(digest)));
    }

    /// True if everybody who is remembered was heard lately, at a time that has just been.
    fn is_full_at(&self, now: Time64) -> bool {
        let is_heard = |known: &Known| now.0.saturating_sub(known.newest().0) < SILENCE_US;
        self.tickets.len() == TICKETS_MAX && self.tickets.values().all(is_heard)
    }

    fn forget_oldest(&mut self) {
        let oldest = self.tickets.iter().min_by_key(|(_, known)| known.used);
        let Some(id) = oldest.map(|(id, _)| *id) else {
            return;
        };
        if let Some(known) = self.tickets.remove(&id) {
            self.forgotten = self.forgotten.max(known.newest());
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::security::issue::{self, Terms};
    use crate::security::{Duration, Issuer, Permission, PrivateKey, Ssp, Validity};

    use super::*;

    #[test]
    fn what_was_forgotten_is_not_new_when_the_clock_is_put_back() {
        let validity = Validity {
            start: 0,
            duration: Duration::years(1),
        };
        let permission = Permission {
            its_aid: 16_480,
            ssp: Ssp::Default,
        };
        let terms = Terms::of_ticket(validity, vec![permission]);
        let key = PrivateKey::of_octets(&[1; 32]).unwrap();
        let issued = issue::certificate(Issuer::Itself, &[], &key, key.public_key(), &terms);
        let ticket = issued.unwrap();
        let mut cache = Cache::default();
        let digest = |number| [number; 32];
        let fresh = |now_us: u64| Time64(now_us.saturating_sub(2_000_000));
        cache.remember(&ticket, Time64(1_000_000), &digest(1), fresh(1_000_000));
        cache.remember(&ticket, Time64(5_000_000), &digest(2), fresh(5_000_000));
        for (generated, number) in [(1_000_000, 1), (900_000, 3), (5_000_000, 2)] {
            let again = cache.check(ticket.id(), Time64(generated), &digest(number));
            assert_eq!(again, Err(Rejected::Replayed), "{generated}");
        }
        let new = cache.check(ticket.id(), Time64(1_000_001), &digest(4));
        assert_eq!(new, Ok(()));
    }
}
