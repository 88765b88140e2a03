//! The core does not allocate, neither for the largest messages nor for an error.

mod support;

use allocation_counter::measure;
use crossguard_codec::core::{Uper, decode, encode, ram::RAM, rmcm::RMCM};
use support::core::{Random, octets_of};

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
