//! From the road users that a robot perceives to clusters that it can announce.
//!
//! The robot is the implicit head: nobody joins, everybody who is perceived belongs. Departures from the
//! clustering of TS 103 300-3 clause 5.4, and why:
//!
//! | ETSI | here |
//! |---|---|
//! | members join by a notification of 3 s | perception makes members; most of them have no radio |
//! | created from 3 to 5 road users on | from 1 on: one person without a radio is the case that matters |
//! | members within 3 to 5 m of the head | within the perception radius, with hysteresis at its edge |
//! | members of the same velocity (5 %) | any velocity: the robot sees them all the time. A device that joins by ETSI's rules checks its own velocity, see [`vru`](super::vru) |
//! | cardinality counts the head | it does not: the head is no road user who needs to be seen |
//! | at most 20 members | the same; a larger group is split along its longer side |
//! | who is in two clusters chooses | who is in the zones of two robots is announced by the one of the lower station id: see [`Clustering::leave_to`] |
//! | a head that ends its cluster warns for 3 s (`timeClusterBreakupWarning`) | no warning; devices of a cluster that is no longer announced resume by themselves, see [`vru`](super::vru) |
//! | a head may change its cluster's id, with 3 s of notice | the id of a cluster stays |
//! | clusters of different kinds combine (`maxCombinedClusterDistance`) | a cluster has all kinds from the beginning, and says which |
//!
//! No identifier of a person leaves the robot: what tracks them is used here only, and a cluster's
//! random id is not used again for 30 s (`timeClusterUniquenessThreshold`) after the cluster is gone.

use std::collections::{BTreeMap, BTreeSet};

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};

use super::area::Area;
use super::motion::{Point, distance_m};
use super::vru::CONTINUITY_MS;

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
    /// What the sensor tracks it by. It never leaves the robot.
    pub id: u32,
    /// Where it is, on the robot's plane.
    pub position_m: Point,
    /// Its velocity in m/s, to the east and to the north.
    pub velocity_mps: [f64; 2],
    /// What it is.
    pub class: VruClass,
    /// How sure the sensor is that it exists, 0..1.
    pub confidence: f64,
}

/// How clusters are made.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Settings {
    /// Who is nearer to the robot than this becomes a member, in metres; at most 100.
    pub radius_m: f64,
    /// A member stays one until it is this much further away, in metres.
    pub hysteresis_m: f64,
    /// Who is less certain, from 0 to 1, does not become a member; a member stays one down to half of it.
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
    /// What is wrong.
    pub fn check(&self) -> Result<(), &'static str> {
        let within = |value: f64, most: f64| (0.0..=most).contains(&value);
        if !within(self.radius_m, 100.0) {
            Err("radius_m is 0 to 100 m")
        } else if !within(self.hysteresis_m, 20.0) || !within(self.margin_m, 20.0) {
            Err("hysteresis_m and margin_m are 0 to 20 m")
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
    /// What bounds the members.
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

/// The members of a robot's clusters.
#[derive(Clone, Debug)]
pub struct Clustering {
    settings: Settings,
    members: BTreeMap<u32, Member>,
    groups: Vec<(u8, BTreeSet<u32>)>,
    retired: BTreeMap<u8, u64>,
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
    /// Nobody is a member yet. The ids of clusters follow from `seed`.
    #[must_use]
    pub fn new(settings: Settings, seed: u64) -> Self {
        Self {
            settings,
            members: BTreeMap::new(),
            groups: Vec::new(),
            retired: BTreeMap::new(),
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

    /// Leaves those within a cluster of a robot that precedes this one to that robot, so that nobody is
    /// announced twice, for 2 s (`timeClusterContinuity`). Which robot precedes has to be an order, as
    /// that of station ids is: then at least one of those who see somebody announces them.
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

    /// Takes back those who were left to a robot that has no cluster any more.
    pub fn take_back(&mut self, now_ms: u64, head: u32) {
        self.others.retain(|(other, _), _| *other != head);
        self.regroup(now_ms);
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
        let mean = |of: fn(&PerceivedVru) -> [f64; 2]| {
            let sum = vrus.iter().fold([0.0, 0.0], |sum, vru| {
                let [x, y] = of(vru);
                [sum[0] + x, sum[1] + y]
            });
            #[expect(clippy::cast_precision_loss, reason = "a few dozen")]
            sum.map(|it| it / vrus.len() as f64)
        };
        Some(Cluster {
            id,
            area,
            cardinality: u8::try_from(vrus.len()).unwrap_or(u8::MAX),
            profiles: vrus.iter().fold(0, |bits, vru| bits | vru.class.bit()),
            center: mean(|vru| vru.position_m),
            velocity_mps: mean(|vru| vru.velocity_mps),
        })
    }

    /// Divides the members into groups that are small enough, each with the id of the group before
    /// that most of it comes from.
    fn regroup(&mut self, now_ms: u64) {
        let size_max = self.settings.size_max.clamp(1, usize::from(u8::MAX));
        let mut parts = Vec::new();
        let places = self.members.iter();
        let places = places.map(|(&id, member)| (id, member.vru.position_m));
        let is_left = |place| self.others.values().any(|it| it.area.contains(place));
        let all: Vec<(u32, Point)> = places.filter(|(_, place)| !is_left(*place)).collect();
        split(all, size_max, &mut parts);
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
        self.retired
            .extend(before.into_iter().map(|(id, _)| (id, now_ms)));
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

/// Splits along the longer side, in halves of equal size, until every part is small enough.
fn split(mut members: Vec<(u32, Point)>, size_max: usize, parts: &mut Vec<BTreeSet<u32>>) {
    // Halving needs as many rounds as the number has bits, so this is no deep recursion.
    if members.len() > size_max {
        let extent = |axis: usize| {
            let of = |(_, place): &(u32, Point)| place[axis];
            let most = members.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
            let least = members.iter().map(of).fold(f64::INFINITY, f64::min);
            most - least
        };
        let axis = usize::from(extent(1) > extent(0));
        members.sort_by(|a, b| a.1[axis].total_cmp(&b.1[axis]));
        let rest = members.split_off(members.len() / 2);
        split(members, size_max, parts);
        split(rest, size_max, parts);
    } else if !members.is_empty() {
        parts.push(members.into_iter().map(|(id, _)| id).collect());
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn pedestrian(id: u32, east_m: f64, north_m: f64) -> PerceivedVru {
        PerceivedVru {
            id,
            position_m: [east_m, north_m],
            velocity_mps: [1.0, 0.0],
            class: VruClass::Pedestrian,
            confidence: 0.9,
        }
    }

    fn perceiving(perceived: &[PerceivedVru]) -> Clustering {
        let mut clustering = Clustering::new(Settings::default(), 1);
        clustering.perceive(0, [0.0, 0.0], perceived);
        clustering
    }

    #[test]
    fn one_person_is_a_cluster() {
        let clusters = perceiving(&[pedestrian(7, 3.0, 4.0)]).clusters();
        assert_eq!(clusters.len(), 1);
        assert_eq!(
            (clusters[0].cardinality, clusters[0].profiles),
            (1, VruClass::Pedestrian.bit())
        );
        assert!(distance_m(clusters[0].velocity_mps, [1.0, 0.0]) < 1e-9);
    }

    #[test]
    fn a_vehicle_is_in_no_cluster_and_a_wheelchair_user_has_the_profile_that_etsi_gives() {
        let of = |class, east_m| PerceivedVru {
            class,
            ..pedestrian(7, east_m, 4.0)
        };
        assert!(
            perceiving(&[of(VruClass::Vehicle, 3.0)])
                .clusters()
                .is_empty()
        );
        let clusters = perceiving(&[of(VruClass::WheelchairUser, 3.0)]).clusters();
        assert_eq!(clusters[0].profiles, VruClass::Bicyclist.bit());
    }

    #[test]
    fn the_edge_has_hysteresis_in_distance_and_confidence() {
        let mut clustering = perceiving(&[pedestrian(1, 15.5, 0.0)]);
        assert_eq!(clustering.members(), 0);
        for (now_ms, east_m, members) in [
            (100, 14.9, 1),
            (200, 15.9, 1),
            (300, 16.1, 0),
            (400, 15.9, 0),
        ] {
            clustering.perceive(now_ms, [0.0, 0.0], &[pedestrian(1, east_m, 0.0)]);
            assert_eq!(clustering.members(), members, "{east_m} m");
        }
        let mut unsure = pedestrian(2, 5.0, 0.0);
        for (now_ms, confidence, members) in
            [(500, 0.4, 0), (600, 0.6, 1), (700, 0.3, 1), (800, 0.2, 0)]
        {
            unsure.confidence = confidence;
            clustering.perceive(now_ms, [0.0, 0.0], &[unsure]);
            assert_eq!(clustering.members(), members, "{confidence}");
        }
    }

    #[test]
    fn who_is_hidden_for_a_moment_is_remembered() {
        let mut clustering = perceiving(&[pedestrian(1, 5.0, 0.0)]);
        clustering.perceive(999, [0.0, 0.0], &[]);
        assert_eq!(clustering.members(), 1);
        clustering.perceive(1_000, [0.0, 0.0], &[]);
        assert!(clustering.clusters().is_empty());
    }

    #[test]
    fn an_id_stays_while_its_cluster_does_and_is_not_used_again_soon() {
        let mut clustering = perceiving(&[pedestrian(1, 5.0, 0.0)]);
        let id = clustering.clusters()[0].id;
        clustering.perceive(
            100,
            [0.0, 0.0],
            &[pedestrian(1, 6.0, 0.0), pedestrian(2, 2.0, 0.0)],
        );
        assert_eq!(clustering.clusters()[0].id, id);
        for round in 0..100 {
            let now_ms = 2_000 + round * 100;
            clustering.perceive(
                now_ms,
                [0.0, 0.0],
                &[pedestrian(1, 20.0, 0.0), pedestrian(2, 20.0, 0.0)],
            );
            clustering.perceive(now_ms + 50, [0.0, 0.0], &[pedestrian(3, 1.0, 0.0)]);
            assert_ne!(clustering.clusters()[0].id, id);
            clustering.perceive(now_ms + 60, [0.0, 0.0], &[pedestrian(3, 20.0, 0.0)]);
        }
    }

    #[test]
    fn who_is_in_the_zones_of_two_robots_is_announced_by_one() {
        let mut clustering = perceiving(&[pedestrian(1, 3.0, 0.0), pedestrian(2, -9.0, 0.0)]);
        let announced = |clustering: &Clustering| -> u32 {
            let clusters = clustering.clusters();
            clusters.iter().map(|it| u32::from(it.cardinality)).sum()
        };
        assert_eq!(announced(&clustering), 2);
        let area = Area::around(&[[3.0, 0.0]], 1.0).unwrap();
        clustering.leave_to(0, (4, Some(9)), area);
        assert_eq!((announced(&clustering), clustering.members()), (1, 2));
        clustering.take_back(100, 5);
        assert_eq!(announced(&clustering), 1);
        clustering.take_back(100, 4);
        assert_eq!(announced(&clustering), 2);
    }

    #[test]
    fn people_are_taken_back_from_a_silent_robot_and_forgotten_without_a_sensor() {
        let mut clustering = perceiving(&[]);
        let area = Area::around(&[[3.0, 0.0]], 1.0).unwrap();
        clustering.leave_to(0, (4, None), area);
        clustering.perceive(1_500, [0.0, 0.0], &[pedestrian(1, 3.0, 0.0)]);
        assert_eq!(clustering.count(), 0);
        clustering.elapse(1_999);
        assert_eq!(clustering.count(), 0);
        clustering.elapse(2_000);
        assert_eq!(clustering.count(), 1);
        clustering.elapse(2_500);
        assert_eq!((clustering.count(), clustering.members()), (0, 0));
    }

    proptest! {
        /// Every member is in one cluster's area, no cluster is larger than allowed, and together they
        /// count everybody once.
        #[test]
        fn clusters_divide_the_members(
            places in proptest::collection::vec((-20.0..20.0_f64, -20.0..20.0_f64), 0..90)
        ) {
            let perceived: Vec<PerceivedVru> = (0..).zip(&places)
                .map(|(id, &(x, y))| pedestrian(id, x, y)).collect();
            let clustering = perceiving(&perceived);
            let clusters = clustering.clusters();
            let near: Vec<_> = perceived.iter().filter(|vru| distance_m([0.0, 0.0], vru.position_m) <= 15.0).collect();
            let counted: usize = clusters.iter().map(|it| usize::from(it.cardinality)).sum();
            prop_assert_eq!(counted, near.len());
            prop_assert!(clusters.iter().all(|it| (1..=20).contains(&it.cardinality)));
            for vru in near {
                prop_assert!(clusters.iter().any(|it| it.area.contains(vru.position_m)));
            }
            let ids: BTreeSet<u8> = clusters.iter().map(|it| it.id).collect();
            prop_assert_eq!(ids.len(), clusters.len());
        }

        /// What a person is tracked by has no influence on what is announced.
        #[test]
        fn nothing_persistent_gets_out(
            places in proptest::collection::vec((-12.0..12.0_f64, -9.0..9.0_f64), 1..50), offset in 1_u32..1_000_000
        ) {
            let announced = |offset: u32| {
                let perceived: Vec<PerceivedVru> = (offset..).zip(&places)
                    .map(|(id, &(x, y))| pedestrian(id, x, y)).collect();
                perceiving(&perceived).clusters()
            };
            prop_assert_eq!(announced(0), announced(offset));
        }
    }
}
