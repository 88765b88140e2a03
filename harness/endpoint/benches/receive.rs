//! The whole receive path: from a datagram to what the robot makes of it, in packets a second of one
//! core, for messages of robots, of other stations, and garbage.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use crossguard_codec::geonet::{EgoPosition, Stack};
use crossguard_codec::{Identifiers, RobotState, Service, golden};
use crossguard_endpoint::{Effect, Endpoint, Moment, Stimulus};
use crossguard_protocol::{Config, Robot, StationId};

fn moment(now_ms: u64) -> Moment {
    Moment::after(694_694_401_000, now_ms)
}

fn endpoint(station: u32) -> Endpoint {
    let robot = Robot::new(StationId(station), 1);
    Endpoint::new(robot, Config::default(), Identifiers::default(), 0)
}

/// A RAM of a robot that has no part in anything.
fn ram() -> Vec<u8> {
    let state = RobotState::default();
    let effects = endpoint(2).handle(moment(2_000), &state, Stimulus::Time);
    let packet = effects.into_iter().find_map(|effect| match effect {
        Effect::Transmit { packet, .. } => Some(packet),
        _ => None,
    });
    packet.expect("a RAM is due")
}

fn packet(service: Service, vectors: &'static str, name: &str) -> Vec<u8> {
    let octets = hex::decode(golden::vector(vectors, name)).expect("hexadecimal digits");
    Stack::of_robot(Identifiers::default(), StationId(9))
        .packet(&EgoPosition::default(), service, &octets)
        .expect("it fits")
}

fn receive(c: &mut Criterion) {
    let mut group = c.benchmark_group("receive");
    group.throughput(Throughput::Elements(1));
    for (name, packet) in [
        ("RAM", ram()),
        ("CAM", packet(Service::Cam, golden::ITS, "C2")),
        ("VAM", packet(Service::Vam, golden::VAM, "V11")),
        ("CPM", packet(Service::Cpm, golden::ITS, "P2")),
        ("garbage", vec![0xA5; 200]),
        ("unknown port", {
            let mut packet = packet(Service::Cam, golden::ITS, "C2");
            packet[41] = 0xD3;
            packet
        }),
    ] {
        let mut endpoint = endpoint(1);
        let state = RobotState::default();
        group.bench_function(name, |bencher| {
            // The clock stands still, so that no RAM is made in between.
            let now = moment(10);
            bencher.iter(|| {
                let datagram = Stimulus::Datagram {
                    packet: black_box(&packet),
                    arrived_ms: now.now_ms,
                };
                endpoint.handle(now, &state, datagram)
            });
        });
    }
    group.finish();
}

criterion_group!(benches, receive);
criterion_main!(benches);
