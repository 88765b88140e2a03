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

use super::model::{Question, World};
use super::robot::{HelpStatus, Input, Place, Progression, Rmcm, Robot};

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
    pub(super) property: Option<Property>,
}

/// A property of the road.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub(super) enum Property {
    W1,
    W2,
    W3,
    W4,
    W7,
}

/// What a body does, and by which command of which leader.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum Body {
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
    leader: Place,
}

/// Somebody at the crossing.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum Pedestrian {
    Waiting,
    /// Since this leader invited.
    OnRoad(Place),
    Across,
}

/// What happens on the road by itself.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum Move {
    /// The pedestrian steps on the road at this leader's invitation.
    StepOn(Place),
    /// The pedestrian is off the road.
    Across,
    /// A body reaches its place.
    Reach(Place),
    /// A body has finished its fallback.
    EndFallback(Place),
}

/// The road.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub(super) struct Road {
    task: Task,
    bodies: Vec<Body>,
    pedestrian: Pedestrian,
    /// Commands of which the leader has heard, by a RAM, that they are executed no more; bits by serial.
    told: u8,
    /// How often a leader has heard a RAM of a leader that goes before it, up to two.
    heard: u8,
    /// Properties that the newest step broke, as bits.
    broken: u8,
}

impl Property {
    pub(super) const ALL: [Self; 5] = [Self::W1, Self::W2, Self::W3, Self::W4, Self::W7];

    const fn bit(self) -> u8 {
        1 << self as u8
    }

    /// Whether it is that somebody waits for ever.
    pub(super) const fn is_without_end(self) -> bool {
        matches!(self, Self::W7)
    }

    /// Whether it is broken.
    fn is_broken(self, world: &World) -> bool {
        let Some(road) = &world.road else {
            return false;
        };
        match self {
            Self::W1 | Self::W2 | Self::W4 => road.broken & self.bit() != 0,
            Self::W3 => road.heard == 2 && inviting(world).count() > 1,
            Self::W7 => road.waits_for_ever(world),
        }
    }
}

/// Whether a question about the road has found what it asks for.
pub(super) fn is_found(question: &Question, world: &World) -> bool {
    let asked = question.road.and_then(|inquiry| inquiry.property);
    asked.is_some_and(|property| property.is_broken(world))
}

/// Whether the robot at this place invites the pedestrian.
pub(super) fn invites(robot: &Robot) -> bool {
    robot.state == Stage::ManeuverExecuting && robot.follower().is_some()
}

fn inviting(world: &World) -> impl Iterator<Item = Place> {
    let invites = |(_, robot): &(Place, &Robot)| invites(robot);
    world.robots().filter(invites).map(|(place, _)| place)
}

impl Road {
    pub(super) fn new(robots: usize, task: Task) -> Self {
        Self {
            task,
            bodies: vec![Body::Parked; robots],
            pedestrian: Pedestrian::Waiting,
            told: 0,
            heard: 0,
            broken: 0,
        }
    }

    /// Whether nobody is on the road.
    pub(super) fn is_free(&self) -> bool {
        !matches!(self.pedestrian, Pedestrian::OnRoad(_))
    }

    /// What may happen on the road by itself.
    pub(super) fn moves(&self, world: &World, moves: &mut Vec<Move>) {
        match self.pedestrian {
            Pedestrian::Waiting => moves.extend(inviting(world).map(Move::StepOn)),
            Pedestrian::OnRoad(_) => moves.push(Move::Across),
            Pedestrian::Across => {}
        }
        for (place, body) in self.bodies.iter().enumerate() {
            match body {
                Body::UnderWay(_) if self.task == Task::Block => moves.push(Move::Reach(place)),
                Body::FallingBack(_) if self.is_free() => moves.push(Move::EndFallback(place)),
                _ => {}
            }
        }
    }

    /// Something happens on the road by itself.
    pub(super) fn happen(&mut self, what: Move) {
        match what {
            Move::StepOn(leader) => {
                let is_there = |body: &Body| self.accounts_for(*body, leader);
                if !self.bodies.iter().any(is_there) {
                    self.broken |= Property::W1.bit();
                }
                self.pedestrian = Pedestrian::OnRoad(leader);
            }
            Move::Across => self.pedestrian = Pedestrian::Across,
            Move::Reach(place) => {
                if let Body::UnderWay(charge) = self.bodies[place] {
                    self.bodies[place] = Body::InPlace(charge);
                }
            }
            Move::EndFallback(place) => self.end(place),
        }
    }

    /// Whether a body guards the people that this leader invites, or is gone and the leader has not been told.
    fn accounts_for(&self, body: Body, leader: Place) -> bool {
        let is_told = |charge: Charge| self.told & 1 << charge.serial != 0;
        match body {
            Body::FallingBack(charge) | Body::Ended(charge) => {
                charge.leader == leader && !is_told(charge)
            }
            _ => self
                .guarded_by(body)
                .is_some_and(|charge| charge.leader == leader),
        }
    }

    fn guarded_by(&self, body: Body) -> Option<Charge> {
        match body {
            Body::UnderWay(charge) if self.task == Task::Move => Some(charge),
            Body::InPlace(charge) => Some(charge),
            _ => None,
        }
    }

    /// Whether this body guards somebody who is on the road.
    fn needs(&self, body: Body) -> bool {
        let guarded_by = self.guarded_by(body);
        guarded_by.is_some_and(|charge| self.pedestrian == Pedestrian::OnRoad(charge.leader))
    }

    /// A body does nothing any more.
    pub(super) fn end(&mut self, place: Place) {
        if let Body::UnderWay(charge) | Body::InPlace(charge) | Body::FallingBack(charge) =
            self.bodies[place]
        {
            self.bodies[place] = Body::Ended(charge);
        }
    }

    pub(super) fn forget_broken(&mut self) {
        self.broken = 0;
    }

    /// Whether the road would note that `to` hears the current RAM of `from`.
    pub(super) fn notes(&self, world: &World, from: Place, to: Place) -> bool {
        let (Some(sender), Some(receiver)) = (world.robot(from), world.robot(to)) else {
            return false;
        };
        let mut after = self.clone();
        after.hear(to, receiver, from, sender.ram());
        after != *self
    }

    /// What the step of the robot at `place` means for its body.
    pub(super) fn observe(&mut self, before: &Robot, place: Place, input: Input, after: &Robot) {
        let body = self.bodies[place];
        let falls_back = matches!(body, Body::FallingBack(_));
        let asks_or_offers =
            |robot: &Robot| matches!(robot.status, HelpStatus::NeedHelp | HelpStatus::OfferHelp);
        if falls_back && asks_or_offers(after) && !asks_or_offers(before) {
            self.broken |= Property::W4.bit();
        }
        match (input, before.executing(), after.executing()) {
            (Input::Rmcm(leader, Rmcm::Command(command)), _, Some(executed))
                if executed == command && after.leader() == Some(leader) =>
            {
                self.leave(body);
                let serial = command.serial;
                self.bodies[place] = Body::UnderWay(Charge { serial, leader });
            }
            (Input::SafetyTimeout, Some(_), None) => {
                self.leave(body);
                if let Body::UnderWay(charge) | Body::InPlace(charge) = body {
                    self.bodies[place] = Body::FallingBack(charge);
                }
            }
            (Input::Finished, Some(_), None) => self.end(place),
            (_, Some(_), None) => {
                self.leave(body);
                self.bodies[place] = Body::Parked;
            }
            _ => {}
        }
        if let Input::Ram(from, ram) = input {
            self.hear(place, after, from, ram);
        }
    }

    /// A body is told to leave what it guards.
    fn leave(&mut self, body: Body) {
        if self.needs(body) {
            self.broken |= Property::W2.bit();
        }
    }

    fn hear(&mut self, place: Place, robot: &Robot, from: Place, ram: super::robot::Ram) {
        if let Body::FallingBack(charge) | Body::Ended(charge) = self.bodies[from]
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

    /// Somebody leads, nobody invites, nothing goes on, nobody has broken down, and the pedestrian waits.
    fn waits_for_ever(&self, world: &World) -> bool {
        let all_are_up = world.robots().count() == self.bodies.len();
        let is_led = world.robots().any(|(_, robot)| robot.follower().is_some());
        let somebody_invites = inviting(world).next().is_some();
        self.pedestrian == Pedestrian::Waiting
            && all_are_up
            && is_led
            && !somebody_invites
            && world.is_stuck()
    }
}
