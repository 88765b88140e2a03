//! Logs as MCAP files, for Foxglove and for tools of ROS 2.
//!
//! All messages are JSON with a JSON Schema, so that no plugin is needed; a robot has its topics under
//! its name:
//!
//! | topic | schema | when |
//! |---|---|---|
//! | `/ARI/state` | `crossguard.State` | its part in a session changes |
//! | `/ARI/step` | `crossguard.Step` | a step in which more than time has passed |
//! | `/ARI/message` | `crossguard.Message` | sent, heard, or lost by the fault layer |
//! | `/ARI/counters` | `crossguard.Counters` | one more was dropped or ignored, or the robot has booted again |
//! | `/ARI/location` | `foxglove.LocationFix` | each of its RAM |
//! | `/ARI/corridor` | `crossguard.Corridor` | it lets the pedestrian cross, or no longer does |
//! | `/ARI/places` | `foxglove.SceneUpdate` | its commands: where followers go, hold and escort |
//! | `/ARI/people` | `crossguard.People` | its sensors have other people, or have them elsewhere |
//! | `/ARI/around` | `crossguard.Around` | once a second: who is on its map |
//! | `/ARI/crossing` | `foxglove.SceneUpdate` | the same, or its RAM announces a cluster: zone, people and clusters |
//! | `/robots` | `foxglove.SceneUpdate` | each RAM: boxes with name and state |
//! | `/tf` | `foxglove.FrameTransform` | each RAM |
//! | `/log` | `foxglove.Log` | what a sequence chart notes |

mod scene;
mod schemas;

use std::collections::{BTreeMap, BTreeSet};
use std::io::{Seek, Write};

use crossguard_endpoint::counters::CauseName;
use crossguard_protocol::State as Stage;
use crossguard_robot::sight::{Outline, Sight};
use crossguard_robot::site::Site;
use crossguard_robot::trace::{LogError, Merged, Record, Timed};
use mcap::records::{MessageHeader, Metadata};
use mcap::{McapError, WriteOptions, Writer};
use schemas::{Counter, Kind, Time};

use crate::facts::{Area, ClusterView, Direction, Fact, Message, Observer, Placed, View};

/// Why logs cannot be written as an MCAP file.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// A log cannot be read.
    #[error(transparent)]
    Log(#[from] LogError),
    /// The file cannot be written.
    #[error(transparent)]
    Mcap(#[from] McapError),
}

/// How many messages there are by topic.
pub type Written = BTreeMap<String, u64>;

/// Writes what `logs` tell to `file`.
///
/// # Errors
/// When a log cannot be read, or the file cannot be written.
pub fn write(mut logs: Merged, file: impl Write + Seek) -> Result<Written, ExportError> {
    let mut recording = Recording::new(file)?;
    let mut observer = Observer::default();
    while let Some(Timed { at_us, record, .. }) = logs.take()? {
        let facts = observer.take(&record);
        let robot = recording.robot(&record);
        for fact in facts {
            recording.write(at_us, robot, fact)?;
        }
    }
    recording.finish()
}

/// A file in the making.
struct Recording<W: Write + Seek> {
    writer: Writer<W>,
    /// By topic: the channel, and how many messages it has.
    channels: BTreeMap<String, (u16, u64)>,
    robots: Vec<Shown>,
    topics: BTreeSet<String>,
    /// The origin of the frame `street`.
    site: Option<Site>,
}

/// What is known of a robot.
#[derive(Default)]
struct Shown {
    name: String,
    /// Its name as a token of a topic.
    topic: String,
    view: Option<View>,
    areas: Vec<Area>,
    counters: BTreeMap<CauseName, u64>,
    crossing: Crossing,
}

/// What there is to be seen at a robot's crossing.
#[derive(Default)]
struct Crossing {
    zone: Outline,
    sight: Sight,
    clusters: BTreeMap<u8, ClusterView>,
    is_drawn: bool,
}

impl<W: Write + Seek> Recording<W> {
    fn new(file: W) -> Result<Self, McapError> {
        let library = concat!("crossguard ", env!("CARGO_PKG_VERSION"));
        let options = WriteOptions::new().compression(None).library(library);
        Ok(Self {
            writer: options.create(file)?,
            channels: BTreeMap::new(),
            robots: Vec::new(),
            topics: BTreeSet::new(),
            site: None,
        })
    }

    /// The place of the robot of a record.
    fn robot(&mut self, record: &Record) -> usize {
        let known = self.robots.iter().position(|it| it.name == record.robot);
        known.unwrap_or_else(|| {
            let topic = self.token(&record.robot);
            self.robots.push(Shown {
                name: record.robot.clone(),
                topic,
                ..Shown::default()
            });
            self.robots.len() - 1
        })
    }

    /// A robot's name as ROS allows it in names of topics, different from all others.
    fn token(&mut self, name: &str) -> String {
        let allowed = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
        let mut token: String = name.chars().map(allowed).collect();
        if !token.starts_with(|c: char| c.is_ascii_alphabetic()) {
            token.insert_str(0, "robot");
        }
        while !self.topics.insert(token.clone()) || ["robots", "tf", "log"].contains(&&*token) {
            token.push('x');
        }
        token
    }

    fn write(&mut self, at_us: u64, robot: usize, fact: Fact) -> Result<(), McapError> {
        let timestamp = time(at_us);
        let name = self.robots[robot].name.clone();
        match fact {
            Fact::State(view) => {
                let message = state(timestamp, name, &view);
                self.robots[robot].view = Some(view);
                self.of_robot(robot, "state", at_us, &message)
            }
            Fact::Step { input, outputs } => {
                let message = schemas::Step {
                    timestamp,
                    robot: name,
                    input,
                    outputs,
                };
                self.of_robot(robot, "step", at_us, &message)
            }
            Fact::Message(it) => {
                self.of_robot(robot, "message", at_us, &message(timestamp, name, it))
            }
            Fact::Counted { cause, count } => {
                self.robots[robot].counters.insert(cause, count);
                self.counters(at_us, robot)
            }
            Fact::Note { is_warning, text } => {
                let message = schemas::Log {
                    timestamp,
                    level: 2 + u8::from(is_warning),
                    message: text,
                    name,
                    file: String::new(),
                    line: 0,
                };
                self.message("/log", at_us, &message)
            }
            Fact::Corridor { is_open, why, .. } => {
                let message = schemas::Corridor {
                    timestamp,
                    robot: name,
                    is_open,
                    why,
                };
                self.of_robot(robot, "corridor", at_us, &message)?;
                self.areas(at_us, robot, is_open)
            }
            Fact::Areas(areas) => {
                self.robots[robot].areas = areas;
                let view = self.robots[robot].view.as_ref();
                let is_open = view.is_some_and(|view| view.corridor_open);
                self.areas(at_us, robot, is_open)
            }
            Fact::Place(placed) => self.place(at_us, robot, &placed),
            Fact::Zone(outline) => {
                self.robots[robot].crossing.zone = outline;
                self.crossing(at_us, robot)
            }
            Fact::People(sight) => {
                let message = scene::people(timestamp, name, &sight);
                self.robots[robot].crossing.sight = sight;
                self.of_robot(robot, "people", at_us, &message)?;
                self.crossing(at_us, robot)
            }
            Fact::Around(around) => {
                let message = schemas::around(timestamp, name, &around);
                self.of_robot(robot, "around", at_us, &message)
            }
            Fact::Cluster(cluster) => {
                let clusters = &mut self.robots[robot].crossing.clusters;
                match cluster {
                    Some(cluster) => {
                        clusters.insert(cluster.id, cluster);
                    }
                    None => clusters.clear(),
                }
                self.crossing(at_us, robot)
            }
            Fact::Started { .. } => {
                // Counters begin anew with a robot; who looks must not see those of its life before.
                if self.robots[robot].counters.is_empty() {
                    return Ok(());
                }
                self.robots[robot].counters.clear();
                self.counters(at_us, robot)
            }
            Fact::Stopped => Ok(()),
        }
    }

    fn counters(&mut self, at_us: u64, robot: usize) -> Result<(), McapError> {
        let shown = &self.robots[robot];
        let counters = shown.counters.iter().map(|(cause, &count)| Counter {
            layer: cause.layer.name().to_owned(),
            cause: cause.reason.to_string(),
            count,
        });
        let message = schemas::Counters {
            timestamp: time(at_us),
            robot: shown.name.clone(),
            counters: counters.collect(),
        };
        self.of_robot(robot, "counters", at_us, &message)
    }

    fn place(&mut self, at_us: u64, robot: usize, placed: &Placed) -> Result<(), McapError> {
        let timestamp = time(at_us);
        let site = self.site(placed)?;
        let shown = &self.robots[robot];
        let frame = shown.topic.clone();
        let seen = shown
            .view
            .as_ref()
            .map(|view| scene::robot(timestamp, &frame, robot, &shown.name, (view, placed)));
        let fix = scene::location_fix(timestamp, &frame, placed);
        self.of_robot(robot, "location", at_us, &fix)?;
        let transform = scene::transform(timestamp, &frame, &site, placed);
        self.message("/tf", at_us, &transform)?;
        let crossing = &self.robots[robot].crossing;
        if !crossing.is_drawn && crossing.zone != Outline::default() {
            self.crossing(at_us, robot)?;
        }
        seen.map_or(Ok(()), |seen| self.message("/robots", at_us, &seen))
    }

    /// The street's frame, which begins where the first robot was first.
    fn site(&mut self, placed: &Placed) -> Result<Site, McapError> {
        if let Some(site) = self.site {
            return Ok(site);
        }
        let site = Site {
            latitude: placed.latitude,
            longitude: placed.longitude,
            ..Site::default()
        };
        let pair = |key: &str, degrees: f64| (key.to_owned(), degrees.to_string());
        let metadata = [
            pair("latitude", site.latitude),
            pair("longitude", site.longitude),
        ];
        self.writer.write_metadata(&Metadata {
            name: format!("origin of {}", scene::STREET),
            metadata: metadata.into(),
        })?;
        Ok(*self.site.insert(site))
    }

    fn areas(&mut self, at_us: u64, robot: usize, is_open: bool) -> Result<(), McapError> {
        let Some(site) = self.site else {
            return Ok(());
        };
        let shown = &self.robots[robot];
        let seen = scene::areas(time(at_us), &site, &shown.name, &shown.areas, is_open);
        self.of_robot(robot, "places", at_us, &seen)
    }

    /// Zone, people and clusters of a robot, once it is known where the street is.
    fn crossing(&mut self, at_us: u64, robot: usize) -> Result<(), McapError> {
        let Some(site) = self.site else {
            return Ok(());
        };
        let crossing = &mut self.robots[robot].crossing;
        crossing.is_drawn = true;
        let seen = scene::crossing(
            time(at_us),
            &site,
            (&crossing.zone, &crossing.sight),
            crossing.clusters.values(),
        );
        self.of_robot(robot, "crossing", at_us, &seen)
    }

    fn of_robot<M: Kind>(
        &mut self,
        robot: usize,
        topic: &str,
        at_us: u64,
        message: &M,
    ) -> Result<(), McapError> {
        let topic = format!("/{}/{topic}", self.robots[robot].topic);
        self.message(&topic, at_us, message)
    }

    fn message<M: Kind>(&mut self, topic: &str, at_us: u64, message: &M) -> Result<(), McapError> {
        if !self.channels.contains_key(topic) {
            let schema = serde_json::to_vec(&M::schema()).map_err(std::io::Error::from)?;
            let schema = self.writer.add_schema(M::NAME, "jsonschema", &schema)?;
            let channel = self
                .writer
                .add_channel(schema, topic, "json", &BTreeMap::new())?;
            self.channels.insert(topic.to_owned(), (channel, 0));
        }
        let Some((channel, count)) = self.channels.get_mut(topic) else {
            return Ok(());
        };
        let nanoseconds = at_us.saturating_mul(1_000);
        let header = MessageHeader {
            channel_id: *channel,
            sequence: u32::try_from(*count).unwrap_or(u32::MAX),
            log_time: nanoseconds,
            publish_time: nanoseconds,
        };
        *count += 1;
        let text = serde_json::to_vec(message).map_err(std::io::Error::from)?;
        self.writer.write_to_known_channel(&header, &text)
    }

    fn finish(mut self) -> Result<Written, ExportError> {
        self.writer.finish()?;
        self.writer.into_inner().flush().map_err(McapError::from)?;
        let channels = self.channels.into_iter();
        Ok(channels.map(|(topic, (_, count))| (topic, count)).collect())
    }
}

fn time(at_us: u64) -> Time {
    Time {
        sec: u32::try_from(at_us / 1_000_000).unwrap_or(u32::MAX),
        nsec: u32::try_from(at_us % 1_000_000 * 1_000).unwrap_or(0),
    }
}

fn state(timestamp: Time, robot: String, view: &View) -> schemas::State {
    let followers = view.followers.iter().map(|follower| schemas::Follower {
        station: follower.station.0,
        task: text(follower.task.as_ref()),
        progress: follower.progress.clone(),
        has_lease: follower.has_lease,
    });
    schemas::State {
        timestamp,
        robot,
        station: view.station.0,
        boot: view.boot,
        state: format!("{:?}", view.state),
        stage: match view.state {
            Stage::Idle => 1,
            Stage::HelpRequested => 2,
            Stage::RoleEstablished => 3,
            Stage::ManeuverExecuting => 4,
        },
        role: view.role.to_string(),
        session: text(view.session.as_ref()),
        executes: text(view.executes.as_ref()),
        followers: followers.collect(),
        corridor_open: view.corridor_open,
        place: view.place.clone(),
        duty: view.duty.clone(),
        availability: view.availability.clone(),
    }
}

/// Nothing is an empty text.
fn text(value: Option<&impl ToString>) -> String {
    value.map_or_else(String::new, ToString::to_string)
}

fn message(timestamp: Time, robot: String, message: Message) -> schemas::RobotMessage {
    let direction = match message.direction {
        Direction::Sent => "sent",
        Direction::Heard => "heard",
        Direction::Lost => "lost",
    };
    schemas::RobotMessage {
        timestamp,
        robot,
        direction: direction.to_owned(),
        kind: message.kind.to_owned(),
        from: message.from.0,
        text: message.text,
        why: message.why,
        octets: hex::encode(message.octets),
    }
}
