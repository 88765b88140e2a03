//! Distance between two robots.

#[cfg(not(feature = "std"))]
#[allow(unused_imports, reason = "another crate may link the standard library")]
use num_traits::Float as _;

use crossguard_protocol::Decimetres;

use crate::state::Position;

/// Half axis of the WGS84 ellipsoid at the equator, in metres.
const EQUATOR_RADIUS: f64 = 6_378_137.0;
/// Square of its first eccentricity.
const ECCENTRICITY_SQUARED: f64 = 6.694_379_990_141_3e-3;

/// Horizontal distance between two positions, rounded to decimetres; unknown when a position is, or
/// from 6553.5 m on.
///
/// It uses additions, multiplications, divisions and square roots only, so it is the same on every
/// machine, and so is what the protocol decides by it. Within its range it is exact to a decimetre up
/// to latitudes of 85 degrees.
#[must_use]
pub fn distance(from: &Position, to: &Position) -> Decimetres {
    let metres = offset(from, to).map(|(x, y)| (x * x + y * y).sqrt());
    let metres = metres.filter(|&metres| metres < 6_553.45);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "within range"
    )]
    metres.map_or(Decimetres::UNKNOWN, |metres| {
        Decimetres((metres * 10.0 + 0.5) as u16)
    })
}

/// How many metres `to` is east and north of `from`.
pub(crate) fn offset(from: &Position, to: &Position) -> Option<(f64, f64)> {
    let (south, north) = (from.latitude?, to.latitude?);
    let mut east = to.longitude? - from.longitude?;
    if east > 180.0 {
        east -= 360.0;
    } else if east < -180.0 {
        east += 360.0;
    }
    // Half way between the two.
    let (across, along) = metres_per_radian(f64::midpoint(south, north));
    Some((
        east.to_radians() * across,
        (north - south).to_radians() * along,
    ))
}

/// The position this many metres east and north of another one, and as exact as that; for distances of a street.
#[cfg(feature = "std")]
pub(crate) fn moved(from: &Position, east: f64, north: f64) -> Position {
    let latitude = from.latitude.map(|south| {
        let (_, along) = metres_per_radian(south);
        south + (north / along).to_degrees()
    });
    let longitude = from.latitude.zip(from.longitude).map(|(south, west)| {
        let (across, _) = metres_per_radian(south);
        west + (east / across).to_degrees()
    });
    // At a pole there is no east.
    let on_earth = |degrees: &f64| degrees.abs() <= 180.0;
    Position {
        latitude: latitude.filter(on_earth),
        longitude: longitude.filter(on_earth),
        ellipse: from.ellipse,
        ..Position::default()
    }
}

/// Metres of a radian along the parallel and along the meridian at a latitude.
fn metres_per_radian(latitude: f64) -> (f64, f64) {
    let cosine = cosine(latitude);
    let flattening = 1.0 - ECCENTRICITY_SQUARED * (1.0 - cosine * cosine);
    let across = EQUATOR_RADIUS / flattening.sqrt();
    let along = across * (1.0 - ECCENTRICITY_SQUARED) / flattening;
    (across * cosine, along)
}

/// Cosine of an angle of at most 90 degrees by its series, exact to 10^-9.
fn cosine(degrees: f64) -> f64 {
    let square = degrees.to_radians() * degrees.to_radians();
    let terms: [f64; 8] = [2.0, 12.0, 30.0, 56.0, 90.0, 132.0, 182.0, 240.0];
    terms
        .iter()
        .rev()
        .fold(1.0, |rest, divisor| 1.0 - square / divisor * rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_distance_is_that_on_the_ellipsoid() {
        // 0.001 degrees of latitude and of longitude at 48.7654321 N: 111.205 m and 73.515 m.
        let here = Position::at(48.765_432_1, 9.123_456_7);
        let north = Position::at(48.766_432_1, 9.123_456_7);
        let east = Position::at(48.765_432_1, 9.124_456_7);
        assert_eq!(distance(&here, &north), Decimetres(1_112));
        assert_eq!(distance(&here, &east), Decimetres(735));
        assert_eq!(distance(&east, &north), distance(&north, &east));
    }

    #[test]
    fn who_moves_is_as_far_as_that() {
        let here = Position::at(48.765_432_1, 9.123_456_7);
        assert_eq!(distance(&here, &moved(&here, 30.0, -40.0)), Decimetres(500));
        let pole = moved(&Position::at(90.0, 0.0), 100.0, 0.0);
        assert_eq!(pole.longitude, None);
    }

    #[test]
    fn the_same_place_is_at_no_distance() {
        let here = Position::at(-33.0, 180.0);
        assert_eq!(distance(&here, &here), Decimetres(0));
        assert_eq!(distance(&here, &Position::at(-33.0, -180.0)), Decimetres(0));
    }

    #[test]
    fn what_is_unknown_or_far_away_is_at_unknown_distance() {
        let here = Position::at(48.0, 9.0);
        assert_eq!(distance(&here, &Position::default()), Decimetres::UNKNOWN);
        assert_eq!(
            distance(&here, &Position::at(48.1, 9.0)),
            Decimetres::UNKNOWN
        );
        assert_eq!(
            distance(&here, &Position::at(f64::NAN, 9.0)),
            Decimetres::UNKNOWN
        );
        assert_eq!(
            distance(&here, &Position::at(48.058, 9.0)),
            Decimetres(64_491)
        );
    }

    #[test]
    fn the_cosine_is_exact_enough() {
        for degrees in -90..=90 {
            let degrees = f64::from(degrees);
            assert!(
                (cosine(degrees) - degrees.to_radians().cos()).abs() < 1e-9,
                "{degrees}"
            );
        }
    }
}
