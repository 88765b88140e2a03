//! What the paper's wording means on the road: bodies, a sign and a pedestrian around its robots, and the
//! road properties W1 to W4 and W7 of them.
//!
//! Nothing here is a rule of a robot. The bodies do as their robots tell them, the pedestrian looks at signs
//! and at nothing else, and applications are truthful: a guard finishes and a task is done only when nobody
//! is on the road. The properties are those of [`road`](crate::road), said again for robots that have no
//! sessions.
//!
//! The wording has neither a sign nor a corridor. The reading is that a leader invites the pedestrian as
//! long as it is in `ManeuverExecuting`.

use crossguard_protocol::State as Stage;

use super::robot::{
    HelpStatus, PaperInput, PaperRam, PaperRmcm, PaperRobot, Progression, RobotIndex,
};

/// How a follower guards.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum Task {
    /// At the pedestrian's side.
    Move,
    /// From a place that it has to reach first.
    Block,
}

/// What is asked about the road.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Inquiry {
    pub(super) task: Task,
    /// The property to break; without one, everything is explored.
    pub(super) property: Option<RoadProperty>,
}

/// A property of the road.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub(super) enum RoadProperty {
    W1,
    W2,
    W3,
    W4,
    W7,
}

/// What a body does, and by which command of which leader.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum PaperBody {
    Parked,
    UnderWay(Charge),
    InPlace(Charge),
    /// The safety timeout has sent it to a safe place.
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

/// Somebody at the crossing.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum PaperPedestrian {
    Waiting,
    /// Since this leader invited.
    OnRoad(RobotIndex),
    Across,
}

/// What happens on the road by itself.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum Move {
    /// The pedestrian steps on the road at this leader's invitation.
    StepOn(RobotIndex),
    /// The pedestrian is off the road.
    Across,
    /// A body reaches its place.
    Reach(RobotIndex),
    /// A body has finished its fallback.
    EndFallback(RobotIndex),
}

/// The road.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub(super) struct Road {
    task: Task,
    bodies: Vec<PaperBody>,
    pedestrian: PaperPedestrian,
    /// Commands of which the leader has heard, by a RAM, that they are executed no more; bits by serial.
    told: u8,
    /// How often a leader has heard a RAM of a leader that goes before it, up to two.
    heard: u8,
    /// Properties that the newest step broke, as bits.
    broken: u8,
}

impl RoadProperty {
    pub(super) const ALL: [Self; 5] = [Self::W1, Self::W2, Self::W3, Self::W4, Self::W7];

    /// One bit for each.
    pub(super) const fn bit(self) -> u8 {
        1 << self as u8
    }

    /// Whether it is that somebody waits for ever.
    pub(super) const fn is_without_end(self) -> bool {
        matches!(self, Self::W7)
    }
}

/// Whether the robot at this place invites the pedestrian.
pub(super) fn invites(robot: &PaperRobot) -> bool {
    robot.state == Stage::ManeuverExecuting && robot.follower().is_some()
}

impl Road {
    pub(super) fn new(robots: usize, task: Task) -> Self {
        Self {
            task,
            bodies: vec![PaperBody::Parked; robots],
            pedestrian: PaperPedestrian::Waiting,
            told: 0,
            heard: 0,
            broken: 0,
        }
    }

    /// Whether nobody is on the road.
    pub(super) fn is_free(&self) -> bool {
        !matches!(self.pedestrian, PaperPedestrian::OnRoad(_))
    }

    /// What may happen on the road by itself, where these robots invite.
    pub(super) fn moves(&self, inviting: impl Iterator<Item = RobotIndex>, moves: &mut Vec<Move>) {
        match self.pedestrian {
            PaperPedestrian::Waiting => moves.extend(inviting.map(Move::StepOn)),
            PaperPedestrian::OnRoad(_) => moves.push(Move::Across),
            PaperPedestrian::Across => {}
        }
        for (place, body) in self.bodies.iter().enumerate() {
            match body {
                PaperBody::UnderWay(_) if self.task == Task::Block => {
                    moves.push(Move::Reach(place));
                }
                PaperBody::FallingBack(_) if self.is_free() => moves.push(Move::EndFallback(place)),
                _ => {}
            }
        }
    }

    /// Something happens on the road by itself.
    pub(super) fn happen(&mut self, what: Move) {
        match what {
            Move::StepOn(leader) => {
                let is_there = |body: &PaperBody| self.accounts_for(*body, leader);
                if !self.bodies.iter().any(is_there) {
                    self.broken |= RoadProperty::W1.bit();
                }
                self.pedestrian = PaperPedestrian::OnRoad(leader);
            }
            Move::Across => self.pedestrian = PaperPedestrian::Across,
            Move::Reach(place) => {
                if let PaperBody::UnderWay(charge) = self.bodies[place] {
                    self.bodies[place] = PaperBody::InPlace(charge);
                }
            }
            Move::EndFallback(place) => self.end(place),
        }
    }

    /// Whether a body guards the people that this leader invites, or is gone and the leader has not been told.
    fn accounts_for(&self, body: PaperBody, leader: RobotIndex) -> bool {
        let is_told = |charge: Charge| self.told & 1 << charge.serial != 0;
        match body {
            PaperBody::FallingBack(charge) | PaperBody::Ended(charge) => {
                charge.leader == leader && !is_told(charge)
            }
            _ => self
                .guarded_by(body)
                .is_some_and(|charge| charge.leader == leader),
        }
    }

    fn guarded_by(&self, body: PaperBody) -> Option<Charge> {
        match body {
            PaperBody::UnderWay(charge) if self.task == Task::Move => Some(charge),
            PaperBody::InPlace(charge) => Some(charge),
            _ => None,
        }
    }

    /// Whether this body guards somebody who is on the road.
    fn needs(&self, body: PaperBody) -> bool {
        let guarded_by = self.guarded_by(body);
        guarded_by.is_some_and(|charge| self.pedestrian == PaperPedestrian::OnRoad(charge.leader))
    }

    /// A body does nothing any more.
    pub(super) fn end(&mut self, place: RobotIndex) {
        if let PaperBody::UnderWay(charge)
        | PaperBody::InPlace(charge)
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

    /// What the step of the robot at `place` means for its body.
    pub(super) fn observe(
        &mut self,
        before: &PaperRobot,
        place: RobotIndex,
        input: PaperInput,
        after: &PaperRobot,
    ) {
        let body = self.bodies[place];
        let falls_back = matches!(body, PaperBody::FallingBack(_));
        let asks_or_offers = |robot: &PaperRobot| {
            matches!(robot.status, HelpStatus::NeedHelp | HelpStatus::OfferHelp)
        };
        if falls_back && asks_or_offers(after) && !asks_or_offers(before) {
            self.broken |= RoadProperty::W4.bit();
        }
        match (input, before.executing(), after.executing()) {
            (PaperInput::Rmcm(leader, PaperRmcm::Command(command)), _, Some(executed))
                if executed == command && after.leader() == Some(leader) =>
            {
                self.leave(body);
                let serial = command.serial;
                self.bodies[place] = PaperBody::UnderWay(Charge { serial, leader });
            }
            (PaperInput::SafetyTimeout, Some(_), None) => {
                self.leave(body);
                if let PaperBody::UnderWay(charge) | PaperBody::InPlace(charge) = body {
                    self.bodies[place] = PaperBody::FallingBack(charge);
                }
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

    /// A body is told to leave what it guards.
    fn leave(&mut self, body: PaperBody) {
        if self.needs(body) {
            self.broken |= RoadProperty::W2.bit();
        }
    }

    fn hear(&mut self, place: RobotIndex, robot: &PaperRobot, from: RobotIndex, ram: PaperRam) {
        if let PaperBody::FallingBack(charge) | PaperBody::Ended(charge) = self.bodies[from]
            && charge.leader == place
            && ram.progression != Progression::Executing
        {
            self.told |= 1 << charge.serial;
        }
        if !matches!(robot.status, HelpStatus::Leader { .. }) {
            return;
        }
        if matches!(ram.status, HelpStatus::Leader { .. }) && from < place {
            self.heard = (self.heard + 1).min(2);
        }
    }

    /// Whether somebody waits at the kerb.
    pub(super) fn is_waited_at(&self) -> bool {
        self.pedestrian == PaperPedestrian::Waiting
    }

    /// Whether the newest step broke a property.
    pub(super) const fn is_broken(&self, property: RoadProperty) -> bool {
        self.broken & property.bit() != 0
    }

    /// Whether a leader has heard twice a RAM of a leader that goes before it.
    pub(super) const fn is_heard_twice(&self) -> bool {
        self.heard == 2
    }
}
