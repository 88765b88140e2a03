//! A robot of the simulation: it stands, perceives everybody around it, and announces them.

#![allow(clippy::similar_names, reason = "the same time in us and in ms")]

use crossguard_codec::core::ram::RAM;
use crossguard_codec::{
    Capabilities, Identifiers, JobRole, Position, RobotCategory, RobotState, SlowState,
    TaskProgression, decode, encode, ram_from,
};
use crossguard_protocol::{Availability, Coordination, Ram, StationId, TaskSet, TaskType};

use super::simulation::{Behaviour, Payload};
use super::trace::Run;
use crate::ras::clustering::{Cluster, Clustering, PerceivedVru, Settings, VruClass};
use crate::ras::containers;
use crate::ras::generation::{Generation, INTERVAL_MAX_MS, Limits, Status, Trigger};
use crate::ras::motion::{Plane, Point, distance_m};
use crate::ras::vam::{Content, VamError, vam};
use crate::ras::vru::{AnnouncedCluster, Announcement, Understands};

/// Where the grid's origin is, in degrees.
const ORIGIN: [f64; 2] = [49.01, 8.41];
/// Station id of the first robot.
const FIRST_STATION: u32 = 1_000_000;
/// The robot's sensors lose people this far outside of the perception radius, in metres.
const SENSED_BEYOND_M: f64 = 5.0;

/// What a robot announced, as it is received.
#[derive(Clone, Debug)]
pub(super) struct Announced {
    head: u32,
    by: Understands,
    cluster: Option<containers::Announced>,
    velocity_mps: Option<[f64; 2]>,
}

impl Announced {
    pub(super) fn announcement(&self) -> Announcement<'_> {
        Announcement {
            head: self.head,
            by: self.by,
            cluster: self.cluster.as_ref().map(|cluster| AnnouncedCluster {
                id: cluster.id,
                area: &cluster.area,
                cardinality: cluster.cardinality,
                velocity_mps: self.velocity_mps,
            }),
        }
    }
}

/// A message of a robot.
pub(super) struct Message {
    pub(super) octets: usize,
    pub(super) payload: Payload,
}

/// Why a robot's message cannot be sent.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum RobotError {
    /// It contradicts itself.
    #[error(transparent)]
    Contradictory(#[from] crossguard_codec::ViewError),
    /// It cannot be encoded.
    #[error(transparent)]
    NotEncodable(#[from] crossguard_codec::EncodeError),
    /// What was encoded cannot be decoded.
    #[error(transparent)]
    NotDecodable(#[from] crossguard_codec::DecodeError),
    /// A cluster VAM cannot be made.
    #[error(transparent)]
    Vam(#[from] VamError),
}

/// A robot.
pub(super) struct Robot {
    station: u32,
    place: Point,
    plane: Plane,
    state: RobotState,
    generation: Generation,
    clustering: Clustering,
    ram_interval_ms: Option<u64>,
    cluster_vam_interval_ms: Option<u64>,
    last_ram_ms: Option<u64>,
    last_vam_ms: Option<u64>,
    sent: usize,
    perceived: Vec<PerceivedVru>,
}

impl Robot {
    pub(super) fn new(number: u32, place: Point, seed: u64, behaviour: &Behaviour) -> Self {
        let grid = Plane::at(ORIGIN[0], ORIGIN[1]);
        let station = FIRST_STATION + number;
        let by_vam = behaviour.understands == Understands::ClusterVam;
        let settings: Settings = behaviour.clustering;
        Self {
            station,
            place,
            plane: grid,
            state: state_of_a_robot(grid.position(place)),
            generation: Generation::default(),
            clustering: Clustering::new(settings, seed << 16 ^ u64::from(station)),
            ram_interval_ms: behaviour.ram_interval_ms,
            cluster_vam_interval_ms: by_vam.then_some(behaviour.cluster_vam_interval_ms),
            last_ram_ms: None,
            last_vam_ms: None,
            sent: 0,
            perceived: Vec::new(),
        }
    }

    pub(super) const fn place(&self) -> Point {
        self.place
    }

    /// Perceives everybody around, and the messages that are due.
    pub(super) fn check(
        &mut self,
        now_us: u64,
        run: &Run,
        congestion_ms: u64,
    ) -> Result<Vec<Message>, RobotError> {
        let now_ms = now_us / 1_000;
        self.perceive(now_us, run);
        let mut messages = Vec::new();
        if let Some(trigger) = self.ram_trigger(now_ms, congestion_ms) {
            messages.push(self.ram(now_ms, trigger)?);
        }
        if let Some(interval_ms) = self.cluster_vam_interval_ms
            && self
                .last_vam_ms
                .is_none_or(|last| now_ms - last >= interval_ms)
        {
            for cluster in self.clustering.clusters() {
                self.last_vam_ms = Some(now_ms);
                messages.push(self.cluster_vam(now_ms, &cluster)?);
            }
        }
        Ok(messages)
    }

    fn perceive(&mut self, now_us: u64, run: &Run) {
        let reach_m = self.clustering.settings().radius_m + SENSED_BEYOND_M;
        self.perceived.clear();
        for (id, track) in (0_u32..).zip(&run.pedestrians) {
            let motion = track.motion(now_us);
            if distance_m(motion.position_m, self.place) <= reach_m {
                self.perceived.push(PerceivedVru {
                    id,
                    position_m: motion.position_m,
                    velocity_mps: motion.velocity_mps(),
                    class: VruClass::Pedestrian,
                    confidence: 1.0,
                });
            }
        }
        self.clustering
            .perceive(now_us / 1_000, self.place, &self.perceived);
    }

    fn status(&self) -> Status {
        Status {
            view: Ram {
                station: StationId(self.station),
                coordination: Coordination::None,
                farewell: None,
            },
            availability: Availability::Available,
            progression: TaskProgression::Idle,
        }
    }

    fn ram_trigger(&self, now_ms: u64, congestion_ms: u64) -> Option<Trigger> {
        if let Some(interval_ms) = self.ram_interval_ms {
            let interval_ms = interval_ms.max(congestion_ms);
            let is_due = |last: u64| now_ms - last >= interval_ms;
            return self
                .last_ram_ms
                .is_none_or(is_due)
                .then_some(Trigger::Interval);
        }
        let limits = Limits {
            congestion_ms,
            max_ms: INTERVAL_MAX_MS / (self.clustering.count() as u64).max(1),
        };
        self.generation
            .trigger(now_ms, limits, &self.state, &self.status())
    }

    fn ram(&mut self, now_ms: u64, trigger: Trigger) -> Result<Message, RobotError> {
        let ids = Identifiers::default();
        let clusters = self.clustering.clusters();
        let cluster = clusters.get(self.sent % clusters.len().max(1));
        self.sent += 1;
        self.last_ram_ms = Some(now_ms);
        let low_frequency = self.generation.low_frequency_due(now_ms);
        let (status, time) = (
            self.status(),
            crossguard_codec::si::generation_delta_time(now_ms),
        );
        let available = status.availability;
        let mut ram = ram_from(
            &ids,
            &self.state,
            &status.view,
            available,
            time,
            low_frequency,
        )?;
        containers::write(&mut ram, &self.plane, cluster);
        self.generation
            .sent(now_ms, trigger, &self.state, status, low_frequency);
        let octets = encode(&ids, &ram)?;
        let received = decode::<RAM>(&ids, &octets)?.message;
        let announced = Announced {
            head: self.station,
            by: Understands::Ram,
            cluster: containers::read(&received, &self.plane),
            velocity_mps: None,
        };
        Ok(Message {
            octets: octets.len(),
            payload: Payload::Robot(Some(Box::new(announced))),
        })
    }

    /// The same cluster for devices that do not understand RAM. Its area is the one that is on the wire.
    fn cluster_vam(&self, now_ms: u64, cluster: &Cluster) -> Result<Message, RobotError> {
        let [east, north] = cluster.velocity_mps;
        let state = RobotState {
            position: self.plane.position(self.place),
            heading: Some(east.atan2(north).to_degrees().rem_euclid(360.0).into()),
            speed: Some(east.hypot(north).into()),
            ..RobotState::default()
        };
        let octets = vam(
            self.station,
            &state,
            now_ms,
            Content::Cluster(cluster, &self.plane),
        )?;
        let wire = cluster.area.to_wire(self.place);
        let announced = Announced {
            head: self.station,
            by: Understands::ClusterVam,
            cluster: Some(containers::Announced {
                id: Some(cluster.id),
                area: crate::ras::area::Area::of_wire(&wire, self.place),
                cardinality: cluster.cardinality,
            }),
            velocity_mps: Some(cluster.velocity_mps),
        };
        Ok(Message {
            octets: octets.len(),
            payload: Payload::Robot(Some(Box::new(announced))),
        })
    }
}

/// A robot that guards a crossing, and stands.
fn state_of_a_robot(position: Position) -> RobotState {
    RobotState {
        position,
        speed: Some(0.0.into()),
        heading: Some(0.0.into()),
        category: RobotCategory::Humanoid,
        job_role: JobRole::TrafficGuard,
        slow: Some(SlowState {
            capabilities: Capabilities::PEDESTRIAN_DETECTION.union(Capabilities::LEADING),
            supported_tasks: TaskSet::of(&[TaskType::MOVE, TaskType::BLOCK]),
            ..SlowState::default()
        }),
        ..RobotState::default()
    }
}
