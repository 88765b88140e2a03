//! The SI conversions at their edges. Their laws are in `si::laws`, which the `proofs` crate calls.

use crossguard_codec::si;

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
