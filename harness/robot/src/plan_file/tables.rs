//! The tables of a plan's file, before they are checked.

use std::collections::BTreeMap;

use crossguard_protocol::Urgency;
use serde::Deserialize;
use toml::Spanned;

use super::Car;
use crate::body::Build;
use crate::located::Exact;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PlanTables {
    pub(super) summary: Option<String>,
    pub(super) followers: Option<Spanned<u8>>,
    pub(super) urgency: Option<Urgency>,
    pub(super) crossing_s: Option<Spanned<f64>>,
    pub(super) patience_s: Option<Spanned<f64>>,
    pub(super) asks_vehicles_s: Option<Spanned<f64>>,
    pub(super) either_way: Option<Exact<Spanned<SpotName>, 2>>,
    pub(super) roles: Vec<Spanned<RoleTable>>,
    pub(super) stages: Vec<Spanned<BTreeMap<String, Spanned<PartTable>>>>,
    pub(super) demo: Option<Spanned<DemoTable>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RoleTable {
    pub(super) name: String,
    #[serde(default)]
    pub(super) leads: bool,
    #[serde(default)]
    pub(super) optional: bool,
    #[serde(default)]
    pub(super) any: bool,
    pub(super) robot: Option<String>,
    pub(super) station: Option<u32>,
    pub(super) build: Option<Build>,
    pub(super) waits: Option<Spanned<SpotName>>,
    pub(super) stands: Option<Spanned<SpotName>>,
    pub(super) shows: Option<SignalName>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum SignalName {
    Stop,
    Go,
    Caution,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PartTable {
    pub(super) task: Spanned<String>,
    pub(super) to: Spanned<SpotName>,
    pub(super) speed_mps: Option<Spanned<f64>>,
    pub(super) heading_deg: Option<Spanned<f64>>,
}

#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(super) struct DemoTable {
    pub(super) loses_power: Option<String>,
    pub(super) ends: EndName,
    pub(super) car: Option<Car>,
}

#[derive(Clone, Copy, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum EndName {
    #[default]
    TaskCompleted,
    NoFollowers,
    ContactLost,
}

/// A place: its name on the site, or metres east and north.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(
    untagged,
    expecting = "a place is wanted: its name on the site, or [EAST, NORTH] in metres"
)]
pub(super) enum SpotName {
    Named(String),
    At(Exact<f64, 2>),
}
