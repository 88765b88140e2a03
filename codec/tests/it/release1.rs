//! CAM of `protocolVersion` 1. The vectors were written bit by bit from TS 102 894-2 v1.2.1, and Wireshark 4.0.17, whose
//! dissector `CAMv1` is made from ETSI's module, reads the same values out of them.

use crate::support::{flips, from_hex};
use crossguard_codec::asn1::cam::{CAM, HighFrequencyContainer};
use crossguard_codec::its::ItsMessage;
use crossguard_codec::{DecodeError, Identifiers};

/// A car at 13.89 m/s to the east in a curve of 10 m to the right, with two points of its path.
const CAR: &str = "0102075bcd1503e8405a56bd962e173e60e0c80a0709b7743e00384122b68902908a83334bc75fffb00000b01f3bf82f8e70006380fa1fc17c73800310";
/// The same with the container of an emergency vehicle.
const EMERGENCY: &str = "0102075bcd1503e8605a56bd962e173e60e0c80a0709b7743e00384122b68902908a83334bc75fffb00000b01f3bf82f8e70006380fa1fc17c73800315f5f018";

fn read(octets: &[u8]) -> Result<ItsMessage, DecodeError> {
    ItsMessage::decode(&Identifiers::default(), octets).map(|it| it.message)
}

fn cam(digits: &str) -> CAM {
    match read(&from_hex(digits)).unwrap() {
        ItsMessage::Cam(cam) => *cam,
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_cam_of_release_1_is_read_up_to_its_special_vehicle_container() {
    let message = cam(CAR);
    let parameters = &message.cam.cam_parameters;
    let HighFrequencyContainer::basicVehicleContainerHighFrequency(fast) =
        &parameters.high_frequency_container
    else {
        panic!("{message:?}");
    };
    assert_eq!(fast.curvature.curvature_value.0, -1_000, "in 1/10,000 m");
    assert_eq!(
        (fast.speed.speed_value.0, fast.yaw_rate.yaw_rate_value.0),
        (1_389, 32_767)
    );
    let json = serde_json::to_value(parameters).unwrap();
    let path = &json["lowFrequencyContainer"]["basicVehicleContainerLowFrequency"]["pathHistory"];
    assert_eq!(path[1]["pathPosition"]["deltaLatitude"], 1_001, "{json}");
    // What stands behind is left out.
    assert_eq!(cam(EMERGENCY).cam, message.cam);
    let message = read(&from_hex(EMERGENCY)).unwrap();
    assert_eq!(message.road_users(694_694_401_000).len(), 1);
    assert!(message.standard().starts_with("EN 302 637-2 v1.3.2"));
    // Nothing is sent in this version.
    assert!(message.encode(&Identifiers::default()).is_err());
}

#[test]
fn curvatures_of_release_1_are_brought_to_the_scale_of_version_2() {
    for (old, new) in [
        (0, 0),
        (30_000, 1_022),
        (-30_000, -1_023),
        (30_001, 1_023),
        (299, 99),
    ] {
        let mut octets = from_hex(CAR);
        // Bits 285 to 300, as the vector has -3,000 there.
        let bits = u32::try_from(old + 30_000).unwrap() << 3;
        octets[35] = octets[35] & !7 | u8::try_from(bits >> 16).unwrap();
        octets[36] = u8::try_from(bits >> 8 & 0xff).unwrap();
        octets[37] = octets[37] & 7 | u8::try_from(bits & 0xff).unwrap();
        let ItsMessage::Cam(cam) = read(&octets).unwrap() else {
            panic!("no CAM");
        };
        let json = serde_json::to_value(&cam.cam.cam_parameters.high_frequency_container).unwrap();
        let fast = &json["basicVehicleContainerHighFrequency"];
        assert_eq!(fast["curvature"]["curvatureValue"], new, "{old}");
    }
}

#[test]
fn octets_of_release_1_that_are_cut_off_or_flipped_are_read_or_refused() {
    for digits in [CAR, EMERGENCY] {
        let octets = from_hex(digits);
        for length in 6..octets.len() - 9 {
            assert!(read(&octets[..length]).is_err(), "{digits}: {length}");
        }
        for flipped in flips(&octets) {
            let _ = read(&flipped);
        }
        let longer = [&octets[..], &[0, 0]].concat();
        assert_eq!(read(&longer).is_ok(), digits == EMERGENCY, "{digits}");
    }
}
