//! The file of a scenario: its form, and what is checked before it is one. An error names its line.

use crossguard_protocol::{
    Config, HelpRequest, Inequality, MAX_FOLLOWERS, Millis, Settings, SettingsInFiles, StationId,
    TaskNames, TaskSet, TaskType, Urgency,
};
use serde::Deserialize;
use toml::Spanned;

use super::location::{Location, Wrong};
use super::{
    Bounds, ChannelSetup, MAX_COOPERATIVE_ROBOTS, MAX_ROBOTS, PSEUDONYM_STEP, RobotSetup, Scenario,
    ScenarioError, Size, lies, monotone, symmetric,
};
use crate::network::MAX_DELAYED;
use crate::properties::{PropertyId, listed};
use crate::timed::{Section, no_place_for};

/// The file's form of a scenario.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct File {
    name: String,
    summary: String,
    pub(super) robots: Vec<RobotSetup>,
    #[serde(default)]
    pub(super) symmetric: Vec<Spanned<StationId>>,
    pub(super) request: Request,
    pub(super) bounds: Bounds,
    #[serde(default)]
    corridor: bool,
    #[serde(default)]
    pub(super) cooperative: bool,
    pub(super) channel: ChannelSetup,
    #[serde(default, with = "SettingsInFiles")]
    protocol: Settings,
    pub(super) timed: Option<Section>,
    properties: Vec<Spanned<String>>,
    expected: Option<Size>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Request {
    #[serde(default)]
    urgency: Urgency,
    pub(super) followers: Spanned<u8>,
    tasks: Vec<Spanned<String>>,
    #[serde(default)]
    place: crossguard_protocol::Place,
}

impl Scenario {
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
            .map_err(|Wrong { at, cause }| ScenarioError::Impossible {
                file: file.to_owned(),
                line: at.line_in(text),
                cause,
            })
    }
}

impl File {
    fn check(self) -> Result<Scenario, Wrong> {
        let robots = self.robots.len();
        if !(2..=MAX_ROBOTS).contains(&robots) {
            let cause = format!("{robots} robots: between 2 and {MAX_ROBOTS} are possible");
            return Err(Wrong::key("robots", cause));
        }
        self.check_robots()?;
        let of_runs = |name: &Spanned<String>| {
            let id = name.get_ref().parse::<PropertyId>();
            id.is_ok_and(|id| id.liveness_rule().is_some())
        };
        let is_of_runs = self.properties.iter().any(of_runs);
        if self.cooperative && is_of_runs && robots > MAX_COOPERATIVE_ROBOTS {
            let cause = format!(
                "{robots} robots in a cooperative scenario: at most {MAX_COOPERATIVE_ROBOTS} are possible"
            );
            return Err(Wrong::key("cooperative", cause));
        }
        let delayed = self.channel.delayed;
        if usize::from(delayed) > MAX_DELAYED {
            let cause =
                format!("{delayed} messages delayed at a time: at most {MAX_DELAYED} are possible");
            return Err(Wrong::key("delayed", cause));
        }
        monotone::check(&self)?;
        lies::check(&self)?;
        symmetric::check(&self)?;
        let request = self.request.check()?;
        let mut settings = self.protocol;
        if self.timed.is_none() {
            // Each armed timer has 1 ms left, so that is what a crossing takes: no corridor is refused for
            // lack of time, where it may be refused in time.
            settings.t_cross = Millis(1);
        }
        let config = Config::new(settings)
            .map_err(|broken| Wrong::key(key_of(broken.0), broken.to_string()))?;
        let mut timed = None;
        if let Some(section) = self.timed {
            let checked = section.check(config.settings(), &self.robots, self.bounds, self.channel);
            let mut checked = checked?;
            if self.cooperative {
                return Err(no_place_for("cooperative"));
            }
            checked.properties = all_named(&self.properties, timed_property)?;
            timed = Some(checked);
        }
        let properties = match timed {
            Some(_) => Vec::new(),
            None => all_named(&self.properties, |name| {
                untimed_property(name, self.cooperative)
            })?,
        };
        Ok(Scenario {
            name: self.name,
            summary: self.summary,
            robots: self.robots,
            symmetric: self
                .symmetric
                .into_iter()
                .map(Spanned::into_inner)
                .collect(),
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

    /// Refuses the first of its properties that there is a cause against.
    pub(super) fn refuse(&self, cause: impl Fn(PropertyId) -> Option<String>) -> Result<(), Wrong> {
        let wrong = |name: &Spanned<String>| {
            let cause = cause(name.get_ref().parse().ok()?)?;
            Some(Wrong::new(Location::Offset(name.span().start), cause))
        };
        self.properties.iter().find_map(wrong).map_or(Ok(()), Err)
    }

    /// Whether the robots can be told apart, and one of them starts a run.
    fn check_robots(&self) -> Result<(), Wrong> {
        for (i, robot) in self.robots.iter().enumerate() {
            let (one, pseudonym) = (robot.station, |id: StationId| id.0 % PSEUDONYM_STEP);
            for other in self.robots[..i].iter().map(|other| other.station) {
                if other == one {
                    return Err(Wrong::key(
                        "robots",
                        format!("two robots have station id {one}"),
                    ));
                }
                if pseudonym(other) == pseudonym(one) {
                    let cause = format!(
                        "station ids {other} and {one} must not differ by a multiple of {PSEUDONYM_STEP}"
                    );
                    return Err(Wrong::key("robots", cause));
                }
            }
        }
        let never_asks = |robot: &&RobotSetup| robot.urgency.is_some() && !robot.detects;
        if let Some(robot) = self.robots.iter().find(never_asks) {
            let station = robot.station;
            let cause = format!(
                "robot {station} has an urgency but no 'detects = true', so it never asks for help"
            );
            return Err(Wrong::key("urgency", cause));
        }
        let starts = |robot: &RobotSetup| robot.detects || robot.lies.is_some();
        if !self.robots.iter().any(starts) {
            let cause = "no robot has 'detects = true', so nothing would ever happen";
            return Err(Wrong::key("robots", cause));
        }
        Ok(())
    }
}

/// The property of this name, if it is one of `all`, which are of this `kind`.
fn property_among(
    name: &str,
    kind: &str,
    all: impl Iterator<Item = PropertyId> + Clone,
) -> Result<PropertyId, String> {
    let id = all.clone().find(|id| id.name() == name);
    id.ok_or_else(|| format!("no {kind} '{name}': {}", listed(all)))
}

fn untimed_property(name: &str, is_cooperative: bool) -> Result<PropertyId, String> {
    let id = property_among(name, "property", PropertyId::all_untimed())?;
    let rule = id.liveness_rule();
    if rule.is_some_and(|rule| rule.needs_cooperation) && !is_cooperative {
        return Err(format!(
            "{id} speaks about cooperative scenarios only; this one lacks 'cooperative = true'"
        ));
    }
    Ok(id)
}

fn timed_property(name: &str) -> Result<PropertyId, String> {
    property_among(name, "timed property", PropertyId::all_timed())
}

fn all_named(
    names: &[Spanned<String>],
    parse: impl Fn(&str) -> Result<PropertyId, String>,
) -> Result<Vec<PropertyId>, Wrong> {
    let property = |name: &Spanned<String>| {
        let at = Location::Offset(name.span().start);
        parse(name.get_ref()).map_err(|cause| Wrong::new(at, cause))
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
        Inequality::OfferWithinHelp | Inequality::HeartbeatsWithinOffer => "t_offer",
        Inequality::CrossingWithinLimits => "t_cross",
        Inequality::FarewellRepeated => "t_farewell",
        Inequality::LockOutlastsTask | Inequality::HeartbeatsInNumberSpace => "t_lock",
        Inequality::NamedTasksGuard => "guarding",
        Inequality::BlockHolds => "holding",
        Inequality::TimerInRange => "protocol",
    }
}

impl Request {
    fn check(self) -> Result<HelpRequest, Wrong> {
        let place = Location::Offset(self.followers.span().start);
        let followers = self.followers.into_inner();
        if followers == 0 || usize::from(followers) > MAX_FOLLOWERS {
            let cause = format!(
                "a request for {followers} followers: between 1 and {MAX_FOLLOWERS} are possible"
            );
            return Err(Wrong::new(place, cause));
        }
        let mut tasks = Vec::new();
        for name in self.tasks {
            let place = Location::Offset(name.span().start);
            let name = name.into_inner();
            let Some(task) = task_of(&name) else {
                let cause = format!("no task '{name}': {TaskNames}");
                return Err(Wrong::new(place, cause));
            };
            tasks.push(task);
        }
        Ok(HelpRequest {
            urgency: self.urgency,
            followers,
            tasks: TaskSet::of(&tasks),
            place: self.place,
        })
    }
}

fn task_of(name: &str) -> Option<TaskType> {
    TaskSet(u16::MAX)
        .iter()
        .find(|task| task.to_string() == name)
}
