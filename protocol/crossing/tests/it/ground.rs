//! Ways and shapes.

use crossguard_crossing::*;

use crate::scene::*;

fn at((east, north): (i32, i32)) -> Point {
    Point::new(east, north)
}

#[test]
fn a_way_that_leads_over_a_road_is_noticed() {
    let road = rectangle(-3_000, 0, 3_000, 700).unwrap();
    for (from, to, expected) in [
        ((0, -100), (0, 800), true),
        ((0, -100), (0, 100), true),
        ((-3_100, -100), (3_100, 800), true),
        ((-3_100, 500), (-2_800, 800), true),
        ((0, -100), (0, -10), false),
        ((-100, -100), (100, -10), false),
        ((-3_100, 350), (-3_010, 350), false),
        ((-3_100, 600), (-2_900, 900), false),
        ((-3_100, 350), (-3_000, 350), true),
        ((3_100, 350), (3_000, 350), false),
    ] {
        for [from, to] in [[from, to], [to, from]] {
            assert_eq!(
                road.is_between(at(from), at(to)),
                expected,
                "{from:?} {to:?}"
            );
        }
    }
}

/// Two shapes side by side have no place in common.
#[test]
fn a_shape_has_two_of_its_sides() {
    let shape = rectangle(0, 0, 10, 10).unwrap();
    for (place, expected) in [
        ((0, 5), true),
        ((10, 5), false),
        ((5, 0), true),
        ((5, 10), false),
    ] {
        assert_eq!(shape.has(at(place)), expected, "{place:?}");
    }
}

#[test]
fn a_place_that_is_too_far_is_at_the_edge_of_its_side() {
    for (cm, expected) in [(i32::MIN, -FAR_CM), (-FAR_CM, -FAR_CM), (i32::MAX, FAR_CM)] {
        let place = Point::new(cm, -1);
        assert_eq!((place.east_cm(), place.north_cm()), (expected, -1));
    }
}

#[test]
fn the_middle_of_a_shape_is_the_mean_of_its_corners() {
    let corners = [(100, 200), (700, -200), (400, 600)].map(at);
    assert_eq!(Shape::new(&corners).unwrap().middle(), at((400, 200)));
}

#[test]
fn a_part_of_a_way_has_its_direction_and_an_end() {
    let far = 2 * FAR_CM;
    let way = |(east_cm, north_cm)| Way { east_cm, north_cm };
    for (whole, numerator, denominator, expected) in [
        ((300, -400), 1, 2, (150, -200)),
        ((300, -400), -3, 1, (-900, 1_200)),
        ((300, -400), 1, 0, (0, 0)),
        ((far, -far), 1, 1, (far, -far)),
        ((i32::MAX, i32::MIN), 3, 1, (far, -far)),
    ] {
        let part = way(whole).part(numerator, denominator);
        assert_eq!(part, way(expected), "{whole:?} * {numerator}");
    }
}
