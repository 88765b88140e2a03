//! What an endpoint holds on to over an hour of virtual time in a busy street: a crossing every minute,
//! and three hundred vehicles that come and go.
//!
//! `cargo bench -p crossguard-robot --bench memory`

#![allow(
    clippy::large_stack_arrays,
    reason = "a pair of machines, in a benchmark"
)]

use std::hint::black_box;

use crossguard_codec::geonet::{EgoPosition, Stack};
use crossguard_codec::{Identifiers, Service, golden};
use crossguard_endpoint::{Effect, Endpoint, Moment, Stimulus};
use crossguard_protocol::{Config, Event, Robot, StationId};
use crossguard_robot::application::Application;
use crossguard_robot::body::{Build, Simulated};
use crossguard_robot::machine::Machine;
use crossguard_robot::plan::Plan;
use crossguard_robot::site::{Place, Site};

/// How many vehicles are heard at a time, and how many different ones in an hour.
const VEHICLES: u32 = 300;
const VEHICLES_IN_ALL: u32 = 18_000;

const TICK_MS: u64 = 10;
const MINUTE_MS: u64 = 60_000;

fn machine(station: u32, plan: Option<Plan>) -> Machine {
    let robot = Robot::new(StationId(station), 1);
    let endpoint = Endpoint::new(robot, Config::default(), Identifiers::default(), 0);
    let place = Place::new(f64::from(station), 0.0);
    let body = Simulated::new(Build::Quadruped, Site::default(), place, 3.0, 1);
    Machine::new(endpoint, Application::new(Box::new(body), plan))
}

/// A CAM, to be given a station id of its own.
fn cam() -> Vec<u8> {
    hex::decode(golden::vector(golden::ITS, "C2")).expect("hexadecimal digits")
}

fn packet_of(vehicle: u32, cam: &mut [u8]) -> Vec<u8> {
    let station = 10_000 + vehicle;
    cam[2..6].copy_from_slice(&station.to_be_bytes());
    Stack::of_robot(Identifiers::default(), StationId(station))
        .packet(&EgoPosition::default(), Service::Cam, cam)
        .expect("it fits")
}

struct Street {
    robots: [Machine; 2],
    cam: Vec<u8>,
    now_ms: u64,
    handled: u64,
}

impl Street {
    fn turn(&mut self, robot: usize, stimulus: Stimulus<'_>) -> Vec<Vec<u8>> {
        let moment = Moment::after(694_694_401_000, self.now_ms);
        #[expect(clippy::cast_precision_loss, reason = "an hour of milliseconds fits")]
        let now_s = self.now_ms as f64 / 1e3;
        self.handled += 1;
        let effects = self.robots[robot].handle(moment, now_s, stimulus);
        let packets = effects.into_iter().filter_map(|effect| match effect {
            Effect::Transmit { packet, .. } => Some(packet),
            _ => None,
        });
        packets.collect()
    }

    fn receive(&mut self, robot: usize, packet: &[u8]) -> Vec<Vec<u8>> {
        let arrived_ms = self.now_ms;
        self.turn(robot, Stimulus::Datagram { packet, arrived_ms })
    }

    fn minute(&mut self) {
        let detected = Event::PedestrianDetected(Plan::crossing(Site::default()).request());
        let mut on_air = vec![(1, self.turn(0, Stimulus::Event(detected)))];
        let end_ms = self.now_ms + MINUTE_MS;
        while self.now_ms < end_ms {
            self.now_ms += TICK_MS;
            for robot in 0..2 {
                let sent = self.turn(robot, Stimulus::Time);
                on_air.push((1 - robot, sent));
            }
            while let Some((to, packets)) = on_air.pop() {
                for packet in packets {
                    let answers = self.receive(to, &packet);
                    on_air.push((1 - to, answers));
                }
            }
            // Each vehicle is heard once a second, and after a minute another one comes in its place.
            for number in 0..VEHICLES / 100 {
                let tick = u32::try_from(self.now_ms / TICK_MS).unwrap_or(0);
                let place = (tick * 3 + number) % VEHICLES;
                let minute = u32::try_from(self.now_ms / MINUTE_MS).unwrap_or(0);
                let vehicle = (place + minute * VEHICLES) % VEHICLES_IN_ALL;
                let packet = packet_of(vehicle, &mut self.cam);
                let _ = self.receive(0, &packet);
            }
        }
    }
}

fn main() {
    println!(
        "| after [min] | held by both endpoints [KiB] | most at a time in these minutes [KiB] | known road users |"
    );
    println!("|--:|--:|--:|--:|");
    let mut street = None;
    let mut held: i64 = 0;
    for minutes in [1, 9, 10, 10, 10, 10, 10] {
        let before = held;
        let info = allocation_counter::measure(|| {
            let street = street.get_or_insert_with(|| Street {
                robots: [
                    machine(1, Some(Plan::crossing(Site::default()))),
                    machine(2, None),
                ],
                cam: cam(),
                now_ms: 0,
                handled: 0,
            });
            for _ in 0..minutes {
                street.minute();
            }
        });
        held += info.bytes_current;
        let street = street.as_ref().expect("it runs");
        let kib = |bytes: i64| bytes / 1_024;
        let most = before + i64::try_from(info.bytes_max).unwrap_or(i64::MAX);
        println!(
            "| {} | {} | {} | {} |",
            street.now_ms / MINUTE_MS,
            kib(held),
            kib(most),
            street.robots[0].endpoint().map().iter().count()
        );
    }
    let street = black_box(street).expect("it ran");
    println!("\n{} inputs were handled.", street.handled);
}
