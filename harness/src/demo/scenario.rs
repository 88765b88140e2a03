//! Scenarios of demonstrations: plan files of the kit or of the user, and who takes part.

use std::path::Path;

use crossguard_protocol::StationId;
use serde::{Serialize, Serializer};

use crossguard_robot::body::Build;
use crossguard_robot::plan::Plan;
use crossguard_robot::plan_file::{Car, PlanFile, Role, SHIPPED};
use crossguard_robot::site::{Place, Site};
use crossguard_robot::site_file::SiteFile;

pub(super) use crossguard_robot::plan_file::Ending;

/// A plan file whose roles all name their robots.
#[derive(Clone, PartialEq, Debug)]
pub struct Scenario(PlanFile);

/// One robot of a scenario.
#[derive(Clone, Debug)]
pub struct Participant {
    /// Its name.
    pub name: String,
    /// Its station id.
    pub station: StationId,
    pub(super) build: Build,
    pub(super) place: Place,
    /// Its plan for leading; it detects the pedestrian if it has one.
    pub(super) plan: Option<Plan>,
}

/// A plan of which no demonstration can be made.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("plan {plan}: role '{role}' wants {wanted} to take part in a demonstration")]
pub struct NoScenario {
    plan: String,
    role: String,
    wanted: &'static str,
}

impl Scenario {
    /// The names of the scenarios that come with the kit, and what happens in each, in a sentence.
    pub fn shipped() -> impl Iterator<Item = (&'static str, String)> {
        let names = SHIPPED.iter().map(|(name, _)| *name);
        names.filter_map(|name| Some((name, Self::named(name)?.summary().to_owned())))
    }

    /// The scenario of this name that comes with the kit.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let plan = PlanFile::open(Path::new(name), SiteFile::street()).ok()?;
        Self::of(plan).ok()
    }

    /// The scenario of a plan.
    ///
    /// # Errors
    /// A role does not say which robot has it, or where that waits.
    pub fn of(plan: PlanFile) -> Result<Self, NoScenario> {
        let wanted = |role: &Role| {
            let wants = [
                (role.robot.is_none(), "'robot'"),
                (role.station.is_none(), "'station'"),
                (role.build.is_none(), "'build'"),
                (role.waits.is_none(), "'waits'"),
            ];
            let mut wants = wants.into_iter().filter(|(is_missing, _)| *is_missing);
            wants.next().map(|(_, wanted)| (role.name.clone(), wanted))
        };
        match plan.roles.iter().find_map(wanted) {
            Some((role, wanted)) => Err(NoScenario {
                plan: plan.name,
                role,
                wanted,
            }),
            None => Ok(Self(plan)),
        }
    }

    /// Its name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.0.name
    }

    /// People who want to cross, in a sentence.
    #[must_use]
    pub fn who_waits(&self) -> &'static str {
        match self.0.plan(StationId(0), self.0.followers).sides() {
            1 => "A pedestrian wants to cross.",
            _ => "People on both sides want to cross.",
        }
    }

    /// Summary of its events, in a sentence.
    #[must_use]
    pub fn summary(&self) -> &str {
        &self.0.summary
    }

    /// The street that it happens on.
    #[must_use]
    pub const fn street(&self) -> &SiteFile {
        &self.0.site
    }

    /// Where it happens.
    #[must_use]
    pub const fn site(&self) -> Site {
        self.0.site.site
    }

    /// How many followers it has unless it is said, and the fewest and the most that it can have.
    #[must_use]
    pub fn followers(&self) -> (u8, [u8; 2]) {
        let count = |followers| {
            let team = self.0.taking_part(followers).into_iter();
            u8::try_from(team.filter(|role| !role.leads).count()).unwrap_or(u8::MAX)
        };
        (self.0.followers, [count(0).max(1), count(u8::MAX)])
    }

    /// The robots, from left to right, in a team with this many followers.
    #[must_use]
    pub fn participants(&self, followers: u8) -> Vec<Participant> {
        let team = self.0.taking_part(followers).into_iter();
        team.filter_map(|role| {
            let station = role.station?;
            Some(Participant {
                name: role.robot.clone()?,
                station,
                build: role.build?,
                place: role.waits?,
                plan: role.leads.then(|| self.0.plan(station, followers)),
            })
        })
        .collect()
    }

    /// Name of the robot that loses power once the corridor is open.
    #[must_use]
    pub fn victim(&self) -> Option<&str> {
        self.0.loses_power.as_deref()
    }

    /// The connected vehicle that comes along.
    #[must_use]
    pub const fn car(&self) -> Option<&Car> {
        self.0.car.as_ref()
    }

    /// How it is to end.
    pub(super) const fn end(&self) -> Ending {
        self.0.ends
    }
}

impl Serialize for Scenario {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}
