//! Whether a vehicle that is heard or seen could no longer stop comfortably before the crossing, or before the way of a body.
//!
//! A vehicle is no hindrance when it stands beside the crossing, has passed with its whole length, passes aside, or is farther away
//! than it needs to stop: `v * reaction + v² / (2 * deceleration)`. An older report counts as if the vehicle had gone on since. A vehicle that
//! falls silent counts for `keep`, also where its number is that of another one by now: a vehicle that cannot be where the next
//! report has it is another one. Vehicles that are neither heard nor seen are the road authority's concern, but for those of packets
//! that the robot itself had to drop: while it may have missed one, go does not begin, and no body leaves the kerb for an empty road.
//!
//! A vehicle passes aside if its line does, and if no bend leads it to the crossing: drivers take one with a radius of
//! `v² / deceleration` at least, for they put up with no more to the side than before them.
//!
//! Where vehicles are asked to stop, one that is soon at the crossing hinders *go* until it has said that it will. Its word makes
//! nothing safer than what it can do: it may lie, and then it hinders as soon as it could not stop any more.

#[cfg(any(test, feature = "laws"))]
pub mod laws;

use crossguard_protocol::{Millis, StationId};

use crate::ground::{Point, Shape, Way};
use crate::input::{RoadUser, Sighting, Vehicle};
use crate::setup::{Setup, TrafficRules};

/// Capacity for vehicles. A further one takes the place of one that stands or goes away, or else is a hindrance.
pub const VEHICLES: usize = 32;

/// How far from its middle a vehicle sweeps the road, in centimetres, with the half of a body: 2.6 m wide at most (Directive 96/53/EC).
const BESIDE_CM: u64 = 180;

/// How far before the crossing a vehicle is to stop, in centimetres: yield lines are 6 to 15 m before one (MUTCD 2009, section
/// 3B.16), and guards stand there.
const STOP_LINE_CM: u32 = 600;

/// How far a vehicle may be from where it was, in centimetres, beyond its way and the errors of both places: the next one in a queue
/// is farther away.
const JUMP_CM: u64 = 500;

/// How much slower a vehicle may be than it was, in cm/s, beyond 10 m/s² of braking.
const SLOWER_CMPS: u64 = 200;

/// How far before its middle the front of a car is, in centimetres.
const FRONT_CM: u16 = 250;

/// The key of a vehicle whose number is that of another one by now.
const RENUMBERED: u64 = 1 << 60;

/// How fast a vehicle is taken to be that does not say it, in cm/s: the limit in towns, 50 km/h.
const UNKNOWN_CMPS: u32 = 1_390;

/// How a vehicle comes to the crossing.
#[derive(Clone, Copy, Debug)]
struct Motion {
    /// How far it is from it.
    left_cm: u32,
    error_cm: u16,
    speed_cmps: u32,
    /// Whether it need not bend.
    is_in_line: bool,
}

/// A vehicle as it was heard or seen last.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
struct Known {
    vehicle: Vehicle,
    age: Millis,
    /// For how long yet its word counts that it will stop.
    promise: Millis,
}

impl Known {
    /// True if it may be where a newer report has a vehicle of its number.
    fn reaches(&self, vehicle: &Vehicle, time: Millis) -> bool {
        let speeds = [self.vehicle.velocity, vehicle.velocity].map(|it| u64::from(it.length_cm()));
        let way_cm = speeds.into_iter().max().unwrap_or(0) * u64::from(time.0) / 1_000;
        let errors_cm = u64::from(self.vehicle.error_cm) + u64::from(vehicle.error_cm);
        let gone_cm = u64::from(self.vehicle.at.distance_cm(vehicle.at));
        // Nor does it brake harder than that: a car's number may go to the bus beside it that stands.
        let [was, is] = speeds;
        gone_cm <= way_cm + errors_cm + JUMP_CM && was <= is + u64::from(time.0) + SLOWER_CMPS
    }
}

/// The beliefs about the vehicles around.
#[derive(Clone, PartialEq, Eq, Hash, Debug, Default)]
pub struct Traffic {
    vehicles: [Option<Known>; VEHICLES],
    /// There are too many: this one counts as one that cannot stop.
    further: Option<(u64, Millis)>,
    /// For how long yet one may be there that was not heard.
    unheard: Millis,
}

impl Traffic {
    /// Lets time pass.
    pub(crate) fn elapse(&mut self, setup: &Setup, time: Millis) {
        let left = self
            .further
            .map(|(key, left)| (key, left.saturating_sub(time)));
        self.further = left.filter(|(_, left)| *left > Millis::ZERO);
        self.unheard = self.unheard.saturating_sub(time);
        for slot in &mut self.vehicles {
            if let Some(known) = slot {
                known.age = known.age.saturating_add(time);
                known.promise = known.promise.saturating_sub(time);
            }
            if slot.is_some_and(|known| known.age > setup.traffic.keep) {
                *slot = None;
            }
        }
    }

    /// Takes in a report of a vehicle, made `age` ago.
    pub(crate) fn hear(&mut self, setup: &Setup, vehicle: Vehicle, age: Millis) {
        if age > setup.traffic.keep {
            return;
        }
        let mut known = self.vehicles.iter_mut().flatten();
        if let Some(known) = known.find(|it| it.vehicle.key == vehicle.key) {
            let Some(since) = known.age.0.checked_sub(age.0).map(Millis) else {
                // A late report says nothing new.
                return;
            };
            if known.reaches(&vehicle, since) {
                (known.vehicle, known.age) = (vehicle, age);
                return;
            }
            known.vehicle.key |= RENUMBERED;
        }
        if !may_hinder(setup, &vehicle) {
            return;
        }
        let may_replace =
            |slot: &&mut Option<Known>| slot.is_none_or(|it| !may_hinder(setup, &it.vehicle));
        let known = Known {
            vehicle,
            age,
            promise: Millis::ZERO,
        };
        match self.vehicles.iter_mut().find(may_replace) {
            Some(slot) => *slot = Some(known),
            None => self.further = Some((vehicle.key, setup.traffic.keep)),
        }
    }

    /// Vehicles may be there for so long that are not heard.
    pub(crate) fn miss(&mut self, time: Millis) {
        self.unheard = self.unheard.max(time);
    }

    /// Whether a vehicle may be there that was not heard.
    pub(crate) fn is_missed(&self) -> bool {
        self.unheard > Millis::ZERO
    }

    /// Takes in a vehicle's answer to the newest question whether it will stop.
    pub(crate) fn answer(&mut self, setup: &Setup, station: StationId, promises: bool) {
        let of_station = |it: &&mut Known| it.vehicle.station == Some(station);
        for known in self.vehicles.iter_mut().flatten().filter(of_station) {
            known.promise = if promises {
                setup.traffic.keep
            } else {
                Millis::ZERO
            };
        }
    }

    /// The first vehicle to be asked that has not said that it will stop, and where its front is to stand.
    pub(crate) fn unpromised(&self, setup: &Setup) -> Option<(StationId, Point)> {
        let (rules, crossing) = (&setup.traffic, setup.ground.where_people_cross()?);
        if rules.asks == Millis::ZERO {
            return None;
        }
        self.vehicles.iter().flatten().find_map(|it| {
            let vehicle = &it.vehicle;
            let motion = ahead(setup, crossing, vehicle).filter(|it| it.is_in_line)?;
            let is_soon_there = motion.comes_within(rules.asks, it.age);
            let station = vehicle
                .station
                .filter(|_| is_soon_there && it.promise == Millis::ZERO)?;
            let way = i32::try_from(motion.left_cm.saturating_sub(STOP_LINE_CM)).ok()?;
            let speed = i32::try_from(motion.speed_cmps).ok()?;
            Some((
                station,
                front(vehicle).plus(vehicle.velocity.part(way, speed)),
            ))
        })
    }

    /// The first vehicle that could no longer stop comfortably before the crossing.
    #[must_use]
    pub fn hindrance(&self, setup: &Setup) -> Option<u64> {
        self.first(
            setup,
            setup.ground.where_people_cross()?,
            &setup.traffic,
            |_, _| true,
        )
    }

    /// Whether a body that goes from one place to another would step in front of a vehicle that could no longer stop: comfortably,
    /// or by hard braking where it is urgent. Vehicles that would have to bend do not count, nor, on the road, those whose line it
    /// stands on already, unless it was held at the kerb and could not stop before it.
    pub(crate) fn comes_at(
        &self,
        setup: &Setup,
        [from, to]: [Point; 2],
        is_urgent: bool,
        is_held: bool,
    ) -> bool {
        let Some(way) = Shape::new(&[from, to, to]) else {
            return false;
        };
        let rules = if is_urgent {
            setup.traffic.urgent()
        } else {
            setup.traffic
        };
        let is_on_road = setup.ground.is_road(from) && !is_held;
        let counts = |vehicle: &Vehicle, motion: &Motion| {
            motion.is_in_line && (!is_on_road || aside_cm(vehicle, from) >= BESIDE_CM)
        };
        self.first(setup, &way, &rules, counts).is_some()
    }

    /// The first of the vehicles that count which could no longer stop before a place, or else one that is too many to be kept.
    fn first(
        &self,
        setup: &Setup,
        place: &Shape,
        rules: &TrafficRules,
        counts: impl Fn(&Vehicle, &Motion) -> bool,
    ) -> Option<u64> {
        let hinders = |it: &&Known| {
            let vehicle = towards(setup, &it.vehicle, place.middle());
            let ahead = ahead(setup, place, &vehicle).filter(|motion| counts(&vehicle, motion));
            ahead.is_some_and(|motion| !motion.can_stop(rules, it.age))
        };
        let key = self.vehicles.iter().flatten().find(hinders);
        let key = key.map(|it| it.vehicle.key);
        key.or(self.further.map(|(key, _)| key))
    }
}

/// The velocity of a vehicle of which not everything is said. One of which nobody knows how fast it is may be as fast as is allowed
/// in towns; one of which nobody knows its direction, which is a way of any length, comes to the crossing.
#[must_use]
pub fn velocity(setup: &Setup, at: Point, speed_cmps: Option<u32>, direction: Option<Way>) -> Way {
    let to_crossing = || Some(at.to(setup.ground.where_people_cross()?.middle()));
    let Some(known) = direction.or_else(to_crossing) else {
        return Way::default();
    };
    // In the middle of the crossing, any direction is as good as another.
    let north = Way {
        east_cm: 0,
        north_cm: 1,
    };
    let direction = if known == Way::default() {
        north
    } else {
        known
    };
    let numbers = [speed_cmps.unwrap_or(UNKNOWN_CMPS), direction.length_cm()];
    let [speed, length] = numbers.map(|it| i32::try_from(it).unwrap_or(i32::MAX));
    direction.part(speed, length)
}

/// How long a vehicle is taken to be: as long as it says, and as long as the rules say at least.
#[must_use]
pub fn length_cm(setup: &Setup, said_cm: Option<u16>) -> u16 {
    said_cm.unwrap_or(0).max(setup.traffic.length_cm)
}

/// Whether somebody comes like a vehicle: is one, or is faster than people walk.
#[must_use]
pub fn rides(setup: &Setup, sighting: &Sighting) -> bool {
    let is_fast = |it: Way| it.length_cm() > u32::from(setup.sensors.speed_max_cmps);
    matches!(sighting.what, RoadUser::Vehicle | RoadUser::Motorcyclist)
        || sighting.velocity.is_some_and(is_fast)
}

/// A vehicle, or somebody who comes like one, as a sensor sees it.
#[must_use]
pub fn seen(setup: &Setup, key: u64, sighting: &Sighting) -> Vehicle {
    let unsaid = || velocity(setup, sighting.at, None, None);
    Vehicle {
        key,
        station: None,
        at: sighting.at,
        front_cm: match sighting.what {
            RoadUser::Vehicle => FRONT_CM,
            _ => 0,
        },
        length_cm: length_cm(setup, None),
        error_cm: sighting.error_cm,
        velocity: sighting.velocity.unwrap_or_else(unsaid),
        goes_anywhere: sighting.velocity.is_none(),
    }
}

/// Whether a vehicle moves on a line or a bend that leads over the crossing.
fn may_hinder(setup: &Setup, vehicle: &Vehicle) -> bool {
    setup
        .ground
        .where_people_cross()
        .is_some_and(|crossing| ahead(setup, crossing, vehicle).is_some())
}

/// A vehicle as it comes to a place, if its direction is not known.
fn towards(setup: &Setup, vehicle: &Vehicle, place: Point) -> Vehicle {
    if !vehicle.goes_anywhere {
        return *vehicle;
    }
    let speed = Some(vehicle.velocity.length_cm());
    let direction = Some(vehicle.at.to(place));
    Vehicle {
        velocity: velocity(setup, vehicle.at, speed, direction),
        ..*vehicle
    }
}

/// How a vehicle comes to a place, if it moves on a line or a bend that comes near it, and has not passed it with its whole length.
fn ahead(setup: &Setup, place: &Shape, vehicle: &Vehicle) -> Option<Motion> {
    let rules = &setup.traffic;
    let middle: Point = place.middle();
    let vehicle = &towards(setup, vehicle, middle);
    let speed_cmps = vehicle.velocity.length_cm();
    let half = place.reach_cm();
    // It may be anywhere within its error.
    let error_cm = u32::from(vehicle.error_cm);
    let near = half.saturating_add(error_cm);
    let aside = aside_cm(vehicle, middle).saturating_sub(near.into());
    let is_in_line = aside <= rules.aside_cm.into();
    let front = front(vehicle);
    let distance_cm = place.distance_cm(front);
    let left_cm = if vehicle.velocity.dot(front.to(middle)) > 0 {
        distance_cm
    } else if distance_cm <= u32::from(vehicle.length_cm).saturating_add(error_cm) {
        0
    } else {
        return None;
    };
    let motion = Motion {
        left_cm,
        error_cm: vehicle.error_cm,
        speed_cmps,
        is_in_line,
    };
    let farthest_cm = front.distance_cm(middle).saturating_add(half);
    let may_come = is_in_line || aside <= motion.bend_cm(rules, farthest_cm);
    let moves = may_come && speed_cmps > rules.standing_cmps.into();
    // People would step in front of one that stands where they cross, and it goes on.
    let is_in_their_way = setup.ground.crossing.is_some() && place.has(vehicle.at);
    (moves || is_in_their_way).then_some(motion)
}

/// Where the front of a vehicle is that moves.
fn front(vehicle: &Vehicle) -> Point {
    let speed = i32::try_from(vehicle.velocity.length_cm()).unwrap_or(i32::MAX);
    vehicle
        .at
        .plus(vehicle.velocity.part(vehicle.front_cm.into(), speed))
}

/// How far the line of a vehicle passes from a place.
fn aside_cm(vehicle: &Vehicle, place: Point) -> u64 {
    let speed = u64::from(vehicle.velocity.length_cm()).max(1);
    vehicle.velocity.cross(vehicle.at.to(place)).unsigned_abs() / speed
}

impl Motion {
    /// Whether it can stop comfortably, if it was like this `age` ago and has gone on.
    fn can_stop(self, rules: &TrafficRules, age: Millis) -> bool {
        self.left_cm(age) > self.way_cm(rules.reaction) + self.radius_cm(rules) / 2
    }

    /// The least radius of a bend that it takes; half of it is the way on which it brakes.
    fn radius_cm(self, rules: &TrafficRules) -> u64 {
        let speed = u64::from(self.speed_cmps);
        speed.saturating_mul(speed) / u64::from(rules.deceleration_cmps2.max(1))
    }

    /// How far from its line a bend leads it to a place that is so far off. A place that it comes to later than reports of it are
    /// kept is as good as none.
    fn bend_cm(self, rules: &TrafficRules, off_cm: u32) -> u64 {
        let radius = self.radius_cm(rules);
        let soon = self.way_cm(rules.reaction.saturating_add(rules.keep)) + radius / 2;
        let off = u64::from(off_cm).min(soon);
        off.saturating_mul(off) / radius.saturating_mul(2).max(1)
    }

    /// Whether it is at the place within a time, if it goes on.
    fn comes_within(self, time: Millis, age: Millis) -> bool {
        self.left_cm(age) <= self.way_cm(time)
    }

    /// How far it is from the place at least, if it was like this `age` ago.
    fn left_cm(self, age: Millis) -> u64 {
        let gone = self.way_cm(age).saturating_add(u64::from(self.error_cm));
        u64::from(self.left_cm).saturating_sub(gone)
    }

    /// How far it goes in a time.
    fn way_cm(self, time: Millis) -> u64 {
        u64::from(self.speed_cmps).saturating_mul(u64::from(time.0)) / 1_000
    }
}
