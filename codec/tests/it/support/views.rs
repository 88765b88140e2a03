//! Strategies for what the application says of its robot.

use crossguard_codec::{
    Battery, Capabilities, ConfidenceEllipse, ControlMode, Dimensions, DriveDirection,
    ExecutionStatus, JobRole, Lights, MapPlace, Measurement, PastPosition, Position, PublicSignal,
    RobotCategory, RobotState, SignalMeans, SignalsShown, SlowState, TaskParameters,
    TaskProgression,
};
use crossguard_protocol::*;
use proptest::option;
use proptest::prelude::*;
use proptest::sample::select;

fn tasks() -> impl Strategy<Value = TaskSet> {
    any::<u16>().prop_map(TaskSet)
}

fn unavailability() -> impl Strategy<Value = Unavailability> {
    select(vec![
        Unavailability::LowBattery,
        Unavailability::Teleoperated,
        Unavailability::EmergencyStop,
        Unavailability::LocalFault,
        Unavailability::NotSafe,
    ])
}

pub fn availability() -> impl Strategy<Value = Availability> {
    option::of(unavailability())
        .prop_map(|why| why.map_or(Availability::Available, Availability::Unavailable))
}

/// A quantity in a likely range, or one that is out of all ranges.
fn quantity(likely: std::ops::Range<f64>) -> BoxedStrategy<f64> {
    let odd = select(vec![0.0, -1e9, 1e9, f64::INFINITY, f64::NEG_INFINITY]);
    prop_oneof![8 => likely, 1 => odd].boxed()
}

fn measurement(likely: std::ops::Range<f64>) -> impl Strategy<Value = Option<Measurement>> {
    let measurement = (quantity(likely), option::of(quantity(0.0..2.0)))
        .prop_map(|(value, confidence)| Measurement { value, confidence });
    option::of(measurement)
}

pub fn position() -> impl Strategy<Value = Position> {
    let ellipse = (
        quantity(0.0..50.0),
        quantity(0.0..50.0),
        quantity(0.0..360.0),
    );
    let ellipse = ellipse.prop_map(|(semi_major, semi_minor, orientation)| ConfidenceEllipse {
        semi_major,
        semi_minor,
        orientation,
    });
    (
        option::of(quantity(48.0..48.02)),
        option::of(quantity(9.0..9.02)),
        option::of(quantity(-10.0..400.0)),
        option::of(ellipse),
        option::of(quantity(0.0..300.0)),
    )
        .prop_map(
            |(latitude, longitude, altitude, ellipse, altitude_confidence)| Position {
                latitude,
                longitude,
                altitude,
                ellipse,
                altitude_confidence,
            },
        )
}

fn slow_state() -> impl Strategy<Value = SlowState> {
    let past = (
        48.0..48.02,
        9.0..9.02,
        option::of(quantity(-10.0..400.0)),
        option::of(0.0..9.9),
    );
    let past = past.prop_map(|(latitude, longitude, altitude, duration)| PastPosition {
        latitude,
        longitude,
        altitude,
        duration,
    });
    let signal = || {
        select(vec![
            PublicSignal::None,
            PublicSignal::Stop,
            PublicSignal::Go,
            PublicSignal::Caution,
        ])
    };
    let signals =
        (signal(), signal(), any::<u8>()).prop_map(|(vehicles, pedestrians, means)| SignalsShown {
            to_vehicles: vehicles,
            to_pedestrians: pedestrians,
            means: SignalMeans(means),
        });
    let lights = option::of(any::<u8>().prop_map(Lights));
    let path = prop::collection::vec(past, 0..30);
    let shown = (lights, option::of(signals), option::of(place()));
    (any::<u8>(), tasks(), path, shown).prop_map(
        |(capabilities, supported_tasks, path, (lights, signals, area))| SlowState {
            capabilities: Capabilities(capabilities),
            supported_tasks,
            path,
            lights,
            signals,
            area,
        },
    )
}

pub fn progression() -> impl Strategy<Value = TaskProgression> {
    select(vec![
        TaskProgression::Idle,
        TaskProgression::Executing,
        TaskProgression::InPosition,
        TaskProgression::Completed,
        TaskProgression::Failed,
        TaskProgression::SafeIdle,
    ])
}

pub fn state() -> impl Strategy<Value = RobotState> {
    let direction = select(vec![
        DriveDirection::Forward,
        DriveDirection::Backward,
        DriveDirection::Unavailable,
    ]);
    let motion = (
        measurement(0.0..360.0),
        measurement(0.0..3.0),
        direction,
        prop::array::uniform3(measurement(-3.0..3.0)),
        measurement(-0.2..0.2),
        measurement(-90.0..90.0),
        measurement(0.0..360.0),
    );
    let size = prop::array::uniform3(option::of(quantity(0.1..2.0)));
    let kind = (
        select(vec![
            RobotCategory::Humanoid,
            RobotCategory::Quadruped,
            RobotCategory::Other,
        ]),
        select(vec![JobRole::None, JobRole::TrafficGuard, JobRole::Escort]),
        progression(),
        (option::of(quantity(0.0..100.0)), any::<bool>()),
        select(vec![
            ControlMode::Autonomous,
            ControlMode::Teleoperated,
            ControlMode::Fault,
        ]),
    );
    (position(), motion, size, kind, option::of(slow_state())).prop_map(
        |(position, motion, [length, width, height], kind, slow)| RobotState {
            position,
            heading: motion.0,
            speed: motion.1,
            drive_direction: motion.2,
            longitudinal_acceleration: motion.3[0],
            lateral_acceleration: motion.3[1],
            vertical_acceleration: motion.3[2],
            curvature: motion.4,
            yaw_rate: motion.5,
            orientation: motion.6,
            dimensions: Dimensions {
                length,
                width,
                height,
            },
            category: kind.0,
            job_role: kind.1,
            task_progression: kind.2,
            battery: Battery {
                state_of_charge: kind.3.0,
                charging: kind.3.1,
            },
            control_mode: kind.4,
            slow,
        },
    )
}

/// The parameters at this place of the map.
pub const fn at(map_place: Option<MapPlace>, parameters: TaskParameters) -> TaskParameters {
    TaskParameters {
        map_place,
        ..parameters
    }
}

pub fn place() -> impl Strategy<Value = MapPlace> {
    let region = || option::of(any::<u16>());
    prop_oneof![
        (region(), any::<u16>()).prop_map(|(region, id)| MapPlace::RoadSegment { region, id }),
        (region(), any::<u16>()).prop_map(|(region, id)| MapPlace::Intersection { region, id }),
    ]
}

pub fn execution() -> impl Strategy<Value = ExecutionStatus> {
    (progression(), option::of(0..=86_400_000_u32)).prop_map(|(progression, time)| {
        ExecutionStatus {
            progression,
            time_to_completion: time.map(Millis),
        }
    })
}
