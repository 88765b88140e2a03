//! Hazard: a robot does not say that a cluster is over, and the devices that fell silent for it stay silent.

use crossguard_codec::core::ram::RAM;
use crossguard_codec::its::ItsMessage;
use crossguard_codec::{Identifiers, Position, RobotState, Service, decode};
use crossguard_endpoint::ras::clustering::{PerceivedVru, VruClass};
use crossguard_endpoint::ras::containers;
use crossguard_endpoint::ras::motion::{Plane, Point};
use crossguard_endpoint::ras::surroundings::Awareness;
use crossguard_endpoint::{Effect, Endpoint, Moment, Stimulus};
use crossguard_protocol::{Config, Robot, StationId};

/// A message that the robot sent of a cluster.
#[derive(PartialEq, Debug)]
enum Sent {
    Cluster(u8),
    Ended(u8),
    BreakupVam(u8),
}

fn sent(effect: &Effect) -> Option<Sent> {
    let ids = Identifiers::default();
    let Effect::Transmit { kind, octets, .. } = effect else {
        return None;
    };
    match kind {
        Service::Ram => {
            let ram = decode::<RAM>(&ids, octets).unwrap().message;
            let container = (ram.ram.ram_parameters.vru_cluster_information_container).as_ref()?;
            let ended = containers::ended(&container.vru_cluster_information).map(Sent::Ended);
            let plane = Plane::at(49.01, 8.41);
            ended.or_else(|| Some(Sent::Cluster(containers::read(&ram, &plane)?.id?)))
        }
        Service::Vam => {
            let ItsMessage::Vam(vam) = ItsMessage::decode(&ids, octets).unwrap().message else {
                panic!("no VAM")
            };
            let it = vam.vam.vam_parameters;
            it.vru_cluster_operation_container?.cluster_breakup_info?;
            let cluster = it.vru_cluster_information_container?;
            Some(Sent::BreakupVam(
                cluster.vru_cluster_information.cluster_id?.0,
            ))
        }
        _ => None,
    }
}

fn person(id: u32, position_m: Point) -> PerceivedVru {
    PerceivedVru {
        id,
        position_m,
        velocity_mps: [0.0, 1.4],
        class: VruClass::Pedestrian,
        confidence: 0.9,
    }
}

#[test]
fn a_cluster_whose_members_are_gone_is_said_to_be_over_at_once_told_once_and_repeated() {
    let awareness = Awareness {
        cluster_vam_interval_ms: Some(500),
        ..Awareness::default()
    };
    let robot = Robot::new(StationId(7), 1);
    let endpoint = Endpoint::new(robot, Config::default(), Identifiers::default(), 0);
    let mut endpoint = endpoint.with_awareness(awareness);
    let state = RobotState {
        position: Position::at(49.01, 8.41),
        ..RobotState::default()
    };
    let mut messages = Vec::new();
    // One of the two goes out of the zone, the other stays.
    for now_ms in (100..=6_000).step_by(100) {
        let east_m = if now_ms <= 3_000 { 3.0 } else { 30.0 };
        let people = [person(1, [east_m, 0.0]), person(2, [-9.0, 0.0])];
        let moment = Moment {
            now_ms,
            timestamp_its: 694_694_400_000 + now_ms,
        };
        let effects = endpoint.handle(moment, &state, Stimulus::Perceived(&people));
        messages.extend(effects.iter().filter_map(sent).map(|it| (now_ms, it)));
    }
    let (before, after) = messages.split_at(messages.partition_point(|(at_ms, _)| *at_ms <= 3_000));
    let told = after.iter().filter(|(_, it)| matches!(it, Sent::Ended(_)));
    let [(told_ms, Sent::Ended(id))] = told.collect::<Vec<_>>()[..] else {
        panic!("not told once: {after:?}");
    };
    assert!(*told_ms <= 3_200, "{told_ms}");
    assert!(before.iter().any(|(_, it)| *it == Sent::Cluster(*id)));
    let still = |of: &dyn Fn(u8) -> bool| {
        after
            .iter()
            .any(|(_, it)| matches!(it, Sent::Cluster(id) if of(*id)))
    };
    assert!(!still(&|it| it == *id), "it is announced: {after:?}");
    assert!(still(&|it| it != *id), "nor is the other: {after:?}");
    // `numClusterVAMRepeat` is three.
    let repeated = after.iter().filter(|(_, it)| *it == Sent::BreakupVam(*id));
    let repeated: Vec<_> = repeated.map(|(at_ms, _)| at_ms - 3_100).collect();
    assert!(
        repeated.len() == 3 && repeated[0] == 0 && repeated[2] <= 1_000,
        "{repeated:?}"
    );
}
