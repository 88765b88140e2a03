//! CAM of a robot, as another robot hears them: its RAM comes first.

use crossguard_codec::{Identity, Kind, Position, RobotState, Service};
use crossguard_endpoint::ras::surroundings::Awareness;
use crossguard_endpoint::{Effect, Endpoint, Stimulus};
use crossguard_protocol::StationId;

use crate::support::moment;

fn endpoint(station: u32, cam: bool) -> Endpoint {
    let awareness = Awareness {
        cam,
        ..Awareness::default()
    };
    crate::support::endpoint(StationId(station)).with_awareness(awareness)
}

fn state() -> RobotState {
    RobotState {
        position: Position::at(49.0, 8.4),
        ..RobotState::default()
    }
}

/// Packets that the endpoint sends within this many seconds when nothing happens.
fn sent(endpoint: &mut Endpoint, seconds: u64) -> Vec<(u64, Service, Vec<u8>)> {
    let mut sent = Vec::new();
    for now_ms in (0..seconds * 1_000).step_by(100) {
        let effects = endpoint.handle(moment(now_ms), &state(), Stimulus::Time);
        sent.extend(effects.into_iter().filter_map(|effect| match effect {
            Effect::Transmit { kind, packet, .. } => Some((now_ms, kind, packet)),
            _ => None,
        }));
    }
    sent
}

/// The kinds of station 1 on the map of a robot that hears these packets.
fn on_the_map(packets: &[(u64, Service, Vec<u8>)], heard: impl Fn(Service) -> bool) -> Vec<Kind> {
    let mut listener = endpoint(2, false);
    for (at_ms, _, packet) in packets.iter().filter(|(_, kind, _)| heard(*kind)) {
        let arrived_ms = *at_ms;
        let datagram = Stimulus::Datagram { packet, arrived_ms };
        listener.handle(moment(arrived_ms), &state(), datagram);
    }
    let users = listener.map().iter().map(|known| known.user);
    let of_station = users.filter(|user| user.identity == Identity::Station(1));
    of_station.map(|user| user.kind).collect()
}

#[test]
fn the_cam_of_a_robot_does_not_replace_it_on_the_map() {
    let packets = sent(&mut endpoint(1, true), 3);
    let kinds: Vec<_> = packets.iter().map(|(_, kind, _)| *kind).collect();
    assert_eq!(kinds, [Service::Ram, Service::Cam].repeat(3));
    assert_eq!(on_the_map(&packets, |_| true), [Kind::Robot]);
    // A station that does not know RAM has a vehicle of that station type.
    let station_type = on_the_map(&packets, |kind| kind == Service::Cam);
    assert_eq!(station_type, [Kind::Vru]);
}

#[test]
fn without_being_asked_for_there_are_no_cam() {
    let packets = sent(&mut endpoint(1, false), 3);
    assert!(packets.iter().all(|(_, kind, _)| *kind == Service::Ram));
}

#[test]
fn a_driver_is_told_to_come_back_in_time_for_cam() {
    let mut robot = endpoint(1, true);
    robot.handle(moment(0), &state(), Stimulus::Time);
    assert!(robot.next_wakeup_ms() <= 100);
}
