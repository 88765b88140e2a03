//! The theorem: safety of any number of robots, sessions and messages, by induction over the steps of a run.
//!
//! One [`Exchange`] is watched: any leader, any of its sessions, any follower, any offer of it, any request. Its
//! [`History`] holds facts about the past, each of which becomes known once and stays known. A proof for one exchange is one
//! for all, because all parts of it are arbitrary.
//!
//! ```text
//!  messages::ram_is_true, rmcm_is_true    what a message implies of the history, whenever it arrives
//!  robots::agrees                         what the state of a robot and the history imply of each other
//!  steps::keeps                           one step keeps both, and breaks no property
//!  leases                                 from facts to real time: what an open corridor rests on
//! ```
//!
//! Nothing here calls a predicate of the protocol: numbers are compared by their positions from the first one, and
//! states are read field by field.

use crate::id::{
    Heartbeat, ManeuverId, OfferNumber, RequestId, SessionId, StationId, UniqueNumber,
};
use crate::task::TaskType;

pub mod alone;
pub mod facts;
pub mod leases;
pub mod messages;
pub mod observer;
pub mod robots;
pub mod steps;

/// The exchange that is watched.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Exchange {
    /// A session of some leader.
    pub session: SessionId,
    /// A robot that may follow in it; not the leader.
    pub follower: StationId,
    /// One number that this robot may give an offer.
    pub offer: OfferNumber,
    /// One request number.
    pub request: RequestId,
    /// The number of the leader's first command of a session.
    pub first: RequestId,
    /// One heartbeat of the leader.
    pub heartbeat: Heartbeat,
}

impl Exchange {
    /// The maneuver that the leader commands.
    #[must_use]
    pub const fn maneuver(&self) -> ManeuverId {
        ManeuverId::of(self.session, self.request)
    }

    /// True if this is the leader.
    #[must_use]
    pub fn is_led_by(&self, station: StationId) -> bool {
        self.session.leader == station
    }

    /// How many numbers a request is behind the first one of a session.
    pub(super) const fn position(&self, request: RequestId) -> u8 {
        request.0.wrapping_sub(self.first.0)
    }

    /// True if this is the watched heartbeat or a later one, among heartbeats that are near it.
    pub(super) const fn has_come(&self, heartbeat: Heartbeat) -> bool {
        heartbeat.0.wrapping_sub(self.heartbeat.0) < HALF_SPACE
    }

    /// True if a heartbeat is less than a quarter of the number space from the watched one, so that any two such
    /// heartbeats can be put in order: 27 minutes with a RAM in 100 ms.
    #[must_use]
    pub const fn is_near(&self, heartbeat: Heartbeat) -> bool {
        let from_quarter = self.heartbeat.0.wrapping_sub(HALF_SPACE / 2);
        heartbeat.0.wrapping_sub(from_quarter) < HALF_SPACE
    }

    /// The position of the watched request.
    pub(super) const fn place(&self) -> u8 {
        self.position(self.request)
    }
}

/// Half of the number space of heartbeats.
const HALF_SPACE: u16 = 1 << 15;

/// When the follower has heard the watched heartbeat, or a later one, first.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Heard {
    /// It was not through with the watched request: it executed it, or it had not accepted it yet.
    BeforeTheEnd,
    /// It did not execute the watched request any more.
    AfterTheEnd,
}

/// The facts of an exchange. A fact that is known stays known.
#[expect(clippy::struct_excessive_bools, reason = "each is a fact of its own")]
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub struct History {
    /// The leader has opened the session.
    pub requested: bool,
    /// The leader has ended the session, or lost power in it.
    pub ended: bool,
    /// The leader has listed the follower, with this offer.
    pub listed: Option<OfferNumber>,
    /// The leader has dropped the follower.
    pub dropped: bool,
    /// The leader has sent the watched heartbeat of the session, or a later one.
    pub beaten: bool,
    /// The leader has commanded this as the watched request.
    pub commanded: Option<TaskType>,
    /// The follower has made the watched offer to the session.
    pub offered: bool,
    /// The follower has entered the session.
    pub joined: bool,
    /// The follower has no part in the session any more.
    pub left: bool,
    /// The follower has heard the watched heartbeat of the session, or a later one.
    pub heard: Option<Heard>,
    /// The follower has accepted the watched request.
    pub accepted: bool,
    /// The follower has refused it.
    pub refused: bool,
    /// The follower has started it.
    pub started: bool,
    /// The follower has started a newer one of the session.
    pub newer_started: bool,
    /// The follower's body has said that it holds its place.
    pub in_position: bool,
    /// The follower's body has said that it has completed it.
    pub completed: bool,
    /// The follower has fallen back from it.
    pub fell_back: bool,
    /// The follower has started it and does not execute it any more.
    pub over: bool,
}

impl History {
    /// True if the body of the follower executes the watched request.
    #[must_use]
    pub const fn runs(&self) -> bool {
        self.started && !self.over
    }
}

/// True if a station that gives out `next` next has given out `number`.
pub(super) const fn is_given_out(number: UniqueNumber, next: UniqueNumber) -> bool {
    number.to_u32() < next.to_u32()
}
