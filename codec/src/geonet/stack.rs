//! Packets of messages, and messages of packets, without input and output.
//!
//! ```text
//!   message, port, ego position ──► headers ──► envelope ──► packet
//!   packet ──► basic header ──► headers ──► service ──► signature ──► message, source
//!                   └────────────┴────────────┴────────────┴──► Discarded
//! ```

use crossguard_protocol::StationId;

use super::{
    Address, Admitted, BASIC_LEN, BasicHeader, Discarded, EgoPosition, Envelope, EnvelopeError,
    GeonetError, HEADERS_LEN_MAX, Headers, LongPositionVector, NextHeader, PACKET_LEN_MAX, Permits,
    Request, Signer, Transport,
};
use crate::identifiers::Identifiers;
use crate::service::Service;
use crate::size::MESSAGE_LEN_MAX;

/// A message that was received.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Indication<'a> {
    /// Which service it is for.
    pub service: Service,
    /// The message.
    pub message: &'a [u8],
    /// Where its source was.
    pub source: LongPositionVector,
    /// The headers that it came with.
    pub headers: Headers,
    /// Its signer; none if it came without an envelope.
    pub signer: Option<Signer>,
    /// Its permissions within the service.
    pub permits: Permits,
}

impl Indication<'_> {
    /// The station id that the ticket of its signer stands for, in RAM and RMCM; `None` if nobody vouches for the
    /// packet.
    #[must_use]
    pub fn vouched_for(&self) -> Option<StationId> {
        let signer = self.signer?;
        Some(self.permits.station(signer))
    }
}

/// Why a message cannot be sent.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SendError {
    /// The message is too long.
    #[error("a message of {length} octets is too long, the limit is {MESSAGE_LEN_MAX}")]
    TooLong {
        /// How long it is.
        length: usize,
    },
    /// The packet with its envelope does not fit into the buffer or on the link.
    #[error("the packet is too long for its buffer")]
    NoRoom,
    /// A value does not fit in its header.
    #[error("{0}")]
    Headers(#[from] GeonetError),
    /// It cannot be secured.
    #[error("{0}")]
    Envelope(#[from] EnvelopeError),
}

/// Layers under the messages of one station.
#[derive(Clone, Debug)]
pub struct Stack {
    identifiers: Identifiers,
    address: Address,
    envelope: Envelope,
    sent: Sent,
}

/// How many sent packets are told from those of a namesake: a robot sends no more in a second.
const SENT: usize = 32;

/// The newest packets that were sent, by a hash of each.
#[derive(Clone, Copy, Debug)]
struct Sent {
    hashes: [u64; SENT],
    next: usize,
}

impl Sent {
    /// FNV-1a, which needs no table.
    fn hash(packet: &[u8]) -> u64 {
        packet.iter().fold(0xcbf2_9ce4_8422_2325, |hash, octet| {
            (hash ^ u64::from(*octet)).wrapping_mul(0x0100_0000_01b3)
        })
    }

    fn add(&mut self, packet: &[u8]) {
        self.hashes[self.next % SENT] = Self::hash(packet);
        self.next = self.next.wrapping_add(1);
    }

    fn has(&self, packet: &[u8]) -> bool {
        self.hashes.contains(&Self::hash(packet))
    }
}

impl Stack {
    /// The stack of a station with this address.
    #[must_use]
    pub fn new(identifiers: Identifiers, address: Address, envelope: Envelope) -> Self {
        Self {
            identifiers,
            address,
            envelope,
            sent: Sent {
                hashes: [0; SENT],
                next: 0,
            },
        }
    }

    /// The stack of the robot that goes by this station id, without security.
    #[must_use]
    pub fn of_robot(identifiers: Identifiers, station: StationId) -> Self {
        let address = Address::of_station(station.0, identifiers.robot_station_type);
        Self::new(identifiers, address, Envelope::Off)
    }

    /// The address of the own station.
    #[must_use]
    pub const fn address(&self) -> Address {
        self.address
    }

    /// The security envelope.
    #[must_use]
    pub const fn envelope(&self) -> &Envelope {
        &self.envelope
    }

    /// The security envelope, to change its pseudonym and the like.
    pub const fn envelope_mut(&mut self) -> &mut Envelope {
        &mut self.envelope
    }

    /// Goes by another address from now on, after a change of pseudonym.
    pub const fn change_address(&mut self, address: Address) {
        self.address = address;
    }

    /// Puts a message into a packet at the front of `packet`, and tells how long it is.
    /// [`PACKET_LEN_MAX`] octets are enough.
    ///
    /// # Errors
    /// Why it cannot be sent.
    pub fn send(
        &mut self,
        ego: &EgoPosition,
        request: &Request,
        message: &[u8],
        packet: &mut [u8],
    ) -> Result<usize, SendError> {
        let length = self.put(ego, request, message, packet)?;
        self.sent.add(&packet[..length]);
        Ok(length)
    }

    fn put(
        &mut self,
        ego: &EgoPosition,
        request: &Request,
        message: &[u8],
        packet: &mut [u8],
    ) -> Result<usize, SendError> {
        let length = message.len();
        if length > MESSAGE_LEN_MAX {
            return Err(SendError::TooLong { length });
        }
        let headers = self.headers(ego, request);
        let encoded = headers.encode(length)?;
        let mut plain = [0; HEADERS_LEN_MAX + MESSAGE_LEN_MAX];
        let header_length = encoded.as_ref().len();
        let length = header_length + length;
        plain[..header_length].copy_from_slice(encoded.as_ref());
        plain[header_length..length].copy_from_slice(message);
        let (basic, room) = packet
            .split_first_chunk_mut::<BASIC_LEN>()
            .ok_or(SendError::NoRoom)?;
        let behind = &plain[BASIC_LEN..length];
        if let Some(secured) = self.envelope.seal(ego, request.its_aid, behind, room)? {
            *basic = headers.basic(NextHeader::Secured).encode()?;
            return within_limit(BASIC_LEN + secured);
        }
        *basic = headers.basic(NextHeader::Common).encode()?;
        let room = room.get_mut(..behind.len()).ok_or(SendError::NoRoom)?;
        room.copy_from_slice(behind);
        within_limit(length)
    }

    /// The packet with a message of this service.
    ///
    /// # Errors
    /// Why it cannot be sent.
    #[cfg(feature = "std")]
    pub fn packet(
        &mut self,
        ego: &EgoPosition,
        service: Service,
        message: &[u8],
    ) -> Result<Vec<u8>, SendError> {
        let request = service.request(&self.identifiers);
        let mut packet = [0; PACKET_LEN_MAX];
        let length = self.send(ego, &request, message, &mut packet)?;
        Ok(packet[..length].to_vec())
    }

    fn headers(&self, ego: &EgoPosition, request: &Request) -> Headers {
        Headers {
            lifetime: request.lifetime,
            remaining_hop_limit: 1,
            maximum_hop_limit: 1,
            traffic_class: request.traffic_class,
            is_mobile: true,
            source: ego.vector(self.address),
            transport: Transport::SingleHop { media: [0; 4] },
            port: request.port,
            port_info: request.port_info,
        }
    }

    /// Takes a packet apart.
    ///
    /// # Errors
    /// Why it is discarded. A packet from the own address is an echo only if it is one of the last that were sent.
    pub fn receive<'a>(
        &mut self,
        ego: &EgoPosition,
        packet: &'a [u8],
    ) -> Result<Indication<'a>, Discarded> {
        self.take(ego, packet).map_err(|discarded| match discarded {
            Discarded::OwnPacket if !self.sent.has(packet) => Discarded::Namesake,
            discarded => discarded,
        })
    }

    fn take<'a>(
        &mut self,
        ego: &EgoPosition,
        packet: &'a [u8],
    ) -> Result<Indication<'a>, Discarded> {
        let length = packet.len();
        if length > PACKET_LEN_MAX {
            return Err(Discarded::TooLong { length });
        }
        let (basic, rest) = BasicHeader::decode(packet)?;
        let (own, identifiers) = (self.address, self.identifiers);
        let take_apart = |plain, its_aid| -> Result<Admitted<'a>, Discarded> {
            let (headers, message) = Headers::decode_behind(basic, plain)?;
            let service = admit(&identifiers, own, &headers, its_aid)?;
            Ok(Admitted {
                headers,
                service,
                message,
            })
        };
        let (admitted, opened) = match basic.next {
            NextHeader::Common => {
                self.envelope.admit_plain()?;
                (take_apart(rest, None)?, None)
            }
            NextHeader::Secured => {
                let take_apart = |plain, its_aid| take_apart(plain, Some(its_aid));
                let (admitted, opened) = self.envelope.open(ego, rest, take_apart)?;
                (admitted, Some(opened))
            }
        };
        let Admitted {
            headers,
            service,
            message,
        } = admitted;
        Ok(Indication {
            service,
            message,
            source: headers.source,
            headers,
            signer: opened.map(|opened| opened.signer),
            permits: opened.map_or(Permits::EVERYTHING, |opened| opened.permits),
        })
    }
}

/// The service that a packet is for, if it is for the station with this address.
fn admit(
    identifiers: &Identifiers,
    own: Address,
    headers: &Headers,
    its_aid: Option<u32>,
) -> Result<Service, Discarded> {
    let Headers { source, port, .. } = *headers;
    if source.address == own {
        return Err(Discarded::OwnPacket);
    }
    if let Transport::GeoBroadcast { .. } = headers.transport {
        return Err(Discarded::GeoBroadcast);
    }
    let service = Service::at_port(identifiers, port).ok_or(Discarded::UnknownPort(port))?;
    match its_aid {
        Some(its_aid) if its_aid != service.its_aid(identifiers) => {
            Err(Discarded::WrongPermission { port, its_aid })
        }
        _ => Ok(service),
    }
}

const fn within_limit(length: usize) -> Result<usize, SendError> {
    if length > PACKET_LEN_MAX {
        return Err(SendError::NoRoom);
    }
    Ok(length)
}
