//! Where a certificate is valid.

use crate::distance::offset;
use crate::state::Position;

/// A place, in units of 10^-7 degree.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Place {
    /// 10^-7 degree, north positive.
    pub latitude: i32,
    /// 10^-7 degree, east positive.
    pub longitude: i32,
}

/// The region of a certificate. IEEE 1609.2 has polygons and countries as well; a certificate with
/// one of these is not taken.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub enum Region {
    /// A circle.
    Circle {
        /// Its centre.
        centre: Place,
        /// Its radius in metres.
        radius: u16,
    },
    /// Rectangles between lines of latitude and longitude, each given by its north-western and its
    /// south-eastern corner.
    Rectangles(Vec<(Place, Place)>),
}

impl Place {
    /// True if there is such a place: latitudes end at the poles, longitudes at the 180th meridian (`Latitude` and
    /// `Longitude` of IEEE 1609.2, without their values for unknown).
    #[must_use]
    pub const fn is_on_earth(self) -> bool {
        self.latitude.unsigned_abs() <= 900_000_000
            && self.longitude.unsigned_abs() <= 1_800_000_000
    }

    /// How far away another place is, in metres along the surface of a sphere: also right for the other side of the
    /// earth, and within 0.5 % of the ellipsoid.
    #[must_use]
    pub fn metres_to(self, other: Self) -> u32 {
        const RADIUS_METRES: f64 = 6_371_000.0;
        let radians = |tenth_microdegrees: i32| (f64::from(tenth_microdegrees) / 1e7).to_radians();
        let (here, there) = (radians(self.latitude), radians(other.latitude));
        let east = radians(other.longitude) - radians(self.longitude);
        // The haversine of the angle between both.
        let north = ((there - here) / 2.0).sin().powi(2);
        let haversine = north + here.cos() * there.cos() * (east / 2.0).sin().powi(2);
        let metres = 2.0 * RADIUS_METRES * haversine.clamp(0.0, 1.0).sqrt().asin();
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "half the circumference at most"
        )]
        let metres = metres as u32;
        metres
    }

    fn position(self) -> Position {
        Position::at(
            f64::from(self.latitude) / 1e7,
            f64::from(self.longitude) / 1e7,
        )
    }
}

impl Region {
    /// True if a place is in it.
    #[must_use]
    pub fn contains(&self, place: Place) -> bool {
        match self {
            Self::Circle { centre, radius } => offset(&centre.position(), &place.position())
                .is_some_and(|(east, north)| east.hypot(north) <= f64::from(*radius)),
            Self::Rectangles(rectangles) => rectangles.iter().any(|(north_west, south_east)| {
                (south_east.latitude..=north_west.latitude).contains(&place.latitude)
                    && (north_west.longitude..=south_east.longitude).contains(&place.longitude)
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HERE: Place = Place {
        latitude: 487_654_321,
        longitude: 91_234_567,
    };

    #[test]
    fn a_circle_ends_at_its_radius() {
        let circle = Region::Circle {
            centre: HERE,
            radius: 100,
        };
        let north = |metres: i32| Place {
            latitude: HERE.latitude + metres * 90,
            ..HERE
        };
        assert!(circle.contains(HERE));
        assert!(circle.contains(north(99)), "90 units are a metre");
        assert!(!circle.contains(north(101)));
        assert!(!circle.contains(north(-5_000)));
    }

    #[test]
    fn the_other_side_of_the_earth_is_half_its_circumference_away() {
        let antipode = Place {
            latitude: -HERE.latitude,
            longitude: HERE.longitude - 1_800_000_000,
        };
        assert!((20_000_000..20_030_000).contains(&HERE.metres_to(antipode)));
        let north = Place {
            latitude: HERE.latitude + 900_000,
            ..HERE
        };
        assert!((9_990..10_020).contains(&HERE.metres_to(north)));
        assert_eq!(HERE.metres_to(HERE), 0);
        // Across the 180th meridian.
        let [west, east] =
            [-1_799_999_999, 1_799_999_999].map(|longitude| Place { longitude, ..HERE });
        assert!(west.metres_to(east) < 2);
    }

    #[test]
    fn latitudes_end_at_the_poles() {
        let place = |latitude, longitude| Place {
            latitude,
            longitude,
        };
        assert!(place(900_000_000, -1_800_000_000).is_on_earth());
        for nowhere in [
            place(900_000_001, 0),
            place(2_000_000_000, 0),
            place(i32::MIN, 0),
            place(0, 1_800_000_001),
        ] {
            assert!(!nowhere.is_on_earth());
        }
    }

    #[test]
    fn a_rectangle_has_four_sides() {
        let place = |latitude, longitude| Place {
            latitude,
            longitude,
        };
        let region = Region::Rectangles(vec![(place(10, -10), place(-10, 10))]);
        assert!(region.contains(place(10, 10)) && region.contains(place(-10, -10)));
        for outside in [place(11, 0), place(-11, 0), place(0, 11), place(0, -11)] {
            assert!(!region.contains(outside));
        }
    }
}
