//! Elapsed time: the rounds of the loop in which timers fire, as three steps of one argument, each a
//! module. `crossguard_protocol::laws::timers` has the argument.
//!
//! Each harness starts from any state that can occur within a step: consistent, with any timers due,
//! and at most two offers or one or two followers.

use crossguard_protocol::laws::arbitrary;
use crossguard_protocol::{Config, Robot, Role};

use super::stage::peers;
use crate::Symbolic;

pub mod firing;
pub mod running;
pub mod settling;

/// A state that can occur within a step.
pub(super) fn any_within_a_step(config: &Config, stage: Role) -> Robot {
    arbitrary::robot(&mut Symbolic, config, stage, peers(stage))
}

/// Declares a harness of this for each stage.
macro_rules! each_stage {
    ($harness:ident) => {
        $crate::protocol::timers::each_stage! { $harness:
            idle(None) requesting(Requester) offering(Helper) following(Follower) leading(Leader)
        }
    };
    ($harness:ident: $($name:ident($role:ident))+) => {
        $crate::harness::harnesses! { $(
            #[doc = concat!("A robot with the role *", stringify!($role), "*.")]
            #[unwind(6)]
            fn $name() {
                $harness(Role::$role);
            }
        )+ }
    };
}

use each_stage;
