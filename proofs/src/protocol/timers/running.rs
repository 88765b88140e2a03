//! 1: all countdowns run.

use crossguard_protocol::laws::{Source, budgets, timers as laws};
use crossguard_protocol::{Millis, Role};

use super::peers;
use crate::harness::harnesses;
use crate::protocol::stage::{self, any_valid};
use crate::{Symbolic, kani};

fn any_running(stage: Role) {
    let config = stage::config();
    let robot = any_valid(&config, stage, peers(stage));
    let elapsed = Millis(Symbolic.number(u32::MAX, 100));
    laws::running_keeps_the_state_consistent(&config, &robot, elapsed);
    budgets::time_uses_them_up(&robot, elapsed);
    let is_any_due = robot.next_due().is_some_and(|due| due <= elapsed);
    kani::cover!(is_any_due, "some are due");
    kani::cover!(!is_any_due, "none is due");
}

harnesses! {
    /// A robot without a part in a session.
    #[unwind(6)]
    #[solver(cadical)]
    fn idle() {
        any_running(Role::None);
    }

    /// A requester.
    #[unwind(6)]
    #[solver(cadical)]
    fn requesting() {
        any_running(Role::Requester);
    }

    /// A helper.
    #[unwind(6)]
    #[solver(cadical)]
    fn offering() {
        any_running(Role::Helper);
    }

    /// A follower.
    #[unwind(6)]
    #[solver(cadical)]
    fn following() {
        any_running(Role::Follower);
    }

    /// A leader.
    #[unwind(6)]
    #[solver(cadical)]
    fn leading() {
        any_running(Role::Leader);
    }
}
