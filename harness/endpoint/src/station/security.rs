//! Whether a robot signs and verifies, and under which pseudonyms.

use std::fmt;
use std::str::FromStr;

use crossguard_codec::geonet::{Demand, EgoPosition, Envelope, Secured};
use crossguard_codec::security::{
    HashedId8, Station, Ticket, Time64, Tolerances, TrustStore, Unsigned,
};
use crossguard_codec::{Identifiers, Service};
use crossguard_protocol::StationId;
use serde::{Deserialize, Serialize};

/// How much security there is.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Mode {
    /// None: packets are not signed, and signed ones are dropped.
    #[default]
    Off,
    /// Packets are signed. Those of others are taken without a signature as well, but not with a
    /// wrong one.
    Sign,
    /// Packets are signed, and nothing is taken in without a signature that can be relied on.
    Enforce,
}

impl Mode {
    const ALL: [Self; 3] = [Self::Off, Self::Sign, Self::Enforce];

    /// Its name in files and options.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Off => "off",
            Self::Sign => "sign",
            Self::Enforce => "enforce",
        }
    }
}

impl fmt::Display for Mode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
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

/// What a robot needs to sign and to verify.
#[derive(Clone, Debug, Default)]
pub struct Credentials {
    /// The certificates that it trusts.
    pub trust: TrustStore,
    /// Its pseudonyms.
    pub tickets: Vec<Ticket>,
}

/// The security of one robot; off by default.
#[derive(Clone, Debug, Default)]
pub struct Security {
    /// What stands around its packets.
    pub envelope: Envelope,
    /// After how long it changes its pseudonym, in milliseconds; `None` for never.
    pub pseudonym_period_ms: Option<u64>,
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
        })
    }

    /// The station id by which a robot goes that is `configured` to go by another one: that of its ticket, which the
    /// ticket names, or else the first four octets of its name. Without security, it is the configured one.
    #[must_use]
    pub fn station_id(&self, identifiers: &Identifiers, configured: StationId) -> StationId {
        match &self.envelope {
            Envelope::Secured(secured) => station_id(secured, identifiers),
            _ => configured,
        }
    }
}

fn station_id(secured: &Secured, identifiers: &Identifiers) -> StationId {
    secured.station_id(Service::Ram.its_aid(identifiers))
}

/// The number of the first geo-broadcast under a pseudonym.
const fn sequence_number(pseudonym: HashedId8) -> u16 {
    let [.., a, b] = pseudonym.0;
    u16::from_be_bytes([a, b])
}

/// When one robot changes its pseudonym.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Pseudonyms {
    period_ms: Option<u64>,
    /// When the pseudonym was taken.
    since_ms: u64,
}

impl Pseudonyms {
    /// The first pseudonym is taken at `now_ms`, and changed after `period_ms`.
    pub(crate) const fn new(period_ms: Option<u64>, now_ms: u64) -> Self {
        Self {
            period_ms,
            since_ms: now_ms,
        }
    }

    /// Takes another ticket if that is due at `now_ms`, or if the ticket is over within `lock_ms`, as long as
    /// a session may take. The station id and the first sequence number that go with it: the caller changes
    /// them at once, and calls this only while the identity is not locked.
    pub(crate) fn renew(
        &mut self,
        envelope: &mut Envelope,
        identifiers: &Identifiers,
        ego: &EgoPosition,
        (now_ms, lock_ms): (u64, u64),
    ) -> Option<(StationId, u16)> {
        let Envelope::Secured(secured) = envelope else {
            return None;
        };
        let age_ms = now_ms.saturating_sub(self.since_ms);
        let is_due = self.period_ms.is_some_and(|period_ms| age_ms >= period_ms);
        if is_due {
            self.since_ms = now_ms;
        }
        let pseudonym = secured.renew_pseudonym(ego, is_due, lock_ms)?;
        self.since_ms = now_ms;
        let station = station_id(secured, identifiers);
        Some((station, sequence_number(pseudonym)))
    }
}
