//! The security envelope, as it is read before anything is verified, and certificates.
#![no_main]

use crossguard_codec::security::{Certificate, SignedMessage};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|octets: &[u8]| {
    let _ = SignedMessage::decode(octets);
    let _ = Certificate::decode(octets);
    let _ = crossguard_endpoint::station::listen::peek(octets);
});
