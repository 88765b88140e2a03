//! What the types cannot say: rules for messages, for senders and receivers alike.

mod support;

use crossguard_codec::asn1::cdd::{
    CartesianAngleValue, EllipticalShape, PathDeltaTime, RadialShape, Shape, SpeedValue,
    StandardLength12b,
};
use crossguard_codec::asn1::ram::{RAM, SessionRole};
use crossguard_codec::asn1::vam::{VAM, VruMotionPredictionContainer};
use crossguard_codec::{
    BrokenRule, DecodeError, EncodeError, Fault, Identifiers, core, decode, encode,
};
use support::reference::Reference;
use support::{from_hex, samples};

fn largest() -> RAM {
    RAM::of(&samples::largest_ram(&Identifiers::default()))
}

fn prediction(ram: &mut RAM) -> &mut VruMotionPredictionContainer {
    ram.ram
        .ram_parameters
        .vru_motion_prediction_container
        .as_mut()
        .unwrap()
}

/// Why no sender has the message.
fn encode_error(ram: &RAM) -> EncodeError {
    ram.to_message().unwrap_err()
}

/// What a receiver says to a message that a sender without the rules encodes.
fn decode_error(ram: &RAM) -> DecodeError {
    let octets = rasn::uper::encode(ram).unwrap();
    decode::<core::ram::RAM>(&Identifiers::default(), &octets).unwrap_err()
}

/// Sender and receiver find the same fault in the same field.
fn assert_refused(ram: &RAM, name: &str, expected: Fault) {
    let EncodeError::Malformed { field, fault } = encode_error(ram) else {
        panic!("the sender says otherwise");
    };
    assert_eq!((field.names().last(), fault), (Some(name), expected));
    let DecodeError::Malformed { field, fault, .. } = decode_error(ram) else {
        panic!("the receiver says otherwise");
    };
    assert_eq!((field.names().last(), fault), (Some(name), expected));
}

#[test]
fn the_motion_prediction_of_a_ram_has_at_most_ten_points_each_way() {
    let too_many = Fault::TooMany { found: 11, max: 10 };
    let mut ram = largest();
    let history = prediction(&mut ram).path_history.as_mut().unwrap();
    history.0.push(history.0[0].clone());
    assert_refused(&ram, "path_history", too_many);

    let mut ram = largest();
    let path = prediction(&mut ram).path_prediction.as_mut().unwrap();
    path.0.push(path.0[0].clone());
    assert_refused(&ram, "path_prediction", too_many);
}

#[test]
fn the_path_prediction_of_a_vam_has_no_more_points_than_the_root_of_its_type() {
    let identifiers = Identifiers::default();
    let vectors = include_str!("golden/vam.txt");
    let v11 = vectors
        .lines()
        .find_map(|line| line.strip_prefix("V11: "))
        .unwrap();
    let mut vam = decode::<VAM>(&identifiers, &from_hex(v11)).unwrap().message;
    let prediction = vam
        .vam
        .vam_parameters
        .vru_motion_prediction_container
        .as_mut()
        .unwrap();
    let path = prediction.path_prediction.as_mut().unwrap();
    path.0.resize(16, path.0[0].clone());
    assert!(encode(&identifiers, &vam).is_ok());
    let prediction = vam
        .vam
        .vam_parameters
        .vru_motion_prediction_container
        .as_mut()
        .unwrap();
    let path = prediction.path_prediction.as_mut().unwrap();
    path.0.push(path.0[0].clone());
    let rule = BrokenRule::TooMany {
        field: "pathPrediction",
        found: 17,
        max: 16,
    };
    assert_eq!(
        encode(&identifiers, &vam).unwrap_err(),
        EncodeError::Rule(rule)
    );
    let octets = rasn::uper::encode(&vam).unwrap();
    let error = decode::<VAM>(&identifiers, &octets).unwrap_err();
    assert!(
        matches!(
            error,
            DecodeError::Malformed {
                fault: Fault::BeyondRoot,
                ..
            }
        ),
        "{error}"
    );
}

#[test]
fn lists_do_not_go_beyond_the_root_of_their_types() {
    let mut ram = largest();
    let distances = prediction(&mut ram).safe_distance.as_mut().unwrap();
    distances.0.push(distances.0[0].clone());
    assert_refused(&ram, "safe_distance", Fault::BeyondRoot);

    let mut ram = largest();
    let interceptions = prediction(&mut ram)
        .trajectory_interception_indication
        .as_mut()
        .unwrap();
    interceptions.0.push(interceptions.0[0].clone());
    assert_refused(
        &ram,
        "trajectory_interception_indication",
        Fault::BeyondRoot,
    );
}

#[test]
fn path_times_do_not_go_beyond_the_root_of_their_type() {
    for time in [0, 65_536] {
        let mut ram = largest();
        let history = prediction(&mut ram).path_history.as_mut().unwrap();
        history.0[3].path_delta_time = Some(PathDeltaTime(time.into()));
        assert_refused(&ram, "path_delta_time", Fault::BeyondRoot);
    }
}

#[test]
fn a_cluster_is_bounded_by_a_rectangle_a_circle_or_a_polygon() {
    let length = || StandardLength12b(10);
    let angle = || CartesianAngleValue(0);
    let shapes = [
        Shape::elliptical(EllipticalShape::new(None, length(), length(), None, None)),
        Shape::radial(RadialShape::new(
            None,
            length(),
            angle(),
            angle(),
            None,
            None,
        )),
    ];
    for shape in shapes {
        let mut ram = largest();
        let cluster = ram
            .ram
            .ram_parameters
            .vru_cluster_information_container
            .as_mut()
            .unwrap();
        cluster.vru_cluster_information.cluster_bounding_box_shape = Some(shape);
        let name = "cluster_bounding_box_shape";
        assert_refused(&ram, name, Fault::AbsentAlternative);
    }
}

#[test]
fn a_polygon_has_3_to_16_corners() {
    for corners in [2, 17] {
        let mut ram = largest();
        let cluster = ram
            .ram
            .ram_parameters
            .vru_cluster_information_container
            .as_mut()
            .unwrap();
        let shape = cluster
            .vru_cluster_information
            .cluster_bounding_box_shape
            .as_mut()
            .unwrap();
        let Shape::polygonal(polygon) = shape else {
            panic!("not a polygon")
        };
        polygon.polygon.resize(corners, polygon.polygon[0].clone());
        assert_refused(&ram, "polygon", Fault::BeyondRoot);
    }
}

#[test]
fn a_number_that_is_not_one_of_its_type_is_not_encoded() {
    let mut ram = largest();
    ram.ram
        .ram_parameters
        .robot_high_frequency_container
        .speed
        .speed_value = SpeedValue(16_384);
    let EncodeError::Value { number, .. } = encode_error(&ram) else {
        panic!("no such error")
    };
    assert_eq!(number, 16_384);
}

#[test]
fn a_list_whose_size_is_not_one_of_its_type_is_not_encoded() {
    let mut ram = largest();
    let operation = ram
        .ram
        .ram_parameters
        .robot_leader_follower_operation_container
        .as_mut();
    let Some(SessionRole::leader(leader)) = operation.and_then(|o| o.role.as_mut()) else {
        panic!("not a leader");
    };
    leader.followers.clear();
    let error = encode_error(&ram);
    assert!(
        matches!(error, EncodeError::Size { size: 0, .. }),
        "{error}"
    );
}

#[test]
fn a_header_that_is_not_that_of_the_message_is_not_encoded() {
    let identifiers = Identifiers::default();
    let mut ram = samples::largest_ram(&identifiers);
    ram.header.message_id.0 = 2;
    let expected = EncodeError::Header {
        message: "RAM",
        field: "messageId",
        found: 2,
        expected: 240,
    };
    assert_eq!(encode(&identifiers, &ram), Err(expected));
}
