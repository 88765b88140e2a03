//! The shipped street with real robots, and a person whose place is the ground truth.
//!
//! ```text
//!   ground truth ──► frames, with the time at which they were made ──► robots ──► signs, bodies, sessions
//!        ▲                                                                │
//!        └──────────── the test judges what they do by it ◄───────────────┘
//! ```

use std::collections::VecDeque;
use std::path::Path;
use std::sync::{Arc, Mutex};

use crossguard_codec::{Identifiers, Identity, Kind, Position, RoadUser, RobotState};
use crossguard_endpoint::ras::area::Area;
use crossguard_endpoint::ras::clustering::PerceivedVru;
use crossguard_endpoint::station::LocalDynamicMap;
use crossguard_endpoint::{Act, Effect, Endpoint, Moment, Stimulus};
use crossguard_protocol::{
    Config, Duty, EndReason, Event, Input, Maneuver, Millis, Notice, Phase, Robot, StationId,
    TaskType,
};
use crossguard_robot::application::Application;
use crossguard_robot::body::{Body, BodyAct, Build, Fallback, NotTaken, Report, Simulated};
use crossguard_robot::machine::Machine;
use crossguard_robot::perception::{Newest, SensorFrame, seen_from};
use crossguard_robot::plan::Plan;
use crossguard_robot::plan_file::PlanFile;
use crossguard_robot::site::{Place, Site};
use crossguard_robot::site_file::SiteFile;
use crossguard_robot::street::Road;
use crossguard_robot::zone::Zone;

const TICK_MS: u32 = 10;
const FRAME_PERIOD_MS: u32 = 100;

/// How old a frame is when a robot that is awake receives it, usually.
const LATENCY_MS: u32 = 40;

const STARTS_ITS: u64 = 694_694_401_000;

/// The robots, by their place in [`Scene::robots`].
pub(crate) const LEADER: usize = 0;
pub(crate) const GUARD: usize = 1;

/// What a body says of its place, apart from where it is: so many metres off, or nothing at all.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Pose {
    Off([f64; 2]),
    Unknown,
}

/// A simulated body that is carried off its place, or does not know it.
#[derive(Debug)]
struct Carried {
    body: Simulated,
    pose: Arc<Mutex<Pose>>,
}

impl Carried {
    fn pose(&self) -> Pose {
        *self.pose.lock().unwrap()
    }
}

impl Body for Carried {
    fn act(&mut self, act: BodyAct) -> Result<(), NotTaken> {
        self.body.act(act)
    }

    fn advance(&mut self, seconds: f64) -> Option<Report> {
        self.body.advance(seconds)
    }

    fn state(&self) -> RobotState {
        let position = match self.pose() {
            Pose::Off(_) => Site::default().position(self.place()),
            Pose::Unknown => Position::default(),
        };
        RobotState {
            position,
            ..self.body.state()
        }
    }

    fn place(&self) -> Place {
        let Place { east, north } = self.body.place();
        match self.pose() {
            Pose::Off([off_east, off_north]) => Place::new(east + off_east, north + off_north),
            Pose::Unknown => Place { east, north },
        }
    }

    fn stands_at(&self, place: Place) -> bool {
        self.body.stands_at(place)
    }

    fn fallback(&self) -> Option<Fallback> {
        self.body.fallback()
    }

    fn release(&mut self) {
        self.body.release();
    }

    fn halt(&mut self) {
        self.body.halt();
    }

    fn walk_to(&mut self, place: Place, heading_deg: Option<f64>) {
        self.body.walk_to(place, heading_deg);
    }

    fn walks_back(&self) -> bool {
        self.body.walks_back()
    }
}

/// A robot, and what waits for it while it hangs.
pub(crate) struct Actor {
    pub(crate) machine: Machine,
    pub(crate) pose: Arc<Mutex<Pose>>,
    pub(crate) hangs: bool,
    newest: Newest,
    frames: VecDeque<(u32, Option<SensorFrame>)>,
    packets: VecDeque<(u32, Vec<u8>)>,
}

/// Where the person really is, and how they walk.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Person {
    pub(crate) at: [f64; 2],
    pub(crate) way_mps: [f64; 2],
}

impl Person {
    pub(crate) fn is_on_road(&self) -> bool {
        self.at[1] > 0.0 && self.at[1] < 7.0
    }

    pub(crate) fn seen_as(&self, id: u32) -> PerceivedVru {
        PerceivedVru {
            velocity_mps: self.way_mps,
            confidence: 0.9,
            ..PerceivedVru::pedestrian(id, self.at)
        }
    }
}

/// What the sensors make of the truth at a time in ms: frames, or `None` for a line that is none.
pub(crate) type Sensors = Box<dyn FnMut(u32, &Person) -> Vec<Option<SensorFrame>>>;

/// A car on the near lane, which comes from the west at 50 km/h.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Car {
    pub(crate) station: u32,
    pub(crate) east: f64,
}

pub(crate) const CAR_MPS: f64 = 50.0 / 3.6;

/// How far the front of a car may be from the crossing, at x = -3, for it to be unable to stop comfortably:
/// `v * 2 s + v² / (2 * 3 m/s²)`.
pub(crate) const STOPPING_M: f64 = 59.0;

pub(crate) struct Scene {
    pub(crate) robots: Vec<Actor>,
    pub(crate) person: Person,
    pub(crate) cars: Vec<Car>,
    pub(crate) sensors: Sensors,
    /// Which robots have the sensors.
    pub(crate) watchers: Vec<usize>,
    /// How old a frame is when a robot that is awake receives it.
    pub(crate) latency_ms: u32,
    pub(crate) is_cut: bool,
    pub(crate) now_ms: u32,
    pub(crate) calls: usize,
    pub(crate) ends: Vec<EndReason>,
    /// When the sign of the leader began to show go, each time.
    pub(crate) goes_ms: Vec<u32>,
    /// For how long the person was on the road.
    pub(crate) on_road_ms: u32,
    shows_go: bool,
}

fn strip([west, east]: [f64; 2], [south, north]: [f64; 2]) -> Area {
    Area::Polygon(vec![
        [west, south],
        [east, south],
        [east, north],
        [west, north],
    ])
}

/// The zone of the shipped street; the carriageway goes on for 10 m beside the crossing.
fn zone() -> Zone {
    Zone {
        crossing: Some(strip([-3.0, 5.0], [0.0, 7.0])),
        waiting: Some(strip([-3.0, 5.0], [-2.5, 9.5])),
        ..Zone::of_road(strip([-13.0, 15.0], [0.0, 7.0]))
    }
}

pub(crate) fn escort() -> Plan {
    Plan::crossing(Site::default())
}

/// A plan that is shipped, of robot 1 for so many followers.
pub(crate) fn shipped(name: &str, followers: u8) -> Plan {
    let file = PlanFile::open(Path::new(name), SiteFile::street()).unwrap();
    file.plan(StationId(1), followers)
}

/// Sensors that have one person under this id.
pub(crate) fn sees(id: u32) -> Sensors {
    Box::new(move |_, person| vec![Some(SensorFrame::of(&[person.seen_as(id)]))])
}

impl Actor {
    fn new(station: u32, build: Build, place: Place, plan: Option<Plan>, road: Road) -> Self {
        let robot = Robot::new(StationId(station), 1);
        let endpoint = Endpoint::new(robot, Config::default(), Identifiers::default(), 0);
        let pose = Arc::new(Mutex::new(Pose::Off([0.0; 2])));
        let body = Carried {
            body: Simulated::new(build, Site::default(), place, 1.0, 1),
            pose: Arc::clone(&pose),
        };
        Self {
            machine: Machine::new(endpoint, Application::new(Box::new(body), plan).on(road)),
            pose,
            hangs: false,
            newest: Newest::default(),
            frames: VecDeque::new(),
            packets: VecDeque::new(),
        }
    }

    pub(crate) fn place(&self) -> Place {
        self.machine.application().body().place()
    }

    pub(crate) fn executes(&self) -> Option<Maneuver> {
        match self.machine.endpoint().robot().phase() {
            Phase::Following(following) => following.executing(),
            _ => None,
        }
    }

    pub(crate) fn falls_back(&self) -> Option<Maneuver> {
        match self.machine.endpoint().robot().duty() {
            Some(Duty::FallingBack(maneuver)) => Some(maneuver),
            _ => None,
        }
    }

    /// Whether it guards people who cross, or holds because it did.
    pub(crate) fn guards(&self) -> bool {
        let maneuver = self.executes().or_else(|| self.falls_back());
        let guarding = Config::default().settings().guarding;
        maneuver.is_some_and(|it| guarding.contains(it.task))
    }
}

impl Scene {
    /// A leader with this plan at `leader`, the followers that it needs, and a person who waits.
    pub(crate) fn new(plan: Plan, leader: Place) -> Self {
        let road = Road::Watched(zone());
        let places = [
            (2, Build::Quadruped, Place::new(1.0, -1.11)),
            (3, Build::Humanoid, Place::new(6.0, 8.2)),
        ];
        let takes_part = |station: u32| {
            plan.roles.is_empty() && station == 2 || plan.roles.contains(&Some(StationId(station)))
        };
        // Only the leader calls for help.
        let guards_road = Zone {
            waiting: None,
            ..zone()
        };
        let followers = places
            .into_iter()
            .filter(|(station, ..)| takes_part(*station));
        let followers: Vec<_> = followers
            .map(|(station, build, place)| {
                let road = Road::Watched(guards_road.clone());
                Actor::new(station, build, place, None, road)
            })
            .collect();
        let mut robots = vec![Actor::new(1, Build::Humanoid, leader, Some(plan), road)];
        robots.extend(followers);
        Self {
            robots,
            person: Person {
                at: [1.0, -0.8],
                way_mps: [0.0; 2],
            },
            cars: Vec::new(),
            sensors: sees(7),
            watchers: vec![LEADER],
            latency_ms: LATENCY_MS,
            is_cut: false,
            now_ms: 0,
            calls: 0,
            ends: Vec::new(),
            goes_ms: Vec::new(),
            on_road_ms: 0,
            shows_go: false,
        }
    }

    /// The paper's crossing.
    pub(crate) fn escorted() -> Self {
        Self::new(escort(), Place::new(-4.0, -0.8))
    }

    /// A crossing between two robots that block a lane each.
    pub(crate) fn blocked() -> Self {
        Self::new(shipped("bilateral", 1), Place::new(-4.0, -0.8))
    }

    pub(crate) const fn is_go(&self) -> bool {
        self.shows_go
    }

    fn now_us(&self) -> u64 {
        u64::from(self.now_ms) * 1_000
    }

    fn tell(&mut self, to: usize, stimulus: Stimulus<'_>) {
        let moment = Moment::after(STARTS_ITS, self.now_ms.into());
        let now_s = f64::from(self.now_ms) / 1e3;
        for effect in self.robots[to].machine.handle(moment, now_s, stimulus) {
            match effect {
                Effect::Transmit { packet, .. } if !self.is_cut => self.send(to, &packet),
                Effect::Stepped {
                    input: Input::Local(Event::PedestrianDetected(_)),
                    outputs,
                    ..
                } if outputs.ignored().is_none() => self.calls += 1,
                Effect::Act(Act::Notice(Notice::SessionEnded(_, why))) if to == LEADER => {
                    self.ends.push(why);
                }
                _ => {}
            }
        }
    }

    fn send(&mut self, from: usize, packet: &[u8]) {
        for to in (0..self.robots.len()).filter(|to| *to != from) {
            let arrived = (self.now_ms, packet.to_vec());
            self.robots[to].packets.push_back(arrived);
        }
    }

    fn sense(&mut self) {
        for frame in (self.sensors)(self.now_ms, &self.person) {
            for watcher in &self.watchers {
                let actor = &mut self.robots[*watcher];
                actor.frames.push_back((self.now_ms, frame.clone()));
            }
        }
        if self.cars.is_empty() {
            return;
        }
        let cars = std::mem::take(&mut self.cars);
        for car in &cars {
            self.hear(Kind::Vehicle, car.station, [car.east, 1.75], Some(CAR_MPS));
        }
        self.cars = cars;
    }

    /// The leader hears a station: its CAM or VAM.
    pub(crate) fn hear(&mut self, kind: Kind, station: u32, at: [f64; 2], speed: Option<f64>) {
        let mut map = LocalDynamicMap::default();
        let user = RoadUser {
            identity: Identity::Station(station),
            kind,
            station_type: None,
            position: Site::default().position(Place::new(at[0], at[1])),
            speed,
            heading: Some(90.0),
            cardinality: 1,
            signals: None,
            measured_its: STARTS_ITS + u64::from(self.now_ms),
        };
        map.observe(user, self.now_ms.into());
        let machine = &mut self.robots[LEADER].machine;
        let robot = machine.endpoint().robot().clone();
        let now_ms = self.now_ms.into();
        machine.application_mut().listen(&map, &robot, now_ms);
    }

    fn wake(&mut self, to: usize) {
        let now_ms = self.now_ms;
        let latency_ms = self.latency_ms;
        let is_due = |(taken_ms, _): &(u32, _)| *taken_ms + latency_ms <= now_ms;
        while self.robots[to].frames.front().is_some_and(is_due)
            && let Some((taken_ms, frame)) = self.robots[to].frames.pop_front()
        {
            // As in the runtime: the endpoint's RAM tell of the people, too.
            let place = self.robots[to].place();
            let application = self.robots[to].machine.application_mut();
            let Some(frame) = frame else {
                application.look_in_vain();
                continue;
            };
            application.look(&frame, Millis(self.now_ms - taken_ms));
            let people = self.robots[to].newest.look(&frame, taken_ms.into());
            let seen: Vec<_> = people
                .into_iter()
                .map(|vru| seen_from(place, vru))
                .collect();
            self.tell(to, Stimulus::Perceived(&seen));
        }
        while let Some((arrived_ms, packet)) = self.robots[to].packets.pop_front() {
            let datagram = Stimulus::Datagram {
                packet: &packet,
                arrived_ms: arrived_ms.into(),
            };
            self.tell(to, datagram);
        }
        self.tell(to, Stimulus::Time);
    }

    fn tick(&mut self) {
        self.now_ms += TICK_MS;
        let seconds = f64::from(TICK_MS) / 1e3;
        for axis in 0..2 {
            self.person.at[axis] += self.person.way_mps[axis] * seconds;
        }
        for car in &mut self.cars {
            car.east += CAR_MPS * seconds;
        }
        if self.now_ms.is_multiple_of(FRAME_PERIOD_MS) {
            self.sense();
        }
        for robot in 0..self.robots.len() {
            if !self.robots[robot].hangs {
                self.wake(robot);
            }
        }
        self.judge();
    }

    /// The law: nobody is on the road without a guard.
    fn judge(&mut self) {
        let sign = self.robots[LEADER].machine.application().sign();
        let shows_go = sign.shows_go(self.now_us());
        let was_go = std::mem::replace(&mut self.shows_go, shows_go);
        if self.shows_go && !was_go {
            self.goes_ms.push(self.now_ms);
        }
        if self.person.is_on_road() {
            self.on_road_ms += TICK_MS;
            let guarded = self.robots[GUARD..].iter().any(Actor::guards);
            assert!(guarded, "nobody guards: {}", self.told());
        }
    }

    pub(crate) fn told(&self) -> String {
        let of = |actor: &Actor| {
            let robot = actor.machine.endpoint().robot();
            format!(
                "\n  {:?} {:?} {:?}",
                actor.place(),
                robot.phase(),
                robot.duty()
            )
        };
        let robots: String = self.robots.iter().map(of).collect();
        format!(
            "{} ms, {:?}, {} calls, go at {:?}, {:?}{robots}",
            self.now_ms, self.person, self.calls, self.goes_ms, self.ends
        )
    }

    pub(crate) fn pass(&mut self, ms: u32) {
        for _ in 0..ms / TICK_MS {
            self.tick();
        }
    }

    /// Lets time pass until it is so, and says how long that took; at most `ms`.
    pub(crate) fn pass_until(&mut self, ms: u32, is: impl Fn(&Self) -> bool) -> u32 {
        let began_ms = self.now_ms;
        while !is(self) {
            assert!(self.now_ms - began_ms < ms, "{}", self.told());
            self.tick();
        }
        self.now_ms - began_ms
    }

    /// The leader's sign shows go.
    pub(crate) fn comes_to_go(&mut self) {
        self.pass_until(30_000, Self::is_go);
    }

    /// The person walks north at this speed until they are beside the road over there, and stands.
    pub(crate) fn walks_across(&mut self, speed_mps: f64) {
        self.person.way_mps = [0.0, speed_mps];
        self.pass_until(60_000, |it| it.person.at[1] >= 7.9);
        self.person.way_mps = [0.0; 2];
    }

    pub(crate) fn walks_to(&mut self, north: f64, speed_mps: f64) {
        self.person.way_mps = [0.0, speed_mps];
        self.pass_until(60_000, |it| it.person.at[1] >= north);
        self.person.way_mps = [0.0; 2];
    }

    /// The session ends as completed within the time, everybody is at rest, and the person was on the road.
    pub(crate) fn comes_to_rest(&mut self, ms: u32) {
        self.pass_until(ms, |it| it.ends.len() == 1 && it.all_rest());
        assert_eq!(self.ends, [EndReason::TaskCompleted], "{}", self.told());
        assert!(self.on_road_ms > 3_000, "{}", self.told());
        self.pass(5_000);
        assert!(self.all_rest() && self.calls == 1, "{}", self.told());
    }

    pub(crate) fn all_rest(&self) -> bool {
        self.robots.iter().all(|it| it.machine.is_at_rest())
    }

    /// Whether a follower executes a maneuver of this kind.
    pub(crate) fn is_executed(&self, task: TaskType) -> bool {
        let mut followers = self.robots[GUARD..].iter();
        followers.any(|it| it.executes().is_some_and(|maneuver| maneuver.task == task))
    }
}
