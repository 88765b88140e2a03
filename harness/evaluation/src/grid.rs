//! The street grid of the evaluation, and where robots stand on it.
//!
//! Nodes are the intersections, `segment_m` apart, the south-western one at the origin. The grid has no
//! roads that lead out of it.

use serde::{Deserialize, Serialize};

use crossguard_endpoint::ras::motion::{Point, distance_m};

/// Width of a lane, in metres: that of SUMO's networks by default.
pub const LANE_M: f64 = 3.2;

/// How far from its middle, along each axis, an intersection reaches with its crossings, in metres.
pub const INTERSECTION_M: f64 = 20.0;

/// People at the edge of a sidewalk may be so far over the lanes, in metres.
const EDGE_M: f64 = 0.3;

/// A square grid of streets.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Grid {
    /// Intersections along a side.
    pub nodes_per_side: u32,
    /// Distance between two intersections, in metres.
    pub segment_m: f64,
    /// Lanes of each direction.
    pub lanes: u32,
    /// Width of the sidewalks, in metres.
    pub sidewalk_m: f64,
    /// Program that moved the traffic, and its version.
    #[serde(default)]
    pub mobility: String,
}

/// Where at an intersection a robot stands.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Site {
    /// In its middle.
    Center,
    /// On the sidewalk of its north-eastern corner.
    NorthEast,
    /// On the sidewalk of its north-western corner.
    NorthWest,
    /// On the sidewalk of its south-eastern corner.
    SouthEast,
    /// On the sidewalk of its south-western corner.
    SouthWest,
}

/// Assumptions on the geometry, which the paper does not state.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Preset {
    /// Two lanes per direction, sidewalks of 3 m, robots on the sidewalk at a corner, 7.9 m from the
    /// middle of the intersection in both axes.
    Kerb,
    /// One lane per direction, sidewalks of 2 m, robots in the middle of the intersection.
    Plain,
}

impl Preset {
    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Kerb => "kerb",
            Self::Plain => "plain",
        }
    }

    /// Its grid, of the paper's size.
    #[must_use]
    pub fn grid(self) -> Grid {
        let (lanes, sidewalk_m) = match self {
            Self::Kerb => (2, 3.0),
            Self::Plain => (1, 2.0),
        };
        Grid {
            nodes_per_side: 3,
            segment_m: 100.0,
            lanes,
            sidewalk_m,
            mobility: String::new(),
        }
    }

    /// Where its robots stand.
    #[must_use]
    pub const fn site(self) -> Site {
        match self {
            Self::Kerb => Site::SouthWest,
            Self::Plain => Site::Center,
        }
    }
}

impl Grid {
    /// Checks that it is one.
    ///
    /// # Errors
    /// A parameter is out of its range.
    pub fn check(&self) -> Result<(), &'static str> {
        match self {
            Self { nodes_per_side, .. } if !(2..=26).contains(nodes_per_side) => {
                Err("a grid has 2 to 26 intersections along a side")
            }
            Self { lanes, .. } if !(1..=4).contains(lanes) => {
                Err("a street has 1 to 4 lanes per direction")
            }
            Self { sidewalk_m, .. } if !(0.5..=10.0).contains(sidewalk_m) => {
                Err("a sidewalk is 0.5 to 10 m wide")
            }
            Self { segment_m, .. } if !(50.0..=1_000.0).contains(segment_m) => {
                Err("a segment is 50 to 1000 m long")
            }
            _ => Ok(()),
        }
    }

    /// All intersections, the one nearest to the middle first.
    #[must_use]
    pub fn nodes(&self) -> Vec<Point> {
        let at = |index: u32| f64::from(index) * self.segment_m;
        let middle = f64::from(self.nodes_per_side - 1) * self.segment_m / 2.0;
        let side = 0..self.nodes_per_side;
        let mut nodes: Vec<Point> = side
            .clone()
            .flat_map(|x| side.clone().map(move |y| (x, y)))
            .map(|(x, y)| [at(x), at(y)])
            .collect();
        let from_middle = |node: &Point| distance_m(*node, [middle, middle]);
        nodes.sort_by(|a, b| from_middle(a).total_cmp(&from_middle(b)));
        nodes
    }

    /// Distance from the middle of an intersection to the middle of its corner's sidewalk along each
    /// axis, in metres.
    #[must_use]
    pub fn corner_m(&self) -> f64 {
        f64::from(self.lanes) * LANE_M + self.sidewalk_m / 2.0
    }

    /// Whether a place is at an intersection: no farther from its middle than its crossings.
    #[must_use]
    pub fn is_at_intersection(&self, place: Point) -> bool {
        self.off_intersection_m(place)
            .iter()
            .all(|off_m| *off_m <= INTERSECTION_M)
    }

    /// Whether a place is on a street or its sidewalks, or at an intersection.
    #[must_use]
    pub fn has(&self, place: Point) -> bool {
        let [east_m, north_m] = self.off_intersection_m(place);
        let wide_m = self.corner_m() + self.sidewalk_m / 2.0 + EDGE_M;
        let (near, far) = (east_m.min(north_m), east_m.max(north_m));
        self.is_at_intersection(place) || (near <= wide_m && far <= self.segment_m / 2.0)
    }

    /// Whether a place is on the lanes of a street away from its intersections, where there are no crossings.
    #[must_use]
    pub fn is_on_road_between(&self, place: Point) -> bool {
        let [east_m, north_m] = self.off_intersection_m(place);
        let lanes_m = f64::from(self.lanes) * LANE_M;
        !self.is_at_intersection(place) && east_m.min(north_m) < lanes_m - EDGE_M
    }

    /// Distance of a place from the middle of the nearest intersection along each axis, in metres.
    fn off_intersection_m(&self, place: Point) -> [f64; 2] {
        let last = f64::from(self.nodes_per_side.saturating_sub(1));
        place.map(|metres| {
            let node = (metres / self.segment_m).round().clamp(0.0, last);
            (metres - node * self.segment_m).abs()
        })
    }

    /// Where a robot at this intersection stands.
    #[must_use]
    pub fn robot_at(&self, node: Point, site: Site) -> Point {
        let corner = self.corner_m();
        let [east, north] = match site {
            Site::Center => [0.0, 0.0],
            Site::NorthEast => [corner, corner],
            Site::NorthWest => [-corner, corner],
            Site::SouthEast => [corner, -corner],
            Site::SouthWest => [-corner, -corner],
        };
        [node[0] + east, node[1] + north]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_corner_is_in_the_middle_of_the_sidewalks() {
        let grid = Preset::Kerb.grid();
        assert!((grid.corner_m() - 7.9).abs() < 1e-9);
        let corner = grid.robot_at(grid.nodes()[0], Preset::Kerb.site());
        assert!(distance_m(corner, [92.1, 92.1]) < 1e-9);
        assert_eq!(grid.nodes().len(), 9);
    }

    #[test]
    fn an_intersection_ends_behind_its_crossings_and_lanes_have_two_sides() {
        let grid = Preset::Kerb.grid();
        assert!(grid.is_at_intersection([81.0, 119.0]));
        assert!(!grid.is_at_intersection([79.0, 100.0]));
        // In the middle of a street: on its lanes to both sides, and on its sidewalks.
        for (north_m, is_on_road) in [(100.0, true), (94.0, true), (106.0, true), (92.1, false)] {
            assert_eq!(grid.is_on_road_between([50.0, north_m]), is_on_road);
            assert_eq!(grid.is_on_road_between([north_m, 50.0]), is_on_road);
        }
        assert!(!grid.is_on_road_between([100.0, 95.0]));
        // There are no streets that lead out of the grid.
        assert!(!grid.is_at_intersection([300.0, 100.0]));
    }
}
