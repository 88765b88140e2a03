//! Messages and states as JSON, with the names of ASN.1.

use std::fmt::Debug;

use crate::support::core::Random;
use crate::support::{arbitrary, samples};
use crossguard_codec::asn1;
use crossguard_codec::asn1::cdd::{
    AltitudeConfidence, GeoPosition, PathPointPredicted, VruClusterProfiles,
};
use crossguard_codec::asn1::vam::VAM;
use crossguard_codec::core::{Uper, ram::RAM, rmcm::RMCM};
use crossguard_codec::{Identifiers, Message, RobotState, TaskParameters};
use proptest::prelude::*;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};

#[test]
fn fields_and_alternatives_have_the_names_of_asn1() {
    let ram = serde_json::to_value(samples::typical_ram(&Identifiers::default())).unwrap();
    let parameters = &ram["ram"]["ramParameters"];
    let altitude = &parameters["basicContainer"]["referencePosition"]["altitude"];
    assert_eq!(altitude["altitudeConfidence"], "alt-001-00");
    assert_eq!(
        parameters["robotStatusContainer"]["helpStatus"],
        "roleConfirmed"
    );
    let role = &parameters["robotLeaderFollowerOperationContainer"]["role"];
    assert_eq!(role["follower"]["session"]["leaderStationID"], 123_456_789);
    let last = json!({ "requestID": 3, "progress": { "executing": null } });
    assert_eq!(role["follower"]["lastCommand"], last);
}

#[test]
fn bit_strings_are_hexadecimal_text() {
    let (_, idle) = &samples::golden(&Identifiers::default())[0];
    let mut json = serde_json::to_value(idle).unwrap();
    let slow = &mut json["ram"]["ram"]["ramParameters"]["robotLowFrequencyContainer"];
    assert_eq!(slow["supportedTasks"], "e000"); // 0, 1 and 2
    assert_eq!(slow["capabilities"], "28"); // 2 and 4
    for wrong in ["e0", "e0000", "g000"] {
        let slow = &mut json["ram"]["ram"]["ramParameters"]["robotLowFrequencyContainer"];
        slow["supportedTasks"] = wrong.into();
        let read = serde_json::from_value::<Message>(json.clone());
        assert!(read.is_err(), "{wrong}");
    }
}

#[test]
fn a_message_says_which_it_is() {
    let message = Message::Rmcm(samples::answer_rmcm(&Identifiers::default()));
    let json = serde_json::to_value(message).unwrap();
    assert!(matches!(&json, Value::Object(fields) if fields.keys().eq(["rmcm"])));
    assert_eq!(serde_json::from_value::<Message>(json).unwrap(), message);
}

#[test]
fn states_and_parameters_name_only_what_they_say() {
    let state: RobotState = serde_json::from_value(json!({
        "position": { "latitude": 48.5, "longitude": 9.5 },
        "speed": { "value": 1.25 },
        "category": "quadruped",
    }))
    .unwrap();
    assert_eq!(state.position.latitude, Some(48.5));
    assert_eq!(state.speed, Some(1.25.into()));
    let parameters: TaskParameters =
        serde_json::from_value(json!({ "target": { "lane": 2 }, "validity": 500 })).unwrap();
    let json = serde_json::to_string(&parameters).unwrap();
    assert_eq!(
        serde_json::from_str::<TaskParameters>(&json).unwrap(),
        parameters
    );
}

fn keeps<M: Serialize + DeserializeOwned + PartialEq + Debug>(message: &M) {
    let json = serde_json::to_string(message).unwrap();
    assert_eq!(&serde_json::from_str::<M>(&json).unwrap(), message);
}

proptest! {
    #[test]
    fn json_keeps_every_message(seed: u64) {
        let random = &mut Random(seed);
        keeps(&RAM::arbitrary(random));
        keeps(&RMCM::arbitrary(random));
        keeps(&arbitrary::any::<asn1::ram::RAM>(seed));
        keeps(&arbitrary::any::<asn1::rmcm::RMCM>(seed));
        keeps(&arbitrary::foreign::<VAM>(seed));
    }
}

#[test]
fn what_no_message_can_say_is_refused() {
    let golden = samples::golden(&Identifiers::default());
    let (_, leads) = golden.iter().find(|(name, _)| *name == "leads").unwrap();
    let parameters = "/ram/ram/ramParameters";
    let follower = json!({ "stationID": 1, "offerNumber": 1 });
    let followers = |length| json!(vec![follower.clone(); length]);
    let speed = "robotHighFrequencyContainer/speed/speedValue";
    let leader = "robotLeaderFollowerOperationContainer/role/leader/followers";
    for (field, value, is_read) in [
        (speed, json!(16_383), true),
        (speed, json!(16_384), false),
        (speed, json!(-1), false),
        (speed, json!(1.5), false),
        (leader, followers(0), false),
        (leader, followers(1), true),
        (leader, followers(16), true),
        (leader, followers(17), false),
    ] {
        let mut json = serde_json::to_value(leads).unwrap();
        *json.pointer_mut(&format!("{parameters}/{field}")).unwrap() = value.clone();
        let read = serde_json::from_value::<Message>(json);
        assert_eq!(read.is_ok(), is_read, "{field} {value}: {read:?}");
    }
}

#[test]
fn the_padding_of_a_bit_string_is_zero() {
    let read = |text: &str| serde_json::from_value::<VruClusterProfiles>(text.into());
    let octets = asn1::encode(&read("90").unwrap()).unwrap();
    assert_eq!(octets, [0x90]);
    assert!(read("98").is_err());
    assert!(read("9").is_err());
}

#[test]
fn a_component_with_a_default_may_be_left_out() {
    let place = json!({ "latitude": 1, "longitude": 2 });
    let point = json!({ "deltaLatitude": 1, "deltaLongitude": 2 });
    let place: GeoPosition = serde_json::from_value(place).unwrap();
    assert_eq!(place.altitude.0, 800_001);
    let point: PathPointPredicted = serde_json::from_value(point).unwrap();
    assert_eq!(point.delta_altitude.0, 12_800);
    assert_eq!(point.altitude_confidence, AltitudeConfidence::unavailable);
    // What has no default is wanted.
    assert!(serde_json::from_value::<GeoPosition>(json!({ "latitude": 1 })).is_err());
}
