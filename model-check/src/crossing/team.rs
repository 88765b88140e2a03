//! A leader and a follower, each a robot of the protocol with a crossing machine, on a good channel.

use std::collections::VecDeque;
use std::fmt;

use crossguard_crossing::{
    BodyReport, Coverage, Crossing, Frame, Ground, Input, Leg, Output, Outputs, Plan, Point, Pose,
    PositionRules, Sensors, Setup, Shape, Stage, Vehicle, WaitingRules,
};
use crossguard_protocol::{
    self as protocol, Config, Decimetres, Event, Heartbeat, HelpRequest, List, ManeuverId, Millis,
    Phase, Renaming, Robot, SessionId, Settings, StationId, TaskSet, TaskType, Timer,
};

use super::world::{Guard, Seen, Sign, sighting};
use super::{MISS_MAX, Scenario};

/// A tick.
pub(super) const TICK: Millis = Millis(500);

/// Where the guard stands.
const POST: Point = Point::new(-200, 200);

/// How far from its place a guard is that has drifted.
const DRIFTED: Point = Point::new(-600, 200);

const LEADER: usize = 0;
const FOLLOWER: usize = 1;

/// A robot with its machine.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
struct Member {
    robot: Robot,
    crossing: Crossing<4>,
}

/// What the follower's body does.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
struct Body {
    at: Point,
    task: Option<ManeuverId>,
    to: Option<Point>,
    /// Whether it holds a place because of a fallback.
    holds: bool,
    /// Whether a maneuver has begun since the last tick.
    begins: bool,
    has_guarded: bool,
}

/// The robots and the body of the follower.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub(super) struct Team {
    members: [Member; 2],
    body: Body,
    has_called: bool,
    /// Where the newest command leads.
    leg: Option<Point>,
}

enum Item {
    Step(usize, Box<protocol::Input>),
    Order(StationId, Leg),
}

/// What one handling needs besides the state.
struct Turn<'a> {
    setups: &'a [Setup; 2],
    config: &'a Config,
    queue: VecDeque<Item>,
    sign: &'a mut Sign,
    guard: Guard,
    /// Whether the leader hangs, and what is sent to it is lost.
    is_leader_deaf: bool,
}

/// What the leader has of this tick.
pub(super) struct Sensed<'a> {
    /// How many ticks have passed since it ran last; none while it hangs.
    pub(super) passed: u8,
    /// Frames with their ages in ticks.
    pub(super) frames: &'a [(u8, Seen)],
    pub(super) vehicle: Option<Vehicle>,
}

fn config() -> Config {
    let settings = Settings {
        ram_period: TICK,
        t_select: TICK,
        t_offer: Millis(2_000),
        t_help: Millis(3_000),
        t_safety: Millis(2_000),
        t_lease: Millis(1_800),
        t_farewell: Millis(1_500),
        drift_ppm: 0,
        delay_max: Millis::ZERO,
        ..Settings::default()
    };
    Config::new(settings).unwrap_or_default()
}

fn rectangle(west: i32, south: i32, east: i32, north: i32) -> Option<Shape> {
    let corners = [(west, south), (east, south), (east, north), (west, north)];
    Shape::new(&corners.map(|(east, north)| Point::new(east, north)))
}

/// The settings of the leader's machine and of the follower's.
fn setups(scenario: &Scenario) -> [Setup; 2] {
    let ground = Ground {
        road: rectangle(-3_000, 0, 3_000, 700),
        crossing: rectangle(-300, 0, 300, 700),
        waiting: rectangle(-300, -250, 300, 950),
        parts: Coverage(1),
    };
    let task = TaskType::BLOCK;
    let leg = Leg {
        task,
        to: POST,
        speed_cmps: 100,
        heading_ddeg: None,
    };
    let mut leader = Setup {
        watches: true,
        sensors: Sensors {
            miss_max: MISS_MAX,
            age_max: Millis(250),
            gap_max: TICK,
            ..Sensors::default()
        },
        waiting: WaitingRules {
            dwell: TICK,
            ..WaitingRules::default()
        },
        position: PositionRules {
            lease: Millis(750),
            ..PositionRules::default()
        },
        ground,
        plan: Some(Plan {
            followers: 1,
            stages: core::iter::once(Stage::everybody(leg)).collect(),
            roles: List::EMPTY,
            own_place: None,
            patience: Millis(10_000),
            kerbs: None,
        }),
        ..Setup::default()
    }
    .with(&config());
    leader.request = HelpRequest {
        tasks: TaskSet::of(&[task]),
        ..leader.request
    };
    let mut follower = Setup {
        watches: false,
        plan: None,
        ..leader.clone()
    };
    (scenario.change)(&mut leader);
    (scenario.change)(&mut follower);
    [leader, follower]
}

impl Team {
    pub(super) fn new() -> Self {
        let member = |station| Member {
            robot: Robot::new(StationId(station), 1),
            crossing: Crossing::default(),
        };
        Self {
            members: [member(1), member(2)],
            body: Body::default(),
            has_called: false,
            leg: None,
        }
    }

    /// Whether the body begins a maneuver, and so goes to its place.
    pub(super) const fn begins(&self) -> bool {
        self.body.begins
    }

    /// The body goes to its place, which takes a tick.
    pub(super) fn walk(&mut self) {
        self.body.begins = false;
        if let Some(to) = self.body.to {
            self.body.at = to;
        }
    }

    /// A tick of both, or of the follower alone while the leader hangs.
    pub(super) fn tick(
        &mut self,
        scenario: &Scenario,
        guard: Guard,
        seen: &Sensed<'_>,
        sign: &mut Sign,
    ) {
        let (setups, config) = (setups(scenario), config());
        let mut turn = Turn {
            setups: &setups,
            config: &config,
            queue: VecDeque::new(),
            sign,
            guard,
            is_leader_deaf: seen.passed == 0,
        };
        if seen.passed > 0 {
            self.lead(seen, &mut turn);
        }
        self.follow(&mut turn);
    }

    fn lead(&mut self, seen: &Sensed<'_>, turn: &mut Turn<'_>) {
        self.pass(LEADER, Millis(u32::from(seen.passed) * TICK.0), turn);
        for (age, seen) in seen.frames {
            let people = seen.iter().enumerate();
            let people = people.filter_map(|(number, it)| Some(sighting(number, (*it)?)));
            let sightings: Vec<_> = people.collect();
            let frame = Frame {
                source: 0,
                age: Millis(u32::from(*age) * TICK.0),
                covers: Coverage::ALL,
                sightings: &sightings,
            };
            self.tell(LEADER, Input::Frame(frame), turn);
        }
        if let Some(vehicle) = seen.vehicle {
            self.tell(LEADER, Input::Vehicle(vehicle, Millis::ZERO), turn);
        }
        self.settle(turn);
    }

    fn follow(&mut self, turn: &mut Turn<'_>) {
        self.pass(FOLLOWER, TICK, turn);
        if let Some(pose) = self.pose(turn.guard) {
            self.tell(FOLLOWER, Input::Pose(Some(pose), Millis::ZERO), turn);
        }
        if let Some(id) = self
            .body
            .task
            .filter(|_| self.body.to == Some(self.body.at))
        {
            self.body.has_guarded = true;
            self.tell(FOLLOWER, Input::Body(BodyReport::InPosition(id)), turn);
        }
        self.settle(turn);
    }

    fn pass(&mut self, member: usize, time: Millis, turn: &mut Turn<'_>) {
        self.tell(member, Input::Elapsed(time), turn);
        let elapsed = protocol::Input::Elapsed(time);
        turn.queue.push_back(Item::Step(member, Box::new(elapsed)));
        self.settle(turn);
    }

    /// Where the body says that it is.
    fn pose(&self, guard: Guard) -> Option<Pose> {
        let at = if guard.is_drifted {
            DRIFTED
        } else {
            self.body.at
        };
        (!guard.is_lost).then_some(Pose { at, error_cm: 10 })
    }

    fn tell(&mut self, member: usize, input: Input<'_>, turn: &mut Turn<'_>) {
        let setup = &turn.setups[member];
        let out = self.members[member].crossing.step(setup, input);
        self.carry_out(member, &out, turn);
    }

    fn carry_out(&mut self, member: usize, out: &Outputs, turn: &mut Turn<'_>) {
        for output in out.iter().copied() {
            match output {
                Output::Tell(event) => {
                    self.has_called |= matches!(event, Event::PedestrianDetected(_));
                    let local = protocol::Input::Local(event);
                    turn.queue.push_back(Item::Step(member, Box::new(local)));
                }
                Output::Order(station, leg) => turn.queue.push_back(Item::Order(station, leg)),
                Output::Go(left) => turn.sign.left = left.0,
                Output::Stop => turn.sign.left = 0,
                Output::Release if member == FOLLOWER => self.body.holds = false,
                _ => {}
            }
        }
    }

    /// Handles everything that is to be handled at this time.
    fn settle(&mut self, turn: &mut Turn<'_>) {
        while let Some(item) = turn.queue.pop_front() {
            match item {
                Item::Step(LEADER, _) if turn.is_leader_deaf => {}
                Item::Step(member, input) => self.step(member, *input, turn),
                Item::Order(follower, leg) => {
                    self.leg = Some(leg.to);
                    let task = leg.task;
                    let event = Event::CommandManeuver { follower, task };
                    self.step(LEADER, protocol::Input::Local(event), turn);
                }
            }
        }
    }

    fn step(&mut self, member: usize, input: protocol::Input, turn: &mut Turn<'_>) {
        use protocol::Output as Said;
        let out = self.members[member].robot.step(turn.config, input);
        for said in out.iter().copied() {
            match said {
                Said::SendRam => self.send_ram(member, turn),
                Said::SendRmcm(rmcm) => {
                    let rmcm = protocol::Input::Rmcm(rmcm);
                    turn.queue.push_back(Item::Step(1 - member, Box::new(rmcm)));
                }
                Said::StartManeuver(maneuver) => {
                    self.body = Body {
                        task: Some(maneuver.id),
                        to: self.leg,
                        holds: false,
                        begins: true,
                        ..self.body
                    };
                    self.tell(member, Input::Started(maneuver, self.leg), turn);
                }
                Said::StopManeuver(..) => {
                    self.body.leave_task(false);
                    self.tell(member, Input::Stopped, turn);
                }
                Said::FallBack(maneuver, policy) => {
                    self.body.leave_task(true);
                    self.tell(member, Input::FellBack(maneuver, policy), turn);
                }
                Said::CorridorOpened(left) | Said::CorridorExtended(left) => {
                    self.tell(member, Input::CorridorOpen(left), turn);
                }
                Said::CorridorClosed(_) => self.tell(member, Input::CorridorClosed, turn),
                Said::Notify(notice) => self.tell(member, Input::Notice(notice), turn),
                _ => {}
            }
        }
        let is_call = matches!(input, protocol::Input::Local(Event::PedestrianDetected(_)));
        if is_call && out.ignored().is_some() {
            self.tell(member, Input::CallIgnored, turn);
        }
        let Member { robot, crossing } = &mut self.members[member];
        let out = crossing.learn(&turn.setups[member], robot);
        self.carry_out(member, &out, turn);
    }

    fn send_ram(&mut self, from: usize, turn: &mut Turn<'_>) {
        let ram = self.members[from].robot.ram();
        if from == FOLLOWER
            && !turn.is_leader_deaf
            && let Some(pose) = self.pose(turn.guard)
        {
            let at = Input::FollowerAt(ram.station, Some(pose), Millis::ZERO);
            self.tell(LEADER, at, turn);
        }
        let distance = Decimetres(50);
        let ram = protocol::Input::Ram { ram, distance };
        turn.queue.push_back(Item::Step(1 - from, Box::new(ram)));
    }

    /// Whether the follower guards, or stands by because of a fallback.
    pub(super) const fn guards(&self) -> bool {
        let follows = matches!(self.members[FOLLOWER].robot.phase(), Phase::Following(_));
        self.body.holds || follows && self.body.task.is_some()
    }

    pub(super) const fn has_guarded(&self) -> bool {
        self.body.has_guarded
    }

    pub(super) const fn has_called(&self) -> bool {
        self.has_called
    }

    pub(super) fn is_idle(&self) -> bool {
        let is_idle =
            |it: &Member| matches!(it.robot.phase(), Phase::Idle) && it.robot.duty().is_none();
        self.members.iter().all(is_idle)
    }

    /// Takes heartbeats relative to the newest, and limits that are far away as they were.
    pub(super) fn canonicalize(&mut self) {
        let newest = match (
            self.members[LEADER].robot.phase(),
            self.members[FOLLOWER].robot.phase(),
        ) {
            (Phase::Leading(leading), _) => leading.heartbeat,
            (Phase::Requesting(requesting), _) => requesting.heartbeat,
            (_, Phase::Following(following)) => following.heard,
            (_, Phase::Offering(offering)) => offering.heard,
            _ => Heartbeat(0),
        };
        for member in &mut self.members {
            member.robot = member.robot.renamed(&mut Relative(newest));
        }
    }
}

impl Body {
    fn leave_task(&mut self, holds: bool) {
        (self.task, self.to, self.holds) = (None, None, holds);
    }
}

/// Heartbeats relative to the newest.
struct Relative(Heartbeat);

impl Renaming for Relative {
    fn heartbeat(&mut self, _: SessionId, heartbeat: Heartbeat) -> Heartbeat {
        Heartbeat(heartbeat.0.wrapping_sub(self.0.0).wrapping_add(1_000))
    }

    fn countdown(&mut self, timer: Timer, left: Millis) -> Millis {
        match timer {
            Timer::IdentityLock | Timer::Execution(_) => Millis(60_000),
            _ => left,
        }
    }
}

impl fmt::Display for Team {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [leader, follower] = &self.members;
        let corridor = match leader.robot.phase() {
            Phase::Leading(leading) => Some(leading.corridor),
            _ => None,
        };
        write!(
            f,
            "leader {} {corridor:?} {:?}, follower {} {:?}, clear {:?}, body {:?}",
            leader.robot.role(),
            leader.robot.duty(),
            follower.robot.role(),
            follower.robot.duty(),
            leader.crossing.occupancy().was_seen(),
            self.body,
        )
    }
}
