//! Whether a place is in a destination area (EN 302 931).

#[cfg(not(feature = "std"))]
#[allow(unused_imports, reason = "another crate may link the standard library")]
use num_traits::Float as _;

use super::{Area, Shape};
use crate::distance::offset;
use crate::state::Position;

impl Area {
    /// Whether the place at this latitude and longitude, in 10^-7 degree, is in the area or on its
    /// border. An area without extent holds nothing but its centre.
    #[must_use]
    pub fn contains(&self, latitude: i32, longitude: i32) -> bool {
        let place = |latitude: i32, longitude: i32| {
            Position::at(f64::from(latitude) / 1e7, f64::from(longitude) / 1e7)
        };
        let centre = place(self.latitude, self.longitude);
        let Some((east, north)) = offset(&centre, &place(latitude, longitude)) else {
            return false;
        };
        // Along the long side or axis, which points `angle` degrees clockwise from north, and across.
        let (sine, cosine) = f64::from(self.angle).to_radians().sin_cos();
        let along = east * sine + north * cosine;
        let across = east * cosine - north * sine;
        let (a, b) = (f64::from(self.distance_a), f64::from(self.distance_b));
        match self.shape {
            Shape::Circle => east.hypot(north) <= a,
            Shape::Rectangle => along.abs() <= a && across.abs() <= b,
            // Multiplied out, so that nothing is divided by zero.
            Shape::Ellipse => {
                (along * b).powi(2) + (across * a).powi(2) <= (a * b).powi(2)
                    && along.abs() <= a
                    && across.abs() <= b
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 1.1 m of latitude, and 0.73 m of longitude at 48.7 degrees.
    const STEP: i32 = 100;

    fn area(shape: Shape, distance_a: u16, distance_b: u16, angle: u16) -> Area {
        Area {
            shape,
            latitude: 487_654_321,
            longitude: 91_234_567,
            distance_a,
            distance_b,
            angle,
        }
    }

    /// Whether the place this many steps north and east of the centre is in the area.
    fn holds(area: &Area, north: i32, east: i32) -> bool {
        area.contains(area.latitude + north * STEP, area.longitude + east * STEP)
    }

    #[test]
    fn a_circle_reaches_as_far_in_every_direction() {
        let circle = area(Shape::Circle, 100, 0, 0);
        for (north, east) in [(0, 0), (89, 0), (-89, 0), (0, 135), (0, -135), (63, 95)] {
            assert!(holds(&circle, north, east), "{north} {east}");
        }
        for (north, east) in [(91, 0), (0, 138), (66, 99)] {
            assert!(!holds(&circle, north, east), "{north} {east}");
        }
    }

    #[test]
    fn the_long_side_points_where_the_angle_says() {
        for shape in [Shape::Rectangle, Shape::Ellipse] {
            let to_the_north = area(shape, 100, 10, 0);
            assert!(holds(&to_the_north, 80, 0) && !holds(&to_the_north, 0, 80));
            let to_the_east = area(shape, 100, 10, 90);
            assert!(!holds(&to_the_east, 80, 0) && holds(&to_the_east, 0, 80));
        }
    }

    #[test]
    fn a_rectangle_has_corners_and_an_ellipse_has_none() {
        assert!(holds(&area(Shape::Rectangle, 100, 100, 0), 85, 128));
        assert!(!holds(&area(Shape::Ellipse, 100, 100, 0), 85, 128));
    }

    #[test]
    fn an_area_without_extent_holds_its_centre() {
        for shape in [Shape::Circle, Shape::Rectangle, Shape::Ellipse] {
            let point = area(shape, 0, 0, 0);
            assert!(holds(&point, 0, 0) && !holds(&point, 1, 0), "{shape:?}");
        }
        let line = area(Shape::Ellipse, 100, 0, 0);
        assert!(holds(&line, 50, 0) && !holds(&line, 50, 10) && !holds(&line, 95, 0));
    }
}
