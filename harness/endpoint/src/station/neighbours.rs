//! Road users around a robot, and owners of station ids.

use crossguard_codec::geonet::EgoPosition;
use crossguard_codec::si::rebuild_timestamp;
use crossguard_codec::{Heard, Identifiers, RoadUser};

use super::map::LocalDynamicMap;
use super::namesakes::Namesakes;

#[derive(Clone, Debug)]
pub(crate) struct Neighbours {
    pub(super) identifiers: Identifiers,
    pub(crate) namesakes: Namesakes,
    pub(crate) map: LocalDynamicMap,
}

impl Neighbours {
    pub(crate) fn new(identifiers: Identifiers) -> Self {
        Self {
            identifiers,
            namesakes: Namesakes::default(),
            map: LocalDynamicMap::default(),
        }
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
