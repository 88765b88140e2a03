//! What the harnesses of all stages have in common: one step from any valid state.

use crossguard_protocol::laws::Source;
use crossguard_protocol::laws::arbitrary::{self, Happening, Kind, Stage};
use crossguard_protocol::laws::steps::{self, Taken};
use crossguard_protocol::{Config, Robot, Role};

use crate::{Symbolic, kani};

/// Any configuration whose numbers are in range.
pub(super) fn any_config() -> Config {
    let config = arbitrary::config(&mut Symbolic);
    kani::assume(config.is_some());
    config.unwrap_or_default()
}

/// Any valid state in `stage`, with at most `peers` offers or followers.
pub(super) fn any_valid(config: &Config, stage: Stage, peers: usize) -> Robot {
    let robot = arbitrary::robot(&mut Symbolic, config, stage, peers);
    kani::assume(robot.is_valid(config));
    robot
}

/// Any input of this kind in any valid state of the stage, with the default configuration: all laws of
/// one step hold.
pub(super) fn any_step(stage: Stage, peers: usize, kind: Kind) -> Taken {
    let config = Config::default();
    let robot = any_valid(&config, stage, peers);
    let input = arbitrary::input(&mut Symbolic, kind);
    let step = Taken::new(&config, robot, input);
    steps::all(&config, &step);
    step
}

/// Any of these kinds.
pub(super) fn any_of(kinds: &[Kind]) -> Kind {
    let last = u32::try_from(kinds.len() - 1).unwrap_or(0);
    kinds[Symbolic.number(last, u32::MAX) as usize]
}

/// All events.
pub(super) const EVENTS: [Kind; 7] = [
    Kind::Local(Happening::PedestrianDetected),
    Kind::Local(Happening::CommandManeuver),
    Kind::Local(Happening::ManeuverEnded),
    Kind::Local(Happening::SessionEnded),
    Kind::Local(Happening::AvailabilityChanged),
    Kind::Local(Happening::Corridor),
    Kind::Local(Happening::IdentityChanged),
];


/// Whether the robot has this role after the step.
pub(super) fn becomes(step: &Taken, role: Role) -> bool {
    step.after.role() == role
}
