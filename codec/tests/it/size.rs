//! No message is larger than the constants say, and the largest ones are exactly as large.

use std::fmt::Debug;

use crate::support::reference::Reference;
use crate::support::{arbitrary, samples};
use crossguard_codec::asn1::rmcm;
use crossguard_codec::{
    Identifiers, MESSAGE_LEN_MAX, Pdu, RAM_LEN_MAX, RMCM_LEN_MAX, decode, encode,
};
use proptest::prelude::*;

/// What a signed packet with its certificate adds to a message, rounded up.
const ENVELOPE_LEN: usize = 300;

fn is_as_large_as<M: Pdu + PartialEq + Debug>(message: &M, max: usize) {
    let identifiers = Identifiers::default();
    let octets = encode(&identifiers, message).unwrap();
    assert_eq!((octets.len(), max), (max, M::LEN_MAX), "{}", M::NAME);
    let decoded = decode::<M>(&identifiers, &octets).unwrap().message;
    assert_eq!(&decoded, message);
}

#[test]
fn the_largest_messages_are_as_large_as_the_constants_say() {
    let identifiers = Identifiers::default();
    is_as_large_as(&samples::largest_ram(&identifiers), RAM_LEN_MAX);
    is_as_large_as(&samples::largest_rmcm(&identifiers), RMCM_LEN_MAX);
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
