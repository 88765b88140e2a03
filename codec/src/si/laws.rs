//! The laws of the conversions: total, monotone, exact on what they produced, never off by more than
//! their rounding, saturating outside.
//!
//! Functions that assert, for the `proofs` crate to call with symbolic, random and all values. Not
//! part of the stable interface.

use super::{
    Beyond, Confidence, Element, Ladder, Rounding, Scale, TIMESTAMP_ITS_MAX, angle, angle_degrees,
    float, generation_delta_time, longitude, longitude_degrees, rebuild_timestamp, timestamp_its,
    unix_ms,
};

/// A number on the wire.
pub trait Number: Copy + Into<i64> + TryFrom<i64> + Ord + core::fmt::Debug {}
impl<N: Copy + Into<i64> + TryFrom<i64> + Ord + core::fmt::Debug> Number for N {}

/// How many steps a number may be off from the quantity that it stands for, either way: half a step
/// or one, and a millionth for the multiplication.
fn error_bounds(rounding: Rounding) -> core::ops::RangeInclusive<f64> {
    const TOLERANCE: f64 = 2e-6;
    match rounding {
        Rounding::Down => -1.0 - TOLERANCE..=TOLERANCE,
        Rounding::Nearest => -0.5 - TOLERANCE..=0.5 + TOLERANCE,
        Rounding::Up => -TOLERANCE..=1.0 + TOLERANCE,
    }
}

/// Every quantity but NaN has a number, one of the scale; outside of it the first or the last.
pub fn scales_are_total<N: Number>(scale: &Scale<N>, quantity: f64) {
    let Some(number) = scale.encode(quantity) else {
        assert!(quantity.is_nan());
        return;
    };
    assert!(scale.min <= number && number <= scale.max);
    let steps = quantity * scale.steps_per_unit;
    if steps >= float(scale.max) {
        assert!(number == scale.max);
    }
    if steps <= float(scale.min) {
        assert!(number == scale.min);
    }
}

/// Within the scale a number is off by no more than its rounding.
pub fn scales_are_close<N: Number>(scale: &Scale<N>, quantity: f64) {
    let steps = quantity * scale.steps_per_unit;
    if let Some(number) = scale.encode(quantity)
        && steps > float(scale.min)
        && steps < float(scale.max)
    {
        assert!(error_bounds(scale.rounding).contains(&(float(number) - steps)));
    }
}

/// A larger quantity has no smaller number.
pub fn scales_are_monotone<N: Number>(scale: &Scale<N>, a: f64, b: f64) {
    if a <= b {
        assert!(scale.encode(a) <= scale.encode(b));
    }
}

/// A number of the scale encodes to itself when it is decoded, and saturates to itself.
pub fn numbers_are_exact<N: Number>(scale: &Scale<N>, number: N) {
    if number < scale.min || number > scale.max {
        return;
    }
    assert_eq!(scale.encode(scale.decode(number)), Some(number));
    assert_eq!(scale.saturate(number.into()), number);
}

/// Any count of steps saturates into the scale.
pub fn counts_saturate<N: Number>(scale: &Scale<N>, steps: i64) {
    let number: i64 = scale.saturate(steps).into();
    assert_eq!(number, steps.clamp(scale.min.into(), scale.max.into()));
}

/// Unavailable is what is not known, NaN and, where the element says so, what is out of range; every
/// other quantity has the number of its scale, and comes back as itself.
pub fn elements_are_total<N: Number>(element: &Element<N>, quantity: f64) {
    let (scale, unavailable) = (&element.scale, element.unavailable);
    assert!(unavailable < scale.min || unavailable > scale.max);
    assert!(element.encode(None) == unavailable && element.decode(unavailable).is_none());
    let number = element.encode(Some(quantity));
    assert!(element.encode(element.decode(number)) == number);
    if number != unavailable {
        assert!(Some(number) == scale.encode(quantity));
        return;
    }
    let steps = quantity * scale.steps_per_unit;
    let is_beyond = steps < float(scale.min) || steps > float(scale.max);
    assert!(quantity.is_nan() || element.beyond == Beyond::IsUnavailable && is_beyond);
}

/// A confidence never claims more than the measurement did, and no less than a step more.
pub fn confidences_claim_no_more<N: Number>(confidence: &Confidence<N>, half_width: f64) {
    let number = confidence.encode(Some(half_width));
    if half_width.is_nan() || half_width < 0.0 {
        assert!(number == confidence.unavailable);
        return;
    }
    let claimed = confidence.decode(number).unwrap_or(-1.0);
    assert!(claimed >= half_width * (1.0 - 1e-6) - 1e-6);
    assert!(confidence.encode(Some(claimed)) == number);
    if number != confidence.out_of_range {
        let steps = half_width * confidence.steps_per_unit;
        assert!(float(number) - steps < 1.0 + 2e-6);
    }
}

/// A wider interval has no smaller number.
pub fn confidences_are_monotone<N: Number>(confidence: &Confidence<N>, a: f64, b: f64) {
    if 0.0 <= a && a <= b {
        assert!(confidence.encode(Some(a)) <= confidence.encode(Some(b)));
    }
}

/// A number that stands for a half width encodes to itself when it is decoded.
pub fn confidence_numbers_are_exact<N: Number>(confidence: &Confidence<N>, number: N) {
    match confidence.decode(number) {
        None => assert!(number == confidence.unavailable || number.into() == 0),
        Some(_) if number > confidence.out_of_range => {}
        half_width => assert!(confidence.encode(half_width) == number),
    }
}

/// A class is the first whose limit is not exceeded.
pub fn classes_are_the_smallest_that_fit(ladder: &Ladder, half_width: f64) {
    let class = ladder.encode(Some(half_width));
    if half_width.is_nan() || half_width < 0.0 {
        assert!(class == ladder.unavailable() && ladder.decode(class).is_none());
        return;
    }
    let limit = ladder.decode(class).unwrap_or(-1.0);
    assert!(half_width <= limit && ladder.encode(Some(limit)) == class);
    if let Some(below) = class.checked_sub(1) {
        assert!(ladder.limits[below] < half_width);
    }
}

/// Every finite angle has a number, within half a step on the circle, that encodes to itself.
pub fn angles_are_total(degrees: f64) {
    let number = angle(Some(degrees));
    let Some(decoded) = angle_degrees(number) else {
        assert!(number == 3_601 && !degrees.is_finite());
        return;
    };
    assert!(angle(Some(decoded)) == number);
    if degrees.abs() < 1e6 {
        let turns = (decoded - degrees) / 360.0;
        #[expect(clippy::cast_possible_truncation, reason = "below 10^4 turns")]
        let whole = (turns + if turns < 0.0 { -0.5 } else { 0.5 }) as i64;
        let error = (turns - float(whole)) * 360.0;
        assert!(error.abs() <= 0.050_001);
    }
}

/// A longitude has a number within half a step, or is out of range; -180 is 180.
pub fn longitudes_are_total(degrees: f64) {
    let number = longitude(Some(degrees));
    let Some(decoded) = longitude_degrees(number) else {
        assert!(!(-180.0..=180.0).contains(&degrees));
        return;
    };
    assert!(decoded > -180.0 && decoded <= 180.0);
    assert!(longitude(Some(decoded)) == number);
    let error = (decoded - degrees).abs();
    assert!(error < 5.1e-8 || (error - 360.0).abs() < 5.1e-8);
}

/// A longitude on the wire encodes to itself when it is decoded.
pub fn longitude_numbers_are_exact(number: i32) {
    if number > -1_800_000_000 && number <= 1_800_000_001 {
        assert_eq!(longitude(longitude_degrees(number)), number);
    }
}

/// Every instant has a time stamp in range, later ones have no smaller one, and one within the time
/// scale keeps its instant.
pub fn time_stamps_keep_their_instant(earlier: i64, later: i64) {
    let stamp = timestamp_its(earlier);
    assert!(stamp <= TIMESTAMP_ITS_MAX);
    if earlier <= later {
        assert!(stamp <= timestamp_its(later));
    }
    if stamp > 0 && stamp < TIMESTAMP_ITS_MAX {
        assert!(unix_ms(stamp) == earlier);
    }
}

/// The instant of a time stamp has that time stamp, unless it is within a leap second: then one
/// after it, by less than a second or just that.
pub fn instants_keep_their_time_stamp(stamp: u64) {
    let again = timestamp_its(unix_ms(stamp));
    let stamp = stamp.min(TIMESTAMP_ITS_MAX);
    assert!(again >= stamp && again - stamp <= 1_000);
}

/// A generation time is rebuilt when it is at most half its range away from now.
pub fn generation_times_are_rebuilt(now: u64, age: i16) {
    if !(0x1_0000..=TIMESTAMP_ITS_MAX).contains(&now) {
        return;
    }
    let generated = now.saturating_add_signed(-i64::from(age));
    let rebuilt = rebuild_timestamp(now, generation_delta_time(generated));
    assert_eq!(rebuilt, generated);
}
