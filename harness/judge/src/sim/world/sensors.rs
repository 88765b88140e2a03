//! Perception of people and vehicles by robots: frames of sensors, and CAM.

use std::collections::BTreeMap;

use crossguard_endpoint::Stimulus;
use crossguard_endpoint::ras::area::Area;
use crossguard_endpoint::ras::clustering::{PerceivedVru, VruClass};
use crossguard_protocol::Millis;
use crossguard_robot::perception::{Perceived, SensorFrame, seen_from};
use crossguard_robot::site::Place;
use crossguard_robot::street::{Road, Street};
use crossguard_robot::zone::Zone;
use rand::Rng;
use rand::seq::SliceRandom;

use super::{Finding, Next, World};
use crate::sim::swarm::{CarDraw, Ids, Sensing, SourceDraw, Swarm};

/// How far from the crossing vehicles come and go, in metres.
const CAR_FROM_M: f64 = 220.0;

/// How far sensors see vehicles, in metres.
const SENSES_M: f64 = 40.0;

/// Time from a CAM to the next, in microseconds.
const CAM_PERIOD_US: u64 = 200_000;

/// A sensor of a robot.
#[derive(Debug)]
pub(super) struct SimulatedSensor<'a> {
    robot: usize,
    /// Its number at its robot.
    number: u8,
    draw: &'a SourceDraw,
    /// In how many frames in a row it has missed each person.
    missed: BTreeMap<u32, u8>,
    frames: u32,
}

/// A frame on its way to a robot; `None` for something that is none.
#[derive(Debug)]
pub(super) struct FrameInFlight {
    taken_us: u64,
    frame: Option<SensorFrame>,
}

/// The sensors of all robots.
pub(super) fn of(swarm: &Swarm) -> Vec<SimulatedSensor<'_>> {
    let robots = swarm.sensing.iter().flat_map(|it| it.sources.iter());
    let sensors = robots.enumerate().flat_map(|(robot, sources)| {
        (0..)
            .zip(sources)
            .map(move |(number, draw)| SimulatedSensor {
                robot,
                number,
                draw,
                missed: BTreeMap::new(),
                frames: 0,
            })
    });
    sensors.collect()
}

/// The road that robots watch.
pub(super) fn road(sensing: &Sensing, calls: bool) -> Road {
    let street = Street::default().zone();
    let mut zone = Zone {
        waiting: street.waiting.filter(|_| calls),
        ..Zone::of_road(street.road.unwrap_or(Area::Polygon(Vec::new())))
    };
    zone.sensors.miss_max = sensing.miss_max;
    (sensing.weakening)(&mut zone);
    Road::Watched(zone)
}

impl World<'_> {
    /// A sensor looks.
    pub(super) fn sense(&mut self, sensor: usize) {
        let now_us = self.now_us;
        let (robot, draw) = (self.sensors[sensor].robot, self.sensors[sensor].draw);
        let repaired = self.is_healed.then(|| draw.repaired());
        let draw = repaired.as_ref().unwrap_or(draw);
        self.at(
            now_us + u64::from(draw.period_ms) * 1_000,
            Next::Senses(sensor),
        );
        let is_silent = draw
            .silent
            .is_some_and(|[from, to]| now_us >= from && now_us < to);
        if is_silent || self.seats[robot].machine.is_none() {
            return;
        }
        let is_garbled = self.draws.random_bool(draw.garbled);
        let frame = (!is_garbled).then(|| self.frame(sensor, draw));
        let latency_us = self
            .draws
            .random_range(0..=u64::from(draw.latency_ms) * 1_000);
        self.frames.push(FrameInFlight {
            taken_us: now_us,
            frame,
        });
        let frame = self.frames.len() - 1;
        self.at(now_us + latency_us, Next::Sees(robot, frame));
    }

    /// Frame of a sensor, of the people now.
    fn frame(&mut self, sensor: usize, draw: &SourceDraw) -> SensorFrame {
        let now_us = self.now_us;
        let miss_max = self.swarm.sensing.as_ref().map_or(0, |it| it.miss_max);
        let SimulatedSensor { missed, frames, .. } = &mut self.sensors[sensor];
        *frames += 1;
        let [west, east] = draw.covers.unwrap_or([-40.0, 40.0]);
        let mut people = Vec::new();
        for walker in &self.walkers {
            let at = walker.place(now_us);
            if at.east < west || at.east > east {
                missed.remove(&walker.id);
                continue;
            }
            let missed = missed.entry(walker.id).or_default();
            if *missed + 1 < miss_max && self.draws.random_bool(draw.misses) {
                *missed += 1;
                continue;
            }
            *missed = 0;
            let mut off = || match draw.error_m {
                error_m if error_m > 0.0 => self.draws.random_range(-error_m..error_m),
                _ => 0.0,
            };
            let id = match draw.ids {
                Ids::Renewed(every) => walker.id + 100 * (*frames / every),
                _ => walker.id,
            };
            people.push(Perceived {
                vru: PerceivedVru {
                    id,
                    position_m: [at.east + off(), at.north + off()],
                    velocity_mps: [0.0; 2],
                    class: VruClass::Pedestrian,
                    confidence: 0.9,
                },
                has_id: draw.ids != Ids::None,
                has_velocity: false,
                error_m: draw.error_m * 1.42,
            });
        }
        // Of vehicles it has the velocity.
        for (id, at, east_mps) in self.vehicles_near(SENSES_M) {
            let vehicle = PerceivedVru {
                id,
                position_m: [at.east, at.north],
                velocity_mps: [east_mps, 0.0],
                class: VruClass::Vehicle,
                confidence: 0.9,
            };
            people.push(Perceived {
                vru: vehicle,
                has_id: true,
                has_velocity: true,
                error_m: 0.5,
            });
        }
        people.shuffle(&mut self.draws);
        if draw.ids == Ids::Shuffled {
            for (id, person) in (1..).zip(&mut people) {
                person.vru.id = id;
            }
        }
        let corners = [[west, -40.0], [east, -40.0], [east, 40.0], [west, 40.0]];
        SensorFrame {
            source: self.sensors[sensor].number,
            covers: draw.covers.map(|_| Area::Polygon(corners.to_vec())),
            people,
        }
    }

    /// A frame arrives at its robot; it waits if the robot hangs.
    pub(super) fn see_frame(&mut self, place: usize, number: usize) -> Result<(), Finding> {
        let seat = &mut self.seats[place];
        if seat.hangs_until_us.is_some() {
            seat.inbox.push(Next::Sees(place, number));
            return Ok(());
        }
        let Some(machine) = &mut seat.machine else {
            return Ok(());
        };
        let FrameInFlight { taken_us, frame } = &self.frames[number];
        let shown_ms = |at_us: u64| seat.clock.shows_us(at_us) / 1_000;
        let (taken_ms, now_ms) = (shown_ms(*taken_us), shown_ms(self.now_us));
        let own = machine.application.body().place();
        let application = &mut machine.application;
        let Some(frame) = frame else {
            application.look_in_vain("a frame");
            return self.handle(place, Stimulus::Time);
        };
        let age = u32::try_from(now_ms - taken_ms).unwrap_or(u32::MAX);
        application.look(frame, Millis(age));
        let people = seat.newest.look(frame, taken_ms).into_iter();
        let seen: Vec<_> = people.map(|vru| seen_from(own, vru)).collect();
        self.handle(place, Stimulus::Perceived(&seen))
    }

    /// Where a vehicle is, in metres to the east of the crossing.
    pub(super) fn car_east(&self, car: CarDraw) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "runs take minutes")]
        let seconds = self.now_us.saturating_sub(car.at_us) as f64 / 1e6;
        car.speed_mps * seconds - CAR_FROM_M * car.speed_mps.signum()
    }

    /// A vehicle drives, and says so.
    pub(super) fn drive(&mut self, number: usize) -> Result<(), Finding> {
        let Some(car) = self.swarm.sensing.as_ref().map(|it| it.cars[number]) else {
            return Ok(());
        };
        let east = self.car_east(car);
        if east * car.speed_mps.signum() > CAR_FROM_M {
            return Ok(());
        }
        for place in 0..self.seats.len() {
            let seat = &mut self.seats[place];
            if seat.hangs_until_us.is_some() || !self.draws.random_bool(0.9) {
                continue;
            }
            let (at, is_westward) = (Place::new(east, 1.75), car.speed_mps <= 0.0);
            self.hear_vehicle(place, number, at, car.speed_mps.abs(), is_westward)?;
        }
        self.at(self.now_us + CAM_PERIOD_US, Next::Drives(number));
        Ok(())
    }
}
