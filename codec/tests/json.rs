//! Messages and states as JSON, with the names of ASN.1.

mod support;

use std::fmt::Debug;

use crossguard_codec::asn1;
use crossguard_codec::asn1::denm::DENM;
use crossguard_codec::asn1::vam::VAM;
use crossguard_codec::core::ram::RAM;
use crossguard_codec::{Identifiers, Message, RobotState, TaskParameters};
use proptest::prelude::*;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};
use support::reference::Reference;
use support::{arbitrary, samples};

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
    let ram = samples::largest_ram(&Identifiers::default());
    let ram = serde_json::to_value(ram).unwrap();
    let slow = &ram["ram"]["ramParameters"]["robotLowFrequencyContainer"];
    assert_eq!(slow["supportedTasks"], "e000"); // 0, 1 and 2
    assert_eq!(slow["capabilities"], "28"); // 2 and 4
}

#[test]
fn a_bit_string_of_another_size_is_refused() {
    let mut ram = serde_json::to_value(samples::largest_ram(&Identifiers::default())).unwrap();
    for wrong in ["e0", "e0000", "g000"] {
        ram["ram"]["ramParameters"]["robotLowFrequencyContainer"]["supportedTasks"] = wrong.into();
        assert!(
            serde_json::from_value::<RAM>(ram.clone()).is_err(),
            "{wrong}"
        );
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
        let identifiers = Identifiers::default();
        keeps(&arbitrary::message::<asn1::ram::RAM>(&identifiers, seed));
        keeps(&arbitrary::ram(&identifiers, seed).to_message().unwrap());
        let rmcm = arbitrary::message::<asn1::rmcm::RMCM>(&identifiers, seed);
        keeps(&rmcm);
        keeps(&rmcm.to_message().unwrap());
        keeps(&arbitrary::message::<VAM>(&identifiers, seed));
        keeps(&arbitrary::message::<DENM>(&identifiers, seed));
    }

    #[test]
    fn a_message_has_the_json_of_the_reference(seed: u64) {
        let ram = arbitrary::ram(&Identifiers::default(), seed);
        let message = ram.to_message().unwrap();
        prop_assert_eq!(serde_json::to_value(message).unwrap(), serde_json::to_value(ram).unwrap());
    }
}
