//! Of RAM and RMCM exactly the canonical encodings are accepted; everything else is refused with its cause.

use std::collections::BTreeSet;

use crate::support::{flips, samples};
use crossguard_codec::{DecodeError, Identifiers, MESSAGE_LEN_MAX, Message, core, decode, encode};

fn identifiers() -> Identifiers {
    Identifiers::default()
}

fn typical() -> Vec<u8> {
    encode(&identifiers(), &samples::typical_ram(&identifiers())).unwrap()
}

#[test]
fn what_is_wrong_is_named_with_its_field() {
    let octets = &typical();
    let errors = flips(octets).filter_map(|flipped| {
        let error = decode::<core::ram::RAM>(&identifiers(), &flipped).err()?;
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
fn the_header_is_read_before_anything_else() {
    let octets = &typical();
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
    let mut of_another = octets.clone();
    of_another[1] = 16;
    let error = Message::decode(&identifiers(), &of_another).unwrap_err();
    let expected = "RAM or RMCM";
    assert_eq!(
        error,
        DecodeError::MessageId {
            found: 16,
            expected
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
fn identifiers_are_those_of_the_configuration() {
    let mut other = identifiers();
    other.ram.message_id = 200;
    let octets = encode(&other, &samples::typical_ram(&other)).unwrap();
    assert_eq!(octets[1], 200);
    assert!(decode::<core::ram::RAM>(&other, &octets).is_ok());
    assert!(decode::<core::ram::RAM>(&identifiers(), &octets).is_err());
}
