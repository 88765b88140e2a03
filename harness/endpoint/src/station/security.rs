//! Whether a robot signs and verifies, and under which pseudonyms.

use std::str::FromStr;

use crossguard_codec::geonet::{Demand, Envelope, Secured};
use crossguard_codec::security::{
    Station, Ticket, Time64, Tolerances, TrustStore, Unsigned, keyed_digest, random_octets,
};
use crossguard_codec::{Identifiers, Service, named};
use crossguard_protocol::StationId;
use serde::{Deserialize, Serialize};

use super::pseudonyms::Secret;

named! {
    /// How much security there is.
    #[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
    #[serde(rename_all = "lowercase")]
    pub enum Mode {
        /// None: packets are not signed, and signed ones are dropped.
        #[default]
        Off = "off",
        /// Packets are signed. Packets of others are taken without a signature as well, but not with a
        /// wrong one.
        Sign = "sign",
        /// Packets are signed, and nothing is taken in without a signature that can be relied on.
        Enforce = "enforce",
    }
}

/// A name that is none of a [`Mode`].
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("no mode of security is called '{0}': it is off, sign or enforce")]
pub struct NoSuchMode(String);

impl FromStr for Mode {
    type Err = NoSuchMode;

    fn from_str(name: &str) -> Result<Self, NoSuchMode> {
        let mut modes = Self::ALL.into_iter();
        let mode = modes.find(|mode| mode.name() == name);
        mode.ok_or_else(|| NoSuchMode(name.to_owned()))
    }
}

/// Certificates that a robot needs to sign and to verify.
#[derive(Clone, Debug, Default)]
pub struct Credentials {
    /// The certificates that it trusts.
    pub trust: TrustStore,
    /// Its pseudonyms.
    pub tickets: Vec<Ticket>,
}

impl Credentials {
    /// The same, with the pseudonyms in an order that nobody can guess: a robot that starts again and again does not
    /// begin with the same one.
    #[must_use]
    pub fn shuffled(mut self) -> Self {
        let key = random_octets();
        let place = |ticket: &Ticket| keyed_digest(&key, &ticket.certificate().id().0);
        self.tickets.sort_by_cached_key(place);
        self
    }
}

/// The security of one robot; off by default.
#[derive(Clone, Debug, Default)]
pub struct Security {
    /// Envelope of its packets.
    pub envelope: Envelope,
    /// After how long it changes its pseudonym, in milliseconds; `None` for never.
    pub pseudonym_period_ms: Option<u64>,
    /// Secret for its pseudonyms; not used without security.
    pub secret: Secret,
}

impl Security {
    /// Security in this mode at `now`.
    ///
    /// # Errors
    /// When no pseudonym is valid.
    pub fn new(
        mode: Mode,
        credentials: Credentials,
        pseudonym_period_ms: Option<u64>,
        now: Time64,
    ) -> Result<Self, Unsigned> {
        let demand = match mode {
            Mode::Off => return Ok(Self::default()),
            Mode::Sign => Demand::Nothing,
            Mode::Enforce => Demand::Signature,
        };
        let Credentials { trust, tickets } = credentials;
        let station = Station::new(trust, tickets, Tolerances::default(), now)?;
        Ok(Self {
            envelope: Envelope::Secured(Box::new(Secured::new(station, demand))),
            pseudonym_period_ms,
            secret: Secret::random(),
        })
    }

    /// Whether its packets are signed.
    #[must_use]
    pub const fn signs(&self) -> bool {
        matches!(self.envelope, Envelope::Secured(_))
    }

    /// The same with the secret that the robot keeps, instead of one for this start.
    #[must_use]
    pub fn with_secret(self, secret: Secret) -> Self {
        Self { secret, ..self }
    }

    /// The same with the time from before a restart: the newest that was known to have been. Until the clock is there,
    /// nothing signed is accepted, and nothing from before it is accepted ever.
    #[must_use]
    pub fn since(mut self, known: Time64) -> Self {
        if let Envelope::Secured(secured) = &mut self.envelope {
            secured.remember_time(known);
        }
        self
    }

    /// Epoch in the session and offer numbers of a robot with this station id: the boot counter itself without
    /// security, and otherwise a number that does not reveal it.
    #[must_use]
    pub fn epoch(&self, station: StationId, boot: u16) -> u16 {
        match &self.envelope {
            Envelope::Secured(_) => self.secret.epoch(station, boot),
            _ => boot,
        }
    }

    /// The station id by which a robot goes that is `configured` to go by another one: that of its ticket, which the
    /// ticket names, or else the first four octets of its name. Without security, it is the configured one.
    #[must_use]
    pub fn station_id(&self, identifiers: &Identifiers, configured: StationId) -> StationId {
        match &self.envelope {
            Envelope::Secured(secured) => secured.station_id(Service::Ram.its_aid(identifiers)),
            _ => configured,
        }
    }
}
