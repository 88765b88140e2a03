//! The map of a robot and that of somebody who listens in are the same: both have the people that a RAM
//! announces, and on neither a late RAM takes the place of a newer one.

use crossguard_codec::its::{Identity, Kind};
use crossguard_codec::{Identifiers, Position, RobotState};
use crossguard_endpoint::ras::clustering::{PerceivedVru, VruClass};
use crossguard_endpoint::{Effect, Endpoint, Moment, Stimulus};
use crossguard_judge::sniffer::Sniffer;
use crossguard_protocol::{Config, Robot, StationId};

const BEGAN_ITS: u64 = 694_694_400_000;

fn endpoint(station: u32) -> Endpoint {
    let robot = Robot::new(StationId(station), 1);
    Endpoint::new(robot, Config::default(), Identifiers::default(), 0)
}

fn at(now_ms: u64) -> Moment {
    let timestamp_its = BEGAN_ITS + now_ms;
    Moment {
        now_ms,
        timestamp_its,
    }
}

fn placed(latitude: f64) -> RobotState {
    RobotState {
        position: Position::at(latitude, 9.1),
        ..RobotState::default()
    }
}

/// The packets of a robot that walks north, with a person at its side.
fn packets() -> Vec<Vec<u8>> {
    let mut robot = endpoint(1);
    let person = PerceivedVru {
        id: 1,
        position_m: [3.0, 0.0],
        velocity_mps: [0.0, 0.0],
        class: VruClass::Pedestrian,
        confidence: 1.0,
    };
    let mut packets = Vec::new();
    for step in 0..30_u32 {
        let state = placed(48.7 + f64::from(step) * 1e-5);
        let moment = at(u64::from(step) * 100 + 100);
        for effect in robot.handle(moment, &state, Stimulus::Perceived(&[person])) {
            if let Effect::Transmit { packet, .. } = effect {
                packets.push(packet);
            }
        }
    }
    packets
}

#[test]
fn a_robot_and_a_sniffer_have_the_same_map_also_when_a_ram_is_late() {
    let mut packets = packets();
    assert!(packets.len() >= 3, "{}", packets.len());
    let last = packets.len() - 1;
    packets.swap(last, last - 1);
    let (mut robot, mut sniffer) = (endpoint(2), Sniffer::new(Identifiers::default()));
    for (packet, now_ms) in packets.iter().zip(3_100..) {
        let datagram = Stimulus::Datagram {
            packet,
            arrived_ms: now_ms,
        };
        robot.handle(at(now_ms), &placed(48.7), datagram);
        sniffer.see(packet, now_ms, BEGAN_ITS + now_ms);
    }
    let map = robot.map();
    let seen: Vec<_> = sniffer.map().iter().collect();
    assert_eq!(map.iter().collect::<Vec<_>>(), seen);
    assert_eq!(map.of_kind(Kind::Vru).count(), 1, "the person at its side");
    let walker = map.get(Identity::Station(1)).expect("it is on the map");
    let latitude = walker.user.position.latitude.expect("it said where it is");
    // The one before the last, as it was sent, is farther south.
    let newest = BEGAN_ITS + 3_000;
    assert!(latitude > 48.7002, "{latitude}");
    assert!(newest - walker.user.measured_its <= 400, "{walker:?}");
}
