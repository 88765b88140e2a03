//! A robot of the simulation: it perceives everybody around it, and announces them.

#![allow(clippy::similar_names, reason = "the same time in us and in ms")]

use crossguard_codec::core::ram::RAM;
use crossguard_codec::{
    Capabilities, ExecutionStatus, Identifiers, JobRole, RobotCategory, RobotState, SlowState,
    TaskParameters, TaskProgression, decode, encode, ram_from, rmcm_from_answer,
    rmcm_from_commands,
};
use crossguard_endpoint::ras::area::Area;
use crossguard_endpoint::ras::clustering::{Cluster, PerceivedVru, VruClass};
use crossguard_endpoint::ras::containers::{self, Announced};
use crossguard_endpoint::ras::etsi::NotMade;
use crossguard_endpoint::ras::generation::{Generation, Limits, Status, Trigger};
use crossguard_endpoint::ras::motion::{Plane, Point, distance_m};
use crossguard_endpoint::ras::surroundings::{Awareness, Surroundings, Told, Unplaced};
use crossguard_endpoint::ras::vam::vam_of;
use crossguard_protocol::{Availability, Coordination, Ram, Rmcm, StationId, TaskSet, TaskType};

use super::behaviour::Behaviour;
use super::crew::{Crew, Said};
use super::trace::{Run, Track};
use super::vru::{Announcement, Understands};

/// Where the grid's origin is, in degrees.
const ORIGIN: [f64; 2] = [49.01, 8.41];
/// Station id of the first robot.
const FIRST_STATION: u32 = 1_000_000;
/// The robot's sensors lose people this far outside of the perception radius, in metres.
const SENSED_BEYOND_M: f64 = 5.0;

#[derive(Clone, Debug)]
pub(super) struct Message {
    pub(super) octets: usize,
    /// The announcement to devices, as they receive it.
    pub(super) announced: Option<Announcement>,
    /// The message to robots that coordinate.
    said: Option<Said>,
    from: Point,
}

/// Why a robot's message cannot be sent.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum RobotError {
    /// It cannot be made.
    #[error(transparent)]
    NotMade(#[from] NotMade),
    /// It does not know where it is.
    #[error(transparent)]
    Unplaced(#[from] Unplaced),
}

pub(super) struct Robot<'a> {
    station: u32,
    track: &'a Track,
    state: RobotState,
    generation: Generation,
    surroundings: Surroundings,
    radius_m: f64,
    ram_interval_ms: Option<u64>,
    last_ram_ms: Option<u64>,
    /// People that it does not perceive, by number.
    unseen: Vec<bool>,
    /// Its part in sessions, if robots hold some.
    crew: Option<Crew>,
    perceived: Vec<PerceivedVru>,
}

impl<'a> Robot<'a> {
    pub(super) fn new(number: u32, track: &'a Track, run: &Run, behaviour: &Behaviour) -> Self {
        let station = FIRST_STATION + number;
        let by_vam = behaviour.understands == Understands::ClusterVam;
        let awareness = Awareness {
            clustering: behaviour.clustering,
            cluster_vam_interval_ms: by_vam.then_some(behaviour.cluster_vam_interval_ms),
            cam: false,
        };
        Self {
            station,
            track,
            state: state_of_a_robot(),
            generation: Generation::default(),
            surroundings: Surroundings::new(awareness, run.seed << 16 ^ u64::from(station)),
            radius_m: awareness.clustering.radius_m,
            ram_interval_ms: behaviour.ram_interval_ms,
            last_ram_ms: None,
            unseen: (0_u32..)
                .take(run.pedestrians.len())
                .map(|person| behaviour.is_unseen(person))
                .collect(),
            crew: behaviour
                .sessions
                .map(|sessions| Crew::new(station, number, sessions)),
            perceived: Vec::new(),
        }
    }

    pub(super) fn place(&self, now_us: u64) -> Point {
        self.track.motion(now_us).position_m
    }

    /// Perceives everybody around, and the messages that are due.
    pub(super) fn check(
        &mut self,
        now_us: u64,
        run: &Run,
        congestion_ms: u64,
    ) -> Result<Vec<Message>, RobotError> {
        let now_ms = now_us / 1_000;
        let motion = self.track.motion(now_us);
        self.state.position = grid().position(motion.position_m);
        self.state.speed = Some(motion.speed_mps.into());
        self.state.heading = Some(motion.heading_deg.into());
        self.perceive(now_us, motion.position_m, run)?;
        let mut messages = Vec::new();
        for said in self
            .crew
            .as_mut()
            .map_or_else(Vec::new, |it| it.pass(now_ms))
        {
            messages.push(match said {
                Said::Ram(_) => self.ram(now_ms, Trigger::Heartbeat)?,
                Said::Rmcm(rmcm) => self.rmcm(now_ms, &rmcm)?,
            });
        }
        if let Some(trigger) = self.ram_trigger(now_ms, congestion_ms) {
            messages.push(self.ram(now_ms, trigger)?);
        }
        for told in self.surroundings.due_cluster_vams(now_ms) {
            let Some(plane) = self.surroundings.plane() else {
                continue;
            };
            let (ids, position) = (Identifiers::default(), &self.state.position);
            let octets = vam_of(&ids, self.station, position, now_ms, &told, plane)?.len();
            messages.push(match told {
                Told::Cluster(cluster) => self.cluster_vam(&cluster, octets),
                Told::Ended(ended) => self.breakup_vam(ended.id, octets),
            });
        }
        Ok(messages)
    }

    fn perceive(&mut self, now_us: u64, place: Point, run: &Run) -> Result<(), Unplaced> {
        let reach_m = self.radius_m + SENSED_BEYOND_M;
        self.perceived.clear();
        let people = (0_u32..).zip(&run.pedestrians).zip(&self.unseen);
        for ((id, track), _) in people.filter(|((_, it), unseen)| !**unseen && it.is_there(now_us))
        {
            let motion = track.motion(now_us);
            if distance_m(motion.position_m, place) <= reach_m {
                self.perceived.push(PerceivedVru {
                    id,
                    position_m: [0, 1].map(|axis| motion.position_m[axis] - place[axis]),
                    velocity_mps: motion.velocity_mps(),
                    class: VruClass::Pedestrian,
                    confidence: 1.0,
                });
            }
        }
        let position = self.state.position;
        self.surroundings
            .perceive(now_us / 1_000, &position, &self.perceived)
    }

    pub(super) fn perceives(&self, person: u32) -> bool {
        self.surroundings.clustering().is_member(person)
    }

    pub(super) fn hear(&mut self, now_us: u64, message: &Message) {
        let now_ms = now_us / 1_000;
        if let (Some(crew), Some(said)) = (&mut self.crew, &message.said) {
            let away_m = distance_m(self.track.motion(now_us).position_m, message.from);
            crew.hear(now_ms, said, away_m);
        }
        let Some(heard) = &message.announced else {
            return;
        };
        if heard.by == Understands::Ram {
            if let Some(id) = heard.ended {
                self.surroundings.hear_ended(now_ms, heard.head, id);
                return;
            }
            let cluster = heard.cluster.as_ref();
            let on_own_plane = cluster.and_then(|it| self.on_own_plane(it));
            let (own, head) = (self.station, heard.head);
            self.surroundings
                .hear(now_ms, own, head, on_own_plane.as_ref());
        }
    }

    /// A cluster on the grid's plane, moved to the plane that the robot keeps.
    fn on_own_plane(&self, cluster: &Announced) -> Option<Announced> {
        let origin = self
            .surroundings
            .plane()?
            .point(&grid().position([0.0, 0.0]))?;
        Some(Announced {
            area: cluster.area.clone().moved(origin),
            ..cluster.clone()
        })
    }

    fn status(&self) -> Status {
        let idle = Ram {
            station: StationId(self.station),
            coordination: Coordination::None,
            farewell: None,
            on_duty: false,
        };
        Status {
            view: self.crew.as_ref().map_or(idle, Crew::ram),
            availability: Availability::Available,
            progression: TaskProgression::Idle,
        }
    }

    fn ram_trigger(&self, now_ms: u64, congestion_ms: u64) -> Option<Trigger> {
        if self.crew.as_ref().is_some_and(Crew::is_busy) {
            // The protocol has its own timer.
            return None;
        }
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
            max_ms: self.surroundings.ram_interval_max_ms(),
        };
        self.generation
            .trigger(now_ms, limits, &self.state, &self.status())
    }

    fn ram(&mut self, now_ms: u64, trigger: Trigger) -> Result<Message, NotMade> {
        let ids = Identifiers::default();
        let told = self.surroundings.next_told();
        self.last_ram_ms = Some(now_ms);
        let low_frequency = self.generation.low_frequency_due(now_ms, &self.state);
        let status = self.status();
        let from = self.place(1_000 * now_ms);
        let said = self.crew.is_some().then_some(Said::Ram(status.view));
        let time = crossguard_codec::si::generation_delta_time(now_ms);
        let available = status.availability;
        let mut ram = ram_from(
            &ids,
            &self.state,
            &status.view,
            available,
            time,
            low_frequency,
        )?;
        match (&told, self.surroundings.plane()) {
            (Some(Told::Cluster(cluster)), Some(plane)) => {
                containers::write(&mut ram, plane, Some(cluster));
            }
            (Some(Told::Ended(ended)), _) => containers::write_ended(&mut ram, *ended),
            (Some(Told::Cluster(_)) | None, _) => {}
        }
        self.generation
            .sent(now_ms, trigger, &self.state, status, low_frequency);
        let octets = encode(&ids, &ram)?;
        let received = decode::<RAM>(&ids, &octets)?.message;
        let parameters = &received.ram.ram_parameters;
        let container = parameters.vru_cluster_information_container.as_ref();
        let information = container.map(|it| &it.vru_cluster_information);
        let announced = Announcement {
            head: self.station,
            by: Understands::Ram,
            cluster: containers::read(&received, &grid()),
            velocity_mps: containers::velocity_mps(&received),
            ended: information.and_then(containers::ended),
        };
        Ok(Message {
            octets: octets.len(),
            announced: Some(announced),
            said,
            from,
        })
    }

    fn rmcm(&self, now_ms: u64, rmcm: &Rmcm) -> Result<Message, NotMade> {
        let (ids, position) = (Identifiers::default(), &self.state.position);
        let time = crossguard_codec::si::generation_delta_time(now_ms);
        let message = match rmcm {
            Rmcm::Command(command) => {
                let commands = [(*command, TaskParameters::default())];
                rmcm_from_commands(&ids, position, &commands, time)
            }
            Rmcm::Answer(answer) => {
                let status = ExecutionStatus {
                    progression: self.state.task_progression,
                    time_to_completion: None,
                };
                rmcm_from_answer(&ids, position, answer, status, time)
            }
        };
        Ok(Message {
            octets: encode(&ids, &message?)?.len(),
            announced: None,
            said: Some(Said::Rmcm(*rmcm)),
            from: self.place(1_000 * now_ms),
        })
    }

    /// A cluster VAM, which says nothing to robots that coordinate.
    fn by_vam(announced: Announcement, octets: usize) -> Message {
        Message {
            octets,
            announced: Some(announced),
            said: None,
            from: [0.0, 0.0],
        }
    }

    /// The same cluster for devices that do not understand RAM. Its area is the one that is on the wire.
    fn cluster_vam(&self, cluster: &Cluster, octets: usize) -> Message {
        let on_grid = || {
            let own = self.surroundings.plane()?;
            let wire = cluster.area.to_wire(own.point(&self.state.position)?);
            Some(Area::of_wire(&wire, grid().point(&self.state.position)?))
        };
        let announced = Announcement {
            head: self.station,
            by: Understands::ClusterVam,
            cluster: on_grid().map(|area| Announced {
                id: Some(cluster.id),
                area,
                cardinality: cluster.cardinality,
            }),
            velocity_mps: Some(cluster.velocity_mps),
            ended: None,
        };
        Self::by_vam(announced, octets)
    }

    /// The VAM that ends the cluster of this id.
    fn breakup_vam(&self, id: u8, octets: usize) -> Message {
        let announced = Announcement {
            head: self.station,
            by: Understands::ClusterVam,
            cluster: None,
            velocity_mps: None,
            ended: Some(id),
        };
        Self::by_vam(announced, octets)
    }
}

fn grid() -> Plane {
    Plane::at(ORIGIN[0], ORIGIN[1])
}

fn state_of_a_robot() -> RobotState {
    RobotState {
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
