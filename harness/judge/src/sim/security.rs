//! Certificates for simulated robots: the same keys in every run, so that a seed repeats.

use std::sync::OnceLock;

use crossguard_codec::Identifiers;
use crossguard_codec::security::{PrivateKey, Time64};
use crossguard_endpoint::station::{Mode, Secret, Security};
use crossguard_protocol::StationId;
use crossguard_robot::pki::Pki;

use super::world::timestamp_at;

/// How many pseudonyms a robot has.
const TICKETS: usize = 2;

/// After how long a robot changes its pseudonym, in milliseconds: within a run, and not in every session.
const PSEUDONYM_PERIOD_MS: u64 = 20_000;

fn keys(first: usize) -> impl FnMut() -> PrivateKey {
    let mut numbers = first..;
    move || {
        let number = numbers.next().and_then(|number| u8::try_from(number).ok());
        let octets = [number.unwrap_or(u8::MAX >> 1); 32];
        PrivateKey::of_octets(&octets).expect("below the order of the curve")
    }
}

/// The security of the robot at this place, whose first ticket names this station id, `now_ms` milliseconds after the
/// run began.
pub(super) fn of(place: usize, station: StationId, now_ms: u64) -> Security {
    static PKI: OnceLock<Pki> = OnceLock::new();
    let identifiers = Identifiers::default();
    let at = |ms: u64| Time64::of_timestamp_its(timestamp_at(ms));
    let pki = PKI.get_or_init(|| {
        Pki::with_keys(&identifiers, at(0), &mut keys(1)).expect("these are certificates")
    });
    let mut own = keys(3 + place * TICKETS);
    let credentials =
        pki.credentials_with_keys(&identifiers, (TICKETS, Some(station)), at(0), &mut own);
    let credentials = credentials.expect("these are certificates");
    let security = Security::new(
        Mode::Enforce,
        credentials,
        Some(PSEUDONYM_PERIOD_MS),
        at(now_ms),
    );
    let security = security.expect("the first pseudonym is valid");
    let number = u8::try_from(place).unwrap_or(u8::MAX);
    security.with_secret(Secret::new([number; 32]))
}
