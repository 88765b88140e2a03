//! The core and the reference, rasn, agree on every type of RAM and RMCM: on the octets of every value, and
//! on which octets are a value. The laws of the core hold for the same values and octets. Where the core is stricter is listed at
//! the end, each with its test.

use std::fmt::Debug;

use crate::support::core::{Random, mutate, octets_of};
use crate::support::{arbitrary, from_bits, to_bits};
use crossguard_codec::asn1;
use crossguard_codec::asn1::cdd as reference;
use crossguard_codec::core::{Fault, Source, Uper, cdd, decode, laws};
use proptest::prelude::*;

/// More octets than any type has.
const N: usize = 1_024;

/// The laws of a value, which Kani proves of containers.
fn laws_of_a_value<T: Uper>(random: &mut Random) {
    let value = T::arbitrary(random);
    laws::encode_then_decode_is_identity::<T, N>(&value);
    laws::length_is_within_maximum::<T, N>(&value);
    let length = octets_of(&value).len();
    laws::truncated_is_an_error::<T, N>(&value, random.index(1, length));
    for bit in 0..8 {
        laws::padding_is_zero::<T, N>(&value, bit);
    }
}

/// The octets of a value of the core are a value of the reference, with the same octets: its decoder
/// encodes again and compares.
fn agree_on_a_value<T: Uper + Debug, R: rasn::Encode + rasn::Decode>(random: &mut Random) {
    let value = T::arbitrary(random);
    let octets = octets_of(&value);
    let decoded = asn1::decode::<R>(&octets);
    assert_eq!(decoded.err(), None, "{value:?}");
    assert_eq!(decode::<T>(&octets), Ok((value, 0)));
}

/// What the core takes is the same value to both. What it refuses is no value to rasn either, or not in its
/// canonical encoding, or behind an extension marker or left out by a rule that PER does not see.
fn agree_on_octets<T, R>(octets: &[u8])
where
    T: Uper + Debug,
    R: rasn::Encode + rasn::Decode + Debug,
{
    laws::decode_is_total::<T>(octets);
    laws::decode_then_encode_is_identity::<T, N>(octets);
    match (decode::<T>(octets), asn1::decode::<R>(octets)) {
        (Ok((value, extended)), Ok(reference)) => {
            assert_eq!(octets_of(&value), asn1::encode(&reference.value).unwrap());
            assert!(reference.is_canonical || extended > 0);
        }
        (Err(_), Err(_)) => {}
        (Err(error), Ok(reference)) => {
            let is_stricter = matches!(
                error.fault,
                Fault::TooMany { .. } | Fault::AbsentAlternative | Fault::BeyondRoot
            );
            assert!(is_stricter || !reference.is_canonical, "{error:?}");
        }
        (core, reference) => panic!("{core:?}, {reference:?}"),
    }
}

/// Extension additions of a newer sender, as bits: a bitmap and open types.
fn additions(random: &mut Random) -> String {
    let count = random.index(1, 64);
    let mut bits = format!("0{:06b}", count - 1);
    let present: Vec<bool> = (0..count).map(|_| random.index(0, 9) == 0).collect();
    bits.extend(present.iter().map(|bit| if *bit { '1' } else { '0' }));
    for _ in present.iter().filter(|bit| **bit) {
        let length = random.index(1, 3) * random.index(1, 60);
        let determinant = match length {
            0..0x80 => format!("{length:08b}"),
            _ => format!("10{length:014b}"),
        };
        bits.push_str(&determinant);
        bits.push_str(&to_bits(&random.octets(length)));
    }
    bits
}

/// The octets of a value whose outermost extension bit is set, with additions behind it.
fn extended<T: Uper>(random: &mut Random) -> Vec<u8> {
    let value = T::arbitrary(random);
    let mut buffer = [0; N];
    let length = value
        .encode(crossguard_codec::core::Writer::new(&mut buffer))
        .position();
    let bits = to_bits(&buffer);
    from_bits(&format!("1{}{}", &bits[1..length], additions(random)))
}

fn agree<T, R>(seed: u64)
where
    T: Uper + Debug,
    R: rasn::Encode + rasn::Decode + Debug,
{
    let random = &mut Random(seed);
    laws_of_a_value::<T>(random);
    agree_on_a_value::<T, R>(random);
    let of_core = octets_of(&T::arbitrary(random));
    agree_on_octets::<T, R>(&mutate(of_core, random));
    let of_reference: R = arbitrary::any(random.next());
    let of_reference = asn1::encode(&of_reference).unwrap();
    agree_on_octets::<T, R>(&of_reference);
    agree_on_octets::<T, R>(&mutate(of_reference, random));
    agree_on_octets::<T, R>(&extended::<T>(random));
    let extended = extended::<T>(random);
    agree_on_octets::<T, R>(&mutate(extended, random));
    let length = random.index(0, T::MAX_BITS as usize / 8 + 2);
    agree_on_octets::<T, R>(&random.octets(length));
    agree_on_octets::<T, R>(&vec![0; length]);
}

macro_rules! agreement {
    ($($module:ident: $($name:ident)+;)+) => {
        $(mod $module {
            use super::*;
            proptest! {
                #![proptest_config(ProptestConfig::with_cases(CASES))]
                $(
                    #[test]
                    #[allow(non_snake_case, reason = "the name of the type")]
                    fn $name(seed: u64) {
                        use crossguard_codec::{asn1, core};
                        agree::<core::$module::$name, asn1::$module::$name>(seed);
                    }
                )+
            }
        })+
    };
}

const CASES: u32 = 128;

mod every_type {
    use super::{CASES, ProptestConfig, agree, proptest};
    crate::for_all_types!(agreement);
}

// The known differences. All are rules that the encoding does not show, and that hold in a RAM.

/// The reference reads lists of all these lengths, and the core those of at most ten items.
fn core_has_ten<T: Uper + Debug, R: rasn::Encode + rasn::Decode>(
    lengths: &[usize],
    list_of: impl Fn(usize) -> R,
) {
    for &found in lengths {
        let octets = asn1::encode(&list_of(found)).unwrap();
        assert!(asn1::decode::<R>(&octets).is_ok());
        let fault = decode::<T>(&octets).err().map(|error| error.fault);
        let too_many = Fault::TooMany { found, max: 10 };
        assert_eq!(fault, (found > 10).then_some(too_many));
    }
}

#[test]
fn the_core_has_ten_points_in_a_path_history() {
    let point = reference::PathPoint::new(
        reference::DeltaReferencePosition::new(
            reference::DeltaLatitude(0),
            reference::DeltaLongitude(0),
            reference::DeltaAltitude(0),
        ),
        None,
    );
    core_has_ten::<cdd::PathHistory, _>(&[10, 11, 40], |length| {
        reference::PathHistory(vec![point.clone(); length])
    });
}

#[test]
fn the_core_has_ten_points_in_a_path_prediction() {
    let mut random = Random(1);
    let point: reference::PathPointPredicted = arbitrary::any(random.next());
    core_has_ten::<cdd::PathPredicted, _>(&[1, 10, 11, 16], |length| {
        reference::PathPredicted(vec![point.clone(); length])
    });
}

#[test]
fn the_core_has_no_ellipse_and_no_sectors_as_shape_of_a_cluster() {
    let length = || reference::StandardLength12b(10);
    let ellipse = reference::EllipticalShape::new(None, length(), length(), None, None);
    let octets = asn1::encode(&reference::Shape::elliptical(ellipse)).unwrap();
    assert!(asn1::decode::<reference::Shape>(&octets).is_ok());
    let error = decode::<cdd::Shape>(&octets).unwrap_err();
    assert_eq!(error.fault, Fault::AbsentAlternative);
    // Index 6 and 7 are no alternatives to anybody.
    for index in [0b0110_0000, 0b0111_0000] {
        let error = decode::<cdd::Shape>(&[index, 0, 0, 0]).unwrap_err();
        assert_eq!(error.fault, Fault::UnknownAlternative);
    }
}

#[test]
fn the_core_names_a_default_that_is_spelled_out() {
    // Presence bit, latitude 0, longitude 0, altitude 800001.
    let bits = format!(
        "1{:031b}{:032b}{:020b}",
        900_000_000, 1_800_000_000, 900_001
    );
    let octets = from_bits(&bits);
    let error = decode::<cdd::GeoPosition>(&octets).unwrap_err();
    assert_eq!((error.fault, error.bit), (Fault::DefaultSpelledOut, 64));
    assert!(error.names(cdd::GeoPosition::FIELDS).eq(["altitude"]));
    let reference = asn1::decode::<reference::GeoPosition>(&octets).unwrap();
    assert!(!reference.is_canonical);
}
