//! `GeoNetworking` and BTP headers, the stack, and Ethernet frames.
#![no_main]

use crossguard_codec::Identifiers;
use crossguard_codec::geonet::{Address, EgoPosition, Envelope, Stack, ethernet, laws};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|octets: &[u8]| {
    let _is_accepted = laws::what_is_accepted_is_canonical(octets);
    let _ = ethernet::packet(octets);
    let address = Address::of_station(1, 12);
    let mut stack = Stack::new(Identifiers::default(), address, Envelope::Off);
    let ego = EgoPosition {
        timestamp_its: 694_694_401_000,
        coordinates: Some((487_654_321, 91_234_567)),
        ..EgoPosition::default()
    };
    let _ = stack.receive(&ego, octets);
});
