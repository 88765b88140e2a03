//! Record of a place with streams of people and vehicles, and its measures: waiting, delay and conflicts.

use std::collections::{BTreeMap, BTreeSet};

use crossguard_model_check::node::Protocol;
use crossguard_robot::site::Place;
use serde::Serialize;

use super::swarm::Swarm;
use super::world::{Finding, run_flow};
use crate::seconds;

/// Where people cross, in metres to the east, and how far from there.
pub(super) const CROSSING_EAST: f64 = 1.0;
pub(super) const WITHIN_M: f64 = 1.5;
/// The width of the road, and the middle of each lane to the north of its edge: to the east, and to the west.
pub(super) const ROAD_M: f64 = 7.0;
pub(super) const LANES: [f64; 2] = [1.75, 5.25];
/// The length of a vehicle.
pub(super) const CAR_M: f64 = 4.5;
/// A person is in the way of a vehicle within so far from the middle of its lane: half of 1.8 m and half of a person.
const SWEPT_M: f64 = 1.15;
/// The half depth of a person along the road.
const BODY_M: f64 = 0.25;

/// A conflict is nearer than this, in seconds: of time to collision (Hydén 1987) as of post-encroachment time.
pub const CONFLICT_S: f64 = 1.5;

/// How far a place is beyond the middle of the crossing, in the direction of travel.
pub(super) fn along_m(comes_back: bool, east: f64) -> f64 {
    let along = east - CROSSING_EAST;
    if comes_back { -along } else { along }
}

/// How somebody's wait ended.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum End {
    AtSign,
    ByGap,
    GaveUp,
}

/// A person on foot.
#[derive(Clone, Debug, Default)]
pub(super) struct PersonLog {
    pub(super) since_us: u64,
    ended: Option<(u64, End)>,
    /// From the kerb on.
    pub(super) way: Vec<(u64, Place)>,
    /// For how long no guard of their session was in place while they were on the road.
    pub(super) alone_us: u64,
}

impl PersonLog {
    pub(super) const fn end(&mut self, at_us: u64, how: End) {
        self.ended = Some((at_us, how));
    }

    /// From when to when they are in the way of vehicles in a lane.
    fn in_lane(&self, lane: usize) -> Option<[f64; 2]> {
        let [(from_us, from), (to_us, to), ..] = self.way[..] else {
            return None;
        };
        let at = |north: f64| {
            let share = (north - from.north) / (to.north - from.north);
            seconds(from_us) + share * (seconds(to_us) - seconds(from_us))
        };
        let (a, b) = (at(LANES[lane] - SWEPT_M), at(LANES[lane] + SWEPT_M));
        Some([a.min(b), a.max(b)])
    }
}

/// Where a vehicle was near the crossing.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    pub(super) at_us: u64,
    pub(super) front_m: f64,
    pub(super) speed_mps: f64,
    pub(super) comes_back: bool,
}

/// Record of a run.
#[derive(Clone, Debug, Default)]
pub(super) struct PlaceLog {
    pub(super) people: Vec<PersonLog>,
    pub(super) delays_s: Vec<Option<f64>>,
    pub(super) tracks: Vec<Vec<Sample>>,
    /// Vehicles that drove into robots.
    robots_hit: BTreeSet<(usize, usize)>,
    /// How many packets robots sent, by their octets.
    pub(super) packets: BTreeMap<usize, u64>,
    pub(super) cams: u64,
    /// VAM that were sent, and that were not because a robot tells of people.
    pub(super) vams: [u64; 2],
}

impl PlaceLog {
    pub(super) fn meets_robots(
        &mut self,
        car: usize,
        at: Place,
        front_m: f64,
        speed_mps: f64,
        robots: &[Place],
    ) {
        for (number, robot) in robots.iter().enumerate() {
            let robot_m = along_m(at.north > ROAD_M / 2.0, robot.east);
            let is_within = robot_m < front_m && robot_m > front_m - CAR_M;
            if is_within && speed_mps > 0.5 && (robot.north - at.north).abs() < SWEPT_M {
                self.robots_hit.insert((car, number));
            }
        }
    }
}

/// The measures of a run.
#[derive(Clone, PartialEq, Debug, Default, Serialize)]
pub struct Measured {
    /// How long each person was at the kerb until they set out or gave up, in seconds.
    pub waited_s: Vec<f64>,
    /// How much longer each vehicle took than by itself on a free road, in seconds.
    pub delays_s: Vec<f64>,
    /// How many people came.
    pub people: usize,
    /// How many of them crossed at a sign.
    pub at_sign: usize,
    /// How many crossed by themselves, by a gap.
    pub by_gap: usize,
    /// How many gave up. The others were there when the run ended.
    pub gave_up: usize,
    /// Pairs of a person on the road and a vehicle whose time to collision fell below [`CONFLICT_S`].
    pub ttc: usize,
    /// Pairs in which the vehicle came less than that after the person had left its way.
    pub pet: usize,
    /// The shortest time to collision of each such pair, in seconds.
    pub shortest_s: Vec<f64>,
    /// People hit.
    pub hit: usize,
    /// People hit who had stepped on the road at a sign.
    pub hit_at_sign: usize,
    /// Vehicles that drove into robots.
    pub robots_hit: usize,
    /// People who stepped on the road at a sign and had no guard in place for more than half a second.
    pub left_alone: usize,
    /// How long the run was, in seconds.
    pub seconds: f64,
    /// Packets of robots, by their octets.
    #[serde(skip)]
    pub packets: BTreeMap<usize, u64>,
    /// CAM of vehicles.
    pub cams: u64,
    /// VAM of phones.
    pub vams: u64,
    /// VAM that were not sent because a robot tells of people.
    pub silent_vams: u64,
    /// The property that the robots broke, if they broke one. The run ended there.
    pub finding: Option<Finding>,
}

impl Measured {
    /// Runs a swarm with demand.
    #[must_use]
    pub fn of(swarm: &Swarm) -> Self {
        let (outcome, log) = run_flow(swarm, &Protocol);
        let mut measured = Self {
            delays_s: log.delays_s.iter().copied().flatten().collect(),
            people: log.people.len(),
            robots_hit: log.robots_hit.len(),
            #[expect(clippy::cast_precision_loss, reason = "runs take minutes")]
            seconds: outcome.virtual_ms as f64 / 1e3,
            packets: log.packets,
            cams: log.cams,
            vams: log.vams[0],
            silent_vams: log.vams[1],
            finding: outcome.finding,
            ..Self::default()
        };
        for person in &log.people {
            measured.add(person, &log.tracks);
        }
        measured
    }

    fn add(&mut self, person: &PersonLog, tracks: &[Vec<Sample>]) {
        let Some((at_us, how)) = person.ended else {
            return;
        };
        self.waited_s
            .push(seconds(at_us) - seconds(person.since_us));
        match how {
            End::AtSign => self.at_sign += 1,
            End::ByGap => self.by_gap += 1,
            End::GaveUp => self.gave_up += 1,
        }
        self.left_alone += usize::from(how == End::AtSign && person.alone_us > 500_000);
        let meetings = tracks.iter().filter_map(|track| Meeting::of(person, track));
        for Meeting { ttc_s, pet_s } in meetings {
            let is_hit = pet_s <= 0.0;
            self.hit += usize::from(is_hit);
            self.hit_at_sign += usize::from(is_hit && how == End::AtSign);
            self.pet += usize::from(pet_s < CONFLICT_S);
            if ttc_s < CONFLICT_S {
                self.ttc += 1;
                self.shortest_s.push(ttc_s);
            }
        }
    }
}

/// How near a person and a vehicle came to each other.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Meeting {
    /// The shortest time to collision, by constant speeds; infinite without a collision course.
    ttc_s: f64,
    /// From when the person has left the vehicle's way until it is there; 0 for a collision, infinite where the vehicle was
    /// first.
    pet_s: f64,
}

impl Meeting {
    fn of(person: &PersonLog, track: &[Sample]) -> Option<Self> {
        let first = track.first()?;
        let [enters_s, leaves_s] = person.in_lane(usize::from(first.comes_back))?;
        let on_road_s = seconds(person.way[0].0);
        let at_m = along_m(first.comes_back, person.way[0].1.east);
        let [front_at, rear_at] = [at_m - BODY_M, at_m + BODY_M + CAR_M];
        let reaches_s = reaches(track, front_at);
        let passed_s = reaches(track, rear_at);
        let pet_s = match (reaches_s, passed_s) {
            (Some(reaches_s), _) if reaches_s > leaves_s => reaches_s - leaves_s,
            (_, Some(passed_s)) if passed_s < enters_s => f64::INFINITY,
            (Some(_), _) => 0.0,
            (None, _) => f64::INFINITY,
        };
        let mut ttc_s = if pet_s <= 0.0 { 0.0 } else { f64::INFINITY };
        for it in track {
            let now_s = seconds(it.at_us);
            if now_s < on_road_s || now_s > leaves_s || it.front_m > rear_at || it.speed_mps < 0.5 {
                continue;
            }
            let comes_s = ((front_at - it.front_m) / it.speed_mps).max(0.0);
            let goes_s = (rear_at - it.front_m) / it.speed_mps;
            let (enters_s, leaves_s) = ((enters_s - now_s).max(0.0), leaves_s - now_s);
            if comes_s < leaves_s && enters_s < goes_s {
                ttc_s = ttc_s.min(comes_s.max(enters_s));
            }
        }
        Some(Self { ttc_s, pet_s })
    }
}

/// When the front of a vehicle is there.
fn reaches(track: &[Sample], at_m: f64) -> Option<f64> {
    let steps = track.windows(2);
    let mut steps = steps.filter(|step| step[0].front_m < at_m && step[1].front_m >= at_m);
    let step = steps.next()?;
    let share = (at_m - step[0].front_m) / (step[1].front_m - step[0].front_m);
    let (from_s, to_s) = (seconds(step[0].at_us), seconds(step[1].at_us));
    Some(from_s + share * (to_s - from_s))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A person who walks north at 1 m/s from the kerb at 10 s, and a vehicle to the east that passes the crossing then at 10 m/s.
    fn meeting(passes_s: f64) -> Meeting {
        let way = [(10_000_000, 0.0), (17_000_000, 7.0)];
        let way = way.map(|(at_us, north)| (at_us, Place::new(1.0, north)));
        let person = PersonLog {
            way: way.to_vec(),
            ..PersonLog::default()
        };
        let track: Vec<_> = (0..400)
            .map(|tick| Sample {
                at_us: tick * 100_000,
                front_m: (seconds(tick * 100_000) - passes_s) * 10.0,
                speed_mps: 10.0,
                comes_back: false,
            })
            .filter(|it| it.front_m.abs() < 60.0)
            .collect();
        Meeting::of(&person, &track).unwrap()
    }

    #[test]
    fn conflicts_are_those_of_a_person_and_a_vehicle_by_hand() {
        // In the way of the near lane from 10.6 to 12.9 s; the front bumper is 0.25 m before the person 0.025 s earlier.
        let hit = meeting(12.0);
        assert_eq!(
            hit,
            Meeting {
                ttc_s: 0.0,
                pet_s: 0.0
            }
        );
        let after = meeting(13.4);
        assert!((after.pet_s - 0.475).abs() < 1e-6, "{after:?}");
        // No collision course: the person leaves before it comes.
        assert!(after.ttc_s.is_infinite());
        let long_after = meeting(15.0);
        assert!((long_after.pet_s - 2.075).abs() < 1e-6);
        let before = meeting(9.0);
        assert!(before.pet_s.is_infinite() && before.ttc_s.is_infinite());
    }
}
