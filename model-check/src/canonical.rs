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

use crate::memo::Memo;

pub(crate) trait Renamable {
    #[must_use]
    fn renamed(&self, to: &mut impl Renaming) -> Self;
}

/// A name: whose it is, and in the lowest 16 bits the number that is ranked among the others of that
/// owner. In one number, because names are compared by the million.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
struct Name(u128);

impl Name {
    const HEARTBEAT: u128 = 1 << 127;

    fn number(owner: StationId, number: UniqueNumber) -> Self {
        let owner = u128::from(owner.0) << 32;
        Self(owner | u128::from(number.boot) << 16 | u128::from(number.count))
    }

    fn heartbeat(session: SessionId, heartbeat: Heartbeat) -> Self {
        let session = Self::number(session.leader, session.number.0).0 << 16;
        Self(Self::HEARTBEAT | session | u128::from(heartbeat.0))
    }

    const fn is_heartbeat(self) -> bool {
        self.0 & Self::HEARTBEAT != 0
    }

    /// The station that gave the number out, or leads the session of the heartbeat.
    #[expect(clippy::cast_possible_truncation, reason = "32 bits are meant")]
    const fn station(self) -> StationId {
        let shift = if self.is_heartbeat() { 48 } else { 32 };
        StationId((self.0 >> shift) as u32)
    }

    /// The number itself, or that of the heartbeat's session.
    #[expect(clippy::cast_possible_truncation, reason = "16 bits are meant")]
    const fn unique(self) -> UniqueNumber {
        let number = if self.is_heartbeat() {
            self.0 >> 16
        } else {
            self.0
        };
        UniqueNumber {
            boot: (number >> 16) as u16,
            count: number as u16,
        }
    }

    const fn owner(self) -> u128 {
        self.0 >> 16
    }

    #[expect(
        clippy::cast_possible_truncation,
        reason = "the lowest 16 bits are meant"
    )]
    const fn value(self) -> u16 {
        self.0 as u16
    }
}

/// The names that occur in something, each once, in their order.
#[derive(Clone, PartialEq, Eq, Hash, Debug, Default)]
pub(crate) struct Names(SmallVec<[Name; 5]>);

impl Names {
    pub(crate) fn of(value: &impl Renamable) -> Self {
        let mut names = Self::default();
        let _ = value.renamed(&mut names);
        names.0.sort_unstable();
        names.0.dedup();
        names
    }
}

impl Renaming for Names {
    fn heartbeat(&mut self, session: SessionId, heartbeat: Heartbeat) -> Heartbeat {
        self.0.push(Name::heartbeat(session, heartbeat));
        heartbeat
    }

    fn number(&mut self, owner: StationId, number: UniqueNumber) -> UniqueNumber {
        self.0.push(Name::number(owner, number));
        number
    }
}

/// Numbers that a station gave out, each with how many heartbeats of its session there are.
pub(crate) type GivenOut = SmallVec<[(UniqueNumber, u16); 6]>;

/// Sets of names by number, and the renamings to ranks. Few sets occur together, so each renaming is made
/// up once; a state finds its own by the numbers of the sets in its parts.
pub(crate) struct Renamings {
    rank: fn(&mut Ranks) -> bool,
    sets: Memo<Names, ()>,
    of_sets: Memo<NameSets, Option<u32>>,
    ranks: boxcar::Vec<Ranks>,
}

#[derive(PartialEq, Eq, Hash, Default)]
pub(crate) struct NameSets(SmallVec<[u32; 8]>);

impl NameSets {
    pub(crate) fn add(&mut self, set: u32) {
        if set != Renamings::EMPTY && !self.0.contains(&set) {
            self.0.push(set);
        }
    }
}

impl Renamings {
    pub(crate) const EMPTY: u32 = 0;

    pub(crate) fn new(rank: fn(&mut Ranks) -> bool) -> Self {
        let renamings = Self {
            rank,
            sets: Memo::default(),
            of_sets: Memo::default(),
            ranks: boxcar::Vec::new(),
        };
        let empty = renamings.set(Names::default());
        debug_assert_eq!(empty, Self::EMPTY);
        renamings
    }

    pub(crate) fn set(&self, names: Names) -> u32 {
        let known = self.sets.find(&names);
        known.unwrap_or_else(|| self.sets.add(names, ()))
    }

    /// The number of the set of all names in these sets.
    pub(crate) fn union(&self, sets: impl Iterator<Item = u32>) -> u32 {
        let mut names = Names::default();
        for set in sets {
            names.0.extend_from_slice(&self.sets.at(set).0.0);
        }
        names.0.sort_unstable();
        names.0.dedup();
        self.set(names)
    }

    /// The number of the renaming of a state in which these sets of names occur; `None` if no name
    /// changes.
    pub(crate) fn of(&self, sets: NameSets) -> Option<u32> {
        let renaming = self.of_sets.get_or_compute(sets, |sets| {
            let mut ranks = Ranks::default();
            for &set in &sets.0 {
                ranks.add(&self.sets.at(set).0);
            }
            let number = |index| u32::try_from(index).expect("fewer than 2^32 renamings");
            (self.rank)(&mut ranks).then(|| number(self.ranks.push(ranks)))
        });
        *renaming
    }

    /// The numbers that `station` gave out, of the names in these sets, in order, each with how many heartbeats
    /// of the session of that number there are.
    pub(crate) fn given_out_by(
        &self,
        station: StationId,
        sets: impl Iterator<Item = u32>,
    ) -> GivenOut {
        let mut names: SmallVec<[Name; 16]> = SmallVec::new();
        for set in sets {
            let own = self.sets.at(set).0.0.iter();
            names.extend(own.copied().filter(|name| name.station() == station));
        }
        names.sort_unstable();
        names.dedup();
        let mut given_out: GivenOut = SmallVec::new();
        for name in names {
            // Names of numbers come before those of heartbeats.
            let number = name.unique();
            let at = given_out.iter().position(|(known, _)| *known == number);
            let at = at.unwrap_or_else(|| {
                given_out.push((number, 0));
                given_out.len() - 1
            });
            given_out[at].1 += u16::from(name.is_heartbeat());
        }
        given_out
    }

    pub(crate) fn ranks(&self, renaming: u32) -> &Ranks {
        &self.ranks[renaming as usize]
    }
}

/// The renaming to ranks, of everything that occurs in one state.
#[derive(Default)]
pub(crate) struct Ranks {
    names: SmallVec<[Name; 16]>,
    ranks: SmallVec<[u16; 16]>,
}

impl Ranks {
    pub(crate) fn add(&mut self, names: &Names) {
        for name in &names.0 {
            let below = self.names.iter().rposition(|known| known <= name);
            let at = below.map_or(0, |below| below + 1);
            if below.is_none_or(|below| self.names[below] != *name) {
                self.names.insert(at, *name);
            }
        }
    }

    /// Ranks everything that was added. Returns whether any name changes.
    pub(crate) fn rank(&mut self) -> bool {
        self.rank_with(|_, _, last| last + 1)
    }

    /// Ranks the numbers that were added, and counts the heartbeats of each session from the oldest
    /// one. That keeps how far apart they are, which is what their age is counted by. Returns
    /// whether any name changes.
    pub(crate) fn rank_keeping_distances(&mut self) -> bool {
        self.rank_with(|name, first, last| {
            if name.is_heartbeat() {
                name.value() - first.value()
            } else {
                last + 1
            }
        })
    }

    /// Ranks the names of each owner: the first is 0, and `next` says what any other becomes, given
    /// the first and what the one before it became.
    fn rank_with(&mut self, next: impl Fn(Name, Name, u16) -> u16) -> bool {
        let mut changes = false;
        let mut group: Option<(Name, u16)> = None;
        for &name in &self.names {
            let (first, rank) = match group {
                Some((first, last)) if first.owner() == name.owner() => {
                    (first, next(name, first, last))
                }
                _ => (name, 0),
            };
            group = Some((first, rank));
            self.ranks.push(rank);
            changes |= rank != name.value();
        }
        changes
    }

    fn of(&self, name: Name) -> Option<u16> {
        let at = self.names.iter().position(|known| *known == name)?;
        Some(self.ranks[at])
    }
}

impl Renaming for &Ranks {
    fn heartbeat(&mut self, session: SessionId, heartbeat: Heartbeat) -> Heartbeat {
        let rank = self.of(Name::heartbeat(session, heartbeat));
        rank.map_or(heartbeat, Heartbeat)
    }

    fn number(&mut self, owner: StationId, number: UniqueNumber) -> UniqueNumber {
        let rank = self.of(Name::number(owner, number));
        rank.map_or(number, |count| UniqueNumber { count, ..number })
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
        for (station, number) in [
            number(2, 1, 9),
            number(1, 2, 0),
            number(1, 1, 7),
            number(1, 1, 3),
        ] {
            let mut names = Names::default();
            names.number(station, number);
            ranks.add(&names);
            ranks.add(&names);
        }
        assert!(ranks.rank());
        let renamed = |(station, n): (StationId, UniqueNumber)| (&ranks).number(station, n).count;
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
        let beats = [(1, 9), (1, 4), (2, 7), (1, 6)];
        let mut ranks = Ranks::default();
        for (leader, beat) in beats {
            let mut names = Names::default();
            names.heartbeat(session(leader), Heartbeat(beat));
            ranks.add(&names);
        }
        assert!(ranks.rank_keeping_distances());
        let renamed =
            beats.map(|(leader, beat)| (&ranks).heartbeat(session(leader), Heartbeat(beat)).0);
        assert_eq!(renamed, [5, 0, 0, 2]);
    }

    #[test]
    fn ranks_are_their_own_ranks() {
        let mut ranks = Ranks::default();
        let mut names = Names::default();
        names.number(StationId(1), UniqueNumber { boot: 1, count: 0 });
        names.number(StationId(1), UniqueNumber { boot: 1, count: 1 });
        ranks.add(&names);
        assert!(!ranks.rank());
    }
}
