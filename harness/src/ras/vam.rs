//! The VAM of a road user's device, and the cluster VAM by which a robot speaks to devices that do not
//! know RAM.
//!
//! A VAM shares its basic container, motion and cluster containers with RAM bit by bit, so they are
//! made as those of a RAM are.

use crossguard_codec::asn1::cdd::{
    ClusterJoinInfo, ClusterLeaveInfo, ClusterLeaveReason, DeltaTimeQuarterSecond, Identifier1B,
    ItsPduHeader, LongitudinalAcceleration, LongitudinalAccelerationValue, MessageId,
    OrdinalNumber1B, StationId, TrafficParticipantType, VruProfileAndSubprofile, VruSizeClass,
    VruSubProfilePedestrian,
};
use crossguard_codec::asn1::ram::RAM;
use crossguard_codec::asn1::vam::{
    VAM, VamParameters, VruAwareness, VruClusterOperationContainer, VruHighFrequencyContainer,
    VruLowFrequencyContainer,
};
use crossguard_codec::{DecodeError, EncodeError, Identifiers, Pdu, RobotState, encode, ram_from};
use crossguard_protocol::{Availability, Coordination, Ram};

use super::clustering::Cluster;
use super::containers;
use super::motion::Plane;
use super::vru::{DueVam, Operation};

/// What a VAM says besides its motion.
#[derive(Clone, Copy, Debug)]
pub enum Content<'a> {
    /// A pedestrian's own VAM.
    Individual(DueVam),
    /// A robot's VAM for a cluster that it leads.
    Cluster(&'a Cluster, &'a Plane),
}

/// `stationType` of a pedestrian.
const PEDESTRIAN: u8 = 1;

/// The octets of a VAM from `station`, which is where and moves as `state` says. `now_ms` is the time
/// of its position in `TimestampIts`.
///
/// # Errors
/// When the message cannot be encoded.
pub fn vam(
    station: u32,
    state: &RobotState,
    now_ms: u64,
    content: Content<'_>,
) -> Result<Vec<u8>, VamError> {
    let ids = Identifiers::default();
    let view = Ram {
        station: crossguard_protocol::StationId(station),
        coordination: Coordination::None,
        farewell: None,
    };
    let time = crossguard_codec::si::generation_delta_time(now_ms);
    let mut shared = ram_from(&ids, state, &view, Availability::Available, time, false)?;
    if let Content::Cluster(cluster, plane) = content {
        containers::write(&mut shared, plane, Some(cluster));
    }
    let shared = RAM::try_from(&shared)?.ram;
    let mut basic = shared.ram_parameters.basic_container;
    let motion = shared.ram_parameters.robot_high_frequency_container;
    basic.station_type = TrafficParticipantType(PEDESTRIAN);
    let high_frequency = VruHighFrequencyContainer::new(
        motion.heading,
        motion.speed,
        LongitudinalAcceleration::new(
            LongitudinalAccelerationValue(motion.longitudinal_acceleration.value.0),
            motion.longitudinal_acceleration.confidence,
        ),
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
    );
    let (low_frequency, operation) = match content {
        Content::Individual(due) => (due.low_frequency.then(low_frequency), due.operation),
        Content::Cluster(..) => (None, None),
    };
    let parameters = VamParameters::new(
        basic,
        high_frequency,
        low_frequency,
        shared.ram_parameters.vru_cluster_information_container,
        operation.map(operation_container),
        shared.ram_parameters.vru_motion_prediction_container,
    );
    let (protocol_version, message_id) = VAM::expected_header(&ids);
    let header = ItsPduHeader::new(
        OrdinalNumber1B(protocol_version),
        MessageId(message_id),
        StationId(station),
    );
    let vam = VAM::new(
        header,
        VruAwareness::new(shared.generation_delta_time, parameters),
    );
    Ok(encode(&ids, &vam)?)
}

/// An ordinary pedestrian of medium size.
fn low_frequency() -> VruLowFrequencyContainer {
    let profile = VruProfileAndSubprofile::pedestrian(VruSubProfilePedestrian(1));
    VruLowFrequencyContainer::new(profile, Some(VruSizeClass(2)), None)
}

fn operation_container(operation: Operation) -> VruClusterOperationContainer {
    let (join, leave) = match operation {
        Operation::Join { id, at_ms } => {
            let join_time = DeltaTimeQuarterSecond(quarter_second(at_ms));
            (
                Some(ClusterJoinInfo::new(Identifier1B(id), join_time)),
                None,
            )
        }
        Operation::Leave { id, reason } => {
            let reason = ClusterLeaveReason(reason as u8);
            (None, Some(ClusterLeaveInfo::new(Identifier1B(id), reason)))
        }
    };
    VruClusterOperationContainer::new(join, leave, None, None)
}

/// `DeltaTimeQuarterSecond`: the upper octet of the generation delta time of a moment, 1..254. That of
/// 0 cannot be said, and 255 is unavailable; both become their neighbour.
fn quarter_second(at_ms: u64) -> u8 {
    let [upper, _] = crossguard_codec::si::generation_delta_time(at_ms).to_be_bytes();
    upper.clamp(1, 254)
}

/// Why a VAM cannot be sent.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum VamError {
    /// It contradicts itself.
    #[error(transparent)]
    Contradictory(#[from] crossguard_codec::ViewError),
    /// The codec's two forms of it differ.
    #[error(transparent)]
    Disagreement(#[from] DecodeError),
    /// It cannot be encoded.
    #[error(transparent)]
    NotEncodable(#[from] EncodeError),
}

#[cfg(test)]
mod tests {
    use crossguard_codec::{ConfidenceEllipse, Measurement, Position};

    use super::super::area::Area;
    use super::super::generation::Trigger;
    use super::super::vru::{LeaveReason, VamTrigger};
    use super::*;

    /// What the golden vectors of VAM have in common (`codec/tests/golden/vam.txt`).
    fn golden_state() -> RobotState {
        let measurement = |value, confidence| {
            Some(Measurement {
                value,
                confidence: Some(confidence),
            })
        };
        RobotState {
            position: Position {
                altitude: Some(260.0),
                altitude_confidence: Some(1.0),
                ellipse: Some(ConfidenceEllipse {
                    semi_major: 1.0,
                    semi_minor: 0.5,
                    orientation: 90.0,
                }),
                ..Position::at(48.765_432_1, 9.123_456_7)
            },
            heading: measurement(90.0, 1.0),
            speed: measurement(1.39, 0.5),
            ..RobotState::default()
        }
    }

    fn golden(content: Content<'_>) -> String {
        hex::encode(vam(123_456_789, &golden_state(), 12_345, content).unwrap())
    }

    fn individual(operation: Option<Operation>) -> Content<'static> {
        Content::Individual(DueVam {
            trigger: VamTrigger::Motion(Trigger::First),
            low_frequency: false,
            operation,
        })
    }

    #[test]
    fn what_a_device_sends_is_what_the_golden_vectors_say() {
        let vectors = include_str!("../../../codec/tests/golden/vam.txt");
        let vector = |name: &str| {
            let lines = vectors.lines();
            lines
                .filter_map(|line| line.split_once(": "))
                .find(|line| line.0 == name)
                .unwrap()
                .1
        };
        assert_eq!(golden(individual(None)), vector("V1"));
        let reason = LeaveReason::OutOfClusterBoundingBox;
        let leave = Operation::Leave { id: 7, reason };
        assert_eq!(golden(individual(Some(leave))), vector("V5"));
        let plane = Plane::at(48.765_432_1, 9.123_456_7);
        let cluster = Cluster {
            id: 7,
            area: Area::Circle {
                center: [0.0, 0.0],
                radius_m: 4.94,
            },
            cardinality: 5,
            profiles: 0b1000,
            center: [0.0, 0.0],
            velocity_mps: [0.0, 0.0],
        };
        // V3 leaves the reference point of its shape out, which takes 33 bits in ours.
        let ours = golden(Content::Cluster(&cluster, &plane));
        assert_eq!(ours.len() / 2, vector("V3").len() / 2 + 5);
    }

    #[test]
    fn joining_and_the_slow_container_have_their_octets() {
        let mut due = DueVam {
            trigger: VamTrigger::Join,
            low_frequency: true,
            operation: Some(Operation::Join {
                id: 7,
                at_ms: 12 * 256,
            }),
        };
        // V4 has lights in its slow container, which take 3 octets.
        let join = golden(Content::Individual(due));
        assert_eq!(join.len() / 2, 39);
        due.operation = None;
        assert_eq!(golden(Content::Individual(due)).len() / 2, 36);
        assert_eq!(quarter_second(12 * 256 + 255), 12);
        assert_eq!((quarter_second(0), quarter_second(65_535)), (1, 254));
    }
}
