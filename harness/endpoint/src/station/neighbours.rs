//! Road users around a robot, and owners of station ids.

use crossguard_codec::geonet::{Address, EgoPosition, Signer};
use crossguard_codec::si::rebuild_timestamp;
use crossguard_codec::{Heard, Identifiers, RoadUser};
use crossguard_protocol::StationId;

use super::map::LocalDynamicMap;
use super::namesakes::Namesakes;

#[derive(Clone, Debug)]
pub(crate) struct Neighbours {
    pub(super) identifiers: Identifiers,
    pub(super) namesakes: Namesakes,
    pub(super) map: LocalDynamicMap,
}

impl Neighbours {
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

    pub(crate) const fn map(&self) -> &LocalDynamicMap {
        &self.map
    }

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
}
