//! The lines of the body port, version 3: one JSON object each, with its kind under `type`.

use crossguard_codec::TaskParameters;
use crossguard_protocol::{FallbackPolicy, Maneuver};
use serde::{Deserialize, Serialize};

use crate::site::{Place, Site};

/// The version that both sides say in `hello`.
pub const VERSION: u8 = 3;

/// Line of the kit to a body.
#[derive(Clone, PartialEq, Debug, Serialize)]
#[serde(
    rename_all_fields = "camelCase",
    tag = "type",
    rename_all = "kebab-case"
)]
pub(super) enum ToBody {
    Hello { crossguard: u8 },
    Start(Start),
    Stop { id: String, why: String },
    FallBack { id: String, policy: &'static str },
    Wait,
    GoOn,
    Go { to: At, heading_deg: Option<f64> },
    Halt,
    Release,
    Beat,
    Refused { why: String },
}

/// A maneuver that begins.
#[derive(Clone, PartialEq, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Start {
    id: String,
    task: String,
    /// Type of the report that the body sends when it is there.
    report: &'static str,
    to: Option<At>,
    speed_mps: Option<f64>,
    heading_deg: Option<f64>,
    pedestrian_distance_m: Option<f64>,
}

/// A place, on the site and on earth.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct At {
    east_m: f64,
    north_m: f64,
    latitude: f64,
    longitude: f64,
}

/// Line of a body to the kit. Fields that are not named here are left alone.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(
    rename_all_fields = "camelCase",
    tag = "type",
    rename_all = "kebab-case"
)]
pub(super) enum FromBody {
    Hello {
        crossguard: u8,
        /// The robot whose body it is, where it knows.
        robot: Option<String>,
    },
    Pose {
        east_m: f64,
        north_m: f64,
        error_m: Option<f64>,
        heading_deg: Option<f64>,
        speed_mps: Option<f64>,
    },
    InPosition {
        id: String,
    },
    Completed {
        id: String,
    },
    Failed {
        id: String,
    },
    FallenBack {
        id: String,
    },
    Fault {
        #[serde(default)]
        text: String,
    },
    Beat,
}

impl At {
    pub(super) fn of(site: &Site, place: Place) -> Self {
        let (latitude, longitude) = site.coordinates(place);
        Self {
            east_m: place.east,
            north_m: place.north,
            latitude,
            longitude,
        }
    }
}

impl Start {
    pub(super) fn new(
        maneuver: Maneuver,
        parameters: &TaskParameters,
        site: &Site,
        holds: bool,
    ) -> Self {
        let to = site.place_of(parameters.target);
        Self {
            id: maneuver.id.to_string(),
            task: maneuver.task.to_string(),
            report: if holds { "in-position" } else { "completed" },
            to: to.map(|place| At::of(site, place)),
            speed_mps: parameters.maximum_speed,
            heading_deg: parameters.heading,
            pedestrian_distance_m: parameters.minimum_pedestrian_distance,
        }
    }
}

pub(super) const fn policy(policy: FallbackPolicy) -> &'static str {
    match policy {
        FallbackPolicy::StopInPlace => "stop-in-place",
        FallbackPolicy::HoldUntilClear => "hold-until-clear",
        FallbackPolicy::GoToSafePosition => "go-to-safe-position",
        FallbackPolicy::EscortToKerb => "escort-to-kerb",
    }
}
