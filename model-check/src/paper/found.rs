//! Hazards that a run of the paper's wording has come to.

use crossguard_protocol::State as Stage;

use super::hazards::Hazard;
use super::road::Road;
use super::robot::{
    HelpStatus, PaperCommand, PaperInput, PaperRmcm, PaperRobot, Progression, RobotIndex,
};
use super::world::PaperWorld;

/// P0: a follower was made to start what its leader did not command.
pub(super) const HOLDS_BIT: u32 = 1 << Hazard::ALL.len();

impl Hazard {
    pub(super) fn is_in(self, world: &PaperWorld) -> bool {
        let on_road = |is_so: &dyn Fn(&Road) -> bool| world.road.as_ref().is_some_and(is_so);
        match self {
            Self::P5 => world.is_stuck() && asking(world) > 1,
            Self::P7 => world
                .robots()
                .any(|(place, _)| leaders_of(world, place) > 1),
            Self::P8 => world.is_stuck() && asking(world) == 1,
            Self::P9 => {
                let offers = |(_, r): (RobotIndex, &PaperRobot)| {
                    matches!(r.status, HelpStatus::OfferHelp { .. })
                };
                world.is_stuck() && asking(world) == 0 && world.robots().any(offers)
            }
            Self::P12 => waits_forever(world, Stage::ManeuverExecuting, |_, follower| {
                follower.is_none()
            }),
            Self::P13 => {
                let is_orphan = |(_, robot): (RobotIndex, &PaperRobot)| {
                    robot.leader().is_some_and(|it| world.robot(it).is_none())
                };
                world.is_stuck() && world.robots().any(is_orphan)
            }
            Self::P1 | Self::P2 | Self::P3 | Self::P4 | Self::P6 | Self::P11 | Self::P14 => {
                world.memory.brought_about & self.bit() != 0
            }
            Self::W1 | Self::W2 | Self::W4 => on_road(&|road| road.is_broken(self)),
            Self::W3 => on_road(&Road::is_heard_twice) && world.inviting().count() > 1,
            Self::W7 => on_road(&Road::is_waited_at) && waits_for_ever(world),
        }
    }
}

/// A robot asks or leads, nothing goes on, and no robot has broken down.
fn waits_for_ever(world: &PaperWorld) -> bool {
    let all_are_up = world.robots().count() == world.robots.len();
    let is_led = world.robots().any(|(_, robot)| robot.follower().is_some());
    all_are_up && (is_led || asking(world) > 0) && world.is_stuck()
}

/// P10: no leader waits for ever for a follower that is still there and follows it.
pub(super) fn is_closed(world: &PaperWorld) -> bool {
    let follows = |leader, follower: Option<&PaperRobot>| {
        follower.is_some_and(|robot| robot.leader() == Some(leader))
    };
    let stages = [Stage::RoleEstablished, Stage::ManeuverExecuting];
    !stages
        .iter()
        .any(|stage| waits_forever(world, *stage, follows))
}

/// Two maneuvers were finished, nothing went wrong, and everybody is idle again.
pub(super) fn is_crossed(world: &PaperWorld) -> bool {
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
    follower_is: fn(RobotIndex, Option<&PaperRobot>) -> bool,
) -> bool {
    world.is_stuck()
        && world.robots().any(|(place, robot)| {
            let follower = robot.follower();
            robot.state == stage
                && robot.command.is_some()
                && follower.is_some_and(|follower| follower_is(place, world.robot(follower)))
        })
}

/// Hazards that the step of the robot at `place` from `before` to `after` brings about, as bits.
pub(super) fn brought_about(
    before: &PaperWorld,
    place: RobotIndex,
    input: PaperInput,
    after: &PaperRobot,
) -> u32 {
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

/// The leader takes an answer to another command, to this one as it was sent before, or from a follower that has
/// said that it fell back.
fn is_acknowledged_in_vain(
    before: &PaperWorld,
    leader: &PaperRobot,
    answered: PaperCommand,
) -> Option<Hazard> {
    if leader.command != Some(answered) {
        let is_reissued = leader.command.map(|command| command.original) == Some(answered.original);
        return Some(if is_reissued {
            Hazard::P14
        } else {
            Hazard::P11
        });
    }
    let has_fallen_back = before.memory.fallen_back & 1 << answered.serial != 0;
    (has_fallen_back && leader.is_told_idle).then_some(Hazard::P1)
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
    (before.memory.finished & 1 << command.original == 0).then_some(Hazard::P2)
}
