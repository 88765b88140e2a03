//! Where a station is and how it moves, on a plane in metres; what counts as a change of that.

#[cfg(not(feature = "std"))]
#[allow(unused_imports, reason = "another crate may link the standard library")]
use num_traits::Float as _;

use crossguard_codec::{Measurement, Position, RobotState};
use crossguard_protocol::Decimetres;

/// A place on the plane: metres to the east and to the north of its origin.
pub type Point = [f64; 2];

/// A station slower than this stands, in m/s: a heading is noise there.
pub const STANDING_MPS: f64 = 0.3;

/// Distance between two places, in metres.
#[must_use]
pub fn distance_m(a: Point, b: Point) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// Where a station is and how it moves.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Motion {
    /// Where it is.
    pub position_m: Point,
    /// Speed over ground in m/s, not negative.
    pub speed_mps: f64,
    /// Direction of motion, in degrees clockwise from north, 0..360.
    pub heading_deg: f64,
}

impl Motion {
    /// The velocity, in m/s to the east and to the north.
    #[must_use]
    pub fn velocity_mps(&self) -> [f64; 2] {
        let (sine, cosine) = self.heading_deg.to_radians().sin_cos();
        [self.speed_mps * sine, self.speed_mps * cosine]
    }
}

/// The smaller angle between two directions, in degrees, 0..180.
#[must_use]
pub fn turn_deg(from_deg: f64, to_deg: f64) -> f64 {
    let turn = (from_deg - to_deg).abs() % 360.0;
    turn.min(360.0 - turn)
}

/// By how much two motions may differ and still be alike.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Likeness {
    /// Largest difference of speed, in m/s.
    pub speed_mps: f64,
    /// Largest angle between the two directions, in degrees, 0..180.
    pub heading_deg: f64,
}

impl Likeness {
    /// Whether two velocities, in m/s to the east and to the north, are alike. A velocity below
    /// [`STANDING_MPS`] has no direction that counts: then the difference of the two velocities does.
    #[must_use]
    pub fn holds(&self, a: [f64; 2], b: [f64; 2]) -> bool {
        let (of_a, of_b) = (a[0].hypot(a[1]), b[0].hypot(b[1]));
        if of_a.min(of_b) < STANDING_MPS {
            return distance_m(a, b) <= self.speed_mps;
        }
        let heading_deg = |[east, north]: [f64; 2]| east.atan2(north).to_degrees();
        (of_a - of_b).abs() <= self.speed_mps
            && turn_deg(heading_deg(a), heading_deg(b)) <= self.heading_deg
    }
}

/// By how much the motion of somebody and that of the cluster around them may differ, for them to be a member: the
/// speed by what triggers a VAM, the direction by what a sensor and a stride err.
pub const MATCH: Likeness = Likeness {
    speed_mps: 0.5,
    heading_deg: 20.0,
};

/// Change since a message was sent; `None` where one of the two values is not known.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Change {
    /// Distance between the two places, in metres.
    pub distance_m: Option<f64>,
    /// Smaller angle between the two headings, in degrees.
    pub turn_deg: Option<f64>,
    /// Difference between the two speeds, in m/s, not negative.
    pub speed_mps: Option<f64>,
}

impl Change {
    /// Change between two motions.
    #[must_use]
    pub fn of_motion(before: &Motion, after: &Motion) -> Self {
        Self {
            distance_m: Some(distance_m(before.position_m, after.position_m)),
            turn_deg: Some(turn_deg(before.heading_deg, after.heading_deg)),
            speed_mps: Some((before.speed_mps - after.speed_mps).abs()),
        }
    }

    /// Change between two states of a robot. The distance is exact to 0.1 m.
    #[must_use]
    pub fn of_robot(before: &RobotState, after: &RobotState) -> Self {
        let both = |a: Option<Measurement>, b: Option<Measurement>| Some((a?.value, b?.value));
        let moved = crossguard_codec::distance(&before.position, &after.position);
        Self {
            distance_m: (moved != Decimetres::UNKNOWN).then(|| f64::from(moved.0) / 10.0),
            turn_deg: both(before.heading, after.heading).map(|(a, b)| turn_deg(a, b)),
            speed_mps: both(before.speed, after.speed).map(|(a, b)| (a - b).abs()),
        }
    }
}

/// A plane that touches the WGS84 ellipsoid: degrees to metres and back. Within a kilometre of its
/// origin it is exact to a few centimetres up to latitudes of 70 degrees.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Plane {
    latitude: f64,
    longitude: f64,
    metres_per_degree: [f64; 2],
}

impl Plane {
    /// The plane whose origin is at a latitude and longitude, in degrees.
    #[must_use]
    pub fn at(latitude: f64, longitude: f64) -> Self {
        const EQUATOR_RADIUS_M: f64 = 6_378_137.0;
        const ECCENTRICITY_SQUARED: f64 = 6.694_379_990_141_3e-3;
        let (sine, cosine) = latitude.to_radians().sin_cos();
        let flattening = 1.0 - ECCENTRICITY_SQUARED * sine * sine;
        let across = EQUATOR_RADIUS_M / flattening.sqrt();
        let along = across * (1.0 - ECCENTRICITY_SQUARED) / flattening;
        let metres_per_degree = [across * cosine.max(1e-6), along].map(|r| r * 1_f64.to_radians());
        Self {
            latitude,
            longitude,
            metres_per_degree,
        }
    }

    /// The plane whose origin is at this position; `None` when that is not known, or no number.
    #[must_use]
    pub fn around(position: &Position) -> Option<Self> {
        let [latitude, longitude] = degrees(position)?;
        Some(Self::at(latitude, longitude))
    }

    /// Latitude and longitude of a place, in degrees.
    #[must_use]
    pub fn position(&self, [east, north]: Point) -> Position {
        let [across, along] = self.metres_per_degree;
        Position::at(
            self.latitude + north / along,
            self.longitude + east / across,
        )
    }

    /// The place of a position; `None` when it is not known, or no number.
    #[must_use]
    pub fn point(&self, position: &Position) -> Option<Point> {
        let [across, along] = self.metres_per_degree;
        let [latitude, longitude] = degrees(position)?;
        let east = (longitude - self.longitude) * across;
        Some([east, (latitude - self.latitude) * along])
    }
}

/// Latitude and longitude in degrees, if both are known and finite.
#[must_use]
pub fn degrees(position: &Position) -> Option<[f64; 2]> {
    let both = [position.latitude?, position.longitude?];
    both.iter().all(|it| it.is_finite()).then_some(both)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plane_leads_there_and_back() {
        let plane = Plane::at(49.0, 8.4);
        let there = plane.position([120.0, -35.0]);
        let back = plane.point(&there).unwrap();
        assert!(distance_m(back, [120.0, -35.0]) < 1e-6);
        let metres = crossguard_codec::distance(&Position::at(49.0, 8.4), &there);
        assert_eq!(metres, Decimetres(1_250));
    }

    #[test]
    fn motions_are_alike_in_speed_and_in_direction() {
        let alike = |a, b| {
            let likeness = Likeness {
                speed_mps: 0.5,
                heading_deg: 20.0,
            };
            likeness.holds(a, b) && likeness.holds(b, a)
        };
        assert!(alike([0.0, 1.4], [0.3, 1.2]));
        // As fast, to the east and to the north; the same way, and faster; back and forth.
        assert!(!alike([0.0, 1.4], [1.4, 0.0]));
        assert!(!alike([0.0, 1.4], [0.0, 5.0]));
        assert!(!alike([0.0, 1.4], [0.0, -1.4]));
        // Two that hardly move, whatever their sensor says of the direction.
        assert!(alike([0.0, 0.1], [0.1, -0.1]));
        assert!(!alike([0.0, 0.0], [0.0, 1.4]));
    }

    #[test]
    fn a_velocity_points_where_the_heading_does() {
        let east = Motion {
            speed_mps: 2.0,
            heading_deg: 90.0,
            ..Motion::default()
        };
        assert!(distance_m(east.velocity_mps(), [2.0, 0.0]) < 1e-9);
        assert!((turn_deg(359.0, 3.0) - 4.0).abs() < 1e-9);
    }
}
