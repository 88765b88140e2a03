//! The golden vectors of CAM, CPM and of VAM on both dictionaries. `broken_vectors.rs` breaks them
//! systematically, `foreign.rs` at random.

use crate::support::{its_vectors, on};
use crossguard_codec::asn1::cam::{
    BasicVehicleContainerHighFrequency, CAM, CauseCodeV2, HighFrequencyContainer,
    SpecialVehicleContainer, VehicleLength, VehicleLengthConfidenceIndication, VehicleLengthValue,
};
use crossguard_codec::asn1::cdd::{
    DriveDirection, HeadingValue, Identifier2B, ObjectDimensionValue, PosConfidenceEllipse,
    PositionConfidenceEllipse, SemiAxisLength, Wgs84AngleValue,
};
use crossguard_codec::asn1::cpm::{
    CardinalNumber3b, CoordinateConfidence, ManagementContainer, MessageSegmentationInfo,
    ObjectDimension, ObjectDimensionConfidence, OrdinalNumber3b, PerceivedObject,
};
use crossguard_codec::its::{CpmContainer, ItsMessage};
use crossguard_codec::{Dictionary, Identifiers, Identity, Kind, RoadUser, distance};
use crossguard_protocol::Decimetres;
use serde_json::{Value, json};

fn vector(name: &str) -> (Identifiers, Vec<u8>) {
    let vector = its_vectors().find(|(it, ..)| *it == name);
    let (_, identifiers, octets) = vector.expect(name);
    (identifiers, octets)
}

fn message(name: &str) -> ItsMessage {
    let (identifiers, octets) = vector(name);
    let received = ItsMessage::decode(&identifiers, &octets).expect(name);
    assert_eq!(received.extended, 0);
    received.message
}

#[test]
fn every_vector_comes_back_bit_for_bit_and_from_json() {
    assert_eq!(its_vectors().count(), 10 + 11);
    for (name, identifiers, octets) in its_vectors() {
        let message = message(name);
        assert_eq!(message.encode(&identifiers).unwrap(), octets, "{name}");
        assert_eq!(message.header().station_id.0, 123_456_789, "{name}");
        let json = serde_json::to_string(&message).unwrap();
        let again: ItsMessage = serde_json::from_str(&json).expect(name);
        assert_eq!(again, message, "{name}");
    }
}

/// Stations on the road encode otherwise than the kit does: that is read, and told.
#[test]
fn padding_that_is_not_zero_is_read() {
    let (identifiers, mut padded) = vector("C1");
    *padded.last_mut().unwrap() |= 1;
    let received = ItsMessage::decode(&identifiers, &padded).unwrap();
    assert!(!received.is_canonical);
    assert_eq!(received.message, message("C1"));
}

#[test]
fn every_vector_has_the_values_that_it_was_made_of() {
    let all: Vec<_> = its_vectors()
        .map(|(name, ..)| (name, json(&message(name))))
        .collect();
    let rows = include_str!("values.txt").lines();
    for row in rows.filter(|row| !row.starts_with('#')) {
        let cells: Vec<_> = row.splitn(3, ' ').collect();
        let expected: Value = serde_json::from_str(cells[2]).expect(row);
        let named = all.iter().filter(|(name, _)| name.starts_with(cells[0]));
        let mut named = named.peekable();
        assert!(named.peek().is_some(), "{row}");
        for (name, json) in named {
            assert_eq!(json.pointer(cells[1]), Some(&expected), "{name}: {row}");
        }
    }
}

/// The components of a message, by their names.
fn json(message: &ItsMessage) -> Value {
    let json = serde_json::to_value(message).unwrap();
    json.as_object().unwrap().values().next().unwrap().clone()
}

#[test]
fn a_cause_beyond_those_of_release_2_is_kept_in_a_cam() {
    let (identifiers, octets) = vector("C3");
    for cause in [128, 200, 255] {
        let ItsMessage::Cam(mut cam) = message("C3") else {
            panic!("not a CAM")
        };
        let special = &mut cam.cam.cam_parameters.special_vehicle_container;
        let Some(SpecialVehicleContainer::emergencyContainer(emergency)) = special else {
            panic!("not an emergency vehicle")
        };
        emergency.incident_indication = Some(CauseCodeV2::new(cause, 1));
        let with_cause = crossguard_codec::encode(&identifiers, &*cam).unwrap();
        assert!(with_cause.len() > octets.len());
        let again = crossguard_codec::decode::<CAM>(&identifiers, &with_cause).unwrap();
        assert_eq!(again.message, *cam, "cause {cause}");
    }
}

#[test]
fn a_dictionary_makes_other_bits_of_the_same_road_user() {
    // W2 is an ordinary pedestrian. Read with the other dictionary, it is a road worker: no header tells.
    let (_, octets) = vector("W2");
    let misread = ItsMessage::decode(&on(Dictionary::V2_4_1), &octets).unwrap();
    let slow = &json(&misread.message)["vam"]["vamParameters"]["vruLowFrequencyContainer"];
    assert_eq!(slow["profileAndSubprofile"], json!({ "pedestrian": 2 }));
}

#[test]
fn road_users_are_where_their_messages_say() {
    let now = 694_694_401_000;
    let user = |name| message(name).road_users(now)[0];
    let car = user("C1");
    let station = Identity::Station(123_456_789);
    assert_eq!((car.identity, car.kind), (station, Kind::Vehicle));
    assert_eq!((car.speed, car.heading), (Some(13.89), Some(90.0)));
    assert_eq!(car.position.latitude, Some(48.765_432_1));
    assert_eq!(error_cm(&message("C1")), Some(100.0));
    for (name, cardinality) in [("V1", 1), ("V3", 5), ("W1", 1), ("W6", 5)] {
        let user = user(name);
        assert_eq!((user.kind, user.cardinality), (Kind::Vru, cardinality));
        assert_eq!(user.speed, Some(1.39));
    }
    let of_it = |number| Identity::Object {
        by: 123_456_789,
        number,
    };
    assert_eq!(user("V3").identity, of_it(7));
    assert_eq!(user("V3").position, car.position);
    // Its shape is 10 cm east and 20 cm south of the sender.
    let off = distance(&user("V8").position, &car.position);
    assert_eq!(off, Decimetres(2));
    assert!(message("P1").road_users(now).is_empty());
    let object = user("P2");
    assert_eq!((object.identity, object.kind), (of_it(5), Kind::Vehicle));
    assert_eq!(object.station_type, Some(5));
    assert_eq!(object.measured_its, now - 10);
    // 10 m east and 5 m south of the sender.
    let off = distance(&object.position, &car.position);
    assert_eq!(off, Decimetres(112), "{object:?}");
    assert_eq!(object.heading.map(f64::round), Some(153.0));
    let speed_cmps = object.speed.map(|speed| (speed * 100.0).round());
    assert_eq!(speed_cmps, Some(224.0));
}

/// The road user of C1, changed: heading 90°, 4.2 m long, without a trailer.
fn car(change: impl FnOnce(&mut BasicVehicleContainerHighFrequency)) -> RoadUser {
    let ItsMessage::Cam(mut cam) = message("C1") else {
        panic!("not a CAM")
    };
    let fast = &mut cam.cam.cam_parameters.high_frequency_container;
    let HighFrequencyContainer::basicVehicleContainerHighFrequency(motion) = fast else {
        panic!("not a vehicle")
    };
    change(motion);
    ItsMessage::Cam(cam).road_users(694_694_401_000)[0]
}

/// Hazard: a car backs to the crossing, and its station says where its front points.
#[test]
fn the_direction_is_known_of_a_vehicle_that_drives_forward_alone() {
    for (direction, heading) in [
        (DriveDirection::forward, Some(90.0)),
        (DriveDirection::backward, None),
        (DriveDirection::unavailable, None),
    ] {
        let car = car(|motion| motion.drive_direction = direction);
        assert_eq!((car.heading, car.speed), (heading, Some(13.89)));
    }
}

#[test]
fn a_vehicle_is_as_long_as_it_says_with_its_trailer() {
    use VehicleLengthConfidenceIndication as Trailer;
    for (value, trailer, length) in [
        (42, Trailer::noTrailerPresent, Some(4.2)),
        (188, Trailer::trailerPresentWithKnownLength, Some(18.8)),
        (42, Trailer::trailerPresentWithUnknownLength, Some(16.2)),
        (42, Trailer::trailerPresenceIsUnknown, Some(16.2)),
        (42, Trailer::unavailable, Some(16.2)),
        (1_022, Trailer::noTrailerPresent, Some(102.2)),
        (1_023, Trailer::noTrailerPresent, None),
    ] {
        let said = VehicleLength::new(VehicleLengthValue(value), trailer);
        let car = car(|motion| motion.vehicle_length = said);
        assert_eq!(car.length, length, "{value}, {trailer:?}");
    }
    let dimension = |value| {
        let confidence = ObjectDimensionConfidence(1);
        Some(ObjectDimension::new(
            ObjectDimensionValue(value),
            confidence,
        ))
    };
    for (along, across, length) in [
        (dimension(180), dimension(25), Some(18.0)),
        (dimension(25), dimension(180), Some(18.0)),
        (dimension(255), None, Some(25.5)),
        (dimension(256), dimension(25), Some(2.5)),
        (dimension(256), None, None),
    ] {
        let seen = cpm(|_, objects| {
            objects[0].object_dimension_x = along.clone();
            objects[0].object_dimension_y = across.clone();
        });
        let length_said = seen.road_users(694_694_401_000)[0].length;
        assert_eq!(length_said, length);
    }
}

/// P2 with other objects, and changed otherwise.
fn cpm(change: impl FnOnce(&mut ManagementContainer, &mut Vec<PerceivedObject>)) -> ItsMessage {
    let ItsMessage::Cpm(mut cpm) = message("P2") else {
        panic!("not a CPM")
    };
    let objects = cpm.cpm_containers.iter_mut().find_map(|it| match it {
        CpmContainer::PerceivedObjectContainer(it) => Some(&mut it.perceived_objects.0),
        _ => None,
    });
    change(&mut cpm.management_container, objects.unwrap());
    let identifiers = on(Dictionary::V2_4_1);
    let octets = crossguard_codec::encode(&identifiers, &*cpm).unwrap();
    ItsMessage::decode(&identifiers, &octets).unwrap().message
}

/// How far off the first road user may be.
fn error_cm(message: &ItsMessage) -> Option<f64> {
    let users = message.road_users(694_694_401_000);
    let first = users.first()?;
    Some((first.position.error_m() * 100.0).round())
}

/// Hazard: a camera reports people without numbers, and they are nobody; or two of one number are one.
#[test]
fn objects_that_no_number_tells_apart_are_as_many_as_there_are() {
    let identities = |ids: &[Option<u16>], number_of_message| -> Vec<Identity> {
        let message = cpm(|management, objects| {
            let info = MessageSegmentationInfo::new(CardinalNumber3b(8), number_of_message);
            management.segmentation_info = Some(info);
            let object = objects[0].clone();
            *objects = ids.iter().map(|_| object.clone()).collect();
            for (object, id) in objects.iter_mut().zip(ids) {
                object.object_id = id.map(Identifier2B);
            }
        });
        let users = message.road_users(694_694_401_000);
        users.iter().map(|user| user.identity).collect()
    };
    let ids = [None, Some(5), None, Some(5), Some(6)];
    let all: Vec<Identity> = (1..=8)
        .flat_map(|number| identities(&ids, OrdinalNumber3b(number)))
        .collect();
    assert_eq!(all.len(), 8 * ids.len());
    let mut different = all.clone();
    different.sort();
    different.dedup();
    // The messages of one report have the numbers of their objects in common.
    assert_eq!(different.len(), 8 * 3 + 2, "{all:?}");
    assert_eq!(all[..5], identities(&ids, OrdinalNumber3b(1)));
}

/// Hazard: a place that is known to 40 m counts as known to 1 m.
#[test]
fn an_object_is_as_far_off_as_its_report_and_its_origin_may_be() {
    const UNAVAILABLE: u16 = 4_095;
    for (half_axes, angle, coordinates, expected) in [
        ([300, 100], 900, [300, 400], 800.0),
        ([300, 100], 3_601, [300, 400], 800.0),
        ([UNAVAILABLE, 300], 900, [300, 400], 800.0),
        ([4_094, 100], 900, [300, 400], f64::INFINITY),
        ([300, 100], 900, [1, 4_095], f64::INFINITY),
        // Nothing that is not said is better than 1 m.
        ([UNAVAILABLE; 2], 3_601, [300, 400], 600.0),
        ([300, 100], 900, [4_096; 2], 441.0),
        ([UNAVAILABLE; 2], 3_601, [4_096; 2], 241.0),
    ] {
        let message = cpm(|management, objects| {
            let [major, minor] = half_axes.map(SemiAxisLength);
            management.reference_position.position_confidence_ellipse =
                PosConfidenceEllipse::new(major, minor, HeadingValue(angle));
            let position = &mut objects[0].position;
            let [x, y] = coordinates.map(CoordinateConfidence);
            (
                position.x_coordinate.confidence,
                position.y_coordinate.confidence,
            ) = (x, y);
        });
        let what = format!("{half_axes:?} {angle} {coordinates:?}");
        assert_eq!(error_cm(&message), Some(expected), "{what}");
    }
}

/// Hazard: a guard that is known to 40 m counts as known to 1 m, for nobody knows in which direction.
#[test]
fn the_larger_half_axis_counts_where_no_direction_is_said() {
    for (half_axes, angle, expected) in [
        ([4_000, 100], 900, 4_000.0),
        ([4_000, 100], 3_601, 4_000.0),
        ([4_000, 4_095], 900, 4_000.0),
        ([4_095, 4_000], 900, 4_000.0),
        ([100, 4_000], 900, 4_000.0),
        ([4_094, 100], 3_601, f64::INFINITY),
        ([4_095, 4_095], 900, 100.0),
    ] {
        let ItsMessage::Cam(mut cam) = message("C1") else {
            panic!("not a CAM")
        };
        let container = &mut cam.cam.cam_parameters.basic_container;
        let [major, minor] = half_axes.map(SemiAxisLength);
        container.reference_position.position_confidence_ellipse =
            PositionConfidenceEllipse::new(major, minor, Wgs84AngleValue(angle));
        let what = format!("{half_axes:?} {angle}");
        assert_eq!(error_cm(&ItsMessage::Cam(cam)), Some(expected), "{what}");
    }
}

/// Hazard: the people of a cluster whose head is known to 40 m count as known to 1 m.
#[test]
fn a_cluster_is_as_exact_as_its_head() {
    let ItsMessage::Vam(mut vam) = message("V8") else {
        panic!("not a VAM")
    };
    let container = &mut vam.vam.vam_parameters.basic_container;
    let ellipse = &mut container.reference_position.position_confidence_ellipse;
    ellipse.semi_major_axis_length = SemiAxisLength(4_000);
    assert_eq!(error_cm(&ItsMessage::Vam(vam)), Some(4_000.0));
}

#[test]
fn every_message_names_its_standard() {
    for (name, standard) in [
        ("C1", "EN 302 637-2 v1.4.1"),
        ("C4", "TS 103 900 v2.3.1"),
        ("P2", "TS 103 324 v2.1.1 on TS 102 894-2 v2.4.1"),
        ("V2", "TS 103 300-3 v2.3.1 on TS 102 894-2 v2.4.1"),
        ("W2", "TS 103 300-3 v2.2.1 on TS 102 894-2 v2.1.1"),
    ] {
        assert!(message(name).standard().starts_with(standard), "{name}");
    }
}
