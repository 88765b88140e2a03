//! What any receiver can say of packets and messages, without verifying them: for sniffers, captures and charts.

#[cfg(feature = "security")]
use crossguard_codec::geonet::EnvelopeError;
#[cfg(not(feature = "security"))]
use crossguard_codec::geonet::GeonetError;
use crossguard_codec::geonet::{
    BasicHeader, Discarded, EgoPosition, Headers, Indication, NextHeader,
};
use crossguard_codec::its::ItsMessage;
use crossguard_codec::{DecodeError, Heard, Identifiers, Position, Received, Service, Unheard};
use crossguard_protocol::StationId;

use super::namesakes::NotAdmitted;
use super::neighbours::Neighbours;
use crate::cause::Cause;

/// The service that a message is of.
#[must_use]
pub const fn service_of(message: &ItsMessage) -> Option<Service> {
    Some(match message {
        ItsMessage::Ram(_) => Service::Ram,
        ItsMessage::Rmcm(_) => Service::Rmcm,
        ItsMessage::Cam(_) => Service::Cam,
        ItsMessage::Denm(_) => Service::Denm,
        ItsMessage::Vam(_) | ItsMessage::Vam211(_) => Service::Vam,
        ItsMessage::Cpm(_) => Service::Cpm,
        _ => return None,
    })
}

/// Why a message tells of nobody.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Unobserved {
    /// It is not a message.
    #[error(transparent)]
    Undecodable(#[from] DecodeError),
    /// It is that of another service.
    #[error("a message of {found:?} at the port of {service:?}")]
    OtherService {
        /// The service at the port.
        service: Service,
        /// The service that it is of.
        found: Option<Service>,
    },
    /// It goes by the own station id: the robot is not its own neighbour.
    #[error("a message of the own station {0}")]
    OwnStation(StationId),
    /// Its certificate may not go by its station id.
    #[error(transparent)]
    NotAdmitted(#[from] NotAdmitted),
}

impl From<&Unobserved> for Cause {
    fn from(unobserved: &Unobserved) -> Self {
        match unobserved {
            Unobserved::Undecodable(error) => error.into(),
            Unobserved::OtherService { .. } => Self::Discarded("message of another port"),
            Unobserved::OwnStation(_) => Self::Discarded("message of the own station"),
            Unobserved::NotAdmitted(why) => (*why).into(),
        }
    }
}

impl Neighbours {
    /// Puts the road users of the message of another station than `me` on the map, and returns the message.
    ///
    /// # Errors
    /// Why the octets are not the message of this service, or of another station.
    pub(crate) fn observe(
        &mut self,
        me: StationId,
        indication: &Indication<'_>,
        ego: &EgoPosition,
        now_ms: u64,
    ) -> Result<Received<ItsMessage>, Unobserved> {
        let service = indication.service;
        let received = ItsMessage::decode(&self.identifiers, indication.message)?;
        let message = &received.message;
        let found = service_of(message);
        if found != Some(service) {
            return Err(Unobserved::OtherService { service, found });
        }
        if message.header().station_id.0 == me.0 {
            return Err(Unobserved::OwnStation(me));
        }
        if let Some(signer) = indication.signer {
            let from = StationId(message.header().station_id.0);
            let as_whom = (signer, indication.source.address);
            self.namesakes.admit(from, as_whom, now_ms)?;
        }
        for user in message.road_users(ego.timestamp_its) {
            self.map.observe(user, now_ms);
        }
        Ok(received)
    }
}

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

/// What `octets`, a message or a packet with one, say to a listener: for charts and tools.
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
