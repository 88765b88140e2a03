//! The golden vectors of VAM: what other encoders made of the same types, bit for bit.

mod support;

use crossguard_codec::asn1::cdd::{
    AccelerationChange, AltitudeConfidence, CurvatureCalculationMode, CurvatureConfidence,
    LanePositionOptions, PathDeltaTimeChoice, Shape, TurningDirection, VruProfileAndSubprofile,
    YawRateConfidence,
};
use crossguard_codec::asn1::ram::RAM;
use crossguard_codec::asn1::vam::{VAM, VamParameters};
use crossguard_codec::{Identifiers, decode, encode, position_of};
use rasn::types::Integer;
use support::from_hex;
use support::reference::Reference;

const VECTORS: &str = include_str!("golden/vam.txt");

fn vectors() -> impl Iterator<Item = (&'static str, Vec<u8>)> {
    let lines = VECTORS
        .lines()
        .filter(|line| !line.starts_with('#') && !line.is_empty());
    lines.map(|line| {
        let (name, hex) = line.split_once(": ").expect("a name and octets");
        (name, from_hex(hex))
    })
}

fn vam(name: &str) -> VAM {
    let (_, octets) = vectors()
        .find(|(n, _)| *n == name)
        .expect("a vector of this name");
    let received = decode::<VAM>(&Identifiers::default(), &octets).expect("a valid vector");
    assert_eq!(received.extended, 0);
    received.message
}

fn parameters(name: &str) -> VamParameters {
    vam(name).vam.vam_parameters
}

#[test]
fn every_vector_decodes_and_encodes_to_the_same_octets() {
    let mut count = 0;
    for (name, octets) in vectors() {
        let encoded = encode(&Identifiers::default(), &vam(name)).unwrap();
        assert_eq!(encoded, octets, "{name}");
        count += 1;
    }
    assert_eq!(count, 11);
}

#[test]
fn all_have_the_common_values() {
    for (name, _) in vectors() {
        let vam = vam(name);
        assert_eq!(vam.header.station_id.0, 123_456_789, "{name}");
        assert_eq!(vam.vam.generation_delta_time.0, 12_345, "{name}");
        let parameters = &vam.vam.vam_parameters;
        assert_eq!(parameters.basic_container.station_type.0, 1, "{name}");
        let position = &parameters.basic_container.reference_position;
        assert_eq!(position.latitude.0, 487_654_321, "{name}");
        assert_eq!(position.longitude.0, 91_234_567, "{name}");
        let ellipse = &position.position_confidence_ellipse;
        assert_eq!(ellipse.semi_major_axis_length.0, 100, "{name}");
        assert_eq!(ellipse.semi_minor_axis_length.0, 50, "{name}");
        assert_eq!(ellipse.semi_major_axis_orientation.0, 900, "{name}");
        assert_eq!(position.altitude.altitude_value.0, 26_000, "{name}");
        assert_eq!(
            position.altitude.altitude_confidence,
            AltitudeConfidence::alt_001_00,
            "{name}"
        );
        let motion = &parameters.vru_high_frequency_container;
        assert_eq!(
            (motion.heading.value.0, motion.heading.confidence.0),
            (900, 10),
            "{name}"
        );
        let speed = &motion.speed;
        assert_eq!(
            (speed.speed_value.0, speed.speed_confidence.0),
            (139, 50),
            "{name}"
        );
        let acceleration = &motion.longitudinal_acceleration;
        assert_eq!(
            acceleration.longitudinal_acceleration_value.0, 161,
            "{name}"
        );
        assert_eq!(
            acceleration.longitudinal_acceleration_confidence.0, 102,
            "{name}"
        );
    }
}

#[test]
fn v2_has_a_low_frequency_container() {
    let slow = parameters("V2").vru_low_frequency_container.unwrap();
    let VruProfileAndSubprofile::pedestrian(profile) = &slow.profile_and_subprofile else {
        panic!("not a pedestrian");
    };
    assert_eq!(profile.0, 1);
    assert_eq!(slow.size_class.unwrap().0, 2);
    let lights = slow.exterior_lights.unwrap();
    assert_eq!(lights.vehicular.0.data[0], 0);
    assert_eq!(lights.vru_specific.0.data[0], 0b0010_0000);
}

#[test]
fn v3_to_v7_have_a_cluster() {
    for name in ["V3", "V6", "V7"] {
        let cluster = parameters(name).vru_cluster_information_container.unwrap();
        let cluster = cluster.vru_cluster_information;
        assert_eq!(cluster.cluster_id.unwrap().0, 7);
        let Some(Shape::circular(circle)) = cluster.cluster_bounding_box_shape else {
            panic!("not a circle");
        };
        assert_eq!(circle.radius.0, 50);
        assert_eq!(cluster.cluster_cardinality_size.0, 5);
        assert_eq!(cluster.cluster_profiles.unwrap().0.data[0], 0b1000_0000);
    }
    let operation = |name| parameters(name).vru_cluster_operation_container.unwrap();
    let join = operation("V4").cluster_join_info.unwrap();
    assert_eq!((join.cluster_id.0, join.join_time.0), (7, 12));
    let leave = operation("V5").cluster_leave_info.unwrap();
    assert_eq!((leave.cluster_id.0, leave.cluster_leave_reason.0), (7, 3));
    let breakup = operation("V6").cluster_breakup_info.unwrap();
    assert_eq!(
        (breakup.cluster_breakup_reason.0, breakup.breakup_time.0),
        (1, 12)
    );
    assert_eq!(operation("V7").cluster_id_change_time_info.unwrap().0, 12);
}

#[test]
fn v8_and_v9_have_a_rectangle_and_a_polygon() {
    let shape = |name| {
        let cluster = parameters(name).vru_cluster_information_container.unwrap();
        assert_eq!(
            cluster.vru_cluster_information.cluster_cardinality_size.0,
            5
        );
        cluster
            .vru_cluster_information
            .cluster_bounding_box_shape
            .unwrap()
    };
    let Shape::rectangular(rectangle) = shape("V8") else {
        panic!("not a rectangle")
    };
    let center = rectangle.shape_reference_point.unwrap();
    assert_eq!((center.x_coordinate.0, center.y_coordinate.0), (10, -20));
    assert_eq!(
        (rectangle.semi_length.0, rectangle.semi_breadth.0),
        (50, 30)
    );
    assert_eq!(rectangle.orientation.unwrap().0, 450);
    let Shape::polygonal(polygon) = shape("V9") else {
        panic!("not a polygon")
    };
    let corners = polygon
        .polygon
        .iter()
        .map(|c| (c.x_coordinate.0, c.y_coordinate.0));
    assert!(corners.eq([(1, 2), (3, 4), (-5, 6)]));
}

#[test]
fn v10_has_everything_optional_in_the_high_frequency_container() {
    let motion = parameters("V10").vru_high_frequency_container;
    let curvature = motion.curvature.unwrap();
    assert_eq!(curvature.curvature_value.0, -5);
    assert_eq!(
        curvature.curvature_confidence,
        CurvatureConfidence::unavailable
    );
    assert_eq!(
        motion.curvature_calculation_mode,
        Some(CurvatureCalculationMode::unavailable)
    );
    let yaw_rate = motion.yaw_rate.unwrap();
    assert_eq!(yaw_rate.yaw_rate_value.0, -32_766);
    assert_eq!(yaw_rate.yaw_rate_confidence, YawRateConfidence::unavailable);
    let lateral = motion.lateral_acceleration.unwrap();
    assert_eq!(lateral.lateral_acceleration_value.0, -1);
    assert_eq!(lateral.lateral_acceleration_confidence.0, 1);
    let vertical = motion.vertical_acceleration.unwrap();
    assert_eq!(vertical.vertical_acceleration_value.0, 161);
    let lane = motion.vru_lane_position.unwrap();
    let LanePositionOptions::detailedlanePosition(detailed) = &lane.lane_position_based else {
        panic!("not a detailed lane position");
    };
    assert_eq!(
        (detailed.transversal_position.0, detailed.lane_type.0),
        (2, 13)
    );
    assert_eq!(detailed.direction.0, 0); // by default
    assert_eq!(lane.confidence.used_detection_information.0.count_ones(), 0);
    assert_eq!(
        lane.confidence.used_stored_information.0.first_one(),
        Some(4)
    );
    assert_eq!(lane.confidence.confidence_value.unwrap().0, 90);
    assert_eq!(
        (
            motion.environment.unwrap().0,
            motion.movement_control.unwrap().0
        ),
        (3, 6)
    );
    let orientation = motion.orientation.unwrap();
    assert_eq!(
        (orientation.value.0, orientation.confidence.0),
        (3_601, 127)
    );
    let roll = motion.roll_angle.unwrap();
    assert_eq!((roll.value.0, roll.confidence.0), (10, 20));
    assert_eq!(motion.device_usage.unwrap().0, 2);
}

#[test]
fn v11_has_a_motion_prediction_with_everything_in_it() {
    let prediction = parameters("V11").vru_motion_prediction_container.unwrap();
    let history = prediction.path_history.unwrap().0;
    let delta = &history[0].path_position;
    assert_eq!(
        (delta.delta_latitude.0, delta.delta_longitude.0),
        (-100, 200)
    );
    assert_eq!(delta.delta_altitude.0, 0);
    assert_eq!(
        history[0].path_delta_time.as_ref().unwrap().0,
        Integer::from(50)
    );
    let path = prediction.path_prediction.unwrap().0;
    assert_eq!(
        (path[0].delta_latitude.0, path[0].delta_longitude.0),
        (100, -200)
    );
    assert_eq!(path[0].delta_altitude.0, 12_800); // by default
    assert_eq!(path[0].altitude_confidence, AltitudeConfidence::unavailable); // by default
    let Some(PathDeltaTimeChoice::deltaTimeHighPrecision(tenths)) = &path[0].path_delta_time else {
        panic!("not in tenths of a second");
    };
    assert_eq!(tenths.0, 10);
    assert_eq!(path[1].delta_altitude.0, 5);
    assert_eq!(path[1].altitude_confidence, AltitudeConfidence::alt_000_50);
    let Some(PathDeltaTimeChoice::deltaTimeMidRange(seconds)) = &path[1].path_delta_time else {
        panic!("not in seconds");
    };
    assert_eq!(seconds.0, 30);
    let distance = &prediction.safe_distance.unwrap().0[0];
    assert_eq!(distance.subject_station.as_ref().unwrap().0, 99);
    assert!(distance.safe_distance_indicator.0);
    assert_eq!(distance.time_to_collision.as_ref().unwrap().0, 25);
    let interception = &prediction.trajectory_interception_indication.unwrap().0[0];
    assert!(interception.subject_station.is_none());
    assert_eq!(interception.trajectory_interception_probability.0, 20);
    assert_eq!(
        interception
            .trajectory_interception_confidence
            .as_ref()
            .unwrap()
            .0,
        2
    );
    let acceleration = prediction.acceleration_change_indication.unwrap();
    assert_eq!(acceleration.accel_or_decel, AccelerationChange::decelerate);
    assert_eq!(acceleration.action_delta_time.0, 5);
    let heading = prediction.heading_change_indication.unwrap();
    assert_eq!(heading.direction, TurningDirection::right);
    assert_eq!(heading.action_delta_time.0, 6);
    let stability = prediction.stability_change_indication.unwrap();
    assert_eq!(
        (stability.loss_probability.0, stability.action_delta_time.0),
        (3, 7)
    );
}

#[test]
fn the_sender_of_a_vam_is_where_it_says() {
    let container = &parameters(vectors().next().unwrap().0).basic_container;
    let position = position_of(&container.try_into().unwrap());
    assert_eq!(position.latitude, Some(48.765_432_1));
}

/// The containers that RAM takes from VAM have the same bits in both.
#[test]
fn a_ram_carries_the_containers_of_a_vam_bit_for_bit() {
    let identifiers = Identifiers::default();
    for (name, octets) in vectors() {
        let theirs = parameters(name);
        let mut ram = RAM::of(&support::samples::typical_ram(&identifiers));
        let ours = &mut ram.ram.ram_parameters;
        ours.basic_container = theirs.basic_container.clone();
        ours.vru_cluster_information_container = theirs.vru_cluster_information_container.clone();
        ours.vru_motion_prediction_container = theirs.vru_motion_prediction_container.clone();
        let sent = support::to_bits(&encode(&identifiers, &ram.to_message().unwrap()).unwrap());
        let vector = support::to_bits(&octets);
        // Behind the header, the generation time and the presence bits.
        let (start, length) = (64 + 5, 1 + 8 + 31 + 32 + 36 + 24);
        assert_eq!(sent[start..][..length], vector[start..][..length], "{name}");

        let cluster = &ram.ram.ram_parameters.vru_cluster_information_container;
        let prediction = &ram.ram.ram_parameters.vru_motion_prediction_container;
        for container in [bits_of(cluster.as_ref()), bits_of(prediction.as_ref())] {
            let container = container.trim_end_matches('0');
            assert!(
                sent.contains(container) && vector.contains(container),
                "{name}"
            );
        }
    }
}

fn bits_of<C: rasn::Encode>(container: Option<&C>) -> String {
    let octets = container.map(|container| rasn::uper::encode(container).unwrap());
    support::to_bits(&octets.unwrap_or_default())
}
