//! The parts of a carriageway, of which a frame covers some.
//!
//! ```text
//!   ┌───┬───┬───   ───┬───┐
//!   │ 3 │ 7 │ 11   27 │ 31│   four rows, from edge to edge
//!   │ 2 │ 6 │ 10 … 26 │ 30│
//!   │ 1 │ 5 │ 9    25 │ 29│
//!   │ 0 │ 4 │ 8    24 │ 28│
//!   └───┴───┴───   ───┴───┘   eight columns, along the longest side
//! ```
//!
//! They fill the carriageway without a gap, whatever its outline and direction: a column is cut at each corner of the
//! outline within it, so that each of its pieces is between two straight edges.

use crossguard_crossing::Coverage;
use crossguard_endpoint::ras::area::Area;

const COLUMNS: u8 = 8;
const ROWS: u8 = 4;

/// How far a polygon may end before the edge of the carriageway and yet cover it, in metres: places are to the centimetre.
const EDGE_M: f64 = 0.01;

type Point = [f64; 2];

pub(super) struct Parts {
    /// The direction of the columns, of length 1.
    axis: Point,
    pieces: Vec<Piece>,
}

/// A piece of a part: a quadrilateral, in metres along the axis and to the left of it.
struct Piece {
    /// The number of the part.
    part: u8,
    /// From where to where it is along the axis.
    along: [f64; 2],
    /// Its right edge, at either end.
    right: [f64; 2],
    /// Its left edge, at either end.
    left: [f64; 2],
}

impl Parts {
    pub(super) fn of(outline: &[Point]) -> Self {
        let directions = sides(outline).map(|(from, to)| [to[0] - from[0], to[1] - from[1]]);
        let longest = directions.max_by(|a, b| length(*a).total_cmp(&length(*b)));
        let longest = longest.unwrap_or([1.0, 0.0]);
        let axis = longest.map(|it| it / length(longest));
        let outline: Vec<_> = outline.iter().map(|at| turned(axis, *at)).collect();
        let along = outline.iter().map(|at| at[0]);
        let least = along.clone().fold(f64::INFINITY, f64::min);
        let column_m =
            (along.clone().fold(f64::NEG_INFINITY, f64::max) - least) / f64::from(COLUMNS);
        let grid = (1..COLUMNS).map(|column| least + f64::from(column) * column_m);
        let mut cuts: Vec<_> = along.chain(grid).collect();
        cuts.sort_by(f64::total_cmp);
        cuts.dedup();
        let pieces = cuts.windows(2).flat_map(|cut| {
            let along = [cut[0], cut[1]];
            let middle = f64::midpoint(along[0], along[1]);
            let numbers = (0..COLUMNS).rev();
            let mut columns = numbers.filter(|it| least + f64::from(*it) * column_m <= middle);
            let column = columns.next().unwrap_or(0);
            between_edges(&outline, along)
                .into_iter()
                .flat_map(move |[right, left]| {
                    let at = move |row: u8| {
                        let share = f64::from(row) / f64::from(ROWS);
                        [0, 1].map(|end| right[end] + share * (left[end] - right[end]))
                    };
                    (0..ROWS).map(move |row| Piece {
                        part: column * ROWS + row,
                        along,
                        right: at(row),
                        left: at(row + 1),
                    })
                })
        });
        let pieces = pieces.collect();
        Self { axis, pieces }
    }

    pub(super) fn all(&self) -> Coverage {
        together(self.pieces.iter())
    }

    /// The parts that are in a polygon as a whole.
    pub(super) fn covered(&self, by: &[Point]) -> Coverage {
        let by: Vec<_> = by.iter().map(|at| turned(self.axis, *at)).collect();
        let by = Area::Polygon(grown(&by, EDGE_M));
        let outside = self.pieces.iter().filter(|piece| !piece.is_in(&by));
        Coverage(self.all().0 & !together(outside).0)
    }
}

fn together<'a>(pieces: impl Iterator<Item = &'a Piece>) -> Coverage {
    pieces.fold(Coverage::NONE, |all, piece| {
        all.union(Coverage(1 << piece.part))
    })
}

impl Piece {
    /// Whether the whole of it is in a polygon: no side of that leads over it, and one place of it is inside.
    fn is_in(&self, polygon: &Area) -> bool {
        let Area::Polygon(corners) = polygon else {
            return false;
        };
        let middle = |[from, to]: [f64; 2]| f64::midpoint(from, to);
        let across = f64::midpoint(middle(self.right), middle(self.left));
        !sides(corners).any(|side| self.meets(side))
            && polygon.contains([middle(self.along), across])
    }

    /// Whether a straight line from one place to another has a place in it or on its edge.
    fn meets(&self, (from, to): (Point, Point)) -> bool {
        let [begins, ends] = self.along;
        let (from, to) = forward(from, to);
        if from[0] > ends || to[0] < begins {
            return false;
        }
        // The part of the line beside the piece: a line whose ends are both on one side of it is so as a whole.
        let beside = [from, to].map(|at| {
            let along = at[0].clamp(begins, ends);
            if from[0] < to[0] {
                [along, height_at(from, to, along)]
            } else {
                at
            }
        });
        let edge =
            |[first, last]: [f64; 2], along: f64| height_at([begins, first], [ends, last], along);
        let is_right = |[along, across]: Point| across < edge(self.right, along);
        let is_left = |[along, across]: Point| across > edge(self.left, along);
        !beside.into_iter().all(is_right) && !beside.into_iter().all(is_left)
    }
}

/// The pairs of edges between which an outline has no corner from one cut to another: right and left, at either cut.
fn between_edges(outline: &[Point], along: [f64; 2]) -> Vec<[[f64; 2]; 2]> {
    let edges = sides(outline).filter_map(|(a, b)| {
        let (from, to) = forward(a, b);
        let spans = from[0] <= along[0] && along[1] <= to[0];
        spans.then(|| along.map(|at| height_at(from, to, at)))
    });
    let mut edges: Vec<_> = edges.collect();
    edges.sort_by(|a, b| (a[0] + a[1]).total_cmp(&(b[0] + b[1])));
    let pairs = edges.chunks_exact(2);
    pairs.map(|pair| [pair[0], pair[1]]).collect()
}

/// The ends of a line, in the direction of the axis.
fn forward(a: Point, b: Point) -> (Point, Point) {
    if a[0] < b[0] { (a, b) } else { (b, a) }
}

/// How far to the left of the axis a line from one place to another is, so far along it.
fn height_at(from: Point, to: Point, along: f64) -> f64 {
    let share = (along - from[0]) / (to[0] - from[0]);
    from[1] + share.clamp(0.0, 1.0) * (to[1] - from[1])
}

/// A polygon with so much more around it, and less at its sharp corners. No corner moves by more than twice that.
fn grown(corners: &[Point], by_m: f64) -> Vec<Point> {
    let cross = |(a, b): (Point, Point)| a[0] * b[1] - a[1] * b[0];
    let by_m = by_m.copysign(sides(corners).map(cross).sum());
    // Across a side, away from the polygon; nothing for a side without length.
    let outward = |(a, b): (Point, Point)| {
        let side = [b[0] - a[0], b[1] - a[1]];
        let metres = length(side).max(f64::MIN_POSITIVE);
        [by_m * side[1] / metres, -by_m * side[0] / metres]
    };
    let ways: Vec<_> = sides(corners).map(outward).collect();
    let before = ways.iter().cycle().skip(ways.len().saturating_sub(1));
    let ways = before.zip(&ways);
    let corners = corners.iter().zip(ways);
    let moved = corners.map(|(at, (before, after))| {
        let alike = (before[0] * after[0] + before[1] * after[1]) / (by_m * by_m);
        let by = |axis: usize| (before[axis] + after[axis]) / (1.0 + alike).max(0.5);
        [at[0] + by(0), at[1] + by(1)]
    });
    moved.collect()
}

fn sides(corners: &[Point]) -> impl Iterator<Item = (Point, Point)> {
    let next = corners.iter().cycle().skip(1);
    corners.iter().copied().zip(next.copied())
}

fn length(way: Point) -> f64 {
    way[0].hypot(way[1])
}

/// A place along an axis, and to the left of it.
fn turned(axis: Point, at: Point) -> Point {
    [
        at[0] * axis[0] + at[1] * axis[1],
        at[1] * axis[0] - at[0] * axis[1],
    ]
}

#[cfg(test)]
mod tests;
