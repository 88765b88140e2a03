//! What makes a robot an ITS station: messages in `GeoNetworking` packets.
//!
//! ```text
//!   message ──► Station::send ────► packet
//!   packet ───► Station::receive ──► message with its source, or a named cause
//! ```
//!
//! Without input and output; [`crossguard_codec::geonet::Stack`] does the work. Not for what the
//! messages say: that is [`wire`](crate::wire).

use crossguard_codec::geonet::{
    Address, BasicHeader, Discarded, EgoPosition, Envelope, Headers, Indication, NextHeader,
    PACKET_LEN_MAX, SendError, Stack,
};
use crossguard_codec::{Identifiers, Service};
use crossguard_protocol::StationId;

/// One robot's ITS station.
#[derive(Clone, Debug)]
pub struct Station {
    identifiers: Identifiers,
    stack: Stack,
}

impl Station {
    /// The station of a robot that goes by this id.
    #[must_use]
    pub fn new(identifiers: &Identifiers, station: StationId) -> Self {
        let address = Address::of_station(station.0, identifiers.robot_station_type);
        Self {
            identifiers: *identifiers,
            stack: Stack::new(*identifiers, address, Envelope::Off),
        }
    }

    /// The packet with a message of this service.
    ///
    /// # Errors
    /// Why it cannot be sent.
    pub fn send(
        &mut self,
        ego: &EgoPosition,
        service: Service,
        message: &[u8],
    ) -> Result<Vec<u8>, SendError> {
        let request = service.request(&self.identifiers);
        let mut packet = [0; PACKET_LEN_MAX];
        let length = self.stack.send(ego, &request, message, &mut packet)?;
        Ok(packet[..length].to_vec())
    }

    /// The message in a packet.
    ///
    /// # Errors
    /// Why it is not for this station.
    pub fn receive<'a>(
        &mut self,
        ego: &EgoPosition,
        packet: &'a [u8],
    ) -> Result<Indication<'a>, Discarded> {
        self.stack.receive(ego, packet)
    }
}

/// The message in a packet, whoever it is for; or the octets, where they are no packet without a
/// security envelope.
#[must_use]
pub fn message_of(octets: &[u8]) -> &[u8] {
    match BasicHeader::decode(octets) {
        Ok((basic, rest)) if basic.next == NextHeader::Common => {
            Headers::decode_behind(basic, rest).map_or(octets, |(_, message)| message)
        }
        _ => octets,
    }
}
