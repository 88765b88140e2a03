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
//! stop of its robot; that ends by the word of a person, and not by a body that connects again. So is a body that says
//! more than is taken in for as long: its last line would wait behind the others. A body that was lost stands still, also when it
//! connects again: what it was to do is over.

mod lines;

use std::fmt;
use std::time::Duration;

use crossguard_codec::RobotState;
use crossguard_endpoint::cause::Cause;
use crossguard_protocol::{FallbackPolicy, Maneuver, ManeuverId, TaskSet};

pub use self::lines::VERSION;
use self::lines::{At, FromBody, Start, ToBody, policy};
use super::{Body, BodyAct, Build, Fallback, NotTaken, Pose, Report, state_of};
use crate::port::{Heard, LINES, Listening, PortAddress, Stream, listen};
use crate::site::{Place, Site};

/// Farthest place that a body says, in metres.
const METRES_MAX: f64 = 1e5;

/// For how long a body is where it said that it is, in seconds.
const POSE_LASTS_S: f64 = 1.0;

/// Largest error of a pose, in metres.
const ERROR_MAX_M: f64 = 1_000.0;

/// How often the kit says something at least, in seconds.
const BEAT_S: f64 = 0.1;

/// How many lines are taken in at a time: as many as may wait.
const LINES_AT_A_TIME: usize = LINES;

/// How many characters of a text of the body are in a report.
const TEXT_CHARS: usize = 256;

/// How a body is reached.
#[derive(Clone, PartialEq, Debug)]
pub struct BodyPort {
    /// Where it connects.
    pub address: PortAddress,
    /// After how long without a line it is silent.
    pub silence: Duration,
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Presence {
    /// It never said hello.
    Absent,
    Here,
    Silent,
}

/// A body that is another process.
pub struct Ported {
    /// Name of its robot.
    robot: String,
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
    /// For how long more lines have waited than are taken in at a time, while any do.
    behind_s: Option<f64>,
    pose: Pose,
    known_s: f64,
    maneuver: Option<Maneuver>,
    /// The maneuver that it falls back from, and how far it is with that.
    fallback: Option<(ManeuverId, Fallback)>,
    reports: Vec<Report>,
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
    /// Opens the port of the body of this robot and build, which says that it is in position in the maneuvers of `holding`.
    ///
    /// # Errors
    /// When the operating system does not open the socket.
    pub fn open(
        robot: &str,
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
            robot: robot.to_owned(),
            build,
            site,
            listening: listen(&port.address)?,
            port,
            holding,
            stream: None,
            presence: Presence::Absent,
            silent_s: 0.0,
            beat_s: 0.0,
            behind_s: None,
            pose,
            known_s: 0.0,
            maneuver: None,
            fallback: None,
            reports: vec![Report::Absent],
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
            self.lose("the body does not take what it is told");
            NotTaken(error.to_string())
        })
    }

    /// Says a line to a body that is there. A failure is ignored: the body will know by the silence.
    fn mention(&mut self, what: &ToBody) {
        if self.presence == Presence::Here {
            let _ = self.say(what);
        }
    }

    /// The body is not there any more, for this reason.
    fn lose(&mut self, why: &str) {
        let Some((_, stream)) = self.stream.take() else {
            return;
        };
        stream.close();
        self.known_s = 0.0;
        if self.presence == Presence::Here {
            (self.presence, self.fallback) = (Presence::Silent, None);
            self.reports.push(Report::Silent(why.to_owned()));
        } else {
            self.misunderstand(format!("no hello: {why}"));
        }
    }

    /// Ends the connection of a body that is none of this robot.
    fn refuse(&mut self, why: &str) {
        let refused = ToBody::Refused {
            why: why.to_owned(),
        };
        // It is refused whether it hears that or not.
        let _ = self.say(&refused);
        self.lose(&in_a_line(why));
    }

    fn hear(&mut self, heard: Heard) {
        match heard {
            Heard::Connected(_, mut stream) if self.stream.is_some() => {
                let why = "another body is connected".to_owned();
                // A body that does not hear it sees that the connection ends.
                let _ = stream.say(&ToBody::Refused { why });
                stream.close();
                self.drop(Cause::BodiesFull, "another body wanted to connect: refused");
            }
            Heard::Connected(number, stream) => {
                (self.stream, self.silent_s) = (Some((number, stream)), 0.0);
                self.behind_s = None;
                let crossguard = VERSION;
                // One that is gone again is lost by that.
                let _ = self.say(&ToBody::Hello { crossguard });
            }
            Heard::Line(number, line) if self.is_current(number) => self.read(&line),
            Heard::Closed(number) if self.is_current(number) => {
                self.lose("the body closed its connection");
            }
            Heard::Unread(number, why) => {
                self.misunderstand(why);
                if self.is_current(number) {
                    self.lose(why);
                }
            }
            Heard::Line(..) => self.misunderstand("said on a connection that does not count"),
            Heard::Closed(_) => {}
            Heard::Stranger(uid) => {
                let who = format!("user {uid} is not the robot's: refused");
                self.drop(Cause::BodyStranger, who);
            }
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
                robot: Some(robot), ..
            } if robot != self.robot => {
                let own = &self.robot;
                self.refuse(&format!(
                    "this is the body port of {own}, and no body of {robot} is wanted"
                ));
            }
            FromBody::Hello {
                crossguard: VERSION,
                ..
            } => {
                let before = std::mem::replace(&mut self.presence, Presence::Here);
                if before != Presence::Here {
                    self.reports.push(Report::Here);
                }
                // It may not have noticed that it was lost.
                if before == Presence::Silent {
                    self.mention(&ToBody::Halt);
                }
            }
            FromBody::Hello { crossguard, .. } => {
                self.refuse(&format!("version {crossguard}: {VERSION} is spoken here"));
            }
            FromBody::Pose {
                east_m,
                north_m,
                error_m,
                heading_deg,
                speed_mps,
            } => {
                let is_on_site = [east_m, north_m].iter().all(|it| it.abs() <= METRES_MAX);
                let can_be = is_on_site
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
            FromBody::FallenBack { id } => match self.fallback {
                Some((of, _)) if of.to_string() == id => self.finish_fallback(),
                Some(_) => self.misunderstand(format!("fallback {id} is not the current one")),
                // The road was clear before its body was at the kerb.
                None => {}
            },
            FromBody::Fault { text } => self.reports.push(Report::Fault(in_a_line(&text))),
            FromBody::Beat => {}
        }
    }

    /// Takes in what it says of a maneuver, if that is the current one.
    fn report(&mut self, id: &str, report: fn(ManeuverId) -> Report) {
        match self.maneuver.filter(|it| it.id.to_string() == id) {
            Some(maneuver) => {
                let report = report(maneuver.id);
                // One that is repeated in a turn is no news.
                if !self.reports.contains(&report) {
                    self.reports.push(report);
                }
            }
            None => self.misunderstand(format!("maneuver {id} is not the current one")),
        }
    }

    fn misunderstand(&mut self, why: impl Into<String>) {
        self.drop(Cause::BodyGarbled, why);
    }

    /// Counts what is dropped: one report of each cause in a turn, however much is said.
    fn drop(&mut self, cause: Cause, what: impl Into<String>) {
        for report in &mut self.reports {
            if let Report::Dropped(its, _, count) = report
                && *its == cause
            {
                *count += 1;
                return;
            }
        }
        let what = in_a_line(&what.into());
        self.reports.push(Report::Dropped(cause, what, 1));
    }
}

/// The beginning of a text that may be the body's, with control characters spelled out: it must not look like a line
/// that the kit says.
fn in_a_line(text: &str) -> String {
    let mut shown = String::new();
    for char in text.chars().take(TEXT_CHARS) {
        if char.is_control() {
            shown.extend(char.escape_unicode());
        } else {
            shown.push(char);
        }
    }
    shown
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
                let begun = match how {
                    FallbackPolicy::HoldUntilClear => Fallback::Holding,
                    _ => Fallback::UnderWay,
                };
                let is_lost = self.presence == Presence::Silent;
                self.fallback = Some((maneuver.id, begun)).filter(|_| !is_lost);
                let id = maneuver.id.to_string();
                let policy = policy(how);
                ToBody::FallBack { id, policy }
            }
            BodyAct::Wait => ToBody::Wait,
            BodyAct::GoOn => ToBody::GoOn,
        };
        match (self.presence, act) {
            // Its silence was told; it stands still by itself, as it hears nothing either.
            (Presence::Silent, BodyAct::Stop(..) | BodyAct::FallBack(..) | BodyAct::Wait) => Ok(()),
            _ => self.say(&line),
        }
    }

    fn advance(&mut self, seconds: f64) -> Vec<Report> {
        self.known_s = (self.known_s - seconds).max(0.0);
        self.silent_s += seconds;
        self.beat_s += seconds;
        let silence_s = self.port.silence.as_secs_f64();
        // The robot was held, and with it what it says. The body stands still by its own rule, and may not say so.
        if self.presence == Presence::Here && self.beat_s > silence_s {
            self.lose("the body was told nothing, so it stands still");
        }
        let heard = self.listening.heard.try_iter().take(LINES_AT_A_TIME);
        let heard: Vec<_> = heard.collect();
        // The time before the first of these turns is not the body's: the robot may have been suspended.
        let behind_s = self.behind_s.map_or(0.0, |it| it + seconds);
        self.behind_s = (heard.len() == LINES_AT_A_TIME).then_some(behind_s);
        for heard in heard {
            self.hear(heard);
        }
        if self.stream.is_some() && self.silent_s > silence_s {
            self.lose("nothing was heard of the body");
        }
        if self.behind_s.is_some_and(|it| it > silence_s) {
            self.lose("the body says more than is taken in");
        }
        if self.beat_s >= BEAT_S {
            self.beat_s = 0.0;
            self.mention(&ToBody::Beat);
        }
        std::mem::take(&mut self.reports)
    }

    fn state(&self) -> RobotState {
        state_of(self.build, &self.site, self.known(), None)
    }

    fn place(&self) -> Place {
        self.pose.place
    }

    fn fallback(&self) -> Option<Fallback> {
        self.fallback.map(|(_, it)| it)
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
        if let Some((_, it @ Fallback::UnderWay)) = &mut self.fallback {
            *it = Fallback::Finished;
        }
    }

    fn walks_back(&self) -> bool {
        self.presence == Presence::Here && self.fallback() == Some(Fallback::UnderWay)
    }

    fn walk_to(&mut self, place: Place, heading_deg: Option<f64>) {
        let to = At::of(&self.site, place);
        self.mention(&ToBody::Go { to, heading_deg });
    }
}

#[cfg(test)]
mod tests;
