//! RAM, RMCM, CAM, VAM and CPM on both dictionaries: what is accepted has a canonical encoding, which
//! is the encoding that it came in or is said not to be.
#![no_main]

use crossguard_codec::its::ItsMessage;
use crossguard_codec::{Dictionary, Identifiers};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|octets: &[u8]| {
    for dictionary in [Dictionary::V2_1_1, Dictionary::V2_4_1] {
        let identifiers = Identifiers {
            dictionary,
            ..Identifiers::default()
        };
        let Ok(received) = ItsMessage::decode(&identifiers, octets) else {
            continue;
        };
        let encoded = received.message.encode(&identifiers).unwrap();
        assert!(encoded == octets || received.extended > 0 || !received.is_canonical);
        let _ = received.message.road_users(694_694_401_000);
    }
});
