//! 3: the step settles.

use crossguard_protocol::laws::timers as laws;
use crossguard_protocol::{Millis, Role};

use super::any_within_a_step;
use crate::harness::harnesses;
use crate::kani;
use crate::protocol::stage;

fn any_settling(stage: Role) {
    let config = stage::config();
    let robot = any_within_a_step(&config, stage);
    kani::assume(laws::is_consistent(&robot, &config) && robot.next_due() != Some(Millis::ZERO));
    laws::settling_makes_the_state_valid(&config, &robot);
    let is_valid = robot.is_valid(&config);
    kani::cover!(is_valid, "valid already");
    kani::cover!(!is_valid, "not valid yet");
}

harnesses! {
    /// A robot without a part in a session.
    #[unwind(6)]
    #[solver(cadical)]
    fn idle() {
        any_settling(Role::None);
    }

    /// A requester.
    #[unwind(6)]
    #[solver(cadical)]
    fn requesting() {
        any_settling(Role::Requester);
    }

    /// A helper.
    #[unwind(6)]
    #[solver(cadical)]
    fn offering() {
        any_settling(Role::Helper);
    }

    /// A follower.
    #[unwind(6)]
    #[solver(cadical)]
    fn following() {
        any_settling(Role::Follower);
    }

    /// A leader.
    #[unwind(6)]
    #[solver(cadical)]
    fn leading() {
        any_settling(Role::Leader);
    }
}
