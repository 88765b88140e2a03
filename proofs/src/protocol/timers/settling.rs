//! 3: the step settles.

use crossguard_protocol::laws::timers as laws;
use crossguard_protocol::{Millis, Role};

use super::{any_within_a_step, each_stage};
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

each_stage! { any_settling }
