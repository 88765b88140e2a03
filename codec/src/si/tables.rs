//! The data elements of TS 102 894-2 v2.4.1 that RAM and RMCM use, and those of RMCM itself.

use super::{Confidence, Element, Ladder, Rounding, Scale};

/// `Latitude`: degrees, north positive. 10^-7 degree, -90..90, nearest; 900000001 unavailable, also
/// for what is beyond a pole.
pub const LATITUDE: Element<i32> =
    Scale::new(1e7, -900_000_000, 900_000_000, Rounding::Nearest).unavailable_beyond(900_000_001);

/// `AltitudeValue`: metres above the WGS84 ellipsoid. 0.01 m, rounded up; -100000 at -1000 m or below,
/// 800000 above 7999.99 m, 800001 unavailable.
pub const ALTITUDE: Element<i32> =
    Scale::new(100.0, -100_000, 800_000, Rounding::Up).with_unavailable(800_001);

/// `DeltaLatitude` and `DeltaLongitude`: degrees. 10^-7 degree, nearest; 131072 unavailable, also for
/// more than 0.0131071 degree.
pub const DELTA_DEGREES: Element<i32> =
    Scale::new(1e7, -131_071, 131_071, Rounding::Nearest).unavailable_beyond(131_072);

/// `DeltaAltitude`: metres. 0.01 m, rounded up; -12700 at -127 m or below, 12799 above 127.98 m, 12800
/// unavailable.
pub const DELTA_ALTITUDE: Element<i16> =
    Scale::new(100.0, -12_700, 12_799, Rounding::Up).with_unavailable(12_800);

/// `SpeedValue`: m/s. 0.01 m/s, rounded up; 16382 above 163.81 m/s, 16383 unavailable.
pub const SPEED: Element<u16> = Scale::new(100.0, 0, 16_382, Rounding::Up).with_unavailable(16_383);

/// `AccelerationValue` and its longitudinal, lateral and vertical kin: m/s². 0.1 m/s², rounded up;
/// -160 at -16 m/s² or below, 160 above 15.9 m/s², 161 unavailable.
pub const ACCELERATION: Element<i16> =
    Scale::new(10.0, -160, 160, Rounding::Up).with_unavailable(161);

/// `CurvatureValue`: 1/m, to the left positive. 10^-4 1/m, rounded up; -1023 at -0.1023 1/m or below,
/// 1022 above 0.1021 1/m, 1023 unavailable.
pub const CURVATURE: Element<i16> =
    Scale::new(10_000.0, -1_023, 1_022, Rounding::Up).with_unavailable(1_023);

/// `YawRateValue`: degrees/s, to the left positive. 0.01 degree/s, rounded up; -32766 at -327.66
/// degrees/s or below, 32766 above 327.65 degrees/s, 32767 unavailable.
pub const YAW_RATE: Element<i16> =
    Scale::new(100.0, -32_766, 32_766, Rounding::Up).with_unavailable(32_767);

/// `ObjectDimensionValue`: metres. 0.1 m, rounded up, at least 1; 255 above 25.4 m, 256 unavailable.
pub const DIMENSION: Element<u16> = Scale::new(10.0, 1, 255, Rounding::Up).with_unavailable(256);

/// `StateOfCharge` of Crossguard-RAM: percent, 0..100, rounded down; 101 unavailable.
pub const STATE_OF_CHARGE: Element<u8> =
    Scale::new(1.0, 0, 100, Rounding::Down).with_unavailable(101);

/// `PathDeltaTime`: seconds. 10 ms, 0.01..655.35 s, nearest.
pub const PATH_DELTA_TIME: Scale<u16> = Scale::new(100.0, 1, 65_535, Rounding::Nearest);

/// `SpeedValue` as the largest speed that a command allows: m/s, as [`SPEED`], but rounded down, so
/// that encoding does not loosen the limit.
pub const MAXIMUM_SPEED: Element<u16> =
    Scale::new(100.0, SPEED.scale.min, SPEED.scale.max, Rounding::Down)
        .with_unavailable(SPEED.unavailable);

/// `StandardLength9b` as the smallest distance that a command allows: metres. 0.1 m, 0..51.1 m,
/// rounded up, so that encoding does not loosen the limit.
pub const MINIMUM_DISTANCE: Scale<u16> = Scale::new(10.0, 0, 511, Rounding::Up);

/// `SemiAxisLength`: metres. 0.01 m; 0 not used, 4094 above 40.93 m, 4095 unavailable.
pub const SEMI_AXIS: Confidence<u16> = Confidence {
    steps_per_unit: 100.0,
    max: 4_093,
    out_of_range: 4_094,
    unavailable: 4_095,
};

/// `CoordinateConfidence`: metres. 0.01 m; 4095 above 40.94 m, 4096 unavailable.
pub const COORDINATE_CONFIDENCE: Confidence<u16> = Confidence {
    steps_per_unit: 100.0,
    max: 4_094,
    out_of_range: 4_095,
    unavailable: 4_096,
};

/// `SpeedConfidence`: m/s. 0.01 m/s; 126 above 1.25 m/s, 127 unavailable.
pub const SPEED_CONFIDENCE: Confidence<u8> = Confidence {
    steps_per_unit: 100.0,
    max: 125,
    out_of_range: 126,
    unavailable: 127,
};

/// `Wgs84AngleConfidence`, `HeadingConfidence` and `AngleConfidence`: degrees. 0.1 degree; 126 above
/// 12.5 degrees, 127 unavailable.
pub const ANGLE_CONFIDENCE: Confidence<u8> = Confidence {
    steps_per_unit: 10.0,
    max: 125,
    out_of_range: 126,
    unavailable: 127,
};

/// `AccelerationConfidence`: m/s². 0.1 m/s²; 0 not used, 101 above 10 m/s², 102 unavailable.
pub const ACCELERATION_CONFIDENCE: Confidence<u8> = Confidence {
    steps_per_unit: 10.0,
    max: 100,
    out_of_range: 101,
    unavailable: 102,
};

/// `AltitudeConfidence`: metres; classes from 0.01 m to 200 m.
pub const ALTITUDE_CONFIDENCE: Ladder = Ladder {
    limits: &[
        0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0,
    ],
};

/// `CurvatureConfidence`: 1/m; classes from 0.00002 to 0.1.
pub const CURVATURE_CONFIDENCE: Ladder = Ladder {
    limits: &[0.00002, 0.0001, 0.0005, 0.002, 0.01, 0.1],
};

/// `YawRateConfidence`: degrees/s; classes from 0.01 to 100.
pub const YAW_RATE_CONFIDENCE: Ladder = Ladder {
    limits: &[0.01, 0.05, 0.1, 1.0, 5.0, 10.0, 100.0],
};
