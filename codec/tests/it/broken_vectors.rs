//! Every golden vector of a message or packet with one bit flipped, or cut short: it is refused with its
//! cause, or it is the encoding of the value that it decodes to, or is said not to be; but for reserved bits of packets. Those of the
//! security envelope are in `security/golden.rs`.

use std::error::Error;

use crate::support::{
    canonical, flips, from_hex, golden, its_vectors, samples, without_reserved_bits,
};
use crossguard_codec::geonet::Headers;
use crossguard_codec::{DecodeError, Identifiers};

struct Vector {
    name: &'static str,
    octets: Vec<u8>,
    identifiers: Identifiers,
    is_packet: bool,
}

/// All vectors of `golden/`.
fn vectors() -> Vec<Vector> {
    let vector = |name, identifiers, octets| Vector {
        name,
        octets,
        identifiers,
        is_packet: false,
    };
    let of_others =
        its_vectors().map(|(name, identifiers, octets)| vector(name, identifiers, octets));
    let packets = golden::vectors(golden::PACKETS).map(|(name, digits)| Vector {
        is_packet: name.starts_with('G'),
        ..vector(name, Identifiers::default(), from_hex(digits))
    });
    let ids = Identifiers::default();
    let of_robots = samples::golden(&ids).into_iter();
    let of_robots =
        of_robots.map(|(name, message)| vector(name, ids, message.encode(&ids).unwrap()));
    of_others.chain(packets).chain(of_robots).collect()
}

fn check(vector: &Vector, octets: &[u8]) -> Result<(), Box<dyn Error>> {
    if !vector.is_packet {
        return Ok(canonical(&vector.identifiers, octets)?);
    }
    let (headers, message) = Headers::decode(octets)?;
    let encoded = headers.encode(message.len()).unwrap();
    assert_eq!(
        [encoded.as_ref(), message].concat(),
        without_reserved_bits(octets)
    );
    Ok(())
}

#[test]
fn all_vectors_are_there_and_whole() {
    let all = vectors();
    for vector in &all {
        check(vector, &vector.octets).expect(vector.name);
    }
    // CAM 4, CPM 2, VAM 11 and 4 on the older dictionary; packets 2 and the CAM in one of them; RAM and RMCM 11.
    assert_eq!(all.len(), 4 + 2 + 11 + 4 + 2 + 1 + 11);
    for name in ["C1", "G1", "G2", "leads", "commands"] {
        assert!(all.iter().any(|vector| vector.name == name), "{name}");
    }
}

#[test]
fn every_flipped_bit_is_refused_or_comes_back() {
    for vector in vectors() {
        let (mut accepted, mut refused) = (0, 0);
        for flipped in flips(&vector.octets) {
            match check(&vector, &flipped) {
                Ok(()) => accepted += 1,
                Err(error) => {
                    assert!(!error.to_string().is_empty());
                    refused += 1;
                }
            }
        }
        // Most bits are part of a number; those of the header say what it is.
        let name = vector.name;
        assert!(
            accepted > 100 && refused > 15,
            "{name}: {accepted} {refused}"
        );
    }
}

#[test]
fn every_truncation_is_refused() {
    for vector in vectors() {
        let name = vector.name;
        for length in 0..vector.octets.len() {
            let error = check(&vector, &vector.octets[..length]).expect_err(name);
            let is_truncation = match error.downcast_ref::<DecodeError>() {
                None => vector.is_packet,
                Some(error) => ["too short", "truncated"].contains(&error.cause()),
            };
            assert!(is_truncation, "{name} {length}: {error}");
        }
    }
}

#[test]
fn an_octet_behind_it_is_refused() {
    for vector in vectors() {
        let longer = [&vector.octets[..], &[0]].concat();
        let error = check(&vector, &longer).expect_err(vector.name);
        if !vector.is_packet {
            let expected = DecodeError::TrailingOctets { count: 1 };
            assert_eq!(error.downcast_ref(), Some(&expected), "{}", vector.name);
        }
    }
}
