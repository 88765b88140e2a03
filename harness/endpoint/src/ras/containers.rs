//! Clusters in a RAM: written as `VruClusterInformationContainer` and `VruMotionPredictionContainer`,
//! and read as what a road user's device makes of them.

use crossguard_codec::core::cdd::{
    AltitudeConfidence, CardinalNumber1B, DeltaAltitude, DeltaLatitude, DeltaLongitude,
    DeltaTimeTenthOfSecond, Identifier1B, PathDeltaTimeChoice, PathPointPredicted, PathPredicted,
    VruClusterInformation, VruClusterProfiles,
};
use crossguard_codec::core::ram::RAM;
use crossguard_codec::core::vam::{VruClusterInformationContainer, VruMotionPredictionContainer};
use crossguard_codec::{Position, position_of, si};

use super::area::Area;
use super::clustering::{Cluster, Ended};
use super::motion::{Plane, Point};

/// How far ahead a cluster's motion is predicted, in tenths of a second.
const PREDICTED_TENTHS: [u8; 3] = [10, 20, 30];
/// A slower cluster stands, and has no prediction, in m/s.
const UNMOVED_MPS: f64 = 0.2;

/// Writes `cluster` into a RAM, or none.
pub fn write(ram: &mut RAM, plane: &Plane, cluster: Option<&Cluster>) {
    let parameters = &mut ram.ram.ram_parameters;
    let reference = plane.point(&position_of(&parameters.basic_container));
    let cluster = reference.zip(cluster);
    parameters.vru_cluster_information_container =
        cluster.map(|(reference, cluster)| information(cluster, reference));
    parameters.vru_motion_prediction_container =
        cluster.and_then(|(reference, cluster)| prediction(cluster, plane, reference));
}

/// Writes into a RAM that a cluster is over: it has its id, nobody in it and no shape.
pub fn write_ended(ram: &mut RAM, ended: Ended) {
    let parameters = &mut ram.ram.ram_parameters;
    parameters.vru_cluster_information_container = Some(VruClusterInformationContainer {
        vru_cluster_information: VruClusterInformation {
            cluster_id: Some(Identifier1B(ended.id)),
            cluster_bounding_box_shape: None,
            cluster_cardinality_size: CardinalNumber1B(0),
            cluster_profiles: None,
        },
    });
    parameters.vru_motion_prediction_container = None;
}

/// The id of the cluster that this says is over, if it says that.
#[must_use]
pub fn ended(information: &VruClusterInformation) -> Option<u8> {
    let id = information.cluster_id?.0;
    (information.cluster_cardinality_size.0 == 0).then_some(id)
}

/// The velocity of the cluster of a RAM, in m/s to the east and to the north: that between the first and the last
/// point of its predicted path. One without a path stands; `None` for a path that does not tell.
#[must_use]
pub fn velocity_mps(ram: &RAM) -> Option<[f64; 2]> {
    let parameters = &ram.ram.ram_parameters;
    let prediction = parameters.vru_motion_prediction_container.as_ref();
    let Some(path) = prediction.and_then(|it| it.path_prediction.as_ref()) else {
        return Some([0.0, 0.0]);
    };
    let plane = Plane::around(&position_of(&parameters.basic_container))?;
    let (first, last) = (path.first()?, path.last()?);
    let ([from, to], [began, ends]) = (
        [place_of(first, &plane)?, place_of(last, &plane)?],
        [seconds_of(first)?, seconds_of(last)?],
    );
    (ends > began).then(|| [0, 1].map(|axis| (to[axis] - from[axis]) / (ends - began)))
}

/// Where a predicted point is, on the plane around the reference position.
fn place_of(point: &PathPointPredicted, plane: &Plane) -> Option<Point> {
    let delta = |steps: i32| f64::from(steps) * 1e-7;
    let origin = plane.position([0.0, 0.0]);
    plane.point(&Position::at(
        origin.latitude? + delta(point.delta_latitude.get()),
        origin.longitude? + delta(point.delta_longitude.get()),
    ))
}

/// When a predicted point is reached, in seconds from now.
fn seconds_of(point: &PathPointPredicted) -> Option<f64> {
    match point.path_delta_time {
        Some(PathDeltaTimeChoice::DeltaTimeHighPrecision(tenths)) => {
            Some(f64::from(tenths.get()) / 10.0)
        }
        _ => None,
    }
}

/// The container of a cluster in a message whose reference position is at `reference`.
#[must_use]
pub fn information(cluster: &Cluster, reference: Point) -> VruClusterInformationContainer {
    VruClusterInformationContainer {
        vru_cluster_information: VruClusterInformation {
            cluster_id: Some(Identifier1B(cluster.id)),
            cluster_bounding_box_shape: Some(cluster.area.to_wire(reference)),
            cluster_cardinality_size: CardinalNumber1B(cluster.cardinality),
            // Without any it is not known which.
            cluster_profiles: (cluster.profiles != 0)
                .then(|| VruClusterProfiles::new(cluster.profiles)),
        },
    }
}

/// Where the middle of a cluster will be, if it goes on as it does. Points are relative to the
/// reference position, as the bounding shape is.
fn prediction(
    cluster: &Cluster,
    plane: &Plane,
    reference: Point,
) -> Option<VruMotionPredictionContainer> {
    let [east, north] = cluster.velocity_mps;
    if east.hypot(north) < UNMOVED_MPS {
        return None;
    }
    let from = plane.position(reference);
    let points = PREDICTED_TENTHS.map(|tenths| {
        let seconds = f64::from(tenths) / 10.0;
        let [x, y] = cluster.center;
        let to = plane.position([x + seconds * east, y + seconds * north]);
        let delta = |from: Option<f64>, to: Option<f64>| {
            si::DELTA_DEGREES.encode(to.zip(from).map(|(to, from)| to - from))
        };
        PathPointPredicted {
            delta_latitude: DeltaLatitude::saturating(delta(from.latitude, to.latitude)),
            delta_longitude: DeltaLongitude::saturating(delta(from.longitude, to.longitude)),
            horizontal_position_confidence: None,
            delta_altitude: DeltaAltitude::UNAVAILABLE,
            altitude_confidence: AltitudeConfidence::Unavailable,
            path_delta_time: DeltaTimeTenthOfSecond::new(tenths)
                .map(PathDeltaTimeChoice::DeltaTimeHighPrecision),
            symmetric_area_offset: None,
            asymmetric_area_offset: None,
        }
    });
    Some(VruMotionPredictionContainer {
        path_prediction: PathPredicted::new(&points),
        path_history: None,
        safe_distance: None,
        trajectory_interception_indication: None,
        acceleration_change_indication: None,
        heading_change_indication: None,
        stability_change_indication: None,
    })
}

/// A cluster as a message announces it.
#[derive(Clone, PartialEq, Debug)]
pub struct Announced {
    /// Its id, if it says one.
    pub id: Option<u8>,
    /// Area around its members, on the receiver's plane.
    pub area: Area,
    /// How many belong to it.
    pub cardinality: u8,
}

/// The cluster that a RAM announces, on the receiver's plane; `None` if it announces none, or where
/// nobody knows.
#[must_use]
pub fn read(ram: &RAM, plane: &Plane) -> Option<Announced> {
    let parameters = &ram.ram.ram_parameters;
    let container = parameters.vru_cluster_information_container.as_ref()?;
    let position: Position = position_of(&parameters.basic_container);
    on_plane(&container.vru_cluster_information, &position, plane)
}

/// A cluster that a message from `position` tells of, on the receiver's plane; `None` if it has no
/// shape, or nobody knows where it is.
#[must_use]
pub fn on_plane(
    information: &VruClusterInformation,
    position: &Position,
    plane: &Plane,
) -> Option<Announced> {
    let shape = information.cluster_bounding_box_shape.as_ref()?;
    Some(Announced {
        id: information.cluster_id.map(|id| id.0),
        area: Area::of_wire(shape, plane.point(position)?),
        cardinality: information.cluster_cardinality_size.0,
    })
}

#[cfg(test)]
mod tests {
    use crossguard_codec::{Identifiers, RobotState, decode, encode, ram_from};
    use crossguard_protocol::{Availability, Robot, StationId};
    use proptest::prelude::*;

    use super::super::clustering::{BreakupReason, Clustering, PerceivedVru, Settings};
    use super::*;

    fn ram_with(cluster: Option<&Cluster>, plane: &Plane, robot_m: Point) -> RAM {
        let state = RobotState {
            position: plane.position(robot_m),
            ..RobotState::default()
        };
        let view = Robot::new(StationId(7), 1).ram();
        let ids = Identifiers::default();
        let mut ram = ram_from(&ids, &state, &view, Availability::Available, 0, false).unwrap();
        write(&mut ram, plane, cluster);
        decode::<RAM>(&ids, &encode(&ids, &ram).unwrap())
            .unwrap()
            .message
    }

    #[test]
    fn a_ram_without_clusters_announces_none() {
        let plane = Plane::at(49.0, 8.4);
        let ram = ram_with(None, &plane, [0.0, 0.0]);
        assert_eq!(read(&ram, &plane), None);
        assert_eq!(ram.ram.ram_parameters.vru_motion_prediction_container, None);
    }

    #[test]
    fn people_who_walk_are_predicted() {
        let plane = Plane::at(49.0, 8.4);
        let mut clustering = Clustering::new(Settings::default(), 3);
        let walking = PerceivedVru {
            velocity_mps: [0.0, 1.5],
            ..PerceivedVru::pedestrian(1, [2.0, 3.0])
        };
        clustering.perceive(0, [0.0, 0.0], &[walking]);
        let ram = ram_with(clustering.clusters().first(), &plane, [0.0, 0.0]);
        let prediction = ram
            .ram
            .ram_parameters
            .vru_motion_prediction_container
            .unwrap();
        let path = prediction.path_prediction.unwrap();
        assert_eq!(path.len(), 3);
        // 3 m + 3 s * 1.5 m/s to the north, a degree being 111.2 km.
        let north = f64::from(path[2].delta_latitude.get()) * 1e-7 * 111_200.0;
        assert!((north - 7.5).abs() < 0.02, "{north}");
        let [east_mps, north_mps] = velocity_mps(&ram).unwrap();
        assert!(east_mps.abs() < 0.02 && (north_mps - 1.5).abs() < 0.02);
    }

    #[test]
    fn a_cluster_that_is_over_has_an_id_and_nobody() {
        let plane = Plane::at(49.0, 8.4);
        let ended_7 = Ended {
            id: 7,
            reason: BreakupReason::NotProvided,
        };
        let ids = Identifiers::default();
        let mut ram = ram_with(None, &plane, [0.0, 0.0]);
        write_ended(&mut ram, ended_7);
        let heard = decode::<RAM>(&ids, &encode(&ids, &ram).unwrap()).unwrap();
        let parameters = &heard.message.ram.ram_parameters;
        let container = parameters.vru_cluster_information_container.unwrap();
        assert_eq!(ended(&container.vru_cluster_information), Some(7));
        // The end of a cluster places no person, and is no cluster to join.
        assert_eq!(read(&heard.message, &plane), None);
        let cluster = ram_with(None, &plane, [0.0, 0.0]).ram.ram_parameters;
        assert_eq!(cluster.vru_cluster_information_container, None);
    }

    proptest! {
        /// Through the real octets of a RAM, everybody that the robot counts is inside of what a
        /// device understands.
        #[test]
        fn members_are_inside_of_what_is_received(
            places in proptest::collection::vec((-10.0..10.0_f64, -10.0..10.0_f64), 1..20),
            robot in (-300.0..300.0_f64, -300.0..300.0_f64),
        ) {
            let plane = Plane::at(49.01, 8.41);
            let robot_m = [robot.0, robot.1];
            let perceived: Vec<PerceivedVru> = (0..).zip(&places).map(|(id, &(x, y))| {
                PerceivedVru::pedestrian(id, [robot_m[0] + x, robot_m[1] + y])
            }).collect();
            let settings = Settings { margin_m: 0.1, spread_m: 100.0, ..Settings::default() };
            let mut clustering = Clustering::new(settings, 5);
            clustering.perceive(0, robot_m, &perceived);
            let clusters = clustering.clusters();
            let heard = read(&ram_with(clusters.first(), &plane, robot_m), &plane).unwrap();
            prop_assert_eq!(usize::from(heard.cardinality), places.len());
            for vru in &perceived {
                prop_assert!(heard.area.contains(vru.position_m));
            }
        }
    }
}
