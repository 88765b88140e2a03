//! The carriageway at a crossing: between the lines of its two kerbs.
//!
//! ```text
//!   ─ ─ ─ ─ ─ ═══════════════ ─ ─ ─ ─ ─   a kerb, and its line
//!    along_m  │   crossing  │  along_m
//!   ─ ─ ─ ─ ─ ═══════════════ ─ ─ ─ ─ ─   the other one
//! ```
//!
//! A person who leaves the crossing sideways is still on the carriageway.

use super::Lane;
use crate::site::Place;

/// The carriageway at a crossing, by its corners, counter-clockwise: the first two are of one kerb.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Carriageway {
    /// The part between the kerbs of the site.
    pub crossing: [Place; 4],
    /// The whole, which goes on beside the crossing along the lines of the kerbs.
    pub whole: [Place; 4],
}

impl Carriageway {
    pub(super) fn new(near: [Place; 2], far: [Place; 2], along_m: f64) -> Self {
        let longer = |[from, to]: [Place; 2]| {
            let metres = from.distance(to) + along_m;
            [to.towards(from, metres), from.towards(to, metres)]
        };
        Self {
            crossing: between(near, far, 0.0),
            whole: between(longer(near), longer(far), 0.0),
        }
    }

    /// How wide it is where people cross, at the widest, in metres.
    #[must_use]
    pub fn width_m(&self) -> f64 {
        let [a, b, c, d] = self.crossing;
        let across = |a: Place, b: Place, to: Place| turn(a, b, to) / a.distance(b);
        let ways = [
            across(a, b, c),
            across(a, b, d),
            across(c, d, a),
            across(c, d, b),
        ];
        ways.into_iter().fold(0.0, f64::max)
    }

    /// Whether a place is between the lines of the kerbs, however far along the road.
    pub(super) fn is_beside(&self, place: Place) -> bool {
        self.pavement(place).is_none()
    }

    /// Behind which kerb a place is, 0 or 1; `None` between them.
    fn pavement(&self, place: Place) -> Option<usize> {
        let [a, b, c, d] = self.crossing;
        [[a, b], [c, d]]
            .into_iter()
            .position(|[from, to]| turn(from, to, place) <= 0.0)
    }

    /// Whether a place is on it.
    pub(super) fn has(&self, place: Place) -> bool {
        let corner = |number: usize| self.whole[number % 4];
        (0..4).all(|first| turn(corner(first), corner(first + 1), place) > 0.0)
    }

    /// Whether two places are behind different kerbs.
    pub(crate) fn parts(&self, places: [Place; 2]) -> bool {
        let [from, to] = places.map(|place| self.pavement(place));
        from.is_some() && to.is_some() && from != to
    }

    /// Whether the middle of a lane leads over a kerb.
    pub(super) fn cuts(&self, lane: &Lane) -> bool {
        let [a, b, c, d] = self.crossing;
        let parts = |[from, to]: [Place; 2], [one, other]: [Place; 2]| {
            (turn(from, to, one) > 0.0) != (turn(from, to, other) > 0.0)
        };
        let lane = [lane.from, lane.to];
        [[a, b], [c, d]]
            .into_iter()
            .any(|kerb| parts(kerb, lane) && parts(lane, kerb))
    }

    /// Whether the lines of the kerbs do not meet in it.
    pub(super) fn is_convex(&self) -> bool {
        let corner = |number: usize| self.whole[number % 4];
        (0..4).all(|first| turn(corner(first), corner(first + 1), corner(first + 2)) > 0.0)
    }
}

/// The corners of the area between two kerbs, and so many metres behind them, counter-clockwise.
pub(crate) fn between(near: [Place; 2], far: [Place; 2], behind_m: f64) -> [Place; 4] {
    let behind = |[a, b]: [Place; 2], other: [Place; 2]| {
        let length = a.distance(b).max(f64::MIN_POSITIVE);
        let middle = Place::new(
            f64::midpoint(other[0].east, other[1].east),
            f64::midpoint(other[0].north, other[1].north),
        );
        // Across the kerb, away from the other one.
        let by = behind_m.copysign(turn(a, b, middle)) / length;
        let (east, north) = (by * (b.north - a.north), by * (a.east - b.east));
        [a, b].map(|end| Place::new(end.east + east, end.north + north))
    };
    let ([a, b], [c, d]) = (behind(near, far), behind(far, near));
    let runs_alike =
        (b.east - a.east) * (d.east - c.east) + (b.north - a.north) * (d.north - c.north) > 0.0;
    let (c, d) = if runs_alike { (d, c) } else { (c, d) };
    if turn(a, b, c) < 0.0 {
        [d, c, b, a]
    } else {
        [a, b, c, d]
    }
}

/// Twice the area of a triangle; negative where its corners go clockwise.
fn turn(a: Place, b: Place, c: Place) -> f64 {
    (b.east - a.east) * (c.north - a.north) - (b.north - a.north) * (c.east - a.east)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::site_file::SiteFile;

    fn size_m2(corners: [Place; 4]) -> f64 {
        let [a, b, c, d] = corners;
        f64::midpoint(turn(a, b, c), turn(a, c, d))
    }

    #[test]
    fn the_carriageway_goes_on_beside_the_crossing() {
        let street = SiteFile::street();
        let road = street.carriageway().unwrap();
        let corners = |corners: [Place; 4]| corners.map(|it| (it.east, it.north));
        assert_eq!(
            corners(road.crossing),
            [(-3.0, 0.0), (5.0, 0.0), (5.0, 7.0), (-3.0, 7.0)]
        );
        assert_eq!(
            corners(road.whole),
            [(-13.0, 0.0), (15.0, 0.0), (15.0, 7.0), (-13.0, 7.0)]
        );
        assert_eq!(street.walk_s(), Some(7.0 / 0.9));
        let one = SiteFile {
            kerbs: None,
            ..street
        };
        assert_eq!(one.carriageway(), None);
    }

    #[test]
    fn kerbs_in_any_direction_and_order_enclose_the_same_road() {
        let kerb = |a: [f64; 2], b: [f64; 2]| [Place::new(a[0], a[1]), Place::new(b[0], b[1])];
        let (near, far) = (kerb([0.0, 0.0], [8.0, 8.0]), kerb([-4.0, 4.0], [4.0, 12.0]));
        let turned = |[a, b]: [Place; 2]| [b, a];
        let (length_m, width_m) = (128.0_f64.sqrt(), 32.0_f64.sqrt());
        for (near, far) in [
            (near, far),
            (turned(near), far),
            (near, turned(far)),
            (turned(near), turned(far)),
            (far, near),
            (far, turned(near)),
        ] {
            let road = Carriageway::new(near, far, 5.0);
            assert!(road.is_convex());
            assert!((road.width_m() - width_m).abs() < 1e-6);
            for (corners, expected) in [
                (road.crossing, length_m * width_m),
                (road.whole, (length_m + 10.0) * width_m),
                (between(near, far, 2.0), length_m * (width_m + 4.0)),
            ] {
                assert!((size_m2(corners) - expected).abs() < 1e-6, "{corners:?}");
            }
        }
    }

    #[test]
    fn lines_that_meet_beside_the_crossing_enclose_no_road() {
        let kerb = |a: [f64; 2], b: [f64; 2]| [Place::new(a[0], a[1]), Place::new(b[0], b[1])];
        let near = kerb([0.0, 0.0], [8.0, 0.0]);
        let far = kerb([8.0, 2.0], [0.0, 6.0]);
        assert!(Carriageway::new(near, far, 3.0).is_convex());
        assert!(!Carriageway::new(near, far, 10.0).is_convex());
        assert!(!Carriageway::new(near, near, 3.0).is_convex());
    }
}
