//! When pseudonyms begin to be valid: each at another moment, so that the moment does not tell whose they are.

use crossguard_codec::security::{Certificate, Duration, Time64, random_octets};

use super::EARLY_S;

/// The share of their time by which pseudonyms begin before they are wanted, at most.
const EARLY_SHARE: u64 = 10;

/// How long before it is wanted a pseudonym that is valid for so long begins at most, in µs.
#[must_use]
pub const fn early_us(duration: Duration) -> u64 {
    duration.microseconds() / EARLY_SHARE
}

/// A start for a pseudonym that is wanted at `from`, drawn from the time before, in which its issuer is valid.
#[must_use]
pub fn drawn_start(issuer: &Certificate, from: Time64, duration: Duration) -> Time64 {
    let drawn = random_octets().into_iter().take(8);
    let drawn = drawn.fold(0, |drawn, octet| drawn << 8 | u64::from(octet));
    start_of(issuer, from, duration, drawn)
}

/// [`drawn_start`] by this number.
pub(super) fn start_of(
    issuer: &Certificate,
    from: Time64,
    duration: Duration,
    drawn: u64,
) -> Time64 {
    let earliest = issuer.content().validity.from().0 + EARLY_S * 1_000_000;
    let span_us = early_us(duration).min(from.0.saturating_sub(earliest));
    Time64(from.0 - drawn % (span_us + 1))
}
