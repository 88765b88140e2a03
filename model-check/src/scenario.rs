//! Scenarios: which robots, which faults, how often what may happen, what must hold.
//!
//! A scenario is a TOML file. The shipped ones are in `scenarios/`; a user can write another without
//! touching code. An unknown key, an impossible bound or an unknown property is an error that names
//! the line.

mod file;
mod lies;
pub(crate) mod location;
mod monotone;
pub(crate) mod setup;
mod symmetric;

use std::path::PathBuf;

use crossguard_protocol::{Config, HelpRequest, StationId};

use crate::properties::PropertyId;
use crate::timed::Timed;
pub use lies::LyingPart;
pub(crate) use setup::PSEUDONYM_STEP;
pub use setup::{Bounds, ChannelSetup, MAX_ROBOTS, RobotSetup, Size};

/// How many robots a cooperative scenario may have.
const MAX_COOPERATIVE_ROBOTS: usize = 3;

/// A scenario, checked.
#[derive(Clone, Debug)]
pub struct Scenario {
    /// Its name.
    pub name: String,
    /// Its subject, in one line.
    pub summary: String,
    /// The robots, in the order of the file.
    pub robots: Vec<RobotSetup>,
    /// The station ids of the robots of which it does not matter which is which: states that differ in
    /// that alone count as one.
    pub symmetric: Vec<StationId>,
    /// Request of a robot that detects a pedestrian, where its setup says nothing else.
    pub request: HelpRequest,
    /// How often what may happen in one run.
    pub bounds: Bounds,
    /// Whether a leader's application opens and closes the corridor, as often as it likes.
    pub corridor: bool,
    /// Behaviour of the radio channel.
    pub channel: ChannelSetup,
    /// Whether everything around the robots does its part, which L3 assumes: an RMCM arrives, of the
    /// RAM that are sent again and again some arrive, no timer that guards against silence runs out,
    /// and applications command, finish, and end the task once it is completed. Where there is a corridor
    /// they open it and keep it open, one pedestrian crosses, and guards and task end after that.
    pub cooperative: bool,
    /// The configuration of every robot.
    pub config: Config,
    /// The properties to check; none where the scenario is timed.
    pub properties: Vec<PropertyId>,
    /// The timed part, with the properties to check then; `None` where the scenario is untimed.
    pub timed: Option<Timed>,
    /// Size that an exploration must find, where the file says one.
    pub expected: Option<Size>,
}

/// Why a scenario cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum ScenarioError {
    /// There is neither a shipped scenario nor a file of that name.
    #[error(
        "no scenario '{name}': the shipped ones are {shipped}, anything else is read as a file"
    )]
    Unknown {
        /// The name that was asked for.
        name: String,
        /// The names of the shipped ones.
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
        /// The error and its place in the text.
        cause: toml::de::Error,
    },
    /// The text is a scenario that makes no sense.
    #[error("{file}:{line}: {cause}")]
    Impossible {
        /// The file or shipped scenario.
        file: String,
        /// The line, counted from 1.
        line: usize,
        /// The mistake.
        cause: String,
    },
}

struct Shipped {
    name: &'static str,
    text: &'static str,
    effort: Effort,
}

/// Time that a check takes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Effort {
    /// Seconds.
    Quick,
    /// Up to minutes.
    Long,
    /// Up to hours, by workers that judge states and steps.
    Large,
}

macro_rules! shipped {
    ($($duration:ident $time:ident $test:ident $name:literal;)*) => {
        /// The scenarios that take seconds come first, then the ones that take minutes, then the large ones.
        const SHIPPED: &[Shipped] = &[$(Shipped {
            name: $name,
            text: include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/scenarios/", $name, ".toml")),
            effort: shipped!(@ $duration),
        }),*];
    };
    (@ quick) => { Effort::Quick };
    (@ long) => { Effort::Long };
    (@ large) => { Effort::Large };
}

include!("../scenarios/list.rs");

impl Scenario {
    /// Whether its state space is expected to be of this size; `None` where nothing is expected.
    #[must_use]
    pub(crate) fn is_expected(&self, size: Size) -> Option<bool> {
        self.expected.map(|expected| expected == size)
    }

    /// The names of the shipped scenarios that take seconds.
    pub fn quick() -> impl Iterator<Item = &'static str> {
        Self::names(|effort| effort == Effort::Quick)
    }

    /// The names of the shipped scenarios that take up to minutes.
    pub fn shipped() -> impl Iterator<Item = &'static str> {
        Self::names(|effort| effort != Effort::Large)
    }

    /// The names of the shipped scenarios of up to 10^9 states, which are for workers.
    pub fn large() -> impl Iterator<Item = &'static str> {
        Self::names(|effort| effort == Effort::Large)
    }

    fn names(of: impl Fn(Effort) -> bool) -> impl Iterator<Item = &'static str> {
        let shipped = SHIPPED.iter().filter(move |shipped| of(shipped.effort));
        shipped.map(|shipped| shipped.name)
    }

    /// The names of the shipped scenarios, each with its file.
    pub fn shipped_texts() -> impl Iterator<Item = (&'static str, &'static str)> {
        SHIPPED.iter().map(|shipped| (shipped.name, shipped.text))
    }

    /// The shipped scenario of this name.
    ///
    /// # Errors
    /// There is none.
    pub fn load(name: &str) -> Result<Self, ScenarioError> {
        let Some(shipped) = SHIPPED.iter().find(|shipped| shipped.name == name) else {
            let shipped = Self::names(|_| true).collect::<Vec<_>>().join(", ");
            return Err(ScenarioError::Unknown {
                name: name.to_owned(),
                shipped,
            });
        };
        Self::parse(name, shipped.text)
    }

    /// Request of the robot at this place when it detects a pedestrian.
    #[must_use]
    pub fn request_of(&self, place: usize) -> HelpRequest {
        HelpRequest {
            urgency: self.robots[place].urgency.unwrap_or(self.request.urgency),
            ..self.request
        }
    }

    /// The robots that lie, with their places.
    pub fn liars(&self) -> impl Iterator<Item = (usize, StationId, LyingPart)> {
        let robots = self.robots.iter().enumerate();
        robots.filter_map(|(place, robot)| Some((place, robot.station, robot.lies?)))
    }

    /// The place of the robot that has, or had before it changed its pseudonym, this station id.
    #[must_use]
    pub fn place_of(&self, station: StationId) -> Option<usize> {
        let base = |id: StationId| id.0 % PSEUDONYM_STEP;
        self.robots
            .iter()
            .position(|robot| base(robot.station) == base(station))
    }
}
