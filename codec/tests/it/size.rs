//! No message is larger than the constants say, and the largest ones are exactly as large.

use crate::support::reference::Reference;
use crate::support::{arbitrary, samples};
use crossguard_codec::asn1::rmcm;
use crossguard_codec::core::ram::RAM;
use crossguard_codec::core::rmcm::RMCM;
use crossguard_codec::{
    Identifiers, MESSAGE_LEN_MAX, Pdu, RAM_LEN_MAX, RMCM_LEN_MAX, decode, encode,
};
use proptest::prelude::*;

/// What a signed packet with its certificate adds to a message, rounded up.
const ENVELOPE_LEN: usize = 300;

#[test]
fn the_largest_ram_is_as_large_as_the_constant_says() {
    let identifiers = Identifiers::default();
    let ram = samples::largest_ram(&identifiers);
    let octets = encode(&identifiers, &ram).unwrap();
    assert_eq!(octets.len(), RAM_LEN_MAX);
    assert_eq!(RAM_LEN_MAX, RAM::LEN_MAX);
    assert_eq!(decode::<RAM>(&identifiers, &octets).unwrap().message, ram);
}

#[test]
fn the_largest_rmcm_is_as_large_as_the_constant_says() {
    let identifiers = Identifiers::default();
    let rmcm = samples::largest_rmcm(&identifiers);
    let octets = encode(&identifiers, &rmcm).unwrap();
    assert_eq!(octets.len(), RMCM_LEN_MAX);
    assert_eq!(RMCM_LEN_MAX, RMCM::LEN_MAX);
    assert_eq!(decode::<RMCM>(&identifiers, &octets).unwrap().message, rmcm);
}

#[test]
fn the_largest_messages_fit_into_one_packet_with_their_envelope() {
    const { assert!(RAM_LEN_MAX + ENVELOPE_LEN < MESSAGE_LEN_MAX) };
    const { assert!(RMCM_LEN_MAX + ENVELOPE_LEN < MESSAGE_LEN_MAX) };
}

#[test]
fn typical_messages_are_small() {
    let identifiers = Identifiers::default();
    let ram = encode(&identifiers, &samples::typical_ram(&identifiers)).unwrap();
    let command = encode(&identifiers, &samples::typical_rmcm(&identifiers)).unwrap();
    let answer = encode(&identifiers, &samples::answer_rmcm(&identifiers)).unwrap();
    assert_eq!((ram.len(), command.len(), answer.len()), (55, 54, 39));
}

proptest! {
    #[test]
    fn no_ram_is_larger(seed: u64) {
        let identifiers = Identifiers::default();
        let ram = arbitrary::ram(&identifiers, seed).to_message().unwrap();
        prop_assert!(encode(&identifiers, &ram).unwrap().len() <= RAM_LEN_MAX);
    }

    #[test]
    fn no_rmcm_is_larger(seed: u64) {
        let identifiers = Identifiers::default();
        let rmcm = arbitrary::message::<rmcm::RMCM>(&identifiers, seed).to_message().unwrap();
        prop_assert!(encode(&identifiers, &rmcm).unwrap().len() <= RMCM_LEN_MAX);
    }
}
