//! Connected vehicles of the streams: they tell where they are by CAM, and answer a leader that asks them to stop.

use std::rc::Rc;

use crossguard_codec::geonet::{EgoPosition, Stack};
use crossguard_codec::{Heard, Identity, Kind, RoadUser, RobotState, Service};
use crossguard_endpoint::station::LocalDynamicMap;
use crossguard_endpoint::station::vehicle::{Question, passenger_car};
use crossguard_endpoint::{Moment, Stimulus};
use crossguard_protocol::StationId;
use crossguard_robot::site::Place;
use rand::Rng;

use super::flow::{STOP_M, Sent};
use super::{Finding, World, timestamp_at};
use crate::sim::place::along_m;
use crate::sim::swarm::Demand;

/// The station id of the first vehicle.
const CARS: u32 = 9_000;

/// How long an answer is under way, in microseconds.
const WAY_US: u64 = 3_000;

/// The station id of a vehicle.
fn station(number: usize) -> StationId {
    StationId(CARS + u32::try_from(number).unwrap_or(0))
}

/// A vehicle's word that it will stop.
#[derive(Clone, Copy, Debug)]
pub(super) struct Promise {
    pub(super) at_us: u64,
    /// Where it stops, in metres beyond the middle of the crossing.
    pub(super) line_m: f64,
}

/// The station of a vehicle, and the state of its messages.
#[derive(Debug)]
pub(super) struct Connection {
    stack: Stack,
    sent: Option<Sent>,
    /// The newest question of a leader that it has not answered.
    asked: Option<Question>,
    pub(super) promise: Option<Promise>,
}

impl Connection {
    pub(super) fn of(number: usize) -> Self {
        Self {
            stack: Stack::of_robot(passenger_car(), station(number)),
            sent: None,
            asked: None,
            promise: None,
        }
    }
}

impl World<'_> {
    /// Vehicles that are connected send CAM, which robots hear.
    pub(super) fn vehicles_speak(&mut self, demand: &Demand) -> Result<(), Finding> {
        for at in 0..self.flow.drivers.len() {
            let driver = &mut self.flow.drivers[at];
            let now = Sent {
                at_us: self.now_us,
                place: driver.place(),
                speed_mps: driver.speed_mps,
            };
            let Some(connection) = &mut driver.connection else {
                continue;
            };
            if connection
                .sent
                .is_some_and(|it| !it.is_due(&now, 1_000_000))
            {
                continue;
            }
            connection.sent = Some(now);
            self.flow.log.cams += 1;
            let (number, is_back) = (driver.number, driver.draw.arrival.comes_back);
            if driver.front_m.abs() < demand.habits.radio_m {
                for place in 0..self.seats.len() {
                    if self.draws.random_bool(1.0 - demand.habits.loss) {
                        self.hear_vehicle(place, number, now.place, now.speed_mps, is_back)?;
                    }
                }
            }
        }
        Ok(())
    }

    /// A robot has a CAM of a vehicle.
    pub(super) fn hear_vehicle(
        &mut self,
        place: usize,
        number: usize,
        at: Place,
        speed_mps: f64,
        is_westward: bool,
    ) -> Result<(), Finding> {
        let seat = &mut self.seats[place];
        let moment = Moment {
            now_ms: seat.clock.shows_us(self.now_us) / 1_000,
            timestamp_its: timestamp_at(self.now_us / 1_000),
        };
        let Some(machine) = &mut seat.machine else {
            return Ok(());
        };
        let user = RoadUser {
            identity: Identity::Station(station(number).0),
            kind: Kind::Vehicle,
            station_type: None,
            position: seat.draw.plan.site.position(at),
            speed: Some(speed_mps),
            heading: Some(if is_westward { 270.0 } else { 90.0 }),
            length: None,
            cardinality: 1,
            signals: None,
            measured_its: moment.timestamp_its,
        };
        let mut map = LocalDynamicMap::default();
        map.observe(user, moment.now_ms);
        let robot = machine.endpoint.robot().clone();
        machine.application.listen(&map, &robot, moment);
        seat.heard_us.insert(number, self.now_us);
        self.handle(place, Stimulus::Time)
    }

    /// A leader's question reaches the vehicle that it names.
    pub(super) fn vehicle_is_asked(&mut self, heard: &Heard) {
        let Some(demand) = &self.swarm.demand else {
            return;
        };
        for driver in &mut self.flow.drivers {
            let Some(connection) = &mut driver.connection else {
                continue;
            };
            let is_near = driver.front_m.abs() < demand.habits.radio_m;
            if let Some(question) = Question::of(heard, station(driver.number))
                && is_near
                && self.draws.random_bool(1.0 - demand.habits.loss)
            {
                connection.asked = Some(question);
            }
        }
    }

    /// Vehicles that were asked say whether they will stop: a driver who stops for robots does, where that is comfortable.
    pub(super) fn vehicles_answer(&mut self, demand: &Demand) {
        let Some(site) = self.seats.first().map(|seat| seat.draw.plan.site) else {
            return;
        };
        let now_its = timestamp_at(self.now_us / 1_000);
        for at in 0..self.flow.drivers.len() {
            let driver = &mut self.flow.drivers[at];
            let asked = driver.connection.as_mut().and_then(|it| it.asked.take());
            let Some(question) = asked else { continue };
            let line = site.place_of(question.line);
            let is_back = driver.draw.arrival.comes_back;
            let line_m = line.map_or(-STOP_M, |line| along_m(is_back, line.east));
            let promises = driver.draw.heeds && driver.can_stop(line_m);
            let position = site.position(driver.place());
            let state = RobotState {
                position,
                ..RobotState::default()
            };
            let Some(connection) = &mut driver.connection else {
                continue;
            };
            connection.promise = promises.then_some(Promise {
                at_us: self.now_us,
                line_m,
            });
            let answer = question.answer(&passenger_car(), &position, promises, now_its);
            let ego = EgoPosition::of(&state, now_its);
            let packet = answer.ok().and_then(|answer| {
                let packet = connection.stack.packet(&ego, Service::Rmcm, &answer);
                packet.ok().map(Rc::from)
            });
            let Some(packet) = packet else { continue };
            self.is_on_air(&packet);
            *self.flow.log.packets.entry(packet.len()).or_default() += 1;
            for to in 0..self.seats.len() {
                if self.draws.random_bool(1.0 - demand.habits.loss) {
                    self.arrives_at(self.now_us + WAY_US, to, to, &packet);
                }
            }
        }
    }

    /// The vehicles near the crossing: where each is, and its velocity to the east, in m/s.
    pub(super) fn vehicles_near(&self, within_m: f64) -> impl Iterator<Item = (u32, Place, f64)> {
        let drivers = self.flow.drivers.iter();
        let near = drivers.filter(move |it| it.front_m.abs() < within_m);
        near.map(|it| {
            let is_back = it.draw.arrival.comes_back;
            let east_mps = if is_back { -it.speed_mps } else { it.speed_mps };
            (station(it.number).0, it.middle(), east_mps)
        })
    }
}
