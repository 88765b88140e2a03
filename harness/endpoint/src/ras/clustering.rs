//! From the road users that a robot perceives to clusters that it can announce.
//!
//! The robot is the implicit head: nobody joins, everybody who is perceived belongs. Departures from the
//! clustering of TS 103 300-3 clause 5.4, and why:
//!
//! | ETSI | here |
//! |---|---|
//! | members join by a notification of 3 s | perception makes members; most of them have no radio |
//! | created from 3 to 5 road users on | from 1 on: one person without a radio is the case that matters |
//! | members within 3 to 5 m of the head (`maxClusterDistance`) | within the perception radius, with hysteresis at its edge, and within 3 m of each other; a robot with people around it has several clusters |
//! | members of the same velocity (5 %) | members of the same speed and direction within [`Settings`], wider than 5 %: a sensor errs, and people do not walk in step |
//! | cardinality counts the head | it does not: the head is no road user who needs to be seen |
//! | at most 20 members | the same; a larger group is split along its longer side |
//! | who is in two clusters chooses | who is in the zones of two robots is announced by the one of the lower station id: see [`Clustering::leave_to`] |
//! | a head that breaks its cluster up warns for 3 s (`timeClusterBreakupWarning`) | no warning, since people part without one: the cluster is over at once, and [`surroundings`](super::surroundings) says so in a RAM and in three cluster VAM |
//! | a head may change its cluster's id, with 3 s of notice | the id of a cluster stays |
//! | clusters of different kinds combine (`maxCombinedClusterDistance`) | a cluster has all kinds from the beginning, and says which |
//!
//! So everywhere in the shape of a cluster somebody who is perceived is near, and moves as the cluster is said
//! to: a person inside who moves so was perceived, or walks in step beside somebody who was.
//!
//! No identifier of a person leaves the robot: what tracks them is used here only, and a cluster's
//! random id is not used again for 30 s (`timeClusterUniquenessThreshold`) after the cluster is gone.

use std::collections::{BTreeMap, BTreeSet};

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};

use super::area::Area;
use super::motion::{MATCH, Point, distance_m};

mod grouping;
#[cfg(test)]
mod tests;

/// After how long without a message from its head a cluster is lost, in ms (`timeClusterContinuity`).
pub const CONTINUITY_MS: u64 = 2_000;
/// How long an id is not used again, in ms (`timeClusterUniquenessThreshold`).
pub const UNIQUENESS_MS: u64 = 30_000;
/// Clusters of other robots that are remembered.
const OTHERS_MAX: usize = 64;

/// Kind of a road user that sensors tell apart.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum VruClass {
    /// On foot.
    Pedestrian,
    /// On a bicycle or a light vehicle.
    Bicyclist,
    /// On a motorcycle.
    Motorcyclist,
    /// An animal.
    Animal,
    /// In a wheelchair. ETSI has it among the light vehicles, beside bicycles.
    WheelchairUser,
    /// A car, a bus, a tram: not vulnerable, so it is in no cluster.
    Vehicle,
}

impl VruClass {
    /// The bit of its profile in `VruClusterProfiles` (TS 102 894-2), bit 0 being the lowest one; 0 without a
    /// profile.
    #[must_use]
    pub const fn bit(self) -> u8 {
        match self {
            Self::Pedestrian => 1,
            Self::Bicyclist | Self::WheelchairUser => 1 << 1,
            Self::Motorcyclist => 1 << 2,
            Self::Animal => 1 << 3,
            Self::Vehicle => 0,
        }
    }

    /// Whether it is a vulnerable road user, which a cluster may count.
    #[must_use]
    pub const fn is_vulnerable(self) -> bool {
        self.bit() != 0
    }
}

/// A road user as a sensor tells of it, of whatever kind the sensor is.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct PerceivedVru {
    /// Number by which the sensor tracks it. It never leaves the robot.
    pub id: u32,
    /// Where it is, on the robot's plane.
    pub position_m: Point,
    /// Its velocity in m/s, to the east and to the north.
    pub velocity_mps: [f64; 2],
    /// Its class.
    pub class: VruClass,
    /// How sure the sensor is that it exists, 0..1.
    pub confidence: f64,
}

impl PerceivedVru {
    /// A pedestrian who stands there. The sensor reports full confidence.
    #[must_use]
    pub const fn pedestrian(id: u32, position_m: Point) -> Self {
        Self {
            id,
            position_m,
            velocity_mps: [0.0; 2],
            class: VruClass::Pedestrian,
            confidence: 1.0,
        }
    }
}

/// How clusters are made.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Settings {
    /// A road user nearer to the robot than this becomes a member, in metres; at most 100.
    pub radius_m: f64,
    /// A member stays one until it is this much further away, from the robot or from another member of its
    /// cluster, in metres.
    pub hysteresis_m: f64,
    /// Members of a cluster are at most this far from each other when they come together, in metres
    /// (`maxClusterDistance`, 3..5); at most 200.
    pub spread_m: f64,
    /// The speeds of two members of a cluster differ by no more than this, in m/s; when they come together,
    /// by half of it. At most 50.
    pub speed_difference_mps: f64,
    /// The directions of two members of a cluster differ by no more than this, in degrees; when they come
    /// together, by half of it. At most 360.
    pub heading_difference_deg: f64,
    /// A road user with less confidence, from 0 to 1, does not become a member; a member stays one down to half of it.
    pub confidence_min: f64,
    /// A member that is no longer perceived is forgotten after so long, in ms. The default is half of
    /// `timeClusterContinuity`.
    pub forget_ms: u64,
    /// A group of more members is split (`maxClusterSize`).
    pub size_max: usize,
    /// Distance between the outermost members and the edge, in metres: what a pedestrian walks and a
    /// sensor errs until the next announcement.
    pub margin_m: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            radius_m: 15.0,
            hysteresis_m: 1.0,
            spread_m: 3.0,
            speed_difference_mps: MATCH.speed_mps,
            heading_difference_deg: MATCH.heading_deg,
            confidence_min: 0.5,
            forget_ms: 1_000,
            size_max: 20,
            margin_m: 1.0,
        }
    }
}

impl Settings {
    /// Checks that they are possible.
    ///
    /// # Errors
    /// The first setting that is out of range, with its range.
    pub fn check(&self) -> Result<(), &'static str> {
        let within = |value: f64, most: f64| (0.0..=most).contains(&value);
        if !within(self.radius_m, 100.0) {
            Err("radius_m is 0 to 100 m")
        } else if !within(self.hysteresis_m, 20.0) || !within(self.margin_m, 20.0) {
            Err("hysteresis_m and margin_m are 0 to 20 m")
        } else if !within(self.spread_m, 200.0) {
            Err("spread_m is 0 to 200 m")
        } else if !within(self.speed_difference_mps, 50.0) {
            Err("speed_difference_mps is 0 to 50 m/s")
        } else if !within(self.heading_difference_deg, 360.0) {
            Err("heading_difference_deg is 0 to 360 degrees")
        } else if !within(self.confidence_min, 1.0) {
            Err("confidence_min is 0 to 1")
        } else if !(100..=CONTINUITY_MS).contains(&self.forget_ms) {
            Err("forget_ms is 100 to 2000 ms")
        } else if !(1..=255).contains(&self.size_max) {
            Err("size_max is 1 to 255")
        } else {
            Ok(())
        }
    }
}

/// A group of road users, as it is announced.
#[derive(Clone, PartialEq, Debug)]
pub struct Cluster {
    /// Random id.
    pub id: u8,
    /// Area around the members.
    pub area: Area,
    /// How many they are.
    pub cardinality: u8,
    /// Which classes are among them: see [`VruClass::bit`].
    pub profiles: u8,
    /// Where they are on average.
    pub center: Point,
    /// Their mean velocity in m/s, to the east and to the north.
    pub velocity_mps: [f64; 2],
}

/// Why a cluster is over (TS 102 894-2 `ClusterBreakupReason`).
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum BreakupReason {
    /// Its members went apart, or moved no longer alike. ETSI has no reason for that.
    NotProvided = 0,
    /// None of its members is around any more.
    ClusteringPurposeCompleted = 1,
}

/// A cluster that is over.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Ended {
    /// The id that it had.
    pub id: u8,
    /// Why.
    pub reason: BreakupReason,
}

/// The members of a robot's clusters.
#[derive(Clone, Debug)]
pub struct Clustering {
    settings: Settings,
    members: BTreeMap<u32, Member>,
    groups: Vec<(u8, BTreeSet<u32>)>,
    retired: BTreeMap<u8, u64>,
    /// Clusters that are over, until they are asked for; by id, so at most 256.
    ended: BTreeMap<u8, BreakupReason>,
    /// Clusters of robots that precede this one, by head and id.
    others: BTreeMap<(u32, Option<u8>), Other>,
    random: ChaCha8Rng,
}

#[derive(Clone, Copy, Debug)]
struct Member {
    vru: PerceivedVru,
    seen_ms: u64,
}

#[derive(Clone, Debug)]
struct Other {
    area: Area,
    heard_ms: u64,
}

impl Clustering {
    /// A clustering without members. The ids of clusters follow from `seed`.
    #[must_use]
    pub fn new(settings: Settings, seed: u64) -> Self {
        Self {
            settings,
            members: BTreeMap::new(),
            groups: Vec::new(),
            retired: BTreeMap::new(),
            ended: BTreeMap::new(),
            others: BTreeMap::new(),
            random: ChaCha8Rng::seed_from_u64(seed),
        }
    }

    /// How clusters are made.
    #[must_use]
    pub const fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Takes in what the robot at `robot_m` perceives at `now_ms`: all road users that its sensors
    /// have now, near and far.
    pub fn perceive(&mut self, now_ms: u64, robot_m: Point, perceived: &[PerceivedVru]) {
        let settings = &self.settings;
        for vru in perceived {
            let distance_m = distance_m(robot_m, vru.position_m);
            let (radius_m, confidence) = match self.members.get(&vru.id) {
                Some(_) => (
                    settings.radius_m + settings.hysteresis_m,
                    settings.confidence_min / 2.0,
                ),
                None => (settings.radius_m, settings.confidence_min),
            };
            let is_near = distance_m <= radius_m;
            if is_near && vru.confidence >= confidence && vru.class.is_vulnerable() {
                let member = Member {
                    vru: *vru,
                    seen_ms: now_ms,
                };
                self.members.insert(vru.id, member);
            } else {
                self.members.remove(&vru.id);
            }
        }
        self.expire(now_ms);
        self.regroup(now_ms);
    }

    /// Forgets who was not perceived for too long, also when the sensors say nothing any more.
    pub fn elapse(&mut self, now_ms: u64) {
        if self.expire(now_ms) {
            self.regroup(now_ms);
        }
    }

    /// Whether anybody was forgotten.
    fn expire(&mut self, now_ms: u64) -> bool {
        let known = self.members.len() + self.others.len();
        let is_within = |since_ms, limit_ms| now_ms.saturating_sub(since_ms) < limit_ms;
        let forget_ms = self.settings.forget_ms;
        self.members
            .retain(|_, member| is_within(member.seen_ms, forget_ms));
        self.others
            .retain(|_, other| is_within(other.heard_ms, CONTINUITY_MS));
        self.members.len() + self.others.len() < known
    }

    /// Forgets everybody, as when places mean something else from now on.
    pub fn forget_everybody(&mut self, now_ms: u64) {
        self.members.clear();
        self.others.clear();
        self.regroup(now_ms);
    }

    /// Gives all clusters new ids, which follow from `seed`: those before belong to another station, so to speak, and
    /// nothing is said of them any more.
    pub fn renew_ids(&mut self, now_ms: u64, seed: u64) {
        self.random = ChaCha8Rng::seed_from_u64(seed);
        self.retired.clear();
        self.ended.clear();
        for (_, members) in std::mem::take(&mut self.groups) {
            let id = self.new_id(now_ms, &[]);
            self.groups.push((id, members));
        }
    }

    /// Leaves those within a cluster of a robot that precedes this one to that robot, so that nobody is
    /// announced twice, for 2 s (`timeClusterContinuity`). Which robot precedes has to be an order, as
    /// that of station ids is: then at least one of the robots that see somebody announces them.
    pub fn leave_to(&mut self, now_ms: u64, id: (u32, Option<u8>), area: Area) {
        if self.others.len() >= OTHERS_MAX && !self.others.contains_key(&id) {
            let oldest = self.others.iter().min_by_key(|(_, other)| other.heard_ms);
            if let Some(oldest) = oldest.map(|(id, _)| *id) {
                self.others.remove(&oldest);
            }
        }
        let heard_ms = now_ms;
        self.others.insert(id, Other { area, heard_ms });
        self.regroup(now_ms);
    }

    /// Takes back the people who were left to a robot that has no cluster any more.
    pub fn take_back(&mut self, now_ms: u64, head: u32) {
        self.others.retain(|(other, _), _| *other != head);
        self.regroup(now_ms);
    }

    /// The clusters that are over since this was asked the last time.
    pub fn take_ended(&mut self) -> Vec<Ended> {
        let ended = std::mem::take(&mut self.ended).into_iter();
        ended.map(|(id, reason)| Ended { id, reason }).collect()
    }

    /// Whether the robot perceives this road user in its zone.
    #[must_use]
    pub fn is_member(&self, id: u32) -> bool {
        self.members.contains_key(&id)
    }

    /// Takes back the people of another head's cluster, given by head and id, once that cluster is over.
    pub fn take_back_one(&mut self, now_ms: u64, id: (u32, Option<u8>)) {
        if self.others.remove(&id).is_some() {
            self.regroup(now_ms);
        }
    }

    /// How many road users the robot perceives in its zone, also the ones that it leaves to another robot.
    #[must_use]
    pub fn members(&self) -> usize {
        self.members.len()
    }

    /// How many clusters there are.
    #[must_use]
    pub fn count(&self) -> usize {
        self.groups.len()
    }

    /// The clusters now.
    #[must_use]
    pub fn clusters(&self) -> Vec<Cluster> {
        let groups = self.groups.iter();
        groups
            .filter_map(|(id, members)| self.cluster(*id, members))
            .collect()
    }

    fn cluster(&self, id: u8, members: &BTreeSet<u32>) -> Option<Cluster> {
        let vrus: Vec<&PerceivedVru> = members
            .iter()
            .filter_map(|member| Some(&self.members.get(member)?.vru))
            .collect();
        let places: Vec<Point> = vrus.iter().map(|vru| vru.position_m).collect();
        let area = Area::around(&places, self.settings.margin_m)?;
        Some(Cluster {
            id,
            area,
            cardinality: u8::try_from(vrus.len()).unwrap_or(u8::MAX),
            profiles: vrus.iter().fold(0, |bits, vru| bits | vru.class.bit()),
            center: grouping::mean(&vrus, |vru| vru.position_m),
            velocity_mps: grouping::mean(&vrus, |vru| vru.velocity_mps),
        })
    }

    /// Divides the members into groups of which each is close and of one motion, with the id of the group
    /// before that most of it comes from.
    fn regroup(&mut self, now_ms: u64) {
        let is_left = |place| self.others.values().any(|it| it.area.contains(place));
        let vrus = self.members.values().map(|member| &member.vru);
        let people: Vec<&PerceivedVru> = vrus.filter(|it| !is_left(it.position_m)).collect();
        let parts = grouping::groups(&people, &self.groups, &self.settings);
        let mut before = std::mem::take(&mut self.groups);
        for part in parts {
            let kept = (0..before.len())
                .filter(|&index| !before[index].1.is_disjoint(&part))
                .max_by_key(|&index| before[index].1.intersection(&part).count());
            let id = match kept {
                Some(index) => before.swap_remove(index).0,
                None => self.new_id(now_ms, &before),
            };
            self.groups.push((id, part));
        }
        for (id, members) in before {
            let is_around = members.iter().any(|it| self.members.contains_key(it));
            let reason = if is_around {
                BreakupReason::NotProvided
            } else {
                BreakupReason::ClusteringPurposeCompleted
            };
            self.retired.insert(id, now_ms);
            self.ended.insert(id, reason);
        }
    }

    /// A random id that is neither in use nor was within the last 30 s.
    fn new_id(&mut self, now_ms: u64, before: &[(u8, BTreeSet<u32>)]) -> u8 {
        self.retired
            .retain(|_, since_ms| now_ms.saturating_sub(*since_ms) < UNIQUENESS_MS);
        let in_use = |id| self.groups.iter().chain(before).any(|group| group.0 == id);
        let is_free = |id: &u8| !in_use(*id) && !self.retired.contains_key(id);
        let free: Vec<u8> = (0..=u8::MAX).filter(is_free).collect();
        match free.len() {
            // More than 256 clusters within half a minute: the one that is gone the longest.
            0 => self
                .retired
                .iter()
                .filter(|(id, _)| !in_use(**id))
                .min_by_key(|(_, since_ms)| **since_ms)
                .map_or(0, |(&id, _)| id),
            count => free[self.random.random_range(0..count)],
        }
    }
}
