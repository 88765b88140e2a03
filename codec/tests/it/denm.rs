//! DENM: what the event is called, what senders encode otherwise than we do, what is refused, and strings.

use crate::support::{from_bits, from_hex, golden, to_bits};
use crossguard_codec::asn1::cam::DangerousGoodsBasic;
use crossguard_codec::asn1::denm::{
    AlacarteContainer, CompanyName, DENM, DangerousGoodsExtended, PhoneNumber,
    StationaryVehicleContainer, Termination,
};
use crossguard_codec::its::ItsMessage;
use crossguard_codec::{DecodeError, EncodeError, Identifiers, Received, decode, encode};
use rasn::types::NumericString;
use serde_json::json;

/// The extension bit of the management container, behind the header and three presence bits.
const MANAGEMENT_MARKER: usize = 48 + 3;
/// The end of its root: extension bit, presence bits, action, two times, position, station type.
const MANAGEMENT_END: usize = MANAGEMENT_MARKER + 1 + 5 + 48 + 42 + 42 + (31 + 32 + 36 + 24) + 8;
/// The cause, behind extension and presence bits, quality, and the extension bit of the cause.
const CAUSE: usize = MANAGEMENT_END + 1 + 2 + 3 + 1;

fn d1() -> Vec<u8> {
    from_hex(golden::vector(golden::ITS, "D1"))
}

fn read(octets: &[u8]) -> Result<Received<DENM>, DecodeError> {
    decode(&Identifiers::default(), octets)
}

fn denm() -> DENM {
    read(&d1()).unwrap().message
}

fn write(denm: &DENM) -> Result<Vec<u8>, EncodeError> {
    encode(&Identifiers::default(), denm)
}

#[test]
fn an_event_is_told_to_people_by_its_names() {
    let mut denm = denm();
    let told = |denm: &DENM| ItsMessage::Denm(Box::new(denm.clone())).event().unwrap();
    let event = told(&denm);
    assert_eq!(
        event.to_string(),
        "collisionRisk (vulnerableRoadUser), 48.765432 9.123457, event 1 of station 123456789, \
         for 600 s"
    );
    let expected = json!({
        "code": 97, "name": "collisionRisk", "subCode": 4, "subName": "vulnerableRoadUser",
    });
    assert_eq!(serde_json::to_value(event).unwrap()["cause"], expected);
    denm.denm.management.termination = Some(Termination::isCancellation);
    denm.denm.situation = None;
    assert_eq!(
        told(&denm).to_string(),
        "cancelled: 48.765432 9.123457, event 1 of station 123456789"
    );
}

/// The golden DENM with `instead` in the place of these bits.
fn with_bits(at: std::ops::Range<usize>, instead: &str) -> Vec<u8> {
    let mut bits = to_bits(&d1());
    bits.replace_range(at, instead);
    from_bits(&bits)
}

/// Whatever the octets spell out, they say the same as the golden DENM.
fn read_though_not_canonical(octets: &[u8]) {
    assert_ne!(octets, d1());
    let received = read(octets).unwrap();
    assert_eq!(received.message, denm());
    assert!(!received.is_canonical);
    assert_eq!(write(&received.message).unwrap(), d1());
}

#[test]
fn what_release_2_adds_is_skipped() {
    let bits = to_bits(&d1());
    let management = &bits[MANAGEMENT_MARKER + 1..MANAGEMENT_END];
    // Two groups of which the second is present, with two octets.
    let additions = "0000001 01 00000010 10100000 00000001";
    let extended = format!("1{management}{additions}");
    read_though_not_canonical(&with_bits(MANAGEMENT_MARKER..MANAGEMENT_END, &extended));
}

#[test]
fn a_default_that_is_spelled_out_is_read() {
    let bits = to_bits(&d1());
    // Behind the extension bit: termination, distance, direction, validityDuration, interval.
    let presence = MANAGEMENT_MARKER + 1;
    assert_eq!(&bits[presence..presence + 5], "00000");
    let station_type = MANAGEMENT_END - 8;
    // validityDuration is a number from 0 to 86400, in 17 bits, in front of the station type.
    let validity = |seconds: u32| {
        let between = &bits[presence + 5..station_type];
        let instead = format!("00010{between}{seconds:017b}");
        with_bits(presence..station_type, &instead)
    };
    read_though_not_canonical(&validity(600));
    let other = read(&validity(601)).unwrap();
    assert!(other.is_canonical);
    assert_eq!(other.message.denm.management.validity_duration.0, 601);
}

#[test]
fn padding_that_is_not_zero_is_read() {
    // One octet of an open type more would be another message: the traces end in its last octet.
    let (presence, end) = (MANAGEMENT_MARKER + 1, MANAGEMENT_END - 8);
    let management = &to_bits(&d1())[presence + 5..end];
    let mut octets = with_bits(presence..end, &format!("00010{management}{:017b}", 601));
    assert!(read(&octets).unwrap().is_canonical);
    *octets.last_mut().unwrap() |= 1;
    let received = read(&octets).unwrap();
    assert!(!received.is_canonical);
    assert_eq!(received.message.denm.management.validity_duration.0, 601);
}

#[test]
fn a_number_out_of_its_range_is_refused_by_its_name() {
    // Extension and presence bits, action, two times.
    let latitude = MANAGEMENT_MARKER + 1 + 5 + 48 + 42 + 42;
    let octets = with_bits(latitude..latitude + 31, &"1".repeat(31));
    let error = read(&octets).unwrap_err();
    assert_eq!(
        error.to_string(),
        "denm.management.event_position.latitude: 1247483647 is not within -900000000..900000001"
    );
    assert_eq!(error.cause(), "value out of range");
    let mut denm = denm();
    denm.denm.management.event_position.latitude.0 = 900_000_002;
    assert!(matches!(write(&denm), Err(EncodeError::Other(_))));
}

#[test]
fn a_cause_beyond_those_of_release_2_is_read_as_release_1_tells_it() {
    let bits = to_bits(&d1());
    assert_eq!(&bits[CAUSE..CAUSE + 8], format!("{:08b}", 97));
    for cause in [128, 129, 255] {
        let octets = with_bits(CAUSE..CAUSE + 8, &format!("{cause:08b}"));
        let received = read(&octets).unwrap().message;
        let event = received.denm.situation.as_ref().unwrap();
        assert_eq!(event.event_type.cause_code, cause);
        assert_eq!(encode(&Identifiers::default(), &received).unwrap(), octets);
    }
}

/// A vehicle with the dangerous goods of a company.
fn with_goods() -> DENM {
    let phone = PhoneNumber(NumericString::from_bytes(b"0123 456789").unwrap());
    let company = CompanyName("Gefahrgut Söhne 🚧".to_owned());
    let kind = DangerousGoodsBasic::explosives1;
    let goods = DangerousGoodsExtended::new(
        kind,
        1_203,
        false,
        false,
        false,
        None,
        Some(phone),
        Some(company),
    );
    let vehicle = StationaryVehicleContainer::new(None, None, Some(goods), None, None, None);
    let alacarte = AlacarteContainer::new(None, None, None, None, None, Some(vehicle));
    let mut denm = denm();
    denm.denm.alacarte = Some(alacarte);
    denm
}

#[test]
fn strings_come_back_and_are_text_in_json() {
    let denm = with_goods();
    assert_eq!(read(&write(&denm).unwrap()).unwrap().message, denm);
    let value = serde_json::to_value(&denm).unwrap();
    let vehicle = &value["denm"]["alacarte"]["stationaryVehicle"];
    let goods = &vehicle["carryingDangerousGoods"];
    assert_eq!(goods["companyName"], "Gefahrgut Söhne 🚧");
    assert_eq!(goods["phoneNumber"], "0123 456789");
    let again: DENM = serde_json::from_value(value.clone()).unwrap();
    assert_eq!(again, denm);
    let mut wrong = value;
    wrong["denm"]["alacarte"]["stationaryVehicle"]["carryingDangerousGoods"]["phoneNumber"] =
        "+49".into();
    assert!(serde_json::from_value::<DENM>(wrong).is_err());
}
