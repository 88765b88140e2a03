//! Faults of headers.

/// A field of the headers, or a group of fields that are read together.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub enum HeaderField {
    /// Basic header: version and next header.
    BasicNextHeader,
    /// Basic header: reserved octet.
    BasicReserved,
    /// Basic header: lifetime.
    Lifetime,
    /// Basic header: remaining hop limit.
    RemainingHopLimit,
    /// Common header: next header and reserved bits.
    CommonNextHeader,
    /// Common header: header type and subtype.
    HeaderType,
    /// Common header: traffic class.
    TrafficClass,
    /// Common header: flags.
    Flags,
    /// Common header: payload length.
    PayloadLength,
    /// Common header: maximum hop limit.
    MaximumHopLimit,
    /// Common header: reserved octet.
    CommonReserved,
    /// Geo-broadcast: sequence number.
    SequenceNumber,
    /// Geo-broadcast: reserved octets behind the sequence number.
    SequenceReserved,
    /// Position vector: address.
    Address,
    /// Position vector: time stamp.
    Timestamp,
    /// Position vector: latitude and longitude.
    Position,
    /// Position vector: accuracy indicator and speed.
    Speed,
    /// Position vector: heading.
    Heading,
    /// Single-hop broadcast: media-dependent data.
    Media,
    /// Geo-broadcast: centre of the area.
    AreaPosition,
    /// Geo-broadcast: distances of the area.
    AreaDistances,
    /// Geo-broadcast: angle of the area.
    AreaAngle,
    /// Geo-broadcast: reserved octets behind the area.
    AreaReserved,
    /// BTP-B: destination port.
    Port,
    /// BTP-B: destination port info.
    PortInfo,
}

/// Why octets are not the headers of a packet, or headers have no octets.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GeonetError {
    /// The packet ends within the field.
    #[error("the packet ends within {field:?}")]
    Truncated {
        /// The field.
        field: HeaderField,
    },
    /// The field has a value that it cannot have, or that this crate does not know.
    #[error("{field:?} is {found:#x}, which is not possible or not supported")]
    Value {
        /// The field.
        field: HeaderField,
        /// Its value.
        found: u16,
    },
    /// The packet is of another version of the protocol (EN 302 636-4-1, 9.6.2).
    #[error("GeoNetworking of version {0}: version 1 is read")]
    Version(u8),
    /// The packet is secured: a security envelope follows the basic header.
    #[error("a security envelope follows the basic header")]
    Secured,
    /// The payload length is not that of what follows.
    #[error("PayloadLength is {announced}, and {present} octets follow the headers")]
    PayloadLength {
        /// The length in the common header.
        announced: u16,
        /// How many octets follow, BTP-B included.
        present: usize,
    },
}
