//! A street corner in metres, and where on earth it is.

use crossguard_codec::{ConfidenceEllipse, MapPlace, Position, Target};
use crossguard_protocol as protocol;

use crate::located::{NEAR_M, Number};

/// A place in metres east and north of the site's origin.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Place {
    /// Metres to the east.
    pub east: f64,
    /// Metres to the north.
    pub north: f64,
}

impl Place {
    /// The place this many metres east and north of the origin.
    #[must_use]
    pub const fn new(east: f64, north: f64) -> Self {
        Self { east, north }
    }

    /// Distance in metres.
    #[must_use]
    pub fn distance(self, other: Self) -> f64 {
        (other.east - self.east).hypot(other.north - self.north)
    }

    /// Direction in degrees clockwise from north; 0 towards itself.
    #[must_use]
    pub fn bearing(self, other: Self) -> f64 {
        (other.east - self.east)
            .atan2(other.north - self.north)
            .to_degrees()
            .rem_euclid(360.0)
    }

    /// The place `distance` metres from here on the way to `other`.
    #[must_use]
    pub fn towards(self, other: Self, distance: f64) -> Self {
        let whole = self.distance(other);
        if whole == 0.0 {
            return other;
        }
        let part = distance / whole;
        Self {
            east: self.east + (other.east - self.east) * part,
            north: self.north + (other.north - self.north) * part,
        }
    }
}

/// Where the origin of a site is, in degrees.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Site {
    /// Latitude of the origin, in degrees, north positive.
    pub latitude: f64,
    /// Longitude of the origin, in degrees, east positive.
    pub longitude: f64,
    /// The crossing that requests for help are for; [`UNKNOWN`](protocol::Place::UNKNOWN) may be any.
    pub crossing: protocol::Place,
    /// The road segment or intersection of the map that commands name, if they name one.
    pub map_place: Option<MapPlace>,
}

impl Default for Site {
    /// A street corner in Karlsruhe, at a crossing without a reference.
    fn default() -> Self {
        Self {
            latitude: 49.010_1,
            longitude: 8.412_4,
            crossing: protocol::Place::UNKNOWN,
            map_place: None,
        }
    }
}

/// A text that names no crossing.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error(
    "'{0}' is no crossing: road regulator and intersection are wanted, each from 0 to 65535 and not both 0, \
     like '276:4711'"
)]
pub struct NoCrossing(String);

/// A crossing as files name it, by road regulator and intersection, like `276:4711`: its reference, and the place of
/// the map.
pub(crate) fn crossing_named(text: &str) -> Result<(protocol::Place, MapPlace), NoCrossing> {
    let number = |text: &str| text.parse::<u16>().ok();
    let halves = text.split_once(':');
    let halves = halves.and_then(|(region, id)| Some((number(region)?, number(id)?)));
    let Some((region, id)) = halves.filter(|it| *it != (0, 0)) else {
        return Err(NoCrossing(text.to_owned()));
    };
    let reference = protocol::Place(u32::from(region) << 16 | u32::from(id));
    let region = Some(region);
    Ok((reference, MapPlace::Intersection { region, id }))
}

/// Metres per degree of latitude, and of longitude at the equator, on a sphere; within 0.6 % of the
/// ellipsoid, which is more than a simulated site needs.
const METRES_PER_DEGREE: f64 = 111_195.0;

/// How far off the place of somebody simulated may be, in metres.
pub(crate) const SIMULATED_ERROR_M: f64 = 0.2;

/// Degrees that are no origin of a site.
#[derive(Clone, Copy, PartialEq, Debug, thiserror::Error)]
#[error(
    "{}, {} is no latitude and longitude in degrees: at most 85 and 180 are wanted, and {NEAR_M} m or more to the \
     180th meridian",
    Number(.0), Number(.1)
)]
pub struct NoOrigin(f64, f64);

impl Site {
    /// A site with this origin, in degrees, at a crossing without a reference. All places of it are on one side of the
    /// 180th meridian.
    pub(crate) fn at(latitude: f64, longitude: f64) -> Result<Self, NoOrigin> {
        let site = Self {
            latitude,
            longitude,
            ..Self::default()
        };
        let farthest = Place::new(NEAR_M.copysign(longitude), 0.0);
        if (-85.0..=85.0).contains(&latitude) && site.coordinates(farthest).1.abs() < 180.0 {
            Ok(site)
        } else {
            Err(NoOrigin(latitude, longitude))
        }
    }

    /// Latitude and longitude of a place, in degrees.
    #[must_use]
    pub fn coordinates(&self, place: Place) -> (f64, f64) {
        let latitude = self.latitude + place.north / METRES_PER_DEGREE;
        let shrink = self.latitude.to_radians().cos();
        (
            latitude,
            self.longitude + place.east / (METRES_PER_DEGREE * shrink),
        )
    }

    /// The place at a latitude and longitude in degrees.
    #[must_use]
    pub fn place(&self, latitude: f64, longitude: f64) -> Place {
        let shrink = self.latitude.to_radians().cos();
        Place {
            east: (longitude - self.longitude) * METRES_PER_DEGREE * shrink,
            north: (latitude - self.latitude) * METRES_PER_DEGREE,
        }
    }

    /// A place as a RAM tells it, known to 20 cm: that of somebody simulated.
    #[must_use]
    pub fn position(&self, place: Place) -> Position {
        self.position_within(place, Some(SIMULATED_ERROR_M))
    }

    /// The same, known to so many metres, or nobody knows to how many.
    #[must_use]
    pub fn position_within(&self, place: Place, error_m: Option<f64>) -> Position {
        let (latitude, longitude) = self.coordinates(place);
        Position {
            ellipse: error_m.map(|radius| ConfidenceEllipse {
                semi_major: radius,
                semi_minor: radius,
                orientation: 0.0,
            }),
            ..Position::at(latitude, longitude)
        }
    }

    /// Where the target of a command is, if it names a place.
    #[must_use]
    pub fn place_of(&self, target: Option<Target>) -> Option<Place> {
        match target {
            Some(Target::Position {
                latitude,
                longitude,
                ..
            }) => Some(self.place(latitude, longitude)),
            _ => None,
        }
    }

    /// A place as the target of a command.
    #[must_use]
    pub fn target(&self, place: Place) -> Target {
        let (latitude, longitude) = self.coordinates(place);
        Target::Position {
            latitude,
            longitude,
            altitude: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_comes_back_from_its_coordinates() {
        let site = Site::default();
        let place = Place::new(12.5, -3.25);
        let (latitude, longitude) = site.coordinates(place);
        assert!(site.place(latitude, longitude).distance(place) < 1e-6);
    }

    #[test]
    fn the_codec_measures_the_distances_of_the_site() {
        let site = Site::default();
        let (here, there) = (Place::new(0.0, 0.0), Place::new(30.0, 40.0));
        let measured = crossguard_codec::distance(&site.position(here), &site.position(there));
        assert!(
            (f64::from(measured.0) / 10.0 - 50.0).abs() < 0.5,
            "{measured:?}"
        );
    }

    #[test]
    fn a_crossing_is_named_as_it_reads() {
        let (reference, intersection) = crossing_named("276:4711").unwrap();
        assert_eq!(reference.to_string(), "276:4711");
        assert_eq!(Ok(intersection), "intersection 276:4711".parse());
        for text in ["", "276", "0:0", "276:65536", "a:b", "1:2:3"] {
            assert!(crossing_named(text).is_err(), "{text}");
        }
    }

    #[test]
    fn bearings_go_clockwise_from_north() {
        let origin = Place::default();
        for (place, bearing) in [
            (Place::new(0.0, 1.0), 0.0),
            (Place::new(1.0, 0.0), 90.0),
            (Place::new(0.0, -1.0), 180.0),
            (Place::new(-1.0, 0.0), 270.0),
        ] {
            assert!((origin.bearing(place) - bearing).abs() < 1e-9);
        }
    }
}
