//! Road users around a robot, and owners of station ids.

use crossguard_codec::core::cdd::VruClusterInformation;
use crossguard_codec::geonet::EgoPosition;
use crossguard_codec::si::rebuild_timestamp;
use crossguard_codec::{Heard, Identifiers, Kind, RoadUser};

use super::extent::{UNSAID, extent_m, widened};
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

    /// Puts the sender of a RAM on the map, and the people that it announces, as far as they reach.
    pub(crate) fn observe_robot(&mut self, heard: &Heard, ego: &EgoPosition, now_ms: u64) {
        let Some(state) = &heard.state else { return };
        let measured = rebuild_timestamp(ego.timestamp_its, heard.generation_delta_time);
        let station_type = self.identifiers.robot_station_type;
        let around = heard.cluster.map(|cluster| {
            let is_over = cluster.cluster_cardinality_size.0 == 0;
            let shape = cluster.cluster_bounding_box_shape;
            VruClusterInformation {
                cluster_bounding_box_shape: shape.or((!is_over).then_some(UNSAID)),
                ..cluster
            }
        });
        let around = around.as_ref();
        let shape = around.and_then(|cluster| cluster.cluster_bounding_box_shape.as_ref());
        for user in RoadUser::of_robot(heard.from.0, station_type, state, around, measured) {
            let user = match user.kind {
                Kind::Vru => widened(user, extent_m(shape)),
                _ => user,
            };
            self.map.observe(user, now_ms);
        }
    }
}
