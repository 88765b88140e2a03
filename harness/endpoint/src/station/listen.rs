//! Packets and messages as any receiver can read them, without verifying them: for sniffers, captures and charts.

#[cfg(feature = "security")]
use crossguard_codec::geonet::EnvelopeError;
#[cfg(not(feature = "security"))]
use crossguard_codec::geonet::GeonetError;
use crossguard_codec::geonet::{BasicHeader, Discarded, Headers, NextHeader};
use crossguard_codec::{Heard, Identifiers, Position, Unheard};
use crossguard_protocol::StationId;

/// The headers of a packet and the message in it, for any receiver; also of one with a security
/// envelope, whose content is not verified then. For listeners.
///
/// # Errors
/// Why it has none.
pub fn peek(packet: &[u8]) -> Result<(Headers, &[u8]), Discarded> {
    let (basic, rest) = BasicHeader::decode(packet)?;
    let plain = match basic.next {
        NextHeader::Common => rest,
        NextHeader::Secured => signed(rest)?,
    };
    Ok(Headers::decode_behind(basic, plain)?)
}

/// The payload of a security envelope, whose signature is not looked at.
#[cfg(feature = "security")]
fn signed(envelope: &[u8]) -> Result<&[u8], Discarded> {
    let signed = crossguard_codec::security::SignedMessage::decode(envelope);
    Ok(signed.map_err(EnvelopeError::from)?.payload)
}

/// Nothing is known of security envelopes.
#[cfg(not(feature = "security"))]
const fn signed(_: &[u8]) -> Result<&[u8], Discarded> {
    Err(Discarded::Headers(GeonetError::Secured))
}

/// The message in a packet, as [`peek`] has it; or the octets, where they are no packet.
#[must_use]
pub fn message_of(octets: &[u8]) -> &[u8] {
    peek(octets).map_or(octets, |(_, message)| message)
}

/// The link-layer address of a packet's source; `02:00:00:00:00:00` where it has none.
#[must_use]
pub fn link_layer_of(packet: &[u8]) -> [u8; 6] {
    peek(packet).map_or([0x02, 0, 0, 0, 0, 0], |(headers, _)| {
        headers.source.address.link_layer
    })
}

/// Content of `octets`, a message or a packet with one, to a listener: for charts and tools.
///
/// # Errors
/// Why they say nothing.
pub fn overhear(identifiers: &Identifiers, octets: &[u8]) -> Result<Heard, Unheard> {
    let nobody = StationId(u32::MAX);
    Heard::of(
        identifiers,
        nobody,
        &Position::default(),
        message_of(octets),
    )
}
