//! Dispatch by demand: robots go to where people are.
//!
//! ```text
//! at every interval   people that robots saw or heard since the last one
//!                  -> the places in whose zones most of them were, each without those of the places before it
//!                  -> each of these places takes the nearest robot that is still free
//!                  -> that robot walks there, east or west first, then north or south
//! ```
//!
//! Robots tell each other what they know, and know nothing else of the trace. A person is known at a sample where a robot sees
//! the person (within its radius, unless the person is one of `unseen_share`), or where the person carries a device (one of
//! `v2x_share`) within radio range of a robot. Not here: collisions, the rule by which a device sends, and its silence, which
//! begins when a robot sees it. A place of which nothing is known has no demand. A robot that no place takes keeps its own place,
//! or goes to the nearest free one if another robot was nearer to it.

use crossguard_endpoint::ras::motion::{Point, distance_m};

use super::behaviour::Behaviour;
use super::coverage::most_seen;
use super::schedule::Schedule;
use super::trace::Run;

pub(super) struct Dispatch<'a> {
    pub(super) run: &'a Run,
    pub(super) sample_ms: u64,
    pub(super) behaviour: &'a Behaviour,
    pub(super) radius_m: f64,
    /// Where robots can be; at the beginning they are at the first ones.
    pub(super) places: &'a [Point],
    pub(super) interval_s: u64,
    pub(super) speed_mps: f64,
}

/// A robot, and the number of the place that it is at or walks to.
struct Dispatched {
    way: Schedule,
    goal: usize,
}

impl Dispatch<'_> {
    /// The ways of `count` robots, at most as many as there are places.
    pub(super) fn schedules(&self, count: usize) -> Vec<Schedule> {
        let places = self.places.iter().take(count).enumerate();
        let mut robots: Vec<Dispatched> = places
            .map(|(goal, place)| Dispatched {
                way: Schedule::new(goal, vec![(0.0, *place)]),
                goal,
            })
            .collect();
        let (interval_ms, mut next) = (1_000 * self.interval_s, 0);
        for now_ms in (1..=self.run.duration_ms() / interval_ms).map(|it| it * interval_ms) {
            let samples = next..now_ms / self.sample_ms + 1;
            next = samples.end;
            let known = samples.flat_map(|sample| self.known(&robots, sample));
            let now_s = seconds(now_ms);
            let goals = self.goals(&robots, known.collect(), now_s);
            for (robot, goal) in robots.iter_mut().zip(goals) {
                if robot.goal != goal {
                    robot.goal = goal;
                    robot.way.walk(now_s, self.places[goal], self.speed_mps);
                }
            }
        }
        robots.into_iter().map(|it| it.way).collect()
    }

    /// Where the people are that robots see or hear at a sample of the run.
    fn known(&self, robots: &[Dispatched], sample: u64) -> Vec<Point> {
        let now_s = seconds(sample * self.sample_ms);
        let robots: Vec<Point> = robots.iter().map(|it| it.way.place_at(now_s)).collect();
        let people = &self.run.pedestrians;
        let devices = self.behaviour.devices(people.len());
        let heard_m = self.behaviour.radio.range_m();
        let known = people.iter().enumerate().filter_map(|(person, track)| {
            let sample = usize::try_from(sample)
                .ok()?
                .checked_sub(track.first_sample());
            let motion = track.samples().get(sample?)?;
            let is_hidden = u32::try_from(person).is_ok_and(|it| self.behaviour.is_unseen(it));
            let is_known = |robot: &Point| {
                let away_m = distance_m(*robot, motion.position_m);
                (away_m <= self.radius_m && !is_hidden) || (away_m <= heard_m && person < devices)
            };
            robots.iter().any(is_known).then_some(motion.position_m)
        });
        known.collect()
    }

    /// The number of the place of each robot, by where people were known to be.
    fn goals(&self, robots: &[Dispatched], known: Vec<Point>, now_s: f64) -> Vec<usize> {
        // Whole millimetres, so that equal ways are equal.
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "`as` saturates"
        )]
        let way_mm = |robot: usize, place: usize| {
            let (from, to) = (robots[robot].way.place_at(now_s), self.places[place]);
            (((to[0] - from[0]).abs() + (to[1] - from[1]).abs()) * 1e3).round() as u64
        };
        let mut goals: Vec<usize> = robots.iter().map(|it| it.goal).collect();
        let mut free: Vec<usize> = (0..robots.len()).collect();
        let wanted = most_seen(known, self.places, self.radius_m, robots.len());
        let wanted = wanted.into_iter().filter(|(_, seen)| *seen > 0);
        let wanted: Vec<usize> = wanted.map(|(place, _)| place).collect();
        for &place in &wanted {
            let nearest = free.iter().min_by_key(|it| way_mm(**it, place)).copied();
            if let Some(nearest) = nearest {
                free.retain(|it| *it != nearest);
                goals[nearest] = place;
            }
        }
        for robot in free {
            if wanted.contains(&goals[robot]) {
                let left = (0..self.places.len()).filter(|it| !goals.contains(it));
                let nearest = left.min_by_key(|it| way_mm(robot, *it));
                goals[robot] = nearest.unwrap_or(goals[robot]);
            }
        }
        goals
    }
}

#[expect(clippy::cast_precision_loss, reason = "a few hours")]
fn seconds(time_ms: u64) -> f64 {
    time_ms as f64 / 1_000.0
}

#[cfg(test)]
mod tests {
    use super::super::grid::Preset;
    use super::super::shipped;
    use super::super::stationing::Stationing;
    use super::super::trace::Track;
    use super::*;

    const PLACES: [Point; 3] = [[0.0, 0.0], [100.0, 0.0], [200.0, 0.0]];

    fn dispatch<'a>(run: &'a Run, behaviour: &'a Behaviour) -> Dispatch<'a> {
        Dispatch {
            run,
            sample_ms: 500,
            behaviour,
            radius_m: 15.0,
            places: &PLACES,
            interval_s: 20,
            speed_mps: 1.0,
        }
    }

    fn run(pedestrians: Vec<Track>) -> Run {
        Run {
            seed: 1,
            vehicles: vec![Track::new(500, &[[50.0, 0.0]; 501])],
            pedestrians,
        }
    }

    /// A person leaves the first place after a minute, is within 15 m of the second one at 102.5 s, and stays there.
    #[test]
    fn a_robot_follows_people_once_it_hears_that_they_are_elsewhere_and_not_without_evidence() {
        let at = |sample: u32| [(f64::from(sample) - 120.0).clamp(0.0, 100.0), 3.0];
        let person = vec![Track::new(500, &(0..=500).map(at).collect::<Vec<_>>())];
        let [first, second, _] = PLACES;
        let stays = vec![(0.0, first)];
        let follows = vec![(0.0, first), (120.0, first), (220.0, second)];
        // A person at the second place is unknown without a device, or with one that is heard 54 m away at most.
        for (people, v2x_share, exponent, expected) in [
            (person.clone(), 1.0, 2.2, follows),
            (person.clone(), 0.0, 2.2, stays.clone()),
            (person, 1.0, 3.47, stays.clone()),
            (vec![], 1.0, 2.2, stays),
        ] {
            let mut behaviour = Behaviour {
                v2x_share,
                ..Behaviour::default()
            };
            behaviour.radio.exponent = exponent;
            let found = dispatch(&run(people), &behaviour).schedules(1);
            assert_eq!(found, [Schedule::new(0, expected)]);
        }
    }

    #[test]
    fn a_place_takes_the_nearest_free_robot_and_no_two_robots_have_the_same_place() {
        let (run, behaviour) = (run(vec![]), Behaviour::default());
        let robot = |(east_m, goal)| Dispatched {
            way: Schedule::new(0, vec![(0.0, [east_m, 0.0])]),
            goal,
        };
        let [near, middle, far] = PLACES;
        let both_go = [(0.0, 0), (100.0, 1)];
        let back = [(0.0, 1), (90.0, 2)];
        for (robots, known, expected) in [
            // The place with the most people is the first to choose.
            (both_go, vec![far, far, middle], [1, 2]),
            // Of equals the first robot.
            ([(50.0, 1), (50.0, 2)], vec![near], [0, 2]),
            // The second robot is nearer to where the first one walks, which goes back.
            (back, vec![middle], [0, 1]),
            (back, vec![], [1, 2]),
        ] {
            let found = dispatch(&run, &behaviour).goals(&robots.map(robot), known, 0.0);
            assert_eq!(found, expected);
        }
    }

    #[test]
    fn two_runs_that_differ_after_100_s_send_robots_the_same_way_until_the_next_interval() {
        let traces = shipped::traces(Preset::Kerb, 20).unwrap().unwrap();
        let mut other = traces.runs[0].clone();
        for (track, later) in other
            .pedestrians
            .iter_mut()
            .zip(&traces.runs[1].pedestrians)
        {
            let at = |sample| if sample <= 200 { &*track } else { later }.place_at(sample);
            *track = Track::new(500, &(0..=400).map(at).collect::<Vec<_>>());
        }
        let stationing = Stationing {
            robots_per_intersection: 4,
            patrol_mps: Some(1.0),
            dispatch_interval_s: Some(20),
            ..Stationing::at(Preset::Kerb.site())
        };
        let behaviour = Behaviour::default();
        let ways = [&traces.runs[0], &other]
            .map(|run| stationing.robots(&traces, run, 9, 15.0, &behaviour));
        let is_same = |sample: usize| {
            let [one, other] = ways.each_ref().map(|ways| {
                let places = ways.iter().map(|it| it.place_at(sample));
                places.collect::<Vec<_>>()
            });
            one == other
        };
        assert!((0..=240).all(is_same) && !(241..=400).all(is_same));
        let walked = |it: &Track| distance_m(it.place_at(0), it.place_at(200)) > 1.0;
        assert!(ways[0].iter().any(walked));
    }
}
