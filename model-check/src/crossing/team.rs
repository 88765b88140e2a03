//! A leader and its followers, each a robot of the protocol with a crossing machine, and the channel between them.

use std::collections::VecDeque;
use std::fmt;

use crossguard_crossing::{BodyReport, Input, Leg, Output, Outputs, Point, Pose};
use crossguard_protocol::{
    self as protocol, Decimetres, Duty, Event, Heartbeat, ManeuverId, Millis, Phase, Renaming,
    Robot, SessionId, StationId, Timer, UniqueNumber,
};

use super::Watch;
use super::rules::{FOLLOWING, HOMES, LEADING, Machine, POSTS, Rules, pose};
use super::street::{Cut, Guard, Sensed, Sign, TICK};
use crate::canonical::{Names, Ranks};

/// The place of the leader among members. Followers come after it.
const LEADER: usize = 0;

#[derive(Clone, PartialEq, Eq, Hash, Debug)]
struct Member {
    robot: Robot,
    crossing: Machine,
}

#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
#[expect(clippy::struct_excessive_bools, reason = "each is a fact of its own")]
struct Body {
    at: Point,
    task: Option<ManeuverId>,
    to: Option<Point>,
    /// Whether it holds a place because of a fallback.
    holds: bool,
    /// Whether it stands on its way.
    waits: bool,
    /// Whether a maneuver has begun since the last tick.
    begins: bool,
    has_guarded: bool,
}

#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub(super) struct Team {
    /// The leader, and then its followers.
    members: Vec<Member>,
    /// Of followers.
    bodies: Vec<Body>,
}

/// Context of one handling, besides the state.
struct Turn<'a> {
    rules: &'a Rules,
    queue: VecDeque<(usize, protocol::Input)>,
    sign: &'a mut Sign,
    guards: &'a [Guard],
    /// Whether the leader hangs, and what is sent to it is lost.
    is_leader_deaf: bool,
    cut: Option<Cut>,
}

impl Turn<'_> {
    /// Whether a member has a crossing machine. The leader of a guard that is on its own has none.
    fn has_machine(&self, member: usize) -> bool {
        member != LEADER || self.rules.watch != Watch::Guard
    }

    /// Whether a message between members is lost.
    fn loses(&self, from: usize, to: usize) -> bool {
        let is_cut = |it: Cut| {
            let to_leader = it.to_leader && (from, to) == (it.follower + 1, LEADER);
            to_leader || it.to_follower && (from, to) == (LEADER, it.follower + 1)
        };
        self.is_leader_deaf && to == LEADER || self.cut.is_some_and(is_cut)
    }
}

impl Team {
    pub(super) fn new(followers: usize) -> Self {
        let member = |station| Member {
            robot: Robot::new(station, 1),
            crossing: Machine::default(),
        };
        let body = |at| Body {
            at,
            ..Body::default()
        };
        let stations = core::iter::once(LEADING).chain(FOLLOWING);
        Self {
            members: stations.take(1 + followers).map(member).collect(),
            bodies: HOMES.into_iter().take(followers).map(body).collect(),
        }
    }

    pub(super) fn begins(&self, follower: usize) -> bool {
        self.bodies[follower].begins
    }

    /// A body goes where it is to be, unless it waits, which takes a tick. Whether it steps on the road.
    pub(super) fn walk(&mut self, follower: usize) -> bool {
        let body = &mut self.bodies[follower];
        body.begins = false;
        let from = body.at;
        if let Some(to) = body.to.filter(|_| !body.waits) {
            body.at = to;
        }
        (from, body.at) == (HOMES[follower], POSTS[follower])
    }

    /// A tick of all, or of the followers alone while the leader hangs. Once the leader is idle and nobody is on the road, a
    /// person says so to followers that wait for that word, for they have no sensors.
    pub(super) fn tick(
        &mut self,
        rules: &Rules,
        guards: &[Guard],
        sensed: &Sensed<'_>,
        is_road_empty: bool,
        sign: &mut Sign,
    ) {
        let mut turn = Turn {
            rules,
            queue: VecDeque::new(),
            sign,
            guards,
            is_leader_deaf: sensed.passed == 0,
            cut: sensed.cut,
        };
        // A guard that is on its own sees people before it hears of an end that came at the same time.
        if rules.watch == Watch::Guard {
            self.follow(LEADER + 1, sensed, &mut turn);
            self.lead(sensed, &mut turn);
            return;
        }
        self.lead(sensed, &mut turn);
        for follower in LEADER + 1..self.members.len() {
            let is_leader_idle = matches!(self.members[LEADER].robot.phase(), Phase::Idle);
            let is_told = rules.watch == Watch::Leader && is_leader_idle;
            if is_told && is_road_empty && !turn.sign.lets_go() {
                self.tell(follower, Input::SaidClear, &mut turn);
            }
            self.follow(follower, sensed, &mut turn);
        }
    }

    fn lead(&mut self, sensed: &Sensed<'_>, turn: &mut Turn<'_>) {
        if sensed.passed == 0 {
            return;
        }
        let passed = Millis(u32::from(sensed.passed) * TICK.0);
        self.pass(LEADER, passed, turn);
        sensed.each(|input| self.tell(LEADER, input, turn));
        let word = sensed.word.map(protocol::Input::Local);
        turn.queue.extend(word.map(|word| (LEADER, word)));
        self.settle(turn);
    }

    fn follow(&mut self, member: usize, sensed: &Sensed<'_>, turn: &mut Turn<'_>) {
        self.pass(member, TICK, turn);
        if turn.rules.watch != Watch::Leader {
            sensed.now(|input| self.tell(member, input, turn));
        }
        sensed.vehicle(|input| self.tell(member, input, turn));
        if let Some(pose) = self.pose(member, turn) {
            self.tell(member, Input::Pose(Some(pose), Millis::ZERO), turn);
        }
        let body = &mut self.bodies[member - 1];
        if let Some(id) = body.task.filter(|_| body.to == Some(body.at)) {
            body.has_guarded = true;
            self.tell(member, Input::Body(BodyReport::InPosition(id)), turn);
        }
        self.settle(turn);
    }

    /// Where a follower says that it is.
    fn pose(&self, member: usize, turn: &Turn<'_>) -> Option<Pose> {
        let follower = member - 1;
        pose(turn.guards[follower], follower, self.bodies[follower].at)
    }

    fn pass(&mut self, member: usize, time: Millis, turn: &mut Turn<'_>) {
        self.tell(member, Input::Elapsed(time), turn);
        let elapsed = protocol::Input::Elapsed(time);
        turn.queue.push_back((member, elapsed));
        self.settle(turn);
    }

    fn tell(&mut self, member: usize, input: Input<'_>, turn: &mut Turn<'_>) {
        if !turn.has_machine(member) {
            return;
        }
        let setup = &turn.rules.setups[member];
        let out = self.members[member].crossing.step(setup, input);
        self.carry_out(member, &out, turn);
    }

    fn carry_out(&mut self, member: usize, out: &Outputs, turn: &mut Turn<'_>) {
        for output in out.iter().copied() {
            match output {
                Output::Tell(event) => {
                    turn.queue
                        .push_back((member, protocol::Input::Local(event)));
                }
                Output::Order(follower, Leg { task, .. }) => {
                    let event = Event::CommandManeuver { follower, task };
                    turn.queue
                        .push_back((member, protocol::Input::Local(event)));
                }
                Output::Go(left) => turn.sign.left = left.0,
                Output::Stop => turn.sign.left = 0,
                Output::Ask(..) => turn.sign.asks = true,
                _ if member == LEADER => {}
                Output::Release => self.bodies[member - 1].holds = false,
                Output::Wait => self.bodies[member - 1].waits = true,
                Output::GoOn => self.bodies[member - 1].waits = false,
                Output::WalkTo(to) => {
                    let body = &mut self.bodies[member - 1];
                    (body.to, body.waits) = (Some(to), false);
                }
                _ => {}
            }
        }
    }

    fn settle(&mut self, turn: &mut Turn<'_>) {
        while let Some((member, input)) = turn.queue.pop_front() {
            self.step(member, input, turn);
        }
    }

    fn step(&mut self, member: usize, input: protocol::Input, turn: &mut Turn<'_>) {
        use protocol::Output as Said;
        let out = self.members[member].robot.step(&turn.rules.config, input);
        for said in out.iter().copied() {
            match said {
                Said::SendRam => self.send_ram(member, turn),
                Said::SendRmcm(rmcm) => self.send(member, protocol::Input::Rmcm(rmcm), turn),
                Said::StartManeuver(maneuver) => {
                    let (body, post) = (&mut self.bodies[member - 1], POSTS[member - 1]);
                    *body = Body {
                        task: Some(maneuver.id),
                        to: Some(post),
                        holds: false,
                        waits: false,
                        begins: true,
                        ..*body
                    };
                    self.tell(member, Input::Started(maneuver, Some(post)), turn);
                }
                Said::StopManeuver(..) => {
                    self.bodies[member - 1].leave_task(false);
                    self.tell(member, Input::Stopped, turn);
                }
                Said::FallBack(maneuver, policy) => {
                    self.bodies[member - 1].leave_task(true);
                    self.tell(member, Input::FellBack(maneuver, policy), turn);
                }
                // Without a machine, the sign shows what the protocol says.
                Said::CorridorOpened(left) | Said::CorridorExtended(left)
                    if !turn.has_machine(member) =>
                {
                    turn.sign.left = left.0;
                }
                Said::CorridorClosed(_) if !turn.has_machine(member) => turn.sign.left = 0,
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
        if !turn.has_machine(member) {
            return;
        }
        let Member { robot, crossing } = &mut self.members[member];
        let out = crossing.learn(&turn.rules.setups[member], robot);
        self.carry_out(member, &out, turn);
    }

    fn send_ram(&mut self, from: usize, turn: &mut Turn<'_>) {
        let ram = self.members[from].robot.ram();
        if from != LEADER
            && !turn.loses(from, LEADER)
            && let Some(pose) = self.pose(from, turn)
        {
            let at = Input::FollowerAt(ram.station, Some(pose), Millis::ZERO);
            self.tell(LEADER, at, turn);
        }
        let distance = Decimetres(50);
        self.send(from, protocol::Input::Ram { ram, distance }, turn);
    }

    /// Sends a message to everybody else.
    fn send(&self, from: usize, message: protocol::Input, turn: &mut Turn<'_>) {
        for to in 0..self.members.len() {
            if to != from && !turn.loses(from, to) {
                turn.queue.push_back((to, message));
            }
        }
    }

    /// Whether a follower's body has not come to the place of its maneuver yet.
    pub(super) fn is_sent(&self, follower: usize) -> bool {
        let body = &self.bodies[follower];
        body.to == Some(POSTS[follower]) && body.at == HOMES[follower]
    }

    /// Whether a follower's body is where its maneuver leads.
    pub(super) fn is_posted(&self, follower: usize) -> bool {
        self.bodies[follower].at == POSTS[follower]
    }

    pub(super) fn guards(&self, follower: usize) -> bool {
        let (body, robot) = (&self.bodies[follower], &self.members[follower + 1].robot);
        let follows = matches!(robot.phase(), Phase::Following(_));
        body.holds || follows && body.task.is_some()
    }

    /// Whether a follower has guarded, and does not any more.
    pub(super) fn has_left(&self, follower: usize) -> bool {
        self.bodies[follower].has_guarded && !self.guards(follower)
    }

    pub(super) fn is_idle(&self) -> bool {
        let is_idle =
            |it: &Member| matches!(it.robot.phase(), Phase::Idle) && it.robot.duty().is_none();
        self.members.iter().all(is_idle)
    }

    /// Takes absolute numbers out. The protocol asks of two heartbeats of one session, and of two numbers of one station,
    /// which is newer, and of two sessions whether they are the same, so states that differ in such a renaming alone do
    /// the same. Numbers in the machines are those of the follower's maneuver and duty: they and all older ones stay as
    /// they are, until there is neither. Limits that are far away stay so: no run is as long as they are.
    pub(super) fn canonicalize(&mut self) {
        let mut names = Gathered::default();
        let mut held: Option<UniqueNumber> = None;
        for Member { robot, .. } in &mut self.members {
            let duty = robot.duty().map(|duty| match duty {
                Duty::FallingBack(maneuver) => maneuver.id.session,
                Duty::Crossing(session) => session,
            });
            let task = match robot.phase() {
                Phase::Following(following) => following.executing().map(|it| it.id.session),
                _ => None,
            };
            held = held.max(duty.into_iter().chain(task).map(|it| it.number.0).max());
            *robot = robot.renamed(&mut names);
        }
        if let Some(held) = held {
            for count in 0..=held.count {
                names.0.number(LEADING, UniqueNumber { count, ..held });
            }
        }
        let mut ranks = Ranks::default();
        ranks.add(&names.0);
        if ranks.rank_keeping_distances() {
            for Member { robot, .. } in &mut self.members {
                *robot = robot.renamed(&mut &ranks);
            }
        }
    }
}

/// The names of robots, whose limits it holds at what they began with.
#[derive(Default)]
struct Gathered(Names);

impl Renaming for Gathered {
    fn heartbeat(&mut self, session: SessionId, heartbeat: Heartbeat) -> Heartbeat {
        self.0.heartbeat(session, heartbeat)
    }

    fn number(&mut self, owner: StationId, number: UniqueNumber) -> UniqueNumber {
        self.0.number(owner, number)
    }

    fn countdown(&mut self, timer: Timer, left: Millis) -> Millis {
        match timer {
            Timer::IdentityLock | Timer::Execution(_) => Millis(60_000),
            _ => left,
        }
    }
}

impl Body {
    fn leave_task(&mut self, holds: bool) {
        (self.task, self.to) = (None, None);
        (self.holds, self.waits) = (holds, false);
    }
}

impl fmt::Display for Team {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let leader = &self.members[LEADER].robot;
        let corridor = match leader.phase() {
            Phase::Leading(leading) => format!(" ({})", leading.corridor),
            _ => String::new(),
        };
        write!(f, "leader {}{corridor}", leader.role())?;
        for (Member { robot, .. }, body) in self.members[1..].iter().zip(&self.bodies) {
            write!(f, ", follower {}", robot.role())?;
            let told = [
                (body.task.is_some(), ", commanded"),
                (robot.duty().is_some(), ", on duty"),
                (body.holds, ", holds"),
            ];
            let told = told.iter().filter(|(is, _)| *is);
            told.into_iter()
                .try_for_each(|(_, what)| f.write_str(what))?;
        }
        Ok(())
    }
}
