//! The largest messages are exactly as large as the constants say. That none is larger is a law of the core.

use std::fmt::Debug;

use crate::support::samples;
use crossguard_codec::{
    Identifiers, MESSAGE_LEN_MAX, Pdu, RAM_LEN_MAX, RMCM_LEN_MAX, decode, encode,
};

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
