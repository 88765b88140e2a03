//! The laws of the core, called with random input. Kani calls the same functions with all input.

use crate::support::core::{Random, mutate, octets_of};
use crossguard_codec::core::{Source, Uper, laws, max_octets};
use proptest::prelude::*;

/// More octets than any type has.
const N: usize = 1_024;

fn laws_of_values<T: Uper>(random: &mut Random) {
    let value = T::arbitrary(random);
    laws::encode_then_decode_is_identity::<T, N>(&value);
    laws::length_is_within_maximum::<T, N>(&value);
    let length = octets_of(&value).len();
    laws::truncated_is_an_error::<T, N>(&value, random.index(1, length));
    for bit in 0..8 {
        laws::padding_is_zero::<T, N>(&value, bit);
    }
}

fn laws_of_octets<T: Uper>(octets: &[u8]) {
    laws::decode_is_total::<T>(octets);
    laws::decode_then_encode_is_identity::<T, N>(octets);
}

fn hold<T: Uper>(seed: u64) {
    let random = &mut Random(seed);
    laws_of_values::<T>(random);
    let octets = octets_of(&T::arbitrary(random));
    laws_of_octets::<T>(&octets);
    laws_of_octets::<T>(&mutate(octets, random));
    let length = random.index(0, max_octets::<T>() + 2);
    laws_of_octets::<T>(&random.octets(length));
}

macro_rules! laws {
    ($($module:ident: $($name:ident)+;)+) => {
        $(mod $module {
            use super::*;
            proptest! {
                #![proptest_config(ProptestConfig::with_cases(128))]
                $(
                    #[test]
                    #[allow(non_snake_case, reason = "the name of the type")]
                    fn $name(seed: u64) {
                        hold::<crossguard_codec::core::$module::$name>(seed);
                    }
                )+
            }
        })+
    };
}

mod every_type {
    use super::{ProptestConfig, hold, proptest};
    crate::for_all_types!(laws);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4_096))]

    #[test]
    fn bits_are_read_as_written(before: (u32, u32), number: (u32, u32), after: (u32, u32)) {
        laws::bits_are_read_as_written(before, number, after);
    }

    #[test]
    fn reading_stops_at_the_end(
        octets in prop::collection::vec(any::<u8>(), 0..12),
        position in 0_usize..100,
        count: u32,
    ) {
        laws::reading_stops_at_the_end(&octets, position, count);
    }

    #[test]
    fn what_is_ahead_decides(octets: [u8; 12], before in 0_usize..100, count: u32) {
        laws::what_is_ahead_decides(&octets, before, count);
    }

    #[test]
    fn integers_keep_their_bounds(min: i32, largest: u32, shift in 0_u32..32, bits: u32) {
        let min = i64::from(min);
        laws::integers_keep_their_bounds(min, min + i64::from(largest >> shift), bits);
    }

    #[test]
    fn skipping_additions_is_total(octets in prop::collection::vec(any::<u8>(), 0..200)) {
        laws::skipping_additions_is_total(&octets);
    }

    #[test]
    fn skipping_a_few_additions_is_total(
        count in 0_u8..4,
        octets in prop::collection::vec(0_u8..4, 0..40),
    ) {
        laws::skipping_additions_is_total(&[&[count << 1], &octets[..]].concat());
    }
}

#[test]
fn every_size_of_an_integer_keeps_its_bounds() {
    for largest in 0..=1_100 {
        for bits in 0..2_048 {
            laws::integers_keep_their_bounds(-7, -7 + largest, bits);
        }
    }
}
