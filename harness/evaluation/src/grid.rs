//! The street grid of the evaluation, and where robots stand on it.
//!
//! Nodes are the intersections, `segment_m` apart, the south-western one at the origin. The grid has no
//! roads that lead out of it.

use serde::{Deserialize, Serialize};

use crossguard_endpoint::ras::motion::{Point, distance_m};

/// Width of a lane, in metres: that of SUMO's networks by default.
pub const LANE_M: f64 = 3.2;

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
    /// What is wrong.
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
}
