//! Values of components with a DEFAULT that JSON leaves out.

use super::cdd::{AltitudeConfidence, AltitudeValue, DeltaAltitude};

/// The DEFAULT wherever a component has one.
macro_rules! defaults {
    ($($type:ident $default:ident),+) => {$(
        impl Default for $type {
            /// The value of a component that is not there.
            fn default() -> Self {
                Self::$default
            }
        }
    )+};
}

defaults!(AltitudeValue UNAVAILABLE, DeltaAltitude UNAVAILABLE, AltitudeConfidence Unavailable);
