//! The streets of a run: the paper's grid, or a net of one's own in SUMO's format.

use std::io::Read;

use crossguard_endpoint::ras::motion::{Point, distance_m};
use serde::Serialize;

use super::grid::{Grid, INTERSECTION_M};
use super::trace::{Run, Track};
use super::xml::{SumoFileError, elements};

/// People and vehicles may be so far outside of a net's boundary, which ends in the middle of streets, in metres.
const MARGIN_M: f64 = 50.0;

/// Where a run is.
#[derive(Clone, PartialEq, Debug, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Streets {
    /// A grid, as the paper has one.
    Grid(Grid),
    /// A net of one's own.
    Net(Net),
}

impl Streets {
    /// The grid, if it is one.
    #[must_use]
    pub const fn grid(&self) -> Option<&Grid> {
        match self {
            Self::Grid(grid) => Some(grid),
            Self::Net(_) => None,
        }
    }

    /// All intersections, the one nearest to the middle first.
    #[must_use]
    pub fn nodes(&self) -> Vec<Point> {
        match self {
            Self::Grid(grid) => grid.nodes(),
            Self::Net(net) => net.nodes.clone(),
        }
    }

    /// Whether a place is at an intersection: on a grid no farther from its middle than its crossings along each
    /// axis, on a net no farther in any direction.
    #[must_use]
    pub fn is_at_intersection(&self, place: Point) -> bool {
        match self {
            Self::Grid(grid) => grid.is_at_intersection(place),
            Self::Net(net) => {
                let from = net
                    .by_east
                    .partition_point(|it| it[0] < place[0] - INTERSECTION_M);
                let near = net.by_east[from..].iter();
                near.take_while(|it| it[0] <= place[0] + INTERSECTION_M)
                    .any(|it| distance_m(*it, place) <= INTERSECTION_M)
            }
        }
    }
}

/// The parts of a net that runs need.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Net {
    /// Least and most metres to the east and to the north: west, south, east, north.
    boundary_m: [f64; 4],
    intersections: usize,
    #[serde(skip)]
    nodes: Vec<Point>,
    #[serde(skip)]
    by_east: Vec<Point>,
}

impl Net {
    /// Reads a net (`netgenerate`, `netconvert`).
    ///
    /// # Errors
    /// Why it cannot be used.
    pub fn read(from: impl Read) -> Result<Self, SumoFileError> {
        let (mut boundary, mut nodes) = (None, Vec::new());
        elements(from, "net", |element| {
            if element.is("location") {
                let four = |text: &str| {
                    let numbers = text.split(',').map(|it| it.parse::<f64>().ok());
                    numbers.collect::<Option<Vec<f64>>>()?.try_into().ok()
                };
                boundary = Some(element.value("convBoundary", "west,south,east,north", four)?);
            } else if element.is("junction")
                && !matches!(&*element.text("type"), "internal" | "dead_end")
            {
                nodes.push([element.number("x")?, element.number("y")?]);
            }
            Ok(())
        })?;
        let missing = |what: &str| {
            let why = format!("has no {what}: make the net with netgenerate or netconvert");
            SumoFileError::Misfit(why)
        };
        let boundary_m: [f64; 4] = boundary.ok_or_else(|| missing("<location>"))?;
        if nodes.is_empty() {
            return Err(missing("intersection"));
        }
        let [west, south, east, north] = boundary_m;
        let middle = [west.midpoint(east), south.midpoint(north)];
        let mut by_east = nodes.clone();
        by_east.sort_by(|a, b| a[0].total_cmp(&b[0]));
        nodes.sort_by(|a, b| distance_m(*a, middle).total_cmp(&distance_m(*b, middle)));
        Ok(Self {
            boundary_m,
            intersections: nodes.len(),
            nodes,
            by_east,
        })
    }

    /// Checks that everybody moved on this net.
    ///
    /// # Errors
    /// How many did not, and where they were.
    pub fn check(&self, run: &Run) -> Result<(), SumoFileError> {
        let [west, south, east, north] = self.boundary_m;
        let is_on_net = |[x, y]: Point| {
            (west - MARGIN_M..=east + MARGIN_M).contains(&x)
                && (south - MARGIN_M..=north + MARGIN_M).contains(&y)
        };
        let all = || run.pedestrians.iter().chain(&run.vehicles);
        let places = || all().flat_map(Track::samples).map(|it| it.position_m);
        let outside = all().filter(|track| {
            let mut places = track.samples().iter().map(|it| it.position_m);
            places.any(|it| !is_on_net(it))
        });
        let outside = outside.count();
        let axis = |axis: usize| {
            let values = places().map(move |it| it[axis]);
            values.fold([f64::MAX, f64::MIN], |[a, b], it| [a.min(it), b.max(it)])
        };
        let ([x0, x1], [y0, y1]) = (axis(0), axis(1));
        let are = format!("they are from ({x0:.2}, {y0:.2}) to ({x1:.2}, {y1:.2})");
        if outside > 0 {
            return Err(SumoFileError::Misfit(format!(
                "{outside} of {} people and vehicles are outside of the net, which is from ({west}, {south}) to \
                 ({east}, {north}) m: {are}; give the net that they moved on, and write metres, not --fcd-output.geo",
                all().count()
            )));
        }
        // Degrees are within most nets in metres.
        if x1 - x0 < 1.0 && y1 - y0 < 1.0 && all().count() > 1 {
            return Err(SumoFileError::Misfit(format!(
                "all people and vehicles are within a metre: {are}; write metres, not --fcd-output.geo"
            )));
        }
        Ok(())
    }
}
