//! The paper's text on the road: bodies, a sign and a pedestrian around its robots, and the road
//! properties W1 to W4 and W7 of them.
//!
//! Nothing here is a rule of a robot. The bodies do as their robots tell them, and applications are truthful: a
//! guard finishes, a leave is granted and a task is done only when nobody is on the road. The properties are
//! those of [`road`](crate::road), said again for robots that have no sessions.
//!
//! The text has neither a sign nor a corridor. It says when the pedestrian is told to go:
//!
//! - an escort: the leader tells the pedestrian to follow the robot dog once the roles are established (stage 3),
//!   so the pedestrian steps on the road with the dog's `Move`, while the leader stops the traffic;
//! - a blocked direction: the leader lets people cross while it is in `ManeuverExecuting` with a `block`.

use crossguard_protocol::State as Stage;

use super::hazards::Hazard;
use super::robot::{
    HelpStatus, PaperInput, PaperRam, PaperRmcm, PaperRobot, PaperTask, Progression, RobotIndex,
    Whereabouts,
};
use crate::walk::{BodyFrame, PersonFrame};

/// Activity of a body, with the leader's command behind it.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum PaperBody {
    Parked,
    UnderWay(Charge),
    Guarding(Charge),
    /// A timeout has sent it to a safe place.
    FallingBack(Charge),
    /// It has finished, has finished its fallback, or has lost power.
    Ended(Charge),
}

/// A command as the road knows it.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) struct Charge {
    serial: u8,
    leader: RobotIndex,
}

#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum PaperPedestrian {
    Waiting,
    /// At the word of this leader.
    OnRoad(RobotIndex),
    Across,
}

/// Events on the road that are no robot's step.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum Move {
    /// The pedestrian steps on the road at this leader's word.
    StepOn(RobotIndex),
    Across,
    EndFallback(RobotIndex),
}

#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub(super) struct Road {
    /// The task by which followers guard.
    guard: PaperTask,
    bodies: Vec<PaperBody>,
    pedestrian: PaperPedestrian,
    /// Commands of which the leader has heard, by a RAM, that they are executed no more; bits by serial.
    told: u8,
    /// How often a leader has heard a RAM of a leader that goes before it, up to two.
    heard: u8,
    /// Properties that the newest step broke, as bits.
    broken: u32,
}

/// Whether the robot lets people cross the road that its follower blocks.
pub(super) fn invites(robot: &PaperRobot) -> bool {
    let task = robot.command.map(|command| command.task);
    robot.state == Stage::ManeuverExecuting
        && robot.follower().is_some()
        && task == Some(PaperTask::Block)
}

impl Road {
    pub(super) fn new(robots: usize, guard: PaperTask) -> Self {
        Self {
            guard,
            bodies: vec![PaperBody::Parked; robots],
            pedestrian: PaperPedestrian::Waiting,
            told: 0,
            heard: 0,
            broken: 0,
        }
    }

    pub(super) fn is_free(&self) -> bool {
        !matches!(self.pedestrian, PaperPedestrian::OnRoad(_))
    }

    /// Possible events on the road, where these robots let people cross.
    pub(super) fn moves(&self, inviting: impl Iterator<Item = RobotIndex>, moves: &mut Vec<Move>) {
        match self.pedestrian {
            PaperPedestrian::Waiting => {
                let said = self.told_to_go(inviting);
                moves.extend(said.into_iter().map(Move::StepOn));
            }
            PaperPedestrian::OnRoad(_) => moves.push(Move::Across),
            PaperPedestrian::Across => {}
        }
        for (place, body) in self.bodies.iter().enumerate() {
            if matches!(body, PaperBody::FallingBack(_)) && self.is_free() {
                moves.push(Move::EndFallback(place));
            }
        }
    }

    /// The leaders at whose word somebody may go, where these robots let people cross.
    pub(super) fn told_to_go(&self, inviting: impl Iterator<Item = RobotIndex>) -> Vec<RobotIndex> {
        if self.guard != PaperTask::Move {
            return inviting.collect();
        }
        let leader = |body: &PaperBody| match body {
            PaperBody::Guarding(charge) => Some(charge.leader),
            _ => None,
        };
        self.bodies.iter().filter_map(leader).collect()
    }

    /// The person at the crossing, as pages show them.
    pub(super) const fn person(&self) -> PersonFrame {
        match self.pedestrian {
            PaperPedestrian::Waiting => PersonFrame::Waiting,
            PaperPedestrian::OnRoad(leader) => PersonFrame::OnRoad(Some(leader)),
            PaperPedestrian::Across => PersonFrame::Across,
        }
    }

    /// Activity of a body, as pages show it.
    pub(super) fn body(&self, place: RobotIndex) -> BodyFrame {
        match self.bodies[place] {
            PaperBody::Parked => BodyFrame::Parked,
            PaperBody::UnderWay(_) => BodyFrame::UnderWay,
            PaperBody::Guarding(_) => BodyFrame::InPosition,
            PaperBody::FallingBack(_) => BodyFrame::FallingBack,
            PaperBody::Ended(_) => BodyFrame::Ended,
        }
    }

    /// Whether a body guards who is on the road, or would, among these robots.
    pub(super) fn guards(&self, place: RobotIndex, robots: &[Option<PaperRobot>]) -> bool {
        let body = self.bodies[place];
        matches!(body, PaperBody::Guarding(charge) if self.is_traffic_stopped(charge.leader, robots))
            && (self.is_free() || self.needs(body))
    }

    /// Whether this leader does its part for the people that it sends: beside an escort, it stops the traffic itself.
    fn is_traffic_stopped(&self, leader: RobotIndex, robots: &[Option<PaperRobot>]) -> bool {
        self.guard != PaperTask::Move
            || robots[leader].is_some_and(|robot| robot.follower().is_some())
    }

    /// Something happens on the road by itself, among these robots.
    pub(super) fn happen(&mut self, what: Move, robots: &[Option<PaperRobot>]) {
        match what {
            Move::StepOn(leader) => {
                let is_guarded = self
                    .bodies
                    .iter()
                    .any(|body| self.accounts_for(*body, leader));
                if !is_guarded || !self.is_traffic_stopped(leader, robots) {
                    self.broken |= Hazard::W1.bit();
                }
                self.pedestrian = PaperPedestrian::OnRoad(leader);
            }
            Move::Across => self.pedestrian = PaperPedestrian::Across,
            Move::EndFallback(place) => self.end(place),
        }
    }

    /// Whether a body guards the people that this leader sends, or is gone and the leader has not been told.
    fn accounts_for(&self, body: PaperBody, leader: RobotIndex) -> bool {
        let is_told = |charge: Charge| self.told & 1 << charge.serial != 0;
        match body {
            PaperBody::FallingBack(charge) | PaperBody::Ended(charge) => {
                charge.leader == leader && !is_told(charge)
            }
            PaperBody::Guarding(charge) => charge.leader == leader,
            PaperBody::Parked | PaperBody::UnderWay(_) => false,
        }
    }

    /// Whether this body guards somebody who is on the road.
    fn needs(&self, body: PaperBody) -> bool {
        let PaperBody::Guarding(charge) = body else {
            return false;
        };
        self.pedestrian == PaperPedestrian::OnRoad(charge.leader)
    }

    /// A body does nothing any more.
    pub(super) fn end(&mut self, place: RobotIndex) {
        if let PaperBody::UnderWay(charge)
        | PaperBody::Guarding(charge)
        | PaperBody::FallingBack(charge) = self.bodies[place]
        {
            self.bodies[place] = PaperBody::Ended(charge);
        }
    }

    pub(super) fn forget_broken(&mut self) {
        self.broken = 0;
    }

    /// Whether the road would note that the robot at `to` hears the current RAM of the robot at `from`.
    pub(super) fn notes(
        &self,
        (from, sender): (RobotIndex, &PaperRobot),
        (to, receiver): (RobotIndex, &PaperRobot),
    ) -> bool {
        let mut after = self.clone();
        after.hear(to, receiver, from, sender.ram());
        after != *self
    }

    /// Applies the step of the robot at `place` to its body.
    pub(super) fn observe(
        &mut self,
        before: &PaperRobot,
        place: RobotIndex,
        input: PaperInput,
        after: &PaperRobot,
    ) {
        let body = self.bodies[place];
        let falls_back = matches!(body, PaperBody::FallingBack(_));
        let takes_part = |robot: &PaperRobot| robot.status != HelpStatus::None;
        if falls_back && takes_part(after) && !takes_part(before) {
            self.broken |= Hazard::W4.bit();
        }
        match (input, before.executing(), after.executing()) {
            (PaperInput::Rmcm(leader, PaperRmcm::Command(command)), _, Some(executed))
                if executed == command && after.leader() == Some(leader) =>
            {
                self.leave(body);
                let serial = command.serial;
                self.bodies[place] = self.begun(executed.task, after, Charge { serial, leader });
            }
            (PaperInput::SafetyTimeout, Some(_), None) => {
                self.leave(body);
                if let PaperBody::UnderWay(charge) | PaperBody::Guarding(charge) = body {
                    self.bodies[place] = PaperBody::FallingBack(charge);
                }
            }
            (PaperInput::Finished, Some(finished), None) if finished.task != self.guard => {
                self.bodies[place] = PaperBody::Parked;
            }
            (PaperInput::Finished, Some(_), None) => self.end(place),
            (_, Some(_), None) => {
                self.leave(body);
                self.bodies[place] = PaperBody::Parked;
            }
            _ => {}
        }
        if let PaperInput::Ram(from, ram) = input {
            self.hear(place, after, from, ram);
        }
    }

    /// An escort guards from the start of its maneuver on, a blocker from its place.
    fn begun(&self, task: PaperTask, robot: &PaperRobot, charge: Charge) -> PaperBody {
        let is_there = task == PaperTask::Move || robot.at == Whereabouts::Lead;
        if task == self.guard && is_there {
            PaperBody::Guarding(charge)
        } else {
            PaperBody::UnderWay(charge)
        }
    }

    /// A body is told to leave what it guards.
    fn leave(&mut self, body: PaperBody) {
        if self.needs(body) {
            self.broken |= Hazard::W2.bit();
        }
    }

    fn hear(&mut self, place: RobotIndex, robot: &PaperRobot, from: RobotIndex, ram: PaperRam) {
        if let PaperBody::FallingBack(charge) | PaperBody::Ended(charge) = self.bodies[from]
            && charge.leader == place
            && ram.progression != Progression::Executing
        {
            self.told |= 1 << charge.serial;
        }
        let leads = |status| matches!(status, HelpStatus::Leader { .. });
        if leads(robot.status) && leads(ram.status) && from < place {
            self.heard = (self.heard + 1).min(2);
        }
    }

    pub(super) fn is_waited_at(&self) -> bool {
        self.pedestrian == PaperPedestrian::Waiting
    }

    /// Whether the newest step broke a property.
    pub(super) const fn is_broken(&self, property: Hazard) -> bool {
        self.broken & property.bit() != 0
    }

    /// Whether a leader has heard twice a RAM of a leader that goes before it.
    pub(super) const fn is_heard_twice(&self) -> bool {
        self.heard == 2
    }
}
