//! How a packet lies in a UDP datagram: alone, or behind an Ethernet header.
//!
//! Some stacks send on UDP what their radio would get, with an Ethernet header of ethertype 0x8947 in front.

use crossguard_codec::geonet::ethernet;
use crossguard_endpoint::station::listen::link_layer_of;
use serde::Deserialize;

/// How a packet lies in a UDP datagram.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Framing {
    /// The datagram is the `GeoNetworking` packet.
    #[default]
    #[serde(rename = "geonetworking")]
    GeoNetworking,
    /// The packet is behind an Ethernet header.
    Ethernet,
}

/// Why a datagram is not taken apart.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
pub enum FramingError {
    /// There is no room for an Ethernet header.
    #[error("{0} octets are too few for an Ethernet header, which has 14")]
    Short(usize),
    /// The frame carries something else.
    #[error("its ethertype is {0:#06x}, and that of GeoNetworking 0x8947")]
    Ethertype(u16),
}

impl FramingError {
    /// The name of the cause, for counters.
    #[must_use]
    pub const fn cause(self) -> &'static str {
        match self {
            Self::Short(_) => "no Ethernet header",
            Self::Ethertype(_) => "another ethertype",
        }
    }
}

impl Framing {
    /// Octets of a datagram with this packet.
    #[must_use]
    pub fn wrap(self, packet: &[u8]) -> Vec<u8> {
        match self {
            Self::GeoNetworking => packet.to_vec(),
            Self::Ethernet => [&ethernet::header(link_layer_of(packet))[..], packet].concat(),
        }
    }

    /// The packet in a datagram.
    ///
    /// # Errors
    /// When there is none.
    pub fn unwrap(self, datagram: &[u8]) -> Result<&[u8], FramingError> {
        if self == Self::GeoNetworking {
            return Ok(datagram);
        }
        match (ethernet::packet(datagram), datagram.get(12..14)) {
            (Some((_, packet)), _) => Ok(packet),
            (None, Some(&[high, low])) => {
                Err(FramingError::Ethertype(u16::from_be_bytes([high, low])))
            }
            (None, _) => Err(FramingError::Short(datagram.len())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_packet_comes_back_from_either_framing() {
        for (framing, length) in [(Framing::GeoNetworking, 6), (Framing::Ethernet, 20)] {
            let datagram = framing.wrap(b"packet");
            assert_eq!(datagram.len(), length);
            assert_eq!(framing.unwrap(&datagram), Ok(&b"packet"[..]));
        }
    }

    #[test]
    fn a_datagram_without_such_a_header_is_named() {
        let unwrap = |datagram: &[u8]| Framing::Ethernet.unwrap(datagram).unwrap_err();
        assert_eq!(unwrap(&[0; 13]), FramingError::Short(13));
        let mut datagram = Framing::Ethernet.wrap(b"packet");
        datagram[12..14].copy_from_slice(&[0x08, 0x00]);
        assert_eq!(unwrap(&datagram), FramingError::Ethertype(0x0800));
    }
}
