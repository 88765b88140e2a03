//! The golden vectors of VAM: what other encoders made of the same types, bit for bit.

use crate::support::reference::Reference;
use crate::support::{from_hex, golden};
use crossguard_codec::asn1::cdd::AltitudeConfidence;
use crossguard_codec::asn1::ram::RAM;
use crossguard_codec::asn1::vam::{VAM, VamParameters};
use crossguard_codec::{Identifiers, decode, encode, position_of};

fn vectors() -> impl Iterator<Item = (&'static str, Vec<u8>)> {
    golden::vectors(golden::VAM).map(|(name, digits)| (name, from_hex(digits)))
}

fn vam(name: &str) -> VAM {
    let octets = from_hex(golden::vector(golden::VAM, name));
    let received = decode::<VAM>(&Identifiers::default(), &octets).expect("a valid vector");
    assert_eq!(received.extended, 0);
    received.message
}

fn parameters(name: &str) -> VamParameters {
    vam(name).vam.vam_parameters
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
        let mut ram = RAM::of(&crate::support::samples::typical_ram(&identifiers));
        let ours = &mut ram.ram.ram_parameters;
        ours.basic_container = theirs.basic_container.clone();
        ours.vru_cluster_information_container = theirs.vru_cluster_information_container.clone();
        ours.vru_motion_prediction_container = theirs.vru_motion_prediction_container.clone();
        let sent =
            crate::support::to_bits(&encode(&identifiers, &ram.to_message().unwrap()).unwrap());
        let vector = crate::support::to_bits(&octets);
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
    crate::support::to_bits(&octets.unwrap_or_default())
}
