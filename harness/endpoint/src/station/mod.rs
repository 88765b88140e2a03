//! What makes a robot an ITS station: messages in `GeoNetworking` packets, and a map of who is around.
//!
//! ```text
//!   message ──► Station::send ────► packet
//!   packet ───► Station::receive ──► message with its source, or a named cause
//!   message ──► Station::observe ──► LocalDynamicMap
//! ```
//!
//! Without input and output; [`crossguard_codec::geonet::Stack`] does the work. Not for what robots
//! tell each other: that is [`wire`](crate::wire).

mod map;

pub use map::{LocalDynamicMap, Neighbour, USERS_MAX, lifetime_ms};

mod namesakes;
mod security;

use crossguard_codec::geonet::{
    Address, BasicHeader, Discarded, EgoPosition, Envelope, GeonetError, Headers, Indication,
    NextHeader, PACKET_LEN_MAX, Permits, SendError, Signer, Stack,
};
use crossguard_codec::its::{ItsMessage, RoadUser};
use crossguard_codec::security::SignedMessage;
use crossguard_codec::si::rebuild_timestamp;
use crossguard_codec::{DecodeError, Identifiers, Part, Service};
use crossguard_protocol::{Input, StationId};

pub use namesakes::NAMES_MAX;
use namesakes::Namesakes;
pub use security::{Credentials, Mode, NoSuchMode, Security, station_id};

use crate::counters::Cause;
use crate::wire::Heard;

/// One robot's ITS station.
#[derive(Clone, Debug)]
pub struct Station {
    identifiers: Identifiers,
    stack: Stack,
    pseudonym_period_ms: Option<u64>,
    /// When the pseudonym was taken.
    pseudonym_since_ms: u64,
    namesakes: Namesakes,
    map: LocalDynamicMap,
}

/// Why a message that was verified is not heeded all the same.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
pub enum NotEntitled {
    /// Another ticket goes by this station id.
    #[error("station {0} goes by another certificate")]
    Namesake(StationId),
    /// The ticket does not permit this part in a session.
    #[error("the certificate does not permit to {}", .0.name())]
    Part(Part),
}

impl NotEntitled {
    /// The name of the cause, for counters.
    #[must_use]
    pub const fn cause(self) -> &'static str {
        match self {
            Self::Namesake(_) => "station id of another certificate",
            Self::Part(_) => "beyond service permissions",
        }
    }
}

impl Station {
    /// The station of a robot that goes by this id, without security.
    #[must_use]
    pub fn new(identifiers: &Identifiers, station: StationId) -> Self {
        let address = Address::of_station(station.0, identifiers.robot_station_type);
        Self {
            identifiers: *identifiers,
            stack: Stack::new(*identifiers, address, Envelope::Off),
            pseudonym_period_ms: None,
            pseudonym_since_ms: 0,
            namesakes: Namesakes::default(),
            map: LocalDynamicMap::default(),
        }
    }

    /// The same with security, whose first pseudonym is taken at `now_ms`.
    #[must_use]
    pub fn with_security(mut self, security: Security, now_ms: u64) -> Self {
        *self.stack.envelope_mut() = security.envelope;
        self.pseudonym_period_ms = security.pseudonym_period_ms;
        self.pseudonym_since_ms = now_ms;
        self
    }

    /// Changes the pseudonym if that is due at `now_ms`, or its ticket is over within `lock_ms`, as long
    /// as a session may take: ticket, address and station id at once. The caller tells the robot its
    /// new id, and does this only while the identity is not locked.
    pub fn renew_pseudonym(
        &mut self,
        ego: &EgoPosition,
        now_ms: u64,
        lock_ms: u64,
    ) -> Option<StationId> {
        let Envelope::Secured(secured) = self.stack.envelope_mut() else {
            return None;
        };
        let age_ms = now_ms.saturating_sub(self.pseudonym_since_ms);
        let is_due = self
            .pseudonym_period_ms
            .is_some_and(|period_ms| age_ms >= period_ms);
        if is_due {
            self.pseudonym_since_ms = now_ms;
        }
        let pseudonym = secured.renew_pseudonym(ego, is_due, lock_ms)?;
        self.pseudonym_since_ms = now_ms;
        let station = station_id(pseudonym);
        let address = Address::of_station(station.0, self.identifiers.robot_station_type);
        self.stack
            .change_address(address, security::sequence_number(pseudonym));
        Some(station)
    }

    /// Whether a message may say what it says, in the name of its sender, at `now_ms`.
    ///
    /// # Errors
    /// Why not.
    pub fn check_entitled(
        &mut self,
        (signer, permits): (Option<Signer>, Permits),
        heard: &Heard,
        now_ms: u64,
    ) -> Result<(), NotEntitled> {
        for input in heard.inputs.iter() {
            let parts: Vec<_> = match input {
                Input::Ram { ram, .. } => Part::of_ram(ram).collect(),
                Input::Rmcm(rmcm) => vec![Part::of_rmcm(rmcm)],
                _ => Vec::new(),
            };
            if let Some(part) = parts.into_iter().find(|part| !permits.allows(part.bit())) {
                return Err(NotEntitled::Part(part));
            }
        }
        match signer {
            Some(signer) if !self.namesakes.admit(heard.from, signer, now_ms) => {
                Err(NotEntitled::Namesake(heard.from))
            }
            _ => Ok(()),
        }
    }

    /// Who is around.
    #[must_use]
    pub const fn map(&self) -> &LocalDynamicMap {
        &self.map
    }

    /// Forgets who was not heard of for too long.
    pub fn elapse(&mut self, now_ms: u64) {
        self.map.forget(now_ms);
    }

    /// Puts the sender of a RAM on the map, and the people that it announces.
    pub fn observe_robot(&mut self, heard: &Heard, ego: &EgoPosition, now_ms: u64) {
        let Some(state) = &heard.state else { return };
        let measured = rebuild_timestamp(ego.timestamp_its, heard.generation_delta_time);
        let station_type = self.identifiers.robot_station_type;
        let around = heard.cluster.as_ref();
        for user in RoadUser::of_robot(heard.from.0, station_type, state, around, measured) {
            self.map.observe(user, now_ms);
        }
    }

    /// Puts the road users of another station's message on the map, and returns the message.
    ///
    /// # Errors
    /// Why the octets are not the message of this service.
    pub fn observe(
        &mut self,
        service: Service,
        octets: &[u8],
        ego: &EgoPosition,
        now_ms: u64,
    ) -> Result<ItsMessage, Unobserved> {
        let message = ItsMessage::decode(&self.identifiers, octets)?.message;
        let found = service_of(&message);
        if found != Some(service) {
            return Err(Unobserved::OtherService { service, found });
        }
        for user in message.road_users(ego.timestamp_its) {
            self.map.observe(user, now_ms);
        }
        Ok(message)
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
}

impl From<&Unobserved> for Cause {
    fn from(unobserved: &Unobserved) -> Self {
        match unobserved {
            Unobserved::Undecodable(error) => error.into(),
            Unobserved::OtherService { .. } => Self::Discarded("message of another port"),
        }
    }
}

/// The headers of a packet and the message in it, for any receiver; also of one with a security
/// envelope, whose content is not verified then. For those who listen in.
///
/// # Errors
/// Why it has none.
pub fn peek(packet: &[u8]) -> Result<(Headers, &[u8]), Discarded> {
    let (basic, rest) = BasicHeader::decode(packet)?;
    let plain = match basic.next {
        NextHeader::Common => rest,
        NextHeader::Secured => {
            SignedMessage::decode(rest)
                .map_err(|_| Discarded::Headers(GeonetError::Secured))?
                .payload
        }
    };
    Ok(Headers::decode_behind(basic, plain)?)
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
