//! What the tests share: hexadecimal text, sample messages, arbitrary messages.
#![allow(
    dead_code,
    unreachable_pub,
    reason = "each test uses the parts it needs"
)]

pub mod arbitrary;
pub mod core;
#[path = "../../../src/golden.rs"]
pub mod golden;
pub mod samples;
pub mod types;

use std::path::Path;
use std::sync::Mutex;
use std::{env, fs};

use crossguard_codec::its::ItsMessage;
use crossguard_codec::{DecodeError, Dictionary, Identifiers};

/// The text of a file of this crate, which is written before by `cargo xtask bless`.
pub fn blessed(path: &str, make: impl FnOnce() -> String) -> String {
    // Another test may read what one writes.
    static ONE: Mutex<()> = Mutex::new(());
    let _one = ONE.lock();
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    if env::var_os("CROSSGUARD_BLESS").is_some() {
        fs::write(&file, make()).expect(path);
    }
    let read = fs::read_to_string(&file);
    read.unwrap_or_else(|error| panic!("{path}: {error}; cargo xtask bless writes it"))
}

/// The golden vectors of other stations' messages with their names, and what is to be known to read them.
pub fn its_vectors() -> impl Iterator<Item = (&'static str, Identifiers, Vec<u8>)> {
    let all = [golden::ITS, golden::VAM].into_iter();
    let all = all.flat_map(golden::vectors);
    all.map(|(name, digits)| {
        let dictionary = match name.as_bytes()[0] {
            b'W' => Dictionary::V2_1_1,
            _ => Dictionary::V2_4_1,
        };
        (name, on(dictionary), from_hex(digits))
    })
}

/// What is to be known where stations use this dictionary.
pub fn on(dictionary: Dictionary) -> Identifiers {
    Identifiers {
        dictionary,
        ..Identifiers::default()
    }
}

/// Decodes a message: it says rightly whether the octets are its canonical encoding, and it is in that one.
pub fn canonical(identifiers: &Identifiers, octets: &[u8]) -> Result<(), DecodeError> {
    let received = ItsMessage::decode(identifiers, octets)?;
    let encoded = received.message.encode(identifiers).unwrap();
    if received.extended == 0 {
        assert_eq!(encoded == octets, received.is_canonical);
    }
    let again = ItsMessage::decode(identifiers, &encoded).unwrap();
    assert_eq!(again.message, received.message);
    assert!(again.is_canonical && again.extended == 0);
    Ok(())
}

/// The octets with one bit flipped.
pub fn flipped(octets: &[u8], bit: usize) -> Vec<u8> {
    let mut flipped = octets.to_vec();
    flipped[bit / 8] ^= 0x80 >> (bit % 8);
    flipped
}

/// Every flip of one bit.
pub fn flips(octets: &[u8]) -> impl Iterator<Item = Vec<u8>> {
    (0..octets.len() * 8).map(|bit| flipped(octets, bit))
}

/// The octets that `text` stands for; white space is left out.
pub fn from_hex(text: &str) -> Vec<u8> {
    let digits: Vec<u32> = text
        .chars()
        .filter(|c| !c.is_whitespace())
        .map(|c| c.to_digit(16).expect("hexadecimal digits"))
        .collect();
    assert!(digits.len().is_multiple_of(2), "whole octets");
    let octet = |pair: &[u32]| u8::try_from(pair[0] << 4 | pair[1]).unwrap();
    digits.chunks(2).map(octet).collect()
}

pub fn to_hex(octets: &[u8]) -> String {
    let digits = octets.iter().flat_map(|octet| [octet >> 4, octet & 15]);
    digits
        .map(|digit| char::from_digit(digit.into(), 16).unwrap())
        .collect()
}

/// The octets as a text of bits, for surgery.
pub fn to_bits(octets: &[u8]) -> String {
    let bits = octets
        .iter()
        .flat_map(|octet| (0..8).rev().map(move |bit| octet >> bit & 1));
    bits.map(|bit| if bit == 1 { '1' } else { '0' }).collect()
}

/// The octets that a text of bits stands for, padded with zeros. Anything but 0 and 1 is left out.
pub fn from_bits(text: &str) -> Vec<u8> {
    let mut bits: Vec<u8> = text
        .chars()
        .filter_map(|c| c.to_digit(2))
        .map(|bit| u8::try_from(bit).unwrap())
        .collect();
    bits.resize(bits.len().next_multiple_of(8), 0);
    let octet = |bits: &[u8]| bits.iter().fold(0, |octet, bit| octet << 1 | bit);
    bits.chunks(8).map(octet).collect()
}

/// The packet with zeros in the reserved bits of its headers, which receivers ignore.
pub fn without_reserved_bits(octets: &[u8]) -> Vec<u8> {
    let mut octets = octets.to_vec();
    let is_geo_broadcast = octets[5] >> 4 == 4;
    let of_both: [(usize, u8); 4] = [(1, 0xFF), (4, 0x0F), (7, 0x7F), (11, 0xFF)];
    let of_geo_broadcast = [14, 15, 54, 55].map(|at| (at, 0xFF));
    let more = of_geo_broadcast.iter().filter(|_| is_geo_broadcast);
    for (at, reserved) in of_both.iter().chain(more) {
        octets[*at] &= !*reserved;
    }
    octets
}
