//! Messages on the wire: CDR, as `rmw_zenoh` writes and reads it.
//!
//! A message is four octets that say how the rest is encoded, and then plain CDR (XCDR version 1): every
//! primitive aligned to its size, counted from behind those four octets, strings with their length and a
//! zero, sequences with their length. It is written in little endian and read in either order.

use byteorder::{BigEndian, LittleEndian};
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::types::TYPES;

/// A message that has a topic.
pub trait Message: Serialize + DeserializeOwned {
    /// Its full name, like `std_msgs/msg/String`.
    const NAME: &'static str;
}

/// A service.
pub trait Service {
    /// Its full name, like `lifecycle_msgs/srv/GetState`.
    const NAME: &'static str;
    /// What it is asked.
    type Request: Serialize + DeserializeOwned;
    /// What it answers.
    type Response: Serialize + DeserializeOwned;
}

/// How plain CDR in little endian begins.
const LITTLE_ENDIAN: [u8; 4] = [0, 1, 0, 0];

/// Why octets are not the message that is expected, or a message cannot be written.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum CdrError {
    /// They are fewer than four.
    #[error("{0} octets are no message: its encoding alone takes 4")]
    Short(usize),
    /// The encoding is another one.
    #[error("the encoding is {0:02x}{1:02x}; plain CDR, 0000 or 0001, is understood")]
    Encoding(u8, u8),
    /// The octets are not those of this type.
    #[error("{0}")]
    Content(String),
    /// Something stands behind the message that is no padding.
    #[error("{0} octets are left over")]
    LeftOver(usize),
}

/// The octets of a message.
///
/// # Errors
/// When it has something that CDR cannot express, as a sequence of unknown length.
pub fn encode<M: Serialize>(message: &M) -> Result<Vec<u8>, CdrError> {
    let body = cdr_encoding::to_vec::<M, LittleEndian>(message);
    let body = body.map_err(|error| CdrError::Content(error.to_string()))?;
    Ok([&LITTLE_ENDIAN[..], &body].concat())
}

/// The message that octets are. Up to three octets of padding may stand behind it.
///
/// # Errors
/// Why they are none of this type.
pub fn decode<M: DeserializeOwned>(octets: &[u8]) -> Result<M, CdrError> {
    let (encoding, body) = octets
        .split_first_chunk::<4>()
        .ok_or(CdrError::Short(octets.len()))?;
    // The other two are options, which say how much padding there is.
    let decoded = match [encoding[0], encoding[1]] {
        [0, 0] => cdr_encoding::from_bytes::<M, BigEndian>(body),
        [0, 1] => cdr_encoding::from_bytes::<M, LittleEndian>(body),
        [first, second] => return Err(CdrError::Encoding(first, second)),
    };
    let (message, taken) = decoded.map_err(|error| CdrError::Content(error.to_string()))?;
    match body.len().saturating_sub(taken) {
        0..=3 => Ok(message),
        left => Err(CdrError::LeftOver(left)),
    }
}

/// The hash of a type that comes along.
///
/// # Panics
/// If `name` is none of them, which a test rules out.
pub(crate) fn hash_of(name: &str) -> String {
    TYPES.hash(name).expect("a test hashes all of them")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::standard::{Header, KeyValue, Text, Time};

    #[test]
    fn a_text_has_its_length_and_a_zero() {
        let text = Text {
            data: "Hi".to_owned(),
        };
        let octets = encode(&text).unwrap();
        assert_eq!(octets, [0, 1, 0, 0, 3, 0, 0, 0, b'H', b'i', 0]);
        assert_eq!(decode::<Text>(&octets), Ok(text));
        let empty = encode(&Text::default()).unwrap();
        assert_eq!(empty, [0, 1, 0, 0, 1, 0, 0, 0, 0]);
    }

    #[test]
    fn values_are_aligned_from_behind_the_encoding() {
        #[derive(serde::Serialize, serde::Deserialize, PartialEq, Debug)]
        struct Mixed {
            a: u8,
            b: f64,
            c: u16,
            d: Vec<KeyValue>,
        }
        let mixed = Mixed {
            a: 7,
            b: 1.5,
            c: 258,
            d: vec![KeyValue::default()],
        };
        let octets = encode(&mixed).unwrap();
        let body = [
            7, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xf8, 0x3f, 2, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0,
            0, 0, 0, 0, 0, 1, 0, 0, 0, 0,
        ];
        assert_eq!(octets[4..], body);
        assert_eq!(decode::<Mixed>(&octets), Ok(mixed));
    }

    #[test]
    fn both_orders_of_octets_are_read() {
        let header = Header {
            stamp: Time { sec: 1, nanosec: 2 },
            frame_id: "m".to_owned(),
        };
        let big = [vec![0; 4], b"\0\0\0\x01\0\0\0\x02\0\0\0\x02m\0".to_vec()].concat();
        assert_eq!(decode::<Header>(&big), Ok(header.clone()));
        assert_eq!(decode::<Header>(&encode(&header).unwrap()), Ok(header));
    }

    #[test]
    fn what_is_no_message_is_refused_with_a_cause() {
        assert_eq!(decode::<Text>(&[0, 1]), Err(CdrError::Short(2)));
        let other = decode::<Text>(&[0, 7, 0, 0, 1, 0, 0, 0, 0]);
        assert_eq!(other, Err(CdrError::Encoding(0, 7)));
        // A length that the octets do not have.
        let cut = decode::<Text>(&[0, 1, 0, 0, 255, 255, 255, 255, b'a']);
        assert!(matches!(cut, Err(CdrError::Content(_))), "{cut:?}");
        let long = decode::<Text>(&[0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 2, 3, 4]);
        assert_eq!(long, Err(CdrError::LeftOver(4)));
    }
}
