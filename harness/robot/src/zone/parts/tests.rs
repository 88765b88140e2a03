//! No place of a carriageway that a polygon leaves out is in a covered part.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::*;

/// A place `along` and `across` a street that has this direction.
fn at(degrees: u16, [along, across]: Point) -> Point {
    let (sine, cosine) = f64::from(degrees).to_radians().sin_cos();
    [
        1.0 + along * cosine - across * sine,
        -2.0 + along * sine + across * cosine,
    ]
}

fn all_at(degrees: u16, corners: &[Point]) -> Vec<Point> {
    corners.iter().map(|it| at(degrees, *it)).collect()
}

fn rectangle([from, to]: Point, [right, left]: Point) -> [Point; 4] {
    [[from, right], [to, right], [to, left], [from, left]]
}

/// Carriageways along a street: with parallel kerbs, with others, with ends that are cut askew, around a corner, and round.
fn outlines(half_m: f64) -> [Vec<Point>; 5] {
    let round = (0..24).map(|number| {
        let (sine, cosine) = (f64::from(number) * std::f64::consts::TAU / 24.0).sin_cos();
        [half_m * cosine, half_m * sine]
    });
    [
        rectangle([-half_m, half_m], [0.0, 7.0]).to_vec(),
        vec![
            [-half_m, 0.0],
            [half_m, 1.0],
            [half_m - 0.4, 6.0],
            [-half_m - 0.4, 7.5],
        ],
        vec![
            [-half_m, 0.004],
            [half_m, 0.0],
            [half_m - 0.006, 7.0],
            [-half_m + 0.003, 7.004],
        ],
        vec![
            [-half_m, 0.0],
            [half_m, 0.0],
            [half_m, 20.0],
            [half_m - 7.0, 20.0],
            [half_m - 7.0, 7.0],
            [-half_m, 7.0],
        ],
        round.collect(),
    ]
}

/// All around a notch, which opens to one side of the street.
fn all_but([from, to]: Point, right: f64) -> [Point; 8] {
    let (far, left) = (500.0, 500.0);
    [
        [-far, -far],
        [far, -far],
        [far, left],
        [to, left],
        [to, right],
        [from, right],
        [from, left],
        [-far, left],
    ]
}

const HALVES_M: [f64; 5] = [4.0, 14.0, 34.0, 64.0, 104.0];

/// A street of 68 m at 30 degrees once had eleven points that had to be seen, and a notch of half the crossing between them.
#[test]
fn a_carriageway_is_covered_by_its_outline_and_by_nothing_with_a_notch() {
    for degrees in (0..=90).step_by(5) {
        for (half_m, outline) in HALVES_M
            .iter()
            .flat_map(|it| outlines(*it).map(|of| (it, of)))
        {
            let outline = all_at(degrees, &outline);
            let parts = Parts::of(&outline);
            assert_eq!(parts.all(), Coverage::ALL, "{degrees} {half_m}");
            // To the millimetre, as a feed may write it; also clockwise.
            let mut written = outline.clone();
            written
                .iter_mut()
                .flatten()
                .for_each(|it| *it = (*it * 1e3).round() / 1e3);
            for corners in [&outline, &written, &outline.iter().rev().copied().collect()] {
                assert_eq!(parts.covered(corners), Coverage::ALL, "{degrees} {half_m}");
            }
            assert_eq!(parts.covered(&[]), Coverage::NONE);
            assert_eq!(
                parts.covered(&all_at(degrees, &rectangle([900.0, 910.0], [0.0, 1.0]))),
                Coverage::NONE
            );
        }
        for half_m in HALVES_M {
            let parts = Parts::of(&all_at(degrees, &rectangle([-half_m, half_m], [0.0, 7.0])));
            for step in 0..80 {
                let from = -half_m - 0.1 + f64::from(step) / 80.0 * 2.0 * half_m;
                for right in [0.1, 3.4, 6.7] {
                    let notched = all_at(degrees, &all_but([from, from + 0.3], right));
                    let covered = parts.covered(&notched);
                    assert_ne!(covered, Coverage::ALL, "{degrees} {half_m} {from} {right}");
                }
            }
        }
    }
}

#[test]
fn no_place_that_is_left_out_is_in_a_covered_part() {
    let mut draws = ChaCha8Rng::seed_from_u64(1);
    let (mut out, mut covered_parts) = (0, 0);
    for _ in 0..3_000 {
        let (degrees, half_m) = (draws.random_range(0..360), draws.random_range(3.0..60.0));
        let outline = &outlines(half_m)[draws.random_range(0..5)];
        let outline = all_at(degrees, outline);
        let parts = Parts::of(&outline);
        // A star: any distances around a place, in order.
        let center = [
            draws.random_range(-half_m..half_m),
            draws.random_range(-2.0..9.0),
        ];
        let count: u8 = draws.random_range(3..20);
        let polygon: Vec<_> = (0..count)
            .map(|number| {
                let (sine, cosine) =
                    (f64::from(number) * std::f64::consts::TAU / f64::from(count)).sin_cos();
                let metres = draws.random_range(0.5..3.0 * half_m);
                at(
                    degrees / 2,
                    [center[0] + metres * cosine, center[1] + metres * sine],
                )
            })
            .collect();
        let covered = parts.covered(&polygon);
        covered_parts += covered.0.count_ones();
        let (road, polygon) = (Area::Polygon(outline), Area::Polygon(polygon));
        for _ in 0..100 {
            let place = at(
                degrees,
                [0, 1].map(|_| draws.random_range(-1.1 * half_m..1.1 * half_m)),
            );
            if !road.contains(place) {
                continue;
            }
            let there = turned(parts.axis, place);
            let pieces = parts
                .pieces
                .iter()
                .filter(|piece| piece.meets((there, there)));
            let there = together(pieces);
            assert_ne!(there, Coverage::NONE, "{place:?} is in no part of {road:?}");
            if polygon.distance_m(place) > 2.0 * EDGE_M {
                out += 1;
                let both = Coverage(covered.0 & there.0);
                assert_eq!(both, Coverage::NONE, "{place:?} {road:?} {polygon:?}");
            }
        }
    }
    assert!(
        out > 10_000 && covered_parts > 5_000,
        "{out} {covered_parts}"
    );
}
