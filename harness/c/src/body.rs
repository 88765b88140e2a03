//! The body of a robot: plain numbers to the codec's state and back.

use crossguard_codec::{
    Battery, Capabilities, ConfidenceEllipse, ControlMode, Dimensions, Heard, JobRole, Measurement,
    Position, PublicSignal, RobotCategory, RobotState, SignalMeans, SignalsShown, SlowState,
};
use crossguard_protocol::{Decimetres, Input};

use crate::abi::{CrossguardBody, CrossguardHeard, CrossguardMessage};
use crate::place::PlainPlace;
use crate::view::unavailability;

pub(crate) fn known(quantity: f64) -> Option<f64> {
    (!quantity.is_nan()).then_some(quantity)
}

/// The value with this number among all of an enumeration.
fn numbered<E: Copy>(all: &[E], number: u8) -> Option<E> {
    all.get(usize::from(number)).copied()
}

/// The quantity, NaN if it is not known.
pub(crate) fn or_nan(quantity: Option<f64>) -> f64 {
    quantity.unwrap_or(f64::NAN)
}

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
    signal_means: 0,
    to_vehicles: 0,
    to_pedestrians: 0,
    map_kind: PlainPlace::NOWHERE.map_kind,
    has_map_region: PlainPlace::NOWHERE.has_map_region,
    map_region: PlainPlace::NOWHERE.map_region,
    map_id: PlainPlace::NOWHERE.map_id,
};

impl CrossguardHeard {
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
        let slow = sender.slow.as_ref();
        let shown = slow.and_then(|slow| slow.signals);
        let area = PlainPlace::of(slow.and_then(|slow| slow.area));
        Self {
            latitude_deg: or_nan(sender.position.latitude),
            longitude_deg: or_nan(sender.position.longitude),
            heading_deg: value(sender.heading),
            speed_mps: value(sender.speed),
            distance_m: or_nan(distance.map(|distance| f64::from(distance.0) / 10.0)),
            station: heard.from.0,
            message: CrossguardMessage::Ram as u8,
            unavailability: heard.availability.map_or(0, unavailability),
            on_duty: on_duty.into(),
            signal_means: shown.map_or(0, |shown| shown.means.0),
            to_vehicles: shown.map_or(0, |shown| shown.to_vehicles as u8),
            to_pedestrians: shown.map_or(0, |shown| shown.to_pedestrians as u8),
            map_kind: area.map_kind,
            has_map_region: area.has_map_region,
            map_region: area.map_region,
            map_id: area.map_id,
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
        signal_means: 0,
        to_vehicles: 0,
        to_pedestrians: 0,
        map_kind: PlainPlace::NOWHERE.map_kind,
        has_map_region: PlainPlace::NOWHERE.has_map_region,
        map_region: PlainPlace::NOWHERE.map_region,
        map_id: PlainPlace::NOWHERE.map_id,
        reserved: [0; 2],
    };

    /// The state that messages are made of; `None` where a code is none.
    pub(crate) fn to_state(self) -> Option<RobotState> {
        let measured = |quantity| known(quantity).map(Measurement::from);
        let area = PlainPlace {
            map_kind: self.map_kind,
            has_map_region: self.has_map_region,
            map_region: self.map_region,
            map_id: self.map_id,
        };
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
            category: numbered(RobotCategory::ALL, self.category)?,
            job_role: numbered(JobRole::ALL, self.job_role)?,
            battery: Battery {
                state_of_charge: known(self.battery_percent),
                charging: self.charging != 0,
            },
            control_mode: numbered(ControlMode::ALL, self.control_mode)?,
            slow: Some(SlowState {
                capabilities: Capabilities(self.abilities),
                signals: match self.signal_means {
                    0 => None,
                    means @ 1..=15 => Some(SignalsShown {
                        to_vehicles: numbered(PublicSignal::ALL, self.to_vehicles)?,
                        to_pedestrians: numbered(PublicSignal::ALL, self.to_pedestrians)?,
                        means: SignalMeans(means),
                    }),
                    _ => return None,
                },
                area: area.to_codec().ok()?,
                ..SlowState::default()
            }),
            ..RobotState::default()
        })
    }
}

#[cfg(test)]
mod tests {
    use crossguard_codec::{Identifiers, RAM_LEN_MAX, encode_into, ram_from};
    use crossguard_protocol::{Availability, Robot, StationId};

    use super::*;

    #[test]
    fn who_hears_a_robot_knows_what_it_shows_to_people_and_what_it_is_there_for() {
        let body = CrossguardBody {
            signal_means: 0b101,
            to_vehicles: 1,
            to_pedestrians: 3,
            map_kind: 2,
            has_map_region: 1,
            map_region: 276,
            map_id: 4_711,
            ..CrossguardBody::UNKNOWN
        };
        let ids = Identifiers::default();
        let view = Robot::new(StationId(7), 1).ram();
        let heard = |slow| {
            let state = body.to_state().unwrap();
            let ram = ram_from(&ids, &state, &view, Availability::Available, 0, slow).unwrap();
            let mut octets = [0; RAM_LEN_MAX];
            let length = encode_into(&ids, &ram, &mut octets).unwrap();
            let here = Position::default();
            let heard = Heard::of(&ids, StationId(8), &here, &octets[..length]).unwrap();
            let heard = CrossguardHeard::of(&heard);
            let shown = [heard.signal_means, heard.to_vehicles, heard.to_pedestrians];
            let place = (heard.map_kind, heard.has_map_region);
            (shown, place, (heard.map_region, heard.map_id))
        };
        assert_eq!(heard(true), ([0b101, 1, 3], (2, 1), (276, 4_711)));
        assert_eq!(heard(false), ([0, 0, 0], (0, 0), (0, 0)));
    }

    #[test]
    fn signals_that_are_none_are_refused() {
        for (signal_means, to_vehicles, to_pedestrians) in [(16, 0, 0), (1, 4, 0), (1, 0, 4)] {
            let body = CrossguardBody {
                signal_means,
                to_vehicles,
                to_pedestrians,
                ..CrossguardBody::UNKNOWN
            };
            assert_eq!(body.to_state(), None);
        }
        let bridge = CrossguardBody {
            map_kind: 3,
            ..CrossguardBody::UNKNOWN
        };
        assert_eq!(bridge.to_state(), None);
    }
}
