//! Messages of other stations than robots: the road users that they put on the map.

use std::iter;

use crossguard_codec::asn1::cdd211::ObjectClass211;
use crossguard_codec::asn1::cpm::ObjectClass;
use crossguard_codec::core::cdd::Shape;
use crossguard_codec::geonet::{EgoPosition, Indication, Signer};
use crossguard_codec::its::{CpmContainer, ItsMessage};
use crossguard_codec::{DecodeError, Identity, Kind, Received, RoadUser, Service};
use crossguard_protocol::StationId;

use super::extent::{extent_m, widened};
use super::map::MEASURED_MS;
use super::namesakes::NotAdmitted;
use super::neighbours::Neighbours;
use crate::cause::Cause;

/// Speed of a person whose speed a CPM does not say, in m/s: the largest.
const WALKS_MPS: f64 = 4.0;

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
        let users = road_users(message, ego.timestamp_its).into_iter();
        let unsure = are_either(message).into_iter().chain(iter::repeat(false));
        for (user, is_either) in users.zip(unsure) {
            let user = refused.map_or(user, |(_, signer)| apart(user, signer));
            self.map.observe_unsure(user, is_either, now_ms);
        }
        refused.map_or(Ok(received), |(why, _)| Err(why.into()))
    }
}

/// The road users of a VAM. Its cluster counts as far as it reaches. The head of one that is over is somebody, and one of which
/// nobody knows how many they are has somebody.
macro_rules! of_vam {
    ($variant:ident($vam:ident), $now_its:ident) => {{
        let mut vam = $vam.clone();
        let container = &mut vam.vam.vam_parameters.vru_cluster_information_container;
        container.take_if(|it| {
            let cluster = &it.vru_cluster_information;
            let is_nobody = cluster.cluster_cardinality_size.0 == 0;
            is_nobody && cluster.cluster_bounding_box_shape.is_none()
        });
        let by_m = container.as_mut().map_or(0.0, |it| {
            let cluster = &mut it.vru_cluster_information;
            let size = &mut cluster.cluster_cardinality_size.0;
            *size = (*size).max(1);
            let shape = cluster.cluster_bounding_box_shape.as_ref();
            extent_m(shape.and_then(|shape| Shape::try_from(shape).ok()).as_ref())
        });
        let users = ItsMessage::$variant(vam).road_users($now_its).into_iter();
        users.map(|user| widened(user, by_m)).collect()
    }};
}

/// The road users that a message tells of at `now_its`, a `TimestampIts`: people as far as they may have gone and their group reaches.
fn road_users(message: &ItsMessage, now_its: u64) -> Vec<RoadUser> {
    let users = || message.road_users(now_its);
    match message {
        ItsMessage::Vam(vam) => of_vam!(Vam(vam), now_its),
        ItsMessage::Vam211(vam) => of_vam!(Vam211(vam), now_its),
        ItsMessage::Cpm(cpm) => {
            // A message is made before it is heard: by so much its station's clock is ahead at least.
            let made_its = cpm.management_container.reference_time.0;
            let ahead_ms = made_its.saturating_sub(now_its);
            let measured = |user: RoadUser| RoadUser {
                measured_its: user.measured_its.saturating_sub(ahead_ms),
                ..user
            };
            let users = users().into_iter().map(measured);
            users.map(|user| as_old_as_it_is(user, now_its)).collect()
        }
        _ => users(),
    }
}

/// Whether each object in a container may be a person as well as a vehicle.
macro_rules! either {
    ($container:expr, $class:ident) => {
        $container.perceived_objects.0.iter().map(|object| {
            let classes = object.classification.iter().flat_map(|it| &it.0);
            let mut is = [None; 2];
            for class in classes {
                let kind = match class.object_class {
                    $class::vehicleSubClass(_) => &mut is[0],
                    $class::vruSubClass(_) | $class::groupSubClass(_) => &mut is[1],
                    _ => continue,
                };
                // A confidence of 101 is not known.
                *kind = (*kind).max(Some(class.confidence.0 % 101));
            }
            matches!(is, [Some(vehicle), Some(person)] if 2 * u16::from(vehicle) >= person.into())
        })
    };
}

/// Whether each object of a CPM may be a person as well as a vehicle. A vehicle may be a person, however improbable. One that is a
/// person more than twice as probably as a vehicle is no vehicle: each person who walks on the crossing would end go.
fn are_either(message: &ItsMessage) -> Vec<bool> {
    let ItsMessage::Cpm(cpm) = message else {
        return Vec::new();
    };
    let mut all = Vec::new();
    for container in &cpm.cpm_containers {
        match container {
            CpmContainer::PerceivedObjectContainer(it) => all.extend(either!(it, ObjectClass)),
            CpmContainer::PerceivedObjectContainer211(it) => {
                all.extend(either!(it, ObjectClass211));
            }
            _ => {}
        }
    }
    all
}

/// People of a CPM, who have gone on since they were measured.
fn as_old_as_it_is(user: RoadUser, now_its: u64) -> RoadUser {
    if user.kind != Kind::Vru {
        return user;
    }
    let age_ms = now_its.saturating_sub(user.measured_its).min(MEASURED_MS);
    let since_s = std::time::Duration::from_millis(age_ms).as_secs_f64();
    let walked_m = user.speed.unwrap_or(WALKS_MPS) * since_s;
    let is_group = user.cardinality != 1;
    let by_m = if is_group { extent_m(None) } else { 0.0 };
    widened(user, walked_m + by_m)
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
