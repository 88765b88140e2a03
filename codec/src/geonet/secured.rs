//! Packets that are signed and verified.

use std::collections::BTreeSet;

use super::{
    Admitted, Discarded, EgoPosition, EnvelopeError, LongPositionVector, Opened, Permits, Signer,
};
use crate::part::{Part, SSP_VERSION};
use crate::security::{
    Certificate, HashedId8, Origin, Place, Rejected, SignedMessage, Ssp, Station, Time64, Unsigned,
    Verified,
};
use crate::service::Service;
use crossguard_protocol::StationId;

/// Demands on the packets of others.
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

    /// Trusts none of these certificates from now on, instead of the ones that were revoked before.
    pub fn set_revoked(&mut self, revoked: BTreeSet<HashedId8>) {
        self.station.set_revoked(revoked);
    }

    /// The station id that goes with the ticket in use, in messages under this ITS-AID.
    #[must_use]
    pub fn station_id(&self, its_aid: u32) -> StationId {
        let certificate = self.station.ticket().certificate();
        station_of(certificate, its_aid).unwrap_or_else(|| Signer(certificate.holder().0).station())
    }

    /// Takes up the time from before a restart, in microseconds since 2004.
    pub fn remember_time(&mut self, known: Time64) {
        self.station.remember_time(known);
    }

    /// Looks at the clock, when one that never leaps shows `steady_ms`.
    pub fn look_at_clock(&mut self, ego: &EgoPosition, steady_ms: u64) {
        self.station.look_at_clock(now(ego), steady_ms);
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

    /// Opens an envelope. `admit` looks at the headers in it and the ITS-AID under which they were sent, and says what
    /// they are before the signature is: whatever it refuses costs no signature.
    pub(super) fn open<'a>(
        &mut self,
        ego: &EgoPosition,
        secured: &'a [u8],
        admit: impl FnOnce(&'a [u8], u32) -> Result<Admitted<'a>, Discarded>,
    ) -> Result<(Admitted<'a>, Opened), Discarded> {
        let message = SignedMessage::decode(secured).map_err(EnvelopeError::from)?;
        let admitted = admit(message.payload, message.header.its_aid)?;
        let verified = self.verify(ego, &admitted, &message);
        let verified = verified.map_err(|rejected| match rejected {
            Rejected::OwnTicket => Discarded::OwnPacket,
            rejected => EnvelopeError::from(rejected).into(),
        })?;
        let opened = Opened {
            signer: Signer(verified.holder.0),
            permits: permits(&verified.ssp),
        };
        Ok((admitted, opened))
    }

    fn verify(
        &mut self,
        ego: &EgoPosition,
        admitted: &Admitted<'_>,
        message: &SignedMessage<'_>,
    ) -> Result<Verified, Rejected> {
        if matches!(admitted.service, Service::Ram | Service::Rmcm) {
            message.header.check_robot_profile()?;
        }
        let origin = origin(&admitted.headers.source);
        let here = ego.coordinates.map(|(latitude, longitude)| Place {
            latitude,
            longitude,
        });
        self.station
            .verifier()
            .check_origin(here, &origin, message)?;
        self.station.verify(now(ego), origin.place, message)
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
    Some(permits(&permission.ssp).station(Signer(ticket.holder().0)))
}

/// Where and when a packet says that it was sent. A station that does not know where it is says 0, 0, and that this is
/// not accurate.
#[must_use]
pub fn origin(source: &LongPositionVector) -> Origin {
    let place = Place {
        latitude: source.latitude,
        longitude: source.longitude,
    };
    let is_unknown = (place.latitude, place.longitude, source.is_accurate) == (0, 0, false);
    Origin {
        place: (!is_unknown).then_some(place),
        timestamp: source.timestamp,
    }
}

/// The permissions in service specific permissions of the kit.
fn permits(ssp: &Ssp) -> Permits {
    let named = match ssp {
        Ssp::Bitmap(octets) => Part::named_in(octets),
        Ssp::Default | Ssp::Opaque(_) => None,
    };
    Permits::new(ssp.bits(SSP_VERSION), named)
}

const fn now(ego: &EgoPosition) -> Time64 {
    Time64::of_timestamp_its(ego.timestamp_its)
}
