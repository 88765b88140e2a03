//! Packets that are signed and verified.

use super::{EgoPosition, LongPositionVector, Opened, Permits, Signer};
use crate::part::{Part, SSP_VERSION};
use crate::security::{
    Certificate, HashedId8, Place, Rejected, SignedMessage, Ssp, Station, Time64, Unsigned,
};
use crossguard_protocol::StationId;

/// What is demanded of the packets of others.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Demand {
    /// Nothing: packets without an envelope are taken as well. One with a wrong envelope is not.
    Nothing,
    /// A signature: nothing is taken without one that can be relied on.
    Signature,
}

/// A station that signs its packets and verifies those of others.
#[derive(Clone, Debug)]
pub struct Secured {
    station: Station,
    demand: Demand,
}

impl Secured {
    /// A station that demands this of others.
    #[must_use]
    pub const fn new(station: Station, demand: Demand) -> Self {
        Self { station, demand }
    }

    /// Its pseudonyms, and what it knows of others.
    #[must_use]
    pub const fn station(&self) -> &Station {
        &self.station
    }

    /// The station id that goes with the ticket in use, in messages under this ITS-AID.
    #[must_use]
    pub fn station_id(&self, its_aid: u32) -> StationId {
        let certificate = self.station.ticket().certificate();
        station_of(certificate, its_aid).unwrap_or_else(|| Signer(certificate.id().0).station())
    }

    /// Changes the pseudonym if that `is_due`, or if its ticket is over within this many milliseconds, to
    /// one that is valid for longer; its name, if there is one. The address and the station id must
    /// change with it, and all of that only while the identity is not locked.
    pub fn renew_pseudonym(
        &mut self,
        ego: &EgoPosition,
        is_due: bool,
        within_ms: u64,
    ) -> Option<HashedId8> {
        let now = now(ego);
        let until = Time64(now.0.saturating_add(within_ms.saturating_mul(1_000)));
        // One that is over in the middle of a session is better than none.
        let until = [until, now]
            .into_iter()
            .find(|until| is_due || self.station.should_change(now, *until))?;
        let changed = self.station.change_pseudonym(now, until);
        changed.ok()
    }

    pub(super) fn seal(
        &mut self,
        ego: &EgoPosition,
        its_aid: u32,
        plain: &[u8],
    ) -> Result<Vec<u8>, Unsigned> {
        self.station.seal(now(ego), its_aid, plain)
    }

    /// `source` tells where the sender of a packet is, from its headers, which are signed.
    pub(super) fn open<'a>(
        &mut self,
        ego: &EgoPosition,
        secured: &'a [u8],
        source: impl FnOnce(&[u8]) -> Option<LongPositionVector>,
    ) -> Result<Opened<'a>, Rejected> {
        let message = SignedMessage::decode(secured)?;
        let place = source(message.payload).map(|source| Place {
            latitude: source.latitude,
            longitude: source.longitude,
        });
        let verified = self.station.verify(now(ego), place, &message)?;
        Ok(Opened {
            plain: message.payload,
            its_aid: message.header.its_aid,
            signer: Signer(verified.signer.0),
            permits: permits(&verified.ssp),
        })
    }

    pub(super) const fn admit_plain(&self) -> Result<(), Rejected> {
        match self.demand {
            Demand::Nothing => Ok(()),
            Demand::Signature => Err(Rejected::Unsecured),
        }
    }
}

/// The station id that the holder of a ticket goes by in messages under this ITS-AID, if it may send them: the one that
/// its permissions name, or else the first four octets of its name.
#[must_use]
pub fn station_of(ticket: &Certificate, its_aid: u32) -> Option<StationId> {
    let permissions = &ticket.content().permissions;
    let permission = permissions.iter().find(|it| it.its_aid == its_aid)?;
    Some(permits(&permission.ssp).station(Signer(ticket.id().0)))
}

/// What service specific permissions of the kit say.
fn permits(ssp: &Ssp) -> Permits {
    let named = match ssp {
        Ssp::Bitmap(octets) => Part::named_in(octets),
        Ssp::Default | Ssp::Opaque(_) => None,
    };
    Permits::of_bits(ssp.bits(SSP_VERSION)).only_as(named)
}

const fn now(ego: &EgoPosition) -> Time64 {
    Time64::of_timestamp_its(ego.timestamp_its)
}
