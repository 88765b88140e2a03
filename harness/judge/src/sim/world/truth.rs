//! The properties P1 to P4, judged by where people, bodies and vehicles really are.
//!
//! Nothing here asks a crossing machine what is so.

use crossguard_model_check::road::Body;
use crossguard_protocol::{Event, Input, Outputs};
use crossguard_robot::site::Place;

use super::{Finding, World};

/// How far a guard may be from its place, in metres.
pub(super) const TOLERANCE_M: f64 = 2.05;

/// How far an escort may be ahead of its person, in metres, and how far it goes until it stands.
const AHEAD_M: f64 = 2.5;

/// Within which time a vehicle was heard, in microseconds.
const HEARD_US: u64 = 600_000;

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

/// What is seen of a body from one moment to the next.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ObservedBody {
    /// Where its maneuver leads.
    pub(super) target: Option<Place>,
    /// Since when it is off that place while it says that it is in position.
    off_since_us: Option<u64>,
    /// Where it was when a person of its session was too far behind first.
    apart_at: Option<Place>,
}

impl World<'_> {
    fn breaks(&self, (property, statement): Judged, place: usize) -> Finding {
        self.broken(property, statement, place)
    }

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
        if self.walkers.iter().any(|it| it.session_is(session)) {
            self.met.insert(P1.0);
        }
        // Nobody knows of a person who has stepped on the road since the sensors' last chance to show them.
        let seen_us = self.now_us.saturating_sub(self.shows_within_us(place));
        let mut people = self.walkers.iter().filter(|it| it.session_is(session));
        if people.any(|it| it.is_on_road(self.now_us) && it.is_on_road(seen_us)) {
            return Err(self.breaks(P1, place));
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

    /// P3, when the sign of a leader begins to show go.
    pub(super) fn judge_go(&mut self, place: usize) -> Result<(), Finding> {
        let Some(sensing) = &self.swarm.sensing else {
            return Ok(());
        };
        for (number, car) in sensing.cars.iter().enumerate() {
            let heard = self.seats[place].heard_us.get(&number);
            let is_heard = heard.is_some_and(|at_us| self.now_us - at_us <= HEARD_US);
            if !is_heard {
                continue;
            }
            self.met.insert(P3.0);
            let ahead_m = -self.car_east(*car) * car.speed_mps.signum();
            let speed_mps = car.speed_mps.abs();
            let stops_m = speed_mps * 2.0 + speed_mps * speed_mps / (2.0 * 3.0);
            // As of the last CAM it may have been a little farther away.
            if ahead_m > 0.0 && ahead_m + speed_mps * 0.2 < stops_m {
                return Err(self.breaks(P3, place));
            }
        }
        Ok(())
    }

    /// P2 and P4, at any time.
    pub(super) fn judge_bodies(&mut self) -> Result<(), Finding> {
        if self.swarm.sensing.is_none() {
            return Ok(());
        }
        for place in 0..self.seats.len() {
            let Some(machine) = &self.seats[place].machine else {
                self.seats[place].observed.off_since_us = None;
                continue;
            };
            let at = machine.application().body().place();
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
                            return Err(self.breaks(P2, leader));
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
                        return Err(self.breaks(P4, place));
                    }
                }
                _ => self.seats[place].observed.off_since_us = None,
            }
        }
        Ok(())
    }
}
