//! Where robots are: how many at an intersection, at which of its corners, and whether they walk.

use crossguard_endpoint::ras::motion::Point;
use serde::Serialize;

use super::grid::{Grid, Site};
use super::net::Streets;
use super::schedule::Schedule;
use super::trace::Track;

/// The corners of an intersection clockwise, as a robot walks around it.
const CLOCKWISE: [Site; 4] = [
    Site::SouthWest,
    Site::NorthWest,
    Site::NorthEast,
    Site::SouthEast,
];

/// Where robots are.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Stationing {
    /// Where at its intersection the first robot stands, or begins to walk.
    pub robot_site: Site,
    /// How many robots are at an intersection before the next one gets any, 1..4. The second is at the
    /// opposite corner of the first, the others at those between.
    pub robots_per_intersection: usize,
    /// How fast robots walk around their intersection, over its corners, in m/s; `None` if they stand.
    pub patrol_mps: Option<f64>,
    /// Where each robot is by a file, instead of at intersections.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub robots_at: Option<Vec<Schedule>>,
}

impl Stationing {
    /// One robot that stands at each intersection.
    #[must_use]
    pub const fn at(site: Site) -> Self {
        Self {
            robot_site: site,
            robots_per_intersection: 1,
            patrol_mps: None,
            robots_at: None,
        }
    }

    /// Checks that `most` robots can be so on the streets.
    ///
    /// # Errors
    /// What is wrong.
    pub fn check(&self, streets: &Streets, most: usize) -> Result<(), StationingError> {
        let room = match &self.robots_at {
            Some(robots) => robots.len(),
            None => streets.nodes().len() * self.robots_per_intersection,
        };
        if !(1..=CLOCKWISE.len()).contains(&self.robots_per_intersection) {
            return Err(StationingError::PerIntersection(
                self.robots_per_intersection,
            ));
        }
        if let Some(patrol_mps) = self.patrol_mps
            && !(0.1..=5.0).contains(&patrol_mps)
        {
            return Err(StationingError::Patrol(patrol_mps));
        }
        if self.robot_site == Site::Center
            && (self.robots_per_intersection > 1 || self.patrol_mps.is_some())
        {
            return Err(StationingError::NoCorner);
        }
        if most > room {
            return Err(StationingError::Room { most, room });
        }
        Ok(())
    }

    /// Where `count` robots are in a run: the first ones at the middle intersection, the others at those
    /// around it. Robots that walk have a sample every `sample_ms` for `duration_ms`. On a net, whose sidewalks are not
    /// known, they stand in the middle of intersections. By a file, the first ones of it are there.
    #[must_use]
    pub fn robots(
        &self,
        streets: &Streets,
        count: usize,
        duration_ms: u64,
        sample_ms: u64,
    ) -> Vec<Track> {
        if let Some(robots) = &self.robots_at {
            let robots = robots.iter().take(count);
            return robots.map(|it| it.track(duration_ms, sample_ms)).collect();
        }
        let Streets::Grid(grid) = streets else {
            let nodes = streets.nodes().into_iter().take(count);
            return nodes.map(Track::standing).collect();
        };
        let first = CLOCKWISE.iter().position(|it| *it == self.robot_site);
        let nodes = grid.nodes().into_iter();
        let posts = nodes.flat_map(|node| {
            let per_intersection = 0..self.robots_per_intersection;
            per_intersection.map(move |number| (node, [0, 2, 1, 3][number % 4]))
        });
        let robots = posts.take(count).map(|(node, turns)| {
            let Some(first) = first else {
                return Track::standing(grid.robot_at(node, self.robot_site));
            };
            let corner = (first + turns) % CLOCKWISE.len();
            match self.patrol_mps {
                None => Track::standing(grid.robot_at(node, CLOCKWISE[corner])),
                Some(speed_mps) => {
                    let place = |sample: u64| {
                        #[expect(clippy::cast_precision_loss, reason = "a few minutes")]
                        let walked_m = speed_mps * (sample * sample_ms) as f64 / 1_000.0;
                        around(grid, node, corner, walked_m)
                    };
                    let samples = 0..=duration_ms / sample_ms;
                    Track::new(sample_ms, &samples.map(place).collect::<Vec<_>>())
                }
            }
        });
        robots.collect()
    }
}

/// Where somebody is who walked so far clockwise around an intersection, from one of its corners.
fn around(grid: &Grid, node: Point, corner: usize, walked_m: f64) -> Point {
    let side_m = 2.0 * grid.corner_m();
    let walked_m = walked_m.rem_euclid(4.0 * side_m);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "0 to 4"
    )]
    let sides = (walked_m / side_m) as usize;
    let at = |sides: usize| grid.robot_at(node, CLOCKWISE[(corner + sides) % CLOCKWISE.len()]);
    let (from, to) = (at(sides), at(sides + 1));
    let share = (walked_m / side_m).fract();
    [0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) * share)
}

/// Why robots cannot be so.
#[derive(Clone, Copy, PartialEq, Debug, thiserror::Error)]
pub enum StationingError {
    /// An intersection has four corners.
    #[error("an intersection takes 1 to 4 robots, one at each corner, not {0}")]
    PerIntersection(usize),
    /// Too slow to be a walk, or too fast.
    #[error("a robot walks at 0.1 to 5 m/s, not {0} m/s")]
    Patrol(f64),
    /// There is one middle, and no way around it.
    #[error(
        "several robots at an intersection and robots that walk are at its corners: choose one \
         with --site, like south-west"
    )]
    NoCorner,
    /// There are more robots than places.
    #[error("there are places for {room} robots, not for {most}")]
    Room {
        /// How many robots there are.
        most: usize,
        /// For how many there is room.
        room: usize,
    },
}

#[cfg(test)]
mod tests {
    use crossguard_endpoint::ras::motion::distance_m;

    use super::super::grid::Preset;
    use super::*;

    fn grid() -> Streets {
        Streets::Grid(Preset::Kerb.grid())
    }

    #[test]
    fn one_robot_stands_in_the_middle_of_the_grid_and_nine_everywhere() {
        let stationing = Stationing::at(Preset::Kerb.site());
        let one = stationing.robots(&grid(), 1, 1_000, 500);
        assert!(distance_m(one[0].place_at(7), [92.1, 92.1]) < 1e-9);
        assert_eq!(stationing.robots(&grid(), 9, 1_000, 500).len(), 9);
        assert_eq!(stationing.check(&grid(), 9), Ok(()));
        let room = StationingError::Room { most: 10, room: 9 };
        assert_eq!(stationing.check(&grid(), 10), Err(room));
    }

    #[test]
    fn two_robots_of_an_intersection_stand_at_opposite_corners() {
        let stationing = Stationing {
            robots_per_intersection: 2,
            ..Stationing::at(Site::SouthEast)
        };
        let robots = stationing.robots(&grid(), 3, 1_000, 500);
        let places: Vec<_> = robots.iter().map(|robot| robot.place_at(0)).collect();
        assert!(distance_m(places[0], [107.9, 92.1]) < 1e-9);
        assert!(distance_m(places[1], [92.1, 107.9]) < 1e-9);
        assert!(distance_m(places[0], places[2]) > 90.0);
        assert_eq!(stationing.check(&grid(), 18), Ok(()));
    }

    #[test]
    fn a_robot_that_walks_passes_all_corners() {
        let stationing = Stationing {
            patrol_mps: Some(1.0),
            ..Stationing::at(Site::SouthWest)
        };
        let robot = stationing.robots(&grid(), 1, 63_200, 100).remove(0);
        for (second, corner) in [
            (0.0, [92.1, 92.1]),
            (15.8, [92.1, 107.9]),
            (63.2, [92.1, 92.1]),
        ] {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "seconds"
            )]
            let place = robot.place_at((second * 10.0) as usize);
            assert!(distance_m(place, corner) < 1e-6, "{second}: {place:?}");
        }
        let walking = robot.motion(5_000_000);
        assert!((walking.speed_mps - 1.0).abs() < 1e-6 && walking.heading_deg.abs() < 1e-6);
    }

    #[test]
    fn there_is_no_way_around_the_middle() {
        let stationing = Stationing {
            robots_per_intersection: 2,
            ..Stationing::at(Site::Center)
        };
        assert_eq!(stationing.check(&grid(), 2), Err(StationingError::NoCorner));
    }
}
