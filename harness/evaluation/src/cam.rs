//! A vehicle's CAM, for its size: EN 302 637-2, which has the same bits as TS 103 900.

use crossguard_codec::asn1::cam::CAM;
use crossguard_codec::{EncodeError, Identifiers, encode};
use serde_json::{Value, json};

/// Octets of a vehicle's CAM, without or with a low-frequency container whose path history has this many
/// points.
///
/// # Errors
/// When it cannot be encoded, as with more than 40 points.
pub(super) fn cam_octets(path_points: Option<usize>) -> Result<usize, CamError> {
    let cam: CAM = serde_json::from_value(cam(path_points))?;
    Ok(encode(&Identifiers::default(), &cam)?.len())
}

/// Why a CAM has no size.
#[derive(Debug, thiserror::Error)]
pub enum CamError {
    /// It is none.
    #[error("not a CAM: {0}")]
    NotACam(#[from] serde_json::Error),
    /// It cannot be encoded.
    #[error(transparent)]
    NotEncodable(#[from] EncodeError),
}

/// A passenger car on its way, in the names of the ASN.1 module. Its numbers do not change its size.
fn cam(path_points: Option<usize>) -> Value {
    json!({
        "header": {"protocolVersion": 2, "messageId": 2, "stationId": 1},
        "cam": {
            "generationDeltaTime": 0,
            "camParameters": {
                "basicContainer": basic_container(),
                "highFrequencyContainer": {"basicVehicleContainerHighFrequency": high_frequency()},
                "lowFrequencyContainer": path_points.map(|points| json!({
                    "basicVehicleContainerLowFrequency": {
                        "vehicleRole": "default",
                        "exteriorLights": "80",
                        "pathHistory": vec![path_point(); points],
                    },
                })),
                "specialVehicleContainer": null,
                "extensionContainers": null,
            },
        },
    })
}

fn basic_container() -> Value {
    json!({
        "stationType": 5,
        "referencePosition": {
            "latitude": 490_100_000,
            "longitude": 84_100_000,
            "positionConfidenceEllipse": {
                "semiMajorAxisLength": 100,
                "semiMinorAxisLength": 50,
                "semiMajorAxisOrientation": 900,
            },
            "altitude": {"altitudeValue": 800_001, "altitudeConfidence": "unavailable"},
        },
    })
}

/// The container that every CAM has, without optional fields.
fn high_frequency() -> Value {
    json!({
        "heading": {"headingValue": 900, "headingConfidence": 10},
        "speed": {"speedValue": 1_389, "speedConfidence": 50},
        "driveDirection": "forward",
        "vehicleLength": {
            "vehicleLengthValue": 42,
            "vehicleLengthConfidenceIndication": "noTrailerPresent",
        },
        "vehicleWidth": 18,
        "longitudinalAcceleration": {"value": 3, "confidence": 102},
        "curvature": {"curvatureValue": 0, "curvatureConfidence": "unavailable"},
        "curvatureCalculationMode": "yawRateUsed",
        "yawRate": {"yawRateValue": 0, "yawRateConfidence": "unavailable"},
        "accelerationControl": null,
        "lanePosition": null,
        "steeringWheelAngle": null,
        "lateralAcceleration": null,
        "verticalAcceleration": null,
        "performanceClass": null,
        "cenDsrcTollingZone": null,
    })
}

fn path_point() -> Value {
    json!({
        "pathPosition": {"deltaLatitude": -100, "deltaLongitude": 200, "deltaAltitude": 12_800},
        "pathDeltaTime": 50,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 41 octets are those of the golden vector C1; C2 has 58 with two points, one of them without time.
    #[test]
    fn a_cam_has_the_size_of_the_golden_vectors() {
        assert_eq!(cam_octets(None).unwrap(), 41);
        assert_eq!(cam_octets(Some(2)).unwrap(), 60);
        assert!(cam_octets(Some(41)).is_err());
    }
}
