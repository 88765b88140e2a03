//! The crossing at which a robot helps: what it believes of the road is of that one.

use crossguard_codec::{Position, distance};
use crossguard_protocol::Place;

/// A crossing at which a robot helps.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Served {
    /// Its reference; [`Place::UNKNOWN`] may be that of any.
    pub place: Place,
    /// Its middle.
    pub middle: Position,
    /// How far from its middle robots are that ask for help there, in metres at most.
    pub within_m: f64,
}

impl Served {
    /// Whether a request for help at `place` is for it, of a robot that is at `from`: it has the same reference, or it may
    /// have, and the robot is near. A robot that does not say where it is is far away.
    pub(super) fn is_meant(&self, place: Place, from: &Position) -> bool {
        let is_named = place != Place::UNKNOWN && place == self.place;
        let off_m = f64::from(distance(&self.middle, from).0) / 10.0;
        is_named || self.place.may_be(place) && off_m <= self.within_m + from.error_m()
    }

    /// Whether a robot that leads at `place`, which may be this crossing by its name, is known to be far away from it. One that does
    /// not say where it is may be here: two leaders at one crossing settle which of them goes on.
    pub(super) fn is_elsewhere(&self, place: Place, from: &Position) -> bool {
        let is_known = from.latitude.is_some() && from.longitude.is_some();
        is_known && self.place.may_be(place) && !self.is_meant(place, from)
    }
}
