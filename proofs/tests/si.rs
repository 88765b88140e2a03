//! The laws of the SI conversions: every number on the wire, and random quantities.
//!
//! Numbers of 8 and 16 bits are swept in full by `cargo test`, and so are those of 32 bits that have
//! less than a million values. The sweeps of all latitudes, all longitudes and all quantities of 32
//! bits take minutes:
//!
//! ```text
//! cargo test --release -p crossguard-proofs --test si -- --ignored
//! ```

use std::iter::successors;

use crossguard_codec::si::laws::{self, Number};
use crossguard_codec::si::{self, Confidence, Element, Scale};
use proptest::prelude::*;

/// Every number of the scale.
fn sweep<N: Number>(scale: &Scale<N>) {
    sweep_by(scale, 1);
}

/// Every `stride`-th number of the scale, and the last.
fn sweep_by<N: Number>(scale: &Scale<N>, stride: usize) {
    let (min, max): (i64, i64) = (scale.min.into(), scale.max.into());
    for number in (min..=max).step_by(stride).chain([max]) {
        let number = N::try_from(number).ok().expect("a number of the scale");
        laws::numbers_are_exact(scale, number);
    }
}

fn sweep_confidence<N: Number>(confidence: &Confidence<N>) {
    let last: i64 = confidence.unavailable.into();
    for number in (0..=last).filter_map(|number| N::try_from(number).ok()) {
        laws::confidence_numbers_are_exact(confidence, number);
    }
}

#[test]
fn every_number_of_8_and_16_bits_is_exact() {
    for element in [
        si::DELTA_ALTITUDE,
        si::ACCELERATION,
        si::CURVATURE,
        si::YAW_RATE,
    ] {
        sweep(&element.scale);
    }
    for element in [si::SPEED, si::DIMENSION, si::MAXIMUM_SPEED] {
        sweep(&element.scale);
    }
    sweep(&si::STATE_OF_CHARGE.scale);
    sweep(&si::PATH_DELTA_TIME);
    sweep(&si::MINIMUM_DISTANCE);
    sweep_confidence(&si::SEMI_AXIS);
    for confidence in [
        si::SPEED_CONFIDENCE,
        si::ANGLE_CONFIDENCE,
        si::ACCELERATION_CONFIDENCE,
    ] {
        sweep_confidence(&confidence);
    }
    for number in 0..3_600 {
        assert_eq!(si::angle(si::angle_degrees(number)), number);
    }
    for ladder in [
        si::ALTITUDE_CONFIDENCE,
        si::CURVATURE_CONFIDENCE,
        si::YAW_RATE_CONFIDENCE,
    ] {
        for class in 0..=ladder.unavailable() {
            assert_eq!(ladder.encode(ladder.decode(class)), class);
        }
    }
}

#[test]
fn every_altitude_and_every_difference_of_positions_is_exact() {
    sweep(&si::ALTITUDE.scale);
    sweep(&si::DELTA_DEGREES.scale);
}

#[test]
fn latitudes_and_longitudes_are_exact() {
    sweep_by(&si::LATITUDE.scale, 997);
    (-1_799_999_999..=1_800_000_001)
        .step_by(997)
        .for_each(laws::longitude_numbers_are_exact);
}

#[test]
#[ignore = "all latitudes; run in release"]
fn every_latitude_is_exact() {
    sweep(&si::LATITUDE.scale);
}

#[test]
#[ignore = "all longitudes; run in release"]
fn every_longitude_is_exact() {
    (-1_799_999_999..=1_800_000_001).for_each(laws::longitude_numbers_are_exact);
}

/// All finite quantities of 32 bits in order, and the infinities.
fn quantities_of_32_bits() -> impl Iterator<Item = f64> {
    successors(Some(f32::NEG_INFINITY), |&quantity| {
        (quantity < f32::INFINITY).then(|| quantity.next_up())
    })
    .map(f64::from)
}

/// All quantities of 32 bits: total, close, and monotone from one to the next.
fn sweep_quantities<N: Number>(element: &Element<N>) {
    let mut before = f64::NEG_INFINITY;
    for quantity in quantities_of_32_bits() {
        laws::scales_are_total(&element.scale, quantity);
        laws::scales_are_close(&element.scale, quantity);
        laws::scales_are_monotone(&element.scale, before, quantity);
        laws::elements_are_total(element, quantity);
        before = quantity;
    }
}

#[test]
#[ignore = "all quantities of 32 bits; run in release"]
fn every_quantity_of_32_bits_has_its_speed() {
    sweep_quantities(&si::SPEED);
}

#[test]
#[ignore = "all quantities of 32 bits; run in release"]
fn every_quantity_of_32_bits_has_its_latitude() {
    sweep_quantities(&si::LATITUDE);
}

/// Every `f64`, the odd ones more often than chance has it, and values that once were wrong.
fn any_quantity() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => -1e3..1e3,
        2 => any::<f64>(),
        1 => prop::sample::select(vec![f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.0, -0.0]),
        1 => prop::sample::select(vec![
            0.548_576_004_478_454_2,
            142.679_900_335_326_27,
            -0.037_269_229_805_483_486,
        ]),
    ]
}

fn element_laws<N: Number>(element: &Element<N>, a: f64, b: f64) {
    scale_laws(&element.scale, a, b);
    laws::elements_are_total(element, a);
}

fn scale_laws<N: Number>(scale: &Scale<N>, a: f64, b: f64) {
    laws::scales_are_total(scale, a);
    laws::scales_are_close(scale, a);
    laws::scales_are_monotone(scale, a, b);
}

fn confidence_laws<N: Number>(confidence: &Confidence<N>, a: f64, b: f64) {
    laws::confidences_claim_no_more(confidence, a);
    laws::confidences_are_monotone(confidence, a, b);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4_000))]

    #[test]
    fn elements_are_total_monotone_and_close(a in any_quantity(), b in any_quantity()) {
        // The same quantities, in the small too.
        for (a, b) in [(a, b), (a / 1e4, b / 1e4)] {
            for element in [si::LATITUDE, si::ALTITUDE, si::DELTA_DEGREES] {
                element_laws(&element, a, b);
            }
            for element in [si::DELTA_ALTITUDE, si::ACCELERATION, si::CURVATURE, si::YAW_RATE] {
                element_laws(&element, a, b);
            }
            for element in [si::SPEED, si::DIMENSION, si::MAXIMUM_SPEED] {
                element_laws(&element, a, b);
            }
            element_laws(&si::STATE_OF_CHARGE, a, b);
            scale_laws(&si::PATH_DELTA_TIME, a, b);
            scale_laws(&si::MINIMUM_DISTANCE, a, b);
        }
    }

    #[test]
    fn confidences_never_claim_more_than_they_got(a in any_quantity(), b in any_quantity()) {
        confidence_laws(&si::SEMI_AXIS, a, b);
        for confidence in [si::SPEED_CONFIDENCE, si::ANGLE_CONFIDENCE, si::ACCELERATION_CONFIDENCE] {
            confidence_laws(&confidence, a, b);
        }
        for ladder in [si::ALTITUDE_CONFIDENCE, si::CURVATURE_CONFIDENCE, si::YAW_RATE_CONFIDENCE] {
            laws::classes_are_the_smallest_that_fit(&ladder, a);
            laws::classes_are_the_smallest_that_fit(&ladder, a / 1e4);
        }
    }

    #[test]
    fn angles_and_longitudes_are_total_and_close(degrees in any_quantity()) {
        laws::angles_are_total(degrees);
        laws::longitudes_are_total(degrees);
    }

    #[test]
    fn time_stamps_keep_their_instant(a in any::<i64>(), b in 0..5_000_000_000_000_i64) {
        laws::time_stamps_keep_their_instant(a, b);
        laws::time_stamps_keep_their_instant(b, b + 1);
        laws::instants_keep_their_time_stamp(b.cast_unsigned());
    }

    #[test]
    fn a_generation_time_is_rebuilt_within_half_its_range(now in any::<u64>(), age in any::<i16>()) {
        laws::generation_times_are_rebuilt(now % (si::TIMESTAMP_ITS_MAX + 1), age);
    }
}
