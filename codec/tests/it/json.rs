//! Messages and states as JSON, with the names of ASN.1.

use std::fmt::Debug;

use crate::support::core::{Random, octets_of};
use crate::support::reference::Reference;
use crate::support::{arbitrary, samples};
use crossguard_codec::asn1;
use crossguard_codec::asn1::denm::DENM;
use crossguard_codec::asn1::vam::VAM;
use crossguard_codec::core::Uper;
use crossguard_codec::core::cdd::{SpeedValue, VruClusterProfiles};
use crossguard_codec::core::ram::{ConfirmedFollowers, RAM};
use crossguard_codec::core::rmcm::RMCM;
use crossguard_codec::{Identifiers, Message, RobotState, TaskParameters, core};
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
        keeps(&arbitrary::foreign::<VAM>(seed));
        keeps(&arbitrary::foreign::<DENM>(seed));
    }
}

/// What the core writes is what the reference writes, and both read it. What the reference writes is
/// read by the core if the core reads the encoding of the same value, and for the same value.
fn agree<T, R>(seed: u64)
where
    T: Uper + Serialize + DeserializeOwned + Debug,
    R: rasn::Encode + rasn::Decode + Serialize + DeserializeOwned + PartialEq + Debug,
{
    let random = &mut Random(seed);
    let of_core = T::arbitrary(random);
    let json = serde_json::to_string(&of_core).unwrap();
    let of_reference = asn1::decode::<R>(&octets_of(&of_core)).unwrap().value;
    assert_eq!(json, serde_json::to_string(&of_reference).unwrap());
    assert_eq!(serde_json::from_str::<T>(&json).unwrap(), of_core);
    assert_eq!(serde_json::from_str::<R>(&json).unwrap(), of_reference);

    let of_reference: R = arbitrary::any(random.next());
    let json = serde_json::to_string(&of_reference).unwrap();
    let octets = asn1::encode(&of_reference).unwrap();
    let decoded = core::decode::<T>(&octets).map(|(value, _)| value);
    assert_eq!(serde_json::from_str::<T>(&json).ok(), decoded.ok());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2_048))]

    #[test]
    fn a_ram_has_the_json_of_the_reference(seed: u64) {
        agree::<RAM, asn1::ram::RAM>(seed);
    }

    #[test]
    fn an_rmcm_has_the_json_of_the_reference(seed: u64) {
        agree::<RMCM, asn1::rmcm::RMCM>(seed);
    }
}

#[test]
fn a_number_that_is_not_one_of_its_type_is_refused() {
    let error = |text| {
        serde_json::from_str::<SpeedValue>(text)
            .unwrap_err()
            .to_string()
    };
    assert_eq!(error("16384"), "16384 is not a number from 0 to 16383");
    assert_eq!(error("-1"), "-1 is not a number from 0 to 16383");
    assert!(serde_json::from_str::<SpeedValue>("1.5").is_err());
    assert_eq!(serde_json::from_str("16383").ok(), SpeedValue::new(16_383));
}

#[test]
fn a_list_whose_size_is_not_one_of_its_type_is_refused() {
    let follower = json!({ "stationID": 1, "offerNumber": 1 });
    for (length, is_read) in [(0, false), (1, true), (16, true), (17, false)] {
        let followers = json!(vec![follower.clone(); length]);
        let read = serde_json::from_value::<ConfirmedFollowers>(followers);
        assert_eq!(read.is_ok(), is_read);
        if let Err(error) = read {
            let size = format!("invalid length {length}, expected a list of 1 to 16 items");
            assert_eq!(error.to_string(), size);
        }
    }
}

#[test]
fn the_padding_of_a_bit_string_is_zero() {
    let read = |text: &str| serde_json::from_value::<VruClusterProfiles>(text.into());
    assert_eq!(read("90").unwrap(), VruClusterProfiles::new(0b1001));
    assert!(read("98").is_err());
    assert!(read("9").is_err());
}

#[test]
fn a_component_with_a_default_may_be_left_out() {
    let place = json!({ "latitude": 1, "longitude": 2 });
    let point = json!({ "deltaLatitude": 1, "deltaLongitude": 2 });
    let of_core: core::cdd::GeoPosition = serde_json::from_value(place.clone()).unwrap();
    assert_eq!(of_core.altitude.get(), 800_001);
    let of_rasn: asn1::cdd::GeoPosition = serde_json::from_value(place).unwrap();
    assert_eq!(of_rasn.altitude.0, 800_001);
    let of_core: core::cdd::PathPointPredicted = serde_json::from_value(point.clone()).unwrap();
    assert_eq!(of_core.delta_altitude.get(), 12_800);
    assert_eq!(
        of_core.altitude_confidence,
        core::cdd::AltitudeConfidence::Unavailable
    );
    let of_rasn: asn1::cdd::PathPointPredicted = serde_json::from_value(point).unwrap();
    assert_eq!(of_rasn.delta_altitude.0, 12_800);
    // What has no default is wanted.
    assert!(serde_json::from_value::<core::cdd::GeoPosition>(json!({ "latitude": 1 })).is_err());
}
