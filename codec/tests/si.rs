//! The laws of the SI conversions: total, monotone, exact on what they produced, never off by more
//! than their rounding, saturating outside.

use std::fmt::Debug;

use crossguard_codec::si::{self, Beyond, Confidence, Element, Ladder, Rounding, Scale};
use proptest::prelude::*;

/// Every `f64`, the odd ones more often than chance has it.
fn any_quantity() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => -1e3..1e3,
        2 => any::<f64>(),
        1 => prop::sample::select(vec![f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.0, -0.0]),
    ]
}

trait Number: Copy + Into<i64> + TryFrom<i64> + Ord + Debug {}
impl<N: Copy + Into<i64> + TryFrom<i64> + Ord + Debug> Number for N {}

#[expect(clippy::cast_precision_loss, reason = "far below 2^53")]
fn float(number: impl Into<i64>) -> f64 {
    number.into() as f64
}

/// How many steps a number may be off from the quantity that it stands for.
fn error_bounds(rounding: Rounding) -> std::ops::RangeInclusive<f64> {
    const TOLERANCE: f64 = 2e-6;
    match rounding {
        Rounding::Down => -1.0 - TOLERANCE..=TOLERANCE,
        Rounding::Nearest => -0.5 - TOLERANCE..=0.5 + TOLERANCE,
        Rounding::Up => -TOLERANCE..=1.0 + TOLERANCE,
    }
}

fn scale_laws<N: Number>(scale: &Scale<N>, a: f64, b: f64) {
    for quantity in [a, b] {
        let Some(number) = scale.encode(quantity) else {
            assert!(quantity.is_nan());
            continue;
        };
        assert!((scale.min..=scale.max).contains(&number), "{quantity}");
        let steps = quantity * scale.steps_per_unit;
        if steps > float(scale.min) && steps < float(scale.max) {
            let error = float(number) - steps;
            assert!(
                error_bounds(scale.rounding).contains(&error),
                "{quantity} is {number:?}"
            );
        }
        assert_eq!(
            scale.encode(scale.decode(number)),
            Some(number),
            "{quantity}"
        );
    }
    if a <= b {
        assert!(scale.encode(a) <= scale.encode(b), "{a} {b}");
    }
}

fn element_laws<N: Number>(element: &Element<N>, a: f64, b: f64) {
    scale_laws(&element.scale, a, b);
    let unavailable = element.unavailable;
    assert!(!(element.scale.min..=element.scale.max).contains(&unavailable));
    assert_eq!(element.encode(None), unavailable);
    assert_eq!(element.decode(unavailable), None);
    let number = element.encode(Some(a));
    assert_eq!(element.encode(element.decode(number)), number, "{a}");
    if element.beyond == Beyond::Saturates || number != unavailable {
        assert_eq!(
            Some(number).filter(|_| !a.is_nan()),
            element.scale.encode(a)
        );
    } else {
        let steps = a * element.scale.steps_per_unit;
        let (min, max) = (float(element.scale.min), float(element.scale.max));
        assert!(steps.is_nan() || steps < min || steps > max, "{a}");
    }
}

/// Every number that stands for a quantity encodes to itself when it is decoded.
fn every_number_is_exact<N: Number>(scale: &Scale<N>) {
    let (min, max): (i64, i64) = (scale.min.into(), scale.max.into());
    let stride = usize::try_from((max - min) / 1_000_000 + 1).unwrap();
    for number in (min..=max).step_by(stride).chain([max]) {
        let number = N::try_from(number).unwrap_or(scale.max);
        assert_eq!(scale.encode(scale.decode(number)), Some(number));
        assert_eq!(scale.saturate(number.into()), number);
    }
    assert_eq!(scale.saturate(i64::MIN), scale.min);
    assert_eq!(scale.saturate(i64::MAX), scale.max);
    assert_eq!(scale.encode(f64::NEG_INFINITY), Some(scale.min));
    assert_eq!(scale.encode(f64::INFINITY), Some(scale.max));
    assert_eq!(scale.encode(f64::MAX), Some(scale.max));
    assert_eq!(scale.encode(f64::NAN), None);
}

fn confidence_laws<N: Number>(confidence: &Confidence<N>, a: f64, b: f64) {
    let number = confidence.encode(Some(a));
    if a.is_nan() || a < 0.0 {
        assert_eq!(number, confidence.unavailable);
        return;
    }
    let half_width = confidence.decode(number).expect("an interval");
    // Never more confident than the measurement.
    assert!(
        half_width >= a * (1.0 - 1e-6) - 1e-6,
        "{a} became {half_width}"
    );
    assert_eq!(confidence.encode(Some(half_width)), number, "{a}");
    if number != confidence.out_of_range {
        let steps = a * confidence.steps_per_unit;
        assert!(float(number) - steps < 1.0 + 2e-6, "{a} is {number:?}");
    }
    if b >= a {
        assert!(confidence.encode(Some(b)) >= number, "{a} {b}");
    }
}

fn every_confidence_is_exact<N: Number>(confidence: &Confidence<N>) {
    let max: i64 = confidence.max.into();
    for number in (1..=max).filter_map(|number| N::try_from(number).ok()) {
        assert_eq!(confidence.encode(confidence.decode(number)), number);
    }
    assert_eq!(
        confidence.decode(confidence.out_of_range),
        Some(f64::INFINITY)
    );
    assert_eq!(
        confidence.encode(Some(f64::INFINITY)),
        confidence.out_of_range
    );
    assert_eq!(confidence.encode(Some(0.0)).into(), 1);
    assert_eq!(confidence.encode(None), confidence.unavailable);
    assert_eq!(confidence.decode(confidence.unavailable), None);
}

fn ladder_laws(ladder: &Ladder, a: f64) {
    let class = ladder.encode(Some(a));
    if a.is_nan() || a < 0.0 {
        assert_eq!(class, ladder.unavailable());
        return;
    }
    let limit = ladder.decode(class).expect("a limit");
    assert!(a <= limit);
    assert_eq!(ladder.encode(Some(limit)), class);
    if let Some(below) = class.checked_sub(1) {
        assert!(ladder.limits[below] < a);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2_000))]

    #[test]
    fn elements_are_total_monotone_and_close(a in any_quantity(), b in any_quantity()) {
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

    #[test]
    fn small_quantities_are_close_too(a in -0.2..0.2_f64, b in -0.2..0.2_f64) {
        element_laws(&si::DELTA_DEGREES, a, b);
        element_laws(&si::CURVATURE, a, b);
        element_laws(&si::DELTA_DEGREES, a / 10.0, b / 10.0);
    }

    #[test]
    fn confidences_never_claim_more_than_they_got(a in any_quantity(), b in any_quantity()) {
        confidence_laws(&si::SEMI_AXIS, a, b);
        for confidence in [si::SPEED_CONFIDENCE, si::ANGLE_CONFIDENCE, si::ACCELERATION_CONFIDENCE] {
            confidence_laws(&confidence, a, b);
        }
        for ladder in [si::ALTITUDE_CONFIDENCE, si::CURVATURE_CONFIDENCE, si::YAW_RATE_CONFIDENCE] {
            ladder_laws(&ladder, a);
            ladder_laws(&ladder, a / 1e4);
        }
    }

    #[test]
    fn angles_are_total_and_close(degrees in any_quantity()) {
        let number = si::angle(Some(degrees));
        prop_assert!(number < 3_600 || number == 3_601 && !degrees.is_finite());
        if let Some(decoded) = si::angle_degrees(number) {
            prop_assert_eq!(si::angle(Some(decoded)), number);
            if degrees.abs() < 1e6 {
                let error = (decoded - degrees).rem_euclid(360.0);
                prop_assert!(error <= 0.050_001 || error >= 359.949_999, "{degrees} is {decoded}");
            }
        }
    }

    #[test]
    fn longitudes_are_total_and_close(degrees in any_quantity()) {
        let number = si::longitude(Some(degrees));
        match si::longitude_degrees(number) {
            None => prop_assert!(!(-180.0..=180.0).contains(&degrees)),
            Some(decoded) => {
                prop_assert!(decoded > -180.0 && decoded <= 180.0);
                prop_assert_eq!(si::longitude(Some(decoded)), number);
                let error = (decoded - degrees).abs();
                prop_assert!(error < 5.1e-8 || (error - 360.0).abs() < 5.1e-8);
            }
        }
    }

    #[test]
    fn time_stamps_keep_their_instant(unix_ms in 1_072_915_200_000_i64..5_000_000_000_000) {
        prop_assert_eq!(si::unix_ms(si::timestamp_its(unix_ms)), unix_ms);
    }

    #[test]
    fn a_generation_time_is_rebuilt_within_half_its_range(
        now in 100_000..si::TIMESTAMP_ITS_MAX,
        age in -32_768..32_768_i64,
    ) {
        let generated = now.saturating_add_signed(-age);
        let rebuilt = si::rebuild_timestamp(now, si::generation_delta_time(generated));
        prop_assert_eq!(rebuilt, generated);
    }
}

#[test]
fn every_number_encodes_to_itself() {
    for element in [si::LATITUDE, si::ALTITUDE, si::DELTA_DEGREES] {
        every_number_is_exact(&element.scale);
    }
    for element in [
        si::DELTA_ALTITUDE,
        si::ACCELERATION,
        si::CURVATURE,
        si::YAW_RATE,
    ] {
        every_number_is_exact(&element.scale);
    }
    for element in [si::SPEED, si::DIMENSION, si::MAXIMUM_SPEED] {
        every_number_is_exact(&element.scale);
    }
    every_number_is_exact(&si::STATE_OF_CHARGE.scale);
    every_number_is_exact(&si::PATH_DELTA_TIME);
    every_number_is_exact(&si::MINIMUM_DISTANCE);
    every_confidence_is_exact(&si::SEMI_AXIS);
    every_confidence_is_exact(&si::SPEED_CONFIDENCE);
    every_confidence_is_exact(&si::ANGLE_CONFIDENCE);
    every_confidence_is_exact(&si::ACCELERATION_CONFIDENCE);
    for number in 0..3_600 {
        assert_eq!(si::angle(si::angle_degrees(number)), number);
    }
}

#[test]
fn speed_at_its_edges() {
    let speed = |quantity| si::SPEED.encode(Some(quantity));
    assert_eq!(speed(0.0), 0);
    assert_eq!(speed(-1.0), 0);
    assert_eq!(speed(0.001), 1); // rounded up
    assert_eq!(speed(1.39), 139);
    assert_eq!(speed(1.390_1), 140);
    assert_eq!(speed(163.81), 16_381);
    assert_eq!(speed(163.811), 16_382); // out of range
    assert_eq!(speed(1e9), 16_382);
    assert_eq!(si::SPEED.encode(None), 16_383);
    assert_eq!(si::SPEED.encode(Some(f64::NAN)), 16_383);
    assert_eq!(si::SPEED.decode(16_382), Some(163.82));
}

#[test]
fn accelerations_curvature_and_yaw_rate_at_their_edges() {
    let acceleration = |quantity| si::ACCELERATION.encode(Some(quantity));
    assert_eq!(acceleration(-16.0), -160);
    assert_eq!(acceleration(-15.99), -159);
    assert_eq!(acceleration(15.9), 159);
    assert_eq!(acceleration(15.91), 160);
    let curvature = |quantity| si::CURVATURE.encode(Some(quantity));
    assert_eq!(curvature(0.01), 100); // radius 100 m, to the left
    assert_eq!(curvature(-0.102_3), -1_023);
    assert_eq!(curvature(0.102_1), 1_021);
    assert_eq!(curvature(0.102_11), 1_022);
    let yaw_rate = |quantity| si::YAW_RATE.encode(Some(quantity));
    assert_eq!(yaw_rate(-327.66), -32_766);
    assert_eq!(yaw_rate(327.65), 32_765);
    assert_eq!(yaw_rate(327.66), 32_766);
}

#[test]
fn positions_at_their_edges() {
    assert_eq!(si::LATITUDE.encode(Some(48.765_432_1)), 487_654_321);
    assert_eq!(si::LATITUDE.encode(Some(-90.0)), -900_000_000);
    assert_eq!(si::LATITUDE.encode(Some(90.000_001)), 900_000_001); // unavailable
    assert_eq!(si::longitude(Some(9.123_456_7)), 91_234_567);
    assert_eq!(si::longitude(Some(180.0)), 1_800_000_000);
    assert_eq!(si::longitude(Some(-180.0)), 1_800_000_000); // -1800000000 is not used
    assert_eq!(si::longitude(Some(180.1)), 1_800_000_001);
    assert_eq!(si::longitude(None), 1_800_000_001);
    assert_eq!(si::ALTITUDE.encode(Some(260.0)), 26_000);
    assert_eq!(si::ALTITUDE.encode(Some(-2_000.0)), -100_000);
    assert_eq!(si::ALTITUDE.encode(Some(7_999.99)), 799_999);
    assert_eq!(si::ALTITUDE.encode(Some(8_000.0)), 800_000);
    assert_eq!(si::DELTA_DEGREES.encode(Some(0.013_107_1)), 131_071);
    assert_eq!(si::DELTA_DEGREES.encode(Some(0.013_107_2)), 131_072); // unavailable
    assert_eq!(si::DELTA_ALTITUDE.encode(Some(-127.0)), -12_700);
    assert_eq!(si::DELTA_ALTITUDE.encode(Some(127.99)), 12_799);
}

#[test]
fn angles_at_their_edges() {
    assert_eq!(si::angle(Some(90.0)), 900);
    assert_eq!(si::angle(Some(359.94)), 3_599);
    assert_eq!(si::angle(Some(359.96)), 0);
    assert_eq!(si::angle(Some(-90.0)), 2_700);
    assert_eq!(si::angle(Some(720.5)), 5);
    assert_eq!(si::angle(Some(-1e-12)), 0);
    assert_eq!(si::angle(Some(f64::INFINITY)), 3_601);
    assert_eq!(si::angle_degrees(3_600), None);
    assert_eq!(si::angle_degrees(3_601), None);
}

#[test]
fn sizes_and_battery_at_their_edges() {
    assert_eq!(si::DIMENSION.encode(Some(0.0)), 1);
    assert_eq!(si::DIMENSION.encode(Some(0.71)), 8);
    assert_eq!(si::DIMENSION.encode(Some(25.4)), 254);
    assert_eq!(si::DIMENSION.encode(Some(25.41)), 255); // out of range
    assert_eq!(si::DIMENSION.encode(None), 256);
    assert_eq!(si::STATE_OF_CHARGE.encode(Some(19.9)), 19);
    assert_eq!(si::STATE_OF_CHARGE.encode(Some(120.0)), 100);
    assert_eq!(si::STATE_OF_CHARGE.encode(None), 101);
}

#[test]
fn limits_are_not_loosened() {
    assert_eq!(si::MAXIMUM_SPEED.encode(Some(1.239)), 123);
    assert_eq!(si::MINIMUM_DISTANCE.encode(1.21), Some(13));
    assert_eq!(si::MINIMUM_DISTANCE.encode(60.0), Some(511));
}

#[test]
fn confidences_at_their_edges() {
    assert_eq!(si::SEMI_AXIS.encode(Some(40.93)), 4_093);
    assert_eq!(si::SEMI_AXIS.encode(Some(40.94)), 4_094);
    assert_eq!(si::SEMI_AXIS.decode(0), None);
    assert_eq!(si::SPEED_CONFIDENCE.encode(Some(1.25)), 125);
    assert_eq!(si::SPEED_CONFIDENCE.encode(Some(1.251)), 126);
    assert_eq!(si::ANGLE_CONFIDENCE.encode(Some(12.6)), 126);
    assert_eq!(si::ACCELERATION_CONFIDENCE.encode(Some(10.1)), 101);
    assert_eq!(si::ACCELERATION_CONFIDENCE.encode(Some(-0.1)), 102);
    assert_eq!(si::ALTITUDE_CONFIDENCE.encode(Some(1.0)), 6);
    assert_eq!(si::ALTITUDE_CONFIDENCE.encode(Some(200.1)), 14);
    assert_eq!(si::ALTITUDE_CONFIDENCE.encode(None), 15);
    assert_eq!(si::CURVATURE_CONFIDENCE.encode(Some(0.2)), 6);
    assert_eq!(si::YAW_RATE_CONFIDENCE.encode(Some(0.06)), 2);
    assert_eq!(si::YAW_RATE_CONFIDENCE.encode(None), 8);
}

#[test]
fn time_stamps_at_their_edges() {
    // 2004-01-01, 2007-01-01 and 2026-01-05T10:39:56Z.
    assert_eq!(si::timestamp_its(1_072_915_200_000), 0);
    assert_eq!(si::timestamp_its(1_167_609_600_000), 94_694_401_000);
    assert_eq!(si::timestamp_its(1_767_609_596_000), 694_694_401_000);
    assert_eq!(si::unix_ms(694_694_401_000), 1_767_609_596_000);
    assert_eq!(si::timestamp_its(0), 0);
    assert_eq!(si::timestamp_its(i64::MIN), 0);
    assert_eq!(si::timestamp_its(i64::MAX), si::TIMESTAMP_ITS_MAX);
    assert_eq!(si::generation_delta_time(694_694_401_000), 21_480);
    // Within the leap second at the end of 2016.
    let after = si::LEAP_SECONDS_UNIX_MS[4];
    assert_eq!(si::unix_ms(si::timestamp_its(after) - 500), after);
    assert_eq!(si::unix_ms(u64::MAX), si::unix_ms(si::TIMESTAMP_ITS_MAX));
    assert_eq!(si::rebuild_timestamp(0, 65_535), 0);
}
