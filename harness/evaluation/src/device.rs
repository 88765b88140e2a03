//! The VAM of a road user's device (TS 103 300-3 v2.3.1).

use crossguard_codec::asn1::cdd::{
    ClusterJoinInfo, ClusterLeaveInfo, ClusterLeaveReason, DeltaTimeQuarterSecond, ExteriorLights,
    Identifier1B, VruExteriorLights, VruProfileAndSubprofile, VruSizeClass,
    VruSpecificExteriorLights, VruSubProfilePedestrian,
};
use crossguard_codec::asn1::vam::{VruClusterOperationContainer, VruLowFrequencyContainer};
use crossguard_codec::{Identifiers, RobotState, encode};
use crossguard_endpoint::ras::etsi::NotMade;
use crossguard_endpoint::ras::vam::{quarter_second, vam};

use super::vru::{DueVam, Operation};

/// The octets of the VAM of a pedestrian, who is where and moves as `state` says. `now_ms` is the time of the position in
/// `TimestampIts`.
pub(super) fn vam_octets(
    station: u32,
    state: &RobotState,
    now_ms: u64,
    due: &DueVam,
) -> Result<Vec<u8>, NotMade> {
    let mut vam = vam(station, state, now_ms, |_| {})?;
    let parameters = &mut vam.vam.vam_parameters;
    parameters.vru_low_frequency_container = due.low_frequency.then(low_frequency);
    parameters.vru_cluster_operation_container = due.operation.map(operation_container);
    Ok(encode(&Identifiers::default(), &vam)?)
}

/// An ordinary pedestrian of medium size with a light at the helmet, as in the golden vectors.
#[expect(
    clippy::default_trait_access,
    reason = "bits without a name in this crate"
)]
fn low_frequency() -> VruLowFrequencyContainer {
    let profile = VruProfileAndSubprofile::pedestrian(VruSubProfilePedestrian(1));
    let mut helmet = VruSpecificExteriorLights(Default::default());
    helmet.0.set(2, true);
    let lights = VruExteriorLights::new(ExteriorLights(Default::default()), helmet);
    VruLowFrequencyContainer::new(profile, Some(VruSizeClass(2)), Some(lights))
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

#[cfg(test)]
mod tests {
    use crossguard_codec::{ConfidenceEllipse, Measurement, Position, golden};
    use crossguard_endpoint::ras::area::Area;
    use crossguard_endpoint::ras::containers::Announced;
    use crossguard_endpoint::ras::motion::Motion;

    use super::super::vru::{
        Announcement, LeaveReason, Suppression, Understands, VamRule, VruStation,
    };
    use super::*;

    /// The octets of this VAM in the state that the golden vectors of VAM have in common
    /// (`codec/tests/golden/vam.txt`).
    fn golden(due: &DueVam) -> String {
        let measurement = |value, confidence| {
            Some(Measurement {
                value,
                confidence: Some(confidence),
            })
        };
        let state = RobotState {
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
        };
        hex(&vam_octets(123_456_789, &state, 12_345, due).unwrap())
    }

    fn hex(octets: &[u8]) -> String {
        octets.iter().fold(String::new(), |digits, octet| {
            digits + &format!("{octet:02x}")
        })
    }

    fn vector(name: &str) -> &'static str {
        golden::vector(golden::VAM, name)
    }

    /// A device from being switched on until it joins a cluster, and when it leaves one: every VAM that it sends is
    /// one of the golden vectors, octet by octet.
    #[test]
    fn what_a_device_sends_is_what_the_golden_vectors_say() {
        let mut device = VruStation::new(
            VamRule::Periodic(100),
            Understands::ClusterVam,
            Suppression::Strict,
        );
        let standing = Motion::default();
        let announced = Announcement {
            head: 9,
            by: Understands::ClusterVam,
            cluster: Some(Announced {
                id: Some(7),
                area: Area::around(&[[0.0, 0.0]], 5.0).unwrap(),
                cardinality: 5,
            }),
            velocity_mps: Some([0.0, 0.0]),
            ended: None,
        };
        let sent = |device: &mut VruStation, now_ms| {
            let due = device.poll(now_ms, &standing, 0).unwrap();
            golden(&due)
        };
        assert_eq!(sent(&mut device, 0), vector("V2"));
        assert_eq!(sent(&mut device, 100), vector("V1"));
        // It joins at 12 * 256 ms, by the quarter seconds of generationDeltaTime.
        device.hear(200, &standing, &announced);
        assert_eq!(sent(&mut device, 200), vector("V4"));
        let leave = DueVam {
            low_frequency: false,
            operation: Some(Operation::Leave {
                id: 7,
                reason: LeaveReason::OutOfClusterBoundingBox,
            }),
        };
        assert_eq!(golden(&leave), vector("V5"));
    }
}
