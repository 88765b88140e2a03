//! People that other stations report: how far they may be from the place that a message says.
#![expect(clippy::float_cmp, reason = "whole centimetres")]

use crossguard_codec::asn1::cdd::{
    CardinalNumber1B, ConfidenceLevel, TrafficParticipantType, VruClusterInformation,
};
use crossguard_codec::asn1::cdd::{VruProfileAndSubprofile, VruSubProfilePedestrian};
use crossguard_codec::asn1::cpm::{
    DeltaTimeMilliSecondSigned, ObjectClass, ObjectClassDescription, ObjectClassWithConfidence,
};
use crossguard_codec::core::vam::VruClusterInformationContainer;
use crossguard_codec::geonet::{EgoPosition, Stack};
use crossguard_codec::its::{CpmContainer, ItsMessage};
use crossguard_codec::{
    Identifiers, Identity, Kind, Position, RoadUser, RobotState, Service, core, encode, golden,
    ram_from,
};
use crossguard_endpoint::Stimulus;
use crossguard_endpoint::station::{LocalDynamicMap, Neighbour};
use crossguard_protocol::{Availability, Robot, StationId};

use crate::support::{endpoint, moment};

/// The station of the golden vectors.
const HEAD: StationId = StationId(123_456_789);

/// A message of the golden vectors. Those of `ITS` are made at `moment(0)`.
fn message(file: &'static str, name: &str) -> ItsMessage {
    let octets = hex::decode(golden::vector(file, name)).unwrap();
    let decoded = ItsMessage::decode(&Identifiers::default(), &octets);
    decoded.unwrap().message
}

/// The map of a robot that hears a message of the station.
fn map_of(service: Service, octets: &[u8]) -> LocalDynamicMap {
    let (now, state) = (moment(0), RobotState::default());
    let mut stack = Stack::of_robot(Identifiers::default(), HEAD);
    let ego = EgoPosition::of(&state, now.timestamp_its);
    let packet = &stack.packet(&ego, service, octets).unwrap();
    let mut endpoint = endpoint(StationId(1));
    let datagram = Stimulus::Datagram {
        packet,
        arrived_ms: now.now_ms,
    };
    endpoint.handle(now, &state, datagram);
    endpoint.map().clone()
}

/// The people on it.
fn heard(service: Service, octets: &[u8]) -> Vec<RoadUser> {
    let map = map_of(service, octets);
    map.of_kind(Kind::Vru).map(|known| known.user).collect()
}

/// The only person or group of a message, and the error of its place in centimetres.
fn one(message: &ItsMessage) -> (RoadUser, f64) {
    let ids = Identifiers::default();
    let (service, octets) = match message {
        ItsMessage::Vam(vam) => (Service::Vam, encode(&ids, &**vam)),
        ItsMessage::Cpm(cpm) => (Service::Cpm, encode(&ids, &**cpm)),
        other => panic!("{other:?}"),
    };
    let people = heard(service, &octets.unwrap());
    let [user] = people[..] else {
        panic!("{people:?}")
    };
    (user, (user.position.error_m() * 100.0).round())
}

/// A VAM whose cluster is changed.
fn cluster(name: &str, change: impl FnOnce(&mut VruClusterInformation)) -> ItsMessage {
    let ItsMessage::Vam(mut vam) = message(golden::VAM, name) else {
        panic!("not a VAM")
    };
    let parameters = &mut vam.vam.vam_parameters;
    let container = parameters.vru_cluster_information_container.as_mut();
    change(&mut container.unwrap().vru_cluster_information);
    ItsMessage::Vam(vam)
}

/// Hazard: the middle of a group is beside the road, and some of its people are on it.
#[test]
fn a_cluster_reaches_as_far_as_its_shape() {
    let (_, alone_cm) = one(&message(golden::VAM, "V1"));
    // A circle of 5 m, the corners of a rectangle and of a polygon.
    for (name, reaches_cm) in [("V3", 500.0), ("V8", 583.0), ("V9", 8.0)] {
        let (user, error_cm) = one(&message(golden::VAM, name));
        assert_eq!(user.cardinality, 5, "{name}");
        assert_eq!(error_cm, alone_cm + reaches_cm, "{name}");
    }
    let (_, unsaid_cm) = one(&cluster("V8", |it| it.cluster_bounding_box_shape = None));
    assert_eq!(unsaid_cm, alone_cm + 500.0);
}

/// Hazard: a cluster of which nobody knows how many they are is nobody, and so is a head whose cluster is over.
#[test]
fn a_cluster_of_unknown_size_is_somebody_and_its_head_too() {
    let nobody = |it: &mut VruClusterInformation| {
        it.cluster_cardinality_size = CardinalNumber1B(0);
    };
    let (group, reaches_cm) = one(&cluster("V3", nobody));
    let (known, known_cm) = one(&message(golden::VAM, "V3"));
    assert_eq!((group.identity, reaches_cm), (known.identity, known_cm));
    let (head, error_cm) = one(&cluster("V3", |it| {
        nobody(it);
        it.cluster_bounding_box_shape = None;
    }));
    let (alone, alone_cm) = one(&message(golden::VAM, "V1"));
    assert_eq!(head.identity, Identity::Station(HEAD.0));
    assert_eq!((head.identity, error_cm), (alone.identity, alone_cm));
}

/// A robot that says that its cluster is over is a robot.
#[test]
fn people_in_a_ram_reach_as_far_as_their_shape_and_its_sender_is_none_of_them() {
    let ids = Identifiers::default();
    let of_size = |size: u8, shape| {
        let state = RobotState {
            position: Position::at(49.0, 8.4),
            ..RobotState::default()
        };
        let view = Robot::new(HEAD, 1).ram();
        let ram = ram_from(&ids, &state, &view, Availability::Available, 0, false);
        let mut ram = ram.unwrap();
        let information = core::cdd::VruClusterInformation {
            cluster_id: Some(core::cdd::Identifier1B(7)),
            cluster_bounding_box_shape: shape,
            cluster_cardinality_size: core::cdd::CardinalNumber1B(size),
            cluster_profiles: None,
        };
        ram.ram.ram_parameters.vru_cluster_information_container =
            Some(VruClusterInformationContainer {
                vru_cluster_information: information,
            });
        let people = heard(Service::Ram, &encode(&ids, &ram).unwrap());
        let errors = people.iter().map(|it| it.position.error_m());
        errors.collect::<Vec<_>>()
    };
    let circle = core::cdd::Shape::Circular(core::cdd::CircularShape {
        shape_reference_point: None,
        radius: core::cdd::StandardLength12b::saturating(20),
        height: None,
    });
    assert_eq!(of_size(3, Some(circle)), [3.0]);
    assert_eq!(of_size(3, None), [6.0]);
    assert!(of_size(0, None).is_empty());
}

/// The object of P2 as one of these classes, measured so long before its message is made by a station whose clock is so far ahead.
fn object(classes: &[(ObjectClass, u8)], age_ms: i16, ahead_ms: u64, tells: bool) -> ItsMessage {
    let ItsMessage::Cpm(mut cpm) = message(golden::ITS, "P2") else {
        panic!("not a CPM")
    };
    cpm.management_container.reference_time.0 += ahead_ms;
    let objects = cpm.cpm_containers.iter_mut().find_map(|it| match it {
        CpmContainer::PerceivedObjectContainer(it) => Some(&mut it.perceived_objects.0),
        _ => None,
    });
    let object = &mut objects.unwrap()[0];
    object.measurement_delta_time = DeltaTimeMilliSecondSigned(-age_ms);
    let classes = classes.iter().map(|(class, confidence)| {
        ObjectClassWithConfidence::new(class.clone(), ConfidenceLevel(*confidence))
    });
    object.classification = Some(ObjectClassDescription(classes.collect()));
    object.velocity.take_if(|_| !tells);
    ItsMessage::Cpm(cpm)
}

fn pedestrian() -> ObjectClass {
    let person = VruProfileAndSubprofile::pedestrian(VruSubProfilePedestrian(1));
    ObjectClass::vruSubClass(person)
}

/// Hazard: the clock of a road-side unit is ahead, and what it has seen 1.5 s ago counts as seen now.
#[test]
fn what_a_cpm_tells_is_as_old_as_it_says_whatever_the_clock_of_its_station() {
    let now_its = moment(0).timestamp_its;
    for ahead_ms in [0, 500, 10_000] {
        let (person, _) = one(&object(&[(pedestrian(), 90)], 1_500, ahead_ms, true));
        assert_eq!(person.measured_its, now_its - 1_500, "{ahead_ms}");
    }
}

/// Hazard: somebody who was beside the road 1.5 s ago is on it, and counts as beside it.
#[test]
fn people_in_a_cpm_have_gone_on_since_they_were_seen() {
    let error_cm = |age_ms, tells| one(&object(&[(pedestrian(), 90)], age_ms, 0, tells)).1;
    let seen_now_cm = error_cm(0, true);
    assert_eq!(error_cm(0, false), seen_now_cm);
    // At the 2.236 m/s that they are said to walk, and at 4 m/s.
    for (tells, walked_cm) in [(true, 335.4), (false, 600.0)] {
        let off_cm = error_cm(1_500, tells) - seen_now_cm - walked_cm;
        assert!(off_cm.abs() <= 1.0, "{tells} {off_cm}");
    }
}

/// Hazard: only the most probable class of an object counts, and a person is nobody by a hair.
#[test]
fn an_object_of_a_cpm_may_be_a_person_as_well_as_a_vehicle() {
    let ids = Identifiers::default();
    for (vehicle, person, expected) in [
        (51, 49, true),
        (49, 51, true),
        (99, 1, true),
        (33, 67, false),
        // Not known.
        (101, 101, true),
    ] {
        let car = ObjectClass::vehicleSubClass(TrafficParticipantType(5));
        let cpm = object(&[(car, vehicle), (pedestrian(), person)], 0, 0, true);
        let ItsMessage::Cpm(cpm) = cpm else { panic!() };
        let map = map_of(Service::Cpm, &encode(&ids, &*cpm).unwrap());
        let is_either = |known: &Neighbour| known.is_either;
        let found: Vec<_> = map.iter().map(is_either).collect();
        assert_eq!(found, [expected], "{vehicle} {person}");
    }
}

#[test]
fn a_group_in_a_cpm_reaches_5_m() {
    let error_cm = |class| one(&object(&[(class, 90)], 0, 0, true)).1;
    let group = VruClusterInformation::new(None, None, CardinalNumber1B(3), None);
    let alone_cm = error_cm(pedestrian());
    assert_eq!(
        error_cm(ObjectClass::groupSubClass(group)),
        alone_cm + 500.0
    );
}
