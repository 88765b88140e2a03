//! The body of a robot: plain numbers to the codec's state and back.

use crossguard_codec::{
    Battery, Capabilities, ConfidenceEllipse, ControlMode, Dimensions, Heard, JobRole, Measurement,
    Position, RobotCategory, RobotState, SlowState,
};
use crossguard_protocol::{Availability, Decimetres, Input};

use crate::abi::{CrossguardBody, CrossguardHeard, CrossguardMessage};
use crate::why::unavailability;

/// A quantity, if it is known.
pub(crate) fn known(quantity: f64) -> Option<f64> {
    (!quantity.is_nan()).then_some(quantity)
}

/// The quantity, NaN if it is not known.
pub(crate) fn or_nan(quantity: Option<f64>) -> f64 {
    quantity.unwrap_or(f64::NAN)
}

/// Nobody was heard.
pub(crate) const NOBODY: CrossguardHeard = CrossguardHeard {
    latitude_deg: f64::NAN,
    longitude_deg: f64::NAN,
    heading_deg: f64::NAN,
    speed_mps: f64::NAN,
    distance_m: f64::NAN,
    station: 0,
    message: 0,
    unavailability: 0,
    on_duty: 0,
    reserved: [0; 1],
};

impl CrossguardHeard {
    /// Who was heard in a message.
    pub(crate) fn of(heard: &Heard) -> Self {
        let Some(sender) = &heard.state else {
            return Self {
                station: heard.from.0,
                message: CrossguardMessage::Rmcm as u8,
                ..NOBODY
            };
        };
        let value = |quantity: Option<Measurement>| or_nan(quantity.map(|it| it.value));
        let distance = heard.inputs.iter().find_map(|input| match input {
            Input::Ram { distance, .. } if *distance != Decimetres::UNKNOWN => Some(distance),
            _ => None,
        });
        let on_duty = heard.inputs.iter().any(|input| match input {
            Input::Ram { ram, .. } => ram.on_duty,
            _ => false,
        });
        Self {
            latitude_deg: or_nan(sender.position.latitude),
            longitude_deg: or_nan(sender.position.longitude),
            heading_deg: value(sender.heading),
            speed_mps: value(sender.speed),
            distance_m: or_nan(distance.map(|distance| f64::from(distance.0) / 10.0)),
            station: heard.from.0,
            message: CrossguardMessage::Ram as u8,
            unavailability: unavailability(match heard.availability {
                Some(Availability::Unavailable(why)) => Some(why),
                Some(Availability::Available) | None => None,
            }),
            on_duty: on_duty.into(),
            reserved: [0; 1],
        }
    }
}

impl CrossguardBody {
    /// A body that knows nothing of itself, and steers itself.
    pub(crate) const UNKNOWN: Self = Self {
        latitude_deg: f64::NAN,
        longitude_deg: f64::NAN,
        altitude_m: f64::NAN,
        accuracy_m: f64::NAN,
        heading_deg: f64::NAN,
        speed_mps: f64::NAN,
        acceleration_mps2: f64::NAN,
        yaw_rate_dps: f64::NAN,
        orientation_deg: f64::NAN,
        length_m: f64::NAN,
        width_m: f64::NAN,
        height_m: f64::NAN,
        battery_percent: f64::NAN,
        charging: 0,
        category: 0,
        job_role: 0,
        control_mode: 0,
        abilities: 0,
        reserved: [0; 3],
    };

    /// The state that messages are made of; `None` where a code is none.
    pub(crate) fn to_state(self) -> Option<RobotState> {
        let measured = |quantity| known(quantity).map(Measurement::from);
        Some(RobotState {
            position: Position {
                latitude: known(self.latitude_deg),
                longitude: known(self.longitude_deg),
                altitude: known(self.altitude_m),
                ellipse: known(self.accuracy_m).map(|radius| ConfidenceEllipse {
                    semi_major: radius,
                    semi_minor: radius,
                    orientation: 0.0,
                }),
                altitude_confidence: None,
            },
            heading: measured(self.heading_deg),
            speed: measured(self.speed_mps),
            longitudinal_acceleration: measured(self.acceleration_mps2),
            yaw_rate: measured(self.yaw_rate_dps),
            orientation: measured(self.orientation_deg),
            dimensions: Dimensions {
                length: known(self.length_m),
                width: known(self.width_m),
                height: known(self.height_m),
            },
            category: category(self.category)?,
            job_role: job_role(self.job_role)?,
            battery: Battery {
                state_of_charge: known(self.battery_percent),
                charging: self.charging != 0,
            },
            control_mode: control_mode(self.control_mode)?,
            slow: Some(SlowState {
                capabilities: Capabilities(self.abilities),
                ..SlowState::default()
            }),
            ..RobotState::default()
        })
    }
}

fn category(code: u8) -> Option<RobotCategory> {
    Some(match code {
        0 => RobotCategory::Unknown,
        1 => RobotCategory::Humanoid,
        2 => RobotCategory::Quadruped,
        3 => RobotCategory::Wheeled,
        4 => RobotCategory::Tracked,
        5 => RobotCategory::Aerial,
        6 => RobotCategory::Other,
        _ => return None,
    })
}

fn job_role(code: u8) -> Option<JobRole> {
    Some(match code {
        0 => JobRole::None,
        1 => JobRole::TrafficGuard,
        2 => JobRole::Escort,
        3 => JobRole::Patrol,
        4 => JobRole::Delivery,
        5 => JobRole::Maintenance,
        6 => JobRole::Other,
        _ => return None,
    })
}

fn control_mode(code: u8) -> Option<ControlMode> {
    Some(match code {
        0 => ControlMode::Autonomous,
        1 => ControlMode::Teleoperated,
        2 => ControlMode::EmergencyStop,
        3 => ControlMode::Fault,
        4 => ControlMode::Unavailable,
        _ => return None,
    })
}
