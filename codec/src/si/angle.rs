//! Quantities that go round: headings and longitudes.

use super::{Rounding, Scale};

/// Number for an unavailable angle.
const ANGLE_UNAVAILABLE: u16 = 3_601;
/// Steps of a full turn; as a number it is not used.
const FULL_TURN: u16 = 3_600;

const ANGLE: Scale<u16> = Scale::new(10.0, 0, FULL_TURN, Rounding::Nearest);

/// The number that stands for an angle in degrees: `Wgs84AngleValue` and `HeadingValue` clockwise from
/// north, `CartesianAngleValue` counter-clockwise from the x axis.
///
/// 0.1 degree, nearest, modulo a full turn: 359.96 degrees are 0. `None`, NaN and infinities are 3601,
/// unavailable.
#[must_use]
pub fn angle(degrees: Option<f64>) -> u16 {
    let Some(degrees) = degrees.filter(|degrees| degrees.is_finite()) else {
        return ANGLE_UNAVAILABLE;
    };
    let within = if (0.0..360.0).contains(&degrees) {
        degrees
    } else {
        let remainder = degrees % 360.0;
        if remainder < 0.0 {
            remainder + 360.0
        } else {
            remainder
        }
    };
    match ANGLE.encode(within) {
        Some(FULL_TURN) => 0,
        Some(number) => number,
        None => ANGLE_UNAVAILABLE,
    }
}

/// The angle in degrees, 0..359.9, that `number` stands for; `None` for 3600, which is not used, and
/// 3601, unavailable.
#[must_use]
pub fn angle_degrees(number: u16) -> Option<f64> {
    (number < FULL_TURN).then(|| ANGLE.decode(number))
}

/// Number for an unavailable longitude.
const LONGITUDE_UNAVAILABLE: i32 = 1_800_000_001;
/// The antimeridian; with a minus sign it is not used.
const ANTIMERIDIAN: i32 = 1_800_000_000;

const LONGITUDE: Scale<i32> = Scale::new(1e7, -ANTIMERIDIAN, ANTIMERIDIAN, Rounding::Nearest);

/// The number that stands for a longitude in degrees, east positive: `Longitude`.
///
/// 10^-7 degree, nearest. -180 is 180. `None`, NaN and what is outside of -180..180 are 1800000001,
/// unavailable.
#[must_use]
pub fn longitude(degrees: Option<f64>) -> i32 {
    match degrees
        .filter(|&degrees| LONGITUDE.covers(degrees))
        .and_then(|d| LONGITUDE.encode(d))
    {
        None => LONGITUDE_UNAVAILABLE,
        Some(number) if number == -ANTIMERIDIAN => ANTIMERIDIAN,
        Some(number) => number,
    }
}

/// The longitude in degrees that `number` stands for; `None` for 1800000001, unavailable.
#[must_use]
pub fn longitude_degrees(number: i32) -> Option<f64> {
    (number != LONGITUDE_UNAVAILABLE).then(|| LONGITUDE.decode(number))
}
