//! Owners of station ids.
//!
//! The id of a robot follows from its ticket, so nobody else can go by it. The tickets of other stations say nothing
//! of ids: there, an id belongs to the ticket under which it was heard first, until that has been silent for a while,
//! and a ticket has one id at a time. No station that is heard is forgotten to make room for a new one.

use std::collections::HashMap;

use crossguard_codec::geonet::{Address, Signer};
use crossguard_protocol::StationId;

use crate::cause::Cause;

/// How long an id belongs to a ticket that is silent; longer than any lease.
const SILENCE_MS: u64 = 10_000;
/// How many ids are remembered.
pub const NAMES_MAX: usize = 256;

/// Why a ticket may not go by a station id.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
pub enum NotAdmitted {
    /// The id is that of another ticket.
    #[error("station {0} goes by another certificate")]
    OtherTicket(StationId),
    /// The ticket goes by another id.
    #[error("the certificate of station {0} goes by station {1} as well")]
    SecondId(StationId, StationId),
    /// The ticket goes by this id with another address.
    #[error("station {0} has another address")]
    OtherAddress(StationId),
    /// As many are heard as can be told apart.
    #[error("{NAMES_MAX} stations are heard, and station {0} is one more")]
    TooMany(StationId),
}

impl From<NotAdmitted> for Cause {
    fn from(why: NotAdmitted) -> Self {
        Self::Rejected(match why {
            NotAdmitted::OtherTicket(_) => "station id of another certificate",
            NotAdmitted::SecondId(..) => "second station id of a certificate",
            NotAdmitted::OtherAddress(_) => "address of another station",
            NotAdmitted::TooMany(_) => "too many stations",
        })
    }
}

/// The ticket that owns an id.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(
    not(any(feature = "foreign", test)),
    expect(dead_code, reason = "`admit` reads them")
)]
struct Owner {
    signer: Signer,
    /// The address of its packets.
    address: Address,
    heard_ms: u64,
}

impl Owner {
    const fn is_heard(&self, now_ms: u64) -> bool {
        now_ms.saturating_sub(self.heard_ms) < SILENCE_MS
    }
}

#[derive(Clone, Debug, Default)]
pub(crate) struct Namesakes {
    /// Robots, whose ids follow from their tickets. They have places of their own, which others cannot fill.
    robots: HashMap<StationId, Owner>,
    /// Other stations, whose ids do not follow from their tickets.
    others: HashMap<StationId, Owner>,
}

impl Namesakes {
    /// A robot was heard at `now_ms`, whose id follows from its ticket: the id is its own, whichever robot had it before.
    /// With more robots around than can be remembered, a new one is not: others may then go by its id, and its RAM
    /// are its own all the same.
    pub(crate) fn bind(
        &mut self,
        station: StationId,
        signer: Signer,
        address: Address,
        now_ms: u64,
    ) {
        self.others.remove(&station);
        if !self.robots.contains_key(&station) {
            self.robots.retain(|_, owner| owner.is_heard(now_ms));
            if self.robots.len() == NAMES_MAX {
                return;
            }
        }
        let owner = Owner {
            signer,
            address,
            heard_ms: now_ms,
        };
        self.robots.insert(station, owner);
    }

    /// Whether `signer` may go by this id at `now_ms`, which does not follow from its ticket, with this address; if so,
    /// that is remembered.
    ///
    /// # Errors
    /// Why not.
    #[cfg(any(feature = "foreign", test))]
    pub(super) fn admit(
        &mut self,
        station: StationId,
        (signer, address): (Signer, Address),
        now_ms: u64,
    ) -> Result<(), NotAdmitted> {
        self.robots.retain(|_, owner| owner.is_heard(now_ms));
        let known = self.robots.get(&station);
        let known = known.or_else(|| self.others.get(&station));
        if let Some(owner) = known
            && (owner.signer == signer || owner.is_heard(now_ms))
        {
            if owner.signer != signer {
                return Err(NotAdmitted::OtherTicket(station));
            }
            if owner.address != address && owner.is_heard(now_ms) {
                return Err(NotAdmitted::OtherAddress(station));
            }
            let owner = Owner {
                signer,
                address,
                heard_ms: now_ms,
            };
            self.others
                .entry(station)
                .and_modify(|known| *known = owner);
            return Ok(());
        }
        self.others.retain(|_, owner| owner.is_heard(now_ms));
        let mut all = self.robots.iter().chain(&self.others);
        if let Some((first, _)) = all.find(|(_, owner)| owner.signer == signer) {
            return Err(NotAdmitted::SecondId(*first, station));
        }
        if self.others.len() == NAMES_MAX {
            return Err(NotAdmitted::TooMany(station));
        }
        let owner = Owner {
            signer,
            address,
            heard_ms: now_ms,
        };
        self.others.insert(station, owner);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const A: Signer = Signer([1; 8]);
    const B: Signer = Signer([2; 8]);
    const OTHER: Result<(), NotAdmitted> = Err(NotAdmitted::OtherTicket(StationId(1)));

    fn address(station: StationId) -> Address {
        Address::of_station(station.0, 5)
    }

    /// A station that has one address.
    fn admit(
        names: &mut Namesakes,
        (id, signer): (u32, Signer),
        now_ms: u64,
    ) -> Result<(), NotAdmitted> {
        let station = StationId(id);
        names.admit(station, (signer, address(station)), now_ms)
    }

    /// A ticket for each number.
    fn ticket(number: usize) -> Signer {
        Signer(u64::try_from(number + 1_000).unwrap().to_be_bytes())
    }

    #[test]
    fn an_id_belongs_to_one_ticket_until_it_is_silent() {
        let mut names = Namesakes::default();
        let mut admit = |id, signer, now_ms| admit(&mut names, (id, signer), now_ms);
        assert_eq!(admit(1, A, 0), Ok(()));
        assert_eq!(admit(1, B, 1), OTHER);
        assert_eq!(admit(1, A, 9_000), Ok(()));
        assert_eq!(admit(1, B, 18_999), OTHER);
        assert_eq!(admit(1, B, 19_000), Ok(()));
        assert_eq!(admit(1, A, 19_001), OTHER);
    }

    #[test]
    fn a_ticket_has_one_id_at_a_time() {
        let mut names = Namesakes::default();
        let mut admit = |id, now_ms| admit(&mut names, (id, A), now_ms);
        assert_eq!(admit(1, 0), Ok(()));
        let second = Err(NotAdmitted::SecondId(StationId(1), StationId(2)));
        assert_eq!(admit(2, 9_999), second);
        assert_eq!(admit(2, 10_000), Ok(()));
    }

    #[test]
    fn nobody_who_is_heard_is_forgotten_for_somebody_new() {
        let mut names = Namesakes::default();
        for (id, number) in (0..).zip(0..NAMES_MAX) {
            assert_eq!(admit(&mut names, (id, ticket(number)), 0), Ok(()));
        }
        let more = (300, ticket(300));
        let one_more = admit(&mut names, more, 9_999);
        assert_eq!(one_more, Err(NotAdmitted::TooMany(StationId(300))));
        assert_eq!(admit(&mut names, (5, ticket(5)), 9_999), Ok(()));
        // The others have been silent for long enough by now.
        assert_eq!(admit(&mut names, more, 10_000), Ok(()));
        assert_eq!(names.others.len(), 2);
    }

    #[test]
    fn a_robots_id_is_its_own_whoever_squats_on_it() {
        let mut names = Namesakes::default();
        assert_eq!(admit(&mut names, (1, A), 0), Ok(()));
        names.bind(StationId(1), B, address(StationId(1)), 1);
        assert_eq!(admit(&mut names, (1, A), 2), OTHER);
        assert_eq!(admit(&mut names, (1, B), 3), Ok(()));
    }

    #[test]
    fn no_robot_that_is_heard_is_forgotten_for_others() {
        let mut names = Namesakes::default();
        names.bind(StationId(1), B, address(StationId(1)), 0);
        for (id, number) in (1_000..).zip(0..2 * NAMES_MAX) {
            let station = StationId(id);
            names.bind(station, ticket(number), address(station), 4);
        }
        assert_eq!(names.robots.len(), NAMES_MAX);
        assert_eq!(admit(&mut names, (1, A), 5), OTHER);
        // Vehicles have places of their own.
        assert_eq!(admit(&mut names, (2, A), 5), Ok(()));
    }

    #[test]
    fn an_id_has_one_address_while_it_is_heard() {
        let mut names = Namesakes::default();
        assert_eq!(admit(&mut names, (1, A), 0), Ok(()));
        let elsewhere = (A, address(StationId(2)));
        let moved = names.admit(StationId(1), elsewhere, 9_999);
        assert_eq!(moved, Err(NotAdmitted::OtherAddress(StationId(1))));
        assert_eq!(names.admit(StationId(1), elsewhere, 10_000), Ok(()));
    }
}
