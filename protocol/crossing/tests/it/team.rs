//! Real robots with crossing machines, bodies and a person, in virtual time: what one says the others hear at once.

use std::collections::{BTreeMap, VecDeque};

use crossguard_crossing::*;
use crossguard_protocol::{
    Config, Decimetres, Event, ManeuverId, Millis, Phase, Rmcm, Robot, StationId,
};

/// A tick, in milliseconds.
pub(crate) const TICK: u32 = 50;

/// A body that goes where it is told.
#[derive(Default)]
pub(crate) struct Body {
    pub(crate) at: Point,
    pub(crate) to: Option<Point>,
    speed_cmps: i32,
    task: Option<ManeuverId>,
    /// Whether it holds a place because of a fallback.
    pub(crate) holds: bool,
    pub(crate) waits: bool,
    /// Whether it knows where it is.
    pub(crate) is_lost: bool,
}

impl Body {
    fn advance(&mut self) {
        let Some(to) = self.to.filter(|_| !self.waits) else {
            return;
        };
        let step = self.speed_cmps * i32::try_from(TICK).unwrap() / 1_000;
        let left = i32::try_from(self.at.distance_cm(to)).unwrap();
        self.at = if left <= step {
            to
        } else {
            self.at.plus(self.at.to(to).part(step, left))
        };
    }

    fn has_arrived(&self) -> bool {
        self.to.is_none_or(|to| to == self.at)
    }
}

/// One robot.
pub(crate) struct Member {
    pub(crate) robot: Robot,
    pub(crate) setup: Setup,
    pub(crate) crossing: Crossing<16>,
    pub(crate) body: Body,
    /// Until when its sign shows go.
    pub(crate) go_until: u32,
    /// Whether it has sensors that see people.
    pub(crate) sees: bool,
    /// Until when its process hangs.
    pub(crate) hangs_until: u32,
    /// The outputs of its machine, to the protocol and others, in order.
    pub(crate) log: Vec<Output>,
    last: u32,
}

#[allow(clippy::large_enum_variant, reason = "a short queue, in a test")]
enum Item {
    Protocol(usize, crossguard_protocol::Input),
    Order(usize, StationId, Leg),
}

/// Robots at a crossing. The first one leads.
pub(crate) struct Team {
    pub(crate) config: Config,
    pub(crate) robots: Vec<Member>,
    pub(crate) now: u32,
    /// Everybody at the crossing.
    pub(crate) people: Vec<Sighting>,
    /// The report of sensors, if not the people as they are.
    pub(crate) sensor: fn(u32, &[Sighting]) -> Option<Vec<Sighting>>,
    /// For how long somebody has been on the road without any guard at its place, in milliseconds.
    pub(crate) alone: u32,
    legs: BTreeMap<(u32, u16, u16, u8), Leg>,
    queue: VecDeque<Item>,
}

impl Team {
    /// Robots with these setups, side by side on the near pavement.
    pub(crate) fn new(setups: Vec<Setup>) -> Self {
        let member = |(number, setup): (usize, Setup)| Member {
            robot: Robot::new(StationId(u32::try_from(number).unwrap() + 1), 1),
            sees: setup.watches,
            setup,
            crossing: Crossing::default(),
            body: Body {
                at: Point::new(-100 * i32::try_from(number).unwrap(), -150),
                speed_cmps: 100,
                ..Body::default()
            },
            go_until: 0,
            hangs_until: 0,
            log: Vec::new(),
            last: 0,
        };
        Self {
            config: Config::default(),
            robots: setups.into_iter().enumerate().map(member).collect(),
            now: 0,
            people: Vec::new(),
            sensor: |_, people| Some(people.to_vec()),
            alone: 0,
            legs: BTreeMap::new(),
            queue: VecDeque::new(),
        }
    }

    /// A robot loses power, and boots where it stands.
    pub(crate) fn boot(&mut self, robot: usize) {
        let member = &mut self.robots[robot];
        member.robot = Robot::new(member.robot.station(), 2);
        member.crossing = Crossing::default();
        member.body = Body {
            at: member.body.at,
            speed_cmps: member.body.speed_cmps,
            ..Body::default()
        };
    }

    /// An input of a crossing machine, and its effect.
    pub(crate) fn hear(&mut self, robot: usize, input: Input<'_>) {
        self.tell(robot, input);
        self.settle();
    }

    fn tell(&mut self, robot: usize, input: Input<'_>) {
        let member = &mut self.robots[robot];
        let out = member.crossing.step(&member.setup, input);
        self.carry_out(robot, &out);
    }

    /// Events from a robot's application besides its crossing machine.
    pub(crate) fn event(&mut self, robot: usize, event: Event) {
        self.tell(robot, Input::Said(event));
        self.queue.push_back(Item::Protocol(
            robot,
            crossguard_protocol::Input::Local(event),
        ));
        self.settle();
    }

    fn carry_out(&mut self, robot: usize, out: &Outputs) {
        let member = &mut self.robots[robot];
        for output in out.iter().copied() {
            member.log.push(output);
            match output {
                Output::Tell(event) => self.queue.push_back(Item::Protocol(
                    robot,
                    crossguard_protocol::Input::Local(event),
                )),
                Output::Order(station, leg) => {
                    self.queue.push_back(Item::Order(robot, station, leg));
                }
                Output::Go(left) => member.go_until = self.now + left.0,
                Output::Stop => member.go_until = 0,
                Output::WalkTo(place) => {
                    (member.body.to, member.body.waits) = (Some(place), false);
                }
                Output::Wait => member.body.waits = true,
                Output::GoOn => member.body.waits = false,
                Output::Release => member.body.holds = false,
                Output::Ask(..)
                | Output::Dropped(..)
                | Output::Hindered(_)
                | Output::SaidTooEarly => {}
            }
        }
    }

    /// Handles everything that is to be handled at this time.
    fn settle(&mut self) {
        while let Some(item) = self.queue.pop_front() {
            match item {
                Item::Protocol(robot, input) => self.step(robot, input, None),
                Item::Order(robot, follower, leg) => {
                    let task = leg.task;
                    let event = Event::CommandManeuver { follower, task };
                    self.step(robot, crossguard_protocol::Input::Local(event), Some(leg));
                }
            }
        }
    }

    fn step(&mut self, robot: usize, input: crossguard_protocol::Input, leg: Option<Leg>) {
        use crossguard_protocol::Output as Said;
        if self.now < self.robots[robot].hangs_until {
            return;
        }
        let out = self.robots[robot].robot.step(&self.config, input);
        for said in out.iter().copied() {
            match said {
                Said::SendRam => self.send_ram(robot),
                Said::SendRmcm(rmcm) => {
                    if let (Rmcm::Command(command), Some(leg)) = (rmcm, leg) {
                        let id = ManeuverId::of(command.session, command.request);
                        self.legs.insert(key(command.to, id), leg);
                    }
                    self.broadcast(robot, crossguard_protocol::Input::Rmcm(rmcm));
                }
                Said::StartManeuver(maneuver) => {
                    let station = self.robots[robot].robot.station();
                    let to = self.legs.get(&key(station, maneuver.id)).map(|leg| leg.to);
                    let body = &mut self.robots[robot].body;
                    (body.task, body.to) = (Some(maneuver.id), to);
                    (body.holds, body.waits) = (false, false);
                    self.tell(robot, Input::Started(maneuver, to));
                }
                Said::StopManeuver(..) => {
                    let body = &mut self.robots[robot].body;
                    (body.task, body.to, body.waits) = (None, None, false);
                    self.tell(robot, Input::Stopped);
                }
                Said::FallBack(maneuver, policy) => {
                    let body = &mut self.robots[robot].body;
                    (body.task, body.to, body.waits) = (None, None, false);
                    body.holds = true;
                    self.tell(robot, Input::FellBack(maneuver, policy));
                }
                Said::CorridorOpened(left) | Said::CorridorExtended(left) => {
                    self.tell(robot, Input::CorridorOpen(left));
                }
                Said::CorridorClosed(_) => self.tell(robot, Input::CorridorClosed),
                Said::Notify(notice) => self.tell(robot, Input::Notice(notice)),
                _ => {}
            }
        }
        let is_call = matches!(
            input,
            crossguard_protocol::Input::Local(Event::PedestrianDetected(_))
        );
        if is_call && out.ignored().is_some() {
            self.tell(robot, Input::CallIgnored);
        }
        let member = &mut self.robots[robot];
        let out = member.crossing.learn(&member.setup, &member.robot);
        self.carry_out(robot, &out);
    }

    fn broadcast(&mut self, from: usize, input: crossguard_protocol::Input) {
        for robot in (0..self.robots.len()).filter(|robot| *robot != from) {
            self.queue.push_back(Item::Protocol(robot, input));
        }
    }

    fn send_ram(&mut self, from: usize) {
        let member = &self.robots[from];
        let (station, ram) = (member.robot.station(), member.robot.ram());
        let pose = self.pose(from);
        for robot in 0..self.robots.len() {
            if robot != from && self.now >= self.robots[robot].hangs_until {
                self.tell(robot, Input::FollowerAt(station, pose, Millis(20)));
            }
        }
        let distance = Decimetres(50);
        self.broadcast(from, crossguard_protocol::Input::Ram { ram, distance });
    }

    fn pose(&self, robot: usize) -> Option<Pose> {
        let body = &self.robots[robot].body;
        (!body.is_lost).then_some(Pose {
            at: body.at,
            error_cm: 10,
        })
    }

    /// One tick.
    pub(crate) fn tick(&mut self) {
        self.now += TICK;
        for robot in 0..self.robots.len() {
            self.robots[robot].body.advance();
            if self.now < self.robots[robot].hangs_until {
                continue;
            }
            let passed = Millis(self.now - self.robots[robot].last);
            self.robots[robot].last = self.now;
            self.tell(robot, Input::Elapsed(passed));
            self.queue.push_back(Item::Protocol(
                robot,
                crossguard_protocol::Input::Elapsed(passed),
            ));
            self.settle();
            self.tell(robot, Input::Pose(self.pose(robot), Millis(10)));
            let body = &self.robots[robot].body;
            if let Some(id) = body.task.filter(|_| body.has_arrived()) {
                self.tell(robot, Input::Body(BodyReport::InPosition(id)));
                let escorts = self.is_escorting(robot);
                if escorts {
                    self.tell(robot, Input::Body(BodyReport::Completed(id)));
                }
            }
            if self.robots[robot].sees
                && self.now.is_multiple_of(100)
                && let Some(seen) = (self.sensor)(self.now, &self.people)
            {
                let frame = Frame {
                    source: 0,
                    age: Millis(30),
                    covers: Coverage::ALL,
                    sightings: &seen,
                };
                self.tell(robot, Input::Frame(frame));
            }
            self.settle();
        }
        let is_on_road = |who: &Sighting| (0..700).contains(&who.at.north_cm());
        if self.people.iter().any(is_on_road) && !self.is_guarded() {
            self.alone += TICK;
        }
    }

    fn is_escorting(&self, robot: usize) -> bool {
        let member = &self.robots[robot];
        match member.robot.phase() {
            Phase::Following(following) => following
                .executing()
                .is_some_and(|it| !member.setup.holding.contains(it.task)),
            _ => false,
        }
    }

    /// Whether any robot but the leader guards, or stands by because of a fallback.
    fn is_guarded(&self) -> bool {
        let guards = |it: &Member| it.body.holds || it.body.task.is_some();
        self.robots.iter().skip(1).any(guards)
    }

    pub(crate) fn shows_go(&self) -> bool {
        self.now < self.robots[0].go_until
    }

    /// Whether nobody has a part in a session or a duty.
    pub(crate) fn is_idle(&self) -> bool {
        let is_idle =
            |it: &Member| matches!(it.robot.phase(), Phase::Idle) && it.robot.duty().is_none();
        self.robots.iter().all(is_idle)
    }

    /// Time passes, and everybody walks as they do.
    pub(crate) fn pass(&mut self, ms: u32) {
        for _ in 0..ms / TICK {
            self.tick();
            for who in &mut self.people {
                let way = who.velocity.unwrap_or_default();
                who.at = who.at.plus(way.part(i32::try_from(TICK).unwrap(), 1_000));
            }
        }
    }

    /// The same until something is so, for a minute at most.
    pub(crate) fn pass_until(&mut self, what: &str, is: impl Fn(&Self) -> bool) {
        let until = self.now + 60_000;
        while !is(self) {
            assert!(self.now < until, "never {what}: {:?}", self.robots[0].log);
            self.pass(TICK);
        }
    }

    /// The position in its log of the first output that is so.
    pub(crate) fn first(&self, robot: usize, is: impl Fn(&Output) -> bool) -> Option<usize> {
        self.robots[robot].log.iter().position(is)
    }

    pub(crate) fn told(&self, robot: usize, event: impl Fn(&Event) -> bool) -> usize {
        let is_told = |output: &&Output| matches!(output, Output::Tell(told) if event(told));
        self.robots[robot].log.iter().filter(is_told).count()
    }
}

fn key(station: StationId, id: ManeuverId) -> (u32, u16, u16, u8) {
    let number = id.session.number.0;
    (station.0, number.boot, number.count, id.request.0)
}
