//! Hazard: a robot announces people who move apart as one group, at a place and with a velocity that nobody has. A
//! device beside them then takes itself for one of them and falls silent, and a vehicle looks for it elsewhere.

use crossguard_codec::core::ram::RAM;
use crossguard_codec::its::ItsMessage;
use crossguard_codec::{Identifiers, Position, RobotState, Service, decode};
use crossguard_endpoint::ras::clustering::{PerceivedVru, VruClass};
use crossguard_endpoint::ras::containers::{self, Announced};
use crossguard_endpoint::ras::motion::{Motion, Plane, Point};
use crossguard_endpoint::ras::surroundings::Awareness;
use crossguard_endpoint::{Effect, Endpoint, Moment, Stimulus};
use crossguard_evaluation::vru::{Announcement, Suppression, Understands, VamRule, VruStation};
use crossguard_protocol::{Config, Robot, StationId};

const HEAD: u32 = 7;

/// A message that the robot sent of the people around it.
enum Sent {
    Cluster(Announced, Option<[f64; 2]>),
    Ended(u8),
    BreakupVam(u8),
}

struct Street {
    endpoint: Endpoint,
    state: RobotState,
    now_ms: u64,
}

impl Street {
    fn new() -> Self {
        let robot = Robot::new(StationId(HEAD), 1);
        let ids = Identifiers::default();
        let awareness = Awareness {
            cluster_vam_interval_ms: Some(500),
            ..Awareness::default()
        };
        Self {
            endpoint: Endpoint::new(robot, Config::default(), ids, 0).with_awareness(awareness),
            state: RobotState {
                position: Position::at(49.01, 8.41),
                ..RobotState::default()
            },
            now_ms: 0,
        }
    }

    /// The robot perceives these people for so long, every 100 ms; what it sends meanwhile, and when.
    fn perceives(
        &mut self,
        for_ms: u64,
        people: impl Fn(u64) -> Vec<PerceivedVru>,
    ) -> Vec<(u64, Sent)> {
        let mut sent = Vec::new();
        for _ in 0..for_ms / 100 {
            self.now_ms += 100;
            let moment = Moment {
                now_ms: self.now_ms,
                timestamp_its: 694_694_400_000 + self.now_ms,
            };
            let stimulus = people(self.now_ms);
            let effects = self
                .endpoint
                .handle(moment, &self.state, Stimulus::Perceived(&stimulus));
            sent.extend(effects.iter().filter_map(said).map(|it| (self.now_ms, it)));
        }
        sent
    }
}

fn said(effect: &Effect) -> Option<Sent> {
    let ids = Identifiers::default();
    let plane = Plane::at(49.01, 8.41);
    match effect {
        Effect::Transmit {
            kind: Service::Ram,
            octets,
            ..
        } => {
            let ram = decode::<RAM>(&ids, octets).unwrap().message;
            let container = ram
                .ram
                .ram_parameters
                .vru_cluster_information_container
                .as_ref()?;
            match containers::ended(&container.vru_cluster_information) {
                Some(id) => Some(Sent::Ended(id)),
                None => containers::read(&ram, &plane)
                    .map(|it| Sent::Cluster(it, containers::velocity_mps(&ram))),
            }
        }
        Effect::Transmit {
            kind: Service::Vam,
            octets,
            ..
        } => {
            let ItsMessage::Vam(vam) = ItsMessage::decode(&ids, octets).unwrap().message else {
                panic!("no VAM")
            };
            let parameters = vam.vam.vam_parameters;
            parameters
                .vru_cluster_operation_container?
                .cluster_breakup_info?;
            let cluster = parameters
                .vru_cluster_information_container?
                .vru_cluster_information;
            Some(Sent::BreakupVam(cluster.cluster_id?.0))
        }
        _ => None,
    }
}

fn person(id: u32, position_m: Point, velocity_mps: [f64; 2]) -> PerceivedVru {
    PerceivedVru {
        id,
        position_m,
        velocity_mps,
        class: VruClass::Pedestrian,
        confidence: 0.9,
    }
}

fn clusters(sent: &[(u64, Sent)]) -> Vec<(&Announced, [f64; 2])> {
    let clusters = sent.iter().filter_map(|(_, it)| match it {
        Sent::Cluster(cluster, velocity_mps) => Some((cluster, velocity_mps.unwrap())),
        Sent::Ended(_) | Sent::BreakupVam(_) => None,
    });
    clusters.collect()
}

/// Whether a device falls silent by a cluster.
fn silences(motion: &Motion, (cluster, velocity_mps): (&Announced, [f64; 2])) -> bool {
    let announcement = Announcement {
        head: HEAD,
        by: Understands::Ram,
        cluster: Some(cluster.clone()),
        velocity_mps: Some(velocity_mps),
        ended: None,
    };
    let mut device = VruStation::new(VamRule::Etsi, Understands::Ram, Suppression::Strict);
    device.hear(0, motion, &announcement);
    device.is_passive()
}

const NORTH: [f64; 2] = [0.0, 1.4];

#[test]
fn people_who_walk_north_and_a_cyclist_who_goes_east_are_announced_apart() {
    let mut street = Street::new();
    let sent = street.perceives(3_000, |_| {
        let cyclist = PerceivedVru {
            class: VruClass::Bicyclist,
            ..person(3, [1.0, 4.0], [5.0, 0.0])
        };
        vec![
            person(1, [0.0, 5.0], NORTH),
            person(2, [1.5, 5.0], NORTH),
            cyclist,
        ]
    });
    let clusters = clusters(&sent);
    let counts = |of: u8| clusters.iter().filter(move |it| it.0.cardinality == of);
    assert!(counts(2).count() >= 1 && counts(1).count() >= 1);
    assert_eq!(counts(3).count(), 0);
    for (cluster, [east, north]) in &clusters {
        let is_as_perceived = match cluster.cardinality {
            2 => east.abs() < 0.05 && (north - 1.4).abs() < 0.05,
            _ => (east - 5.0).abs() < 0.05 && north.abs() < 0.05,
        };
        assert!(is_as_perceived, "{cluster:?} {east} {north}");
    }
    // The device of a person between them was not perceived, and does not take itself for one of them.
    let unseen = Motion {
        position_m: [0.7, 4.8],
        ..Motion::default()
    };
    for cluster in clusters {
        assert!(!silences(&unseen, cluster));
    }
}

#[test]
fn a_cluster_whose_members_are_gone_is_said_to_be_over_at_once_told_once_and_repeated() {
    let mut street = Street::new();
    let near = |_| vec![person(1, [3.0, 0.0], NORTH), person(2, [-9.0, 0.0], NORTH)];
    let sent = street.perceives(3_000, near);
    let at_m = |east_m: f64| move |it: &&(&Announced, _)| it.0.area.contains([east_m, 0.0]);
    let id = clusters(&sent)
        .iter()
        .find(at_m(3.0))
        .unwrap()
        .0
        .id
        .unwrap();
    // One of the two is out of the zone, the other stays.
    let sent = street.perceives(3_000, |_| {
        vec![person(1, [30.0, 0.0], NORTH), person(2, [-9.0, 0.0], NORTH)]
    });
    let when = |of: fn(&Sent) -> Option<u8>| -> Vec<u64> {
        let said = sent.iter().filter(|(_, it)| of(it) == Some(id));
        said.map(|(at_ms, _)| at_ms - 3_100).collect()
    };
    let told_once = when(|it| match it {
        Sent::Ended(id) => Some(*id),
        _ => None,
    });
    assert!(told_once.len() == 1 && told_once[0] <= 100, "{told_once:?}");
    // `numClusterVAMRepeat` is three.
    let repeated = when(|it| match it {
        Sent::BreakupVam(id) => Some(*id),
        _ => None,
    });
    assert!(
        repeated.len() == 3 && repeated[0] == 0 && repeated[2] <= 1_000,
        "{repeated:?}"
    );
    let still = when(|it| match it {
        Sent::Cluster(cluster, _) => cluster.id,
        _ => None,
    });
    assert!(
        still.is_empty(),
        "a cluster that is over is announced: {still:?}"
    );
}
