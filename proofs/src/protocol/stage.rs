//! What the harnesses of all stages have in common: one step from any valid state.

use crossguard_protocol::laws::Source;
use crossguard_protocol::laws::arbitrary::{self, Kind, Stage};
use crossguard_protocol::laws::steps::{self, Taken};
use crossguard_protocol::{Config, Robot, Role};

use crate::{Symbolic, kani};

/// Any configuration whose numbers are in range.
pub(super) fn any_config() -> Config {
    let config = arbitrary::config(&mut Symbolic);
    kani::assume(config.is_some());
    config.unwrap_or_default()
}

/// Any valid state in `stage`, with so many offers or followers.
pub(super) fn any_valid(config: &Config, stage: Stage, peers: (usize, usize)) -> Robot {
    let robot = arbitrary::valid_robot(&mut Symbolic, config, stage, peers);
    kani::assume(robot.is_valid(config));
    robot
}

/// Where a step begins.
#[derive(Clone, Copy)]
pub(super) struct From {
    /// The stage.
    pub(super) stage: Stage,
    /// How many offers or followers there are, at least and at most.
    pub(super) peers: (usize, usize),
    /// Whether a RAM may name a session as over.
    pub(super) farewells: bool,
}

impl From {
    /// From any valid state of the stage, without peers.
    pub(super) const fn stage(stage: Stage) -> Self {
        Self {
            stage,
            peers: (0, 0),
            farewells: true,
        }
    }

    /// Any input of this kind in any such state, with the default configuration: all laws of one
    /// step hold.
    pub(super) fn any_step(self, kind: Kind) -> Taken {
        let config = Config::default();
        let robot = any_valid(&config, self.stage, self.peers);
        let input = arbitrary::input(&mut Symbolic, kind, self.farewells);
        let step = Taken::new(&config, robot, input);
        steps::all(&config, &step);
        step
    }
}

/// Any of these kinds. To a proof each is a case of its own.
pub(super) fn any_of(kinds: &[Kind], mut check: impl FnMut(Kind)) {
    let last = u32::try_from(kinds.len() - 1).unwrap_or(0);
    let which = Symbolic.number(last, u32::MAX) as usize;
    let mut i = 0;
    while i < kinds.len() {
        if i == which {
            check(kinds[i]);
        }
        i += 1;
    }
}

/// Whether the robot has this role after the step.
pub(super) fn becomes(step: &Taken, role: Role) -> bool {
    step.after.role() == role
}
