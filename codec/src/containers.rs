//! The containers of a RAM that hold the robot's state, from SI units and back.
//!
//! Encoding what was decoded gives the same containers again, so a state can be passed on without
//! drifting.

use rasn::types::Integer;

use crate::asn1::cdd::{
    AccelerationComponent, AccelerationConfidence, AccelerationValue, Altitude, AltitudeValue,
    BasicContainer, Curvature, CurvatureValue, DeltaAltitude, DeltaLatitude, DeltaLongitude,
    DeltaReferencePosition, ExteriorLights, Latitude, Longitude, ObjectDimensionValue,
    PathDeltaTime, PathPoint, PositionConfidenceEllipse, ReferencePositionWithConfidence,
    SemiAxisLength, Speed, SpeedConfidence, SpeedValue, TrafficParticipantType, Wgs84Angle,
    Wgs84AngleConfidence, Wgs84AngleValue, YawRate, YawRateValue,
};
use crate::asn1::ram;
use crate::si;
use crate::state::{
    Battery, Capabilities, ConfidenceEllipse, Dimensions, Lights, Measurement, PastPosition,
    Position, RobotState, SignalMeans, SignalsShown, SlowState,
};
use crate::wire::{bits8, class, half_width, set8, task_set, tasks_of};

/// How many points the path history of the low-frequency container has at most.
const PATH_MAX: usize = 23;

fn value(measurement: Option<Measurement>) -> Option<f64> {
    measurement.map(|measurement| measurement.value)
}

fn confidence(measurement: Option<Measurement>) -> Option<f64> {
    measurement.and_then(|measurement| measurement.confidence)
}

fn measurement(value: Option<f64>, confidence: Option<f64>) -> Option<Measurement> {
    value.map(|value| Measurement { value, confidence })
}

/// The basic container of a robot at `position`.
pub(crate) fn basic_container(station_type: u8, position: &Position) -> BasicContainer {
    let unavailable = PositionConfidenceEllipse::new(
        SemiAxisLength(si::SEMI_AXIS.unavailable),
        SemiAxisLength(si::SEMI_AXIS.unavailable),
        Wgs84AngleValue(si::angle(None)),
    );
    let ellipse = position.ellipse.map_or(unavailable, |ellipse| {
        PositionConfidenceEllipse::new(
            SemiAxisLength(si::SEMI_AXIS.encode(Some(ellipse.semi_major))),
            SemiAxisLength(si::SEMI_AXIS.encode(Some(ellipse.semi_minor))),
            Wgs84AngleValue(si::angle(Some(ellipse.orientation))),
        )
    });
    let altitude = Altitude::new(
        AltitudeValue(si::ALTITUDE.encode(position.altitude)),
        class(&si::ALTITUDE_CONFIDENCE, position.altitude_confidence),
    );
    let reference_position = ReferencePositionWithConfidence::new(
        Latitude(si::LATITUDE.encode(position.latitude)),
        Longitude(si::longitude(position.longitude)),
        ellipse,
        altitude,
    );
    BasicContainer::new(TrafficParticipantType(station_type), reference_position)
}

/// Where the sender of a message with this basic container is: a RAM, an RMCM or a VAM.
#[must_use]
pub fn position_of(container: &BasicContainer) -> Position {
    let position = &container.reference_position;
    let ellipse = &position.position_confidence_ellipse;
    let ellipse = (|| {
        Some(ConfidenceEllipse {
            semi_major: si::SEMI_AXIS.decode(ellipse.semi_major_axis_length.0)?,
            semi_minor: si::SEMI_AXIS.decode(ellipse.semi_minor_axis_length.0)?,
            orientation: si::angle_degrees(ellipse.semi_major_axis_orientation.0)?,
        })
    })();
    Position {
        latitude: si::LATITUDE.decode(position.latitude.0),
        longitude: si::longitude_degrees(position.longitude.0),
        altitude: si::ALTITUDE.decode(position.altitude.altitude_value.0),
        ellipse,
        altitude_confidence: half_width(
            &si::ALTITUDE_CONFIDENCE,
            position.altitude.altitude_confidence,
        ),
    }
}

fn angle(angle: Option<Measurement>) -> Wgs84Angle {
    Wgs84Angle::new(
        Wgs84AngleValue(si::angle(value(angle))),
        Wgs84AngleConfidence(si::ANGLE_CONFIDENCE.encode(confidence(angle))),
    )
}

fn angle_of(angle: &Wgs84Angle) -> Option<Measurement> {
    let confidence = si::ANGLE_CONFIDENCE.decode(angle.confidence.0);
    measurement(si::angle_degrees(angle.value.0), confidence)
}

fn acceleration(acceleration: Option<Measurement>) -> AccelerationComponent {
    AccelerationComponent::new(
        AccelerationValue(si::ACCELERATION.encode(value(acceleration))),
        AccelerationConfidence(si::ACCELERATION_CONFIDENCE.encode(confidence(acceleration))),
    )
}

fn acceleration_of(acceleration: &AccelerationComponent) -> Option<Measurement> {
    let confidence = si::ACCELERATION_CONFIDENCE.decode(acceleration.confidence.0);
    measurement(si::ACCELERATION.decode(acceleration.value.0), confidence)
}

pub(crate) fn high_frequency(state: &RobotState) -> ram::RobotHighFrequencyContainer {
    let speed = Speed::new(
        SpeedValue(si::SPEED.encode(value(state.speed))),
        SpeedConfidence(si::SPEED_CONFIDENCE.encode(confidence(state.speed))),
    );
    let dimension = |metres| ObjectDimensionValue(si::DIMENSION.encode(metres));
    let dimensions = ram::RobotDimensions::new(
        dimension(state.dimensions.length),
        dimension(state.dimensions.width),
        dimension(state.dimensions.height),
    );
    let curvature = state.curvature.map(|curvature| {
        Curvature::new(
            CurvatureValue(si::CURVATURE.encode(Some(curvature.value))),
            class(&si::CURVATURE_CONFIDENCE, curvature.confidence),
        )
    });
    let yaw_rate = state.yaw_rate.map(|yaw_rate| {
        YawRate::new(
            YawRateValue(si::YAW_RATE.encode(Some(yaw_rate.value))),
            class(&si::YAW_RATE_CONFIDENCE, yaw_rate.confidence),
        )
    });
    ram::RobotHighFrequencyContainer::new(
        angle(state.heading),
        speed,
        state.drive_direction.to_wire(),
        acceleration(state.longitudinal_acceleration),
        dimensions,
        curvature,
        yaw_rate,
        state
            .lateral_acceleration
            .map(|lateral| acceleration(Some(lateral))),
        state
            .vertical_acceleration
            .map(|vertical| acceleration(Some(vertical))),
        state
            .orientation
            .map(|orientation| angle(Some(orientation))),
    )
}

/// Adds to `state` what the container says.
pub(crate) fn read_high_frequency(
    container: &ram::RobotHighFrequencyContainer,
    state: &mut RobotState,
) {
    let dimension = |metres: &ObjectDimensionValue| si::DIMENSION.decode(metres.0);
    let speed = &container.speed;
    state.heading = angle_of(&container.heading);
    state.speed = measurement(
        si::SPEED.decode(speed.speed_value.0),
        si::SPEED_CONFIDENCE.decode(speed.speed_confidence.0),
    );
    state.drive_direction = crate::state::DriveDirection::from_wire(container.drive_direction);
    state.longitudinal_acceleration = acceleration_of(&container.longitudinal_acceleration);
    state.lateral_acceleration = container
        .lateral_acceleration
        .as_ref()
        .and_then(acceleration_of);
    state.vertical_acceleration = container
        .vertical_acceleration
        .as_ref()
        .and_then(acceleration_of);
    state.curvature = container.curvature.as_ref().and_then(|curvature| {
        measurement(
            si::CURVATURE.decode(curvature.curvature_value.0),
            half_width(&si::CURVATURE_CONFIDENCE, curvature.curvature_confidence),
        )
    });
    state.yaw_rate = container.yaw_rate.as_ref().and_then(|yaw_rate| {
        measurement(
            si::YAW_RATE.decode(yaw_rate.yaw_rate_value.0),
            half_width(&si::YAW_RATE_CONFIDENCE, yaw_rate.yaw_rate_confidence),
        )
    });
    state.orientation = container.orientation.as_ref().and_then(angle_of);
    state.dimensions = Dimensions {
        length: dimension(&container.robot_dimensions.length),
        width: dimension(&container.robot_dimensions.width),
        height: dimension(&container.robot_dimensions.height),
    };
}

/// The low-frequency container of a robot at `reference`.
pub(crate) fn low_frequency(
    slow: &SlowState,
    reference: &Position,
) -> ram::RobotLowFrequencyContainer {
    let signals = slow.signals.map(|signals| {
        ram::SignalsShown::new(
            signals.to_vehicles.to_wire(),
            signals.to_pedestrians.to_wire(),
            ram::SignalMeans(bits8(signals.means.0)),
        )
    });
    ram::RobotLowFrequencyContainer::new(
        ram::RobotCapabilities(bits8(slow.capabilities.0)),
        task_set(slow.supported_tasks),
        path_history(&slow.path, reference),
        slow.lights.map(|lights| ExteriorLights(bits8(lights.0))),
        signals,
    )
}

pub(crate) fn slow_state_of(
    container: &ram::RobotLowFrequencyContainer,
    reference: &Position,
) -> SlowState {
    let signals = container
        .signals_shown
        .as_ref()
        .map(|signals| SignalsShown {
            to_vehicles: crate::state::PublicSignal::from_wire(signals.to_vehicles),
            to_pedestrians: crate::state::PublicSignal::from_wire(signals.to_pedestrians),
            means: SignalMeans(set8(signals.means.0)),
        });
    SlowState {
        capabilities: Capabilities(set8(container.capabilities.0)),
        supported_tasks: tasks_of(&container.supported_tasks),
        path: path_of(&container.path_history, reference),
        lights: container
            .exterior_lights
            .as_ref()
            .map(|lights| Lights(set8(lights.0))),
        signals,
    }
}

/// A path on the wire: every point relative to the one before it, the first one to the reference
/// position. Both ends count from the positions that the receiver has, so errors do not add up.
fn path_history(path: &[PastPosition], reference: &Position) -> Vec<PathPoint> {
    let mut points = Vec::new();
    let mut before = quantized(reference);
    for past in path.iter().take(PATH_MAX) {
        let (Some(latitude), Some(longitude)) = (before.latitude, before.longitude) else {
            break;
        };
        let north = si::DELTA_DEGREES.encode(Some(past.latitude - latitude));
        let east = si::DELTA_DEGREES.encode(Some(past.longitude - longitude));
        if north == si::DELTA_DEGREES.unavailable || east == si::DELTA_DEGREES.unavailable {
            break;
        }
        let rise = past
            .altitude
            .zip(before.altitude)
            .map(|(past, before)| past - before);
        let duration = past
            .duration
            .and_then(|duration| si::PATH_DELTA_TIME.encode(duration));
        let point = PathPoint::new(
            DeltaReferencePosition::new(
                DeltaLatitude(north),
                DeltaLongitude(east),
                DeltaAltitude(si::DELTA_ALTITUDE.encode(rise)),
            ),
            duration.map(|duration| PathDeltaTime(Integer::from(duration))),
        );
        before = follow(&point, &before);
        points.push(point);
    }
    points
}

fn path_of(points: &[PathPoint], reference: &Position) -> Vec<PastPosition> {
    let mut path = Vec::new();
    let mut before = *reference;
    for point in points {
        before = follow(point, &before);
        let (Some(latitude), Some(longitude)) = (before.latitude, before.longitude) else {
            break;
        };
        let duration = point.path_delta_time.as_ref();
        let duration = duration.and_then(|time| u16::try_from(&time.0).ok());
        path.push(PastPosition {
            latitude,
            longitude,
            altitude: before.altitude,
            duration: duration.map(|time| si::PATH_DELTA_TIME.decode(time)),
        });
    }
    path
}

/// The position as its receiver has it.
fn quantized(position: &Position) -> Position {
    position_of(&basic_container(0, position))
}

/// The position that `point` leads to from `before`.
fn follow(point: &PathPoint, before: &Position) -> Position {
    let delta = &point.path_position;
    let add = |base: Option<f64>, delta: Option<f64>| base.zip(delta).map(|(a, b)| a + b);
    let north = si::DELTA_DEGREES.decode(delta.delta_latitude.0);
    let east = si::DELTA_DEGREES.decode(delta.delta_longitude.0);
    let rise = si::DELTA_ALTITUDE.decode(delta.delta_altitude.0);
    Position {
        latitude: add(before.latitude, north),
        longitude: add(before.longitude, east),
        altitude: add(before.altitude, rise),
        ..Position::default()
    }
}

pub(crate) fn battery(battery: &Battery) -> ram::BatteryStatus {
    let state_of_charge = si::STATE_OF_CHARGE.encode(battery.state_of_charge);
    ram::BatteryStatus::new(ram::StateOfCharge(state_of_charge), battery.charging)
}

pub(crate) fn battery_of(battery: &ram::BatteryStatus) -> Battery {
    Battery {
        state_of_charge: si::STATE_OF_CHARGE.decode(battery.state_of_charge.0),
        charging: battery.charging,
    }
}
