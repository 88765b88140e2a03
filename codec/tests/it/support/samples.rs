//! Typical and largest messages.

use crossguard_codec::core::cdd::{
    AltitudeConfidence, DeltaAltitude, PathPointPredicted, PathPredicted,
};
use crossguard_codec::core::ram::{
    CommandProgress, CommandReport, RAM, RobotLeaderFollowerOperationContainer, SessionRole,
};
use crossguard_codec::core::rmcm::RMCM;
use crossguard_codec::core::vam::VruMotionPredictionContainer;
use crossguard_codec::core::{Source, Uper, common};
use crossguard_codec::{
    Battery, Capabilities, ConfidenceEllipse, ControlMode, Dimensions, DriveDirection, Identifiers,
    JobRole, Lights, MapPlace, Measurement, Message, PATH_PREDICTION_MAX, PastPosition, Position,
    PublicSignal, RobotCategory, RobotState, SignalMeans, SignalsShown, SlowState, Target,
    TaskParameters, TaskProgression, ram_from, rmcm_from_answer, rmcm_from_commands,
};
use crossguard_protocol::{
    Answer, Availability, Command, Confirmation, Coordination, Ending, Farewell, Heartbeat,
    HelpRequest, Millis, OfferNumber, Place, Progress, Ram, Rejection, Report, RequestId,
    SessionId, SessionNumber, StationId, TaskSet, TaskType, UniqueNumber, Urgency, Verdict,
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
    let request = RequestId(3);
    let coordination = Coordination::Follower {
        session: session(),
        echo: Heartbeat(700),
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
    ram_of(identifiers, &follower_view(), false)
}

fn ram_of(identifiers: &Identifiers, view: &Ram, with_low_frequency: bool) -> RAM {
    let (available, time) = (Availability::Available, GENERATION_DELTA_TIME);
    let ram = ram_from(
        identifiers,
        &state(),
        view,
        available,
        time,
        with_low_frequency,
    );
    ram.unwrap()
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
    let time = GENERATION_DELTA_TIME;
    rmcm_from_answer(identifiers, &position(), &answer, status, time).unwrap()
}

/// A RAM with everything in it, every list full, and of every CHOICE the longest alternative.
pub fn largest_ram(identifiers: &Identifiers) -> RAM {
    let header = typical_ram(identifiers).header;
    let mut ram = RAM {
        header,
        ..highest()
    };
    let parameters = &mut ram.ram.ram_parameters;
    let operation = RobotLeaderFollowerOperationContainer {
        role: Some(SessionRole::Leader(highest())),
        ..highest()
    };
    parameters.robot_leader_follower_operation_container = Some(operation);
    // Whatever is not its default takes room.
    let point = PathPointPredicted {
        delta_altitude: DeltaAltitude::new(-12_700).unwrap(),
        altitude_confidence: AltitudeConfidence::OutOfRange,
        ..highest()
    };
    parameters.vru_motion_prediction_container = Some(VruMotionPredictionContainer {
        path_prediction: PathPredicted::new(&[point; PATH_PREDICTION_MAX]),
        ..highest()
    });
    ram
}

fn highest<T: Uper>() -> T {
    T::arbitrary(&mut Highest)
}

/// Makes every number the highest, every list full, of every CHOICE the last alternative, and leaves nothing out.
struct Highest;

impl Source for Highest {
    fn integer(&mut self, _: i64, high: i64) -> i64 {
        high
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
    let command_to = |id| Command {
        to: StationId(id),
        ..command()
    };
    let commands: Vec<_> = (1..=16).map(|id| (command_to(id), parameters)).collect();
    rmcm_from_commands(identifiers, &position(), &commands, u16::MAX).unwrap()
}

/// The messages of `golden/messages.json`, with their names: one of every kind.
pub fn golden(identifiers: &Identifiers) -> Vec<(&'static str, Message)> {
    let rams = golden_views().into_iter().map(|(name, view)| {
        let with_low_frequency = view.coordination == Coordination::None && view.farewell.is_none();
        let ram = ram_of(identifiers, &view, with_low_frequency);
        (name, Message::Ram(ram))
    });
    let rejects = rmcm_of_verdict(identifiers, Verdict::Rejected(Rejection::OnDuty), None);
    let rmcms = [
        ("commands", typical_rmcm(identifiers)),
        ("acknowledges", answer_rmcm(identifiers)),
        ("rejects, since it is on duty", rejects),
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
    let station = FOLLOWER;
    let heartbeat = Heartbeat(700);
    let leads = Coordination::Leader {
        number,
        heartbeat,
        followers: [Confirmation { station, offer }].into_iter().collect(),
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
    let has_ended = Ram {
        station: LEADER,
        farewell: ended,
        ..idle
    };
    let has_left = Ram {
        farewell: left,
        on_duty: true,
        ..idle
    };
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
        ("has ended its session", has_ended),
        ("has left, with a duty on the road", has_left),
    ]
}

/// Changes the last command of a follower's RAM without changing its status.
pub fn set_progress(ram: &mut RAM, progress: CommandProgress) {
    let parameters = &mut ram.ram.ram_parameters;
    let operation = &mut parameters.robot_leader_follower_operation_container;
    let role = operation.as_mut().and_then(|it| it.role.as_mut());
    let Some(SessionRole::Follower(follower)) = role else {
        panic!("not the RAM of a follower");
    };
    follower.last_command = Some(CommandReport {
        request_id: common::RequestId(3),
        progress,
    });
}
