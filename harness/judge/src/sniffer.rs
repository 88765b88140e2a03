//! Packets on the channel, for people who listen in: each one as a line or a JSON object.
//!
//! Whether a packet is signed is said; signatures are verified where roots are given.

use crossguard_codec::geonet::{BasicHeader, LongPositionVector};
use crossguard_codec::geonet::{Headers, NextHeader, Transport};
use crossguard_codec::its::ItsMessage;
use crossguard_codec::security::Time64;
use crossguard_codec::{Identifiers, Identity, RoadUser, Service};
use crossguard_endpoint::cause::Cause;
use crossguard_endpoint::counters::Counters;
use crossguard_endpoint::station::listen::{overhear, peek};
use crossguard_endpoint::station::{Unobserved, service_of};
use serde::Serialize;

use crate::chart::text_of;
use crate::signature::{Signature, Signatures};

/// A packet that was seen.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Seen {
    /// Seconds since the first packet.
    pub at_s: f64,
    /// The name of its message, also of messages that are not decoded (DENM, MAPEM, SPATEM and the like), or `?`.
    pub kind: &'static str,
    /// The station that sent the message.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub station: Option<u32>,
    /// How many octets the packet has.
    pub octets: usize,
    /// Whether it has a security envelope.
    pub is_signed: bool,
    /// Its signer, and whether the signature was verified.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub signature: Option<Signature>,
    /// Content of the message, or why there is none.
    pub text: String,
    /// Road users, as the message tells.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub road_users: Vec<RoadUser>,
    /// The whole message under its kind, with the names and numbers of its ASN.1 module, where it is decoded.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub message: Option<ItsMessage>,
}

/// Reads one packet after the other.
#[derive(Clone, Debug, Default)]
pub struct Sniffer {
    identifiers: Identifiers,
    counters: Counters,
    signatures: Signatures,
    began_ms: Option<u64>,
    newest_its: u64,
}

/// By how much packets of a capture may be out of order, in milliseconds: their times are those of several threads.
const DISORDER_MS: u64 = 100;

impl Sniffer {
    /// A sniffer for a channel with these identifiers.
    #[must_use]
    pub fn new(identifiers: Identifiers) -> Self {
        Self {
            identifiers,
            ..Self::default()
        }
    }

    /// The same, and it looks at signatures by these.
    #[must_use]
    pub fn with_signatures(mut self, signatures: Signatures) -> Self {
        self.signatures = signatures;
        self
    }

    /// How often each kind of message was seen, and what could not be read.
    #[must_use]
    pub const fn counters(&self) -> &Counters {
        &self.counters
    }

    /// Takes in a packet that was on the link at `now_ms` by any clock, which is `now_its` as
    /// `TimestampIts`.
    pub fn see(&mut self, packet: &[u8], now_ms: u64, now_its: u64) -> Seen {
        let began_ms = *self.began_ms.get_or_insert(now_ms);
        #[expect(clippy::cast_precision_loss, reason = "centuries of milliseconds fit")]
        let at_s = now_ms.saturating_sub(began_ms) as f64 / 1e3;
        // No signature is trusted by a clock that goes back.
        let is_late = (1..=DISORDER_MS).contains(&self.newest_its.saturating_sub(now_its));
        let now_its = if is_late { self.newest_its } else { now_its };
        self.newest_its = now_its;
        let is_signed =
            BasicHeader::decode(packet).is_ok_and(|(basic, _)| basic.next == NextHeader::Secured);
        let mut seen = Seen {
            at_s,
            kind: "?",
            station: None,
            octets: packet.len(),
            is_signed,
            signature: self.signatures.of(
                &self.identifiers,
                packet,
                Some(Time64::of_timestamp_its(now_its)),
            ),
            text: String::new(),
            road_users: Vec::new(),
            message: None,
        };
        if let Err((cause, text)) = self.read(packet, now_its, &mut seen) {
            self.counters.count(cause);
            seen.text = text;
        }
        seen
    }

    fn read(
        &mut self,
        packet: &[u8],
        now_its: u64,
        seen: &mut Seen,
    ) -> Result<(), (Cause, String)> {
        let (headers, octets) =
            peek(packet).map_err(|why| (Cause::Discarded(why.cause()), why.to_string()))?;
        if let Some(name) = Service::foreign_at_port(headers.port) {
            seen.kind = name;
            // All begin with the same header.
            let station = octets.get(2..).and_then(<[u8]>::first_chunk);
            seen.station = station.map(|it| u32::from_be_bytes(*it));
            seen.text = place_of_packet(&headers.source);
            return Ok(());
        }
        if let Some(service) = Service::at_port(&self.identifiers, headers.port) {
            seen.kind = service.name();
        }
        let message = ItsMessage::decode(&self.identifiers, octets);
        let message = message.map_err(|error| (Cause::from(&error), error.to_string()))?;
        if !message.is_canonical {
            self.counters.count(Cause::NotCanonical);
        }
        let is_partly_read = message.extended > 0;
        let message = message.message;
        if let Some(service) = service_of(&message) {
            seen.kind = service.name();
            if service.port(&self.identifiers) != headers.port {
                let found = Some(service);
                let wrong = Unobserved::OtherService { service, found };
                return Err((Cause::from(&wrong), format!("at port {}", headers.port)));
            }
        }
        seen.station = Some(message.header().station_id.0);
        seen.road_users = message.road_users(now_its);
        seen.text = self.describe(&message, octets, &headers, &seen.road_users);
        if is_partly_read {
            seen.text.push_str(", and parts that are not read");
        }
        seen.message = Some(message);
        Ok(())
    }

    /// Content of a message, in a few words.
    fn describe(
        &self,
        message: &ItsMessage,
        octets: &[u8],
        headers: &Headers,
        users: &[RoadUser],
    ) -> String {
        let mut parts = Vec::new();
        match message {
            ItsMessage::Ram(_) | ItsMessage::Rmcm(_) => {
                parts.push(match overhear(&self.identifiers, octets) {
                    Ok(heard) => {
                        // Its kind stands in front already.
                        let texts = text_of(&heard);
                        let bare = texts.split_once(' ').map(|(_, text)| text.to_owned());
                        bare.unwrap_or(texts)
                    }
                    Err(unheard) => unheard.to_string(),
                });
                parts.extend(users.first().map(place));
                // The people around a robot.
                parts.extend(users.iter().skip(1).map(cluster));
            }
            ItsMessage::Cpm(_) => {
                parts.push(format!("{} objects", users.len()));
                parts.push(place_of_packet(&headers.source));
            }
            _ => parts.extend(users.first().map(|user| match user.identity {
                Identity::Station(_) if user.cardinality == 1 => {
                    format!("{}, {}", user.kind, place(user))
                }
                _ => cluster(user),
            })),
        }
        if let Transport::GeoBroadcast { .. } = headers.transport {
            parts.push("geo-broadcast".to_owned());
        }
        parts.join(", ")
    }
}

fn cluster(user: &RoadUser) -> String {
    let id = match user.identity {
        Identity::Object { number, .. } => format!("cluster {number}"),
        _ => "cluster".to_owned(),
    };
    format!("{id} of {} at {}", user.cardinality, place(user))
}

/// Where somebody is, and how fast.
#[must_use]
pub fn place(user: &RoadUser) -> String {
    let position = match (user.position.latitude, user.position.longitude) {
        (Some(latitude), Some(longitude)) => format!("{latitude:.6} {longitude:.6}"),
        _ => "somewhere".to_owned(),
    };
    match (user.speed, user.heading) {
        (Some(speed), Some(heading)) => format!("{position}, {speed:.2} m/s to {heading:.0}°"),
        (Some(speed), None) => format!("{position}, {speed:.2} m/s"),
        (None, _) => position,
    }
}

fn place_of_packet(source: &LongPositionVector) -> String {
    let degrees = |number: i32| f64::from(number) / 1e7;
    format!(
        "{:.6} {:.6}",
        degrees(source.latitude),
        degrees(source.longitude)
    )
}

impl std::fmt::Display for Seen {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let station = self
            .station
            .map_or_else(|| "-".to_owned(), |id| id.to_string());
        let signed = match &self.signature {
            Some(signature) if signature.is_verified => " verified",
            _ if self.is_signed => " signed",
            _ => "",
        };
        write!(
            f,
            "{:>9.3}  {:<4} {station:>10} {:>5} B{signed}  {}",
            self.at_s, self.kind, self.octets, self.text
        )?;
        let why_not = self.signature.as_ref().and_then(|it| it.why_not.as_ref());
        why_not.map_or(Ok(()), |why| write!(f, "; not verified: {why}"))
    }
}
