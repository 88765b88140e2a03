//! What a robot perceives of the people around it, and what it announces of them: one cluster in every
//! RAM, in turn, and a cluster VAM for each where devices do not understand RAM.
//!
//! ```text
//!  sensor ──► perceive ─┐
//!                       ├─► clusters ──► next ──► RAM
//!  other robots' RAM ───┘           └──► cluster_vams
//!             (hear)
//! ```
//!
//! Places are kept on a plane that stays where it is while the robot moves, so that people do not move
//! with it. Without input and output; the live [`Endpoint`](crate::Endpoint) and the robots of
//! `crossguard-evaluation` are the same here.

use crossguard_codec::{Identifiers, Position};

use super::clustering::{Cluster, Clustering, PerceivedVru, Settings};
use super::containers::Announced;
use super::etsi::NotMade;
use super::generation::INTERVAL_MAX_MS;
use super::motion::{Plane, distance_m};
use super::vam::cluster_vam;

/// How far a robot goes before its plane follows it, in metres: so far it is exact.
const PLANE_M: f64 = 1_000.0;

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
    announced: usize,
    cluster_vam_interval_ms: Option<u64>,
    last_cluster_vam_ms: Option<u64>,
}

impl Surroundings {
    /// Nobody is around yet. The ids of clusters follow from `seed`.
    #[must_use]
    pub fn new(awareness: Awareness, seed: u64) -> Self {
        Self {
            plane: None,
            clustering: Clustering::new(awareness.clustering, seed),
            announced: 0,
            cluster_vam_interval_ms: awareness.cluster_vam_interval_ms,
            last_cluster_vam_ms: None,
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
        Ok(())
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
    }

    /// The longest interval between two RAM at which every cluster is announced about once a second, in
    /// ms.
    #[must_use]
    pub fn ram_interval_max_ms(&self) -> u64 {
        INTERVAL_MAX_MS / (self.clustering.count() as u64).max(1)
    }

    /// The cluster that the next RAM announces, if there is one.
    pub fn next_cluster(&mut self) -> Option<Cluster> {
        let clusters = self.clustering.clusters();
        let turn = self.announced % clusters.len().max(1);
        self.announced = self.announced.wrapping_add(1);
        clusters.into_iter().nth(turn)
    }

    /// The cluster VAM that are due at `now_ms` from `station` at `position`, each with its cluster;
    /// `timestamp_its` is the time of the position.
    pub fn cluster_vams(
        &mut self,
        ids: &Identifiers,
        now_ms: u64,
        timestamp_its: u64,
        station: u32,
        position: &Position,
    ) -> Vec<(Cluster, Result<Vec<u8>, NotMade>)> {
        let (Some(plane), Some(interval_ms)) = (self.plane, self.cluster_vam_interval_ms) else {
            return Vec::new();
        };
        let is_early = |last| now_ms.saturating_sub(last) < interval_ms;
        if self.clustering.count() == 0 || self.last_cluster_vam_ms.is_some_and(is_early) {
            return Vec::new();
        }
        self.last_cluster_vam_ms = Some(now_ms);
        let clusters = self.clustering.clusters().into_iter();
        let vams = clusters.map(|cluster| {
            let vam = cluster_vam(ids, station, position, timestamp_its, &cluster, &plane);
            (cluster, vam)
        });
        vams.collect()
    }
}

/// People were perceived by a robot that does not know where it is.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
#[error("people were perceived, but the robot's own position is not known")]
pub struct Unplaced;

#[cfg(test)]
mod tests {
    use super::super::clustering::VruClass;
    use super::super::motion::Point;
    use super::*;

    fn person(id: u32, position_m: Point) -> PerceivedVru {
        PerceivedVru {
            id,
            position_m,
            velocity_mps: [0.0, 0.0],
            class: VruClass::Pedestrian,
            confidence: 1.0,
        }
    }

    fn at(east_m: f64) -> Position {
        Plane::at(49.0, 8.4).position([east_m, 0.0])
    }

    fn surroundings() -> Surroundings {
        Surroundings::new(Awareness::default(), 1)
    }

    #[test]
    fn people_stay_where_they_are_while_the_robot_moves() {
        let mut around = surroundings();
        around
            .perceive(0, &at(0.0), &[person(1, [5.0, 0.0])])
            .unwrap();
        let there = around.next_cluster().unwrap().center;
        around.perceive(500, &at(3.0), &[]).unwrap();
        assert!(distance_m(around.next_cluster().unwrap().center, there) < 1e-9);
        around
            .perceive(600, &at(3.0), &[person(1, [2.0, 0.0])])
            .unwrap();
        assert!(distance_m(around.next_cluster().unwrap().center, there) < 0.01);
    }

    #[test]
    fn a_robot_that_went_far_starts_a_new_plane() {
        let mut around = surroundings();
        let near = [person(1, [5.0, 0.0])];
        around.perceive(0, &at(0.0), &near).unwrap();
        around.perceive(100, &at(1_500.0), &[]).unwrap();
        assert_eq!(around.next_cluster(), None);
        around.perceive(200, &at(1_500.0), &near).unwrap();
        assert!(distance_m(around.next_cluster().unwrap().center, [5.0, 0.0]) < 0.01);
    }

    #[test]
    fn a_robot_without_a_position_announces_nobody() {
        let lost = Position::default();
        let near = [person(1, [5.0, 0.0])];
        assert_eq!(surroundings().perceive(0, &lost, &near), Err(Unplaced));
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
            let near = [person(1, [5.0, 0.0])];
            let people: &[PerceivedVru] = if now_ms < 1_000 { &near } else { &[] };
            around.perceive(now_ms, &at(0.0), people).unwrap();
            let vams = around.cluster_vams(&Identifiers::default(), now_ms, now_ms, 7, &at(0.0));
            sent.extend(vams.iter().map(|(_, vam)| (now_ms, vam.is_ok())));
        }
        // Who is no longer perceived is forgotten a second after the last time, at 900 ms.
        assert_eq!(sent, [(0, true), (500, true), (1_000, true), (1_500, true)]);
    }
}
