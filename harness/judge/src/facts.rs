//! Facts from logs: states, places, messages, the corridor, drops.
//!
//! ```text
//!   records ──► Observer ──► facts ──┬──► JSON lines (for tools: `crossguard export --facts`)
//!                                    └──► playback (for people)
//! ```
//!
//! A log holds inputs, outputs, states and octets. Tools want to know where a robot is and what it
//! does; both are worked out here, once, and from the log alone.

mod area;
mod cluster;
mod view;

pub use area::Area;
pub use cluster::ClusterView;
pub use view::{FollowerView, View};

use std::fmt::Display;

use area::Areas;
use crossguard_codec::its::ItsMessage;
use crossguard_codec::{ConfidenceEllipse, Dimensions, Heard, Identifiers, RobotState, Service};
use crossguard_endpoint::cause::{Cause, Layer};
use crossguard_endpoint::counters::{CauseName, Counts};
use crossguard_endpoint::station::listen::{message_of, overhear};
use crossguard_endpoint::station::service_of;
use crossguard_protocol::{Input, Output, Outputs, Robot, StationId};
use crossguard_robot::around::Around;
use crossguard_robot::sight::{Degrees, Outline, Sight};
use crossguard_robot::trace::{Entry, Record};
use serde::{Serialize, Serializer};

use crate::chart::{Chart, text_of};
use crate::sniffer::place;

/// Something that a record tells about its robot.
#[derive(Clone, PartialEq, Debug, Serialize)]
#[serde(
    tag = "fact",
    content = "of",
    rename_all = "camelCase",
    rename_all_fields = "camelCase"
)]
pub enum Fact {
    /// It booted.
    Started {
        /// Its station id.
        station: StationId,
        /// Its boot counter.
        boot: u16,
    },
    /// Its part in a session has changed.
    State(View),
    /// Where it says that it is.
    Place(Box<Placed>),
    /// A step of the transition function, other than one in which nothing but time has passed.
    Step {
        /// Input of the step.
        input: String,
        /// Outputs of the step, in order.
        outputs: Vec<String>,
    },
    /// A message that it sent, heard, or should have heard.
    Message(Message),
    /// Note for a person who follows the run.
    Note {
        /// Whether something went wrong.
        is_warning: bool,
        /// Its text.
        text: String,
    },
    /// It lets the pedestrian cross, or no longer does.
    Corridor {
        /// Whether the corridor is open.
        is_open: bool,
        /// When that began, in microseconds on the log's clock: before the record, where the sign ended by
        /// itself because nothing renewed it.
        since_us: u64,
        /// Why it was closed; empty where it was opened.
        why: String,
    },
    /// Places that its followers hold or go to, all of them: there are new ones, or none any more.
    Areas(Vec<Area>),
    /// It watches this crossing zone.
    Zone(Outline),
    /// Its sensors have these people now, and no others.
    People(Sight),
    /// These road users are on its map now, and no others.
    Around(Around),
    /// Its RAM announces this cluster of people, or none any more.
    Cluster(Option<ClusterView>),
    /// One more was dropped or ignored.
    Counted {
        /// The cause that it is counted under.
        #[serde(flatten)]
        cause: CauseName,
        /// How often by now.
        count: u64,
    },
    /// It stopped in order.
    Stopped,
}

/// Where a robot is, by its own RAM.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Placed {
    /// Degrees, north positive.
    pub latitude: f64,
    /// Degrees, east positive.
    pub longitude: f64,
    /// Metres above the WGS84 ellipsoid, if known.
    pub altitude: Option<f64>,
    /// Where it is with a confidence of 95 %, if known.
    pub ellipse: Option<ConfidenceEllipse>,
    /// Direction of motion in degrees clockwise from north, if known.
    pub heading: Option<f64>,
    /// Speed in m/s, if known.
    pub speed: Option<f64>,
    /// The box around it.
    pub dimensions: Dimensions,
}

impl Placed {
    pub(crate) const fn degrees(&self) -> Degrees {
        (self.latitude, self.longitude)
    }

    fn of(state: &RobotState) -> Option<Box<Self>> {
        let position = &state.position;
        Some(Box::new(Self {
            latitude: position.latitude?,
            longitude: position.longitude?,
            altitude: position.altitude,
            ellipse: position.ellipse,
            heading: state.heading.map(|heading| heading.value),
            speed: state.speed.map(|speed| speed.value),
            dimensions: state.dimensions,
        }))
    }
}

/// Fate of a message at a robot.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub enum Direction {
    /// It sent it.
    Sent,
    /// It heard it.
    Heard,
    /// The fault layer kept it from the robot.
    Lost,
}

/// A message at a robot.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Message {
    /// Its fate.
    pub direction: Direction,
    /// Its name: `RAM`, `RMCM`, or that of a message of ETSI.
    pub kind: &'static str,
    /// The station that sent it.
    pub from: StationId,
    /// Its content, in a few words.
    pub text: String,
    /// Why it was sent, or how it was lost; empty where it was heard.
    pub why: String,
    /// The message.
    #[serde(with = "hex::serde")]
    pub octets: Vec<u8>,
}

/// As people write it.
pub(crate) fn shown<S: Serializer>(value: &impl Display, to: S) -> Result<S::Ok, S::Error> {
    to.collect_str(value)
}

/// The same; nothing is an empty text.
#[expect(clippy::ref_option, reason = "serde gives it so")]
pub(crate) fn shown_if_any<S: Serializer>(
    value: &Option<impl Display>,
    to: S,
) -> Result<S::Ok, S::Error> {
    match value {
        Some(value) => to.collect_str(value),
        None => to.serialize_str(""),
    }
}

/// State of a robot, as far as its records tell.
#[derive(Debug, Default)]
struct Observed {
    name: String,
    identifiers: Identifiers,
    view: Option<View>,
    /// Until when its sign shows go, if it does.
    go_until_us: Option<u64>,
    /// Whether its newest RAM announces a cluster.
    has_cluster: bool,
    counters: Counts,
}

/// Works out facts from records, as they come.
#[derive(Debug)]
pub struct Observer {
    chart: Chart,
    robots: Vec<Observed>,
    areas: Areas,
}

impl Default for Observer {
    fn default() -> Self {
        Self {
            chart: Chart::growing().with_short_ids(),
            robots: Vec::new(),
            areas: Areas::default(),
        }
    }
}

impl Observer {
    /// The facts that a record adds, in order.
    pub fn take(&mut self, record: &Record) -> Vec<Fact> {
        let known = self.robots.iter().position(|it| it.name == record.robot);
        let robot = known.unwrap_or_else(|| {
            self.robots.push(Observed {
                name: record.robot.clone(),
                ..Observed::default()
            });
            self.robots.len() - 1
        });
        let mut facts: Vec<_> = self
            .sign_that_ended(robot, record.at_us)
            .into_iter()
            .collect();
        facts.extend(self.facts(robot, record.at_us, &record.entry));
        facts.extend(self.notes(record));
        facts
    }

    /// The sign of a robot that went to stop by itself before `at_us`.
    fn sign_that_ended(&mut self, robot: usize, at_us: u64) -> Option<Fact> {
        let go_until_us = &mut self.robots[robot].go_until_us;
        let since_us = go_until_us.filter(|go_until_us| *go_until_us < at_us)?;
        *go_until_us = None;
        let why = "the sign ended by itself, since nothing renewed it";
        Some(corridor(false, since_us, why))
    }

    /// Facts about the sign, from the outputs of a step.
    fn sign(&mut self, robot: usize, at_us: u64, outputs: &Outputs) -> Vec<Fact> {
        let go_until_us = &mut self.robots[robot].go_until_us;
        let mut facts = Vec::new();
        for output in outputs.iter() {
            match output {
                Output::CorridorOpened(time) | Output::CorridorExtended(time) => {
                    if go_until_us.is_none() {
                        facts.push(corridor(true, at_us, ""));
                    }
                    let time_us = u64::from(time.0) * 1_000;
                    *go_until_us = Some(at_us.saturating_add(time_us));
                }
                Output::CorridorClosed(why) if go_until_us.take().is_some() => {
                    facts.push(corridor(false, at_us, why.to_string()));
                }
                _ => {}
            }
        }
        facts
    }

    fn facts(&mut self, robot: usize, at_us: u64, entry: &Entry) -> Vec<Fact> {
        match entry {
            Entry::Started {
                station,
                boot,
                epoch,
                settings,
                identifiers,
                ..
            } => {
                let observed = &mut self.robots[robot];
                observed.identifiers = *identifiers;
                observed.counters = Counts::default();
                let mut facts = vec![Fact::Started {
                    station: *station,
                    boot: *boot,
                }];
                // A robot that lost power says nothing of what it had a part in.
                if observed.go_until_us.take().is_some() {
                    facts.push(corridor(false, at_us, ""));
                }
                let epoch = epoch.unwrap_or(*boot);
                facts.extend(self.view(robot, &Robot::new(*station, epoch)));
                self.areas.guarding(*station, settings.guarding);
                facts
            }
            Entry::Step {
                input,
                outputs,
                state,
            } => self.step(robot, at_us, input, outputs, state),
            Entry::Sent {
                message,
                trigger,
                octets,
            } => {
                let me = self.robots[robot].view.as_ref().map(|view| view.station);
                let known = (*message, me.unwrap_or(StationId(0)));
                self.sent(robot, &format!("{trigger:?}"), known, octets)
            }
            Entry::Heard {
                message,
                from,
                octets,
                ..
            } => {
                let read = self.message(robot, Direction::Heard, String::new(), octets);
                let message = read.map_or_else(
                    || unread(Direction::Heard, String::new(), (*message, *from), octets),
                    |(_, message)| message,
                );
                vec![Fact::Message(message)]
            }
            Entry::Dropped { cause, octets, .. } => {
                let lost = if cause.layer == Layer::Simulated {
                    self.message(robot, Direction::Lost, cause.to_string(), octets)
                } else {
                    None
                };
                let mut facts: Vec<_> = lost
                    .map(|(_, message)| Fact::Message(message))
                    .into_iter()
                    .collect();
                facts.push(self.count(robot, cause.clone(), 1));
                facts
            }
            Entry::Unrecorded { counters } => counters
                .iter()
                .map(|(cause, count)| self.count(robot, cause, count))
                .collect(),
            Entry::Channel(_) | Entry::Clock(_) | Entry::Hindered { .. } => Vec::new(),
            Entry::Zone(outline) => vec![Fact::Zone(outline.clone())],
            Entry::People(sight) => vec![Fact::People(sight.clone())],
            Entry::Around(around) => vec![Fact::Around(around.clone())],
            Entry::Stopped { counters } => {
                let observed = &mut self.robots[robot];
                let silent = counters.iter();
                let silent = silent.filter(|(cause, count)| observed.counters.of(cause) != *count);
                let mut facts: Vec<_> = silent
                    .map(|(cause, count)| Fact::Counted { cause, count })
                    .collect();
                observed.counters.clone_from(counters);
                facts.push(Fact::Stopped);
                facts
            }
        }
    }

    fn step(
        &mut self,
        robot: usize,
        at_us: u64,
        input: &Input,
        outputs: &Outputs,
        state: &Robot,
    ) -> Vec<Fact> {
        let mut facts = Vec::new();
        if !matches!(input, Input::Elapsed(_)) || !outputs.is_empty() {
            facts.push(Fact::Step {
                input: input.to_string(),
                outputs: outputs.iter().map(ToString::to_string).collect(),
            });
        }
        if let Some(reason) = outputs.ignored() {
            facts.push(self.count(robot, Cause::from(reason).into(), 1));
        }
        facts.extend(self.sign(robot, at_us, outputs));
        facts.extend(self.view(robot, state));
        facts
    }

    /// Facts about the robot's part in a session, where it is new.
    fn view(&mut self, robot: usize, state: &Robot) -> Vec<Fact> {
        let (view, observed) = (View::of(state), &mut self.robots[robot]);
        if observed.view.as_ref() == Some(&view) {
            return Vec::new();
        }
        let before = observed.view.replace(view.clone());
        let mut facts = Vec::new();
        let is_over = |before: &View| before.session != view.session;
        if let Some(before) = &before
            && is_over(before)
            && self.areas.leave(before.station)
        {
            facts.push(Fact::Areas(Vec::new()));
        }
        facts.push(Fact::State(view));
        facts
    }

    fn sent(
        &mut self,
        robot: usize,
        trigger: &str,
        known: (Service, StationId),
        octets: &[u8],
    ) -> Vec<Fact> {
        let sent = self.message(robot, Direction::Sent, trigger.to_owned(), octets);
        let Some((heard, message)) = sent else {
            let message = unread(Direction::Sent, trigger.to_owned(), known, octets);
            return vec![Fact::Message(message)];
        };
        let mut facts = vec![Fact::Message(message)];
        let Some(heard) = heard else { return facts };
        if let Some(placed) = heard.state.as_ref().and_then(Placed::of) {
            self.areas.place(heard.from, &placed);
            facts.push(Fact::Place(placed));
        }
        let cluster = ClusterView::of(&heard);
        let observed = &mut self.robots[robot];
        if heard.service == Service::Ram && (cluster.is_some() || observed.has_cluster) {
            observed.has_cluster = cluster.is_some();
            facts.push(Fact::Cluster(cluster));
        }
        let identifiers = self.robots[robot].identifiers;
        if let Some(areas) = self.areas.command(&identifiers, &heard, octets) {
            facts.push(Fact::Areas(areas));
        }
        facts
    }

    fn message(
        &self,
        robot: usize,
        direction: Direction,
        why: String,
        octets: &[u8],
    ) -> Option<(Option<Heard>, Message)> {
        let (identifiers, octets) = (&self.robots[robot].identifiers, message_of(octets));
        let heard = overhear(identifiers, octets).ok();
        let (service, from, text) = match &heard {
            Some(heard) => (heard.service, heard.from, text_of(heard)),
            None => of_etsi(identifiers, octets)?,
        };
        let message = Message {
            direction,
            kind: service.name(),
            from,
            text,
            why,
            octets: octets.to_vec(),
        };
        Some((heard, message))
    }

    fn count(&mut self, robot: usize, cause: CauseName, count: u64) -> Fact {
        let count = self.robots[robot].counters.add(&cause, count);
        Fact::Counted { cause, count }
    }

    /// The notes that the sequence chart has at this robot.
    fn notes(&mut self, record: &Record) -> impl Iterator<Item = Fact> {
        let is_warning = matches!(
            record.entry,
            Entry::Dropped { .. } | Entry::Unrecorded { .. }
        );
        let notes = self.chart.notes(record).into_iter();
        notes.map(move |text| Fact::Note { is_warning, text })
    }
}

fn corridor(is_open: bool, since_us: u64, why: impl Into<String>) -> Fact {
    let why = why.into();
    Fact::Corridor {
        is_open,
        since_us,
        why,
    }
}

/// A message that the robot understood, and that cannot be read here: what its record says of it.
fn unread(
    direction: Direction,
    why: String,
    (service, from): (Service, StationId),
    octets: &[u8],
) -> Message {
    Message {
        direction,
        kind: service.name(),
        from,
        text: "not readable with the log's identifiers".to_owned(),
        why,
        octets: octets.to_vec(),
    }
}

/// Content of a CAM or VAM: its service, its sender, and the sender's place.
fn of_etsi(identifiers: &Identifiers, octets: &[u8]) -> Option<(Service, StationId, String)> {
    let message = ItsMessage::decode(identifiers, octets).ok()?.message;
    let service = service_of(&message).filter(|it| !matches!(it, Service::Ram | Service::Rmcm))?;
    let users = message.road_users(0);
    let text = users.first().map(place).unwrap_or_default();
    Some((service, StationId(message.header().station_id.0), text))
}
