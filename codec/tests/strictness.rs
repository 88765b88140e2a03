//! Exactly the canonical encodings are accepted; everything else is refused with its cause.

mod support;

use std::collections::BTreeSet;

use crossguard_codec::asn1::denm::DENM;
use crossguard_codec::asn1::ram::RAM;
use crossguard_codec::asn1::rmcm::RMCM;
use crossguard_codec::asn1::vam::VAM;
use crossguard_codec::{
    DecodeError, Fault, Identifiers, MESSAGE_LEN_MAX, Message, Pdu, core, decode, encode,
};
use proptest::prelude::*;
use support::reference::Reference;
use support::{arbitrary, from_bits, from_hex, samples, to_bits};

fn identifiers() -> Identifiers {
    Identifiers::default()
}

fn rams() -> Vec<Vec<u8>> {
    let rams = [
        samples::typical_ram(&identifiers()),
        samples::largest_ram(&identifiers()),
    ];
    rams.iter()
        .map(|ram| encode(&identifiers(), ram).unwrap())
        .collect()
}

fn rmcms() -> Vec<Vec<u8>> {
    let identifiers = identifiers();
    let rmcms = [
        samples::typical_rmcm(&identifiers),
        samples::answer_rmcm(&identifiers),
        samples::largest_rmcm(&identifiers),
    ];
    rmcms
        .iter()
        .map(|rmcm| encode(&identifiers, rmcm).unwrap())
        .collect()
}

fn vams() -> Vec<Vec<u8>> {
    let lines = include_str!("golden/vam.txt")
        .lines()
        .filter(|line| line.starts_with('V'));
    lines
        .map(|line| from_hex(line.split_once(": ").unwrap().1))
        .collect()
}

fn denms() -> Vec<Vec<u8>> {
    let lines = include_str!("golden/its.txt")
        .lines()
        .filter_map(|line| line.strip_prefix("D1: "));
    lines.map(from_hex).collect()
}

fn flip(octets: &[u8], bit: usize) -> Vec<u8> {
    let mut flipped = octets.to_vec();
    flipped[bit / 8] ^= 0x80 >> (bit % 8);
    flipped
}

/// Decodes, and checks what holds for all octets: what is accepted is the encoding of its value, and
/// rasn's own decoder agrees with ours.
fn decode_checked<M: Reference>(octets: &[u8]) -> Result<M::Message, DecodeError> {
    let of_rasn = rasn::uper::decode::<M>(octets);
    let received = decode::<M::Message>(&identifiers(), octets);
    match &received {
        Ok(received) => {
            assert_eq!(of_rasn.as_ref().ok(), Some(&M::of(&received.message)));
            let encoded = encode(&identifiers(), &received.message).unwrap();
            assert!(encoded == octets || received.extended > 0);
        }
        // What rasn takes for canonical is refused only where this crate promises less.
        Err(error)
            if of_rasn
                .as_ref()
                .is_ok_and(|m| rasn::uper::encode(m).unwrap() == octets) =>
        {
            let is_promised = matches!(
                error,
                DecodeError::Malformed {
                    fault: Fault::BeyondRoot | Fault::TooMany { .. } | Fault::AbsentAlternative,
                    ..
                } | DecodeError::Rule(_)
                    | DecodeError::MessageId { .. }
                    | DecodeError::ProtocolVersion { .. }
            );
            assert!(is_promised, "{error}");
        }
        Err(_) => {}
    }
    received.map(|received| received.message)
}

fn truncations_are_refused<M: Reference>(samples: &[Vec<u8>]) {
    for octets in samples {
        for length in 0..octets.len() {
            match decode_checked::<M>(&octets[..length]) {
                Err(DecodeError::TooShort { length: found }) => assert_eq!(found, length),
                Err(DecodeError::Malformed {
                    fault: Fault::Truncated,
                    bit,
                    ..
                }) => {
                    assert_eq!(bit, length * 8);
                }
                other => panic!("{length} octets: {other:?}"),
            }
        }
    }
}

#[test]
fn a_message_that_ends_too_early_is_refused_as_truncated() {
    truncations_are_refused::<RAM>(&rams());
    truncations_are_refused::<RMCM>(&rmcms());
    truncations_are_refused::<VAM>(&vams());
    truncations_are_refused::<DENM>(&denms());
}

#[test]
fn a_flipped_bit_leaves_a_canonical_encoding_or_none_at_all() {
    for octets in rams() {
        for bit in 0..octets.len() * 8 {
            let _ = decode_checked::<RAM>(&flip(&octets, bit));
        }
    }
    for octets in rmcms() {
        for bit in 0..octets.len() * 8 {
            let _ = decode_checked::<RMCM>(&flip(&octets, bit));
        }
    }
    for octets in vams() {
        for bit in 0..octets.len() * 8 {
            let _ = decode_checked::<VAM>(&flip(&octets, bit));
        }
    }
    for octets in denms() {
        for bit in 0..octets.len() * 8 {
            let _ = decode_checked::<DENM>(&flip(&octets, bit));
        }
    }
}

#[test]
fn what_is_wrong_is_named_with_its_field() {
    let octets = &rams()[0];
    let errors = (0..octets.len() * 8).filter_map(|bit| {
        let error = decode::<core::ram::RAM>(&identifiers(), &flip(octets, bit)).err()?;
        Some(error.to_string())
    });
    let errors: BTreeSet<String> = errors
        .map(|error| error.split(" (").next().unwrap().into())
        .collect();
    let status = "ram.ram_parameters.robot_status_container";
    let expected = [
        "ram.ram_parameters.basic_container.reference_position.longitude: \
         2238718215 is not within -1800000000..1800000001"
            .to_owned(),
        format!("{status}.robot_category: its alternative is unknown"),
        format!("{status}.battery_status.state_of_charge: 115 is not within 0..101"),
        format!("{status}.help_status: its alternative is unknown"),
    ];
    for error in expected {
        assert!(
            errors.contains(&error),
            "{error}\nis not among\n{errors:#?}"
        );
    }
}

#[test]
fn a_number_is_refused_from_the_first_one_beyond_its_range() {
    let bits = to_bits(&rams()[0]);
    // Behind header, generation time, extension and presence bits, and the station type.
    let (start, width) = (64 + 5 + 1 + 8, 31);
    let with_latitude = |number: i32| {
        let offset = u32::try_from(number + 900_000_000).unwrap();
        let (before, after) = (&bits[..start], &bits[start + width..]);
        decode::<core::ram::RAM>(
            &identifiers(),
            &from_bits(&format!("{before}{offset:031b}{after}")),
        )
    };
    assert!(with_latitude(900_000_001).is_ok());
    let error = with_latitude(900_000_002).unwrap_err();
    let DecodeError::Malformed { field, bit, fault } = error else {
        panic!("{error}");
    };
    assert_eq!((field.names().last(), bit), (Some("latitude"), start));
    let (min, max) = (-900_000_000, 900_000_001);
    assert_eq!(
        fault,
        Fault::Value {
            number: 900_000_002,
            min,
            max
        }
    );
}

#[test]
fn octets_behind_the_message_are_refused() {
    for octets in rams() {
        let longer = [octets, vec![0, 0]].concat();
        let error = decode::<core::ram::RAM>(&identifiers(), &longer).unwrap_err();
        assert_eq!(error, DecodeError::TrailingOctets { count: 2 });
    }
}

#[test]
fn padding_that_is_not_zero_is_refused() {
    // The acknowledgement ends in the middle of an octet.
    let octets = &rmcms()[1];
    let last = octets.len() * 8 - 1;
    let error = decode_checked::<RMCM>(&flip(octets, last)).unwrap_err();
    let DecodeError::Malformed { fault, .. } = &error else {
        panic!("{error}")
    };
    assert_eq!(*fault, Fault::Padding);
    assert_eq!(
        rasn::uper::decode::<RMCM>(&flip(octets, last)).unwrap(),
        RMCM::of(&samples::answer_rmcm(&identifiers()))
    );
}

#[test]
fn a_component_that_spells_out_its_default_is_refused() {
    // The altitude of a target is "unavailable" by default. With 8000 m it is spelled out ...
    let mut parameters = samples::parameters();
    parameters.target = Some(crossguard_codec::Target::Position {
        latitude: 48.0,
        longitude: 9.0,
        altitude: Some(8_000.0),
    });
    let commands = [(samples::command(), parameters)];
    let position = samples::position();
    let rmcm = crossguard_codec::rmcm_from_commands(&identifiers(), &position, &commands, 0);
    let octets = encode(&identifiers(), &rmcm.unwrap()).unwrap();
    // ... as 800000, and the next number is 800001, unavailable.
    let bits = to_bits(&octets);
    let (altitude, unavailable) = (format!("{:020b}", 900_000), format!("{:020b}", 900_001));
    assert_eq!(bits.matches(&altitude).count(), 1);
    let octets = from_bits(&bits.replace(&altitude, &unavailable));
    let error = decode_checked::<RMCM>(&octets).unwrap_err();
    let DecodeError::Malformed { field, fault, .. } = error else {
        panic!("{error}");
    };
    assert_eq!(fault, Fault::DefaultSpelledOut);
    assert_eq!(field.names().last(), Some("altitude"));
}

#[test]
fn the_header_is_read_before_anything_else() {
    let octets = &rams()[0];
    for length in 0..6 {
        let error = decode::<core::ram::RAM>(&identifiers(), &octets[..length]).unwrap_err();
        assert_eq!(error, DecodeError::TooShort { length });
    }
    let error = decode::<core::rmcm::RMCM>(&identifiers(), octets).unwrap_err();
    assert_eq!(
        error,
        DecodeError::MessageId {
            found: 240,
            expected: "RMCM"
        }
    );
    let mut newer = octets.clone();
    newer[0] = 2;
    let error = decode::<core::ram::RAM>(&identifiers(), &newer).unwrap_err();
    assert_eq!(
        error,
        DecodeError::ProtocolVersion {
            message: "RAM",
            found: 2,
            known: 1
        }
    );
    let error = Message::decode(&identifiers(), &vams()[0]).unwrap_err();
    assert_eq!(
        error,
        DecodeError::MessageId {
            found: 16,
            expected: "RAM or RMCM"
        }
    );
}

#[test]
fn what_no_packet_carries_is_refused_unread() {
    let length = MESSAGE_LEN_MAX + 1;
    let octets = vec![0; length];
    let error = decode::<core::ram::RAM>(&identifiers(), &octets).unwrap_err();
    assert_eq!(
        error,
        DecodeError::TooLong {
            length,
            max: MESSAGE_LEN_MAX
        }
    );
}

#[test]
fn the_header_tells_the_messages_apart() {
    let ram = Message::decode(&identifiers(), &rams()[0]).unwrap().message;
    assert!(matches!(&ram, Message::Ram(_)));
    assert_eq!(ram.encode(&identifiers()).unwrap(), rams()[0]);
    let rmcm = Message::decode(&identifiers(), &rmcms()[0])
        .unwrap()
        .message;
    assert!(matches!(&rmcm, Message::Rmcm(_)));
    assert_eq!(rmcm.encode(&identifiers()).unwrap(), rmcms()[0]);
}

#[test]
fn identifiers_are_those_of_the_configuration() {
    let mut other = identifiers();
    other.ram.message_id = 200;
    let octets = encode(&other, &samples::typical_ram(&other)).unwrap();
    assert_eq!(octets[1], 200);
    assert!(decode::<core::ram::RAM>(&other, &octets).is_ok());
    assert!(decode::<core::ram::RAM>(&identifiers(), &octets).is_err());
}

/// Octets with the header of `M`.
fn with_header<M: Reference>(mut octets: Vec<u8>) -> Vec<u8> {
    let (protocol_version, message_id) = M::Message::expected_header(&identifiers());
    octets.splice(0..0, [protocol_version, message_id]);
    octets
}

/// Flips some bits and cuts or lengthens the end.
fn mutate(mut octets: Vec<u8>, flips: &[prop::sample::Index], length: usize) -> Vec<u8> {
    for index in flips {
        let bit = 48 + index.index(octets.len() * 8 - 48);
        octets = flip(&octets, bit);
    }
    octets.resize(octets.len().saturating_sub(3) + length, 0);
    octets
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn arbitrary_octets_are_no_trouble(octets in prop::collection::vec(any::<u8>(), 0..1_500)) {
        let _ = decode_checked::<RAM>(&octets);
        let _ = decode_checked::<RAM>(&with_header::<RAM>(octets.clone()));
        let _ = decode_checked::<RMCM>(&with_header::<RMCM>(octets.clone()));
        let _ = decode_checked::<VAM>(&with_header::<VAM>(octets.clone()));
        let _ = decode_checked::<DENM>(&with_header::<DENM>(octets));
    }

    #[test]
    fn arbitrary_messages_survive_and_their_mutations_are_no_trouble(
        seed: u64,
        flips in prop::collection::vec(any::<prop::sample::Index>(), 1..4),
        length in 0_usize..6,
    ) {
        let identifiers = identifiers();
        let ram = arbitrary::ram(&identifiers, seed).to_message().unwrap();
        let octets = encode(&identifiers, &ram).unwrap();
        prop_assert_eq!(decode_checked::<RAM>(&octets).unwrap(), ram);
        let _ = decode_checked::<RAM>(&mutate(octets, &flips, length));

        let rmcm = arbitrary::message::<RMCM>(&identifiers, seed).to_message().unwrap();
        let octets = encode(&identifiers, &rmcm).unwrap();
        prop_assert_eq!(decode_checked::<RMCM>(&octets).unwrap(), rmcm);
        let _ = decode_checked::<RMCM>(&mutate(octets, &flips, length));
    }

    #[test]
    fn arbitrary_denms_survive_and_their_mutations_are_no_trouble(
        seed: u64,
        flips in prop::collection::vec(any::<prop::sample::Index>(), 1..4),
        length in 0_usize..6,
    ) {
        let identifiers = identifiers();
        let denm: DENM = arbitrary::message(&identifiers, seed);
        // A DENM may be longer than a packet.
        if let Ok(octets) = encode(&identifiers, &denm) {
            prop_assert_eq!(decode_checked::<DENM>(&octets).unwrap(), denm);
            let _ = decode_checked::<DENM>(&mutate(octets, &flips, length));
        }
    }

    #[test]
    fn arbitrary_vams_survive(seed: u64) {
        let identifiers = identifiers();
        let vam: VAM = arbitrary::message(&identifiers, seed);
        // A VAM may break the rule on the shape of a cluster, and be longer than a packet.
        if let Ok(octets) = encode(&identifiers, &vam) {
            prop_assert_eq!(decode_checked::<VAM>(&octets).unwrap(), vam);
        }
    }
}
