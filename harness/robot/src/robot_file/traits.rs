//! Traits of the robot in its robot file: its job, its size and its battery.
//!
//! ```toml
//! build = "wheeled"
//! job = "patrol"
//! dimensions_m = [0.9, 0.6, 1.2] # length, width, height
//!
//! [battery]
//! charge_percent = 64.0
//! charging = false
//! low_percent = 10.0
//! silence_s = 600.0
//! ```

use crossguard_codec::{Battery, Dimensions, JobRole};
use serde::de::IntoDeserializer;
use serde::de::value::{Error as Unknown, StrDeserializer};
use serde::{Deserialize, Deserializer};

use crate::application::Traits;
use crate::located::{Impossible, Number, possible};

/// Largest dimension of a robot in a RAM, in metres.
const METRES_MAX: f64 = 102.2;

/// A job as files name it.
#[derive(Deserialize)]
#[serde(remote = "JobRole", rename_all = "kebab-case")]
enum JobName {
    None,
    TrafficGuard,
    Escort,
    Patrol,
    Delivery,
    Maintenance,
    Other,
}

/// The job that files and operators call so, like `traffic-guard`; `None` if there is none.
#[must_use]
pub fn job_named(name: &str) -> Option<JobRole> {
    let name: StrDeserializer<'_, Unknown> = name.into_deserializer();
    JobName::deserialize(name).ok()
}

/// The job that a file names, if it names one.
pub(super) fn job<'de, D: Deserializer<'de>>(from: D) -> Result<Option<JobRole>, D::Error> {
    JobName::deserialize(from).map(Some)
}

#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(super) struct BatteryTable {
    charge_percent: Option<f64>,
    charging: bool,
    low_percent: Option<f64>,
    silence_s: Option<f64>,
}

/// Why no robot is like that.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum NoTraits {
    /// A number is not possible.
    #[error("[battery] {0}")]
    Number(#[from] Impossible),
    /// It charges, and nobody says how full it is.
    #[error("[battery] 'charging' wants 'charge_percent', too")]
    Charge,
    /// No robot has such a size.
    #[error(
        "dimensions_m has {}: length, width and height in metres, above 0 and at most {METRES_MAX}, are wanted",
        Number(.0)
    )]
    Dimension(f64),
}

pub(super) fn check(
    job: Option<JobRole>,
    dimensions_m: Option<[f64; 3]>,
    battery: &BatteryTable,
) -> Result<Traits, NoTraits> {
    let percent = |field, value| possible(field, value, 0.0..=100.0, "0 to 100");
    let charge = battery
        .charge_percent
        .map(|value| percent("charge_percent", value));
    let charge = charge.transpose()?;
    if battery.charging && charge.is_none() {
        return Err(NoTraits::Charge);
    }
    let impossible = |metres: &f64| !(*metres > 0.0 && *metres <= METRES_MAX);
    if let Some(metres) = dimensions_m.into_iter().flatten().find(impossible) {
        return Err(NoTraits::Dimension(metres));
    }
    let silence_s = battery
        .silence_s
        .map(|value| possible("silence_s", value, 1.0..=86_400.0, "1 to 86400 s"));
    let low = battery.low_percent.unwrap_or(Traits::default().low_percent);
    Ok(Traits {
        job,
        dimensions: dimensions_m.map(|[length, width, height]| Dimensions {
            length: Some(length),
            width: Some(width),
            height: Some(height),
        }),
        battery: charge.map(|charge| Battery {
            state_of_charge: Some(charge),
            charging: battery.charging,
        }),
        low_percent: percent("low_percent", low)?,
        battery_silence_s: silence_s.transpose()?,
    })
}
