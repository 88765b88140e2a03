//! Who is around a robot, and who goes by which station id.

use crossguard_codec::Heard;
use crossguard_codec::Identifiers;
use crossguard_codec::geonet::{Address, EgoPosition, Indication, Signer};
use crossguard_codec::its::{ItsMessage, RoadUser};
use crossguard_codec::si::rebuild_timestamp;
use crossguard_protocol::StationId;

use super::listen::{Unobserved, service_of};
use super::map::LocalDynamicMap;
use super::namesakes::Namesakes;

/// The stations around one robot.
#[derive(Clone, Debug)]
pub(crate) struct Neighbours {
    identifiers: Identifiers,
    namesakes: Namesakes,
    map: LocalDynamicMap,
}

impl Neighbours {
    /// Nobody is known yet.
    pub(crate) fn new(identifiers: Identifiers) -> Self {
        Self {
            identifiers,
            namesakes: Namesakes::default(),
            map: LocalDynamicMap::default(),
        }
    }

    /// The robot with this station id, which follows from the ticket of `signer`, is heard at `now_ms`.
    pub(crate) fn bind(&mut self, from: StationId, signer: Signer, address: Address, now_ms: u64) {
        self.namesakes.bind(from, signer, address, now_ms);
    }

    /// Who is around.
    pub(crate) const fn map(&self) -> &LocalDynamicMap {
        &self.map
    }

    /// Forgets who was not heard of for too long.
    pub(crate) fn elapse(&mut self, now_ms: u64) {
        self.map.forget(now_ms);
    }

    /// Puts the sender of a RAM on the map, and the people that it announces.
    pub(crate) fn observe_robot(&mut self, heard: &Heard, ego: &EgoPosition, now_ms: u64) {
        let Some(state) = &heard.state else { return };
        let measured = rebuild_timestamp(ego.timestamp_its, heard.generation_delta_time);
        let station_type = self.identifiers.robot_station_type;
        let around = heard.cluster.as_ref();
        for user in RoadUser::of_robot(heard.from.0, station_type, state, around, measured) {
            self.map.observe(user, now_ms);
        }
    }

    /// Puts the road users of the message of another station than `me` on the map, and returns the message.
    ///
    /// # Errors
    /// Why the octets are not the message of this service, or of another station.
    pub(crate) fn observe(
        &mut self,
        me: StationId,
        indication: &Indication<'_>,
        ego: &EgoPosition,
        now_ms: u64,
    ) -> Result<ItsMessage, Unobserved> {
        let service = indication.service;
        let message = ItsMessage::decode(&self.identifiers, indication.message)?.message;
        let found = service_of(&message);
        if found != Some(service) {
            return Err(Unobserved::OtherService { service, found });
        }
        if message.header().station_id.0 == me.0 {
            return Err(Unobserved::OwnStation(me));
        }
        if let Some(signer) = indication.signer {
            let from = StationId(message.header().station_id.0);
            let as_whom = (signer, indication.source.address);
            self.namesakes.admit(from, as_whom, now_ms)?;
        }
        for user in message.road_users(ego.timestamp_its) {
            self.map.observe(user, now_ms);
        }
        Ok(message)
    }
}
