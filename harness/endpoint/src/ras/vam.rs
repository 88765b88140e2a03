//! The VAM by which a robot speaks to devices that do not know RAM: of clusters that it leads, and that they are over.
//!
//! A VAM shares its basic container, motion and cluster containers with RAM bit by bit, so they are
//! made as those of a RAM are.

use crossguard_codec::asn1::cdd::{
    AccelerationComponent, ClusterBreakupInfo, ClusterBreakupReason, DeltaTimeQuarterSecond,
    LongitudinalAcceleration, LongitudinalAccelerationValue, PathDeltaTimeChoice,
    PathPointPredicted, TrafficParticipantType,
};
use crossguard_codec::asn1::cdd211::{
    ClusterBreakupInfo211, ClusterBreakupReason211, PathPointPredicted211, PathPredicted211,
    VAM211, VamParameters211, VruAwareness211, VruClusterInformationContainer211,
    VruClusterOperationContainer211, VruHighFrequencyContainer211, VruMotionPredictionContainer211,
};
use crossguard_codec::asn1::ram::RobotAwareness;
use crossguard_codec::asn1::vam::{
    VAM, VamParameters, VruAwareness, VruClusterOperationContainer, VruHighFrequencyContainer,
};
use crossguard_codec::core::ram::RAM;
use crossguard_codec::{Dictionary, Identifiers, Position, RobotState, encode};

use super::clustering::{BreakupReason, Cluster, Ended};
use super::containers;
use super::etsi::{NotMade, awareness, header};
use super::motion::Plane;
use super::surroundings::Told;

/// `stationType` of a pedestrian.
const PEDESTRIAN: u8 = 1;

/// How it moves, which both dictionaries say in the same fields.
macro_rules! high_frequency {
    ($container:ident, $motion:expr) => {{
        let motion = $motion;
        $container::new(
            motion.heading,
            motion.speed,
            acceleration(&motion.longitudinal_acceleration),
            None,
            None,
            None,
            None,
            None,
            None,
            None,
            None,
            None,
            None,
            None,
        )
    }};
}

/// The octets of the VAM by which `station`, a robot at `position` on `plane`, tells devices that do not understand
/// RAM of a cluster, on the dictionary that `ids` say. `now_ms` is the time of the position in `TimestampIts`.
///
/// # Errors
/// When the message cannot be encoded.
pub fn vam_of(
    ids: &Identifiers,
    station: u32,
    position: &Position,
    now_ms: u64,
    told: &Told,
    plane: &Plane,
) -> Result<Vec<u8>, NotMade> {
    match told {
        Told::Cluster(cluster) => cluster_vam(ids, station, position, now_ms, cluster, plane),
        Told::Ended(ended) => breakup_vam(ids, station, position, now_ms, *ended),
    }
}

fn cluster_vam(
    ids: &Identifiers,
    station: u32,
    position: &Position,
    now_ms: u64,
    cluster: &Cluster,
    plane: &Plane,
) -> Result<Vec<u8>, NotMade> {
    let [east, north] = cluster.velocity_mps;
    let state = RobotState {
        position: *position,
        heading: Some(east.atan2(north).to_degrees().rem_euclid(360.0).into()),
        speed: Some(east.hypot(north).into()),
        ..RobotState::default()
    };
    of_dictionary(ids, station, &state, now_ms, None, |ram| {
        containers::write(ram, plane, Some(cluster));
    })
}

/// The VAM that says that a cluster is over: with the id of the cluster, nobody in it, and `ClusterBreakupInfo` with
/// the time.
fn breakup_vam(
    ids: &Identifiers,
    station: u32,
    position: &Position,
    now_ms: u64,
    ended: Ended,
) -> Result<Vec<u8>, NotMade> {
    let state = RobotState {
        position: *position,
        ..RobotState::default()
    };
    of_dictionary(ids, station, &state, now_ms, Some(ended), |ram| {
        containers::write_ended(ram, ended);
    })
}

/// The octets of a VAM that says that a cluster is over, or where one is. ETSI sends the low-frequency container along
/// with every operation; it would say that the robot is a pedestrian.
fn of_dictionary(
    ids: &Identifiers,
    station: u32,
    state: &RobotState,
    now_ms: u64,
    ended: Option<Ended>,
    complete: impl FnOnce(&mut RAM),
) -> Result<Vec<u8>, NotMade> {
    match ids.dictionary {
        Dictionary::V2_4_1 => {
            let mut vam = vam(station, state, now_ms, complete)?;
            let operation = ended.map(|ended| breakup(ended, now_ms));
            vam.vam.vam_parameters.vru_cluster_operation_container = operation;
            Ok(encode(ids, &vam)?)
        }
        Dictionary::V2_1_1 => {
            let shared = shared(station, state, now_ms, complete)?;
            let operation = ended.map(|ended| breakup_211(ended, now_ms));
            let vam = VAM211::new(
                header::<VAM>(&Identifiers::default(), station),
                awareness_211(shared, operation),
            );
            Ok(encode(ids, &vam)?)
        }
    }
}

/// The VAM of a pedestrian with this `station` id on the dictionary v2.4.1, who is where and moves as `state` says.
/// `now_ms` is the time of the position in `TimestampIts`; `complete` adds the containers that a RAM has as well.
///
/// # Errors
/// When the message cannot be made.
pub fn vam(
    station: u32,
    state: &RobotState,
    now_ms: u64,
    complete: impl FnOnce(&mut RAM),
) -> Result<VAM, NotMade> {
    let shared = shared(station, state, now_ms, complete)?;
    let motion = shared.ram_parameters.robot_high_frequency_container;
    let parameters = VamParameters::new(
        shared.ram_parameters.basic_container,
        high_frequency!(VruHighFrequencyContainer, motion),
        None,
        shared.ram_parameters.vru_cluster_information_container,
        None,
        shared.ram_parameters.vru_motion_prediction_container,
    );
    Ok(VAM::new(
        header::<VAM>(&Identifiers::default(), station),
        VruAwareness::new(shared.generation_delta_time, parameters),
    ))
}

/// Containers that a VAM shares with a RAM.
fn shared(
    station: u32,
    state: &RobotState,
    now_ms: u64,
    complete: impl FnOnce(&mut RAM),
) -> Result<RobotAwareness, NotMade> {
    let ids = Identifiers::default();
    let mut shared = awareness(&ids, station, state, now_ms, false, complete)?;
    shared.ram_parameters.basic_container.station_type = TrafficParticipantType(PEDESTRIAN);
    Ok(shared)
}

fn acceleration(of_robot: &AccelerationComponent) -> LongitudinalAcceleration {
    LongitudinalAcceleration::new(
        LongitudinalAccelerationValue(of_robot.value.0),
        of_robot.confidence.clone(),
    )
}

/// The same of a cluster on the dictionary v2.1.1, whose predicted points are others.
fn awareness_211(
    shared: RobotAwareness,
    operation: Option<VruClusterOperationContainer211>,
) -> VruAwareness211 {
    let parameters = shared.ram_parameters;
    let motion = parameters.robot_high_frequency_container;
    let high_frequency = high_frequency!(VruHighFrequencyContainer211, motion);
    let cluster = parameters.vru_cluster_information_container;
    let cluster =
        cluster.map(|it| VruClusterInformationContainer211::new(it.vru_cluster_information));
    let prediction = parameters.vru_motion_prediction_container;
    let path = prediction.and_then(|prediction| prediction.path_prediction);
    let prediction = path.map(|path| {
        let points = path.0.into_iter().filter_map(point_211).collect();
        let path = Some(PathPredicted211(points));
        VruMotionPredictionContainer211::new(None, path, None, None, None, None, None)
    });
    let basic = parameters.basic_container;
    let parameters =
        VamParameters211::new(basic, high_frequency, None, cluster, operation, prediction);
    VruAwareness211::new(shared.generation_delta_time, parameters)
}

/// A predicted point, which the older dictionary has only with a time of its own in tenths of a second.
fn point_211(point: PathPointPredicted) -> Option<PathPointPredicted211> {
    let Some(PathDeltaTimeChoice::deltaTimeHighPrecision(time)) = point.path_delta_time else {
        return None;
    };
    Some(PathPointPredicted211::new(
        point.delta_latitude,
        point.delta_longitude,
        point.horizontal_position_confidence,
        point.delta_altitude,
        point.altitude_confidence,
        time,
    ))
}

fn breakup(ended: Ended, now_ms: u64) -> VruClusterOperationContainer {
    let reason = ClusterBreakupReason(ended.reason as u8);
    let time = DeltaTimeQuarterSecond(quarter_second(now_ms));
    let info = ClusterBreakupInfo::new(reason, time);
    VruClusterOperationContainer::new(None, None, Some(info), None)
}

fn breakup_211(ended: Ended, now_ms: u64) -> VruClusterOperationContainer211 {
    let reason = match ended.reason {
        BreakupReason::NotProvided => ClusterBreakupReason211::notProvided,
        BreakupReason::ClusteringPurposeCompleted => {
            ClusterBreakupReason211::clusteringPurposeCompleted
        }
    };
    let time = DeltaTimeQuarterSecond(quarter_second(now_ms));
    let info = ClusterBreakupInfo211::new(reason, time);
    VruClusterOperationContainer211::new(None, None, Some(info), None)
}

/// `DeltaTimeQuarterSecond`: the upper octet of the generation delta time of a moment, 1..254. The values
/// 0, which cannot be said, and 255, which is unavailable, become their neighbours.
#[must_use]
pub fn quarter_second(at_ms: u64) -> u8 {
    let [upper, _] = crossguard_codec::si::generation_delta_time(at_ms).to_be_bytes();
    upper.clamp(1, 254)
}

#[cfg(test)]
mod tests {
    use crossguard_codec::its::ItsMessage;
    use crossguard_codec::{Measurement, golden};

    use super::super::area::Area;
    use super::super::clustering::VruClass;
    use super::super::etsi::golden_position;
    use super::super::motion::Point;
    use super::*;

    /// State that the golden vectors of VAM have in common (`codec/tests/golden/vam.txt`).
    fn golden_state() -> RobotState {
        let measurement = |value, confidence| {
            Some(Measurement {
                value,
                confidence: Some(confidence),
            })
        };
        RobotState {
            position: golden_position(),
            heading: measurement(90.0, 1.0),
            speed: measurement(1.39, 0.5),
            ..RobotState::default()
        }
    }

    fn golden(cluster: &Cluster) -> String {
        let plane = Plane::at(48.765_432_1, 9.123_456_7);
        let vam = vam(123_456_789, &golden_state(), 12_345, |ram| {
            containers::write(ram, &plane, Some(cluster));
        });
        hex::encode(encode(&Identifiers::default(), &vam.unwrap()).unwrap())
    }

    fn cluster(center: Point, velocity_mps: [f64; 2]) -> Cluster {
        let radius_m = 4.94;
        Cluster {
            id: 7,
            area: Area::Circle { center, radius_m },
            cardinality: 5,
            profiles: VruClass::Pedestrian.bit(),
            center,
            velocity_mps,
        }
    }

    /// Messages of `make`, decoded by the newer and by the older dictionary.
    fn heard(make: impl Fn(&Identifiers) -> Vec<u8>) -> [ItsMessage; 2] {
        [Dictionary::V2_4_1, Dictionary::V2_1_1].map(|dictionary| {
            let ids = Identifiers {
                dictionary,
                ..Identifiers::default()
            };
            ItsMessage::decode(&ids, &make(&ids)).unwrap().message
        })
    }

    #[test]
    fn clusters_have_the_octets_of_the_golden_vectors() {
        let mut cluster = cluster([0.0, 0.0], [0.0, 0.0]);
        assert_eq!(golden(&cluster), golden::vector(golden::VAM, "V3"));
        cluster.profiles = 0;
        cluster.area = Area::Rectangle {
            center: [0.1, -0.2],
            half_m: [4.94, 2.94],
            direction_rad: 45_f64.to_radians(),
        };
        assert_eq!(golden(&cluster), golden::vector(golden::VAM, "V8"));
    }

    #[test]
    fn a_cluster_is_told_on_the_dictionary_that_is_configured() {
        let plane = Plane::at(48.765_432_1, 9.123_456_7);
        let cluster = cluster([3.0, 1.0], [0.0, 1.5]);
        let now_its = 694_694_400_000;
        let position = plane.position([0.0, 0.0]);
        let [new, old] =
            heard(|ids| cluster_vam(ids, 9, &position, now_its, &cluster, &plane).unwrap());
        let ItsMessage::Vam211(vam) = &old else {
            panic!("{old:?}");
        };
        assert_eq!(old.road_users(now_its), new.road_users(now_its));
        let prediction = &vam.vam.vam_parameters.vru_motion_prediction_container;
        let path = prediction.as_ref().unwrap().path_prediction.as_ref();
        let path = path.unwrap().0.iter();
        let times: Vec<_> = path.map(|it| it.path_delta_time.0).collect();
        assert_eq!(times, [10, 20, 30]);
    }

    #[test]
    fn a_cluster_is_broken_up_on_both_dictionaries() {
        let plane = Plane::at(48.765_432_1, 9.123_456_7);
        let ended = Ended {
            id: 7,
            reason: BreakupReason::ClusteringPurposeCompleted,
        };
        let position = plane.position([0.0, 0.0]);
        let [new, old] = heard(|ids| breakup_vam(ids, 9, &position, 12 * 256, ended).unwrap());
        // On a map there is nobody by it.
        assert!(new.road_users(0).is_empty() && old.road_users(0).is_empty());
        let ItsMessage::Vam(vam) = new else {
            panic!("{new:?}")
        };
        let parameters = &vam.vam.vam_parameters;
        let cluster = parameters.vru_cluster_information_container.as_ref();
        let cluster = &cluster.unwrap().vru_cluster_information;
        assert_eq!(cluster.cluster_id.as_ref().map(|id| id.0), Some(7));
        assert_eq!(cluster.cluster_bounding_box_shape, None);
        let operation = parameters.vru_cluster_operation_container.as_ref();
        let breakup = operation.unwrap().cluster_breakup_info.as_ref().unwrap();
        assert_eq!(breakup.cluster_breakup_reason, ClusterBreakupReason(1));
        assert_eq!(breakup.breakup_time, DeltaTimeQuarterSecond(12));
        let ItsMessage::Vam211(vam) = old else {
            panic!("{old:?}")
        };
        let operation = &vam.vam.vam_parameters.vru_cluster_operation_container;
        let breakup = operation.as_ref().unwrap().cluster_breakup_info.as_ref();
        let reason = breakup.unwrap().cluster_breakup_reason;
        assert_eq!(reason, ClusterBreakupReason211::clusteringPurposeCompleted);
    }

    #[test]
    fn a_time_within_a_minute_has_a_quarter_second_of_its_own() {
        assert_eq!(quarter_second(12 * 256 + 255), 12);
        assert_eq!((quarter_second(0), quarter_second(65_535)), (1, 254));
    }
}
