//! Whether a robot signs and verifies, and under which pseudonyms.

use crossguard_codec::geonet::{Demand, Envelope, Secured};
use crossguard_codec::security::{
    HashedId8, Station, Ticket, Time64, Tolerances, TrustStore, Unsigned,
};
use crossguard_protocol::StationId;
use serde::{Deserialize, Serialize};

/// How much security there is.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize, clap::ValueEnum)]
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

/// What a robot needs to sign and to verify.
#[derive(Clone, Debug, Default)]
pub struct Credentials {
    /// Whom it trusts.
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
}

/// The station id that goes with a pseudonym: as random as its name, and gone with it.
#[must_use]
pub fn station_id(pseudonym: HashedId8) -> StationId {
    let [a, b, c, d, ..] = pseudonym.0;
    StationId(u32::from_be_bytes([a, b, c, d]))
}

/// The number of the first geo-broadcast under a pseudonym.
pub(super) const fn sequence_number(pseudonym: HashedId8) -> u16 {
    let [.., a, b] = pseudonym.0;
    u16::from_be_bytes([a, b])
}
