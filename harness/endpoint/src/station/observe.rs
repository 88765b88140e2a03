//! Messages of other stations than robots: the road users that they put on the map.

use crossguard_codec::geonet::{EgoPosition, Indication, Signer};
use crossguard_codec::its::ItsMessage;
use crossguard_codec::{DecodeError, Identity, Received, RoadUser, Service};
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
    /// Its certificate may not go by its station id; its road users count, apart from those of others.
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
    /// Why the octets are not the message of this service, or of another station, or not of one that may go by this id.
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
        let refused = indication.signer.and_then(|signer| {
            let from = StationId(message.header().station_id.0);
            let as_whom = (signer, indication.source.address);
            let admitted = self.namesakes.admit(from, as_whom, now_ms);
            admitted.err().map(|why| (why, signer))
        });
        for user in message.road_users(ego.timestamp_its) {
            let user = refused.map_or(user, |(_, signer)| apart(user, signer));
            self.map.observe(user, now_ms);
        }
        refused.map_or(Ok(received), |(why, _)| Err(why.into()))
    }
}

/// A road user whose station may not go by its id, by the ticket that tells of them. They are on the road all the same, take the
/// place of nobody, and one ticket is one of them, whatever ids it goes by.
fn apart(user: RoadUser, signer: Signer) -> RoadUser {
    let digest = u64::from_be_bytes(signer.0);
    let number = u16::try_from(digest % (1 << 16)).unwrap_or_default();
    let by = u32::try_from(digest >> 32).unwrap_or_default();
    let identity = match user.identity {
        Identity::Station(_) => Identity::Object { by, number },
        Identity::Object { number, .. } => Identity::Object { by, number },
        Identity::Unnumbered { place, .. } => Identity::Unnumbered { by, place },
    };
    RoadUser { identity, ..user }
}
