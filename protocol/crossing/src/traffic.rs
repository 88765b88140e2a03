//! Whether a vehicle that is heard or seen could no longer stop comfortably before the crossing.
//!
//! A vehicle is no hindrance when it stands, goes away from the crossing, passes it aside, or is farther from it than it needs to stop:
//! `v * reaction + v² / (2 * deceleration)`. An older report counts as if the vehicle had gone on since. A vehicle that
//! falls silent counts for `keep`. Vehicles that are neither heard nor seen are the road authority's concern.

#[cfg(any(test, feature = "laws"))]
pub mod laws;

use crossguard_protocol::Millis;

use crate::ground::{Point, Shape};
use crate::input::Vehicle;
use crate::setup::{Setup, TrafficRules};

/// Capacity for vehicles. A further one takes the place of one that stands or goes away, or else is a hindrance.
pub const VEHICLES: usize = 32;

/// How a vehicle comes to the crossing.
#[derive(Clone, Copy, Debug)]
struct Motion {
    /// How far it is from it.
    left_cm: u32,
    error_cm: u16,
    speed_cmps: u32,
}

/// What is known of the vehicles around.
#[derive(Clone, PartialEq, Eq, Hash, Debug, Default)]
pub struct Traffic {
    vehicles: [Option<(Vehicle, Millis)>; VEHICLES],
    /// There are too many: this one counts as one that cannot stop.
    further: Option<(u32, Millis)>,
}

impl Traffic {
    /// Lets time pass.
    pub(crate) fn elapse(&mut self, setup: &Setup, time: Millis) {
        let left = self
            .further
            .map(|(key, left)| (key, left.saturating_sub(time)));
        self.further = left.filter(|(_, left)| *left > Millis::ZERO);
        for slot in &mut self.vehicles {
            if let Some((_, age)) = slot {
                *age = age.saturating_add(time);
            }
            if slot.is_some_and(|(_, age)| age > setup.traffic.keep) {
                *slot = None;
            }
        }
    }

    /// Takes in a report of a vehicle, made `age` ago.
    pub(crate) fn hear(&mut self, setup: &Setup, vehicle: Vehicle, age: Millis) {
        if age > setup.traffic.keep {
            return;
        }
        let is_own =
            |slot: &Option<(Vehicle, Millis)>| slot.is_some_and(|(it, _)| it.key == vehicle.key);
        if let Some(own) = self.vehicles.iter().position(is_own) {
            // A late report says nothing new.
            if self.vehicles[own].is_none_or(|(_, known)| age <= known) {
                self.vehicles[own] = Some((vehicle, age));
            }
            return;
        }
        if !may_hinder(setup, &vehicle) {
            return;
        }
        let is_free = |slot: &Option<(Vehicle, Millis)>| {
            slot.is_none_or(|(vehicle, _)| !may_hinder(setup, &vehicle))
        };
        if let Some(place) = self.vehicles.iter().position(is_free) {
            self.vehicles[place] = Some((vehicle, age));
        } else {
            self.further = Some((vehicle.key, setup.traffic.keep));
        }
    }

    /// The first vehicle that could no longer stop comfortably.
    #[must_use]
    pub fn hindrance(&self, setup: &Setup) -> Option<u32> {
        let mut vehicles = self.vehicles.iter().flatten();
        let hindering = vehicles.find(|(vehicle, age)| is_hindrance(setup, vehicle, *age));
        let key = hindering.map(|(vehicle, _)| vehicle.key);
        key.or(self.further.map(|(key, _)| key))
    }
}

/// Whether a vehicle moves on a line that leads over the crossing.
fn may_hinder(setup: &Setup, vehicle: &Vehicle) -> bool {
    let crossing = setup.ground.crossing.or(setup.ground.road);
    let is_moving = vehicle.velocity.length_cm() > u32::from(setup.traffic.standing_cmps);
    is_moving && crossing.is_some_and(|crossing| comes(setup, &crossing, vehicle))
}

/// Whether a vehicle could no longer stop comfortably, as reported `age` ago.
fn is_hindrance(setup: &Setup, vehicle: &Vehicle, age: Millis) -> bool {
    let Some(crossing) = setup.ground.crossing.or(setup.ground.road) else {
        return false;
    };
    if !may_hinder(setup, vehicle) {
        return false;
    }
    let motion = Motion {
        left_cm: crossing.distance_cm(vehicle.at),
        error_cm: vehicle.error_cm,
        speed_cmps: vehicle.velocity.length_cm(),
    };
    !motion.can_stop(&setup.traffic, age)
}

impl Motion {
    /// Whether it can stop comfortably, if it was like this `age` ago and has gone on.
    fn can_stop(self, rules: &TrafficRules, age: Millis) -> bool {
        let speed = u64::from(self.speed_cmps);
        let gone = speed.saturating_mul(u64::from(age.0)) / 1_000 + u64::from(self.error_cm);
        let left = u64::from(self.left_cm).saturating_sub(gone);
        let reacting = speed.saturating_mul(u64::from(rules.reaction.0)) / 1_000;
        let braking =
            speed.saturating_mul(speed) / (2 * u64::from(rules.deceleration_cmps2.max(1)));
        left > reacting.saturating_add(braking)
    }
}

/// Whether a vehicle moves towards the crossing, on a line that comes near it.
fn comes(setup: &Setup, crossing: &Shape, vehicle: &Vehicle) -> bool {
    let middle: Point = crossing.middle();
    let half = crossing
        .corners()
        .map(|corner| corner.distance_cm(middle))
        .max();
    let way = vehicle.at.to(middle);
    let speed = u64::from(vehicle.velocity.length_cm()).max(1);
    let aside = vehicle.velocity.cross(way).unsigned_abs() / speed;
    let near = u64::from(half.unwrap_or(0)) + u64::from(setup.traffic.aside_cm);
    aside <= near && (vehicle.velocity.dot(way) > 0 || crossing.has(vehicle.at))
}
