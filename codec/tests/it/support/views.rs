//! Random values of what the application says of its robot, also quantities that no message can tell.

use std::ops::Range;

use crossguard_codec::core::Source;
use crossguard_codec::{
    Battery, Capabilities, ConfidenceEllipse, ControlMode, Dimensions, DriveDirection,
    ExecutionStatus, JobRole, Lights, MapPlace, Measurement, PastPosition, Position, PublicSignal,
    RobotCategory, RobotState, SignalMeans, SignalsShown, SlowState, TaskParameters,
    TaskProgression,
};
use crossguard_protocol::{Availability, Millis, TaskSet, Unavailability};

use super::core::Random;

/// One of these values.
fn among<T: Copy>(random: &mut Random, all: &[T]) -> T {
    all[random.index(0, all.len() - 1)]
}

fn maybe<T>(random: &mut Random, value: impl FnOnce(&mut Random) -> T) -> Option<T> {
    random.flip().then(|| value(random))
}

fn octet(random: &mut Random) -> u8 {
    random.octets(1)[0]
}

fn number(random: &mut Random) -> u16 {
    u16::from_be_bytes([octet(random), octet(random)])
}

fn within(random: &mut Random, range: &Range<f64>) -> f64 {
    let part = f64::from(number(random)) / f64::from(u16::MAX);
    range.start + (range.end - range.start) * part
}

/// A quantity in a likely range, or one that is out of all ranges.
fn quantity(random: &mut Random, likely: &Range<f64>) -> f64 {
    match random.next() % 9 {
        0 => among(random, &[0.0, -1e9, 1e9, f64::INFINITY, f64::NEG_INFINITY]),
        _ => within(random, likely),
    }
}

fn known(random: &mut Random, likely: Range<f64>) -> Option<f64> {
    maybe(random, |it| quantity(it, &likely))
}

fn measurement(random: &mut Random, likely: Range<f64>) -> Option<Measurement> {
    maybe(random, |it| Measurement {
        value: quantity(it, &likely),
        confidence: known(it, 0.0..2.0),
    })
}

pub fn availability(random: &mut Random) -> Availability {
    let why = [
        Unavailability::LowBattery,
        Unavailability::Teleoperated,
        Unavailability::EmergencyStop,
        Unavailability::LocalFault,
        Unavailability::NotSafe,
    ];
    let why = maybe(random, |it| among(it, &why));
    why.map_or(Availability::Available, Availability::Unavailable)
}

fn position(random: &mut Random) -> Position {
    Position {
        latitude: known(random, 48.0..48.02),
        longitude: known(random, 9.0..9.02),
        altitude: known(random, -10.0..400.0),
        ellipse: maybe(random, |it| ConfidenceEllipse {
            semi_major: quantity(it, &(0.0..50.0)),
            semi_minor: quantity(it, &(0.0..50.0)),
            orientation: quantity(it, &(0.0..360.0)),
        }),
        altitude_confidence: known(random, 0.0..300.0),
    }
}

fn slow_state(random: &mut Random) -> SlowState {
    let past = |random: &mut Random| PastPosition {
        latitude: within(random, &(48.0..48.02)),
        longitude: within(random, &(9.0..9.02)),
        altitude: known(random, -10.0..400.0),
        duration: maybe(random, |it| within(it, &(0.0..9.9))),
    };
    SlowState {
        capabilities: Capabilities(octet(random)),
        supported_tasks: TaskSet(number(random)),
        path: (0..random.index(0, 29)).map(|_| past(random)).collect(),
        lights: maybe(random, |it| Lights(octet(it))),
        signals: maybe(random, |it| SignalsShown {
            to_vehicles: among(it, PublicSignal::ALL),
            to_pedestrians: among(it, PublicSignal::ALL),
            means: SignalMeans(octet(it)),
        }),
        area: maybe(random, place),
    }
}

pub fn state(random: &mut Random) -> RobotState {
    RobotState {
        position: position(random),
        heading: measurement(random, 0.0..360.0),
        speed: measurement(random, 0.0..3.0),
        drive_direction: among(random, DriveDirection::ALL),
        longitudinal_acceleration: measurement(random, -3.0..3.0),
        lateral_acceleration: measurement(random, -3.0..3.0),
        vertical_acceleration: measurement(random, -3.0..3.0),
        curvature: measurement(random, -0.2..0.2),
        yaw_rate: measurement(random, -90.0..90.0),
        orientation: measurement(random, 0.0..360.0),
        dimensions: Dimensions {
            length: known(random, 0.1..2.0),
            width: known(random, 0.1..2.0),
            height: known(random, 0.1..2.0),
        },
        category: among(random, RobotCategory::ALL),
        job_role: among(random, JobRole::ALL),
        task_progression: among(random, TaskProgression::ALL),
        battery: Battery {
            state_of_charge: known(random, 0.0..100.0),
            charging: random.flip(),
        },
        control_mode: among(random, ControlMode::ALL),
        slow: maybe(random, slow_state),
    }
}

/// The parameters at this place of the map.
pub const fn at(map_place: Option<MapPlace>, parameters: TaskParameters) -> TaskParameters {
    TaskParameters {
        map_place,
        ..parameters
    }
}

pub fn place(random: &mut Random) -> MapPlace {
    let (region, id) = (maybe(random, number), number(random));
    if random.flip() {
        MapPlace::RoadSegment { region, id }
    } else {
        MapPlace::Intersection { region, id }
    }
}

pub fn execution(random: &mut Random) -> ExecutionStatus {
    let time = maybe(random, |it| it.integer(0, 86_400_000));
    ExecutionStatus {
        progression: among(random, TaskProgression::ALL),
        time_to_completion: time.map(|ms| Millis(u32::try_from(ms).unwrap())),
    }
}
