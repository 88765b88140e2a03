//! The CAM of a robot, beside its RAM: for stations that do not know RAM (EN 302 637-2 v1.4.1, which has
//! the same bits as TS 103 900 v2.3.1 here).
//!
//! It is that of a vehicle of the station type of robots, without a special role: where the robot is, how
//! it moves and how large it is. Its work for people stands in its RAM alone.

use crossguard_codec::asn1::cam::{
    BasicVehicleContainerHighFrequency, BasicVehicleContainerLowFrequency, CAM, CamParameters,
    CamPayload, Heading, HeadingConfidence, HighFrequencyContainer, LowFrequencyContainer,
    VehicleLength, VehicleLengthConfidenceIndication, VehicleLengthValue, VehicleRole,
};
use crossguard_codec::asn1::cdd::{
    Curvature, CurvatureCalculationMode, CurvatureConfidence, CurvatureValue, ExteriorLights,
    HeadingValue, ObjectDimensionValue, PathHistory, VehicleWidth, YawRate, YawRateConfidence,
    YawRateValue,
};
use crossguard_codec::asn1::ram::{RobotHighFrequencyContainer, RobotLowFrequencyContainer};
use crossguard_codec::{DriveDirection, Identifiers, Position, RobotState, encode};

use super::etsi::{NotMade, awareness, header};
use super::generation::{Cadence, Limits, LowFrequency, Trigger};
use super::motion::{Change, Plane};

/// `ObjectDimensionValue` of a dimension that nobody knows.
const DIMENSION_UNAVAILABLE: u16 = 256;
/// `ObjectDimensionValue` of a dimension that is larger than it can say.
const DIMENSION_OUT_OF_RANGE: u16 = 255;
/// `VehicleLengthValue` of such a length.
const LENGTH_OUT_OF_RANGE: u16 = 1_022;
/// `VehicleLengthValue` of a length that nobody knows.
const LENGTH_UNAVAILABLE: u16 = 1_023;
/// `VehicleWidth` of more than 6.0 m.
const WIDTH_OUT_OF_RANGE: u8 = 61;
/// `VehicleWidth` of a width that nobody knows.
const WIDTH_UNAVAILABLE: u8 = 62;

/// When the CAM of one robot are sent: the generation rules of EN 302 637-2, clause 6.1.3.
#[derive(Clone, Debug, Default)]
pub struct CamGeneration {
    cadence: Cadence,
    low_frequency: LowFrequency,
    /// State in the last CAM.
    said: RobotState,
}

impl CamGeneration {
    /// Why a CAM is due at `now_ms` from a robot in `state`, and whether the low-frequency container goes along; it counts
    /// as sent then. Congestion control says that two are at least `congestion_ms` apart. A robot that does not know
    /// where it is sends none.
    pub fn poll(
        &mut self,
        now_ms: u64,
        congestion_ms: u64,
        state: &RobotState,
    ) -> Option<(Trigger, bool)> {
        Plane::around(&state.position)?;
        let limits = Limits {
            congestion_ms,
            ..Limits::default()
        };
        let change = Change::of_robot(&self.said, state);
        let trigger = self.cadence.trigger(now_ms, limits, &change)?;
        let low_frequency = self.low_frequency.is_due(now_ms);
        self.cadence.sent(now_ms, trigger);
        if low_frequency {
            self.low_frequency.sent(now_ms);
        }
        self.said.clone_from(state);
        Some((trigger, low_frequency))
    }
}

/// The octets of the CAM of `station`, a robot in `state`. `now_ms` is the time of its position in
/// `TimestampIts`.
///
/// # Errors
/// When the message cannot be encoded.
pub fn cam(
    ids: &Identifiers,
    station: u32,
    state: &RobotState,
    now_ms: u64,
    with_low_frequency: bool,
) -> Result<Vec<u8>, NotMade> {
    let at_front = RobotState {
        position: front(state).unwrap_or(state.position),
        ..state.clone()
    };
    let shared = awareness(ids, station, &at_front, now_ms, with_low_frequency, |_| {})?;
    let parameters = shared.ram_parameters;
    let low_frequency = with_low_frequency
        .then(|| slow_container(parameters.robot_low_frequency_container))
        .map(LowFrequencyContainer::basicVehicleContainerLowFrequency);
    let parameters = CamParameters::new(
        parameters.basic_container,
        HighFrequencyContainer::basicVehicleContainerHighFrequency(fast_container(
            parameters.robot_high_frequency_container,
        )),
        low_frequency,
        None,
        None,
    );
    let payload = CamPayload::new(shared.generation_delta_time, parameters);
    Ok(encode(
        ids,
        &CAM::new(header::<CAM>(ids, station), payload),
    )?)
}

/// Where a CAM says that the robot is: at the middle of the front of its box (EN 302 637-2, annex B), whose
/// own middle is the position of the state. `None` where length or direction are not known.
fn front(state: &RobotState) -> Option<Position> {
    let of_motion = state.heading.map(|heading| match state.drive_direction {
        DriveDirection::Backward => heading.value + 180.0,
        DriveDirection::Forward | DriveDirection::Unavailable => heading.value,
    });
    let of_body = state.orientation.map(|orientation| orientation.value);
    let (sine, cosine) = of_body.or(of_motion)?.to_radians().sin_cos();
    let ahead_m = state.dimensions.length? / 2.0;
    let plane = Plane::around(&state.position)?;
    let there = plane.position([ahead_m * sine, ahead_m * cosine]);
    Some(Position {
        latitude: there.latitude,
        longitude: there.longitude,
        ..state.position
    })
}

/// How it moves, and how large it is. How the curvature was calculated is not known.
fn fast_container(motion: RobotHighFrequencyContainer) -> BasicVehicleContainerHighFrequency {
    let heading = motion.heading;
    let unknown_curvature =
        || Curvature::new(CurvatureValue(1_023), CurvatureConfidence::unavailable);
    let unknown_yaw_rate = || YawRate::new(YawRateValue(32_767), YawRateConfidence::unavailable);
    BasicVehicleContainerHighFrequency::new(
        Heading::new(
            HeadingValue(heading.value.0),
            HeadingConfidence(heading.confidence.0),
        ),
        motion.speed,
        motion.drive_direction,
        length(&motion.robot_dimensions.length),
        width(&motion.robot_dimensions.width),
        motion.longitudinal_acceleration,
        motion.curvature.unwrap_or_else(unknown_curvature),
        CurvatureCalculationMode::unavailable,
        motion.yaw_rate.unwrap_or_else(unknown_yaw_rate),
        None,
        None,
        None,
        motion.lateral_acceleration,
        motion.vertical_acceleration,
        None,
        None,
    )
}

/// In 0.1 m, as the dimension is.
fn length(dimension: &ObjectDimensionValue) -> VehicleLength {
    use VehicleLengthConfidenceIndication as Indication;
    let (value, indication) = match dimension.0 {
        DIMENSION_UNAVAILABLE.. => (LENGTH_UNAVAILABLE, Indication::unavailable),
        DIMENSION_OUT_OF_RANGE => (LENGTH_OUT_OF_RANGE, Indication::noTrailerPresent),
        value => (value, Indication::noTrailerPresent),
    };
    VehicleLength::new(VehicleLengthValue(value), indication)
}

/// In 0.1 m, as the dimension is.
fn width(dimension: &ObjectDimensionValue) -> VehicleWidth {
    let value = u8::try_from(dimension.0).unwrap_or(u8::MAX);
    VehicleWidth(match dimension.0 {
        DIMENSION_UNAVAILABLE.. => WIDTH_UNAVAILABLE,
        _ => value.min(WIDTH_OUT_OF_RANGE),
    })
}

/// No special role, lights, and where it came from. Lights that a robot does not have are off.
#[expect(
    clippy::default_trait_access,
    reason = "bits without a name in this crate"
)]
fn slow_container(slow: Option<RobotLowFrequencyContainer>) -> BasicVehicleContainerLowFrequency {
    let (lights, path) = slow.map_or_else(Default::default, |slow| {
        (slow.exterior_lights, slow.path_history)
    });
    let lights = lights.unwrap_or_else(|| ExteriorLights(Default::default()));
    BasicVehicleContainerLowFrequency::new(VehicleRole::default, lights, PathHistory(path))
}

#[cfg(test)]
mod tests {
    use crossguard_codec::its::ItsMessage;
    use crossguard_codec::{
        Dimensions, Kind, Lights, Measurement, PastPosition, SlowState, distance, golden,
    };
    use crossguard_protocol::Decimetres;

    use super::super::etsi::golden_position;

    use super::*;

    const fn measurement(value: f64, confidence: f64) -> Measurement {
        Measurement {
            value,
            confidence: Some(confidence),
        }
    }

    /// The passenger car of the golden vectors of CAM (`codec/tests/golden/its.txt`) as a robot. It is the
    /// box around its reference point that is missing, since that stands at the front.
    fn golden_state() -> RobotState {
        let past = |latitude, longitude, altitude, duration| PastPosition {
            latitude,
            longitude,
            altitude,
            duration,
        };
        RobotState {
            position: golden_position(),
            heading: Some(measurement(90.0, 1.0)),
            speed: Some(measurement(13.89, 0.5)),
            drive_direction: DriveDirection::Forward,
            longitudinal_acceleration: Some(0.3.into()),
            curvature: Some(0.0.into()),
            yaw_rate: Some(0.0.into()),
            slow: Some(SlowState {
                lights: Some(Lights::LOW_BEAM),
                path: vec![
                    past(48.765_422_1, 9.123_476_7, Some(260.0), Some(0.5)),
                    past(48.765_411_1, 9.123_497_7, None, None),
                ],
                ..SlowState::default()
            }),
            ..RobotState::default()
        }
    }

    fn ids() -> Identifiers {
        Identifiers {
            robot_station_type: 5,
            ..Identifiers::default()
        }
    }

    fn made(state: &RobotState, with_low_frequency: bool) -> CAM {
        let octets = cam(&ids(), 123_456_789, state, 12_345, with_low_frequency).unwrap();
        match ItsMessage::decode(&ids(), &octets).unwrap().message {
            ItsMessage::Cam(cam) => *cam,
            other => panic!("{other:?}"),
        }
    }

    /// Everything that a robot says is as in the vectors that two other encoders agree on; what the car of
    /// the vectors says besides is put in.
    #[test]
    fn a_cam_has_the_octets_of_the_golden_vectors() {
        for (name, with_low_frequency) in [("C1", false), ("C2", true)] {
            let mut cam = made(&golden_state(), with_low_frequency);
            let parameters = &mut cam.cam.cam_parameters;
            let HighFrequencyContainer::basicVehicleContainerHighFrequency(motion) =
                &mut parameters.high_frequency_container
            else {
                panic!("that of a vehicle")
            };
            assert_eq!(motion.vehicle_length.vehicle_length_value.0, 1_023);
            assert_eq!(motion.vehicle_width.0, 62);
            motion.vehicle_length = length(&ObjectDimensionValue(42));
            motion.vehicle_width = width(&ObjectDimensionValue(18));
            motion.curvature_calculation_mode = CurvatureCalculationMode::yawRateUsed;
            let octets = encode(&ids(), &cam).unwrap();
            assert_eq!(hex::encode(octets), golden::vector(golden::ITS, name));
        }
    }

    #[test]
    fn dimensions_that_nobody_knows_or_can_say_are_said_to_be_so() {
        let lengths =
            [1, 254, 255, 256].map(|it| length(&ObjectDimensionValue(it)).vehicle_length_value.0);
        assert_eq!(lengths, [1, 254, 1_022, 1_023]);
        let widths = [1, 60, 61, 254, 255, 256].map(|it| width(&ObjectDimensionValue(it)).0);
        assert_eq!(widths, [1, 60, 61, 61, 61, 62]);
    }

    #[test]
    fn the_position_of_a_cam_is_the_front_of_the_robot() {
        let state = RobotState {
            position: Position::at(49.0, 8.4),
            heading: Some(90.0.into()),
            drive_direction: DriveDirection::Forward,
            dimensions: Dimensions {
                length: Some(2.0),
                ..Dimensions::default()
            },
            ..RobotState::default()
        };
        let longitude = |state: &RobotState| {
            let cam = ItsMessage::Cam(Box::new(made(state, false)));
            let user = cam.road_users(12_345)[0];
            assert_eq!(user.kind, Kind::Vehicle);
            assert_eq!(distance(&state.position, &user.position), Decimetres(10));
            user.position.longitude.unwrap()
        };
        assert!(longitude(&state) > 8.4);
        let backing = RobotState {
            drive_direction: DriveDirection::Backward,
            ..state.clone()
        };
        assert!(longitude(&backing) < 8.4);
        let sideways = RobotState {
            orientation: Some(270.0.into()),
            ..state
        };
        assert!(longitude(&sideways) < 8.4);
    }

    #[test]
    fn cam_come_by_the_rules_and_the_slow_container_every_half_second() {
        let mut generation = CamGeneration::default();
        let standing = RobotState {
            position: Position::at(49.0, 8.4),
            speed: Some(0.0.into()),
            ..RobotState::default()
        };
        let walking = RobotState {
            speed: Some(1.0.into()),
            ..standing.clone()
        };
        let mut sent = Vec::new();
        for now_ms in (0..3_000).step_by(50) {
            let state = if now_ms < 1_200 { &standing } else { &walking };
            if let Some((trigger, low_frequency)) = generation.poll(now_ms, 0, state) {
                sent.push((now_ms, trigger, low_frequency));
            }
        }
        let expected = [
            (0, Trigger::First, true),
            (1_000, Trigger::Interval, true),
            // It set off 200 ms after the last one; that interval is kept for three messages.
            (1_200, Trigger::Speed, false),
            (1_400, Trigger::Interval, false),
            (1_600, Trigger::Interval, true),
            (1_800, Trigger::Interval, false),
            (2_800, Trigger::Interval, true),
        ];
        assert_eq!(sent, expected);
    }

    #[test]
    fn a_robot_that_does_not_know_where_it_is_sends_no_cam() {
        let mut generation = CamGeneration::default();
        assert_eq!(generation.poll(0, 0, &RobotState::default()), None);
        let found = RobotState {
            position: Position::at(49.0, 8.4),
            ..RobotState::default()
        };
        let (first, _) = generation.poll(5_000, 0, &found).unwrap();
        assert_eq!(first, Trigger::First);
    }

    #[test]
    fn congestion_control_holds_cam_back() {
        let mut generation = CamGeneration::default();
        let state = |speed: f64| RobotState {
            position: Position::at(49.0, 8.4),
            speed: Some(speed.into()),
            ..RobotState::default()
        };
        assert!(generation.poll(0, 400, &state(0.0)).is_some());
        assert_eq!(generation.poll(399, 400, &state(2.0)), None);
        let (late, _) = generation.poll(400, 400, &state(2.0)).unwrap();
        assert_eq!(late, Trigger::Speed);
    }
}
