//! Values of what nobody tells in the state of a robot of which nothing is known.

use super::cdd::DriveDirection;
use super::common::TaskProgression;
use super::ram::{ControlMode, OperationalJobRole, PublicSignal, RobotCategory};

macro_rules! defaults {
    ($($type:ident $default:ident),+) => {$(
        impl Default for $type {
            /// The value of what is not known.
            fn default() -> Self {
                Self::$default
            }
        }
    )+};
}

defaults!(
    DriveDirection Unavailable, RobotCategory Unknown, OperationalJobRole None, TaskProgression Idle,
    ControlMode Unavailable, PublicSignal None
);
