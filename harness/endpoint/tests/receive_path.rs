//! The whole receive path of an endpoint against octets of all kinds: the same entry point as the
//! fuzz target `receive` in `harness/fuzz`.

use crossguard_codec::geonet::{EgoPosition, Stack};
use crossguard_codec::{Identifiers, RobotState, Service, golden};
use crossguard_endpoint::{Effect, Endpoint, Moment, Stimulus};
use crossguard_protocol::{Config, Robot, StationId};
use rand::{Rng, RngCore, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// How many packets are tried.
const PACKETS: u64 = 20_000;

fn packets() -> Vec<Vec<u8>> {
    let mut sender = Stack::of_robot(Identifiers::default(), StationId(77));
    let mut packets = Vec::new();
    for file in [golden::ITS, golden::VAM, golden::PACKETS] {
        for (_, digits) in golden::vectors(file) {
            let octets = hex::decode(digits).unwrap();
            if octets[0] == 0x11 {
                packets.push(octets);
                continue;
            }
            for service in Service::ALL {
                let packet = sender.packet(&EgoPosition::default(), service, &octets);
                packets.extend(packet);
            }
        }
    }
    packets
}

/// Messages of a robot that asks for help.
fn of_a_robot() -> Vec<Vec<u8>> {
    let mut robot = endpoint(StationId(9));
    let event = crossguard_protocol::Event::PedestrianDetected(crossguard_protocol::HelpRequest {
        urgency: crossguard_protocol::Urgency::High,
        followers: 1,
        tasks: crossguard_protocol::TaskSet(1),
        place: crossguard_protocol::Place::UNKNOWN,
    });
    let state = RobotState::default();
    let effects = robot.handle(moment(200), &state, Stimulus::Event(event));
    effects
        .into_iter()
        .filter_map(|effect| match effect {
            Effect::Transmit { packet, .. } => Some(packet),
            _ => None,
        })
        .collect()
}

fn endpoint(station: StationId) -> Endpoint {
    Endpoint::new(
        Robot::new(station, 1),
        Config::default(),
        Identifiers::default(),
        0,
    )
}

fn moment(now_ms: u64) -> Moment {
    Moment::after(694_694_401_000, now_ms)
}

#[test]
fn any_packet_is_taken_or_dropped_under_a_cause() {
    let mut noise = ChaCha8Rng::seed_from_u64(4);
    let mut seeds = packets();
    seeds.extend(of_a_robot());
    assert!(seeds.len() > 100);
    let mut endpoint = endpoint(StationId(1));
    let state = RobotState::default();
    let (mut taken, mut dropped) = (0, 0);
    for n in 0..PACKETS {
        let seed = noise.random_range(0..seeds.len());
        let mut packet = seeds[seed].clone();
        match n % 4 {
            // As it is, with flipped bits, cut off, or noise from somewhere on.
            0 => {}
            1 => {
                for _ in 0..noise.random_range(1..4) {
                    let bit = noise.random_range(0..packet.len() * 8);
                    packet[bit / 8] ^= 0x80 >> (bit % 8);
                }
            }
            2 => packet.truncate(noise.random_range(0..packet.len())),
            _ => {
                let from = noise.random_range(0..packet.len());
                noise.fill_bytes(&mut packet[from..]);
            }
        }
        let datagram = Stimulus::Datagram {
            packet: &packet,
            arrived_ms: moment(n).now_ms,
        };
        let effects = endpoint.handle(moment(n), &state, datagram);
        let drops = effects
            .iter()
            .filter(|effect| matches!(effect, Effect::Dropped { .. }))
            .count();
        assert!(drops <= 1);
        if drops == 1 {
            dropped += 1;
        } else {
            taken += 1;
        }
        assert!(endpoint.map().iter().count() <= 5 * 128);
    }
    assert!(
        taken > PACKETS / 20 && dropped > PACKETS / 2,
        "{taken} {dropped}"
    );
    let counted: u64 = endpoint.counters().named().total(|_| true);
    assert!(counted >= dropped);
}
