//! Area around a cluster of road users: a circle, a rectangle or a polygon on the plane, and the same
//! on the wire (TS 102 894-2 `Shape` as `VruClusterInformation` restricts it).
//!
//! On the wire an area is relative to the sender's reference position: centimetres to the east and
//! to the north, lengths in decimetres, angles counter-clockwise from east.

use crossguard_codec::core::cdd::{
    CartesianAngleValue, CartesianCoordinate, CartesianPosition3d, CircularShape, RectangularShape,
    Shape, StandardLength12b,
};

use super::motion::{Point, distance_m};

/// Largest loss of an area by rounding on the wire, in metres.
const ROUNDING_M: f64 = 0.05;

/// An area on the plane.
#[derive(Clone, PartialEq, Debug)]
pub enum Area {
    /// A circle.
    Circle {
        /// Its centre.
        center: Point,
        /// Its radius, in metres.
        radius_m: f64,
    },
    /// A rectangle.
    Rectangle {
        /// Its centre.
        center: Point,
        /// Half of its sides, in metres.
        half_m: [f64; 2],
        /// Direction of the first side, in radians counter-clockwise from east.
        direction_rad: f64,
    },
    /// A polygon, by its corners.
    Polygon(Vec<Point>),
}

impl Area {
    /// The smaller one of a circle and a rectangle that hold all `points` with `margin_m` around them;
    /// `None` when there are none.
    #[must_use]
    pub fn around(points: &[Point], margin_m: f64) -> Option<Self> {
        let circle = circle_around(points)?.grown(margin_m);
        let smallest = hull(points)
            .windows(2)
            .map(|side| rectangle_along(side[0], side[1], points).grown(margin_m))
            .min_by(|a, b| a.size_m2().total_cmp(&b.size_m2()))
            .filter(|rectangle| rectangle.size_m2() < circle.size_m2());
        Some(smallest.unwrap_or(circle))
    }

    /// The area with `margin_m` more on every side. A polygon stays as it is.
    #[must_use]
    pub fn grown(self, margin_m: f64) -> Self {
        match self {
            Self::Circle { center, radius_m } => Self::Circle {
                center,
                radius_m: radius_m + margin_m,
            },
            Self::Rectangle {
                center,
                half_m,
                direction_rad,
            } => Self::Rectangle {
                center,
                half_m: half_m.map(|half| half + margin_m),
                direction_rad,
            },
            polygon @ Self::Polygon(_) => polygon,
        }
    }

    /// Its size in square metres.
    #[must_use]
    pub fn size_m2(&self) -> f64 {
        match self {
            Self::Circle { radius_m, .. } => std::f64::consts::PI * radius_m * radius_m,
            Self::Rectangle { half_m, .. } => 4.0 * half_m[0] * half_m[1],
            Self::Polygon(corners) => {
                let sum: f64 = sides(corners).map(|(a, b)| cross(a, b)).sum();
                sum.abs() / 2.0
            }
        }
    }

    /// How far outside of it a place is, in metres; 0 inside and on the edge.
    #[must_use]
    pub fn distance_m(&self, point: Point) -> f64 {
        match self {
            Self::Circle { center, radius_m } => (distance_m(*center, point) - radius_m).max(0.0),
            Self::Rectangle {
                center,
                half_m,
                direction_rad,
            } => {
                let [along, across] = turned(minus(point, *center), -direction_rad);
                let beyond = |offset: f64, half: f64| (offset.abs() - half).max(0.0);
                beyond(along, half_m[0]).hypot(beyond(across, half_m[1]))
            }
            Self::Polygon(corners) if is_inside(corners, point) => 0.0,
            Self::Polygon(corners) => sides(corners)
                .map(|(a, b)| distance_to_side_m(a, b, point))
                .fold(f64::INFINITY, f64::min),
        }
    }

    /// Whether a place is in it or on its edge.
    #[must_use]
    pub fn contains(&self, point: Point) -> bool {
        self.distance_m(point) <= 0.0
    }

    /// The same area, moved by a vector.
    #[must_use]
    pub fn moved(self, by: Point) -> Self {
        let plus = |point: Point| [point[0] + by[0], point[1] + by[1]];
        match self {
            Self::Circle { center, radius_m } => Self::Circle {
                center: plus(center),
                radius_m,
            },
            Self::Rectangle {
                center,
                half_m,
                direction_rad,
            } => Self::Rectangle {
                center: plus(center),
                half_m,
                direction_rad,
            },
            Self::Polygon(corners) => Self::Polygon(corners.into_iter().map(plus).collect()),
        }
    }

    /// The area on the wire, as seen from `reference`. It is never smaller than this one.
    #[must_use]
    pub fn to_wire(&self, reference: Point) -> Shape {
        // Without one, the reference position itself is meant.
        let origin = place([0.0, 0.0]);
        let place =
            |center: &Point| Some(place(minus(*center, reference))).filter(|it| *it != origin);
        match self {
            Self::Circle { center, radius_m } => Shape::Circular(CircularShape {
                shape_reference_point: place(center),
                radius: decimetres(*radius_m),
                height: None,
            }),
            Self::Rectangle {
                center,
                half_m,
                direction_rad,
            } => {
                let tenths = (direction_rad.to_degrees().rem_euclid(360.0) * 10.0).round();
                Shape::Rectangular(RectangularShape {
                    shape_reference_point: place(center),
                    semi_length: decimetres(half_m[0]),
                    semi_breadth: decimetres(half_m[1]),
                    orientation: Some(CartesianAngleValue::saturating(whole(tenths % 3_600.0))),
                    height: None,
                })
            }
            // This crate makes circles and rectangles; a polygon is passed on as its circle.
            Self::Polygon(corners) => match circle_around(corners) {
                Some(circle) => circle.to_wire(reference),
                None => Shape::Circular(CircularShape {
                    shape_reference_point: None,
                    radius: decimetres(0.0),
                    height: None,
                }),
            },
        }
    }

    /// The area that a shape from `reference` means.
    #[must_use]
    pub fn of_wire(shape: &Shape, reference: Point) -> Self {
        let center = |it: Option<CartesianPosition3d>| it.map_or([0.0, 0.0], point_of);
        let area = match shape {
            Shape::Circular(circle) => Self::Circle {
                center: center(circle.shape_reference_point),
                radius_m: metres(circle.radius),
            },
            Shape::Rectangular(rectangle) => Self::Rectangle {
                center: center(rectangle.shape_reference_point),
                half_m: [
                    metres(rectangle.semi_length),
                    metres(rectangle.semi_breadth),
                ],
                direction_rad: rectangle
                    .orientation
                    .map_or(0.0, |angle| (f64::from(angle.get()) / 10.0).to_radians()),
            },
            Shape::Polygonal(polygon) => {
                let origin = center(polygon.shape_reference_point);
                let corners = polygon.polygon.iter().copied().map(point_of);
                Self::Polygon(
                    corners
                        .map(|[x, y]| [x + origin[0], y + origin[1]])
                        .collect(),
                )
            }
        };
        area.moved(reference)
    }
}

/// How far a shape reaches from its middle, in metres; a polygon from its reference point.
pub(crate) fn extent_m(shape: &Shape) -> f64 {
    match shape {
        Shape::Circular(circle) => metres(circle.radius),
        Shape::Rectangular(sides) => metres(sides.semi_length).hypot(metres(sides.semi_breadth)),
        Shape::Polygonal(polygon) => {
            let corners = polygon.polygon.iter().copied().map(point_of);
            corners.map(|[x, y]| x.hypot(y)).fold(0.0, f64::max)
        }
    }
}

fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn turned([x, y]: Point, by_rad: f64) -> Point {
    let (sine, cosine) = by_rad.sin_cos();
    [x * cosine - y * sine, x * sine + y * cosine]
}

fn sides(corners: &[Point]) -> impl Iterator<Item = (Point, Point)> {
    let next = corners.iter().cycle().skip(1);
    corners.iter().copied().zip(next.copied())
}

fn is_inside(corners: &[Point], [x, y]: Point) -> bool {
    let crossings = sides(corners).filter(|&([ax, ay], [bx, by])| {
        (ay > y) != (by > y) && x < (bx - ax) * (y - ay) / (by - ay) + ax
    });
    crossings.count() % 2 == 1
}

fn distance_to_side_m(a: Point, b: Point, point: Point) -> f64 {
    let (side, offset) = (minus(b, a), minus(point, a));
    let length2 = side[0] * side[0] + side[1] * side[1];
    let along = side[0] * offset[0] + side[1] * offset[1];
    let share = if length2 > 0.0 {
        (along / length2).clamp(0.0, 1.0)
    } else {
        0.0
    };
    distance_m(point, [a[0] + share * side[0], a[1] + share * side[1]])
}

/// A circle around the middle of the points' extent.
fn circle_around(points: &[Point]) -> Option<Area> {
    let first = *points.first()?;
    let extent = |axis: usize| {
        let least = points
            .iter()
            .fold(first[axis], |least, p| least.min(p[axis]));
        let most = points.iter().fold(first[axis], |most, p| most.max(p[axis]));
        f64::midpoint(least, most)
    };
    let center = [extent(0), extent(1)];
    let radius_m = points
        .iter()
        .map(|&p| distance_m(center, p))
        .fold(0.0, f64::max);
    Some(Area::Circle { center, radius_m })
}

/// The convex hull, counter-clockwise, with its first corner at the end again (Andrew's monotone
/// chain).
fn hull(points: &[Point]) -> Vec<Point> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let half = |points: &mut dyn Iterator<Item = Point>| {
        let mut chain: Vec<Point> = Vec::new();
        for point in points {
            while let [.., a, b] = chain[..]
                && cross(minus(b, a), minus(point, a)) <= 0.0
            {
                chain.pop();
            }
            chain.push(point);
        }
        chain
    };
    let mut lower = half(&mut sorted.iter().copied());
    let upper = half(&mut sorted.iter().rev().copied());
    lower.extend(upper.into_iter().skip(1));
    lower
}

/// The rectangle around `points` that has a side along `a` to `b`.
fn rectangle_along(a: Point, b: Point, points: &[Point]) -> Area {
    let side = minus(b, a);
    let direction_rad = side[1].atan2(side[0]);
    let (mut least, mut most) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for &point in points {
        let point = turned(point, -direction_rad);
        for axis in 0..2 {
            least[axis] = least[axis].min(point[axis]);
            most[axis] = most[axis].max(point[axis]);
        }
    }
    let middle = [
        f64::midpoint(least[0], most[0]),
        f64::midpoint(least[1], most[1]),
    ];
    Area::Rectangle {
        center: turned(middle, direction_rad),
        half_m: [(most[0] - least[0]) / 2.0, (most[1] - least[1]) / 2.0],
        direction_rad,
    }
}

/// A whole number of steps that fits, saturating.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "`as` saturates"
)]
fn whole(steps: f64) -> u16 {
    steps as u16
}

fn metres(length: StandardLength12b) -> f64 {
    f64::from(length.get()) / 10.0
}

fn decimetres(metres: f64) -> StandardLength12b {
    StandardLength12b::saturating(whole(((metres + ROUNDING_M) * 10.0).ceil()))
}

fn place([east, north]: Point) -> CartesianPosition3d {
    #[expect(clippy::cast_possible_truncation, reason = "`as` saturates")]
    let centimetres = |metres: f64| CartesianCoordinate((metres * 100.0).round() as i16);
    CartesianPosition3d {
        x_coordinate: centimetres(east),
        y_coordinate: centimetres(north),
        z_coordinate: None,
    }
}

fn point_of(position: CartesianPosition3d) -> Point {
    let metres = |coordinate: CartesianCoordinate| f64::from(coordinate.0) / 100.0;
    [metres(position.x_coordinate), metres(position.y_coordinate)]
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn a_row_of_people_is_bounded_by_a_rectangle_and_one_by_a_circle() {
        let row: Vec<Point> = (0..6).map(|i| [f64::from(i) * 2.0, f64::from(i)]).collect();
        let area = Area::around(&row, 0.5).unwrap();
        let Area::Rectangle { half_m, .. } = area else {
            panic!("not a rectangle: {area:?}")
        };
        assert!((half_m[0] - (5.0 * 5_f64.sqrt() / 2.0 + 0.5)).abs() < 1e-9);
        assert!((half_m[1] - 0.5).abs() < 1e-9);
        let one = Area::around(&[[3.0, 4.0]], 0.5).unwrap();
        assert_eq!(
            one,
            Area::Circle {
                center: [3.0, 4.0],
                radius_m: 0.5
            }
        );
        assert_eq!(Area::around(&[], 0.5), None);
    }

    #[test]
    fn a_polygon_from_elsewhere_is_understood() {
        let corners = vec![[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 1.0], [0.0, 4.0]];
        let area = Area::Polygon(corners);
        assert!(area.contains([0.5, 0.5]) && area.contains([3.8, 2.0]));
        assert!(!area.contains([2.0, 3.0]));
        assert!((area.distance_m([6.0, 0.0]) - 2.0).abs() < 1e-9);
        assert!((area.size_m2() - 10.0).abs() < 1e-9);
    }

    fn points() -> impl Strategy<Value = Vec<Point>> {
        let coordinate = -40.0..40.0_f64;
        let point = (coordinate.clone(), coordinate).prop_map(|(x, y)| [x, y]);
        proptest::collection::vec(point, 1..25)
    }

    proptest! {
        /// Every person stays inside an area, both as drawn and on the wire.
        #[test]
        fn everybody_stays_inside(points in points(), x in -30.0..30.0_f64, y in -30.0..30.0_f64) {
            let area = Area::around(&points, 0.3).unwrap();
            let wire = Area::of_wire(&area.to_wire([x, y]), [x, y]);
            for &point in &points {
                prop_assert!(area.contains(point), "{area:?} {point:?}");
                prop_assert!(wire.contains(point), "{wire:?} {point:?}");
            }
            prop_assert!(wire.size_m2() >= area.size_m2() * 0.999);
        }
    }
}
