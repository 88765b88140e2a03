//! The tickets of robots that have a part in the robot's session: a robot that joins under one ticket stays under it.
//!
//! The station id follows from the ticket, by four octets of its digest or by a name in it, so two tickets can have one
//! id: by chance, by search, or because the authority gave the same name twice. A session believes of its leader and
//! of each member only what *that* ticket has said; without security, only what came without a ticket.

use crossguard_codec::geonet::Signer;
use crossguard_protocol::{MAX_FOLLOWERS, Phase, Robot, StationId};

/// Signer of a message; `None` without an envelope.
type Vouching = Option<Signer>;

/// The tickets of those in the robot's session.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Pins([Option<(StationId, Vouching)>; MAX_FOLLOWERS]);

impl Pins {
    /// Whether somebody may speak under this ticket, as far as the session of `robot` goes.
    pub(super) fn allow(&mut self, robot: &Robot, from: StationId, signer: Vouching) -> bool {
        // A station that has left may come back under another ticket.
        for pin in &mut self.0 {
            pin.take_if(|(station, _)| !has_part(robot, *station));
        }
        let mut pins = self.0.iter().flatten();
        pins.all(|(station, by)| *station != from || *by == signer)
    }

    /// `robot` has taken in what somebody said under this ticket.
    pub(super) fn keep(&mut self, robot: &Robot, from: StationId, signer: Vouching) {
        let is_pinned = self.0.iter().flatten().any(|(station, _)| *station == from);
        if is_pinned || !has_part(robot, from) {
            return;
        }
        // There is a place for each robot that has a part, once the ones without a part are gone.
        let place = self.0.iter_mut().find(|pin| {
            pin.as_ref()
                .is_none_or(|(station, _)| !has_part(robot, *station))
        });
        if let Some(place) = place {
            *place = Some((from, signer));
        }
    }
}

/// Whether the robot's session relies on this station: its leader, a member, or who offers to be one.
fn has_part(robot: &Robot, station: StationId) -> bool {
    match robot.phase() {
        Phase::Idle => false,
        Phase::Requesting(own) => own.offers.iter().any(|offer| offer.station == station),
        Phase::Leading(own) => own.member(station).is_some(),
        Phase::Offering(_) | Phase::Following(_) => robot
            .session()
            .is_some_and(|session| session.leader == station),
    }
}
