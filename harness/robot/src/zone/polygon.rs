//! Polygons as people and sensors say them, by their corners.

use crossguard_crossing::CORNERS_MAX;
use crossguard_endpoint::ras::area::Area;

/// Smallest area of a polygon, in square metres.
const AREA_MIN_M2: f64 = 0.01;

/// Why corners are no polygon.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum NoPolygon {
    /// There are too few or too many of them.
    #[error("{field} has {count} corners: 3 to {CORNERS_MAX} are possible")]
    Corners {
        /// The field.
        field: &'static str,
        /// How many it has.
        count: usize,
    },
    /// Its sides cross.
    #[error(
        "{field}: its sides {first} and {second} cross; the corners are wanted in order around it"
    )]
    Crossed {
        /// The field.
        field: &'static str,
        /// The number of a side, from 1 on.
        first: usize,
        /// The number of another side.
        second: usize,
    },
    /// It has no area.
    #[error("{0}: its corners enclose nothing")]
    Flat(&'static str),
}

/// The polygon with these corners, in metres.
pub(crate) fn polygon(field: &'static str, corners: Vec<[f64; 2]>) -> Result<Area, NoPolygon> {
    let count = corners.len();
    if !(3..=CORNERS_MAX).contains(&count) {
        return Err(NoPolygon::Corners { field, count });
    }
    let side = |number: usize| (corners[number], corners[(number + 1) % count]);
    for first in 0..count {
        // The next side begins where this one ends, and the last one ends where the first begins.
        for second in first + 2..count - usize::from(first == 0) {
            if do_cross(side(first), side(second)) {
                let (first, second) = (first + 1, second + 1);
                return Err(NoPolygon::Crossed {
                    field,
                    first,
                    second,
                });
            }
        }
    }
    let area = Area::Polygon(corners);
    if area.size_m2() < AREA_MIN_M2 {
        return Err(NoPolygon::Flat(field));
    }
    Ok(area)
}

/// Whether two sides have a point in common other than by touching.
fn do_cross((a, b): ([f64; 2], [f64; 2]), (c, d): ([f64; 2], [f64; 2])) -> bool {
    let turn = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| {
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    };
    turn(a, b, c) * turn(a, b, d) < 0.0 && turn(c, d, a) * turn(c, d, b) < 0.0
}
