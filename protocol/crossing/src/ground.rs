//! Where things are: places in centimetres on the site, the carriageway, and where people wait.

use crossguard_protocol::List;

/// Capacity of a [`Shape`] for corners.
pub const CORNERS_MAX: usize = 64;

/// Farthest place from the origin of a site on each axis, in centimetres: 100 km.
pub const FAR_CM: i32 = 10_000_000;

/// A place on the site, in centimetres east and north of its origin. Farther places than [`FAR_CM`] are at the edge.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub struct Point {
    east_cm: i32,
    north_cm: i32,
}

impl Point {
    /// The place that is so far east and north.
    #[must_use]
    pub const fn new(east_cm: i32, north_cm: i32) -> Self {
        Self {
            east_cm: clamp(east_cm),
            north_cm: clamp(north_cm),
        }
    }

    /// Centimetres east of the origin.
    #[must_use]
    pub const fn east_cm(self) -> i32 {
        self.east_cm
    }

    /// Centimetres north of the origin.
    #[must_use]
    pub const fn north_cm(self) -> i32 {
        self.north_cm
    }

    /// The distance, in centimetres, rounded down.
    #[must_use]
    pub const fn distance_cm(self, other: Self) -> u32 {
        self.to(other).length_cm()
    }

    /// The way from here to `other`.
    #[must_use]
    pub const fn to(self, other: Self) -> Way {
        Way {
            east_cm: other.east_cm - self.east_cm,
            north_cm: other.north_cm - self.north_cm,
        }
    }

    /// The place at the end of a way from here.
    #[must_use]
    pub const fn plus(self, way: Way) -> Self {
        Self::new(
            self.east_cm.saturating_add(way.east_cm),
            self.north_cm.saturating_add(way.north_cm),
        )
    }
}

const fn clamp(cm: i32) -> i32 {
    if cm > FAR_CM {
        FAR_CM
    } else if cm < -FAR_CM {
        -FAR_CM
    } else {
        cm
    }
}

/// A way on the site: centimetres to the east and to the north; as a velocity, in a second.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub struct Way {
    /// Centimetres to the east.
    pub east_cm: i32,
    /// Centimetres to the north.
    pub north_cm: i32,
}

impl Way {
    /// Its length in centimetres, rounded down.
    #[must_use]
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the root of a sum of two squares of 32 bits"
    )]
    pub const fn length_cm(self) -> u32 {
        let (east, north) = (self.east_cm as i64, self.north_cm as i64);
        let square = (east * east) as u64 + (north * north) as u64;
        square.isqrt() as u32
    }

    /// The part of the way that is `numerator / denominator` long.
    #[must_use]
    pub const fn part(self, numerator: i32, denominator: i32) -> Self {
        if denominator == 0 {
            return Self {
                east_cm: 0,
                north_cm: 0,
            };
        }
        let east = self.east_cm as i64 * numerator as i64 / denominator as i64;
        let north = self.north_cm as i64 * numerator as i64 / denominator as i64;
        Self {
            east_cm: clamp_wide(east),
            north_cm: clamp_wide(north),
        }
    }

    /// Scalar product with another way, in square centimetres.
    #[must_use]
    pub const fn dot(self, other: Self) -> i64 {
        let east = self.east_cm as i64 * other.east_cm as i64;
        east.saturating_add(self.north_cm as i64 * other.north_cm as i64)
    }

    /// Cross product with another way, in square centimetres: positive where `other` is to the left.
    #[must_use]
    pub const fn cross(self, other: Self) -> i64 {
        self.east_cm as i64 * other.north_cm as i64 - self.north_cm as i64 * other.east_cm as i64
    }
}

#[expect(clippy::cast_possible_truncation, reason = "clamped")]
const fn clamp_wide(cm: i64) -> i32 {
    let far = 2 * FAR_CM as i64;
    if cm > far {
        far as i32
    } else if cm < -far {
        -far as i32
    } else {
        cm as i32
    }
}

/// A polygon.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Shape {
    corners: List<Point, CORNERS_MAX>,
}

impl Shape {
    /// The polygon with these corners, in either direction. `None` for fewer than 3 or more than [`CORNERS_MAX`].
    #[must_use]
    pub fn new(corners: &[Point]) -> Option<Self> {
        let mut list = List::EMPTY;
        for corner in corners {
            list.push(*corner).ok()?;
        }
        (list.len() >= 3).then_some(Self { corners: list })
    }

    /// Its corners.
    pub fn corners(&self) -> impl Iterator<Item = Point> + Clone {
        self.corners.iter().copied()
    }

    fn edges(&self) -> impl Iterator<Item = (Point, Point)> {
        let last = self.corners().last().unwrap_or_default();
        self.corners().scan(last, |before, corner| {
            Some((core::mem::replace(before, corner), corner))
        })
    }

    /// Whether a place is in it.
    #[must_use]
    pub fn has(&self, at: Point) -> bool {
        let crossed = self.edges().filter(|(from, to)| {
            let rises = to.north_cm > from.north_cm;
            let spans = (from.north_cm > at.north_cm) != (to.north_cm > at.north_cm);
            let cross = from.to(*to).cross(from.to(at));
            spans && (if rises { cross > 0 } else { cross < 0 })
        });
        crossed.count() % 2 == 1
    }

    /// Whether the straight way from one place to another leads over it.
    #[must_use]
    pub fn is_between(&self, from: Point, to: Point) -> bool {
        let parts = |from: Point, to: Point, [a, b]: [Point; 2]| {
            let is_left = |at: Point| from.to(to).cross(from.to(at)) > 0;
            is_left(a) != is_left(b)
        };
        let mut edges = self.edges();
        self.has(from)
            || self.has(to)
            || edges.any(|(a, b)| parts(from, to, [a, b]) && parts(a, b, [from, to]))
    }

    /// How far a place is from it, in centimetres, rounded down; 0 in it.
    #[must_use]
    pub fn distance_cm(&self, at: Point) -> u32 {
        if self.has(at) {
            return 0;
        }
        let nearest = self
            .edges()
            .map(|(from, to)| edge_distance_cm(from, to, at));
        nearest.min().unwrap_or(u32::MAX)
    }

    /// How wide it is, in centimetres, rounded up: between two lines along the same edge, with all of it between them.
    pub(crate) fn width_cm(&self) -> u32 {
        let edges = self.edges().filter(|(from, to)| from != to);
        let widths = edges.filter_map(|(from, to)| {
            let edge = from.to(to);
            let off = self.corners().map(|corner| edge.cross(from.to(corner)));
            let (least, most) =
                off.fold((0, 0), |(least, most), off| (off.min(least), off.max(most)));
            let square = u64::try_from(most.saturating_sub(least)).ok()?;
            let width = square.div_ceil(u64::from(edge.length_cm()));
            u32::try_from(width).ok()
        });
        widths.min().unwrap_or(u32::MAX)
    }

    /// How far its corners are from its middle at most, in centimetres.
    #[must_use]
    pub fn reach_cm(&self) -> u32 {
        let middle = self.middle();
        let corners = self.corners().map(|corner| corner.distance_cm(middle));
        corners.max().unwrap_or(0)
    }

    /// The mean of its corners.
    #[must_use]
    pub fn middle(&self) -> Point {
        let (mut east, mut north, mut count) = (0_i64, 0_i64, 0_i64);
        for corner in self.corners() {
            east += i64::from(corner.east_cm);
            north += i64::from(corner.north_cm);
            count += 1;
        }
        let count = count.max(1);
        Point::new(clamp_wide(east / count), clamp_wide(north / count))
    }
}

/// How far a place is from a straight edge, in centimetres.
fn edge_distance_cm(from: Point, to: Point, at: Point) -> u32 {
    let (edge, way) = (from.to(to), from.to(at));
    let (along, square) = (edge.dot(way), edge.dot(edge));
    if along <= 0 {
        return way.length_cm();
    }
    if along >= square {
        return to.distance_cm(at);
    }
    // By the length rounded up: no place is nearer than this says.
    let length = u64::from(edge.length_cm());
    let is_exact = square.unsigned_abs() == length * length;
    let distance = edge.cross(way).unsigned_abs() / (length + u64::from(!is_exact)).max(1);
    u32::try_from(distance).unwrap_or(u32::MAX)
}

/// Parts of the carriageway, one bit for each: which parts there are is for the site to say.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub struct Coverage(pub u32);

impl Coverage {
    /// No part.
    pub const NONE: Self = Self(0);
    /// All parts of any site.
    pub const ALL: Self = Self(u32::MAX);

    /// Whether all parts of `other` are in it.
    #[must_use]
    pub const fn has(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }

    /// The parts of either.
    #[must_use]
    pub const fn union(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

/// The ground of a crossing. A shape that is not known has no place in it.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub struct Ground {
    /// The carriageway: between the kerbs, and along the road as far as the site says. Without it the road is never
    /// known to be clear.
    pub road: Option<Shape>,
    /// The part of it on which people cross, for vehicles that come near. The whole, if it is not said.
    pub crossing: Option<Shape>,
    /// Where people wait to cross; without it nobody is detected.
    pub waiting: Option<Shape>,
    /// The parts of the carriageway, of which frames say whether they cover them.
    pub parts: Coverage,
}

impl Ground {
    /// The part of the carriageway on which people cross, or the whole, if that is not said.
    #[must_use]
    pub fn where_people_cross(&self) -> Option<&Shape> {
        self.crossing.as_ref().or(self.road.as_ref())
    }

    /// Whether somebody who is at most `error_cm` from a place may be on the carriageway.
    #[must_use]
    pub fn may_be_road(&self, at: Point, error_cm: u32) -> bool {
        self.road
            .is_some_and(|road| road.distance_cm(at) <= error_cm)
    }

    /// Whether a place is on the carriageway.
    #[must_use]
    pub fn is_road(&self, at: Point) -> bool {
        self.road.is_some_and(|road| road.has(at))
    }

    /// Whether a place is where people wait or cross.
    #[must_use]
    pub fn is_zone(&self, at: Point) -> bool {
        self.waiting.is_some_and(|waiting| waiting.has(at)) || self.is_road(at)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shape(corners: &[(i32, i32)]) -> Shape {
        let corners: std::vec::Vec<Point> =
            corners.iter().map(|at| Point::new(at.0, at.1)).collect();
        Shape::new(&corners).unwrap()
    }

    /// Edges of a few centimetres, whose length is no whole number.
    #[test]
    fn a_distance_is_never_more_than_it_is() {
        let diamond = shape(&[(0, 0), (1, 1), (0, 2), (-1, 1)]);
        assert_eq!(diamond.distance_cm(Point::new(100, -98)), 140);
        let long = shape(&[(0, 0), (100, 100), (0, 200)]);
        for off in [1, 7, 50, 141, 1_000] {
            let at = Point::new(50 + off, 50 - off);
            let is = long.distance_cm(at);
            let exact = f64::from(off) * std::f64::consts::SQRT_2;
            assert!(
                f64::from(is) <= exact && exact < f64::from(is) * 1.01 + 1.0,
                "{is} {exact}"
            );
        }
    }

    #[test]
    fn a_road_is_as_wide_as_people_walk_from_kerb_to_kerb() {
        for (name, corners, width) in [
            (
                "straight",
                &[(0, 0), (6_000, 0), (6_000, 700), (0, 700)][..],
                700,
            ),
            (
                "askew",
                &[(0, 0), (4_000, 3_000), (3_400, 3_800), (-600, 800)],
                1_000,
            ),
            ("three corners", &[(0, 0), (1_000, 0), (0, 100)], 100),
            (
                "a corner twice",
                &[(0, 0), (0, 0), (6_000, 0), (6_000, 700), (0, 700)],
                700,
            ),
            ("no road", &[(5, 5), (5, 5), (5, 5)], u32::MAX),
        ] {
            assert_eq!(shape(corners).width_cm(), width, "{name}");
        }
    }

    #[test]
    fn no_way_is_too_long_to_be_measured() {
        for far in [i32::MIN, i32::MAX] {
            let way = Way {
                east_cm: far,
                north_cm: far,
            };
            assert!(way.length_cm() > 3_000_000_000);
            assert!(way.dot(way) > 0 && way.cross(way) == 0);
            assert_eq!(way.part(far, 1), way.part(far, 1));
            let (edge, origin) = (Point::new(far, far), Point::default());
            assert_eq!(edge.distance_cm(origin), 14_142_135);
        }
    }

    #[test]
    fn a_polygon_has_what_is_in_it_in_either_direction() {
        let mut corners = [(0, 0), (10, 0), (10, 10), (5, 5), (0, 10)];
        for _ in 0..2 {
            let shape = shape(&corners);
            for (at, inside) in [
                ((5, 2), true),
                ((5, 8), false),
                ((1, 7), true),
                ((11, 5), false),
            ] {
                assert_eq!(shape.has(Point::new(at.0, at.1)), inside, "{at:?}");
            }
            corners.reverse();
        }
        assert_eq!(Shape::new(&[Point::default(); 2]), None);
        assert_eq!(Shape::new(&[Point::default(); CORNERS_MAX + 1]), None);
    }
}
