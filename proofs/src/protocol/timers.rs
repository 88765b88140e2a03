//! Elapsed time: the rounds of the loop in which timers fire.
//!
//! Each harness starts from any state that can occur within a step: consistent, with any timers due.

use crossguard_protocol::laws::arbitrary::{self, Stage};
use crossguard_protocol::laws::steps::{self, Taken};
use crossguard_protocol::laws::watch::Sort;
use crossguard_protocol::laws::{Source, timers as laws};
use crossguard_protocol::{Config, Millis, Robot, Role};

use super::stage::{any_config, any_valid, becomes};
use crate::harness::harnesses;
use crate::{Symbolic, kani};

/// How many offers or followers there are: one that a timer is about, and another.
const PEERS: (usize, usize) = (0, 2);

/// All countdowns run.
fn any_running(stage: Stage) {
    let config = any_config();
    let robot = any_valid(&config, stage, PEERS);
    let elapsed = Millis(Symbolic.number(u32::MAX, 100));
    laws::running_keeps_the_state_consistent(&config, &robot, elapsed);
    kani::cover!(
        robot.next_due().is_some_and(|due| due <= elapsed),
        "some are due"
    );
    kani::cover!(
        robot.next_due().is_some_and(|due| due > elapsed),
        "none is due"
    );
}

/// A state that can occur within a step.
fn any_within_a_step(config: &Config, stage: Stage) -> Robot {
    arbitrary::robot(&mut Symbolic, config, stage, PEERS)
}

/// One timer fires.
fn any_firing(stage: Stage) -> Taken {
    let config = any_config();
    let timer = arbitrary::timer(&mut Symbolic);
    let robot = laws::with_due(any_within_a_step(&config, stage), timer);
    kani::assume(laws::is_due(&robot, timer) && laws::is_consistent(&robot, &config));
    let late = Millis(Symbolic.number(u32::MAX, 0));
    let fired = laws::fire(&config, &robot, timer, late);
    laws::firing_keeps_the_state_consistent(&config, &fired);
    laws::firing_keeps_within_the_outputs(&fired);
    steps::tells_the_body(&fired);
    steps::final_progress_stays(&fired);
    fired
}

/// The step settles.
fn any_settling(stage: Stage) {
    let config = any_config();
    let robot = any_within_a_step(&config, stage);
    kani::assume(laws::is_consistent(&robot, &config) && robot.next_due() != Some(Millis::ZERO));
    laws::settling_makes_the_state_valid(&config, &robot);
    kani::cover!(robot.is_valid(&config), "valid already");
    kani::cover!(!robot.is_valid(&config), "not valid yet");
}

harnesses! {
    /// Any valid state.
    #[random_only("not run under Kani to its end.")]
    fn running_without_followers() {
        let stages = [Stage::Idle, Stage::Requesting, Stage::Offering, Stage::Following];
        any_running(stages[Symbolic.number(3, u32::MAX) as usize]);
    }

    /// Any valid state of a leader.
    #[random_only("not run under Kani to its end.")]
    fn running_as_a_leader() {
        any_running(Stage::Leading);
    }

    /// Any due timer of a robot without a role.
    #[random_only("not run under Kani to its end.")]
    fn firing_without_a_role() {
        let stages = [Stage::Idle, Stage::Requesting, Stage::Offering];
        let fired = any_firing(stages[Symbolic.number(2, u32::MAX) as usize]);
        kani::cover!(becomes(&fired, Role::Leader), "establishes the roles");
        kani::cover!(becomes(&fired, Role::None), "ends its part");
    }

    /// Any due timer of a follower.
    #[random_only("not run under Kani to its end.")]
    fn firing_as_a_follower() {
        let fired = any_firing(Stage::Following);
        kani::cover!(fired.said.has(Sort::FallBack), "falls back");
        kani::cover!(becomes(&fired, Role::None), "leaves");
    }

    /// Any due timer of a leader.
    #[random_only("not run under Kani to its end.")]
    fn firing_as_a_leader() {
        let fired = any_firing(Stage::Leading);
        kani::cover!(becomes(&fired, Role::None), "ends its session");
        kani::cover!(becomes(&fired, Role::Leader), "leads on");
    }

    /// Any state at the end of a step.
    #[random_only("not run under Kani to its end.")]
    fn settling_without_followers() {
        let stages = [Stage::Idle, Stage::Requesting, Stage::Offering, Stage::Following];
        any_settling(stages[Symbolic.number(3, u32::MAX) as usize]);
    }

    /// Any state of a leader at the end of a step.
    #[random_only("not run under Kani to its end.")]
    fn settling_as_a_leader() {
        any_settling(Stage::Leading);
    }
}
