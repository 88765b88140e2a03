//! The observation coverage ratio: the share of people on foot that a robot sees.
//!
//! A robot sees everybody within its perception radius. The ratio is the mean over people and time of
//! being seen by at least one robot, at every sample of the trace.

use crossguard_endpoint::ras::motion::{Point, distance_m};

use super::net::Streets;
use super::trace::{Run, Track};

/// The observation coverage ratio of robots on these ways, 0..1. A person in the zones of two robots
/// is seen once.
#[must_use]
pub fn coverage(run: &Run, robots: &[Track], radius_m: f64) -> f64 {
    let (mut seen, mut all) = (0_u32, 0_u32);
    for track in &run.pedestrians {
        for (index, motion) in (track.first_sample()..).zip(track.samples()) {
            all += 1;
            let near =
                |robot: &Track| distance_m(robot.place_at(index), motion.position_m) <= radius_m;
            seen += u32::from(robots.iter().any(near));
        }
    }
    f64::from(seen) / f64::from(all.max(1))
}

/// Where people are, and where robots see them. Shares are from 0 to 1.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Places {
    /// How long all people are on their way together, in seconds.
    pub travel_s: f64,
    /// Share of that time at an intersection.
    pub at_intersections: f64,
    /// Share of it on the road away from the crossings; 0 where the streets are no grid, whose lanes are not known.
    pub on_road_between: f64,
    /// Share of the time in which a robot sees them that they are at an intersection; 0 where no robot does.
    pub covered_at_intersections: f64,
}

/// Where people are on the streets, and where robots on these ways see them, from samples `sample_ms` apart.
#[must_use]
pub fn places(
    run: &Run,
    streets: &Streets,
    robots: &[Track],
    radius_m: f64,
    sample_ms: u64,
) -> Places {
    let is_between = |place| {
        streets
            .grid()
            .is_some_and(|grid| grid.is_on_road_between(place))
    };
    let (mut all, mut at, mut between, mut seen, mut seen_at) = (0_u32, 0_u32, 0_u32, 0_u32, 0_u32);
    for track in &run.pedestrians {
        for (index, motion) in (track.first_sample()..).zip(track.samples()) {
            let place = motion.position_m;
            let is_at = streets.is_at_intersection(place);
            let near = |robot: &Track| distance_m(robot.place_at(index), place) <= radius_m;
            let is_seen = robots.iter().any(near);
            all += 1;
            at += u32::from(is_at);
            between += u32::from(is_between(place));
            seen += u32::from(is_seen);
            seen_at += u32::from(is_seen && is_at);
        }
    }
    let share = |part: u32, of: u32| f64::from(part) / f64::from(of.max(1));
    #[expect(clippy::cast_precision_loss, reason = "half a second")]
    let seconds_each = sample_ms as f64 / 1_000.0;
    Places {
        travel_s: f64::from(all) * seconds_each,
        at_intersections: share(at, all),
        on_road_between: share(between, all),
        covered_at_intersections: share(seen_at, seen),
    }
}

/// `candidates` in the order in which each adds the most to the coverage of those before it, with the
/// coverage that is reached.
#[must_use]
pub fn greedy(runs: &[Run], candidates: &[Point], radius_m: f64) -> Vec<(usize, f64)> {
    let places: Vec<Point> = runs
        .iter()
        .flat_map(|run| &run.pedestrians)
        .flat_map(|track| track.samples().iter().map(|motion| motion.position_m))
        .collect();
    let (all, mut seen) = (places.len().max(1), 0);
    let order = most_seen(places, candidates, radius_m, candidates.len()).into_iter();
    let covered = order.map(|(index, gain)| {
        seen += gain;
        #[expect(clippy::cast_precision_loss, reason = "a few million")]
        let covered = seen as f64 / all as f64;
        (index, covered)
    });
    covered.collect()
}

/// At most so many of `candidates`, in the order in which each sees the most of these people that none before it sees, with how
/// many these are. Of equals the first one is taken.
pub(super) fn most_seen(
    mut unseen: Vec<Point>,
    candidates: &[Point],
    radius_m: f64,
    most: usize,
) -> Vec<(usize, usize)> {
    let mut left: Vec<usize> = (0..candidates.len()).collect();
    let mut order = Vec::new();
    while !left.is_empty() && order.len() < most {
        let sees = |index: usize, place: &Point| distance_m(candidates[index], *place) <= radius_m;
        let gain = |index: usize| unseen.iter().filter(|place| sees(index, place)).count();
        let gains: Vec<usize> = left.iter().map(|&index| gain(index)).collect();
        let most = gains.iter().max().copied().unwrap_or(0);
        let best = gains.iter().position(|&it| it == most).unwrap_or(0);
        let index = left.remove(best);
        unseen.retain(|place| !sees(index, place));
        order.push((index, gains[best]));
    }
    order
}

#[cfg(test)]
mod tests {
    use super::super::grid::Preset;
    use super::*;

    fn standing_at(places: &[Point]) -> Run {
        let track = |&place: &Point| Track::new(500, &[place, place]);
        Run {
            seed: 0,
            vehicles: Vec::new(),
            pedestrians: places.iter().map(track).collect(),
        }
    }

    #[test]
    fn who_is_seen_twice_counts_once() {
        let run = standing_at(&[[0.0, 0.0], [10.0, 0.0], [15.1, 0.0], [50.0, 0.0]]);
        let robots = [[0.0, 0.0], [5.0, 0.0]].map(Track::standing);
        assert!((coverage(&run, &robots[..1], 15.0) - 0.5).abs() < 1e-12);
        assert!((coverage(&run, &robots, 15.0) - 0.75).abs() < 1e-12);
        assert!(coverage(&run, &[], 15.0).abs() < 1e-12);
    }

    #[test]
    fn a_robot_that_walks_sees_along_its_way() {
        let walker = Track::new(500, &[[0.0, 0.0], [100.0, 0.0]]);
        let stays = Track::new(500, &[[100.0, 0.0], [100.0, 0.0]]);
        let run = Run {
            pedestrians: vec![stays],
            ..standing_at(&[])
        };
        assert!((coverage(&run, &[walker], 15.0) - 0.5).abs() < 1e-12);
    }

    #[test]
    fn people_are_at_intersections_or_between_them_and_robots_see_some() {
        let grid = Streets::Grid(Preset::Kerb.grid());
        // On a corner, in the middle of a street's lanes, on the sidewalk beside, and on the next corner.
        let run = standing_at(&[[92.1, 92.1], [50.0, 100.0], [78.0, 92.1], [0.0, 0.0]]);
        let robots = [Track::standing([92.1, 92.1])];
        let found = places(&run, &grid, &robots, 15.0, 500);
        let expected = Places {
            travel_s: 4.0,
            at_intersections: 0.5,
            on_road_between: 0.25,
            covered_at_intersections: 0.5,
        };
        assert_eq!(found, expected);
        assert!(
            places(&run, &grid, &[], 15.0, 500)
                .covered_at_intersections
                .abs()
                < 1e-12
        );
    }

    #[test]
    fn the_greedy_order_gains_less_and_less() {
        let run = standing_at(&[[0.0, 0.0], [1.0, 0.0], [100.0, 0.0], [200.0, 0.0]]);
        let order = greedy(&[run], &[[200.0, 0.0], [50.0, 0.0], [0.0, 0.0]], 15.0);
        let indices: Vec<usize> = order.iter().map(|(index, _)| *index).collect();
        assert_eq!(indices, [2, 0, 1]);
        assert!((order[2].1 - 0.75).abs() < 1e-12);
    }
}
