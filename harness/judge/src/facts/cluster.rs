//! The cluster of people that a RAM announces, as something that can be drawn.

use crossguard_codec::Heard;
use crossguard_endpoint::ras::area::Area;
use crossguard_robot::sight::{Degrees, corners};
use crossguard_robot::site::{Place, Site};
use serde::Serialize;

/// A cluster of people that a robot announces.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct ClusterView {
    /// Its id; 0 if it says none.
    pub id: u8,
    /// How many people belong to it.
    pub cardinality: u8,
    /// The corners of what bounds it.
    pub corners: Vec<Degrees>,
}

impl ClusterView {
    /// Cluster of a RAM from a known place.
    pub(super) fn of(heard: &Heard) -> Option<Self> {
        let cluster = heard.cluster.as_ref()?;
        let shape = cluster.cluster_bounding_box_shape.as_ref()?;
        let position = &heard.state.as_ref()?.position;
        let site = Site {
            latitude: position.latitude?,
            longitude: position.longitude?,
            ..Site::default()
        };
        let area = Area::of_wire(shape, [0.0, 0.0]);
        let degrees = |[east, north]: [f64; 2]| site.coordinates(Place::new(east, north));
        Some(Self {
            id: cluster.cluster_id.map_or(0, |id| id.0),
            cardinality: cluster.cluster_cardinality_size.0,
            corners: corners(&area).into_iter().map(degrees).collect(),
        })
    }
}
