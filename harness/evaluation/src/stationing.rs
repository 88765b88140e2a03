//! Where robots are: how many at an intersection, at which of its corners, and whether they walk.

use crossguard_endpoint::ras::motion::Point;
use serde::Serialize;

use super::behaviour::Behaviour;
use super::dispatch::Dispatch;
use super::grid::Site;
use super::net::Streets;
use super::schedule::Schedule;
use super::trace::{Run, Traces, Track};

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
    /// How fast robots walk, in m/s: around their intersection over its corners, or where they are dispatched to; `None` if they
    /// stand.
    pub patrol_mps: Option<f64>,
    /// How often robots that walk are dispatched to where people are, in seconds; `None` if they are not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dispatch_interval_s: Option<u64>,
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
            dispatch_interval_s: None,
            robots_at: None,
        }
    }

    /// Checks that `most` robots can be so on the streets.
    ///
    /// # Errors
    /// There is no room or no corner for them, or a number is out of its range.
    pub fn check(&self, streets: &Streets, most: usize) -> Result<(), StationingError> {
        let room = match &self.robots_at {
            Some(robots) => robots.len(),
            None => streets.nodes().len() * self.robots_per_intersection,
        };
        let wrong = |why| Err(StationingError(why));
        let patrols = self.patrol_mps.is_some() && self.dispatch_interval_s.is_none();
        if !(1..=CLOCKWISE.len()).contains(&self.robots_per_intersection) {
            return wrong(format!(
                "an intersection takes 1 to 4 robots, one at each corner, not {}",
                self.robots_per_intersection
            ));
        }
        if let Some(patrol_mps) = self.patrol_mps
            && !(0.1..=5.0).contains(&patrol_mps)
        {
            return wrong(format!(
                "a robot walks at 0.1 to 5 m/s, not {patrol_mps} m/s"
            ));
        }
        if self.robot_site == Site::Center && (self.robots_per_intersection > 1 || patrols) {
            let why = "several robots at an intersection and robots that walk are at its corners: choose one with --site, like \
                       south-west";
            return wrong(why.to_owned());
        }
        if most > room {
            return wrong(format!(
                "there are places for {room} robots, not for {most}"
            ));
        }
        Ok(())
    }

    /// Where `count` robots are in a run of these traces, with this perception radius.
    #[must_use]
    pub fn robots(
        &self,
        traces: &Traces,
        run: &Run,
        count: usize,
        radius_m: f64,
        behaviour: &Behaviour,
    ) -> Vec<Track> {
        let (streets, sample_ms) = (&traces.streets, traces.sample_ms);
        let schedules = match (self.dispatch_interval_s, self.patrol_mps) {
            (Some(interval_s), Some(speed_mps)) => {
                let all = self.schedules(streets, usize::MAX, 0);
                let places: Vec<Point> = all.iter().map(|it| it.place_at(0.0)).collect();
                let dispatch = Dispatch {
                    run,
                    sample_ms,
                    behaviour,
                    radius_m,
                    places: &places,
                    interval_s,
                    speed_mps,
                };
                dispatch.schedules(count)
            }
            _ => self.schedules(streets, count, run.duration_ms()),
        };
        let schedules = schedules.iter();
        schedules
            .map(|it| it.track(run.duration_ms(), sample_ms))
            .collect()
    }

    /// Where `count` robots are, whatever people do, or where dispatched ones begin: the first ones at the middle intersection, the
    /// others at those around it. On a net, whose sidewalks are not known, they stand in the middle of intersections. By a file,
    /// the first ones of it are there.
    #[must_use]
    pub fn schedules(&self, streets: &Streets, count: usize, duration_ms: u64) -> Vec<Schedule> {
        if let Some(robots) = &self.robots_at {
            return robots.iter().take(count).cloned().collect();
        }
        let standing = |(number, place)| Schedule::new(number, vec![(0.0, place)]);
        let Streets::Grid(grid) = streets else {
            let nodes = streets.nodes().into_iter().take(count);
            return nodes.enumerate().map(standing).collect();
        };
        let first = CLOCKWISE.iter().position(|it| *it == self.robot_site);
        let nodes = grid.nodes().into_iter();
        let posts = nodes.flat_map(|node| {
            let per_intersection = 0..self.robots_per_intersection;
            per_intersection.map(move |number| (node, [0, 2, 1, 3][number % 4]))
        });
        let robots = posts
            .take(count)
            .enumerate()
            .map(|(number, (node, turns))| {
                let Some(first) = first else {
                    return standing((number, grid.robot_at(node, self.robot_site)));
                };
                let at = |sides: u32| {
                    let corner = (first + turns + sides as usize) % CLOCKWISE.len();
                    grid.robot_at(node, CLOCKWISE[corner])
                };
                let Some(speed_mps) = self.patrol_mps else {
                    return standing((number, at(0)));
                };
                let side_s = 2.0 * grid.corner_m() / speed_mps;
                let corners = (0..).map(|sides| (f64::from(sides) * side_s, at(sides)));
                #[expect(clippy::cast_precision_loss, reason = "a few hours")]
                let is_before = |at_s: f64| at_s < duration_ms as f64 / 1_000.0 + side_s;
                let corners = corners.take_while(|it| is_before(it.0));
                Schedule::new(number, corners.collect())
            });
        robots.collect()
    }
}

/// Why robots cannot be so, in words.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("{0}")]
pub struct StationingError(String);

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
        let one = stationing.schedules(&grid(), 1, 1_000);
        assert!(distance_m(one[0].place_at(3.5), [92.1, 92.1]) < 1e-9);
        assert_eq!(stationing.schedules(&grid(), 9, 1_000).len(), 9);
        assert_eq!(stationing.check(&grid(), 9), Ok(()));
        let refused = stationing.check(&grid(), 10).unwrap_err().to_string();
        assert_eq!(refused, "there are places for 9 robots, not for 10");
    }

    #[test]
    fn two_robots_of_an_intersection_stand_at_opposite_corners() {
        let stationing = Stationing {
            robots_per_intersection: 2,
            ..Stationing::at(Site::SouthEast)
        };
        let robots = stationing.schedules(&grid(), 3, 1_000);
        let places: Vec<_> = robots.iter().map(|robot| robot.place_at(0.0)).collect();
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
        let robot = stationing.schedules(&grid(), 1, 63_200).remove(0);
        for (second, corner) in [
            (0.0, [92.1, 92.1]),
            (15.8, [92.1, 107.9]),
            (63.2, [92.1, 92.1]),
        ] {
            let place = robot.place_at(second);
            assert!(distance_m(place, corner) < 1e-6, "{second}: {place:?}");
        }
        let walking = robot.track(63_200, 100).motion(5_000_000);
        assert!((walking.speed_mps - 1.0).abs() < 1e-6 && walking.heading_deg.abs() < 1e-6);
    }

    #[test]
    fn there_is_no_way_around_the_middle() {
        let stationing = Stationing {
            robots_per_intersection: 2,
            ..Stationing::at(Site::Center)
        };
        let refused = stationing.check(&grid(), 2).unwrap_err().to_string();
        assert!(refused.contains("at its corners"), "{refused}");
        // But one to another intersection.
        let dispatched = Stationing {
            patrol_mps: Some(1.0),
            dispatch_interval_s: Some(20),
            ..Stationing::at(Site::Center)
        };
        assert_eq!(dispatched.check(&grid(), 2), Ok(()));
    }
}
