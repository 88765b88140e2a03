//! The whole receive path of an endpoint against octets of all kinds: the same entry point as the
//! fuzz target `receive` in `harness/fuzz`.

use crossguard_codec::geonet::{EgoPosition, Stack};
use crossguard_codec::{Identifiers, Service, golden};
use crossguard_endpoint::{Effect, Stimulus};
use crossguard_protocol::{Place, StationId, TaskType};
use rand::{Rng, RngCore, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::support::{detected, endpoint, handle, hear, sent};

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
    let event = detected(TaskType::INITIAL_POS, Place::UNKNOWN);
    let effects = handle(&mut robot, 200, Stimulus::Event(event));
    let sent = sent(&effects, None).into_iter();
    sent.map(|(packet, _)| packet.to_vec()).collect()
}

#[test]
fn any_packet_is_taken_or_dropped_under_a_cause() {
    let mut noise = ChaCha8Rng::seed_from_u64(4);
    let mut seeds = packets();
    seeds.extend(of_a_robot());
    assert!(seeds.len() > 100);
    let mut endpoint = endpoint(StationId(1));
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
        let effects = hear(&mut endpoint, n, &packet);
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
