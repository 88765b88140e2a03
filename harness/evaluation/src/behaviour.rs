//! How the stations of a run behave.

use crossguard_endpoint::ras::clustering;
use crossguard_endpoint::ras::surroundings::CLUSTER_INTERVAL_MS;
use serde::{Deserialize, Serialize};

use super::crew::Sessions;
use super::radio::Radio;
use super::vru::{Suppression, Understands, VamRule};

/// How the stations behave. The paper states the power of the radio, and none of the others.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Behaviour {
    /// When a device sends its VAM.
    pub vam: VamRule,
    /// Announcements of a cluster that devices understand.
    pub understands: Understands,
    /// Whether a device has to be perceived to fall silent.
    pub suppression: Suppression,
    /// Share of people with a device, 0..1.
    pub v2x_share: f64,
    /// Share of people that no robot perceives, as if they were hidden all the time, 0..1.
    pub unseen_share: f64,
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
    /// How robots hold sessions, whose messages are on the channel as well; `None` is not at all.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sessions: Option<Sessions>,
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
            suppression: Suppression::default(),
            v2x_share: 1.0,
            unseen_share: 0.0,
            ram_interval_ms: None,
            cluster_vam_interval_ms: CLUSTER_INTERVAL_MS,
            cam_interval_ms: None,
            cam_path_points: 5,
            vehicles_leave_s: None,
            signed: false,
            dcc: false,
            sessions: None,
            clustering: clustering::Settings::default(),
            radio: Radio::default(),
        }
    }
}

impl Behaviour {
    /// The same with devices that fall silent by this rule. The loose rule goes with clusters of everybody in
    /// the zone, however far from each other and whatever their motion.
    #[must_use]
    pub fn with_suppression(self, suppression: Suppression) -> Self {
        let clustering = match suppression {
            Suppression::Strict => self.clustering,
            Suppression::Loose => clustering::Settings {
                spread_m: 200.0,
                speed_difference_mps: 50.0,
                heading_difference_deg: 360.0,
                ..self.clustering
            },
        };
        Self {
            suppression,
            clustering,
            ..self
        }
    }

    /// How many of so many people carry a device: the first ones.
    #[must_use]
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_precision_loss,
        reason = "a share of a few thousand"
    )]
    pub fn devices(&self, people: usize) -> usize {
        (self.v2x_share * people as f64).round() as usize
    }

    /// Whether no robot ever perceives this person, the `number`th from 0. The share is spread evenly.
    #[must_use]
    pub fn is_unseen(&self, number: u32) -> bool {
        let before = |number: u32| (f64::from(number) * self.unseen_share + 1e-9).floor();
        before(number + 1) > before(number)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_share_of_people_that_nobody_perceives_is_spread_evenly() {
        let unseen = |unseen_share| {
            let behaviour = Behaviour {
                unseen_share,
                ..Behaviour::default()
            };
            (0..20)
                .filter(|&it| behaviour.is_unseen(it))
                .collect::<Vec<u32>>()
        };
        assert!(unseen(0.0).is_empty());
        assert_eq!(unseen(0.2), [4, 9, 14, 19]);
        assert_eq!(unseen(1.0).len(), 20);
    }
}
