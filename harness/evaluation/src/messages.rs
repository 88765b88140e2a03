//! Sizes of what goes over the air: real messages, encoded, and everything around them.
//!
//! A VAM's and a CAM's size follows from which containers it has, so each combination is encoded once.
//! A RAM is encoded every time.

use crossguard_codec::asn1::cam::{CAM, LowFrequencyContainer};
use crossguard_codec::{
    ConfidenceEllipse, Measurement, PastPosition, Position, RobotState, SlowState, decode, encode,
};
use crossguard_endpoint::ras::cam::cam;
use crossguard_endpoint::ras::etsi::NotMade;
use crossguard_endpoint::station::vehicle::passenger_car;
use serde::{Deserialize, Serialize};

use super::device::vam_octets;
use super::vru::{DueVam, LeaveReason, Operation};

/// IEEE 802.11 `QoS` data header and frame check sequence, in octets.
const MAC: usize = 26 + 4;
/// LLC and SNAP, in octets.
const LLC: usize = 8;
/// `GeoNetworking` single-hop broadcast and BTP-B, in octets.
const NETWORK: usize = 40 + 4;
/// TS 103 097 envelope whose signer is a digest, in octets.
const SIGNED_BY_DIGEST: usize = 93;
/// TS 103 097 envelope with the signer's certificate, in octets: one of 162 octets.
const SIGNED_WITH_CERTIFICATE: usize = 249;
/// A certificate goes along after so long, in ms.
pub const CERTIFICATE_INTERVAL_MS: u64 = 1_000;

/// How a packet is signed.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Signed {
    /// Not at all.
    No,
    /// By the digest of a certificate.
    ByDigest,
    /// With the certificate.
    WithCertificate,
}

/// The octets of a frame (PSDU) whose message has this many.
#[must_use]
pub const fn frame_octets(message: usize, signed: Signed) -> usize {
    let security = match signed {
        Signed::No => 0,
        Signed::ByDigest => SIGNED_BY_DIGEST,
        Signed::WithCertificate => SIGNED_WITH_CERTIFICATE,
    };
    MAC + LLC + NETWORK + message + security
}

/// Data rates of the 10 MHz channel, in Mbit/s (IEEE 802.11, clause 17).
pub const DATA_RATES_MBPS: [f64; 8] = [3.0, 4.5, 6.0, 9.0, 12.0, 18.0, 24.0, 27.0];
/// The default of ITS-G5, in Mbit/s. The paper does not state it.
pub const DATA_RATE_MBPS: f64 = 6.0;
/// How long a symbol takes, in microseconds.
pub const SYMBOL_US: u64 = 8;

/// How long a frame of these octets is in the air at one of [`DATA_RATES_MBPS`], in microseconds: IEEE 802.11 with
/// 10 MHz. 40 us of preamble and signal, then symbols of 8 us, of 48 bits each at 6 Mbit/s, among them 16 of service
/// and 6 of tail.
#[must_use]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    reason = "24 to 216 bits"
)]
pub const fn air_time_us(octets: usize, data_rate_mbps: f64) -> u64 {
    let bits = (data_rate_mbps * SYMBOL_US as f64) as u64;
    40 + (16 + 6 + 8 * octets as u64).div_ceil(bits) * SYMBOL_US
}

/// How long a `GeoNetworking` packet of these octets is in the air, in microseconds.
#[must_use]
pub const fn packet_air_time_us(octets: usize) -> u64 {
    air_time_us(MAC + LLC + octets, DATA_RATE_MBPS)
}

/// Octets of the messages whose size follows from their containers.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Sizes {
    /// VAM without and with the low-frequency container.
    vam: [usize; 2],
    /// VAM that announces that it joins, and that it left.
    vam_operation: [usize; 2],
    /// CAM without and with the low-frequency container.
    cam: [usize; 2],
}

impl Sizes {
    /// Encodes one message of each kind; the path history of a CAM's low-frequency container has this many
    /// points.
    ///
    /// # Errors
    /// When a message cannot be encoded.
    pub fn measure(cam_path_points: usize) -> Result<Self, NotMade> {
        let octets = |low_frequency, operation| {
            let due = DueVam {
                low_frequency,
                operation,
            };
            vam_octets(1, &state_of_a_pedestrian(), 0, &due).map(|vam| vam.len())
        };
        let reason = LeaveReason::OutOfClusterBoundingBox;
        let join = Operation::Join { id: 1, at_ms: 0 };
        let leave = Operation::Leave { id: 1, reason };
        Ok(Self {
            vam: [octets(false, None)?, octets(true, None)?],
            vam_operation: [octets(true, Some(join))?, octets(true, Some(leave))?],
            cam: [cam_octets(None)?, cam_octets(Some(cam_path_points))?],
        })
    }

    /// Octets of a VAM.
    #[must_use]
    pub const fn vam(&self, due: &DueVam) -> usize {
        match due.operation {
            None => self.vam[due.low_frequency as usize],
            Some(Operation::Join { .. }) => self.vam_operation[0],
            Some(Operation::Leave { .. }) => self.vam_operation[1],
        }
    }

    /// Octets of a VAM without containers of its own choice.
    #[must_use]
    pub const fn plain_vam(&self) -> usize {
        self.vam[0]
    }

    /// Octets of a CAM.
    #[must_use]
    pub const fn cam(&self, low_frequency: bool) -> usize {
        self.cam[low_frequency as usize]
    }
}

/// Octets of a passenger car's CAM, without or with a low-frequency container whose path history has this many
/// points. More than 40 cannot be encoded.
fn cam_octets(path_points: Option<usize>) -> Result<usize, NotMade> {
    let (ids, mut state) = (passenger_car(), state_of_a_pedestrian());
    let point = PastPosition {
        latitude: 49.01,
        longitude: 8.41,
        altitude: None,
        duration: Some(0.5),
    };
    state.slow = Some(SlowState {
        path: vec![point],
        ..SlowState::default()
    });
    let octets = cam(&ids, 1, &state, 0, path_points.is_some())?;
    let mut cam = decode::<CAM>(&ids, &octets)?.message;
    let slow = &mut cam.cam.cam_parameters.low_frequency_container;
    if let (Some(points), Some(LowFrequencyContainer::basicVehicleContainerLowFrequency(slow))) =
        (path_points, slow)
    {
        let path = &mut slow.path_history.0;
        *path = path.iter().cycle().take(points).cloned().collect();
    }
    Ok(encode(&ids, &cam)?.len())
}

/// Confidences as a phone would give them; they do not change the size of a VAM.
fn state_of_a_pedestrian() -> RobotState {
    let measurement = |value, confidence| {
        Some(Measurement {
            value,
            confidence: Some(confidence),
        })
    };
    RobotState {
        position: Position {
            ellipse: Some(ConfidenceEllipse {
                semi_major: 2.0,
                semi_minor: 2.0,
                orientation: 0.0,
            }),
            ..Position::at(49.01, 8.41)
        },
        heading: measurement(90.0, 5.0),
        speed: measurement(1.4, 0.5),
        ..RobotState::default()
    }
}

#[cfg(test)]
mod tests {
    use crossguard_codec::golden;

    use super::*;

    #[test]
    fn the_air_time_is_that_of_the_standard() {
        for (octets, us) in [(141, 232), (234, 360), (390, 568), (400, 584)] {
            assert_eq!(air_time_us(octets, DATA_RATE_MBPS), us, "{octets} octets");
        }
        // 1150 bits: 48 symbols of 24 bits, 6 of 216.
        assert_eq!((air_time_us(141, 3.0), air_time_us(141, 27.0)), (424, 88));
        assert_eq!(frame_octets(59, Signed::No), 141);
        assert_eq!(frame_octets(59, Signed::ByDigest), 234);
        assert_eq!(frame_octets(59, Signed::WithCertificate), 390);
    }

    /// 41 octets are those of the golden vector C1; C2 has 58 with two points, one of them without time.
    #[test]
    fn a_cam_has_the_size_of_the_golden_vectors() {
        assert_eq!(cam_octets(None).unwrap(), 41);
        assert_eq!(cam_octets(Some(2)).unwrap(), 60);
        assert!(cam_octets(Some(41)).is_err());
    }

    /// The VAM of which sizes are taken have the containers of the golden vectors, whose octets [`vam_octets`] makes.
    #[test]
    fn a_vam_has_the_size_of_the_golden_vectors() {
        let octets = |name| golden::vector(golden::VAM, name).len() / 2;
        let sizes = Sizes::measure(5).unwrap();
        assert_eq!(sizes.vam, [octets("V1"), octets("V2")]);
        // A device that says that it left sends the low-frequency container as well.
        let left = octets("V2") + octets("V5") - octets("V1");
        assert_eq!(sizes.vam_operation, [octets("V4"), left]);
    }
}
