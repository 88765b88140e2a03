//! Where people are, as far as sights in logs tell, and which of them are on the carriageway.
//!
//! ```text
//!   sight of a robot ──► tracks: nearest first, no faster than on foot ──┐
//!   outlines ──► carriageway: the road, and beside it between its kerbs ─┴─► who is on it
//! ```
//!
//! A person inside the outline of a road of any robot is on the carriageway. A person who leaves it sideways,
//! between the lines of its kerbs, is still on it. Kerbs are the edges of the road at which people wait. A robot
//! may lose a person from sight: that person stays in the last place for [`STAYS_US`].

use std::collections::BTreeMap;

use crossguard_robot::sight::{Degrees, Outline, RoadUser, Sight};

use crate::seconds;

/// Metres to the east and to the north of the first place in the logs.
pub(super) type Metres = [f64; 2];

/// For how long somebody who is not seen any more is taken to be there, in µs of the robots' own time.
pub(super) const STAYS_US: u64 = 1_000_000;

/// Largest speed on foot, and error of a place.
const ON_FOOT_MAX_MPS: f64 = 4.0;
const PLACE_ERROR_M: f64 = 0.5;

const METRES_PER_DEGREE: f64 = 111_195.0;

/// How far from the middle of an edge it is looked at what lies on its sides, in metres.
const BESIDE_M: f64 = 0.1;

/// People and roads of a run.
#[derive(Debug, Default)]
pub(super) struct Ground {
    origin: Option<Degrees>,
    /// By the robots that told of them.
    roads: BTreeMap<String, Carriageway>,
    watchers: BTreeMap<String, Watcher>,
    pub(super) has_sights: bool,
    /// How many times as fast as real the fastest robot moves; 0 before any has said it.
    speed: f64,
}

/// A robot, and the people that it sees.
#[derive(Debug, Default)]
struct Watcher {
    /// When it did something last.
    awake_us: u64,
    people: Vec<Person>,
}

#[derive(Clone, Copy, Debug)]
struct Person {
    at: Metres,
    is_on_road: bool,
    /// When the robot had them last; `None` while it has them.
    lost_us: Option<u64>,
    /// When the sight was that they are from.
    sighted_us: u64,
}

/// A person on the carriageway.
#[derive(Clone, Copy, Debug)]
pub(super) struct OnRoad<'a> {
    pub(super) at: Metres,
    /// They stepped on the road then, or before: so far they have come from its nearest edge.
    pub(super) since_us: u64,
    /// The robot that saw them.
    pub(super) by: &'a str,
}

impl Ground {
    pub(super) fn metres(&mut self, place: Degrees) -> Metres {
        let (latitude, longitude) = *self.origin.get_or_insert(place);
        let east = (place.1 - longitude) * latitude.to_radians().cos();
        [east, place.0 - latitude].map(|degrees| degrees * METRES_PER_DEGREE)
    }

    pub(super) fn has_road(&self) -> bool {
        self.roads.values().any(|road| road.road.len() > 2)
    }

    /// A robot watches this zone from now on.
    pub(super) fn outline(&mut self, robot: &str, outline: &Outline) {
        let mut corners = |corners: &[Degrees]| -> Vec<Metres> {
            corners.iter().map(|corner| self.metres(*corner)).collect()
        };
        let (waiting, road) = (corners(&outline.waiting), corners(&outline.road));
        let mut road = Carriageway::of(&waiting, road);
        road.crossing = corners(&outline.crossing);
        self.roads.insert(robot.to_owned(), road);
    }

    /// The part of the road on which people cross, as a robot has it.
    pub(super) fn crossing(&self, robot: &str) -> Option<&[Metres]> {
        let road = self.roads.get(robot)?;
        let outline = [&road.crossing, &road.road].map(Vec::as_slice);
        outline.into_iter().find(|corners| corners.len() > 2)
    }

    /// How far a place is off the road of a robot, in metres, negative on it.
    pub(super) fn off_road_m(&self, robot: &str, at: Metres) -> Option<f64> {
        let road = self.roads.get(robot).filter(|it| it.road.len() > 2)?;
        let edge_m = road.depth(at);
        Some(if road.contains(at) { -edge_m } else { edge_m })
    }

    /// A robot has made a record, so it lives.
    pub(super) fn lives(&mut self, robot: &str, at_us: u64) {
        if let Some(watcher) = self.watchers.get_mut(robot) {
            watcher.awake_us = at_us;
        }
    }

    /// A robot sees nothing any more.
    pub(super) fn forget(&mut self, robot: &str) {
        self.watchers.remove(robot);
    }

    /// The sensors of a robot have these people now, and no others.
    pub(super) fn see(&mut self, robot: &str, at_us: u64, sight: &Sight) {
        self.has_sights = true;
        let (pace, stays_us) = (self.pace(), self.stays_us());
        let on_foot = sight
            .people
            .iter()
            .filter(|seen| matches!(seen.class, RoadUser::Pedestrian | RoadUser::WheelchairUser));
        let places: Vec<_> = on_foot.map(|seen| self.metres(seen.place)).collect();
        let watcher = self.watchers.entry(robot.to_owned()).or_default();
        let lost_us = watcher.awake_us;
        let before = std::mem::take(&mut watcher.people);
        let came_from = came_from(&places, &before, at_us, pace);
        let roads = &self.roads;
        watcher.people = (places.iter().zip(&came_from))
            .map(|(at, from)| Person {
                at: *at,
                is_on_road: roads.values().any(|road| {
                    let was_on_road = from.is_some_and(|from| before[from].is_on_road);
                    road.contains(*at) || was_on_road && road.is_between_kerbs(*at)
                }),
                lost_us: None,
                sighted_us: at_us,
            })
            .collect();
        let lost = before.iter().enumerate();
        let lost = lost.filter(|(place, _)| !came_from.contains(&Some(*place)));
        watcher.people.extend(lost.map(|(_, person)| Person {
            lost_us: Some(person.lost_us.unwrap_or(lost_us)),
            ..*person
        }));
        let stays = |since_us: u64| at_us.saturating_sub(since_us) <= stays_us;
        watcher.people.retain(|it| it.lost_us.is_none_or(stays));
        watcher.awake_us = at_us;
    }

    /// A robot moves this many times as fast as real.
    pub(super) fn move_at(&mut self, speed: f64) {
        self.speed = self.speed.max(speed);
    }

    /// How many times as fast as real people walk.
    fn pace(&self) -> f64 {
        self.speed.max(1.0)
    }

    /// For how long somebody who is not seen any more is taken to be there, in µs.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_precision_loss,
        reason = "a second at most"
    )]
    pub(super) fn stays_us(&self) -> u64 {
        (STAYS_US as f64 / self.pace()) as u64
    }

    /// Whether another robot, which has nobody on the road, saw somebody beside it later who may be this person.
    fn is_seen_off_road(&self, person: &Person, by: &str) -> bool {
        let others = self.watchers.iter().filter(|(other, _)| *other != by);
        let mut clear = others.filter(|(_, it)| it.people.iter().all(|seen| !seen.is_on_road));
        clear.any(|(_, watcher)| {
            watcher.people.iter().any(|seen| {
                let passed_us = seen.sighted_us.saturating_sub(person.sighted_us);
                let walked_m = ON_FOOT_MAX_MPS * self.pace() * seconds(passed_us);
                seen.lost_us.is_none()
                    && seen.sighted_us > person.sighted_us
                    && distance(seen.at, person.at) <= walked_m + PLACE_ERROR_M
            })
        })
    }

    /// When a person on the carriageway has stepped on it, at the latest.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "some seconds"
    )]
    fn stepped_on_us(&self, person: &Person) -> u64 {
        let inside = self.roads.values().filter(|road| road.contains(person.at));
        let depths = inside.map(|road| road.depth(person.at) - PLACE_ERROR_M);
        // Beside the outline of a road nothing is known.
        let depth = depths.reduce(f64::min).unwrap_or_default().max(0.0);
        let way_us = depth / ON_FOOT_MAX_MPS / self.pace() * 1e6;
        person.sighted_us.saturating_sub(way_us as u64)
    }

    /// People on the carriageway.
    pub(super) fn on_road(&self, at_us: u64) -> impl Iterator<Item = OnRoad<'_>> {
        self.watchers.iter().flat_map(move |(by, watcher)| {
            let is_there = move |person: &&Person| {
                let seen_us = person.lost_us.unwrap_or(watcher.awake_us);
                person.is_on_road
                    && at_us.saturating_sub(seen_us) <= self.stays_us()
                    && !self.is_seen_off_road(person, by)
            };
            let people = watcher.people.iter().filter(is_there);
            people.map(|person| OnRoad {
                at: person.at,
                since_us: self.stepped_on_us(person),
                by,
            })
        })
    }
}

/// Where each of the people was before, the nearest pairs first. People walk no faster than on foot.
fn came_from(places: &[Metres], before: &[Person], at_us: u64, pace: f64) -> Vec<Option<usize>> {
    let mut pairs = Vec::new();
    for (now, place) in places.iter().enumerate() {
        for (was, person) in before.iter().enumerate() {
            let far = distance(*place, person.at);
            let passed_us = at_us.saturating_sub(person.sighted_us).min(STAYS_US);
            if far <= ON_FOOT_MAX_MPS * pace * seconds(passed_us) + PLACE_ERROR_M {
                pairs.push((far, now, was));
            }
        }
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut came_from = vec![None; places.len()];
    for (_, now, was) in pairs {
        if came_from[now].is_none() && !came_from.contains(&Some(was)) {
            came_from[now] = Some(was);
        }
    }
    came_from
}

/// The part of a road on which people cross.
#[derive(Debug)]
struct Carriageway {
    road: Vec<Metres>,
    /// The part of it on which people cross, if it is not the whole.
    crossing: Vec<Metres>,
    /// The edges at which people wait.
    kerbs: Vec<[Metres; 2]>,
}

impl Carriageway {
    fn of(waiting: &[Metres], road: Vec<Metres>) -> Self {
        let ends = road.iter().cycle().skip(1);
        let edges = road.iter().zip(ends).map(|(from, to)| [*from, *to]);
        let is_kerb = |[from, to]: &[Metres; 2]| {
            let length = distance(*from, *to).max(f64::MIN_POSITIVE);
            let [x, y] = [0, 1].map(|axis| f64::midpoint(from[axis], to[axis]));
            let [dx, dy] = [to[0] - from[0], to[1] - from[1]].map(|it| it / length * BESIDE_M);
            let sides = [[x - dy, y + dx], [x + dy, y - dx]];
            let is_inside = |at: &Metres| contains(&road, *at);
            sides
                .iter()
                .all(|at| is_inside(at) || contains(waiting, *at))
        };
        let kerbs = edges.filter(is_kerb).collect();
        Self {
            road,
            crossing: Vec::new(),
            kerbs,
        }
    }

    fn contains(&self, at: Metres) -> bool {
        contains(&self.road, at)
    }

    /// How far a place is from the nearest edge.
    fn depth(&self, at: Metres) -> f64 {
        let ends = self.road.iter().cycle().skip(1);
        let from_edge = |(from, to): (&Metres, &Metres)| {
            let way = [to[0] - from[0], to[1] - from[1]];
            let length = way[0].hypot(way[1]).max(f64::MIN_POSITIVE);
            let along = ((at[0] - from[0]) * way[0] + (at[1] - from[1]) * way[1]) / length;
            let along = along.clamp(0.0, length) / length;
            distance(at, [from[0] + along * way[0], from[1] + along * way[1]])
        };
        let edges = self.road.iter().zip(ends).map(from_edge);
        edges.fold(f64::INFINITY, f64::min)
    }

    /// Whether a place is between the lines of the kerbs, however far along the road.
    fn is_between_kerbs(&self, at: Metres) -> bool {
        #[expect(clippy::cast_precision_loss, reason = "an outline has few corners")]
        let count = self.road.len() as f64;
        let middle =
            [0, 1].map(|axis| self.road.iter().map(|corner| corner[axis]).sum::<f64>() / count);
        let side = |[from, to]: [Metres; 2], at: Metres| {
            (to[0] - from[0]) * (at[1] - from[1]) - (to[1] - from[1]) * (at[0] - from[0])
        };
        let is_inward = |kerb: &[Metres; 2]| side(*kerb, at) * side(*kerb, middle) > 0.0;
        self.kerbs.len() > 1 && self.kerbs.iter().all(is_inward)
    }
}

pub(super) fn contains(corners: &[Metres], [x, y]: Metres) -> bool {
    let ends = corners.iter().cycle().skip(1);
    let crossed = corners.iter().zip(ends).filter(|([ax, ay], [bx, by])| {
        (*ay > y) != (*by > y) && x < ax + (y - ay) / (by - ay) * (bx - ax)
    });
    crossed.count() % 2 == 1
}

pub(super) fn distance(a: Metres, b: Metres) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A road from 0 to 7 m to the north, 8 m wide, with pavements of 2.5 m.
    fn road() -> Carriageway {
        let rectangle =
            |south: f64, north: f64| [[-3.0, south], [5.0, south], [5.0, north], [-3.0, north]];
        Carriageway::of(&rectangle(-2.5, 9.5), rectangle(0.0, 7.0).to_vec())
    }

    #[test]
    fn kerbs_are_where_people_wait() {
        let road = road();
        assert_eq!(road.kerbs.len(), 2);
        assert!(road.contains([1.0, 3.0]) && !road.contains([9.0, 3.0]));
        assert!(road.is_between_kerbs([9.0, 3.0]));
        assert!(!road.is_between_kerbs([9.0, 8.0]) && !road.is_between_kerbs([1.0, -0.5]));
    }

    #[test]
    fn people_come_from_where_they_could_have_walked_from() {
        let was = |at: Metres| Person {
            at,
            is_on_road: true,
            lost_us: None,
            sighted_us: 0,
        };
        let before = [was([0.0, 0.0]), was([1.0, 0.0])];
        let places = [[0.9, 0.0], [5.0, 0.0]];
        assert_eq!(came_from(&places, &before, 200_000, 1.0), [Some(1), None]);
    }
}
