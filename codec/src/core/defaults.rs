//! Values of what nobody tells: of components with a DEFAULT that JSON leaves out, and in the state of a robot of which
//! nothing is known.

use super::cdd::{AltitudeConfidence, AltitudeValue, DeltaAltitude, DriveDirection};
use super::common::TaskProgression;
use super::ram::{ControlMode, OperationalJobRole, PublicSignal, RobotCategory};

/// The DEFAULT wherever a component has one.
macro_rules! defaults {
    ($($type:ident $default:ident),+) => {$(
        impl Default for $type {
            /// The value of what is not there.
            fn default() -> Self {
                Self::$default
            }
        }
    )+};
}

defaults!(AltitudeValue UNAVAILABLE, DeltaAltitude UNAVAILABLE, AltitudeConfidence Unavailable);
defaults!(
    DriveDirection Unavailable, RobotCategory Unknown, OperationalJobRole None, TaskProgression Idle,
    ControlMode Unavailable, PublicSignal None
);
