//! What the protocol says arrives as it was said, and nothing contradictory arrives.

use crate::support::{samples, views};
use crossguard_codec::core::common;
use crossguard_codec::core::ram::{
    CommandProgress, ConfirmedFollowers, CrossingNumber, CrossingReference, HelpStatus, LeaderRole,
    RAM, SessionRole,
};
use crossguard_codec::core::rmcm::{ManeuverCommands, ManeuverContainer, RMCM};
use crossguard_codec::{
    ExecutionStatus, Identifiers, MapPlace, Target, TaskParameters, TaskProgression, ViewError,
    decode, encode, execution_of, ram_from, rmcm_from_answer, rmcm_from_commands,
    task_parameters_of, view_of_ram, views_of_rmcm,
};
use crossguard_protocol::{
    Availability, Command, Coordination, Failure, Farewell, Heartbeat, Millis, OfferNumber, Place,
    Progress, Ram, RequestId, SessionId, StationId,
};

fn identifiers() -> Identifiers {
    Identifiers::default()
}

/// The message as a receiver has it.
fn over_the_air<M: crossguard_codec::Pdu>(message: &M) -> M {
    let octets = encode(&identifiers(), message).expect("what is mapped can be encoded");
    decode(&identifiers(), &octets)
        .expect("what is encoded can be decoded")
        .message
}

fn ram(view: &Ram) -> Result<RAM, ViewError> {
    let available = Availability::Available;
    ram_from(&identifiers(), &samples::state(), view, available, 0, false)
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

fn leader_role(ram: &mut RAM) -> &mut LeaderRole {
    let operation = ram
        .ram
        .ram_parameters
        .robot_leader_follower_operation_container
        .as_mut();
    let Some(SessionRole::Leader(role)) = operation.and_then(|o| o.role.as_mut()) else {
        panic!("not a leader");
    };
    role
}

#[test]
fn what_a_robot_says_of_itself_is_said_by_no_other() {
    let sent = ram(&samples::follower_view()).unwrap();
    assert_eq!(view_of_ram(&sent), Ok(samples::follower_view()));

    // The same octets with another sender, who then follows itself.
    let mut forged = sent;
    forged.header.station_id.0 = samples::LEADER.0;
    assert_eq!(
        view_of_ram(&forged),
        Err(ViewError::OwnSession(samples::LEADER))
    );
}

#[test]
fn nobody_leads_the_session_of_another() {
    let identifiers = identifiers();
    let mut forged = samples::largest_ram(&identifiers);
    assert!(view_of_ram(&forged).is_ok());
    forged.header.station_id.0 = 5;
    let error = ViewError::NotOwnSession {
        sender: StationId(5),
        session: samples::session(),
    };
    assert_eq!(view_of_ram(&forged), Err(error));

    let mut forged = samples::typical_rmcm(&identifiers);
    forged.header.station_id.0 = 5;
    assert_eq!(views_of_rmcm(&forged), Err(error));
}

#[test]
fn the_help_status_goes_with_the_role() {
    let mut ram = ram(&samples::follower_view()).unwrap();
    let status = &mut ram.ram.ram_parameters.robot_status_container;
    status.help_status = HelpStatus::None;
    let (found, expected) = (HelpStatus::None, HelpStatus::RoleConfirmed);
    assert_eq!(
        view_of_ram(&ram),
        Err(ViewError::HelpStatus { found, expected })
    );

    ram.ram
        .ram_parameters
        .robot_leader_follower_operation_container = None;
    assert_eq!(view_of_ram(&ram).unwrap().coordination, Coordination::None);
}

#[test]
fn the_task_progression_goes_with_the_report() {
    let mut ram = ram(&samples::follower_view()).unwrap();
    assert_eq!(
        ram.ram
            .ram_parameters
            .robot_status_container
            .task_progression,
        common::TaskProgression::Executing
    );
    samples::set_progress(&mut ram, CommandProgress::Completed(()));
    let (found, expected) = (TaskProgression::Executing, TaskProgression::Completed);
    assert_eq!(
        view_of_ram(&ram),
        Err(ViewError::TaskProgression { found, expected })
    );
}

#[test]
fn the_leaders_execution_limit_is_nothing_a_follower_can_report() {
    let mut view = samples::failed_view();
    let Coordination::Follower {
        last: Some(report), ..
    } = &mut view.coordination
    else {
        panic!("not a report");
    };
    report.progress = Progress::Failed(Failure::ExecutionLimit);
    assert_eq!(ram(&view), Err(ViewError::ExecutionLimit));
}

#[test]
fn a_leader_names_every_follower_once_and_not_itself() {
    let view = view_of_ram(&samples::largest_ram(&identifiers())).unwrap();
    let with_followers = |stations: &[u32]| {
        let mut coordination = view.coordination;
        let Coordination::Leader { followers, .. } = &mut coordination else {
            panic!("not a leader");
        };
        let offer = followers.iter().next().unwrap().offer;
        let confirm = |&id: &u32| crossguard_protocol::Confirmation {
            station: StationId(id),
            offer,
        };
        *followers = stations.iter().map(confirm).collect();
        ram(&Ram {
            coordination,
            ..view
        })
        .map(drop)
    };
    assert_eq!(with_followers(&[1, 2]), Ok(()));
    assert_eq!(with_followers(&[]), Err(ViewError::NoFollowers));
    assert_eq!(
        with_followers(&[1, 2, 1]),
        Err(ViewError::NamedTwice(StationId(1)))
    );
    let leader = samples::LEADER;
    assert_eq!(
        with_followers(&[1, leader.0]),
        Err(ViewError::OwnFollower(leader))
    );

    // And a receiver says the same to one that does.
    let mut forged = samples::largest_ram(&identifiers());
    let role = leader_role(&mut forged);
    let mut followers = role.followers.to_vec();
    followers[1].station_id = followers[0].station_id;
    role.followers = ConfirmedFollowers::new(&followers).unwrap();
    assert_eq!(
        view_of_ram(&forged),
        Err(ViewError::NamedTwice(StationId(1)))
    );
}

#[test]
fn nobody_says_farewell_to_the_session_that_it_takes_part_in() {
    let offer = OfferNumber(samples::number(9, 4));
    let farewell = |session| Ram {
        farewell: Some(Farewell::Left(session, offer)),
        ..samples::follower_view()
    };
    let present = samples::session();
    assert_eq!(
        ram(&farewell(present)),
        Err(ViewError::FarewellToPresent(present))
    );
    let own = SessionId {
        leader: samples::FOLLOWER,
        ..present
    };
    assert_eq!(
        ram(&farewell(own)),
        Err(ViewError::OwnSession(samples::FOLLOWER))
    );
    let past = SessionId {
        leader: StationId(9),
        ..present
    };
    assert!(ram(&farewell(past)).is_ok());
}

#[test]
fn a_request_is_for_1_to_16_followers() {
    let request = crossguard_protocol::HelpRequest {
        urgency: crossguard_protocol::Urgency::High,
        followers: 17,
        tasks: crossguard_protocol::TaskSet(7),
        place: Place::UNKNOWN,
    };
    let coordination = Coordination::NeedHelp {
        number: samples::session().number,
        heartbeat: Heartbeat(0),
        request,
    };
    assert_eq!(
        ram(&says(samples::LEADER, coordination)),
        Err(ViewError::FollowerCount(17))
    );
}

#[test]
fn a_safety_timeout_is_from_1_ms_to_one_day() {
    let offers = |t_safety| {
        let coordination = Coordination::OfferHelp {
            session: samples::session(),
            offer: OfferNumber(samples::number(9, 4)),
            capabilities: crossguard_protocol::TaskSet(7),
            echo: Heartbeat(u16::MAX),
            t_safety,
        };
        let view = says(samples::FOLLOWER, coordination);
        ram(&view).map(|ram| assert_eq!(view_of_ram(&over_the_air(&ram)), Ok(view)))
    };
    for told in [Millis(1), Millis(2_000), Millis::MAX_TIMER] {
        assert_eq!(offers(told), Ok(()));
    }
    for untold in [Millis(0), Millis(Millis::MAX_TIMER.0 + 1)] {
        assert_eq!(offers(untold), Err(ViewError::SafetyTimeout(untold)));
    }
}

#[test]
fn an_unknown_crossing_is_absent_and_never_spelled_out() {
    let at = |place| {
        let mut view = view_of_ram(&samples::largest_ram(&identifiers())).unwrap();
        let Coordination::Leader { place: of_view, .. } = &mut view.coordination else {
            panic!("not a leader");
        };
        *of_view = place;
        let said = over_the_air(&ram(&view).unwrap());
        assert_eq!(view_of_ram(&said), Ok(view));
        said
    };
    let crossing = |regulator, intersection| {
        Some(CrossingReference {
            regulator: CrossingNumber(regulator),
            intersection: CrossingNumber(intersection),
        })
    };
    assert_eq!(
        leader_role(&mut at(Place(1 << 16))).crossing,
        crossing(1, 0)
    );
    assert_eq!(
        leader_role(&mut at(Place(0xfffe))).crossing,
        crossing(0, 0xfffe)
    );
    let mut forged = at(Place::UNKNOWN);
    assert_eq!(leader_role(&mut forged).crossing, None);
    // On the wire it can be spelled out, and that is refused.
    leader_role(&mut forged).crossing = crossing(0, 0);
    let error = view_of_ram(&over_the_air(&forged)).unwrap_err();
    assert_eq!(
        (error, error.cause()),
        (ViewError::UnknownCrossing, "crossing 0:0")
    );
}

#[test]
fn a_duty_is_told_without_a_part_in_a_session() {
    let view = Ram {
        on_duty: true,
        ..says(samples::FOLLOWER, Coordination::None)
    };
    let said = over_the_air(&ram(&view).unwrap());
    let parameters = &said.ram.ram_parameters;
    assert_eq!(parameters.robot_leader_follower_operation_container, None);
    assert_eq!(view_of_ram(&said), Ok(view));
}

#[test]
fn in_position_stands_in_report_and_status() {
    let view = samples::progress_view(Progress::InPosition);
    let mut said = ram(&view).unwrap();
    let status = &said.ram.ram_parameters.robot_status_container;
    assert_eq!(status.task_progression, common::TaskProgression::InPosition);
    assert_eq!(view_of_ram(&over_the_air(&said)), Ok(view));

    samples::set_progress(&mut said, CommandProgress::Executing(()));
    let (found, expected) = (TaskProgression::InPosition, TaskProgression::Executing);
    assert_eq!(
        view_of_ram(&said),
        Err(ViewError::TaskProgression { found, expected })
    );
}

#[test]
fn the_commands_of_a_message_belong_together() {
    let rmcm = |commands: &[(Command, TaskParameters)]| {
        rmcm_from_commands(&identifiers(), &samples::position(), commands, 0).map(drop)
    };
    let parameters = samples::parameters();
    let first = samples::command();
    let other = |to| Command {
        to: StationId(to),
        ..first
    };
    assert_eq!(rmcm(&[(first, parameters), (other(2), parameters)]), Ok(()));
    assert_eq!(rmcm(&[]), Err(ViewError::CommandCount(0)));
    let crowd: Vec<_> = (1..=17).map(|to| (other(to), parameters)).collect();
    assert_eq!(rmcm(&crowd), Err(ViewError::CommandCount(17)));
    let twice = [(first, parameters), (first, parameters)];
    assert_eq!(rmcm(&twice), Err(ViewError::NamedTwice(first.to)));
    let own = [(other(samples::LEADER.0), parameters)];
    assert_eq!(rmcm(&own), Err(ViewError::OwnFollower(samples::LEADER)));
    let session = SessionId {
        leader: StationId(9),
        ..first.session
    };
    let elsewhere = Command {
        session,
        ..other(2)
    };
    let region = None;
    let segment = |id| views::at(Some(MapPlace::RoadSegment { region, id }), parameters);
    let places = [(first, segment(1)), (other(2), segment(2))];
    assert_eq!(rmcm(&places), Err(ViewError::MapPlacesDiffer(StationId(2))));
    let error = ViewError::SessionsDiffer(first.session, session);
    assert_eq!(
        rmcm(&[(first, parameters), (elsewhere, parameters)]),
        Err(error)
    );
}

#[test]
fn a_message_that_commands_a_follower_twice_is_refused() {
    let mut forged: RMCM = samples::largest_rmcm(&identifiers());
    let container = &mut forged.rmcm.rmcm_parameters.maneuver_container;
    let ManeuverContainer::LeaderManeuverContainer(leader) = container else {
        panic!("not a leader");
    };
    let mut commands = leader.commands.to_vec();
    commands[3].target_follower_station_id.0 = 2;
    leader.commands = ManeuverCommands::new(&commands).unwrap();
    assert_eq!(
        views_of_rmcm(&forged),
        Err(ViewError::NamedTwice(StationId(2)))
    );
}

#[test]
fn nobody_answers_itself() {
    let mut forged = samples::answer_rmcm(&identifiers());
    forged.header.station_id.0 = samples::LEADER.0;
    assert_eq!(
        views_of_rmcm(&forged),
        Err(ViewError::OwnSession(samples::LEADER))
    );
}

#[test]
fn a_target_that_cannot_be_expressed_is_not_left_out() {
    let targets = [
        Target::Position {
            latitude: f64::NAN,
            longitude: 9.0,
            altitude: None,
        },
        Target::Position {
            latitude: 48.0,
            longitude: 190.0,
            altitude: None,
        },
        Target::Offset {
            latitude: 0.02,
            longitude: 0.0,
            altitude: None,
        },
        Target::Lane(15),
    ];
    for target in targets {
        let parameters = TaskParameters {
            target: Some(target),
            ..TaskParameters::default()
        };
        let commands = [(samples::command(), parameters)];
        let rmcm = rmcm_from_commands(&identifiers(), &samples::position(), &commands, 0);
        assert_eq!(
            rmcm,
            Err(ViewError::Target(samples::FOLLOWER)),
            "{target:?}"
        );
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
    let commands = [(samples::command(), parameters)];
    let rmcm = rmcm_from_commands(&identifiers(), &samples::position(), &commands, 0);
    let read = task_parameters_of(&rmcm.unwrap(), samples::FOLLOWER);
    assert_eq!(read, Some(TaskParameters::default()));
}

#[test]
fn durations_saturate_at_one_day() {
    let status = ExecutionStatus {
        time_to_completion: Some(crossguard_protocol::Millis(u32::MAX)),
        ..ExecutionStatus::default()
    };
    let answer = crossguard_protocol::Answer {
        from: samples::FOLLOWER,
        session: samples::session(),
        request: RequestId(0),
        verdict: crossguard_protocol::Verdict::Accepted,
    };
    let position = samples::position();
    let rmcm = rmcm_from_answer(&identifiers(), &position, &answer, status, 0).unwrap();
    let time = execution_of(&rmcm).unwrap().time_to_completion;
    assert_eq!(time, Some(crossguard_protocol::Millis::MAX_TIMER));
}
