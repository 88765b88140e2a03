//! Whether a vehicle that is heard or seen could no longer stop comfortably before the crossing, or before the way of a body.
//!
//! A vehicle is no hindrance when it stands, has passed with its whole length, passes aside, or is farther away than it needs to stop:
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

/// How far from its middle a vehicle sweeps the road, in centimetres, with the half of a body: 2.6 m wide at most (Directive 96/53/EC).
const BESIDE_CM: u64 = 180;

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

    /// The first vehicle that could no longer stop comfortably before the crossing.
    #[must_use]
    pub fn hindrance(&self, setup: &Setup) -> Option<u32> {
        self.first(setup, crossing(setup)?, &setup.traffic, |_| true)
    }

    /// Whether a body that goes from one place to another would step in front of a vehicle that could no longer stop: comfortably,
    /// or by hard braking where it is urgent. On the road, vehicles whose line it stands on already do not count.
    pub(crate) fn comes_at(&self, setup: &Setup, [from, to]: [Point; 2], is_urgent: bool) -> bool {
        let Some(way) = Shape::new(&[from, to, to]) else {
            return false;
        };
        let rules = if is_urgent {
            setup.traffic.urgent()
        } else {
            setup.traffic
        };
        let is_on_road = setup.ground.is_road(from);
        let counts = |vehicle: &Vehicle| !is_on_road || aside_cm(vehicle, from) >= BESIDE_CM;
        self.first(setup, &way, &rules, counts).is_some()
    }

    /// The first of the vehicles that count which could no longer stop before a place, or else one that is too many to be kept.
    fn first(
        &self,
        setup: &Setup,
        place: &Shape,
        rules: &TrafficRules,
        counts: impl Fn(&Vehicle) -> bool,
    ) -> Option<u32> {
        let hinders = |(vehicle, age): &&(Vehicle, Millis)| {
            let ahead = ahead(setup, place, vehicle).filter(|_| counts(vehicle));
            ahead.is_some_and(|it| !it.can_stop(rules, *age))
        };
        let key = self.vehicles.iter().flatten().find(hinders);
        let key = key.map(|(vehicle, _)| vehicle.key);
        key.or(self.further.map(|(key, _)| key))
    }
}

fn crossing(setup: &Setup) -> Option<&Shape> {
    setup
        .ground
        .crossing
        .as_ref()
        .or(setup.ground.road.as_ref())
}

/// Whether a vehicle moves on a line that leads over the crossing.
fn may_hinder(setup: &Setup, vehicle: &Vehicle) -> bool {
    crossing(setup).is_some_and(|crossing| ahead(setup, crossing, vehicle).is_some())
}

/// How a vehicle comes to a place, if it moves on a line that comes near it, and has not passed it with its whole length.
fn ahead(setup: &Setup, place: &Shape, vehicle: &Vehicle) -> Option<Motion> {
    let rules = &setup.traffic;
    let speed_cmps = vehicle.velocity.length_cm();
    let middle: Point = place.middle();
    let half = place.corners().map(|corner| corner.distance_cm(middle));
    let near = u64::from(half.max().unwrap_or(0)) + u64::from(rules.aside_cm);
    if speed_cmps <= u32::from(rules.standing_cmps) || aside_cm(vehicle, middle) > near {
        return None;
    }
    let distance_cm = place.distance_cm(vehicle.at);
    let left_cm = if vehicle.velocity.dot(vehicle.at.to(middle)) > 0 {
        distance_cm
    } else if distance_cm <= u32::from(rules.length_cm) {
        0
    } else {
        return None;
    };
    Some(Motion {
        left_cm,
        error_cm: vehicle.error_cm,
        speed_cmps,
    })
}

/// How far the line of a vehicle passes from a place.
fn aside_cm(vehicle: &Vehicle, place: Point) -> u64 {
    let speed = u64::from(vehicle.velocity.length_cm()).max(1);
    vehicle.velocity.cross(vehicle.at.to(place)).unsigned_abs() / speed
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
