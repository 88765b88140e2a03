//! Road users that messages tell of, in SI units.

use std::fmt::{self, Display, Formatter};

use serde::{Deserialize, Serialize};

use crate::core::cdd::{CartesianCoordinate, Shape, VruClusterInformation};
use crate::distance::moved;
use crate::named;
use crate::state::{Position, RobotState, SignalsShown};

named! {
    /// Kinds of road users.
    #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
    #[serde(rename_all = "camelCase")]
    pub enum Kind {
        /// A robot that sends RAM.
        Robot = "robot",
        /// A vehicle.
        Vehicle = "vehicle",
        /// A vulnerable road user, or a group of them.
        Vru = "vulnerable road user",
        /// A road-side unit.
        RoadSideUnit = "road-side unit",
        /// Something else that somebody perceived.
        Object = "object",
    }
}

/// Which one it is.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Identity {
    /// A station, which says of itself where it is.
    Station(u32),
    /// An object that a station perceives, or a cluster that it heads.
    Object {
        /// The station.
        by: u32,
        /// Its number for the object, or the cluster's id.
        number: u16,
    },
    /// An object that a station perceives, and that no number tells from its others.
    Unnumbered {
        /// The station.
        by: u32,
        /// Its place among the objects of one report.
        place: u16,
    },
}

impl Display for Identity {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Station(id) => write!(f, "station {id}"),
            Self::Object { by, number } => write!(f, "object {number} of station {by}"),
            Self::Unnumbered { by, .. } => write!(f, "object of station {by}"),
        }
    }
}

/// A road user.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct RoadUser {
    /// Which one it is: a station by its id, or an object that a station perceives.
    pub identity: Identity,
    /// Its kind.
    pub kind: Kind,
    /// `TrafficParticipantType` of the common data dictionary, if it is told.
    pub station_type: Option<u8>,
    /// Where it is.
    pub position: Position,
    /// Speed over ground in m/s.
    pub speed: Option<f64>,
    /// Direction of motion in degrees clockwise from north. That of a vehicle is known while it says that it drives forward.
    pub heading: Option<f64>,
    /// How long it is at least, in metres, if a CAM or a CPM tells.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub length: Option<f64>,
    /// How many it stands for: more than one, or 0 for an unknown number, of a VRU cluster's leader.
    pub cardinality: u8,
    /// The signals that it shows to people, if a RAM tells.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub signals: Option<SignalsShown>,
    /// When that was so, as `TimestampIts`.
    pub measured_its: u64,
}

impl RoadUser {
    /// Road users that a RAM tells of: the robot that sent it, which is in this state, and the people around it
    /// that it announces, at the middle of their bounding shape.
    pub fn of_robot(
        station: u32,
        station_type: u8,
        state: &RobotState,
        around: Option<&VruClusterInformation>,
        measured_its: u64,
    ) -> impl Iterator<Item = Self> {
        let robot = Self {
            identity: Identity::Station(station),
            kind: Kind::Robot,
            station_type: Some(station_type),
            position: state.position,
            speed: state.speed.map(|speed| speed.value),
            heading: state.heading.map(|heading| heading.value),
            length: None,
            cardinality: 1,
            signals: state.slow.as_ref().and_then(|slow| slow.signals),
            measured_its,
        };
        let cluster = around.and_then(|cluster| cluster_around(station, cluster, &robot));
        std::iter::once(robot).chain(cluster)
    }
}

fn cluster_around(
    station: u32,
    cluster: &VruClusterInformation,
    robot: &RoadUser,
) -> Option<RoadUser> {
    let [east, north] = middle_of(cluster.cluster_bounding_box_shape?).unwrap_or_default();
    Some(RoadUser {
        identity: identity_of(station, cluster.cluster_id.map(|id| id.0)),
        kind: Kind::Vru,
        station_type: None,
        position: moved(&robot.position, east, north),
        speed: None,
        heading: None,
        cardinality: cluster.cluster_cardinality_size.0,
        signals: None,
        ..*robot
    })
}

/// How many metres east and north of its sender the middle of a shape is, if that has one of its own.
pub(crate) fn middle_of(shape: Shape) -> Option<[f64; 2]> {
    let middle = match shape {
        Shape::Circular(circle) => circle.shape_reference_point,
        Shape::Rectangular(rectangle) => rectangle.shape_reference_point,
        Shape::Polygonal(polygon) => polygon.shape_reference_point,
    };
    let metres = |coordinate: CartesianCoordinate| f64::from(coordinate.0) / 100.0;
    middle.map(|middle| [middle.x_coordinate, middle.y_coordinate].map(metres))
}

/// A cluster is not its head, and a head may have several: the id tells them apart.
pub(crate) const fn identity_of(station: u32, cluster: Option<u8>) -> Identity {
    match cluster {
        Some(id) => Identity::Object {
            by: station,
            number: id as u16,
        },
        None => Identity::Station(station),
    }
}
