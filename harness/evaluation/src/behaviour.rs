//! How the stations of a run behave.

use crossguard_endpoint::ras::clustering;
use crossguard_endpoint::ras::vam::CLUSTER_INTERVAL_MS;
use crossguard_endpoint::ras::vru::{Understands, VamRule};
use serde::{Deserialize, Serialize};

use super::radio::Radio;

/// How the stations behave. The paper states none of these.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Behaviour {
    /// When a device sends its VAM.
    pub vam: VamRule,
    /// What devices understand of a cluster.
    pub understands: Understands,
    /// Share of people with a device, 0..1.
    pub v2x_share: f64,
    /// Interval of RAM in ms; `None` is by the generation rules, once a second for a robot that stands
    /// still.
    pub ram_interval_ms: Option<u64>,
    /// Interval of the cluster VAM in ms that robots send for devices that do not understand RAM.
    pub cluster_vam_interval_ms: u64,
    /// Interval of CAM in ms; `None` is by the generation rules.
    pub cam_interval_ms: Option<u64>,
    /// Points in the path history of a CAM's low-frequency container.
    pub cam_path_points: usize,
    /// How long vehicles are there, in seconds from the beginning; `None` is all the time.
    pub vehicles_leave_s: Option<f64>,
    /// Whether packets are signed.
    pub signed: bool,
    /// Whether the reactive congestion control of TS 102 687 holds stations back.
    pub dcc: bool,
    /// How people around a robot are clustered; its radius is that of the cell.
    pub clustering: clustering::Settings,
    /// The radio channel.
    pub radio: Radio,
}

impl Default for Behaviour {
    fn default() -> Self {
        Self {
            vam: VamRule::Periodic(100),
            understands: Understands::Ram,
            v2x_share: 1.0,
            ram_interval_ms: None,
            cluster_vam_interval_ms: CLUSTER_INTERVAL_MS,
            cam_interval_ms: None,
            cam_path_points: 5,
            vehicles_leave_s: None,
            signed: true,
            dcc: false,
            clustering: clustering::Settings::default(),
            radio: Radio::default(),
        }
    }
}
