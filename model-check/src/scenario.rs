//! Scenarios: which robots, which faults, how often what may happen, what must hold.
//!
//! A scenario is a TOML file. The shipped ones are in `scenarios/`; a user can write another without
//! touching code. An unknown key, an impossible bound or an unknown property is an error that names
//! the line.

use std::fmt;
use std::hash::{Hash, Hasher};
use std::path::{Path, PathBuf};

use crossguard_protocol::{
    Availability, BrokenInequality, Config, Event, HelpRequest, Inequality, MAX_FOLLOWERS,
    Settings, StationId, TaskSet, TaskType, Urgency,
};
use serde::{Deserialize, Serialize};

use crate::network::MAX_DELAYED;
use crate::properties::PropertyId;
use crate::symmetry::{Asymmetry, Claim, Wrong};
use crate::timed::{Section, Timed, TimedImpossibility, TimedProperty};

/// How many robots a scenario may have.
pub const MAX_ROBOTS: usize = 4;

/// How many robots a cooperative scenario may have.
const MAX_COOPERATIVE_ROBOTS: usize = 3;

/// By how much a robot's station id grows when it changes its pseudonym.
pub(crate) const PSEUDONYM_STEP: u32 = 100;

/// A scenario, checked.
#[derive(Clone, Debug)]
pub struct Scenario {
    /// Its name.
    pub name: String,
    /// What it is about, in one line.
    pub summary: String,
    /// The robots, in the order of the file.
    pub robots: Vec<RobotSetup>,
    /// The station ids of the robots of which it does not matter which is which: states that differ in
    /// that alone count as one.
    pub symmetric: Vec<StationId>,
    /// What a robot that detects a pedestrian asks for.
    pub request: HelpRequest,
    /// How often what may happen in one run.
    pub bounds: Bounds,
    /// Whether a leader's application opens and closes the corridor, as often as it likes.
    pub corridor: bool,
    /// What the radio channel does.
    pub channel: Channel,
    /// Whether everything around the robots does its part, which L3 assumes: an RMCM arrives, of the
    /// RAM that are sent again and again some arrive, no timer that guards against silence runs out,
    /// and applications command, finish, and end the task once it is completed.
    pub cooperative: bool,
    /// The configuration of every robot.
    pub config: Config,
    /// The properties to check; none where the scenario is timed.
    pub properties: Vec<PropertyId>,
    /// What makes it a timed scenario, with the properties to check then.
    pub timed: Option<Timed>,
    /// What an exploration must find, where the file says so.
    pub expected: Option<Size>,
}

/// The size of a state space.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Size {
    /// Distinct states.
    pub unique_states: usize,
    /// Steps from the initial state to the farthest state.
    pub depth: usize,
}

/// One robot of a scenario.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RobotSetup {
    /// Its station id.
    pub station: StationId,
    /// Whether it may detect a pedestrian.
    #[serde(default)]
    pub detects: bool,
}

/// How often each kind of event may happen in one run, over all robots together; never where a file
/// says nothing.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Bounds {
    /// A pedestrian is detected.
    pub detections: u8,
    /// A leader's application gives a command.
    pub commands: u8,
    /// An application's disturbance: a maneuver fails, a robot leaves, becomes
    /// unavailable, or changes its pseudonym. To become available again costs nothing.
    pub disturbances: u8,
    /// A robot crashes.
    pub crashes: u8,
    /// A crashed robot boots again.
    pub restarts: u8,
    /// A message gets lost on its way to one receiver; any number of times where nothing is said.
    pub losses: Option<u8>,
}

impl Bounds {
    /// Takes an event off what may still happen.
    pub(crate) fn spend(&mut self, event: Event) {
        let bound = match event {
            Event::PedestrianDetected(_) => &mut self.detections,
            Event::CommandManeuver { .. } => &mut self.commands,
            Event::ManeuverFailed(_)
            | Event::LeaveRequested
            | Event::AvailabilityChanged(Availability::Unavailable(_))
            | Event::IdentityChanged(_) => &mut self.disturbances,
            Event::ManeuverCompleted(_)
            | Event::TaskCompleted
            | Event::AvailabilityChanged(Availability::Available)
            | Event::OpenCorridor
            | Event::CloseCorridor => return,
        };
        *bound -= 1;
    }
}

/// What the radio channel does.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Channel {
    /// How many messages may be delayed at a time; each may arrive late, in any order, more than
    /// once, or never. A timed scenario bounds for how long instead.
    #[serde(default)]
    pub delayed: u8,
    /// Whether a message may get lost on its way to one receiver and reach another.
    pub loss: bool,
}

/// The file's form of a scenario.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    name: String,
    summary: String,
    robots: Vec<RobotSetup>,
    #[serde(default)]
    symmetric: Vec<toml::Spanned<StationId>>,
    request: Request,
    bounds: Bounds,
    #[serde(default)]
    corridor: bool,
    #[serde(default)]
    cooperative: bool,
    channel: Channel,
    #[serde(default)]
    protocol: Settings,
    timed: Option<Section>,
    properties: Vec<toml::Spanned<String>>,
    expected: Option<Size>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Request {
    #[serde(default)]
    urgency: Urgency,
    followers: toml::Spanned<u8>,
    tasks: Vec<toml::Spanned<String>>,
}

/// Why a scenario cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum ScenarioError {
    /// There is neither a shipped scenario nor a file of that name.
    #[error(
        "no scenario '{name}': the shipped ones are {shipped}, anything else is read as a file"
    )]
    Unknown {
        /// What was asked for.
        name: String,
        /// The names of those that are shipped.
        shipped: String,
    },
    /// The file cannot be read.
    #[error("{}: {cause}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// Why.
        cause: std::io::Error,
    },
    /// The text is no scenario.
    #[error("{file}: {cause}")]
    Syntax {
        /// The file or shipped scenario.
        file: String,
        /// What and where.
        cause: toml::de::Error,
    },
    /// The text is a scenario that makes no sense.
    #[error("{file}:{line}: {cause}")]
    Impossible {
        /// The file or shipped scenario.
        file: String,
        /// The line, counted from 1.
        line: usize,
        /// What is wrong.
        cause: Impossibility,
    },
}

/// What is wrong with a scenario.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Impossibility {
    /// Too few or too many robots.
    #[error("{0} robots: between 2 and {MAX_ROBOTS} are possible")]
    Robots(usize),
    /// Two robots with the same station id.
    #[error("two robots have station id {0}")]
    SameStation(StationId),
    /// Nobody can start.
    #[error("no robot has 'detects = true', so nothing would ever happen")]
    NobodyDetects,
    /// The request cannot be met.
    #[error("a request for {0} followers: between 1 and {MAX_FOLLOWERS} are possible")]
    Followers(u8),
    /// An unknown task.
    #[error("no task '{0}': initialPos, move, block, or task3 to task15")]
    Task(String),
    /// Too many messages delayed.
    #[error("{0} messages delayed at a time: at most {MAX_DELAYED} are possible")]
    Delayed(u8),
    /// Too many robots to tell all their messages apart.
    #[error("{0} robots in a cooperative scenario: at most {MAX_COOPERATIVE_ROBOTS} are possible")]
    Cooperative(usize),
    /// Two robots whose pseudonyms could not be told apart.
    #[error("station ids {0} and {1} must not differ by a multiple of {PSEUDONYM_STEP}")]
    SamePseudonyms(StationId, StationId),
    /// A property that assumes what the scenario does not.
    #[error("L3 speaks about cooperative scenarios only; this one lacks 'cooperative = true'")]
    NotCooperative,
    /// Robots that are not symmetric.
    #[error(transparent)]
    Asymmetry(#[from] Asymmetry),
    /// An unknown property.
    #[error("no property '{0}': {list}", list = PropertyId::list())]
    Property(String),
    /// The protocol's settings contradict each other.
    #[error(transparent)]
    Settings(#[from] BrokenInequality),
    /// What is wrong with the time of a timed scenario.
    #[error(transparent)]
    Timed(#[from] TimedImpossibility),
}

/// The scenarios that come with the kit; those that take seconds first, then those that take minutes.
const SHIPPED: [(&str, &str); 14] = [
    ("pair", include_str!("../scenarios/pair.toml")),
    ("contention", include_str!("../scenarios/contention.toml")),
    ("pair-reboot", include_str!("../scenarios/pair-reboot.toml")),
    (
        "leader-crash",
        include_str!("../scenarios/leader-crash.toml"),
    ),
    ("offer-race", include_str!("../scenarios/offer-race.toml")),
    ("bilateral", include_str!("../scenarios/bilateral.toml")),
    ("trio", include_str!("../scenarios/trio.toml")),
    ("timed-pair", include_str!("../scenarios/timed-pair.toml")),
    ("timed-trio", include_str!("../scenarios/timed-trio.toml")),
    ("wrap", include_str!("../scenarios/wrap.toml")),
    ("stable", include_str!("../scenarios/stable.toml")),
    (
        "team-of-four",
        include_str!("../scenarios/team-of-four.toml"),
    ),
    (
        "team-symmetric",
        include_str!("../scenarios/team-symmetric.toml"),
    ),
    (
        "timed-in-use",
        include_str!("../scenarios/timed-in-use.toml"),
    ),
];

/// How many of the shipped scenarios take seconds.
const QUICK: usize = 11;

impl Scenario {
    /// The names of the shipped scenarios that take seconds.
    pub fn quick() -> impl Iterator<Item = &'static str> {
        Self::shipped().take(QUICK)
    }

    /// The names of the shipped scenarios.
    pub fn shipped() -> impl Iterator<Item = &'static str> {
        SHIPPED.iter().map(|(name, _)| *name)
    }

    /// The shipped scenario of this name, or the scenario in the file of this name.
    ///
    /// # Errors
    /// Every way in which there is no usable scenario of that name.
    pub fn load(name: &str) -> Result<Self, ScenarioError> {
        if let Some((_, text)) = SHIPPED.iter().find(|(shipped, _)| *shipped == name) {
            return Self::parse(name, text);
        }
        let path = Path::new(name);
        if !path.exists() && path.extension().is_none() {
            let shipped = Self::shipped().collect::<Vec<_>>().join(", ");
            return Err(ScenarioError::Unknown {
                name: name.to_owned(),
                shipped,
            });
        }
        let text = std::fs::read_to_string(path).map_err(|cause| ScenarioError::Unreadable {
            path: path.to_owned(),
            cause,
        })?;
        Self::parse(name, &text)
    }

    /// The place of the robot that has, or had before it changed its pseudonym, this station id.
    #[must_use]
    pub fn place_of(&self, station: StationId) -> Option<usize> {
        let base = |id: StationId| id.0 % PSEUDONYM_STEP;
        self.robots
            .iter()
            .position(|robot| base(robot.station) == base(station))
    }

    /// Reads a scenario from its text; `file` is what errors call it.
    ///
    /// # Errors
    /// The first thing that is wrong, with its line.
    pub fn parse(file: &str, text: &str) -> Result<Self, ScenarioError> {
        let parsed: File = toml::from_str(text).map_err(|cause| ScenarioError::Syntax {
            file: file.to_owned(),
            cause,
        })?;
        parsed
            .check()
            .map_err(|Located { at, cause }| ScenarioError::Impossible {
                file: file.to_owned(),
                line: at.line_in(text),
                cause,
            })
    }
}

/// Where in a file something is wrong.
enum Place {
    Offset(usize),
    Key(&'static str),
}

impl Place {
    /// The line, counted from 1.
    fn line_in(&self, text: &str) -> usize {
        let offset = match self {
            Self::Offset(offset) => *offset,
            Self::Key(key) => text
                .lines()
                .scan(0, |start, line| {
                    let this = *start;
                    *start += line.len() + 1;
                    Some((this, line))
                })
                .find(|(_, line)| line.trim_start().trim_start_matches('[').starts_with(key))
                .map_or(0, |(start, _)| start),
        };
        text[..offset.min(text.len())].matches('\n').count() + 1
    }
}

struct Located {
    at: Place,
    cause: Impossibility,
}

fn at(at: Place, cause: impl Into<Impossibility>) -> Located {
    Located {
        at,
        cause: cause.into(),
    }
}

impl File {
    fn check(self) -> Result<Scenario, Located> {
        use Impossibility as I;
        let robots = self.robots.len();
        if !(2..=MAX_ROBOTS).contains(&robots) {
            return Err(at(Place::Key("robots"), I::Robots(robots)));
        }
        for (i, robot) in self.robots.iter().enumerate() {
            let (one, pseudonym) = (robot.station, |id: StationId| id.0 % PSEUDONYM_STEP);
            for other in self.robots[..i].iter().map(|other| other.station) {
                if other == one {
                    return Err(at(Place::Key("robots"), I::SameStation(one)));
                }
                if pseudonym(other) == pseudonym(one) {
                    return Err(at(Place::Key("robots"), I::SamePseudonyms(other, one)));
                }
            }
        }
        if !self.robots.iter().any(|robot| robot.detects) {
            return Err(at(Place::Key("robots"), I::NobodyDetects));
        }
        if self.cooperative && robots > MAX_COOPERATIVE_ROBOTS {
            return Err(at(Place::Key("cooperative"), I::Cooperative(robots)));
        }
        let delayed = self.channel.delayed;
        if usize::from(delayed) > MAX_DELAYED {
            return Err(at(Place::Key("delayed"), I::Delayed(delayed)));
        }
        let request = self.request.check()?;
        let config = Config::new(self.protocol)
            .map_err(|broken| at(Place::Key(key_of(broken.0)), I::Settings(broken)))?;
        let claim = Claim {
            robots: &self.robots,
            followers: request.followers,
            bounds: self.bounds,
            is_timed: self.timed.is_some(),
            properties: &self.properties,
        };
        let symmetric = claim.check(&self.symmetric).map_err(|(wrong, cause)| {
            let place = match wrong {
                Wrong::At(offset) => Place::Offset(offset),
                Wrong::Key(key) => Place::Key(key),
            };
            at(place, cause)
        })?;
        let mut timed = None;
        if let Some(section) = self.timed {
            let checked = section.check(config.settings(), &self.robots, self.bounds, self.channel);
            let mut checked = checked.map_err(|(key, cause)| at(Place::Key(key), cause))?;
            if self.cooperative {
                let cause = TimedImpossibility::Untimed("cooperative");
                return Err(at(Place::Key("cooperative"), cause));
            }
            checked.properties = all_named(&self.properties, |name| {
                let unknown = || TimedImpossibility::Property(name.to_owned());
                TimedProperty::named(name).ok_or_else(|| unknown().into())
            })?;
            timed = Some(checked);
        }
        let properties = match timed {
            Some(_) => Vec::new(),
            None => all_named(&self.properties, |name| match name.parse() {
                Ok(PropertyId::L3) if !self.cooperative => Err(I::NotCooperative),
                Ok(property) => Ok(property),
                Err(()) => Err(I::Property(name.to_owned())),
            })?,
        };
        Ok(Scenario {
            name: self.name,
            summary: self.summary,
            robots: self.robots,
            symmetric,
            request,
            bounds: self.bounds,
            corridor: self.corridor,
            channel: self.channel,
            cooperative: self.cooperative,
            config,
            timed,
            properties,
            expected: self.expected,
        })
    }
}

/// The properties of these names.
fn all_named<P>(
    names: &[toml::Spanned<String>],
    parse: impl Fn(&str) -> Result<P, Impossibility>,
) -> Result<Vec<P>, Located> {
    let property = |name: &toml::Spanned<String>| {
        parse(name.get_ref()).map_err(|cause| at(Place::Offset(name.span().start), cause))
    };
    names.iter().map(property).collect()
}

/// The key whose line a broken inequality is reported at: the first timer in its formula.
const fn key_of(inequality: Inequality) -> &'static str {
    match inequality {
        Inequality::RepeatsInRange => "n_ack",
        Inequality::DriftInRange => "drift_ppm",
        Inequality::LeaseWithinSafety | Inequality::HeartbeatsWithinLease => "t_lease",
        Inequality::SelectionWithinOffer => "t_select",
        Inequality::OfferWithinHelp => "t_offer",
        Inequality::FarewellRepeated => "t_farewell",
        Inequality::LockOutlastsTask | Inequality::HeartbeatsInNumberSpace => "t_lock",
        Inequality::TimerInRange => "protocol",
    }
}

impl Request {
    fn check(self) -> Result<HelpRequest, Located> {
        let place = Place::Offset(self.followers.span().start);
        let followers = self.followers.into_inner();
        if followers == 0 || usize::from(followers) > MAX_FOLLOWERS {
            return Err(at(place, Impossibility::Followers(followers)));
        }
        let mut tasks = Vec::new();
        for name in self.tasks {
            let place = Place::Offset(name.span().start);
            let name = name.into_inner();
            match task_of(&name) {
                Some(task) => tasks.push(task),
                None => return Err(at(place, Impossibility::Task(name))),
            }
        }
        Ok(HelpRequest {
            urgency: self.urgency,
            followers,
            tasks: TaskSet::of(&tasks),
        })
    }
}

fn task_of(name: &str) -> Option<TaskType> {
    TaskSet(u16::MAX)
        .iter()
        .find(|task| task.to_string() == name)
}

impl Hash for Bounds {
    /// All bounds at once: states are hashed by the million.
    fn hash<H: Hasher>(&self, state: &mut H) {
        let Self {
            detections,
            commands,
            disturbances,
            crashes,
            restarts,
            losses,
        } = *self;
        // A bound of 255 losses and none at all may share a hash.
        let losses = losses.unwrap_or(u8::MAX);
        state.write(&[
            detections,
            commands,
            disturbances,
            crashes,
            restarts,
            losses,
        ]);
    }
}

impl fmt::Display for Bounds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let bounds = [
            ("detections", self.detections),
            ("commands", self.commands),
            ("disturbances", self.disturbances),
            ("crashes", self.crashes),
            ("restarts", self.restarts),
            ("losses", self.losses.unwrap_or_default()),
        ];
        let allowed: Vec<_> = bounds
            .iter()
            .filter(|(_, bound)| *bound > 0)
            .map(|(name, bound)| format!("{name} <= {bound}"))
            .collect();
        f.write_str(&allowed.join(", "))
    }
}
