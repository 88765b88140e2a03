//! A connected vehicle of a demonstration: it comes along its lane, tells where it is by CAM, and answers a leader that asks it to
//! stop. One that has stopped drives on when nobody leads any more.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use crossguard_codec::geonet::{EgoPosition, Stack};
use crossguard_codec::{DriveDirection, Heard, Identifiers, Measurement, RobotState, Service};
use crossguard_endpoint::ras::cam::{CamGeneration, cam};
use crossguard_endpoint::station::vehicle::{Question, passenger_car};
use crossguard_protocol::{Coordination, Input, StationId};
use crossguard_robot::plan_file::{Car, CarAnswer};
use crossguard_robot::runtime::Clock;
use crossguard_robot::site::{Place, Site};
use crossguard_robot::site_file::SiteFile;
use crossguard_robot::transport::{Arrival, Halves};

/// Time between two steps of its motion, in ms.
const TICK_MS: u64 = 20;

/// How hard it brakes, and how hard it speeds up, in m/s².
const BRAKES_MPS2: f64 = 3.0;
const SPEEDS_UP_MPS2: f64 = 2.0;

/// How far behind the crossing it is out of sight, in metres.
const AWAY_M: f64 = 40.0;

/// For how long a leader counts that is not heard any more, in ms.
const LEADER_MS: u64 = 2_000;

/// A vehicle that drives, until it is dropped.
pub(super) struct Driving {
    stop: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Driving {
    pub(super) fn start(car: Car, street: SiteFile, link: Halves, clock: Clock) -> Self {
        let stop = Arc::new(AtomicBool::new(false));
        let is_stopped = Arc::clone(&stop);
        let thread = thread::spawn(move || {
            if let Some(mut drive) = Drive::new(car, &street, link, clock) {
                while !is_stopped.load(Ordering::Relaxed) {
                    drive.tick();
                }
            }
        });
        Self {
            stop,
            thread: Some(thread),
        }
    }
}

impl Drop for Driving {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

struct Drive {
    car: Car,
    site: Site,
    /// The middle of its lane, where the crossing is, and its end.
    lane: [Place; 2],
    link: Halves,
    clock: Clock,
    identifiers: Identifiers,
    stack: Stack,
    cams: CamGeneration,
    at_ms: u64,
    /// How far the front is beyond the middle of the lane, in metres.
    front_m: f64,
    speed_mps: f64,
    /// Where it stops, in metres likewise.
    line_m: Option<f64>,
    /// When a leader was heard last.
    leader_ms: u64,
}

impl Drive {
    fn new(car: Car, street: &SiteFile, link: Halves, clock: Clock) -> Option<Self> {
        let lane = street.lanes.iter().find(|lane| lane.name == car.lane)?;
        let half_m = lane.from.distance(lane.to) / 2.0;
        let identifiers = passenger_car();
        Some(Self {
            site: street.site,
            lane: [lane.from.towards(lane.to, half_m), lane.to],
            link,
            clock,
            stack: Stack::of_robot(identifiers, StationId(car.station)),
            identifiers,
            cams: CamGeneration::default(),
            at_ms: clock.now_us() / 1_000,
            front_m: -car.from_m,
            speed_mps: car.speed_mps,
            line_m: None,
            leader_ms: 0,
            car,
        })
    }

    fn state(&self) -> RobotState {
        let exactly = |value| {
            Some(Measurement {
                value,
                confidence: Some(0.1),
            })
        };
        let [middle, ahead] = self.lane;
        RobotState {
            position: self.site.position(middle.towards(ahead, self.front_m)),
            heading: exactly(middle.bearing(ahead)),
            speed: exactly(self.speed_mps),
            drive_direction: DriveDirection::Forward,
            ..RobotState::default()
        }
    }

    fn tick(&mut self) {
        let now_ms = self.clock.now_us() / 1_000;
        self.drive(Duration::from_millis(now_ms - self.at_ms).as_secs_f64());
        self.at_ms = now_ms;
        let state = self.state();
        let now_its = self.clock.moment().timestamp_its;
        if let Some((_, low_frequency)) = self.cams.poll(now_ms, 0, &state)
            && let Ok(cam) = cam(
                &self.identifiers,
                self.car.station,
                &state,
                now_its,
                low_frequency,
            )
        {
            self.send(Service::Cam, &cam, &state, now_its);
        }
        let arrival = self.link.receiver.receive(Duration::from_millis(TICK_MS));
        if let Ok(Some(Arrival::Datagram { octets, .. })) = arrival {
            self.hear(&octets, &state, now_its);
        }
    }

    fn drive(&mut self, seconds: f64) {
        if self.leader_ms + LEADER_MS < self.at_ms {
            self.line_m = None;
        }
        let faster = self.speed_mps + SPEEDS_UP_MPS2 * seconds;
        // As fast as it can stop from.
        let limit = self.line_m.map_or(f64::MAX, |line_m| {
            (2.0 * BRAKES_MPS2 * (line_m - self.front_m).max(0.0)).sqrt()
        });
        self.speed_mps = faster.min(self.car.speed_mps).min(limit);
        self.front_m += self.speed_mps * seconds;
        if self.front_m > AWAY_M {
            self.front_m = -self.car.from_m;
        }
    }

    fn send(&mut self, service: Service, message: &[u8], state: &RobotState, now_its: u64) {
        let ego = EgoPosition::of(state, now_its);
        if let Ok(packet) = self.stack.packet(&ego, service, message) {
            // A message that is lost is told again.
            let _ = self.link.sender.send(&packet);
        }
    }

    fn hear(&mut self, packet: &[u8], state: &RobotState, now_its: u64) {
        let (me, ego) = (StationId(self.car.station), EgoPosition::of(state, now_its));
        let Ok(indication) = self.stack.receive(&ego, packet) else {
            return;
        };
        let heard = Heard::of(&self.identifiers, me, &state.position, indication.message);
        let Ok(heard) = heard else { return };
        let leads = |input: &Input| matches!(input, Input::Ram { ram, .. } if matches!(ram.coordination, Coordination::Leader { .. }));
        if heard.inputs.iter().any(leads) {
            self.leader_ms = self.at_ms;
        }
        let Some(question) = Question::of(&heard, me) else {
            return;
        };
        let line_m = self.site.place_of(question.line).map(|line| {
            let [middle, ahead] = self.lane;
            middle.distance(ahead) - line.distance(ahead)
        });
        let promises = match self.car.answers {
            CarAnswer::Silent => return,
            CarAnswer::Refuses => false,
            CarAnswer::Stops | CarAnswer::Lies => true,
        };
        if self.car.answers == CarAnswer::Stops {
            self.line_m = line_m;
        }
        if let Ok(answer) = question.answer(&self.identifiers, &state.position, promises, now_its) {
            self.send(Service::Rmcm, &answer, state, now_its);
        }
    }
}
