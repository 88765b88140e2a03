//! Extension additions of newer senders are skipped; additions that are not well-formed are refused.

use crate::support::{from_bits, samples, to_bits};
use crossguard_codec::core::ram::RAM;
use crossguard_codec::{DecodeError, Fault, Identifiers, Received, decode, encode};

/// The extension bit of `RamParameters`, behind the header and the generation time.
const PARAMETERS_MARKER: usize = 64;
/// The extension bit of `BasicContainer`, behind the presence bits of `RamParameters`.
const BASIC_MARKER: usize = PARAMETERS_MARKER + 1 + 4;
/// The end of the root of `BasicContainer`.
const BASIC_END: usize = BASIC_MARKER + 1 + 8 + 31 + 32 + 36 + 24;

/// One addition of two octets: 0 and 6 bits for a bitmap of one bit, the bitmap, length, octets.
const ONE: &str = "0000000 1 00000010 10101010 01010101";
/// Three additions are known to the sender, and the third one is present.
const THIRD_OF_THREE: &str = "0000010 001 00000001 11111111";

/// A RAM of which an addition can be made: its bits without padding.
fn bits() -> String {
    let ram = samples::typical_ram(&Identifiers::default());
    let bits = to_bits(&encode(&Identifiers::default(), &ram).unwrap());
    // The last component is a report; its last bits are "executing", 0 and 000.
    let end = bits
        .rfind(&format!("{:08b}0000", 3))
        .expect("the report on command 3")
        + 12;
    bits[..end].to_owned()
}

fn extend(bits: &str, marker: usize, end: usize, additions: &str) -> String {
    assert_eq!(&bits[marker..=marker], "0");
    format!(
        "{}1{}{additions}{}",
        &bits[..marker],
        &bits[marker + 1..end],
        &bits[end..]
    )
}

fn decode_bits(bits: &str) -> Result<Received<RAM>, DecodeError> {
    decode(&Identifiers::default(), &from_bits(bits))
}

fn said(message: &RAM, extended: usize) -> Received<RAM> {
    Received {
        message: *message,
        extended,
        is_canonical: true,
    }
}

fn fault(bits: &str) -> Fault {
    match decode_bits(bits) {
        Err(DecodeError::Malformed { fault, .. }) => fault,
        other => panic!("{other:?}"),
    }
}

#[test]
fn the_sample_is_whole() {
    let ram = samples::typical_ram(&Identifiers::default());
    assert_eq!(decode_bits(&bits()).unwrap(), said(&ram, 0));
}

#[test]
fn unknown_additions_are_skipped_wherever_they_are() {
    let ram = samples::typical_ram(&Identifiers::default());
    let bits = bits();
    for additions in [ONE, THIRD_OF_THREE] {
        let outer = extend(&bits, PARAMETERS_MARKER, bits.len(), additions);
        assert_eq!(decode_bits(&outer).unwrap(), said(&ram, 1));
        let inner = extend(&bits, BASIC_MARKER, BASIC_END, additions);
        assert_eq!(decode_bits(&inner).unwrap(), said(&ram, 1));
        let both = extend(&inner, PARAMETERS_MARKER, inner.len(), ONE);
        assert_eq!(decode_bits(&both).unwrap(), said(&ram, 2));
    }
}

#[test]
fn additions_that_are_announced_and_missing_are_refused() {
    let bits = bits();
    let extended = |additions| extend(&bits, PARAMETERS_MARKER, bits.len(), additions);
    assert_eq!(fault(&extended("0000010 000")), Fault::NoAddition);
    assert_eq!(
        fault(&extended("0000000 1 00000010 10101010")),
        Fault::Truncated
    );
    assert_eq!(fault(&extended("")), Fault::Truncated);
}

#[test]
fn lengths_that_are_not_canonical_are_refused() {
    let bits = bits();
    let extended = |additions| extend(&bits, PARAMETERS_MARKER, bits.len(), additions);
    let long_form = "0000000 1 10 00000000000010 10101010 01010101";
    assert_eq!(fault(&extended(long_form)), Fault::Length);
    assert_eq!(fault(&extended("0000000 1 00000000")), Fault::Length);
    assert_eq!(fault(&extended("0000000 1 11000001")), Fault::Truncated);
}

#[test]
fn more_additions_than_a_decoder_can_hold_are_refused() {
    let bits = bits();
    let many = format!("1 01000001 {}", "1".repeat(65));
    let extended = extend(&bits, PARAMETERS_MARKER, bits.len(), &many);
    assert_eq!(fault(&extended), Fault::TooManyAdditions);
}

#[test]
fn an_extended_message_must_be_canonical_otherwise() {
    let bits = bits();
    let extended = extend(&bits, PARAMETERS_MARKER, bits.len(), THIRD_OF_THREE);
    let mut octets = from_bits(&extended);
    octets.push(0);
    let error = decode::<RAM>(&Identifiers::default(), &octets).unwrap_err();
    assert_eq!(error, DecodeError::TrailingOctets { count: 1 });
    octets.pop();
    let bits = extended.chars().filter(|c| *c != ' ').count();
    assert!(!bits.is_multiple_of(8), "there is padding");
    *octets.last_mut().unwrap() |= 1;
    assert_eq!(fault(&to_bits(&octets)), Fault::Padding);
}
