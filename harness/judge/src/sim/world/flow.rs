//! Streams of people and vehicles: drivers follow each other, yield or do not, and people cross at a sign or by themselves.
//!
//! ```text
//!   people and robots on the road ── in sight, or told by RAM and VAM ──► hazard ── reaction ──► brakes
//!   a robot that shows stop, a person who waits ──► stops before the crossing, if that is comfortable
//!   a leader asks, and the vehicle promises ──► stops where it was asked to
//!   a sign that shows go, or a gap that is long enough ──► a person steps on the road
//! ```

use std::collections::BTreeSet;

use crossguard_codec::{Identifiers, PublicSignal};
use crossguard_endpoint::station::listen::overhear;
use crossguard_protocol::SessionId;
use crossguard_robot::site::Place;
use rand::Rng;

use super::connected::{Connection, Promise};
use super::truth::TOLERANCE_M;
use super::walkers::{COMES_FROM, GOES_TO, WAITS_AT, Walker, walk};
use super::{Finding, Next, World};
use crate::sim::place::{
    CAR_M, CROSSING_EAST, End, LANES, PersonLog, PlaceLog, ROAD_M, Sample, WITHIN_M, along_m,
};
use crate::sim::swarm::{Demand, DriverDraw, PersonDraw};

/// Time from a step of the streams to the next, in microseconds.
const TICK_US: u64 = 100_000;
const TICK_S: f64 = 0.1;

/// Where drivers stop for a crossing, in metres before its middle: before the posts of the guards. Yield lines are 6 to 15 m before
/// a crossing (MUTCD 2009, section 3B.16).
pub(super) const STOP_M: f64 = 7.0;

/// For how long a driver who has seen somebody on the road is ready to brake, and one who has promised to stop stops, in
/// microseconds.
const ALERT_US: u64 = 5_000_000;

/// For how long a driver stands for a person who does not go, in microseconds.
const YIELDS_US: u64 = 6_000_000;

/// For how long a RAM counts, in microseconds.
const RAM_US: u64 = 1_500_000;

/// The Intelligent Driver Model (Treiber, Hennecke and Helbing 2000) with the parameters for cities of Treiber and Kesting,
/// Traffic Flow Dynamics (2013), table 11.2: acceleration and comfortable deceleration in m/s², time gap in s, distance in m.
const IDM_A: f64 = 1.0;
const IDM_B: f64 = 1.5;
const IDM_T: f64 = 1.0;
const IDM_S0: f64 = 2.0;
/// A driver brakes no harder, in m/s²; and stops of courtesy no harder than that.
const BRAKES_MPS2: f64 = 8.0;
const COURTESY_MPS2: f64 = 3.0;

/// When a station that moves sends: EN 302 637-2 and TS 103 300-3 by way and speed; the heading is not looked at.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sent {
    pub(super) at_us: u64,
    pub(super) place: Place,
    pub(super) speed_mps: f64,
}

impl Sent {
    pub(super) fn is_due(&self, now: &Self, longest_us: u64) -> bool {
        self.place.distance(now.place) > 4.0
            || (self.speed_mps - now.speed_mps).abs() > 0.5
            || now.at_us - self.at_us >= longest_us
    }
}

#[derive(Debug)]
pub(super) struct Driver {
    pub(super) number: usize,
    pub(super) draw: DriverDraw,
    /// How far the front bumper is beyond the middle of the crossing, in the direction of travel.
    pub(super) front_m: f64,
    pub(super) speed_mps: f64,
    /// From when to when somebody on the road was in sight.
    saw_us: Option<[u64; 2]>,
    /// For how long it has stood for somebody who waits.
    stood_us: u64,
    /// Of a vehicle that hears robots and tells of itself.
    pub(super) connection: Option<Connection>,
}

impl Driver {
    /// Where its front is, as a CAM says.
    pub(super) fn place(&self) -> Place {
        self.at(self.front_m)
    }

    /// Where its middle is, as a sensor sees it.
    pub(super) fn middle(&self) -> Place {
        self.at(self.front_m - CAR_M / 2.0)
    }

    fn at(&self, along_m: f64) -> Place {
        let lane = usize::from(self.draw.arrival.comes_back);
        let sign = if lane == 0 { 1.0 } else { -1.0 };
        Place::new(CROSSING_EAST + sign * along_m, LANES[lane])
    }

    /// The acceleration with an obstacle so far ahead that moves that fast.
    fn follows(&self, gap_m: f64, speed_mps: f64) -> f64 {
        let (own, wanted) = (self.speed_mps, self.draw.speed_mps);
        let closing = own * (own - speed_mps) / (2.0 * (IDM_A * IDM_B).sqrt());
        let distance = IDM_S0 + (own * IDM_T + closing).max(0.0);
        let free = 1.0 - (own / wanted).powi(4);
        (IDM_A * (free - (distance / gap_m.max(0.1)).powi(2))).max(-BRAKES_MPS2)
    }

    /// The acceleration for a stop at a line ahead.
    fn stops_at(&self, line_m: f64) -> f64 {
        self.follows(line_m + IDM_S0 - self.front_m, 0.0)
    }

    /// Whether it can stop at a line out of courtesy.
    pub(super) fn can_stop(&self, line_m: f64) -> bool {
        let left_m = line_m - self.front_m;
        left_m >= 0.0 && self.speed_mps.powi(2) <= 2.0 * COURTESY_MPS2 * left_m.max(0.3)
    }
}

/// People, robots and signs that drivers look out for.
struct Ahead {
    /// Places of people on the road, the side that they go to, and whether stations tell of them.
    on_road: Vec<(Place, bool, bool)>,
    /// Whether there are people who wait to cross by themselves, and whether stations tell of all of them.
    waiting: Option<bool>,
    robots: Vec<Place>,
    /// Whether a robot shows stop.
    is_stop: bool,
}

/// The streams of a run.
#[derive(Debug, Default)]
pub(super) struct Flow {
    pub(super) drivers: Vec<Driver>,
    drivers_came: BTreeSet<usize>,
    people_came: usize,
    /// When a RAM that shows stop to vehicles was sent last, and one that tells of people.
    stop_us: Option<u64>,
    told_us: Option<u64>,
    vams: Vec<Option<Sent>>,
    pub(super) log: PlaceLog,
}

impl Flow {
    /// How far some vehicles are before the crossing, in metres, and how fast they are, in m/s.
    pub(super) fn vehicles_ahead(
        &self,
        is_one: impl Fn(&usize) -> bool,
    ) -> impl Iterator<Item = [f64; 2]> {
        let drivers = self.drivers.iter();
        let drivers = drivers.filter(move |it| is_one(&it.number));
        drivers.map(|it| [-it.front_m, it.speed_mps])
    }
}

impl World<'_> {
    pub(super) fn begin_flow(&mut self) {
        if let Some(demand) = &self.swarm.demand {
            let people = demand.people.len();
            self.flow.vams = vec![None; people];
            self.flow.log.people = vec![PersonLog::default(); people];
            self.flow.log.delays_s = vec![None; demand.drivers.len()];
            self.flow.log.tracks = vec![Vec::new(); demand.drivers.len()];
            self.at(0, Next::Flows);
        }
    }

    /// Everybody goes on for a tenth of a second.
    pub(super) fn flows(&mut self) -> Result<(), Finding> {
        let Some(demand) = &self.swarm.demand else {
            return Ok(());
        };
        self.at(self.now_us + TICK_US, Next::Flows);
        self.people_come(demand);
        self.people_decide(demand)?;
        self.drivers_come(demand);
        self.drivers_go_on(demand);
        self.vehicles_speak(demand)?;
        self.vehicles_answer(demand);
        self.phones_speak(demand);
        self.note_guards();
        Ok(())
    }

    /// A robot has sent a RAM.
    pub(super) fn is_told(&mut self, packet: &[u8]) {
        if self.swarm.demand.is_none() {
            return;
        }
        *self.flow.log.packets.entry(packet.len()).or_default() += 1;
        let Ok(heard) = overhear(&Identifiers::default(), packet) else {
            return;
        };
        self.vehicle_is_asked(&heard);
        let signals = heard.state.and_then(|state| state.slow?.signals);
        if signals.is_some_and(|it| it.to_vehicles == PublicSignal::Stop) {
            self.flow.stop_us = Some(self.now_us);
        }
        if heard.cluster.is_some() {
            self.flow.told_us = Some(self.now_us);
        }
    }

    fn is_fresh(&self, at_us: Option<u64>) -> bool {
        at_us.is_some_and(|at_us| self.now_us - at_us <= RAM_US)
    }

    fn people_come(&mut self, demand: &Demand) {
        let rest = demand.people[self.flow.people_came..].iter();
        for draw in rest.take_while(|it| it.arrival.at_us <= self.now_us) {
            let number = self.flow.people_came;
            self.flow.people_came += 1;
            let arrival = draw.arrival;
            let at = |north| side(arrival.comes_back, Place::new(draw.east_m, north));
            let from = at((ROAD_M / 2.0 - arrival.away_m).min(WAITS_AT));
            let id = u32::try_from(number).unwrap_or(u32::MAX);
            let ends = [from, at(WAITS_AT)];
            let mut walker = Walker::comes(id, self.now_us, ends, arrival.speed_mps);
            walker.patient_until_us = walker.since_us + draw.patience_us;
            self.flow.log.people[number].since_us = walker.since_us;
            self.walkers.push(walker);
        }
    }

    fn people_decide(&mut self, demand: &Demand) -> Result<(), Finding> {
        let now_us = self.now_us;
        self.walkers.retain(|it| !it.is_gone(now_us));
        for number in 0..self.walkers.len() {
            let walker = &self.walkers[number];
            if !walker.stands(now_us) {
                continue;
            }
            let draw = demand.people[walker.id as usize];
            let goes_alone = self.goes_alone(demand, walker, &draw);
            if walker.patient_until_us <= now_us {
                self.flow.log.people[walker.id as usize].end(now_us, End::GaveUp);
                let away = side(draw.arrival.comes_back, Place::new(draw.east_m, COMES_FROM));
                self.walkers[number].goes_away(now_us, away, draw.arrival.speed_mps);
            } else if let Some(&leader) = self.road.signs_at(0).first() {
                // A third of a second to look and to step off.
                if self.draws.random_bool(0.3)
                    && let Some(session) = self.step_on(leader)?
                {
                    self.goes_across(number, &draw, Some(session));
                }
            } else if goes_alone && self.gap_is_enough(demand, &draw) {
                self.goes_across(number, &draw, None);
            }
        }
        Ok(())
    }

    /// Whether somebody does not wait for a sign.
    fn goes_alone(&self, demand: &Demand, walker: &Walker, draw: &PersonDraw) -> bool {
        #[expect(clippy::cast_precision_loss, reason = "people wait for minutes")]
        let waited_s = (self.now_us - walker.since_us) as f64 / 1e6;
        self.seats.is_empty() || !draw.trusts || waited_s >= demand.habits.hope_s
    }

    /// Whether no vehicle comes within the critical gap: the time across and the time to start (HCM 2010, equation 19-69).
    fn gap_is_enough(&self, demand: &Demand, draw: &PersonDraw) -> bool {
        let across_s = ROAD_M / draw.arrival.speed_mps;
        let critical_s = (across_s + demand.habits.start_up_s) * draw.gap_factor;
        self.flow.drivers.iter().all(|driver| {
            let has_passed = driver.front_m - CAR_M > WITHIN_M;
            let left_m = -WITHIN_M - driver.front_m;
            has_passed || left_m > critical_s * driver.speed_mps.max(0.1)
        })
    }

    fn goes_across(&mut self, number: usize, draw: &PersonDraw, session: Option<SessionId>) {
        let now_us = self.now_us;
        let walker = &mut self.walkers[number];
        let at = |north| side(draw.arrival.comes_back, Place::new(draw.east_m, north));
        let mut way = vec![(now_us, walker.place(now_us))];
        walk(&mut way, at(ROAD_M + 0.1), draw.arrival.speed_mps);
        walk(&mut way, at(GOES_TO), draw.arrival.speed_mps);
        walker.sets_out(way, session);
        let log = &mut self.flow.log.people[walker.id as usize];
        let is_guided = session.is_some();
        log.end(now_us, if is_guided { End::AtSign } else { End::ByGap });
        log.way.clone_from(&walker.way);
        if let Some(session) = session {
            self.is_on_road(number, session);
        }
    }

    fn drivers_come(&mut self, demand: &Demand) {
        let due = demand.drivers.iter().enumerate();
        let due = due.take_while(|(_, it)| it.arrival.at_us <= self.now_us);
        let mut is_full = [false; 2];
        for (number, draw) in due {
            let lane = usize::from(draw.arrival.comes_back);
            if is_full[lane] || self.flow.drivers_came.contains(&number) {
                continue;
            }
            let ahead = self.flow.drivers.iter().rev();
            let last = ahead
                .clone()
                .find(|it| it.draw.arrival.comes_back == draw.arrival.comes_back);
            let gap_m = last.map_or(f64::INFINITY, |it| it.front_m - CAR_M + draw.arrival.away_m);
            is_full[lane] = gap_m < IDM_S0;
            if is_full[lane] {
                continue;
            }
            let slower = last.filter(|_| gap_m < 3.0 * draw.speed_mps);
            let speed_mps = slower.map_or(draw.speed_mps, |it| it.speed_mps.min(draw.speed_mps));
            self.flow.drivers_came.insert(number);
            self.flow.drivers.push(Driver {
                number,
                draw: *draw,
                front_m: -draw.arrival.away_m,
                speed_mps,
                saw_us: None,
                stood_us: 0,
                connection: draw.is_connected.then(|| Connection::of(number)),
            });
        }
    }

    /// People, robots and signs that drivers look out for now.
    fn ahead(&self, demand: &Demand) -> Ahead {
        let is_told = self.is_fresh(self.flow.told_us);
        let is_known = |it: &Walker| is_told || demand.people[it.id as usize].has_phone;
        let on_road = self.walkers.iter().filter(|it| it.is_on_road(self.now_us));
        let on_road = on_road.map(|it| {
            let comes_back = demand.people[it.id as usize].arrival.comes_back;
            (it.place(self.now_us), comes_back, is_known(it))
        });
        let waiting = self.walkers.iter().filter(|it| {
            let draw = &demand.people[it.id as usize];
            it.stands(self.now_us) && self.goes_alone(demand, it, draw)
        });
        let robots = self.seats.iter().filter_map(|seat| seat.machine.as_ref());
        Ahead {
            on_road: on_road.collect(),
            waiting: waiting.map(is_known).reduce(|all, it| all && it),
            robots: robots.map(|it| it.application.body().place()).collect(),
            is_stop: self.is_fresh(self.flow.stop_us),
        }
    }

    fn drivers_go_on(&mut self, demand: &Demand) {
        let ahead = self.ahead(demand);
        let now_us = self.now_us;
        let Flow { drivers, log, .. } = &mut self.flow;
        let mut leaders: [Option<(f64, f64)>; 2] = [None; 2];
        for driver in drivers.iter_mut() {
            let leader = &mut leaders[usize::from(driver.draw.arrival.comes_back)];
            let mut acceleration = driver.accelerates(demand, &ahead, now_us);
            if let Some((rear_m, speed_mps)) = *leader {
                acceleration = acceleration.min(driver.follows(rear_m - driver.front_m, speed_mps));
            }
            let speed_mps = (driver.speed_mps + acceleration * TICK_S).max(0.0);
            driver.front_m += f64::midpoint(driver.speed_mps, speed_mps) * TICK_S;
            driver.speed_mps = speed_mps;
            *leader = Some((driver.front_m - CAR_M, speed_mps));
            if driver.front_m.abs() < 60.0 {
                log.tracks[driver.number].push(Sample {
                    at_us: now_us + TICK_US,
                    front_m: driver.front_m,
                    speed_mps,
                    comes_back: driver.draw.arrival.comes_back,
                });
            }
            log.meets_robots(
                driver.number,
                driver.place(),
                driver.front_m,
                speed_mps,
                &ahead.robots,
            );
        }
        drivers.retain(|driver| {
            let goes_on = driver.front_m < driver.draw.arrival.away_m;
            if !goes_on {
                #[expect(clippy::cast_precision_loss, reason = "drives take minutes")]
                let took_s = (now_us + TICK_US - driver.draw.arrival.at_us) as f64 / 1e6;
                let free_s = (driver.front_m + driver.draw.arrival.away_m) / driver.draw.speed_mps;
                log.delays_s[driver.number] = Some(took_s - free_s);
            }
            goes_on
        });
    }

    /// Phones send VAM, unless a robot tells of the people around it.
    fn phones_speak(&mut self, demand: &Demand) {
        let is_told = self.is_fresh(self.flow.told_us);
        for walker in &self.walkers {
            let draw = &demand.people[walker.id as usize];
            let is_walking = !walker.waits || walker.since_us > self.now_us;
            let now = Sent {
                at_us: self.now_us,
                place: walker.place(self.now_us),
                speed_mps: f64::from(u8::from(is_walking)) * draw.arrival.speed_mps,
            };
            let sent = &mut self.flow.vams[walker.id as usize];
            if draw.has_phone && sent.is_none_or(|it| it.is_due(&now, 5_000_000)) {
                *sent = Some(now);
                self.flow.log.vams[usize::from(is_told)] += 1;
            }
        }
    }

    /// Whether somebody on the road has a guard in place.
    fn note_guards(&mut self) {
        let guards = (0..self.seats.len()).filter_map(|place| {
            let at = self.seats[place]
                .machine
                .as_ref()?
                .application
                .body()
                .place();
            let target = self.seats[place].observed.target?;
            let maneuver = self.monitor.guards(place)?;
            (target.distance(at) <= TOLERANCE_M || at.north > 0.0 && at.north < ROAD_M)
                .then_some(maneuver.id.session)
        });
        let guards: Vec<_> = guards.collect();
        for walker in self.walkers.iter().filter(|it| it.is_on_road(self.now_us)) {
            if walker.session.is_none_or(|it| !guards.contains(&it)) {
                self.flow.log.people[walker.id as usize].alone_us += TICK_US;
            }
        }
    }
}

/// A place as people see it who come from the south, or from the other side.
fn side(comes_back: bool, place: Place) -> Place {
    let north = if comes_back {
        ROAD_M - place.north
    } else {
        place.north
    };
    Place::new(place.east, north)
}

impl Driver {
    /// The acceleration that everything but the vehicle ahead asks for.
    fn accelerates(&mut self, demand: &Demand, ahead: &Ahead, now_us: u64) -> f64 {
        let habits = &demand.habits;
        let is_back = self.draw.arrival.comes_back;
        let lane = LANES[usize::from(is_back)];
        let sees = |at_m: f64, is_told: bool| {
            let is_heard = self.draw.is_connected && is_told;
            at_m - self.front_m
                < if is_heard {
                    habits.radio_m
                } else {
                    habits.sight_m
                }
        };
        let mut hazards = Vec::new();
        for (place, comes_back, is_told) in &ahead.on_road {
            // People count until they are past the lane.
            let left_m = if *comes_back {
                place.north - lane
            } else {
                lane - place.north
            };
            let at_m = along_m(is_back, place.east);
            if left_m > -1.5 && at_m > self.front_m && sees(at_m, *is_told) {
                let line_m = if self.front_m < -STOP_M {
                    -STOP_M
                } else {
                    at_m - 1.5
                };
                hazards.push(line_m);
            }
        }
        for place in &ahead.robots {
            let at_m = along_m(is_back, place.east) - 1.0;
            // Its RAM says where it is.
            if (place.north - lane).abs() < 2.05 && at_m > self.front_m && sees(at_m, true) {
                hazards.push(at_m - 1.0);
            }
        }
        let mut acceleration = self.follows(f64::INFINITY, 0.0);
        self.saw_us = self
            .saw_us
            .filter(|[_, last_us]| now_us - last_us < ALERT_US);
        if let Some(nearest) = hazards.into_iter().reduce(f64::min) {
            let [since_us, last_us] = self.saw_us.get_or_insert([now_us; 2]);
            *last_us = now_us;
            if now_us - *since_us >= self.draw.reaction_us {
                acceleration = acceleration.min(self.stops_at(nearest));
            }
        }
        let stops_for_robot = self.draw.heeds && ahead.is_stop && sees(-STOP_M, true);
        let promise = self.connection.as_ref().and_then(|it| it.promise);
        let is_held = |it: &Promise| now_us - it.at_us < ALERT_US && self.front_m <= it.line_m;
        if let Some(promise) = promise.filter(is_held) {
            acceleration = acceleration.min(self.stops_at(promise.line_m));
        }
        let may_yield = self.draw.yields && self.stood_us < YIELDS_US;
        let yields = may_yield && ahead.waiting.is_some_and(|is_told| sees(-STOP_M, is_told));
        if (stops_for_robot || yields) && self.can_stop(-STOP_M) {
            acceleration = acceleration.min(self.stops_at(-STOP_M));
            // A driver who stops for people or robots sees them step on the road.
            self.saw_us = Some([self.saw_us.map_or(now_us, |[since_us, _]| since_us), now_us]);
        }
        if yields && self.speed_mps < 0.5 {
            self.stood_us += TICK_US;
        }
        acceleration
    }
}
