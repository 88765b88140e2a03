//! The core does not allocate, neither for the largest messages nor for an error, and on it nothing
//! of the endpoint's way from a view to octets and back does.

use crate::support::core::{Random, octets_of};
use crate::support::samples;
use allocation_counter::measure;
use crossguard_codec::core::{Uper, decode, encode, ram::RAM, rmcm::RMCM};
use crossguard_codec::{
    Identifiers, MESSAGE_LEN_MAX, Message, encode_into, ram_from, state_of, view_of_ram,
    views_of_rmcm,
};
use crossguard_protocol::Availability;

fn allocates_nothing<T: Uper>() {
    for seed in 0..64 {
        let value = T::arbitrary(&mut Random(seed));
        let octets = octets_of(&value);
        let mut buffer = [0; 1_024];
        let encoding = measure(|| assert!(encode(&value, &mut buffer).is_ok()));
        let decoding = measure(|| assert!(decode::<T>(&octets).is_ok()));
        let refusing = measure(|| assert!(decode::<T>(&octets[1..]).is_err()));
        for step in [encoding, decoding, refusing] {
            assert_eq!(step.count_total, 0);
        }
    }
}

#[test]
fn encoding_and_decoding_a_ram_allocates_nothing() {
    allocates_nothing::<RAM>();
}

#[test]
fn encoding_and_decoding_an_rmcm_allocates_nothing() {
    allocates_nothing::<RMCM>();
}

/// What a robot hears is a message and a view, or refused, without heap.
fn hear(octets: &[u8]) -> bool {
    match Message::decode(&Identifiers::default(), octets) {
        Ok(received) => match received.message {
            Message::Ram(ram) => view_of_ram(&ram).is_ok(),
            Message::Rmcm(rmcm) => views_of_rmcm(&rmcm).is_ok(),
        },
        Err(_) => false,
    }
}

#[test]
fn saying_and_hearing_a_message_allocates_nothing() {
    let identifiers = Identifiers::default();
    for (name, message) in samples::golden(&identifiers) {
        let mut buffer = [0; MESSAGE_LEN_MAX];
        let mut length = 0;
        let saying = measure(|| {
            let said = match &message {
                Message::Ram(ram) => encode_into(&identifiers, ram, &mut buffer),
                Message::Rmcm(rmcm) => encode_into(&identifiers, rmcm, &mut buffer),
            };
            length = said.unwrap();
        });
        let octets = &buffer[..length];
        let hearing = measure(|| assert!(hear(octets)));
        let refusing = measure(|| assert!(!hear(&octets[..length - 1])));
        for step in [saying, hearing, refusing] {
            assert_eq!(step.count_total, 0, "{name}");
        }
    }
}

#[test]
fn a_ram_of_a_view_and_a_state_allocates_nothing() {
    let identifiers = Identifiers::default();
    let (state, view) = (samples::state(), samples::follower_view());
    let available = Availability::Available;
    let mapping = measure(|| {
        let ram = ram_from(&identifiers, &state, &view, available, 0, true).unwrap();
        // Only the path of a robot has a list of any length.
        assert!(state_of(&ram).slow.is_some());
    });
    assert!(mapping.count_max <= 1, "{mapping:?}");
    let typical = measure(|| {
        let ram = ram_from(&identifiers, &state, &view, available, 0, false).unwrap();
        assert!(state_of(&ram).slow.is_none());
    });
    assert_eq!(typical.count_total, 0);
}
