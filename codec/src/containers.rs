//! The containers of a RAM that hold the robot's state, from SI units and back.
//!
//! A state that was decoded encodes to containers that decode to it again, so it can be passed on without
//! drifting.

use crate::core::Uper;
use crate::core::cdd::{
    AccelerationComponent, AccelerationConfidence, AccelerationValue, Altitude, AltitudeConfidence,
    AltitudeValue, BasicContainer, Curvature, CurvatureConfidence, CurvatureValue, DeltaAltitude,
    DeltaLatitude, DeltaLongitude, DeltaReferencePosition, ExteriorLights, Latitude, Longitude,
    ObjectDimensionValue, PathDeltaTime, PathPoint, PositionConfidenceEllipse,
    ReferencePositionWithConfidence, SemiAxisLength, Speed, SpeedConfidence, SpeedValue,
    TrafficParticipantType, Wgs84Angle, Wgs84AngleConfidence, Wgs84AngleValue, YawRate,
    YawRateConfidence, YawRateValue,
};
use crate::core::ram::{
    self, BatteryStatus, RobotCapabilities, RobotDimensions, RobotHighFrequencyContainer,
    RobotLowFrequencyContainer, RobotPathHistory, StateOfCharge,
};
use crate::si;
use crate::state::{
    Battery, Capabilities, ConfidenceEllipse, Dimensions, Lights, Measurement, PastPosition,
    Position, RobotState, SignalMeans, SignalsShown, SlowState,
};
use crate::view::MapPlace;
use crate::wire::{class, task_set, tasks_of};

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
    let ellipse = position.ellipse;
    let axis = |metres| SemiAxisLength::saturating(si::SEMI_AXIS.encode(metres));
    let ellipse = PositionConfidenceEllipse {
        semi_major_axis_length: axis(ellipse.map(|ellipse| ellipse.semi_major)),
        semi_minor_axis_length: axis(ellipse.map(|ellipse| ellipse.semi_minor)),
        semi_major_axis_orientation: angle_value(ellipse.map(|ellipse| ellipse.orientation)),
    };
    let altitude = Altitude {
        altitude_value: AltitudeValue::saturating(si::ALTITUDE.encode(position.altitude)),
        altitude_confidence: class(
            &si::ALTITUDE_CONFIDENCE,
            position.altitude_confidence,
            AltitudeConfidence::ALL,
        ),
    };
    BasicContainer {
        station_type: TrafficParticipantType(station_type),
        reference_position: ReferencePositionWithConfidence {
            latitude: Latitude::saturating(si::LATITUDE.encode(position.latitude)),
            longitude: Longitude::saturating(si::longitude(position.longitude)),
            position_confidence_ellipse: ellipse,
            altitude,
        },
    }
}

/// Where the sender of a message with this basic container is. That of a VAM converts to it.
#[must_use]
pub fn position_of(container: &BasicContainer) -> Position {
    let position = &container.reference_position;
    let ellipse = &position.position_confidence_ellipse;
    let ellipse = ellipse_of(
        [
            ellipse.semi_major_axis_length.get(),
            ellipse.semi_minor_axis_length.get(),
        ],
        ellipse.semi_major_axis_orientation.get(),
    );
    let altitude = position.altitude;
    Position {
        latitude: si::LATITUDE.decode(position.latitude.get()),
        longitude: si::longitude_degrees(position.longitude.get()),
        altitude: si::ALTITUDE.decode(altitude.altitude_value.get()),
        ellipse,
        altitude_confidence: si::ALTITUDE_CONFIDENCE.decode(altitude.altitude_confidence as usize),
    }
}

/// The ellipse of two half axes and the direction of the first, as numbers of the wire. Where one of the three is
/// unavailable, the larger half axis counts in every direction.
pub(crate) fn ellipse_of(half_axes: [u16; 2], orientation: u16) -> Option<ConfidenceEllipse> {
    let [first, second] = half_axes.map(|length| si::SEMI_AXIS.decode(length));
    let larger = first.into_iter().chain(second).reduce(f64::max)?;
    let orientation = si::angle_degrees(orientation);
    Some(ConfidenceEllipse {
        semi_major: larger,
        semi_minor: second.filter(|_| orientation.is_some()).unwrap_or(larger),
        orientation: orientation.unwrap_or_default(),
    })
}

fn angle_value(degrees: Option<f64>) -> Wgs84AngleValue {
    Wgs84AngleValue::saturating(si::angle(degrees))
}

fn angle(angle: Option<Measurement>) -> Wgs84Angle {
    let confidence = si::ANGLE_CONFIDENCE.encode(confidence(angle));
    Wgs84Angle {
        value: angle_value(value(angle)),
        confidence: Wgs84AngleConfidence::saturating(confidence),
    }
}

fn angle_of(angle: Wgs84Angle) -> Option<Measurement> {
    let confidence = si::ANGLE_CONFIDENCE.decode(angle.confidence.get());
    measurement(si::angle_degrees(angle.value.get()), confidence)
}

fn acceleration(acceleration: Option<Measurement>) -> AccelerationComponent {
    let number = si::ACCELERATION.encode(value(acceleration));
    let confidence = si::ACCELERATION_CONFIDENCE.encode(confidence(acceleration));
    AccelerationComponent {
        value: AccelerationValue::saturating(number),
        confidence: AccelerationConfidence::saturating(confidence),
    }
}

fn acceleration_of(acceleration: AccelerationComponent) -> Option<Measurement> {
    let confidence = si::ACCELERATION_CONFIDENCE.decode(acceleration.confidence.get());
    measurement(
        si::ACCELERATION.decode(acceleration.value.get()),
        confidence,
    )
}

fn speed(speed: Option<Measurement>) -> Speed {
    let confidence = si::SPEED_CONFIDENCE.encode(confidence(speed));
    Speed {
        speed_value: SpeedValue::saturating(si::SPEED.encode(value(speed))),
        speed_confidence: SpeedConfidence::saturating(confidence),
    }
}

fn speed_of(speed: Speed) -> Option<Measurement> {
    let confidence = si::SPEED_CONFIDENCE.decode(speed.speed_confidence.get());
    measurement(si::SPEED.decode(speed.speed_value.get()), confidence)
}

fn curvature(curvature: Measurement) -> Curvature {
    let number = si::CURVATURE.encode(Some(curvature.value));
    Curvature {
        curvature_value: CurvatureValue::saturating(number),
        curvature_confidence: class(
            &si::CURVATURE_CONFIDENCE,
            curvature.confidence,
            CurvatureConfidence::ALL,
        ),
    }
}

fn curvature_of(curvature: Curvature) -> Option<Measurement> {
    let class = curvature.curvature_confidence as usize;
    measurement(
        si::CURVATURE.decode(curvature.curvature_value.get()),
        si::CURVATURE_CONFIDENCE.decode(class),
    )
}

fn yaw_rate(yaw_rate: Measurement) -> YawRate {
    YawRate {
        yaw_rate_value: YawRateValue::saturating(si::YAW_RATE.encode(Some(yaw_rate.value))),
        yaw_rate_confidence: class(
            &si::YAW_RATE_CONFIDENCE,
            yaw_rate.confidence,
            YawRateConfidence::ALL,
        ),
    }
}

fn yaw_rate_of(yaw_rate: YawRate) -> Option<Measurement> {
    let class = yaw_rate.yaw_rate_confidence as usize;
    measurement(
        si::YAW_RATE.decode(yaw_rate.yaw_rate_value.get()),
        si::YAW_RATE_CONFIDENCE.decode(class),
    )
}

fn dimensions(dimensions: &Dimensions) -> RobotDimensions {
    let dimension = |metres| ObjectDimensionValue::saturating(si::DIMENSION.encode(metres));
    RobotDimensions {
        length: dimension(dimensions.length),
        width: dimension(dimensions.width),
        height: dimension(dimensions.height),
    }
}

fn dimensions_of(dimensions: RobotDimensions) -> Dimensions {
    let dimension = |number: ObjectDimensionValue| si::DIMENSION.decode(number.get());
    Dimensions {
        length: dimension(dimensions.length),
        width: dimension(dimensions.width),
        height: dimension(dimensions.height),
    }
}

pub(crate) fn high_frequency(state: &RobotState) -> RobotHighFrequencyContainer {
    let optional_acceleration =
        |measured: Option<Measurement>| measured.map(|measured| acceleration(Some(measured)));
    RobotHighFrequencyContainer {
        heading: angle(state.heading),
        speed: speed(state.speed),
        drive_direction: state.drive_direction,
        longitudinal_acceleration: acceleration(state.longitudinal_acceleration),
        robot_dimensions: dimensions(&state.dimensions),
        curvature: state.curvature.map(curvature),
        yaw_rate: state.yaw_rate.map(yaw_rate),
        lateral_acceleration: optional_acceleration(state.lateral_acceleration),
        vertical_acceleration: optional_acceleration(state.vertical_acceleration),
        orientation: state
            .orientation
            .map(|orientation| angle(Some(orientation))),
    }
}

/// Adds to `state` what the container says.
pub(crate) fn read_high_frequency(container: &RobotHighFrequencyContainer, state: &mut RobotState) {
    state.heading = angle_of(container.heading);
    state.speed = speed_of(container.speed);
    state.drive_direction = container.drive_direction;
    state.longitudinal_acceleration = acceleration_of(container.longitudinal_acceleration);
    state.lateral_acceleration = container.lateral_acceleration.and_then(acceleration_of);
    state.vertical_acceleration = container.vertical_acceleration.and_then(acceleration_of);
    state.curvature = container.curvature.and_then(curvature_of);
    state.yaw_rate = container.yaw_rate.and_then(yaw_rate_of);
    state.orientation = container.orientation.and_then(angle_of);
    state.dimensions = dimensions_of(container.robot_dimensions);
}

/// The low-frequency container of a robot at `reference`.
pub(crate) fn low_frequency(slow: &SlowState, reference: &Position) -> RobotLowFrequencyContainer {
    RobotLowFrequencyContainer {
        capabilities: RobotCapabilities::new(slow.capabilities.0),
        supported_tasks: task_set(slow.supported_tasks),
        #[cfg(feature = "std")]
        path_history: path_history(&slow.path, reference),
        #[cfg(not(feature = "std"))]
        path_history: path_history(&[], reference),
        exterior_lights: slow.lights.map(|lights| ExteriorLights::new(lights.0)),
        signals_shown: slow.signals.map(|signals| ram::SignalsShown {
            to_vehicles: signals.to_vehicles,
            to_pedestrians: signals.to_pedestrians,
            means: ram::SignalMeans::new(signals.means.0),
        }),
        area_served: slow.area.map(MapPlace::to_wire),
    }
}

#[cfg_attr(not(feature = "std"), expect(unused_variables))]
pub(crate) fn slow_state_of(
    container: &RobotLowFrequencyContainer,
    reference: &Position,
) -> SlowState {
    let lights = container.exterior_lights;
    SlowState {
        capabilities: Capabilities(container.capabilities.bits()),
        supported_tasks: tasks_of(container.supported_tasks),
        #[cfg(feature = "std")]
        path: path_of(&container.path_history, reference),
        lights: lights.map(|lights| Lights(lights.bits())),
        signals: container.signals_shown.map(|signals| SignalsShown {
            to_vehicles: signals.to_vehicles,
            to_pedestrians: signals.to_pedestrians,
            means: SignalMeans(signals.means.bits()),
        }),
        area: container.area_served.map(MapPlace::from_wire),
    }
}

/// A path on the wire: every point relative to the one before it, the first one to the reference
/// position. Both ends count from the positions that the receiver has, so errors do not add up.
fn path_history(path: &[PastPosition], reference: &Position) -> RobotPathHistory {
    let mut before = quantized(reference);
    let points = path.iter().map_while(|past| {
        let point = path_point(past, &before)?;
        before = follow(&point, &before);
        Some(point)
    });
    let points = RobotPathHistory::collect(points.take(RobotPathHistory::CAPACITY));
    // There are no more of them than fit, and none is enough.
    points.unwrap_or(RobotPathHistory::LOWEST)
}

/// The way to `past` from the position `before` it; `None` when that is unknown or too far away.
fn path_point(past: &PastPosition, before: &Position) -> Option<PathPoint> {
    let north = si::DELTA_DEGREES.encode(Some(past.latitude - before.latitude?));
    let east = si::DELTA_DEGREES.encode(Some(past.longitude - before.longitude?));
    if north == si::DELTA_DEGREES.unavailable || east == si::DELTA_DEGREES.unavailable {
        return None;
    }
    let rise = past.altitude.zip(before.altitude);
    let rise = si::DELTA_ALTITUDE.encode(rise.map(|(past, before)| past - before));
    let duration = past
        .duration
        .and_then(|duration| si::PATH_DELTA_TIME.encode(duration));
    Some(PathPoint {
        path_position: DeltaReferencePosition {
            delta_latitude: DeltaLatitude::saturating(north),
            delta_longitude: DeltaLongitude::saturating(east),
            delta_altitude: DeltaAltitude::saturating(rise),
        },
        path_delta_time: duration.map(PathDeltaTime::saturating),
    })
}

#[cfg(feature = "std")]
fn path_of(points: &[PathPoint], reference: &Position) -> Vec<PastPosition> {
    let mut path = Vec::new();
    let mut before = *reference;
    for point in points {
        before = follow(point, &before);
        let (Some(latitude), Some(longitude)) = (before.latitude, before.longitude) else {
            break;
        };
        path.push(PastPosition {
            latitude,
            longitude,
            altitude: before.altitude,
            duration: point
                .path_delta_time
                .map(|time| si::PATH_DELTA_TIME.decode(time.get())),
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
    let north = si::DELTA_DEGREES.decode(delta.delta_latitude.get());
    let east = si::DELTA_DEGREES.decode(delta.delta_longitude.get());
    let rise = si::DELTA_ALTITUDE.decode(delta.delta_altitude.get());
    Position {
        latitude: add(before.latitude, north),
        longitude: add(before.longitude, east),
        altitude: add(before.altitude, rise),
        ..Position::default()
    }
}

pub(crate) fn battery(battery: &Battery) -> BatteryStatus {
    let state_of_charge = si::STATE_OF_CHARGE.encode(battery.state_of_charge);
    BatteryStatus {
        state_of_charge: StateOfCharge::saturating(state_of_charge),
        charging: battery.charging,
    }
}

pub(crate) fn battery_of(battery: BatteryStatus) -> Battery {
    Battery {
        state_of_charge: si::STATE_OF_CHARGE.decode(battery.state_of_charge.get()),
        charging: battery.charging,
    }
}
