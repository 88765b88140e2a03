//! What a robot hears in a message is what the mapping has of it, for this robot and its place.

use crate::support::samples;
use crossguard_codec::{
    Heard, Identifiers, Position, RobotState, Service, Target, TaskParameters, Unheard, encode,
    ram_from, rmcm_from_commands,
};
use crossguard_protocol::{
    Availability, Command, Decimetres, Input, Ram, Rmcm, Robot, StationId, Unavailability,
};

const ME: StationId = StationId(2);

fn state() -> RobotState {
    RobotState {
        position: Position::at(48.765_432_1, 9.123_456_7),
        ..RobotState::default()
    }
}

fn hear(octets: &[u8]) -> Result<Heard, Unheard> {
    let here = Position::at(48.765_432_1, 9.123_500_0);
    Heard::of(&Identifiers::default(), ME, &here, octets)
}

fn ram(view: &Ram) -> Vec<u8> {
    let ids = Identifiers::default();
    let unavailable = Availability::Unavailable(Unavailability::LowBattery);
    let ram = ram_from(&ids, &state(), view, unavailable, 0, false).unwrap();
    encode(&ids, &ram).unwrap()
}

#[test]
fn a_ram_says_who_and_where_its_sender_is() {
    let view = Robot::new(StationId(7), 1).ram();
    let heard = hear(&ram(&view)).unwrap();
    assert_eq!((heard.service, heard.from), (Service::Ram, StationId(7)));
    let distance = Decimetres(32);
    assert!(heard.inputs.iter().eq(&[Input::Ram {
        ram: view,
        distance
    }]));
    assert_eq!(heard.state.unwrap().position.latitude, Some(48.765_432_1));
    let unavailable = Availability::Unavailable(Unavailability::LowBattery);
    assert_eq!(heard.availability, Some(unavailable));
    assert_eq!((heard.parameters, heard.cluster), (None, None));
}

#[test]
fn an_rmcm_says_what_its_leader_wants_of_each_and_where_this_robot_is_to_go() {
    let command = |to, lane| {
        let command = Command {
            to,
            ..samples::command()
        };
        let parameters = TaskParameters {
            target: Some(Target::Lane(lane)),
            ..TaskParameters::default()
        };
        (command, parameters)
    };
    let commands = [command(StationId(5), 1), command(ME, 2)];
    let ids = Identifiers::default();
    let rmcm = rmcm_from_commands(&ids, &state().position, &commands, 0).unwrap();
    let heard = hear(&encode(&ids, &rmcm).unwrap()).unwrap();
    assert_eq!(
        (heard.service, heard.from),
        (Service::Rmcm, samples::LEADER)
    );
    let inputs = commands.map(|(command, _)| Input::Rmcm(Rmcm::Command(command)));
    assert!(heard.inputs.iter().eq(&inputs));
    assert_eq!(heard.parameters, Some(commands[1].1));
    assert!(heard.state.is_none() && heard.availability.is_none());
}

#[test]
fn what_says_nothing_says_why() {
    let view = Robot::new(StationId(7), 1).ram();
    let mut octets = ram(&view);
    octets.push(0);
    assert!(matches!(hear(&octets), Err(Unheard::Undecodable(_))));
    assert!(matches!(hear(&[]), Err(Unheard::Undecodable(_))));
    // A follower in a session of its own.
    let ids = Identifiers::default();
    let mut ram = samples::typical_ram(&ids);
    ram.header.station_id.0 = samples::LEADER.0;
    let contradictory = hear(&encode(&ids, &ram).unwrap());
    assert!(matches!(contradictory, Err(Unheard::Contradictory(_))));
}
