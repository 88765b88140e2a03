//! The golden vectors of CAM, DENM, CPM and of VAM on both dictionaries, whole and followed by noise.
//! `broken_vectors.rs` breaks them systematically.

use crate::support::{canonical, its_vectors, on};
use crossguard_codec::asn1::cam::{
    CAM, CauseCodeV2, HighFrequencyContainer, SpecialVehicleContainer,
};
use crossguard_codec::asn1::cdd::VruProfileAndSubprofile;
use crossguard_codec::asn1::cdd211::{VruProfileAndSubprofile211, VruSubProfilePedestrian211};
use crossguard_codec::asn1::cpm::{ObjectClass, Velocity3dWithConfidence};
use crossguard_codec::its::{CpmContainer, ItsMessage};
use crossguard_codec::{Dictionary, Identifiers, Identity, Kind, distance};
use crossguard_protocol::Decimetres;
use proptest::prelude::*;

fn vectors() -> Vec<(&'static str, Identifiers, Vec<u8>)> {
    its_vectors().collect()
}

fn message(name: &str) -> ItsMessage {
    let all = vectors();
    let (_, identifiers, octets) = all.iter().find(|(n, ..)| *n == name).expect("a vector");
    let received = ItsMessage::decode(identifiers, octets).expect(name);
    assert_eq!(received.extended, 0);
    received.message
}

#[test]
fn every_vector_comes_back_bit_for_bit() {
    let all = vectors();
    assert_eq!(all.len(), 11 + 11);
    for (name, identifiers, octets) in all {
        let received = ItsMessage::decode(&identifiers, &octets).expect(name);
        assert_eq!(received.extended, 0, "{name}");
        assert_eq!(
            received.message.encode(&identifiers).unwrap(),
            octets,
            "{name}"
        );
        assert_eq!(
            received.message.header().station_id.0,
            123_456_789,
            "{name}"
        );
    }
}

#[test]
fn every_vector_comes_back_from_json() {
    for (name, ..) in vectors() {
        let message = message(name);
        let json = serde_json::to_string(&message).unwrap();
        let again: ItsMessage = serde_json::from_str(&json).expect(name);
        assert_eq!(again, message, "{name}");
    }
}

#[test]
fn a_cam_has_the_values_that_it_was_made_of() {
    let ItsMessage::Cam(cam) = message("C3") else {
        panic!("not a CAM")
    };
    assert_eq!(cam.cam.generation_delta_time.0, 12_345);
    let parameters = &cam.cam.cam_parameters;
    assert_eq!(parameters.basic_container.station_type.0, 5);
    let HighFrequencyContainer::basicVehicleContainerHighFrequency(motion) =
        &parameters.high_frequency_container
    else {
        panic!("not a vehicle")
    };
    assert_eq!(motion.heading.heading_value.0, 900);
    assert_eq!(motion.speed.speed_value.0, 1_389);
    assert_eq!(motion.vehicle_length.vehicle_length_value.0, 42);
    assert_eq!(motion.vehicle_width.0, 18);
    let Some(SpecialVehicleContainer::emergencyContainer(emergency)) =
        &parameters.special_vehicle_container
    else {
        panic!("not an emergency vehicle")
    };
    assert_eq!(emergency.light_bar_siren_in_use.0.count_ones(), 2);
    assert!(emergency.incident_indication.is_none());
}

#[test]
fn a_cause_beyond_those_of_release_2_is_kept_in_a_cam() {
    let vectors = vectors();
    let (_, identifiers, octets) = vectors.iter().find(|(name, ..)| *name == "C3").unwrap();
    for cause in [128, 200, 255] {
        let ItsMessage::Cam(mut cam) = message("C3") else {
            panic!("not a CAM")
        };
        let special = &mut cam.cam.cam_parameters.special_vehicle_container;
        let Some(SpecialVehicleContainer::emergencyContainer(emergency)) = special else {
            panic!("not an emergency vehicle")
        };
        emergency.incident_indication = Some(CauseCodeV2::new(cause, 1));
        let with_cause = crossguard_codec::encode(identifiers, &*cam).unwrap();
        assert!(with_cause.len() > octets.len());
        let again = crossguard_codec::decode::<CAM>(identifiers, &with_cause).unwrap();
        assert_eq!(again.message, *cam, "cause {cause}");
    }
}

#[test]
fn the_extension_container_of_a_cam_is_kept() {
    let ItsMessage::Cam(cam) = message("C4") else {
        panic!("not a CAM")
    };
    let containers = cam.cam.cam_parameters.extension_containers.unwrap();
    assert_eq!(containers.0.len(), 1);
    let data = &containers.0[0].container_data;
    assert_eq!(&*data.0, [0x20, 0x60, 0x80]);
}

#[test]
fn a_cpm_has_its_object() {
    let ItsMessage::Cpm(cpm) = message("P2") else {
        panic!("not a CPM")
    };
    assert_eq!(cpm.management_container.reference_time.0, 694_694_401_000);
    let Some(CpmContainer::PerceivedObjectContainer(objects)) = cpm.cpm_containers.last() else {
        panic!("no objects")
    };
    let object = &objects.perceived_objects.0[0];
    assert_eq!(object.object_id.as_ref().unwrap().0, 5);
    assert_eq!(object.measurement_delta_time.0, -10);
    assert_eq!(object.position.x_coordinate.value.0, 1_000);
    assert_eq!(object.position.y_coordinate.value.0, -500);
    let Some(Velocity3dWithConfidence::cartesianVelocity(velocity)) = &object.velocity else {
        panic!("no velocity")
    };
    assert_eq!(
        (velocity.x_velocity.value.0, velocity.y_velocity.value.0),
        (100, -200)
    );
    assert_eq!(object.object_age.as_ref().unwrap().0, 500);
    let classes = &object.classification.as_ref().unwrap().0;
    assert!(matches!(&classes[0].object_class, ObjectClass::vehicleSubClass(kind) if kind.0 == 5));
    assert!(matches!(
        &classes[1].object_class,
        ObjectClass::vruSubClass(_)
    ));
}

#[test]
fn a_dictionary_makes_other_bits_of_the_same_road_user() {
    let ItsMessage::Vam211(vam) = message("W2") else {
        panic!("not a VAM of the older dictionary")
    };
    let slow = vam.vam.vam_parameters.vru_low_frequency_container.unwrap();
    assert!(matches!(
        slow.profile_and_subprofile,
        VruProfileAndSubprofile211::pedestrian(VruSubProfilePedestrian211::ordinary_pedestrian)
    ));
    // Read with the other dictionary, it is a road worker: no header tells.
    let all = vectors();
    let (_, _, octets) = all.iter().find(|(name, ..)| *name == "W2").unwrap();
    let misread = ItsMessage::decode(&on(Dictionary::V2_4_1), octets).unwrap();
    let ItsMessage::Vam(vam) = misread.message else {
        panic!("not a VAM")
    };
    let slow = vam.vam.vam_parameters.vru_low_frequency_container.unwrap();
    assert!(matches!(
        slow.profile_and_subprofile,
        VruProfileAndSubprofile::pedestrian(kind) if kind.0 == 2
    ));
}

#[test]
fn road_users_are_where_their_messages_say() {
    let now = 694_694_401_000;
    let user = |name| message(name).road_users(now)[0];
    let car = user("C1");
    assert_eq!(
        (car.identity, car.kind),
        (Identity::Station(123_456_789), Kind::Vehicle)
    );
    assert_eq!((car.speed, car.heading), (Some(13.89), Some(90.0)));
    assert_eq!(car.position.latitude, Some(48.765_432_1));
    for (name, cardinality) in [("V1", 1), ("V3", 5), ("W1", 1), ("W6", 5)] {
        let pedestrian = user(name);
        assert_eq!(
            (pedestrian.kind, pedestrian.cardinality),
            (Kind::Vru, cardinality)
        );
        assert_eq!(pedestrian.speed, Some(1.39));
    }
    let cluster = Identity::Object {
        by: 123_456_789,
        number: 7,
    };
    assert_eq!(user("V3").identity, cluster);
    assert_eq!(user("V3").position, car.position);
    // Its shape is 10 cm east and 20 cm south of the sender.
    let off = distance(&user("V8").position, &car.position);
    assert_eq!(off, Decimetres(2));
    for nobody in ["P1", "D1"] {
        assert!(message(nobody).road_users(now).is_empty(), "{nobody}");
    }
    let object = user("P2");
    let identity = Identity::Object {
        by: 123_456_789,
        number: 5,
    };
    assert_eq!((object.identity, object.kind), (identity, Kind::Vehicle));
    assert_eq!(object.station_type, Some(5));
    assert_eq!(object.measured_its, now - 10);
    // 10 m east and 5 m south of the sender.
    assert_eq!(
        distance(&object.position, &car.position),
        Decimetres(112),
        "{object:?}"
    );
    assert_eq!(object.heading.map(f64::round), Some(153.0));
    assert_eq!(
        object.speed.map(|speed| (speed * 100.0).round()),
        Some(224.0)
    );
}

#[test]
fn every_message_names_its_standard() {
    for (name, standard) in [
        ("C1", "EN 302 637-2 v1.4.1"),
        ("C4", "TS 103 900 v2.3.1"),
        ("D1", "EN 302 637-3 v1.3.1 and TS 103 831 v2.3.1"),
        ("P2", "TS 103 324 v2.1.1 on TS 102 894-2 v2.4.1"),
        ("V2", "TS 103 300-3 v2.3.1 on TS 102 894-2 v2.4.1"),
        ("W2", "TS 103 300-3 v2.2.1 on TS 102 894-2 v2.1.1"),
    ] {
        assert!(message(name).standard().starts_with(standard), "{name}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2_000))]

    #[test]
    fn any_octets_are_refused_or_come_back(
        index in any::<prop::sample::Index>(),
        cut in any::<prop::sample::Index>(),
        noise in prop::collection::vec(any::<u8>(), 0..80),
    ) {
        let all = vectors();
        let (_, identifiers, octets) = index.get(&all);
        let kept = cut.index(octets.len());
        let _ = canonical(identifiers, &[&octets[..kept], &noise].concat());
    }
}
