//! 1: all countdowns run.

use crossguard_protocol::laws::{Source, budgets, timers as laws};
use crossguard_protocol::{Millis, Role};

use super::{each_stage, peers};
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

each_stage! { any_running }
