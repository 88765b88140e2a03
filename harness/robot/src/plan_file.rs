//! A plan as a file: roles, stages, tasks, and a target for each role, on a site.
//!
//! ```toml
//! summary = "ARI leads and blocks a lane, and a dog escorts."
//!
//! [[roles]]
//! name = "leader"
//! leads = true
//! stands = "near-lane"
//!
//! [[roles]]
//! name = "escort"
//! station = 2
//!
//! [[stages]]
//! escort = { task = "move", to = "far-kerb", speed_mps = 0.424 }
//! ```
//!
//! Guards are sent to their places before anybody is escorted, and every way can be walked in the time that its task has.
//! No two bodies are sent to places that are closer than [`APART_M`]: in no stage, and not to where the leader stands.

mod check;
mod safety;
mod tables;

use std::path::Path;

use crossguard_codec::PublicSignal;
use crossguard_protocol::{EndReason, ReleaseReason, Settings, StationId, Urgency};
use serde::Deserialize;

use crate::body::Build;
use crate::located::{self, FileError};
use crate::plan::{Leg, Plan, Stage, Who};
use crate::site::Place;
use crate::site_file::SiteFile;

/// How far apart the targets of two robots are at least, in metres: a humanoid is 0.75 m wide, a dog 0.7 m long.
pub const APART_M: f64 = 1.0;

/// A plan on a site, checked.
#[derive(Clone, PartialEq, Debug)]
pub struct PlanFile {
    /// Its name.
    pub name: String,
    /// Summary of its events, in a sentence.
    pub summary: String,
    /// The site that its places are on.
    pub site: SiteFile,
    /// Robots that take part: leaders and followers, in the order of the file.
    pub roles: Vec<Role>,
    /// How many followers it takes unless it is said.
    pub followers: u8,
    /// How urgent it is.
    pub urgency: Urgency,
    /// The stages. A part is of the follower with this number, of all that the file has.
    pub stages: Vec<Vec<(usize, Leg)>>,
    /// For how long a simulated pedestrian is on the road, in seconds.
    pub crossing_s: f64,
    /// After which time the leader gives up, in seconds.
    pub patience_s: f64,
    /// Vehicles that would be at the crossing within this time are asked to stop before go begins, in seconds; 0: none.
    pub asks_vehicles_s: f64,
    /// The places between which the escort may go in either direction.
    pub either_way: Option<[Place; 2]>,
    /// The robot that loses power in a demonstration, once the pedestrian is on the road.
    pub loses_power: Option<String>,
    /// How a demonstration is to end.
    pub ends: Ending,
    /// A connected vehicle of a demonstration.
    pub car: Option<Car>,
}

/// A connected vehicle of a demonstration, which comes along a lane of the site over and over.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Car {
    /// Its name.
    pub name: String,
    /// Its station id.
    pub station: u32,
    /// The lane that it comes along.
    pub lane: String,
    /// How far before the crossing it comes into sight, in metres.
    pub from_m: f64,
    /// How fast it is, in m/s.
    pub speed_mps: f64,
    /// Its reaction when it is asked to stop.
    pub answers: CarAnswer,
}

/// Reaction of a vehicle that is asked to stop.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CarAnswer {
    /// It says that it will, and does.
    Stops,
    /// It says that it will, and goes on.
    Lies,
    /// It says that it will not.
    Refuses,
    /// It says nothing.
    Silent,
}

/// A robot that takes part.
#[derive(Clone, PartialEq, Debug)]
pub struct Role {
    /// Its name in stages.
    pub name: String,
    /// Whether it leads.
    pub leads: bool,
    /// Whether it is left out of a smaller team.
    pub optional: bool,
    /// Whether any robot may take it.
    pub any: bool,
    /// Its robot in a demonstration.
    pub robot: Option<String>,
    /// The station that the role is for, unless any may take it.
    pub station: Option<StationId>,
    /// Its build in a demonstration.
    pub build: Option<Build>,
    /// Where it waits before.
    pub waits: Option<Place>,
    /// Where a leader stands while it leads.
    pub stands: Option<Place>,
    /// A leader's signal to vehicles while it leads; stop where it stands somewhere, unless the file has another one.
    pub shows: Option<PublicSignal>,
}

/// How a demonstration ends.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Ending {
    /// The leader ended the session.
    Session(EndReason),
    /// The followers left; the leader did not end it.
    Released(ReleaseReason),
}

macro_rules! shipped {
    ($($name:literal),*) => {
        /// The plans that come with the kit.
        pub const SHIPPED: &[(&str, &str)] =
            &[$(($name, include_str!(concat!("../plans/", $name, ".toml")))),*];
    };
}

shipped!(
    "crossing",
    "bilateral",
    "trio",
    "team",
    "follower-dies",
    "leader-dies",
    "two-detect",
    "vehicle"
);

impl PlanFile {
    /// The plan of this name that comes with the kit, or of this file, on a site, for robots with the settings by default.
    /// A name without `.toml` is one that comes with the kit.
    ///
    /// # Errors
    /// The first thing that is wrong, with its line.
    pub fn open(name: &Path, site: SiteFile) -> Result<Self, FileError> {
        Self::open_for(name, site, &Settings::default())
    }

    /// The same, for robots with these settings.
    ///
    /// # Errors
    /// The first thing that is wrong, with its line.
    pub fn open_for(name: &Path, site: SiteFile, settings: &Settings) -> Result<Self, FileError> {
        let text = name.to_string_lossy();
        let shipped = SHIPPED.iter().find(|(shipped, _)| *shipped == text);
        if let Some((name, plan)) = shipped {
            return Self::parse(&format!("plan {name}"), name, plan, site, settings);
        }
        if name.extension().is_none_or(|extension| extension != "toml") {
            let names: Vec<_> = SHIPPED.iter().map(|(name, _)| *name).collect();
            let names = names.join(", ");
            let what =
                format!("no plan of this name: a file like plan.toml is wanted, or one of {names}");
            return Err(FileError {
                file: text.into_owned(),
                line: None,
                what,
            });
        }
        let stem = name.file_stem().unwrap_or_default().to_string_lossy();
        Self::parse(&text, &stem, &located::read(name)?, site, settings)
    }

    fn parse(
        file: &str,
        name: &str,
        text: &str,
        site: SiteFile,
        settings: &Settings,
    ) -> Result<Self, FileError> {
        let tables: Result<tables::PlanTables, _> = located::parse(text);
        let checked = tables.and_then(|tables| tables.check(name, site, settings));
        checked.map_err(|misfit| misfit.of(file, text))
    }

    /// The roles of robots that take part in a team with this many followers: all leaders, the followers that are not
    /// optional, and the first optional ones.
    #[must_use]
    pub fn taking_part(&self, followers: u8) -> Vec<&Role> {
        let is_fixed = |role: &&Role| !role.leads && !role.optional;
        let fixed = self.roles.iter().filter(is_fixed).count();
        let mut left = usize::from(followers).saturating_sub(fixed);
        let takes_part = |role: &&Role| {
            if role.leads || !role.optional {
                return true;
            }
            let has_place = left > 0;
            left = left.saturating_sub(1);
            has_place
        };
        self.roles.iter().filter(takes_part).collect()
    }

    /// Plan of a leader in a team with this many followers: the leader with this station id, or else the first one.
    #[must_use]
    pub fn plan(&self, leader: StationId, followers: u8) -> Plan {
        let team = self.taking_part(followers);
        let followers: Vec<_> = self.roles.iter().filter(|role| !role.leads).collect();
        // The numbers of robots that take part, by the ones that the file gives them.
        let mut seats = Vec::new();
        let mut roles = Vec::new();
        for follower in followers {
            let takes_part = team.iter().any(|role| role.name == follower.name);
            let seat = u8::try_from(roles.len()).unwrap_or(u8::MAX);
            seats.push(takes_part.then_some(seat));
            if takes_part {
                roles.push(follower.station.filter(|_| !follower.any));
            }
        }
        let leader = self.leader(leader);
        let stages = self.stages.iter().map(|stage| {
            let parts = stage.iter();
            let parts = parts.filter_map(|(it, leg)| Some((Who::Role((*seats.get(*it)?)?), *leg)));
            Stage {
                parts: parts.collect(),
            }
        });
        // A stage in which nobody has a part would have no end.
        let stages = stages.filter(|stage| !stage.parts.is_empty()).collect();
        Plan {
            site: self.site.site,
            followers: u8::try_from(roles.len()).unwrap_or(u8::MAX),
            urgency: self.urgency,
            stages,
            roles,
            own_place: leader.and_then(|role| role.stands),
            own_heading_deg: leader
                .and_then(|role| role.stands)
                .and_then(|place| self.site.facing_deg(place)),
            shows: leader.and_then(|role| role.shows.or(role.stands.map(|_| PublicSignal::Stop))),
            crossing_s: self.crossing_s,
            patience_s: self.patience_s,
            kerbs: self.either_way,
            asks_vehicles_s: self.asks_vehicles_s,
        }
    }

    fn leader(&self, station: StationId) -> Option<&Role> {
        let mut leaders = self.roles.iter().filter(|role| role.leads);
        let named = leaders.clone().find(|role| role.station == Some(station));
        named.or_else(|| leaders.next())
    }
}

#[cfg(test)]
mod tests;
