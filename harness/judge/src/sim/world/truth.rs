//! The properties P1 to P4, P9 and P10, judged by where people, bodies and vehicles really are.
//!
//! Nothing here asks a crossing machine what is so.

use crossguard_model_check::road::Body;
use crossguard_protocol::{Event, Input, Outputs};
use crossguard_robot::site::Place;

use super::{Finding, World};
use crate::sim::place::ROAD_M;

/// How far a guard may be from its place, in metres.
pub(super) const TOLERANCE_M: f64 = 2.05;

/// How far an escort may be ahead of its person, in metres, and how far it goes until it stands.
const AHEAD_M: f64 = 2.5;

/// Within which time a vehicle was heard, in microseconds.
const HEARD_US: u64 = 600_000;

/// How fast a vehicle is that counts as moving, in m/s, and for how long its promise counts at most, in microseconds.
const MOVES_MPS: f64 = 1.5;
const PROMISES_US: u64 = 6_000_000;

/// For how long a vehicle that cannot stop has been heard when a body ought to stand at the kerb, in microseconds.
const STANDS_WITHIN_US: u64 = 1_500_000;

/// How far from the kerb a body is on the road, and beside it with room to stop, in metres.
const KERB_M: f64 = 0.1;
const STOPS_M: f64 = 1.0;

/// For how long after somebody was on the road robots may have them there, as with sensors that fail.
const LINGERS_US: u64 = 60_000_000;

/// Needs of a driver to stop: time of reaction in s, and deceleration in m/s²; comfortably, and by hard braking.
const COMFORT: [f64; 2] = [2.0, 3.0];
const HARD: [f64; 2] = [1.0, 6.0];

/// A property's id, and what it says.
type Judged = (&'static str, &'static str);

const P1: Judged = (
    "P1",
    "no guard leaves by its application's word while a person of its session is on the road",
);
const P2: Judged = (
    "P2",
    "go is shown only while every guard in position is within tolerance of its place, or left it less than the bound ago",
);
const P3: Judged = (
    "P3",
    "go does not begin while a vehicle that is heard can no longer stop comfortably",
);
const P4: Judged = (
    "P4",
    "an escort on the road does not go on while a person of its session is far behind",
);

const P9: Judged = (
    "P9",
    "no robot steps on the road while a vehicle that it hears can no longer stop, comfortably or, where somebody is on it, at all",
);

const P10: Judged = (
    "P10",
    "where vehicles are asked, go does not begin while one that is heard and soon there has not said that it will stop",
);

/// Observation of a body from one moment to the next.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ObservedBody {
    /// Where its maneuver leads.
    pub(super) target: Option<Place>,
    /// Since when it is off that place while it says that it is in position.
    off_since_us: Option<u64>,
    /// Where it was when a person of its session was too far behind first.
    apart_at: Option<Place>,
    /// Whether it was beside the road last, and has not been pushed since.
    pub(super) is_beside_road: bool,
    /// Since when it hears a vehicle that cannot stop.
    hears_since_us: Option<u64>,
}

impl World<'_> {
    /// P1, before a step of a robot is taken into account.
    pub(super) fn judge_word(
        &mut self,
        place: usize,
        input: Input,
        outputs: &Outputs,
    ) -> Result<(), Finding> {
        let (Input::Local(event), None) = (input, outputs.ignored()) else {
            return Ok(());
        };
        let body = self.monitor.node(place).actuation.body;
        let left = match (event, body) {
            (Event::RoadClear, Body::FallingBack(maneuver, _)) => Some(maneuver),
            (Event::ManeuverCompleted(id), _) => self
                .monitor
                .guards(place)
                .filter(|maneuver| maneuver.id == id),
            _ => None,
        };
        let Some(maneuver) = left else {
            return Ok(());
        };
        let session = maneuver.id.session;
        let walkers = self.walkers.iter();
        let mut people = walkers.filter(|it| it.session == Some(session)).peekable();
        if people.peek().is_some() {
            self.met.insert(P1.0);
        }
        // A person who has stepped on the road since the sensors' last chance to show them is not known.
        let seen_us = self.now_us.saturating_sub(self.shows_within_us(place));
        if people.any(|it| it.is_on_road(self.now_us) && it.is_on_road(seen_us)) {
            return Err(self.broken(P1, place));
        }
        Ok(())
    }

    /// Within which time a robot's sensors show everybody on the road, in microseconds: as many frames as may miss somebody,
    /// and the lag of one. Without sensors it knows everybody.
    fn shows_within_us(&self, place: usize) -> u64 {
        let sensing = self.swarm.sensing.as_ref();
        let times_ms = sensing.into_iter().flat_map(|it| {
            let frames = u32::from(it.miss_max).max(1);
            let sources = it.sources[place].iter();
            sources.map(move |source| frames * source.period_ms + source.latency_ms)
        });
        u64::from(times_ms.max().unwrap_or(0)) * 1_000
    }

    /// P3 and P10, when the sign of a leader begins to show go.
    pub(super) fn judge_go(&mut self, place: usize) -> Result<(), Finding> {
        if self.vehicles_heard(place).next().is_some() {
            self.met.insert(P3.0);
        }
        let mut vehicles = self.vehicles_heard(place);
        if vehicles.any(|it| cannot_stop(it, COMFORT)) {
            return Err(self.broken(P3, place));
        }
        drop(vehicles);
        let asked: Vec<_> = self.vehicles_asked(place).collect();
        if !asked.is_empty() {
            self.met.insert(P10.0);
        }
        if asked.contains(&false) {
            return Err(self.broken(P10, place));
        }
        Ok(())
    }

    /// Whether each vehicle has promised to stop that a robot has heard lately and that is soon there, also as of an older report.
    fn vehicles_asked(&self, place: usize) -> impl Iterator<Item = bool> {
        let demand = self.swarm.demand.as_ref();
        let asks_s = demand.map_or(0.0, |it| it.habits.asks_vehicles_s);
        let soon = self.flow.drivers.iter().filter(move |it| {
            self.has_heard(place, it.number)
                && it.speed_mps > MOVES_MPS
                && (0.0..it.speed_mps * (0.8 * asks_s - 1.0)).contains(&-it.front_m)
        });
        soon.map(|it| {
            let promise = it.connection.as_ref().and_then(|it| it.promise);
            promise.is_some_and(|it| self.now_us - it.at_us < PROMISES_US)
        })
    }

    /// Whether a robot has heard a vehicle lately.
    fn has_heard(&self, place: usize, number: usize) -> bool {
        let heard_us = self.seats[place].heard_us.get(&number);
        heard_us.is_some_and(|at_us| self.now_us - at_us <= HEARD_US)
    }

    /// How far each vehicle that a robot has heard lately is before the crossing, in metres, and how fast it is, in m/s.
    fn vehicles_heard(&self, place: usize) -> impl Iterator<Item = [f64; 2]> {
        let is_heard = move |number: &usize| self.has_heard(place, *number);
        let cars = self.swarm.sensing.iter().flat_map(|it| it.cars.iter());
        let cars = cars.enumerate().filter(move |(number, _)| is_heard(number));
        let cars = cars.map(move |(_, car)| {
            let ahead_m = -self.car_east(*car) * car.speed_mps.signum();
            [ahead_m, car.speed_mps.abs()]
        });
        cars.chain(self.flow.vehicles_ahead(is_heard))
    }

    /// P9, when a body has moved.
    fn judge_step(&mut self, place: usize, at: Place) -> Result<(), Finding> {
        let now_us = self.now_us;
        let is_lately = |at_us: u64| now_us - at_us <= LINGERS_US;
        let needs = if self.occupied_us.is_some_and(is_lately) {
            HARD
        } else {
            COMFORT
        };
        let mut vehicles = self.vehicles_heard(place);
        let is_held = vehicles.any(|it| cannot_stop(it, needs));
        drop(vehicles);
        let observed = &mut self.seats[place].observed;
        let since_us = observed.hears_since_us.filter(|_| is_held);
        observed.hears_since_us = is_held.then(|| since_us.unwrap_or(now_us));
        let off_m = (at.north - ROAD_M / 2.0).abs() - ROAD_M / 2.0;
        let is_on_road = off_m < -KERB_M;
        let was_beside = observed.is_beside_road;
        observed.is_beside_road = off_m > STOPS_M || was_beside && !is_on_road;
        let ought_to_stand = since_us.is_some_and(|at_us| now_us - at_us > STANDS_WITHIN_US);
        if !was_beside || !ought_to_stand {
            return Ok(());
        }
        if off_m < 2.0 {
            self.met.insert(P9.0);
        }
        if is_on_road {
            return Err(self.broken(P9, place));
        }
        Ok(())
    }

    /// Whether robots may have somebody on the road: there is somebody, within the error of sensors.
    fn may_be_occupied(&self) -> bool {
        let sources = self.swarm.sensing.iter().flat_map(|it| it.sources.iter());
        let errors = sources.flatten().map(|it| it.error_m);
        let error_m = errors.fold(0.0, f64::max);
        self.walkers.iter().any(|it| {
            let north = it.place(self.now_us).north;
            north > -error_m && north < ROAD_M + error_m
        })
    }

    /// P2, P4 and P9, at any time.
    pub(super) fn judge_bodies(&mut self) -> Result<(), Finding> {
        if self.swarm.sensing.is_none() {
            return Ok(());
        }
        if self.may_be_occupied() {
            self.occupied_us = Some(self.now_us);
        }
        for place in 0..self.seats.len() {
            let Some(machine) = &self.seats[place].machine else {
                self.seats[place].observed = ObservedBody {
                    target: self.seats[place].observed.target,
                    ..ObservedBody::default()
                };
                continue;
            };
            let at = machine.application.body().place();
            self.judge_step(place, at)?;
            let settings = self.seats[place].draw.config.settings();
            match self.monitor.node(place).actuation.body {
                Body::InPosition(maneuver) if settings.holding.contains(maneuver.task) => {
                    let target = self.seats[place].observed.target;
                    let is_off = target.is_some_and(|to| to.distance(at) > TOLERANCE_M);
                    let now_us = self.now_us;
                    let since = &mut self.seats[place].observed.off_since_us;
                    *since = is_off.then(|| since.unwrap_or(now_us));
                    let Some(since_us) = *since else { continue };
                    for leader in self.road.signs_of(maneuver.id.session) {
                        self.met.insert(P2.0);
                        if now_us - since_us > self.road.leaves_within_us(leader) {
                            return Err(self.broken(P2, leader));
                        }
                    }
                }
                Body::UnderWay(maneuver) if settings.guarding.contains(maneuver.task) => {
                    let people: Vec<_> = self.on_road(maneuver.id.session).collect();
                    let is_on_road = at.north > 0.3 && at.north < 6.7;
                    let Some(target) = self.seats[place].observed.target else {
                        continue;
                    };
                    let left_m = target.distance(at);
                    let is_apart = people
                        .iter()
                        .any(|it| it.distance(target) > left_m + AHEAD_M);
                    let observed = &mut self.seats[place].observed;
                    if people.is_empty() || !is_on_road || !is_apart {
                        observed.apart_at = None;
                        if !people.is_empty() && is_on_road {
                            self.met.insert(P4.0);
                        }
                        continue;
                    }
                    let began_at = *observed.apart_at.get_or_insert(at);
                    let goes_m = 1.0 + 1.5 * self.seats[place].draw.time_scale;
                    if began_at.distance(at) > goes_m {
                        return Err(self.broken(P4, place));
                    }
                }
                _ => self.seats[place].observed.off_since_us = None,
            }
        }
        Ok(())
    }
}

/// Whether a vehicle so far before the crossing can no longer stop. As of its last CAM it may have been a little farther away.
fn cannot_stop([ahead_m, speed_mps]: [f64; 2], [reaction_s, deceleration_mps2]: [f64; 2]) -> bool {
    let stops_m = speed_mps * reaction_s + speed_mps * speed_mps / (2.0 * deceleration_mps2);
    ahead_m > 0.0 && ahead_m + speed_mps * 0.2 < stops_m
}
