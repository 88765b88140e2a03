//! One state for all that differ in names alone.
//!
//! Heartbeats, session numbers and offer numbers only ever grow, so a model that took them as they
//! are would be infinite. The protocol asks of heartbeats only which is newer, and of numbers only
//! whether they are the same. So each state is renamed: the heartbeats of a session become their
//! ranks, oldest first, and so do the numbers that one station gave out in one boot. Nothing is
//! bounded by this; a run of any length stays within finitely many states.
//!
//! Names are ranked within the station that gave them out, so to exchange stations before or after
//! makes no difference; [`symmetry`](crate::symmetry) does that where a scenario allows it.

use crossguard_protocol::{Heartbeat, Renaming, SessionId, StationId, UniqueNumber};
use smallvec::SmallVec;

/// Something that holds names.
pub(crate) trait Renamable {
    /// The same under other names.
    #[must_use]
    fn renamed(&self, to: &mut impl Renaming) -> Self;
}

type Number = (StationId, UniqueNumber);
type Beat = (SessionId, Heartbeat);

/// The names that occur in something, in no particular order.
#[derive(Clone, Debug, Default)]
pub(crate) struct Names {
    numbers: SmallVec<[Number; 4]>,
    heartbeats: SmallVec<[Beat; 2]>,
}

impl Names {
    pub(crate) fn of(value: &impl Renamable) -> Self {
        let mut names = Self::default();
        let _ = value.renamed(&mut names);
        names
    }
}

impl Renaming for Names {
    fn heartbeat(&mut self, session: SessionId, heartbeat: Heartbeat) -> Heartbeat {
        self.heartbeats.push((session, heartbeat));
        heartbeat
    }

    fn number(&mut self, owner: StationId, number: UniqueNumber) -> UniqueNumber {
        self.numbers.push((owner, number));
        number
    }
}

/// The renaming to ranks, of everything that occurs in one state.
#[derive(Default)]
pub(crate) struct Ranks {
    numbers: SmallVec<[(Number, u16); 16]>,
    heartbeats: SmallVec<[(Beat, u16); 16]>,
}

impl Ranks {
    pub(crate) fn add(&mut self, names: &Names) {
        self.numbers
            .extend(names.numbers.iter().map(|&number| (number, 0)));
        self.heartbeats
            .extend(names.heartbeats.iter().map(|&beat| (beat, 0)));
    }

    /// Ranks everything that was added. Returns whether any name changes.
    pub(crate) fn rank(&mut self) -> bool {
        self.sort();
        let numbers_change = self.rank_numbers();
        let beats_change = rank_groups(
            &mut self.heartbeats,
            |(session, _)| *session,
            |(_, beat)| beat.0,
        );
        numbers_change || beats_change
    }

    /// Ranks the numbers that were added, and counts the heartbeats of each session from the oldest
    /// one. That keeps how far apart they are, which is what their age is counted by. Returns
    /// whether any name changes.
    pub(crate) fn rank_keeping_distances(&mut self) -> bool {
        self.sort();
        let mut changes = self.rank_numbers();
        let mut oldest: Option<Beat> = None;
        for (beat, name) in &mut self.heartbeats {
            let first = match oldest {
                Some(first) if first.0 == beat.0 => first,
                _ => *beat,
            };
            oldest = Some(first);
            *name = beat.1.distance_from(first.1);
            changes |= beat.1.0 != *name;
        }
        changes
    }

    fn sort(&mut self) {
        self.numbers.sort_unstable();
        self.numbers.dedup();
        self.heartbeats
            .sort_unstable_by_key(|((session, beat), _)| (*session, beat.0));
        self.heartbeats.dedup();
    }

    fn rank_numbers(&mut self) -> bool {
        rank_groups(
            &mut self.numbers,
            |(owner, n)| (*owner, n.boot),
            |(_, n)| n.count,
        )
    }
}

/// Gives each item its rank within its group. The items are sorted by group, then value.
fn rank_groups<T, G: PartialEq>(
    items: &mut [(T, u16)],
    group: impl Fn(&T) -> G,
    value: impl Fn(&T) -> u16,
) -> bool {
    let mut changes = false;
    let mut next = 0;
    for i in 0..items.len() {
        if i > 0 && group(&items[i - 1].0) != group(&items[i].0) {
            next = 0;
        }
        items[i].1 = next;
        changes |= value(&items[i].0) != next;
        next += 1;
    }
    changes
}

impl Renaming for Ranks {
    fn heartbeat(&mut self, session: SessionId, heartbeat: Heartbeat) -> Heartbeat {
        let known = self
            .heartbeats
            .iter()
            .find(|(beat, _)| *beat == (session, heartbeat));
        known.map_or(heartbeat, |(_, rank)| Heartbeat(*rank))
    }

    fn number(&mut self, owner: StationId, number: UniqueNumber) -> UniqueNumber {
        let known = self
            .numbers
            .iter()
            .find(|(other, _)| *other == (owner, number));
        known.map_or(number, |(_, rank)| UniqueNumber {
            count: *rank,
            ..number
        })
    }
}

#[cfg(test)]
mod tests {
    use crossguard_protocol::SessionNumber;

    use super::*;

    #[test]
    fn names_become_their_ranks_within_station_and_boot() {
        let number = |station, boot, count| (StationId(station), UniqueNumber { boot, count });
        let mut ranks = Ranks::default();
        let mut names = Names::default();
        names.numbers.extend([
            number(2, 1, 9),
            number(1, 2, 0),
            number(1, 1, 7),
            number(1, 1, 3),
        ]);
        ranks.add(&names);
        ranks.add(&names);
        assert!(ranks.rank());
        let mut renamed = |(station, n): Number| ranks.number(station, n).count;
        assert_eq!(renamed(number(1, 1, 3)), 0);
        assert_eq!(renamed(number(1, 1, 7)), 1);
        assert_eq!(renamed(number(1, 2, 0)), 0);
        assert_eq!(renamed(number(2, 1, 9)), 0);
    }

    #[test]
    fn heartbeats_keep_their_distances_when_they_are_counted_from_the_oldest() {
        let session = |leader| SessionId {
            leader: StationId(leader),
            number: SessionNumber(UniqueNumber { boot: 1, count: 0 }),
        };
        let mut names = Names::default();
        let beats = [(1, 9), (1, 4), (2, 7), (1, 6)];
        names
            .heartbeats
            .extend(beats.map(|(leader, beat): (u32, u16)| (session(leader), Heartbeat(beat))));
        let mut ranks = Ranks::default();
        ranks.add(&names);
        assert!(ranks.rank_keeping_distances());
        let renamed =
            beats.map(|(leader, beat)| ranks.heartbeat(session(leader), Heartbeat(beat)).0);
        assert_eq!(renamed, [5, 0, 0, 2]);
    }

    #[test]
    fn ranks_are_their_own_ranks() {
        let mut ranks = Ranks::default();
        let mut names = Names::default();
        names
            .numbers
            .push((StationId(1), UniqueNumber { boot: 1, count: 0 }));
        names
            .numbers
            .push((StationId(1), UniqueNumber { boot: 1, count: 1 }));
        ranks.add(&names);
        assert!(!ranks.rank());
    }
}
