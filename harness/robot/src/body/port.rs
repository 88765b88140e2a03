//! The body port: a body that is another process, by lines on a socket. The lines are on the page
//! `harness/doc/body-port.md`.
//!
//! ```text
//!   absent ──── hello ────► here ──── nothing heard, or closed ────► silent
//!                            ▲                                          │
//!                            └──────────────── hello ───────────────────┘
//! ```
//!
//! The body sends at least a line in each `silence`, and so does the kit. A body that falls silent is an emergency
//! stop of its robot; that ends by the word of a person, and not by a body that connects again.

mod lines;

use std::collections::VecDeque;
use std::fmt;
use std::time::Duration;

use crossguard_codec::RobotState;
use crossguard_protocol::{FallbackPolicy, Maneuver, TaskSet};

pub use self::lines::VERSION;
use self::lines::{At, FromBody, Start, ToBody, policy};
use super::{Body, BodyAct, Build, Fallback, NotTaken, Pose, Report, state_of};
use crate::located::is_on_site;
use crate::port::{Heard, Listening, PortAddress, Stream, listen};
use crate::site::{Place, Site};

/// For how long a body is where it said that it is, in seconds.
const POSE_LASTS_S: f64 = 1.0;

/// Largest error of a pose, in metres.
const ERROR_MAX_M: f64 = 1_000.0;

/// How often the kit says something at least, in seconds.
const BEAT_S: f64 = 0.1;

/// How many lines are taken in at a time.
const LINES_AT_A_TIME: usize = 64;

/// How a body is reached.
#[derive(Clone, PartialEq, Debug)]
pub struct BodyPort {
    /// Where it connects.
    pub address: PortAddress,
    /// After how long without a line it is silent.
    pub silence: Duration,
    /// How near to a place it stands there, in metres.
    pub stands_m: f64,
}

/// Whether the body is there.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Presence {
    /// It never said hello.
    Absent,
    Here,
    Silent,
}

/// A body that is another process.
pub struct Ported {
    build: Build,
    site: Site,
    port: BodyPort,
    /// The maneuvers in which it says that it is in position.
    holding: TaskSet,
    listening: Listening,
    /// The connection that counts, with its number.
    stream: Option<(u64, Stream)>,
    presence: Presence,
    /// Since when nothing was heard, and nothing was said, in seconds.
    silent_s: f64,
    beat_s: f64,
    pose: Pose,
    known_s: f64,
    maneuver: Option<Maneuver>,
    fallback: Option<Fallback>,
    reports: VecDeque<Report>,
}

impl fmt::Debug for Ported {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Ported")
            .field("address", &self.port.address)
            .field("presence", &self.presence)
            .field("pose", &self.known())
            .finish_non_exhaustive()
    }
}

impl Ported {
    /// Opens the port of a body of this build, which says that it is in position in the maneuvers of `holding`.
    ///
    /// # Errors
    /// When the operating system does not open the socket.
    pub fn open(
        build: Build,
        site: Site,
        place: Place,
        port: BodyPort,
        holding: TaskSet,
    ) -> std::io::Result<Self> {
        let pose = Pose {
            place,
            error_m: None,
            heading_deg: None,
            speed_mps: None,
        };
        Ok(Self {
            build,
            site,
            listening: listen(&port.address)?,
            port,
            holding,
            stream: None,
            presence: Presence::Absent,
            silent_s: 0.0,
            beat_s: 0.0,
            pose,
            known_s: 0.0,
            maneuver: None,
            fallback: None,
            reports: VecDeque::from([Report::Absent]),
        })
    }

    fn known(&self) -> Option<Pose> {
        (self.known_s > 0.0).then_some(self.pose)
    }

    /// Says a line; a body that does not take it is lost.
    fn say(&mut self, what: &ToBody) -> Result<(), NotTaken> {
        let nobody = || NotTaken("no body is connected".to_owned());
        let (_, stream) = self.stream.as_mut().ok_or_else(nobody)?;
        let said = stream.say(what);
        said.map_err(|error| {
            self.lose();
            NotTaken(error.to_string())
        })
    }

    /// Nobody hears what is said here: the body will know by the silence.
    fn mention(&mut self, what: &ToBody) {
        if self.presence == Presence::Here {
            let _ = self.say(what);
        }
    }

    /// The body is not there any more.
    fn lose(&mut self) {
        if let Some((_, stream)) = self.stream.take() {
            stream.close();
        }
        self.known_s = 0.0;
        if self.presence == Presence::Here {
            self.presence = Presence::Silent;
            self.reports.push_back(Report::Silent);
        }
    }

    fn hear(&mut self, heard: Heard) {
        match heard {
            Heard::Connected(_, mut stream) if self.stream.is_some() => {
                let why = "another body is connected".to_owned();
                // Who does not hear it sees that the connection ends.
                let _ = stream.say(&ToBody::Refused { why });
                stream.close();
            }
            Heard::Connected(number, stream) => {
                (self.stream, self.silent_s) = (Some((number, stream)), 0.0);
                let crossguard = VERSION;
                // One that is gone again is lost by that.
                let _ = self.say(&ToBody::Hello { crossguard });
            }
            Heard::Line(number, line) if self.is_current(number) => self.read(&line),
            Heard::Closed(number) if self.is_current(number) => self.lose(),
            Heard::Line(..) | Heard::Closed(_) => {}
            Heard::Stranger(uid) => self.reports.push_back(Report::Stranger(uid)),
        }
    }

    fn is_current(&self, number: u64) -> bool {
        let current = self.stream.as_ref();
        current.is_some_and(|(current, _)| *current == number)
    }

    fn read(&mut self, line: &str) {
        let line: FromBody = match serde_json::from_str(line) {
            Ok(line) => line,
            Err(error) => return self.misunderstand(error.to_string()),
        };
        if self.presence != Presence::Here && !matches!(line, FromBody::Hello { .. }) {
            return self.misunderstand("said before its hello");
        }
        self.silent_s = 0.0;
        match line {
            FromBody::Hello {
                crossguard: VERSION,
            } => {
                if self.presence != Presence::Here {
                    self.presence = Presence::Here;
                    self.reports.push_back(Report::Here);
                }
            }
            FromBody::Hello { crossguard } => {
                let why = format!("version {crossguard}: {VERSION} is spoken here");
                self.misunderstand(why.clone());
                // It is refused whether it hears that or not.
                let _ = self.say(&ToBody::Refused { why });
                self.lose();
            }
            FromBody::Pose {
                east_m,
                north_m,
                error_m,
                heading_deg,
                speed_mps,
            } => {
                let can_be = is_on_site([east_m, north_m])
                    && error_m.is_none_or(|it| it > 0.0 && it <= ERROR_MAX_M)
                    && heading_deg.is_none_or(f64::is_finite)
                    && speed_mps.is_none_or(f64::is_finite);
                if !can_be {
                    return self.misunderstand("a pose that cannot be");
                }
                self.pose = Pose {
                    place: Place::new(east_m, north_m),
                    error_m,
                    heading_deg: heading_deg.map(|it| it.rem_euclid(360.0)),
                    // A speed has no direction. What is below 0 does not say how fast the body moves.
                    speed_mps: speed_mps.filter(|it| *it >= 0.0),
                };
                self.known_s = POSE_LASTS_S;
            }
            FromBody::InPosition { id } => self.report(&id, Report::InPosition),
            FromBody::Completed { id } => self.report(&id, Report::Completed),
            FromBody::Failed { id } => self.report(&id, Report::Failed),
            FromBody::FallenBack => self.finish_fallback(),
            FromBody::Fault { text } => self.reports.push_back(Report::Fault(text)),
            FromBody::Beat => {}
        }
    }

    /// Takes in what it says of a maneuver, if that is the current one.
    fn report(&mut self, id: &str, report: fn(crossguard_protocol::ManeuverId) -> Report) {
        match self.maneuver.filter(|it| it.id.to_string() == id) {
            Some(maneuver) => self.reports.push_back(report(maneuver.id)),
            None => self.misunderstand(format!("maneuver {id} is not the current one")),
        }
    }

    fn misunderstand(&mut self, why: impl Into<String>) {
        self.reports.push_back(Report::Garbled(why.into()));
    }
}

impl Body for Ported {
    fn act(&mut self, act: BodyAct) -> Result<(), NotTaken> {
        let line = match act {
            BodyAct::Start(maneuver, parameters) => {
                (self.maneuver, self.fallback) = (Some(maneuver), None);
                let holds = self.holding.contains(maneuver.task);
                ToBody::Start(Start::new(maneuver, &parameters, &self.site, holds))
            }
            BodyAct::Stop(maneuver, why) => {
                (self.maneuver, self.fallback) = (None, None);
                let (id, why) = (maneuver.id.to_string(), why.to_string());
                ToBody::Stop { id, why }
            }
            BodyAct::FallBack(maneuver, how) => {
                self.maneuver = None;
                self.fallback = Some(match how {
                    FallbackPolicy::HoldUntilClear => Fallback::Holding,
                    _ => Fallback::UnderWay,
                });
                let id = maneuver.id.to_string();
                let policy = policy(how);
                ToBody::FallBack { id, policy }
            }
            BodyAct::Wait => ToBody::Wait,
            BodyAct::GoOn => ToBody::GoOn,
        };
        match (self.presence, act) {
            // That it is silent was told; it stands still by itself, as it hears nothing either.
            (Presence::Silent, BodyAct::Stop(..) | BodyAct::FallBack(..) | BodyAct::Wait) => Ok(()),
            _ => self.say(&line),
        }
    }

    fn advance(&mut self, seconds: f64) -> Option<Report> {
        self.known_s = (self.known_s - seconds).max(0.0);
        self.silent_s += seconds;
        self.beat_s += seconds;
        for _ in 0..LINES_AT_A_TIME {
            let Ok(heard) = self.listening.heard.try_recv() else {
                break;
            };
            self.hear(heard);
        }
        if self.stream.is_some() && self.silent_s > self.port.silence.as_secs_f64() {
            self.lose();
        }
        if self.beat_s >= BEAT_S {
            self.beat_s = 0.0;
            self.mention(&ToBody::Beat);
        }
        self.reports.pop_front()
    }

    fn state(&self) -> RobotState {
        state_of(self.build, &self.site, self.known(), None)
    }

    fn place(&self) -> Place {
        self.pose.place
    }

    fn stands_at(&self, place: Place) -> bool {
        let is_there = |pose: Pose| pose.place.distance(place) <= self.port.stands_m;
        self.known().is_some_and(is_there)
    }

    fn fallback(&self) -> Option<Fallback> {
        self.fallback
    }

    fn release(&mut self) {
        self.fallback = None;
        self.mention(&ToBody::Release);
    }

    fn halt(&mut self) {
        (self.maneuver, self.fallback) = (None, None);
        self.mention(&ToBody::Halt);
    }

    fn finish_fallback(&mut self) {
        if self.fallback == Some(Fallback::UnderWay) {
            self.fallback = Some(Fallback::Finished);
        }
    }

    fn walk_to(&mut self, place: Place, heading_deg: Option<f64>) {
        let to = At::of(&self.site, place);
        self.mention(&ToBody::Go { to, heading_deg });
    }
}

#[cfg(test)]
mod tests;
