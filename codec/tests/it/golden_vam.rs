//! The golden vectors of VAM: what other encoders made of the same types, bit for bit.

use crate::support::reference::Reference;
use crate::support::{from_hex, golden};
use crossguard_codec::asn1::ram::RAM;
use crossguard_codec::asn1::vam::{VAM, VamParameters};
use crossguard_codec::{Identifiers, decode, encode, position_of};

fn vectors() -> impl Iterator<Item = (&'static str, Vec<u8>)> {
    golden::vectors(golden::VAM).map(|(name, digits)| (name, from_hex(digits)))
}

fn parameters(name: &str) -> VamParameters {
    let octets = from_hex(golden::vector(golden::VAM, name));
    let received = decode::<VAM>(&Identifiers::default(), &octets).expect("a valid vector");
    received.message.vam.vam_parameters
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
