//! Strategies for what the protocol says and what the application adds.

use crossguard_codec::{
    Battery, Capabilities, ConfidenceEllipse, ControlMode, Dimensions, DriveDirection,
    ExecutionStatus, JobRole, Lights, MapPlace, Measurement, PastPosition, Position, PublicSignal,
    RobotCategory, RobotState, SignalMeans, SignalsShown, SlowState, Target, TaskParameters,
    TaskProgression,
};
use crossguard_protocol::*;
use proptest::option;
use proptest::prelude::*;
use proptest::sample::select;

/// Few stations, so that they meet themselves and each other.
pub fn station() -> impl Strategy<Value = StationId> {
    select(vec![
        StationId(0),
        StationId(1),
        StationId(2),
        StationId(3),
        StationId(u32::MAX),
    ])
}

fn number() -> impl Strategy<Value = UniqueNumber> {
    let any = any::<u32>().prop_map(UniqueNumber::from_u32);
    prop_oneof![(0..3_u32).prop_map(UniqueNumber::from_u32), any]
}

fn session() -> impl Strategy<Value = SessionId> {
    (station(), number().prop_map(SessionNumber))
        .prop_map(|(leader, number)| SessionId { leader, number })
}

fn offer() -> impl Strategy<Value = OfferNumber> {
    number().prop_map(OfferNumber)
}

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

fn progress() -> impl Strategy<Value = Progress> {
    prop_oneof![
        select(vec![
            Progress::Executing,
            Progress::InPosition,
            Progress::Completed,
            Progress::SafeIdle
        ]),
        Just(Progress::Failed(Failure::Maneuver)),
        Just(Progress::Failed(Failure::ExecutionLimit)),
        unavailability().prop_map(|why| Progress::Failed(Failure::Unavailable(why))),
    ]
}

fn urgency() -> impl Strategy<Value = Urgency> {
    select(vec![
        Urgency::Low,
        Urgency::Medium,
        Urgency::High,
        Urgency::Emergency,
    ])
}

/// The crossing of a request, which may be unknown.
fn crossing() -> impl Strategy<Value = Place> {
    prop_oneof![
        select(vec![Place::UNKNOWN, Place(1), Place(1 << 16)]),
        any::<u32>().prop_map(Place)
    ]
}

fn coordination() -> impl Strategy<Value = Coordination> {
    let request =
        (urgency(), 0..6_u8, tasks(), crossing()).prop_map(|(urgency, followers, tasks, place)| {
            HelpRequest {
                urgency,
                followers,
                tasks,
                place,
            }
        });
    let day = Millis::MAX_TIMER.0;
    let t_safety = prop_oneof![
        select(vec![0, 1, 2_000, day, day + 1, u32::MAX]),
        any::<u32>(),
        1..=day,
    ];
    let t_safety = t_safety.prop_map(Millis);
    let followers = prop::collection::vec((station(), offer()), 0..=MAX_FOLLOWERS);
    let followers = followers.prop_map(|followers| {
        followers
            .into_iter()
            .map(|(station, offer)| Confirmation { station, offer })
            .collect()
    });
    let report = (any::<u8>(), progress()).prop_map(|(request, progress)| Report {
        request: RequestId(request),
        progress,
    });
    let heartbeat = || any::<u16>().prop_map(Heartbeat);
    prop_oneof![
        Just(Coordination::None),
        (number().prop_map(SessionNumber), heartbeat(), request).prop_map(
            |(number, heartbeat, request)| Coordination::NeedHelp {
                number,
                heartbeat,
                request
            }
        ),
        (session(), offer(), tasks(), heartbeat(), t_safety).prop_map(
            |(session, offer, capabilities, echo, t_safety)| Coordination::OfferHelp {
                session,
                offer,
                capabilities,
                echo,
                t_safety,
            }
        ),
        (
            number().prop_map(SessionNumber),
            heartbeat(),
            followers,
            urgency(),
            crossing(),
            any::<bool>()
        )
            .prop_map(|(number, heartbeat, followers, urgency, place, yields)| {
                Coordination::Leader {
                    number,
                    heartbeat,
                    followers,
                    urgency,
                    place,
                    yields,
                }
            }),
        (session(), heartbeat(), option::of(report)).prop_map(|(session, echo, last)| {
            Coordination::Follower {
                session,
                echo,
                last,
            }
        }),
    ]
}

pub fn ram() -> impl Strategy<Value = Ram> {
    let ending = select(vec![Ending::Completed, Ending::Aborted]);
    let farewell = prop_oneof![
        (number(), ending)
            .prop_map(|(number, ending)| Farewell::Ended(SessionNumber(number), ending)),
        (session(), offer()).prop_map(|(session, offer)| Farewell::Left(session, offer)),
    ];
    (
        station(),
        coordination(),
        option::of(farewell),
        any::<bool>(),
    )
        .prop_map(|(station, coordination, farewell, on_duty)| Ram {
            station,
            coordination,
            farewell,
            on_duty,
        })
}

pub fn command() -> impl Strategy<Value = Command> {
    (session(), station(), any::<u8>(), 0..16_u8).prop_map(|(session, to, request, task)| {
        let task = TaskType::new(task).unwrap();
        Command {
            session,
            to,
            request: RequestId(request),
            task,
        }
    })
}

pub fn answer() -> impl Strategy<Value = Answer> {
    let verdict = prop_oneof![
        Just(Verdict::Accepted),
        Just(Verdict::Rejected(Rejection::UnsupportedTask)),
        Just(Verdict::Rejected(Rejection::OnDuty)),
        unavailability().prop_map(|why| Verdict::Rejected(Rejection::Unavailable(why))),
    ];
    (station(), session(), any::<u8>(), verdict).prop_map(|(from, session, request, verdict)| {
        Answer {
            from,
            session,
            request: RequestId(request),
            verdict,
        }
    })
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

pub fn parameters() -> impl Strategy<Value = TaskParameters> {
    let position = (48.0..49.0, 9.0..10.0, option::of(quantity(-10.0..400.0))).prop_map(
        |(latitude, longitude, altitude)| Target::Position {
            latitude,
            longitude,
            altitude,
        },
    );
    let offset = (-0.02..0.02, -0.01..0.01, option::of(quantity(-10.0..10.0))).prop_map(
        |(latitude, longitude, altitude)| Target::Offset {
            latitude,
            longitude,
            altitude,
        },
    );
    let target = prop_oneof![position, offset, (-2..16_i8).prop_map(Target::Lane)];
    let duration = any::<u32>().prop_map(Millis);
    (
        option::of(target),
        option::of(quantity(0.0..360.0)),
        option::of(quantity(0.0..3.0)),
        option::of(quantity(0.0..10.0)),
        option::of(duration),
    )
        .prop_map(
            |(target, heading, speed, distance, validity)| TaskParameters {
                target,
                heading,
                maximum_speed: speed,
                minimum_pedestrian_distance: distance,
                validity,
                map_place: None,
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
