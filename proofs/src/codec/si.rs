//! Conversions of quantities: all of `f64`, NaN and infinities included.
//!
//! Products and quotients of floats are slow to prove. What is not here, `tests/si.rs` sweeps or
//! tries at random.

use crossguard_codec::si::{self, laws};

use crate::harness::harnesses;
use crate::kani;

harnesses! {
    /// All quantities.
    #[unwind(2)]
    fn state_of_charge_is_total() {
        let quantity = kani::any::<f64>();
        laws::scales_are_total(&si::STATE_OF_CHARGE.scale, quantity);
        kani::cover!(quantity.is_nan(), "not a number");
        kani::cover!(quantity > 100.0, "above the range");
        kani::cover!(quantity < 0.0, "below the range");
        kani::cover!(quantity > 0.0 && quantity < 100.0, "within the range");
    }

    /// All quantities.
    #[unwind(2)]
    fn speed_is_total() {
        let quantity = kani::any::<f64>();
        laws::scales_are_total(&si::SPEED.scale, quantity);
        kani::cover!(quantity.is_nan(), "not a number");
        kani::cover!(quantity > 163.82, "above the range");
        kani::cover!(quantity < 0.0, "below the range");
        kani::cover!(quantity > 0.0 && quantity < 163.82, "within the range");
    }

    /// All quantities.
    #[unwind(2)]
    fn latitude_is_total() {
        let quantity = kani::any::<f64>();
        laws::scales_are_total(&si::LATITUDE.scale, quantity);
        kani::cover!(quantity.is_nan(), "not a number");
        kani::cover!(quantity.is_infinite(), "infinite");
        kani::cover!(quantity > -90.0 && quantity < 90.0, "within the range");
    }

    /// All half widths.
    #[unwind(16)]
    fn altitude_confidence_is_the_smallest_that_fits() {
        let half_width = kani::any::<f64>();
        laws::classes_are_the_smallest_that_fit(&si::ALTITUDE_CONFIDENCE, half_width);
        kani::cover!(half_width > 200.0, "out of range");
        kani::cover!(half_width < 0.0, "negative");
        kani::cover!((0.0..0.01).contains(&half_width), "the best");
    }

    /// All half widths.
    #[unwind(9)]
    fn yaw_rate_confidence_is_the_smallest_that_fits() {
        let half_width = kani::any::<f64>();
        laws::classes_are_the_smallest_that_fit(&si::YAW_RATE_CONFIDENCE, half_width);
        kani::cover!(half_width > 100.0, "out of range");
        kani::cover!(half_width.is_nan(), "not a number");
    }

    /// All counts of steps, of scales of 8, 16 and 32 bits.
    #[unwind(2)]
    fn counts_saturate() {
        let steps = kani::any();
        laws::counts_saturate(&si::STATE_OF_CHARGE.scale, steps);
        laws::counts_saturate(&si::DELTA_ALTITUDE.scale, steps);
        laws::counts_saturate(&si::SPEED.scale, steps);
        laws::counts_saturate(&si::LATITUDE.scale, steps);
        kani::cover!(steps > i64::from(i32::MAX), "beyond 32 bits");
        kani::cover!(steps < 0, "negative");
    }
}
