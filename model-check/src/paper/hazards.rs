//! What the paper's wording lets happen, P1 to P12, each with the rule that closes it; and P0, which
//! holds, so that nobody takes the model for one in which anything can happen.

use stateright::Property;

use crossguard_protocol::State as Stage;

use super::model::{PaperWorld, Question};
use super::road;
use super::robot::{
    HelpStatus, PaperCommand, PaperInput, PaperRmcm, PaperRobot, Progression, RobotIndex,
};

/// A property of the paper's wording.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[allow(missing_docs, reason = "the ids are those of the table in `text`")]
pub enum Hazard {
    P1,
    P2,
    P3,
    P4,
    P5,
    P6,
    P7,
    P8,
    P9,
    P10,
    P11,
    P12,
}

/// What there is to say about a hazard.
#[derive(Clone, Copy, Debug)]
pub struct Text {
    /// Its id.
    pub id: &'static str,
    /// What happens, in a few words.
    pub title: &'static str,
    /// The property that it breaks.
    pub statement: &'static str,
    /// How it comes about and what harm it does.
    pub explanation: &'static str,
    /// The rule of the protocol that closes it, with the ids of the properties that verify it.
    pub closed_by: &'static str,
}

impl Hazard {
    /// All hazards, in order.
    pub const ALL: [Self; 12] = [
        Self::P1,
        Self::P2,
        Self::P3,
        Self::P4,
        Self::P5,
        Self::P6,
        Self::P7,
        Self::P8,
        Self::P9,
        Self::P10,
        Self::P11,
        Self::P12,
    ];

    /// What there is to say about it.
    #[must_use]
    pub const fn text(self) -> Text {
        super::texts::TEXTS[self as usize]
    }

    /// Whether it is that somebody waits for ever, and nothing happens any more.
    pub(super) const fn is_without_end(self) -> bool {
        matches!(self, Self::P5 | Self::P8 | Self::P9 | Self::P10 | Self::P12)
    }

    const fn bit(self) -> u16 {
        1 << self as u16
    }

    /// Whether it is there.
    pub(super) fn is_in(self, world: &PaperWorld) -> bool {
        match self {
            Self::P5 => world.is_stuck() && asking(world) > 1,
            Self::P7 => world
                .robots()
                .any(|(place, _)| leaders_of(world, place) > 1),
            Self::P8 => world.is_stuck() && asking(world) == 1,
            Self::P9 => {
                world.is_stuck()
                    && asking(world) == 0
                    && world
                        .robots()
                        .any(|(_, r)| r.status == HelpStatus::OfferHelp)
            }
            Self::P10 => {
                waits_forever(world, Stage::RoleEstablished, |follower| follower.is_some())
            }
            Self::P12 => waits_forever(world, Stage::ManeuverExecuting, |follower| {
                follower.is_none()
            }),
            Self::P1 | Self::P2 | Self::P3 | Self::P4 | Self::P6 | Self::P11 => {
                world.memory.brought_about & self.bit() != 0
            }
        }
    }
}

/// P0: what holds.
pub(super) const HOLDS: &str = "P0";
/// The premise of P0.
pub(super) const PREMISE: &str = "P0-premise";
/// What is asked about the road.
pub(super) const ON_ROAD: &str = "W";
const HOLDS_BIT: u16 = 1 << Hazard::ALL.len();

/// What stateright looks at to answer a question.
///
/// One hazard at a time: with several, stateright goes on after the first, shortest counterexample and
/// keeps the last.
pub(super) fn properties(question: &Question) -> Vec<Property<Question>> {
    let mut properties = vec![match question.hazard {
        Some(hazard) => Property::always(
            hazard.text().id,
            |question: &Question, world: &PaperWorld| {
                question.hazard.is_none_or(|hazard| !hazard.is_in(world))
            },
        ),
        None => Property::always(HOLDS, |_, world: &PaperWorld| {
            world.memory.brought_about & HOLDS_BIT == 0
        }),
    }];
    if question.road.is_some_and(|road| road.property.is_some()) {
        let holds = |question: &Question, world: &PaperWorld| !road::is_found(question, world);
        properties = vec![Property::always(ON_ROAD, holds)];
    }
    if question.hazard.is_none() && question.road.is_none() && question.cast.commands > 1 {
        let is_met = |_: &Question, world: &PaperWorld| is_crossed(world);
        properties.push(Property::sometimes(PREMISE, is_met));
    }
    properties
}

/// Two maneuvers were finished, nothing went wrong, and everybody is idle again.
fn is_crossed(world: &PaperWorld) -> bool {
    world.memory.finished == 0b11
        && world.memory.fallen_back == 0
        && world.robots.iter().all(|robot| {
            robot
                .as_ref()
                .is_some_and(|robot| robot.state == Stage::Idle)
        })
}

fn asking(world: &PaperWorld) -> usize {
    let asks = |(_, robot): &(RobotIndex, &PaperRobot)| robot.status == HelpStatus::NeedHelp;
    world.robots().filter(asks).count()
}

fn leaders_of(world: &PaperWorld, follower: RobotIndex) -> usize {
    let leads = |(_, robot): &(RobotIndex, &PaperRobot)| robot.follower() == Some(follower);
    world.robots().filter(leads).count()
}

/// A leader in this state that has a command pending, and nothing will ever happen.
fn waits_forever(
    world: &PaperWorld,
    stage: Stage,
    follower_is: fn(Option<&PaperRobot>) -> bool,
) -> bool {
    world.is_stuck()
        && world.robots().any(|(_, robot)| {
            let follower = robot.follower();
            robot.state == stage
                && robot.command.is_some()
                && follower.is_some_and(|follower| follower_is(world.robot(follower)))
        })
}

/// What the step of the robot at `place` from `before` to `after` brings about, as bits.
pub(super) fn brought_about(
    before: &PaperWorld,
    place: RobotIndex,
    input: PaperInput,
    after: &PaperRobot,
) -> u16 {
    let Some(robot) = before.robot(place) else {
        return 0;
    };
    let found = match input {
        PaperInput::Ram(from, ram) if ram.status == HelpStatus::None => {
            is_released_by_mistake(before, place, from, after)
        }
        PaperInput::Ram(_, ram) if ram.progression == Progression::Completed => {
            is_completed_too_early(before, robot, after)
        }
        PaperInput::Rmcm(from, PaperRmcm::Command(command))
            if after.executing() == Some(command) =>
        {
            if !is_given(before, from, robot, command) {
                return HOLDS_BIT;
            }
            let is_again = before.memory.started & 1 << command.serial != 0;
            is_again.then_some(Hazard::P6)
        }
        PaperInput::Rmcm(_, PaperRmcm::Acknowledgement(answered)) if robot.state != after.state => {
            is_acknowledged_in_vain(before, robot, answered)
        }
        PaperInput::SafetyTimeout => {
            let leader = robot.leader().and_then(|leader| before.robot(leader));
            let is_led = leader.is_some_and(|leader| leader.follower() == Some(place));
            (robot.executing().is_some() && robot.heard_leader && is_led).then_some(Hazard::P4)
        }
        _ => None,
    };
    found.map_or(0, Hazard::bit)
}

/// Whether a command was given, and by the leader that the follower follows.
fn is_given(
    before: &PaperWorld,
    from: RobotIndex,
    follower: &PaperRobot,
    command: PaperCommand,
) -> bool {
    command.serial < before.memory.given && follower.leader() == Some(from)
}

/// The leader takes an answer that is for another command, or from a follower that has fallen back.
fn is_acknowledged_in_vain(
    before: &PaperWorld,
    leader: &PaperRobot,
    answered: PaperCommand,
) -> Option<Hazard> {
    if leader.command != Some(answered) {
        return Some(Hazard::P11);
    }
    let has_fallen_back = before.memory.fallen_back & 1 << answered.serial != 0;
    has_fallen_back.then_some(Hazard::P1)
}

/// A RAM with `none` stopped a maneuver that the leader, who did not mean it, counts on.
fn is_released_by_mistake(
    before: &PaperWorld,
    place: RobotIndex,
    from: RobotIndex,
    after: &PaperRobot,
) -> Option<Hazard> {
    let was_executing = before
        .robot(place)
        .and_then(PaperRobot::executing)
        .is_some();
    let counts_on_it = before.robot(from).is_some_and(|leader| {
        leader.follower() == Some(place) && leader.state == Stage::ManeuverExecuting
    });
    (was_executing && after.state == Stage::Idle && counts_on_it).then_some(Hazard::P3)
}

/// The leader counts a command as completed that the follower has not finished.
fn is_completed_too_early(
    before: &PaperWorld,
    leader: &PaperRobot,
    after: &PaperRobot,
) -> Option<Hazard> {
    let command = leader.command.filter(|_| after.command.is_none())?;
    (before.memory.finished & 1 << command.serial == 0).then_some(Hazard::P2)
}
