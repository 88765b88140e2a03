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
    fn position(self) -> Position {
        Position::at(
            f64::from(self.latitude) / 1e7,
            f64::from(self.longitude) / 1e7,
        )
    }
}

impl Region {
    /// Whether a place is in it.
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
