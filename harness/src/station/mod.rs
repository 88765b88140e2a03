//! What makes a robot an ITS station: messages in `GeoNetworking` packets.
//!
//! ```text
//!   message ──► Station::send ────► packet
//!   packet ───► Station::receive ──► message with its source, or a named cause
//! ```
//!
//! Without input and output; [`crossguard_codec::geonet::Stack`] does the work. Not for what the
//! messages say: that is [`wire`](crate::wire).

mod namesakes;
mod security;

use crossguard_codec::geonet::{
    Address, BasicHeader, Discarded, EgoPosition, Envelope, Headers, Indication, NextHeader,
    PACKET_LEN_MAX, Permits, SendError, Signer, Stack,
};
use crossguard_codec::security::SignedMessage;
use crossguard_codec::{Identifiers, Part, Service};
use crossguard_protocol::{Input, StationId};

pub use namesakes::NAMES_MAX;
use namesakes::Namesakes;
pub use security::{Credentials, Mode, Security, station_id};

/// One robot's ITS station.
#[derive(Clone, Debug)]
pub struct Station {
    identifiers: Identifiers,
    stack: Stack,
    pseudonym_period_ms: Option<u64>,
    /// When the pseudonym was taken.
    pseudonym_since_ms: u64,
    namesakes: Namesakes,
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

    /// Whether a message may say what it says, in the name of `from`, at `now_ms`.
    ///
    /// # Errors
    /// Why not.
    pub fn check_entitled(
        &mut self,
        (signer, permits): (Option<Signer>, Permits),
        from: StationId,
        inputs: &[Input],
        now_ms: u64,
    ) -> Result<(), NotEntitled> {
        for input in inputs {
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
            Some(signer) if !self.namesakes.admit(from, signer, now_ms) => {
                Err(NotEntitled::Namesake(from))
            }
            _ => Ok(()),
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

/// The message in a packet, whoever it is for and whoever signed it; or the octets, where they are no
/// packet.
#[must_use]
pub fn message_of(octets: &[u8]) -> &[u8] {
    let Ok((basic, rest)) = BasicHeader::decode(octets) else {
        return octets;
    };
    let plain = match basic.next {
        NextHeader::Common => Some(rest),
        NextHeader::Secured => SignedMessage::decode(rest)
            .ok()
            .map(|signed| signed.payload),
    };
    let behind = plain.and_then(|plain| Headers::decode_behind(basic, plain).ok());
    behind.map_or(octets, |(_, message)| message)
}
