//! The file of a scenario: its form, and what is checked before it is one. An error names its line.

use crossguard_protocol::{
    Config, HelpRequest, Inequality, MAX_FOLLOWERS, Millis, Settings, StationId, TaskSet, TaskType,
    Urgency,
};
use serde::Deserialize;

use super::location::Location;
use super::symmetric::SymmetryClaim;
use super::{
    Bounds, ChannelSetup, Impossibility, MAX_COOPERATIVE_ROBOTS, MAX_ROBOTS, PSEUDONYM_STEP,
    RobotSetup, Scenario, ScenarioError, Size, lies, monotone,
};
use crate::network::MAX_DELAYED;
use crate::properties::PropertyId;
use crate::timed::{Section, TimedImpossibility};

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
    channel: ChannelSetup,
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
            .map_err(|Located { at, cause }| ScenarioError::Impossible {
                file: file.to_owned(),
                line: at.line_in(text),
                cause,
            })
    }
}

struct Located {
    at: Location,
    cause: Impossibility,
}

fn at(at: Location, cause: impl Into<Impossibility>) -> Located {
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
            return Err(at(Location::Key("robots"), I::Robots(robots)));
        }
        self.check_robots()?;
        let of_runs = |name: &toml::Spanned<String>| {
            let id = name.get_ref().parse::<PropertyId>();
            id.is_ok_and(|id| id.liveness_rule().is_some())
        };
        let is_of_runs = self.properties.iter().any(of_runs);
        if self.cooperative && is_of_runs && robots > MAX_COOPERATIVE_ROBOTS {
            return Err(at(Location::Key("cooperative"), I::Cooperative(robots)));
        }
        let delayed = self.channel.delayed;
        if usize::from(delayed) > MAX_DELAYED {
            return Err(at(Location::Key("delayed"), I::Delayed(delayed)));
        }
        monotone::check(
            self.channel,
            self.bounds,
            self.cooperative,
            &self.properties,
        )
        .map_err(|(wrong, cause)| at(wrong, cause))?;
        let others = [
            ("monotone", self.channel.monotone),
            ("symmetric", !self.symmetric.is_empty()),
            ("timed", self.timed.is_some()),
            ("cooperative", self.cooperative),
        ];
        lies::check(&self.robots, others).map_err(|(wrong, cause)| at(wrong, cause))?;
        let request = self.request.check()?;
        let mut settings = self.protocol;
        if self.timed.is_none() {
            // Each armed timer has 1 ms left, so that is what a crossing takes: no corridor is refused for
            // lack of time, where it may be refused in time.
            settings.t_cross = Millis(1);
        }
        let config = Config::new(settings)
            .map_err(|broken| at(Location::Key(key_of(broken.0)), I::Settings(broken)))?;
        let claim = SymmetryClaim {
            robots: &self.robots,
            followers: request.followers,
            bounds: self.bounds,
            is_timed: self.timed.is_some(),
            properties: &self.properties,
        };
        let symmetric = claim
            .check(&self.symmetric)
            .map_err(|(wrong, cause)| at(wrong, cause))?;
        let mut timed = None;
        if let Some(section) = self.timed {
            let checked = section.check(config.settings(), &self.robots, self.bounds, self.channel);
            let mut checked = checked.map_err(|(key, cause)| at(Location::Key(key), cause))?;
            if self.cooperative {
                let cause = TimedImpossibility::Untimed("cooperative");
                return Err(at(Location::Key("cooperative"), cause));
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

    /// Whether the robots can be told apart, and one of them starts a run.
    fn check_robots(&self) -> Result<(), Located> {
        use Impossibility as I;
        for (i, robot) in self.robots.iter().enumerate() {
            let (one, pseudonym) = (robot.station, |id: StationId| id.0 % PSEUDONYM_STEP);
            for other in self.robots[..i].iter().map(|other| other.station) {
                if other == one {
                    return Err(at(Location::Key("robots"), I::SameStation(one)));
                }
                if pseudonym(other) == pseudonym(one) {
                    return Err(at(Location::Key("robots"), I::SamePseudonyms(other, one)));
                }
            }
        }
        let never_asks = |robot: &&RobotSetup| robot.urgency.is_some() && !robot.detects;
        if let Some(robot) = self.robots.iter().find(never_asks) {
            return Err(at(
                Location::Key("urgency"),
                I::UnusedUrgency(robot.station),
            ));
        }
        let starts = |robot: &RobotSetup| robot.detects || robot.lies.is_some();
        if !self.robots.iter().any(starts) {
            return Err(at(Location::Key("robots"), I::NobodyDetects));
        }
        Ok(())
    }
}

fn untimed_property(name: &str, is_cooperative: bool) -> Result<PropertyId, Impossibility> {
    let id = name.parse().ok();
    let id = id.filter(|id: &PropertyId| id.untimed().is_some());
    let id = id.ok_or_else(|| Impossibility::Property(name.to_owned()))?;
    let rule = id.liveness_rule();
    if rule.is_some_and(|rule| rule.needs_cooperation) && !is_cooperative {
        return Err(Impossibility::NotCooperative(id));
    }
    Ok(id)
}

fn timed_property(name: &str) -> Result<PropertyId, Impossibility> {
    let id = name.parse().ok();
    let id = id.filter(|id: &PropertyId| id.timed().is_some());
    id.ok_or_else(|| TimedImpossibility::Property(name.to_owned()).into())
}

/// The properties of these names.
fn all_named(
    names: &[toml::Spanned<String>],
    parse: impl Fn(&str) -> Result<PropertyId, Impossibility>,
) -> Result<Vec<PropertyId>, Located> {
    let property = |name: &toml::Spanned<String>| {
        parse(name.get_ref()).map_err(|cause| at(Location::Offset(name.span().start), cause))
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
        Inequality::TimerInRange => "protocol",
    }
}

impl Request {
    fn check(self) -> Result<HelpRequest, Located> {
        let place = Location::Offset(self.followers.span().start);
        let followers = self.followers.into_inner();
        if followers == 0 || usize::from(followers) > MAX_FOLLOWERS {
            return Err(at(place, Impossibility::Followers(followers)));
        }
        let mut tasks = Vec::new();
        for name in self.tasks {
            let place = Location::Offset(name.span().start);
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
            place: self.place,
        })
    }
}

fn task_of(name: &str) -> Option<TaskType> {
    TaskSet(u16::MAX)
        .iter()
        .find(|task| task.to_string() == name)
}
