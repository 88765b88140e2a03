//! People that a robot perceives around it, and their announcement: one cluster in every
//! RAM, in turn, and a cluster VAM for each where devices do not understand RAM. A cluster that is over goes
//! first: the next RAM is due at once and says so, and three cluster VAM break it up.
//!
//! ```text
//!  sensor ──► perceive ─┐
//!                       ├─► clusters ──► next ──► RAM
//!  other robots' RAM ───┘           └──► due_cluster_vams
//!             (hear)
//! ```
//!
//! Places are kept on a plane that stays where it is while the robot moves, so that people do not move
//! with it. Without input and output; the live [`Endpoint`](crate::Endpoint) and the robots of
//! `crossguard-evaluation` are the same here.

use std::collections::{BTreeMap, VecDeque};

use crossguard_codec::Position;

use super::clustering::{CONTINUITY_MS, Cluster, Clustering, Ended, PerceivedVru, Settings};
use super::containers::Announced;
use super::generation::{INTERVAL_MAX_MS, INTERVAL_MIN_MS};
use super::motion::{Plane, distance_m};

/// How far a robot goes before its plane follows it, in metres: so far it is exact.
const PLANE_M: f64 = 1_000.0;
/// How soon a cluster is announced again, in ms: three quarters of what a device waits (`timeClusterContinuity`).
const ANNOUNCED_WITHIN_MS: u64 = 3 * CONTINUITY_MS / 4;
/// How many cluster VAM say that a cluster is over (`numClusterVAMRepeat`).
const BREAKUP_REPEAT: u8 = 3;

/// How often a robot sends the VAM of a cluster, in ms. By the triggers of clause 6 of TS 103 300-3 it could be as seldom
/// as every 5 s, and members take a head for lost after 2 s (`timeClusterContinuity`).
pub const CLUSTER_INTERVAL_MS: u64 = 500;

/// How a robot announces the people around it, and itself to stations that do not know RAM.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Awareness {
    /// How people are clustered.
    pub clustering: Settings,
    /// How often each cluster is announced by ETSI's cluster VAM as well, in ms: for devices that do not
    /// understand RAM. `None` is not at all.
    pub cluster_vam_interval_ms: Option<u64>,
    /// Whether the robot sends a CAM of itself beside its RAM.
    pub cam: bool,
}

/// The people around a robot.
#[derive(Clone, Debug)]
pub struct Surroundings {
    plane: Option<Plane>,
    clustering: Clustering,
    /// Clusters that were announced in RAM.
    announced: u64,
    cluster_vam_interval_ms: Option<u64>,
    last_cluster_vam_ms: Option<u64>,
    /// Clusters that a RAM or a cluster VAM announced and that are not over: which of the announcements in RAM
    /// was the last, 0 for none.
    told: BTreeMap<u8, u64>,
    /// Clusters that are over and that no RAM said so of.
    ended: VecDeque<Ended>,
    /// Clusters that cluster VAM break up, and how many of these are still to be sent.
    breakups: Vec<(Ended, u8)>,
}

/// Content of a cluster VAM.
#[derive(Clone, PartialEq, Debug)]
pub enum Told {
    /// A cluster and its place.
    Cluster(Cluster),
    /// The end of a cluster.
    Ended(Ended),
}

impl Surroundings {
    /// Surroundings without people. The ids of clusters follow from `seed`.
    #[must_use]
    pub fn new(awareness: Awareness, seed: u64) -> Self {
        Self {
            plane: None,
            clustering: Clustering::new(awareness.clustering, seed),
            announced: 0,
            cluster_vam_interval_ms: awareness.cluster_vam_interval_ms,
            last_cluster_vam_ms: None,
            told: BTreeMap::new(),
            ended: VecDeque::new(),
            breakups: Vec::new(),
        }
    }

    /// The plane that places are on, once the robot knows where it is.
    #[must_use]
    pub const fn plane(&self) -> Option<&Plane> {
        self.plane.as_ref()
    }

    /// The members and their clusters.
    #[must_use]
    pub const fn clustering(&self) -> &Clustering {
        &self.clustering
    }

    /// Takes in what a robot at `position` perceives at `now_ms`; places are relative to the robot.
    ///
    /// # Errors
    /// When the robot does not know where it is: then nobody could be told where the people are.
    pub fn perceive(
        &mut self,
        now_ms: u64,
        position: &Position,
        people: &[PerceivedVru],
    ) -> Result<(), Unplaced> {
        let plane = self.follow(now_ms, position).ok_or(Unplaced)?;
        let robot_m = plane.point(position).ok_or(Unplaced)?;
        let placed = people.iter().map(|vru| PerceivedVru {
            position_m: [0, 1].map(|axis| robot_m[axis] + vru.position_m[axis]),
            ..*vru
        });
        let placed: Vec<_> = placed.collect();
        self.clustering.perceive(now_ms, robot_m, &placed);
        self.note_ended();
        Ok(())
    }

    /// Queues the announcement that a cluster is over, for each cluster that was announced.
    fn note_ended(&mut self) {
        for ended in self.clustering.take_ended() {
            if self.told.remove(&ended.id).is_none() {
                continue;
            }
            self.ended.push_back(ended);
            if self.cluster_vam_interval_ms.is_some() {
                self.breakups.push((ended, BREAKUP_REPEAT));
            }
        }
    }

    /// The plane for a robot that is here now. Once it is far from its origin, a new one, on which nobody
    /// is known yet.
    fn follow(&mut self, now_ms: u64, position: &Position) -> Option<Plane> {
        let is_far = |plane: &Plane| {
            let point = plane.point(position);
            point.is_some_and(|point| distance_m(point, [0.0, 0.0]) > PLANE_M)
        };
        if self.plane.as_ref().is_none_or(is_far) {
            self.plane = Plane::around(position).or(self.plane);
            self.clustering.forget_everybody(now_ms);
        }
        self.plane
    }

    /// Forgets who was not perceived for too long.
    pub fn elapse(&mut self, now_ms: u64) {
        self.clustering.elapse(now_ms);
        self.note_ended();
    }

    /// Takes in what another robot announces in its RAM, on this robot's plane: see
    /// [`Clustering::leave_to`].
    pub fn hear(&mut self, now_ms: u64, own: u32, head: u32, announced: Option<&Announced>) {
        match announced {
            _ if head >= own => {}
            Some(cluster) => {
                let id = (head, cluster.id);
                self.clustering.leave_to(now_ms, id, cluster.area.clone());
            }
            None => self.clustering.take_back(now_ms, head),
        }
        self.note_ended();
    }

    /// Takes in that another robot's cluster is over.
    pub fn hear_ended(&mut self, now_ms: u64, head: u32, id: u8) {
        self.clustering.take_back_one(now_ms, (head, Some(id)));
        self.note_ended();
    }

    /// Whether there are people to announce, or clusters to say of that they are over.
    #[must_use]
    pub fn announces(&self) -> bool {
        self.clustering.count() > 0 || !self.ended.is_empty() || !self.breakups.is_empty()
    }

    /// All clusters are announced under new ids, which follow from `seed`, as after a change of pseudonym. Devices hear
    /// nothing of the clusters before any more, and join the new ones or speak for themselves again.
    pub fn renew_ids(&mut self, now_ms: u64, seed: u64) {
        self.clustering.renew_ids(now_ms, seed);
        self.told.clear();
        self.ended.clear();
        self.breakups.clear();
        self.last_cluster_vam_ms = None;
    }

    /// The longest interval between two RAM at which up to 15 clusters are announced every 1.5 s, in ms; the
    /// shortest one when a cluster is over.
    #[must_use]
    pub fn ram_interval_max_ms(&self) -> u64 {
        if !self.ended.is_empty() {
            return INTERVAL_MIN_MS;
        }
        let interval_ms = ANNOUNCED_WITHIN_MS / (self.clustering.count() as u64).max(1);
        // Where time is looked at every 100 ms, one in between would be the next longer one.
        let whole_ms = interval_ms / INTERVAL_MIN_MS * INTERVAL_MIN_MS;
        whole_ms.clamp(INTERVAL_MIN_MS, INTERVAL_MAX_MS)
    }

    /// Cluster, or end of one, that the next RAM announces, if there is any.
    pub fn next_told(&mut self) -> Option<Told> {
        match self.ended.pop_front() {
            Some(ended) => Some(Told::Ended(ended)),
            None => self.next_cluster().map(Told::Cluster),
        }
    }

    /// The cluster that was announced the longest ago; one that never was comes first.
    fn next_cluster(&mut self) -> Option<Cluster> {
        let clusters = self.clustering.clusters().into_iter();
        let last = |cluster: &Cluster| self.told.get(&cluster.id).copied().unwrap_or(0);
        let cluster = clusters.min_by_key(last)?;
        self.announced += 1;
        self.told.insert(cluster.id, self.announced);
        Some(cluster)
    }

    /// Contents of the cluster VAM that are due at `now_ms`. The first one that breaks a cluster up is due at once, the
    /// others every interval.
    pub fn due_cluster_vams(&mut self, now_ms: u64) -> Vec<Told> {
        let (Some(_), Some(interval_ms)) = (self.plane, self.cluster_vam_interval_ms) else {
            return Vec::new();
        };
        let is_early = |last| now_ms.saturating_sub(last) < interval_ms;
        let is_early = self.last_cluster_vam_ms.is_some_and(is_early);
        let mut due = Vec::new();
        for (ended, left) in &mut self.breakups {
            if !is_early || *left == BREAKUP_REPEAT {
                *left -= 1;
                due.push(Told::Ended(*ended));
            }
        }
        self.breakups.retain(|(_, left)| *left > 0);
        if is_early || (self.clustering.count() == 0 && due.is_empty()) {
            return due;
        }
        self.last_cluster_vam_ms = Some(now_ms);
        for cluster in self.clustering.clusters() {
            self.told.entry(cluster.id).or_default();
            due.push(Told::Cluster(cluster));
        }
        due
    }
}

/// People were perceived by a robot that does not know where it is.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
#[error("people were perceived, but the robot's own position is not known")]
pub struct Unplaced;

#[cfg(test)]
mod tests {
    use super::super::clustering::BreakupReason;
    use super::*;

    fn at(east_m: f64) -> Position {
        Plane::at(49.0, 8.4).position([east_m, 0.0])
    }

    fn surroundings() -> Surroundings {
        Surroundings::new(Awareness::default(), 1)
    }

    /// The robot, so far to the east, perceives people, each with its id and so far to the east of the robot.
    fn see(around: &mut Surroundings, now_ms: u64, east_m: f64, people: &[(u32, f64)]) {
        let people = people.iter();
        let people = people.map(|&(id, ahead_m)| PerceivedVru::pedestrian(id, [ahead_m, 0.0]));
        let perceived = around.perceive(now_ms, &at(east_m), &people.collect::<Vec<_>>());
        perceived.unwrap();
    }

    #[test]
    fn people_stay_where_they_are_while_the_robot_moves() {
        let mut around = surroundings();
        see(&mut around, 0, 0.0, &[(1, 5.0)]);
        let there = around.next_cluster().unwrap().center;
        see(&mut around, 500, 3.0, &[]);
        assert!(distance_m(around.next_cluster().unwrap().center, there) < 1e-9);
        see(&mut around, 600, 3.0, &[(1, 2.0)]);
        assert!(distance_m(around.next_cluster().unwrap().center, there) < 0.01);
    }

    #[test]
    fn a_robot_that_went_far_starts_a_new_plane() {
        let mut around = surroundings();
        see(&mut around, 0, 0.0, &[(1, 5.0)]);
        see(&mut around, 100, 1_500.0, &[]);
        assert_eq!(around.next_cluster(), None);
        see(&mut around, 200, 1_500.0, &[(1, 5.0)]);
        assert!(distance_m(around.next_cluster().unwrap().center, [5.0, 0.0]) < 0.01);
    }

    /// Hazard: one position that is no number is the origin of the plane for ever, and nobody is announced any more.
    #[test]
    fn a_robot_without_a_position_announces_nobody_until_it_has_one() {
        for lost in [
            Position::default(),
            Position::at(f64::NAN, 8.4),
            Position::at(49.0, f64::INFINITY),
        ] {
            let mut around = surroundings();
            let near = [PerceivedVru::pedestrian(1, [5.0, 0.0])];
            assert_eq!(around.perceive(0, &lost, &near), Err(Unplaced));
            see(&mut around, 100, 0.0, &[(1, 5.0)]);
            assert!(around.next_cluster().is_some(), "{lost:?}");
            assert_eq!(around.perceive(200, &lost, &near), Err(Unplaced));
            assert!(around.next_cluster().is_some(), "{lost:?}");
        }
    }

    #[test]
    fn cluster_vam_come_at_their_interval_while_there_is_a_cluster() {
        let awareness = Awareness {
            cluster_vam_interval_ms: Some(500),
            ..Awareness::default()
        };
        let mut around = Surroundings::new(awareness, 1);
        let mut sent = Vec::new();
        for now_ms in (0..3_000).step_by(100) {
            let people: &[_] = if now_ms < 1_000 { &[(1, 5.0)] } else { &[] };
            see(&mut around, now_ms, 0.0, people);
            let due = around.due_cluster_vams(now_ms);
            let is_there = due.iter().map(|told| matches!(told, Told::Cluster(_)));
            sent.extend(is_there.map(|is_there| (now_ms, is_there)));
        }
        // A person who is no longer perceived is forgotten a second after the last time, at 900 ms.
        let (is_there, is_over) = (true, false);
        let told = [
            (0, is_there),
            (500, is_there),
            (1_000, is_there),
            (1_500, is_there),
            (1_900, is_over),
            (2_000, is_over),
            (2_500, is_over),
        ];
        assert_eq!(sent, told);
    }

    #[test]
    fn the_cluster_that_waited_the_longest_is_next_and_each_comes_in_time() {
        let mut around = surroundings();
        let row = [(1, -10.0), (2, -5.0), (3, 0.0)];
        let mut id_of_next = |now_ms, count: usize| {
            see(&mut around, now_ms, 0.0, &row[..count]);
            let round_ms = around.ram_interval_max_ms() * u64::try_from(count).unwrap();
            assert!((1_000..=1_500).contains(&round_ms), "{round_ms}");
            match around.next_told() {
                Some(Told::Cluster(cluster)) => cluster.id,
                told => panic!("{told:?}"),
            }
        };
        let (first, second) = (id_of_next(0, 2), id_of_next(100, 2));
        assert_ne!(first, second);
        // A third one comes before the ones whose turn it would be.
        let third = id_of_next(200, 3);
        assert!(![first, second].contains(&third));
        let ids = [300, 400, 500].map(|now_ms| id_of_next(now_ms, 3));
        assert_eq!(ids, [first, second, third]);
    }

    #[test]
    fn a_ram_says_at_once_that_a_cluster_is_over_and_only_of_one_that_was_announced() {
        let mut around = surroundings();
        see(&mut around, 0, 0.0, &[(1, 5.0)]);
        let Some(Told::Cluster(cluster)) = around.next_told() else {
            panic!("nobody is announced")
        };
        see(&mut around, 100, 0.0, &[(2, -5.0)]);
        see(&mut around, 200, 0.0, &[(1, 30.0)]);
        assert_eq!(around.ram_interval_max_ms(), INTERVAL_MIN_MS);
        let over = Ended {
            id: cluster.id,
            reason: BreakupReason::ClusteringPurposeCompleted,
        };
        assert_eq!(around.next_told(), Some(Told::Ended(over)));
        assert_eq!(around.ram_interval_max_ms(), INTERVAL_MAX_MS);
        // The other person was never announced.
        see(&mut around, 300, 0.0, &[(2, 30.0)]);
        assert_eq!(around.next_told(), None);
    }
}
