//! Typical and largest messages.

use crossguard_codec::core::cdd::{
    AccelerationChange, AccelerationChangeIndication, CardinalNumber1B, CartesianCoordinate,
    CartesianPosition3d, DeltaAltitude, DeltaLatitude, DeltaLongitude, DeltaReferencePosition,
    DeltaTimeSecond, DeltaTimeTenthOfSecond, HeadingChangeIndication, HeadingValue, Identifier1B,
    PathDeltaTime, PathDeltaTimeChoice, PathHistory, PathPoint, PathPointPredicted, PathPredicted,
    PolygonCorners, PolygonalShape, PosConfidenceEllipse, SafeDistanceIndication, SemiAxisLength,
    SequenceOfSafeDistanceIndication, SequenceOfTrajectoryInterceptionIndication, Shape,
    StabilityChangeIndication, StabilityLossProbability, StandardLength9b, StandardLength12b,
    StationId as WireStationId, TrajectoryInterceptionConfidence, TrajectoryInterceptionIndication,
    TrajectoryInterceptionProbability, TurningDirection, VruClusterInformation, VruClusterProfiles,
};
use crossguard_codec::core::ram::RAM;
use crossguard_codec::core::rmcm::RMCM;
use crossguard_codec::core::vam::{VruClusterInformationContainer, VruMotionPredictionContainer};
use crossguard_codec::core::{Uper, cdd, common, ram};
use crossguard_codec::{
    Battery, Capabilities, ConfidenceEllipse, ControlMode, Dimensions, DriveDirection, Identifiers,
    JobRole, Lights, MapPlace, Measurement, Message, PATH_HISTORY_MAX, PATH_PREDICTION_MAX,
    PastPosition, Position, PublicSignal, RobotCategory, RobotState, SignalMeans, SignalsShown,
    SlowState, Target, TaskParameters, TaskProgression, ram_from, rmcm_from_answer,
    rmcm_from_commands,
};
use crossguard_protocol::{
    Answer, Availability, Command, Confirmation, Coordination, Ending, Failure, Farewell,
    Heartbeat, HelpRequest, Millis, OfferNumber, Place, Progress, Ram, Rejection, Report,
    RequestId, SessionId, SessionNumber, StationId, TaskSet, TaskType, Unavailability,
    UniqueNumber, Urgency, Verdict,
};

pub const LEADER: StationId = StationId(123_456_789);
pub const FOLLOWER: StationId = StationId(987_654_321);
pub const GENERATION_DELTA_TIME: u16 = 12_345;

pub fn number(boot: u16, count: u16) -> UniqueNumber {
    UniqueNumber { boot, count }
}

/// The session of [`LEADER`].
pub fn session() -> SessionId {
    SessionId {
        leader: LEADER,
        number: SessionNumber(number(5, 2)),
    }
}

pub fn measurement(value: f64, confidence: f64) -> Measurement {
    let confidence = Some(confidence);
    Measurement { value, confidence }
}

pub fn position() -> Position {
    Position {
        altitude: Some(260.0),
        ellipse: Some(ConfidenceEllipse {
            semi_major: 1.0,
            semi_minor: 0.5,
            orientation: 90.0,
        }),
        altitude_confidence: Some(1.0),
        ..Position::at(48.765_432_1, 9.123_456_7)
    }
}

/// A robot dog that walks at 1.39 m/s.
pub fn state() -> RobotState {
    RobotState {
        position: position(),
        heading: Some(measurement(90.0, 1.0)),
        speed: Some(measurement(1.39, 0.5)),
        drive_direction: DriveDirection::Forward,
        longitudinal_acceleration: Some(measurement(0.3, 0.2)),
        yaw_rate: Some(measurement(-1.5, 1.0)),
        dimensions: Dimensions {
            length: Some(0.7),
            width: Some(0.4),
            height: Some(0.5),
        },
        category: RobotCategory::Quadruped,
        job_role: JobRole::TrafficGuard,
        battery: Battery {
            state_of_charge: Some(83.0),
            charging: false,
        },
        control_mode: ControlMode::Autonomous,
        slow: Some(slow_state()),
        ..RobotState::default()
    }
}

pub fn slow_state() -> SlowState {
    let past = |latitude, longitude| PastPosition {
        latitude,
        longitude,
        altitude: Some(260.0),
        duration: Some(0.5),
    };
    SlowState {
        capabilities: Capabilities::FOLLOWING.union(Capabilities::DISPLAY),
        supported_tasks: TaskSet::of(&[TaskType::INITIAL_POS, TaskType::MOVE, TaskType::BLOCK]),
        path: vec![
            past(48.765_430_0, 9.123_450_0),
            past(48.765_428_0, 9.123_440_0),
        ],
        lights: Some(Lights::DAYTIME_RUNNING),
        signals: Some(SignalsShown {
            to_vehicles: PublicSignal::Stop,
            to_pedestrians: PublicSignal::Go,
            means: SignalMeans::DISPLAY,
        }),
        area: Some(MapPlace::RoadSegment {
            region: Some(276),
            id: 12,
        }),
    }
}

/// A follower that executes command 3.
pub fn follower_view() -> Ram {
    progress_view(Progress::Executing)
}

/// A follower with this progress of command 3.
pub fn progress_view(progress: Progress) -> Ram {
    reporting(Heartbeat(700), RequestId(3), progress)
}

fn reporting(echo: Heartbeat, request: RequestId, progress: Progress) -> Ram {
    let coordination = Coordination::Follower {
        session: session(),
        echo,
        last: Some(Report { request, progress }),
    };
    Ram {
        station: FOLLOWER,
        coordination,
        farewell: None,
        on_duty: false,
    }
}

/// The RAM that a follower sends most of the time: without low-frequency container.
pub fn typical_ram(identifiers: &Identifiers) -> RAM {
    let available = Availability::Available;
    ram_from(
        identifiers,
        &state(),
        &follower_view(),
        available,
        GENERATION_DELTA_TIME,
        false,
    )
    .unwrap()
}

pub fn command() -> Command {
    Command {
        session: session(),
        to: FOLLOWER,
        request: RequestId(3),
        task: TaskType::MOVE,
    }
}

pub fn parameters() -> TaskParameters {
    TaskParameters {
        target: Some(Target::Position {
            latitude: 48.765_5,
            longitude: 9.123_6,
            altitude: None,
        }),
        maximum_speed: Some(1.2),
        validity: Some(Millis(60_000)),
        ..TaskParameters::default()
    }
}

/// One command with a target.
pub fn typical_rmcm(identifiers: &Identifiers) -> RMCM {
    let commands = [(command(), parameters())];
    rmcm_from_commands(identifiers, &position(), &commands, GENERATION_DELTA_TIME).unwrap()
}

/// An acknowledgement.
pub fn answer_rmcm(identifiers: &Identifiers) -> RMCM {
    rmcm_of_verdict(identifiers, Verdict::Accepted, Some(Millis(21_600)))
}

/// The answer to command 3.
fn rmcm_of_verdict(
    identifiers: &Identifiers,
    verdict: Verdict,
    time_to_completion: Option<Millis>,
) -> RMCM {
    let answer = Answer {
        from: FOLLOWER,
        session: session(),
        request: RequestId(3),
        verdict,
    };
    let status = crossguard_codec::ExecutionStatus {
        progression: TaskProgression::Idle,
        time_to_completion,
    };
    rmcm_from_answer(
        identifiers,
        &position(),
        &answer,
        status,
        GENERATION_DELTA_TIME,
    )
    .unwrap()
}

/// A RAM with everything in it, every list full, and of every CHOICE the longest alternative.
pub fn largest_ram(identifiers: &Identifiers) -> RAM {
    let mut state = state();
    state.curvature = Some(measurement(0.01, 0.01));
    state.lateral_acceleration = Some(measurement(0.1, 0.1));
    state.vertical_acceleration = Some(measurement(0.1, 0.1));
    state.orientation = Some(measurement(180.0, 1.0));
    let step = slow_state().path[0];
    state.slow = Some(SlowState {
        path: vec![step; 23],
        ..slow_state()
    });
    let follower = |id| Confirmation {
        station: StationId(id),
        offer: OfferNumber(number(u16::MAX, u16::MAX)),
    };
    let coordination = Coordination::Leader {
        number: session().number,
        heartbeat: Heartbeat(u16::MAX),
        followers: (1..16).chain([u32::MAX]).map(follower).collect(),
        urgency: Urgency::Emergency,
        place: Place(u32::MAX),
        yields: true,
    };
    let other = SessionId {
        leader: FOLLOWER,
        ..session()
    };
    let farewell = Some(Farewell::Left(other, OfferNumber(number(5, 1))));
    let view = Ram {
        station: LEADER,
        coordination,
        farewell,
        on_duty: true,
    };
    let unavailable = Availability::Unavailable(Unavailability::NotSafe);
    let mut ram = ram_from(identifiers, &state, &view, unavailable, u16::MAX, true).unwrap();
    let parameters = &mut ram.ram.ram_parameters;
    parameters.vru_cluster_information_container = Some(largest_cluster());
    parameters.vru_motion_prediction_container = Some(largest_prediction());
    ram
}

/// The follower's RAM whose report is the longest.
pub fn failed_view() -> Ram {
    let failure = Failure::Unavailable(Unavailability::LowBattery);
    reporting(Heartbeat(0), RequestId(255), Progress::Failed(failure))
}

fn largest_cluster() -> VruClusterInformationContainer {
    let coordinate = CartesianCoordinate(-32_768);
    let corner = CartesianPosition3d {
        x_coordinate: coordinate,
        y_coordinate: coordinate,
        z_coordinate: Some(coordinate),
    };
    let polygon = PolygonalShape {
        shape_reference_point: Some(corner),
        polygon: PolygonCorners::new(&[corner; PolygonCorners::CAPACITY]).unwrap(),
        height: StandardLength12b::new(4_095),
    };
    VruClusterInformationContainer {
        vru_cluster_information: VruClusterInformation {
            cluster_id: Some(Identifier1B(255)),
            cluster_bounding_box_shape: Some(Shape::Polygonal(polygon)),
            cluster_cardinality_size: CardinalNumber1B(255),
            cluster_profiles: Some(VruClusterProfiles::LOWEST),
        },
    }
}

fn past_point() -> PathPoint {
    PathPoint {
        path_position: DeltaReferencePosition {
            delta_latitude: DeltaLatitude::new(-131_071).unwrap(),
            delta_longitude: DeltaLongitude::new(131_072).unwrap(),
            delta_altitude: DeltaAltitude::new(12_800).unwrap(),
        },
        path_delta_time: PathDeltaTime::new(65_535),
    }
}

fn predicted_point() -> PathPointPredicted {
    PathPointPredicted {
        delta_latitude: DeltaLatitude::new(131_072).unwrap(),
        delta_longitude: DeltaLongitude::new(-131_071).unwrap(),
        horizontal_position_confidence: Some(PosConfidenceEllipse {
            semi_major_confidence: SemiAxisLength::new(4_095).unwrap(),
            semi_minor_confidence: SemiAxisLength::new(0).unwrap(),
            semi_major_orientation: HeadingValue::new(3_601).unwrap(),
        }),
        delta_altitude: DeltaAltitude::new(-12_700).unwrap(),
        altitude_confidence: cdd::AltitudeConfidence::OutOfRange,
        path_delta_time: DeltaTimeSecond::new(86_400).map(PathDeltaTimeChoice::DeltaTimeMidRange),
        symmetric_area_offset: StandardLength9b::new(511),
        asymmetric_area_offset: StandardLength9b::new(511),
    }
}

fn largest_prediction() -> VruMotionPredictionContainer {
    let tenths = DeltaTimeTenthOfSecond::new(127);
    let action_delta_time = tenths.unwrap();
    let subject_station = Some(WireStationId(u32::MAX));
    let distance = SafeDistanceIndication {
        subject_station,
        safe_distance_indicator: true,
        time_to_collision: tenths,
    };
    let interception = TrajectoryInterceptionIndication {
        subject_station,
        trajectory_interception_probability: TrajectoryInterceptionProbability::new(63).unwrap(),
        trajectory_interception_confidence: TrajectoryInterceptionConfidence::new(3),
    };
    VruMotionPredictionContainer {
        path_history: PathHistory::new(&[past_point(); PATH_HISTORY_MAX]),
        path_prediction: PathPredicted::new(&[predicted_point(); PATH_PREDICTION_MAX]),
        safe_distance: SequenceOfSafeDistanceIndication::new(&[distance; 8]),
        trajectory_interception_indication: SequenceOfTrajectoryInterceptionIndication::new(
            &[interception; 8],
        ),
        acceleration_change_indication: Some(AccelerationChangeIndication {
            accel_or_decel: AccelerationChange::Decelerate,
            action_delta_time,
        }),
        heading_change_indication: Some(HeadingChangeIndication {
            direction: TurningDirection::Right,
            action_delta_time,
        }),
        stability_change_indication: Some(StabilityChangeIndication {
            loss_probability: StabilityLossProbability::new(63).unwrap(),
            action_delta_time,
        }),
    }
}

/// An RMCM with everything in it.
pub fn largest_rmcm(identifiers: &Identifiers) -> RMCM {
    let parameters = TaskParameters {
        target: Some(Target::Position {
            latitude: 90.0,
            longitude: 180.0,
            altitude: Some(8_000.0),
        }),
        heading: Some(359.9),
        maximum_speed: Some(100.0),
        minimum_pedestrian_distance: Some(51.1),
        validity: Some(Millis(86_400_000)),
        map_place: Some(MapPlace::Intersection {
            region: Some(65_535),
            id: 65_535,
        }),
    };
    let follower = |id| {
        (
            Command {
                to: StationId(id),
                ..command()
            },
            parameters,
        )
    };
    let commands: Vec<_> = (1..=16).map(follower).collect();
    rmcm_from_commands(identifiers, &position(), &commands, u16::MAX).unwrap()
}

/// The messages of `golden/messages.json`, with their names: one of every kind.
pub fn golden(identifiers: &Identifiers) -> Vec<(&'static str, Message)> {
    let rams = golden_views().into_iter().map(|(name, view)| {
        let with_low_frequency = view.coordination == Coordination::None && view.farewell.is_none();
        let (state, available) = (state(), Availability::Available);
        let time = GENERATION_DELTA_TIME;
        let ram = ram_from(
            identifiers,
            &state,
            &view,
            available,
            time,
            with_low_frequency,
        );
        (name, Message::Ram(ram.unwrap()))
    });
    let rmcms = [
        ("commands", typical_rmcm(identifiers)),
        ("acknowledges", answer_rmcm(identifiers)),
        (
            "rejects, since it is on duty",
            rmcm_of_verdict(identifiers, Verdict::Rejected(Rejection::OnDuty), None),
        ),
    ];
    let rmcms = rmcms.map(|(name, rmcm)| (name, Message::Rmcm(rmcm)));
    rams.chain(rmcms).collect()
}

fn golden_views() -> [(&'static str, Ram); 8] {
    let session = session();
    let number = session.number;
    let tasks = TaskSet::of(&[TaskType::INITIAL_POS, TaskType::MOVE]);
    let place = Place(0x0031_04d2);
    let offer = OfferNumber(self::number(9, 4));
    let request = HelpRequest {
        urgency: Urgency::High,
        followers: 1,
        tasks,
        place,
    };
    let followers = [Confirmation {
        station: FOLLOWER,
        offer,
    }]
    .into_iter()
    .collect();
    let heartbeat = Heartbeat(700);
    let leads = Coordination::Leader {
        number,
        heartbeat,
        followers,
        urgency: request.urgency,
        place,
        yields: false,
    };
    let asks = Coordination::NeedHelp {
        number,
        heartbeat: Heartbeat(12),
        request,
    };
    let offers = Coordination::OfferHelp {
        session,
        offer,
        capabilities: tasks,
        echo: Heartbeat(11),
        t_safety: Millis(2_000),
    };
    let view = |station, coordination| Ram {
        station,
        coordination,
        farewell: None,
        on_duty: false,
    };
    let idle = view(FOLLOWER, Coordination::None);
    let ended = Some(Farewell::Ended(number, Ending::Completed));
    let left = Some(Farewell::Left(session, offer));
    [
        ("idle, with low-frequency container", idle),
        ("asks for help", view(LEADER, asks)),
        ("offers help", view(FOLLOWER, offers)),
        ("leads", view(LEADER, leads)),
        ("follows and executes", follower_view()),
        (
            "follows and is in position",
            progress_view(Progress::InPosition),
        ),
        (
            "has ended its session",
            Ram {
                station: LEADER,
                farewell: ended,
                ..idle
            },
        ),
        (
            "has left, with a duty on the road",
            Ram {
                farewell: left,
                on_duty: true,
                ..idle
            },
        ),
    ]
}

/// Changes the last command of a follower's RAM without changing its status.
pub fn set_progress(ram: &mut RAM, progress: ram::CommandProgress) {
    let operation = ram
        .ram
        .ram_parameters
        .robot_leader_follower_operation_container
        .as_mut();
    let Some(ram::SessionRole::Follower(follower)) =
        operation.and_then(|operation| operation.role.as_mut())
    else {
        panic!("not the RAM of a follower");
    };
    follower.last_command = Some(ram::CommandReport {
        request_id: common::RequestId(3),
        progress,
    });
}
