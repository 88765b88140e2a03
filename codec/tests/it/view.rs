//! Nothing contradictory is said or understood, and each contradiction has its name. That everything else arrives as it
//! was said is what the laws of the mapping say, in `view_laws.rs`.

use crate::support::samples;
use crossguard_codec::core::ram::{
    CommandProgress, ConfirmedFollowers, CrossingNumber, CrossingReference, HelpStatus, LeaderRole,
    RAM, SessionRole,
};
use crossguard_codec::core::rmcm::{ManeuverCommands, ManeuverContainer, RMCM};
use crossguard_codec::{
    Identifiers, MapPlace, Target, TaskParameters, TaskProgression, ViewError, ram_from,
    rmcm_from_commands, task_parameters_of, view_of_ram, views_of_rmcm,
};
use crossguard_protocol::{
    Availability, Command, Confirmation, Coordination, Failure, Farewell, Heartbeat, HelpRequest,
    Millis, OfferNumber, Place, Progress, Ram, SessionId, StationId, TaskSet, Urgency,
};

const LEADER: StationId = samples::LEADER;
const FOLLOWER: StationId = samples::FOLLOWER;

fn ram(view: &Ram) -> Result<RAM, ViewError> {
    let (ids, available) = (Identifiers::default(), Availability::Available);
    ram_from(&ids, &samples::state(), view, available, 0, false)
}

/// Commands of one message.
type Commands = [(Command, TaskParameters)];

fn rmcm(commands: &Commands) -> Result<RMCM, ViewError> {
    rmcm_from_commands(&Identifiers::default(), &samples::position(), commands, 0)
}

/// What a robot says with this part in a session.
fn says(station: StationId, coordination: Coordination) -> Ram {
    Ram {
        station,
        coordination,
        farewell: None,
        on_duty: false,
    }
}

fn asks(followers: u8) -> Ram {
    let request = HelpRequest {
        urgency: Urgency::High,
        followers,
        tasks: TaskSet(7),
        place: Place::UNKNOWN,
    };
    let coordination = Coordination::NeedHelp {
        number: samples::session().number,
        heartbeat: Heartbeat(0),
        request,
    };
    says(LEADER, coordination)
}

fn offer() -> OfferNumber {
    OfferNumber(samples::number(9, 4))
}

fn offers(t_safety: Millis) -> Ram {
    let coordination = Coordination::OfferHelp {
        session: samples::session(),
        offer: offer(),
        capabilities: TaskSet(7),
        echo: Heartbeat(u16::MAX),
        t_safety,
    };
    says(FOLLOWER, coordination)
}

fn leads(stations: &[u32], place: Place) -> Ram {
    let confirm = |&id: &u32| Confirmation {
        station: StationId(id),
        offer: offer(),
    };
    let coordination = Coordination::Leader {
        number: samples::session().number,
        heartbeat: Heartbeat(1),
        followers: stations.iter().map(confirm).collect(),
        urgency: Urgency::Low,
        place,
        yields: false,
    };
    says(LEADER, coordination)
}

/// A follower that says that it has left a session of this leader.
fn has_left(leader: StationId) -> Ram {
    let session = SessionId {
        leader,
        ..samples::session()
    };
    Ram {
        farewell: Some(Farewell::Left(session, offer())),
        ..samples::follower_view()
    }
}

#[test]
fn what_contradicts_itself_is_not_said() {
    let (followers, timeout) = (|of: &[u32]| leads(of, Place(1)), ViewError::SafetyTimeout);
    let execution_limit = samples::progress_view(Progress::Failed(Failure::ExecutionLimit));
    let on_duty = Ram {
        on_duty: true,
        ..says(FOLLOWER, Coordination::None)
    };
    let day = Millis::MAX_TIMER;
    let longer = Millis(day.0 + 1);
    #[rustfmt::skip]
    let cases = [
        ("a report", samples::follower_view(), Ok(())),
        ("a duty without a part in a session", on_duty, Ok(())),
        ("16 followers are asked for", asks(16), Ok(())),
        ("17 of them", asks(17), Err(ViewError::FollowerCount(17))),
        ("none of them", asks(0), Err(ViewError::FollowerCount(0))),
        ("safety within 1 ms", offers(Millis(1)), Ok(())),
        ("safety within a day", offers(day), Ok(())),
        ("safety at once", offers(Millis(0)), Err(timeout(Millis(0)))),
        ("safety later", offers(longer), Err(timeout(longer))),
        ("two followers", followers(&[1, 2]), Ok(())),
        ("no follower", followers(&[]), Err(ViewError::NoFollowers)),
        ("a follower twice", followers(&[1, 2, 1]), Err(ViewError::NamedTwice(StationId(1)))),
        ("a leader that follows itself", followers(&[1, LEADER.0]), Err(ViewError::OwnFollower(LEADER))),
        ("farewell to another session", has_left(StationId(9)), Ok(())),
        ("farewell to the present session", has_left(LEADER), Err(ViewError::FarewellToPresent(samples::session()))),
        ("an own session that was left", has_left(FOLLOWER), Err(ViewError::OwnSession(FOLLOWER))),
        ("the leader's execution limit, in a report", execution_limit, Err(ViewError::ExecutionLimit)),
    ];
    for (name, view, expected) in cases {
        let said = ram(&view);
        assert_eq!(said.map(drop), expected, "{name}");
        let Ok(said) = said else { continue };
        assert_eq!(view_of_ram(&said), Ok(view), "{name}");
        let parameters = said.ram.ram_parameters;
        let container = parameters.robot_leader_follower_operation_container;
        let is_part = view.coordination != Coordination::None || view.farewell.is_some();
        assert_eq!(container.is_some(), is_part, "{name}");
    }
}

fn leader_role(ram: &mut RAM) -> &mut LeaderRole {
    let parameters = &mut ram.ram.ram_parameters;
    let operation = &mut parameters.robot_leader_follower_operation_container;
    match operation.as_mut().and_then(|it| it.role.as_mut()) {
        Some(SessionRole::Leader(role)) => role,
        other => panic!("{other:?} is no leader"),
    }
}

fn crossing(regulator: u16, intersection: u16) -> CrossingReference {
    CrossingReference {
        regulator: CrossingNumber(regulator),
        intersection: CrossingNumber(intersection),
    }
}

/// A message with its name, what is changed in it, and the contradiction that this is.
type Forged<S, M> = (&'static str, S, fn(&mut M), ViewError);

#[test]
fn a_forged_ram_is_refused() {
    let progression = |found, expected| ViewError::TaskProgression { found, expected };
    let not_own = ViewError::NotOwnSession {
        sender: StationId(5),
        session: samples::session(),
    };
    let cases: [Forged<Ram, RAM>; 7] = [
        (
            "a follower of itself",
            samples::follower_view(),
            |ram| ram.header.station_id.0 = LEADER.0,
            ViewError::OwnSession(LEADER),
        ),
        (
            "a leader of the session of another",
            leads(&[1, 2], Place(1)),
            |ram| ram.header.station_id.0 = 5,
            not_own,
        ),
        (
            "a follower that is named twice",
            leads(&[1, 2], Place(1)),
            |ram| {
                let role = leader_role(ram);
                let follower = role.followers[0];
                role.followers = ConfirmedFollowers::new(&[follower; 2]).unwrap();
            },
            ViewError::NamedTwice(StationId(1)),
        ),
        (
            "an unknown crossing that is spelled out",
            leads(&[1, 2], Place::UNKNOWN),
            |ram| leader_role(ram).crossing = Some(crossing(0, 0)),
            ViewError::UnknownCrossing,
        ),
        (
            "a role without its help status",
            samples::follower_view(),
            |ram| {
                let status = &mut ram.ram.ram_parameters.robot_status_container;
                status.help_status = HelpStatus::None;
            },
            ViewError::HelpStatus {
                found: HelpStatus::None,
                expected: HelpStatus::RoleConfirmed,
            },
        ),
        (
            "a task in execution that is reported as completed",
            samples::follower_view(),
            |ram| samples::set_progress(ram, CommandProgress::Completed(())),
            progression(TaskProgression::Executing, TaskProgression::Completed),
        ),
        (
            "a robot in position that is reported as on its way",
            samples::progress_view(Progress::InPosition),
            |ram| samples::set_progress(ram, CommandProgress::Executing(())),
            progression(TaskProgression::InPosition, TaskProgression::Executing),
        ),
    ];
    for (name, view, forge, expected) in cases {
        let mut forged = ram(&view).expect(name);
        forge(&mut forged);
        assert_eq!(view_of_ram(&forged), Err(expected), "{name}");
    }
    assert_eq!(ViewError::UnknownCrossing.cause(), "crossing 0:0");
}

#[test]
fn a_forged_rmcm_is_refused() {
    let ids = Identifiers::default();
    let cases: [Forged<RMCM, RMCM>; 3] = [
        (
            "a command in the session of another",
            samples::typical_rmcm(&ids),
            |rmcm| rmcm.header.station_id.0 = 5,
            ViewError::NotOwnSession {
                sender: StationId(5),
                session: samples::session(),
            },
        ),
        (
            "a follower that is commanded twice",
            samples::largest_rmcm(&ids),
            |rmcm| {
                let container = &mut rmcm.rmcm.rmcm_parameters.maneuver_container;
                let ManeuverContainer::LeaderManeuverContainer(leader) = container else {
                    panic!("not a leader");
                };
                let mut commands = leader.commands.to_vec();
                commands[3].target_follower_station_id.0 = 2;
                leader.commands = ManeuverCommands::new(&commands).unwrap();
            },
            ViewError::NamedTwice(StationId(2)),
        ),
        (
            "an answer to itself",
            samples::answer_rmcm(&ids),
            |rmcm| rmcm.header.station_id.0 = LEADER.0,
            ViewError::OwnSession(LEADER),
        ),
    ];
    for (name, mut forged, forge, expected) in cases {
        forge(&mut forged);
        assert_eq!(views_of_rmcm(&forged), Err(expected), "{name}");
    }
}

#[test]
fn an_unknown_crossing_is_absent() {
    for (place, expected) in [
        (Place(1 << 16), Some(crossing(1, 0))),
        (Place(0xfffe), Some(crossing(0, 0xfffe))),
        (Place::UNKNOWN, None),
    ] {
        let mut said = ram(&leads(&[1], place)).unwrap();
        assert_eq!(leader_role(&mut said).crossing, expected);
    }
}

#[test]
fn the_commands_of_a_message_belong_together() {
    let parameters = samples::parameters();
    let first = samples::command();
    let other = |to| Command {
        to: StationId(to),
        ..first
    };
    let session = SessionId {
        leader: StationId(9),
        ..first.session
    };
    let elsewhere = Command {
        session,
        ..other(2)
    };
    let region = None;
    let segment = |id| TaskParameters {
        map_place: Some(MapPlace::RoadSegment { region, id }),
        ..parameters
    };
    let crowd: Vec<_> = (1..=17).map(|to| (other(to), parameters)).collect();
    #[rustfmt::skip]
    let cases: [(&str, &Commands, Result<(), ViewError>); 7] = [
        ("two", &[(first, parameters), (other(2), parameters)], Ok(())),
        ("none", &[], Err(ViewError::CommandCount(0))),
        ("too many", &crowd, Err(ViewError::CommandCount(17))),
        ("to one follower", &[(first, parameters); 2], Err(ViewError::NamedTwice(first.to))),
        ("to the leader", &[(other(LEADER.0), parameters)], Err(ViewError::OwnFollower(LEADER))),
        ("at two places", &[(first, segment(1)), (other(2), segment(2))], Err(ViewError::MapPlacesDiffer(StationId(2)))),
        ("in two sessions", &[(first, parameters), (elsewhere, parameters)], Err(ViewError::SessionsDiffer(first.session, session))),
    ];
    for (name, commands, expected) in cases {
        assert_eq!(rmcm(commands).map(drop), expected, "{name}");
    }
}

#[test]
fn a_target_that_cannot_be_expressed_is_not_left_out() {
    let altitude = None;
    let position = |latitude, longitude| Target::Position {
        latitude,
        longitude,
        altitude,
    };
    let offset = Target::Offset {
        latitude: 0.02,
        longitude: 0.0,
        altitude,
    };
    let targets = [position(f64::NAN, 9.0), position(48.0, 190.0), offset];
    for target in targets.into_iter().chain([Target::Lane(15)]) {
        let parameters = TaskParameters {
            target: Some(target),
            ..TaskParameters::default()
        };
        let rmcm = rmcm(&[(samples::command(), parameters)]);
        assert_eq!(rmcm, Err(ViewError::Target(FOLLOWER)), "{target:?}");
    }
}

#[test]
fn a_limit_that_is_no_number_is_no_limit() {
    let parameters = TaskParameters {
        heading: Some(f64::NAN),
        maximum_speed: Some(f64::NAN),
        minimum_pedestrian_distance: Some(f64::NAN),
        ..TaskParameters::default()
    };
    let rmcm = rmcm(&[(samples::command(), parameters)]).unwrap();
    let read = task_parameters_of(&rmcm, FOLLOWER);
    assert_eq!(read, Some(TaskParameters::default()));
}
