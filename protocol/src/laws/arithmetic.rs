//! Arithmetic of serial numbers and times, written once more for the laws that judge by it.

use crate::config::{Config, Settings};
use crate::id::{Heartbeat, RequestId};
use crate::time::{Countdown, Millis};

/// RFC 1982, in 16 bits.
pub(super) const fn beat_is_newer(beat: Heartbeat, known: Heartbeat) -> bool {
    matches!(beat.0.wrapping_sub(known.0), 1..0x8000)
}

/// RFC 1982, in 8 bits.
pub(super) const fn request_is_newer(request: RequestId, known: RequestId) -> bool {
    matches!(request.0.wrapping_sub(known.0), 1..0x80)
}

/// The time that is left, in ms; none where nothing runs.
pub(super) fn left_ms(countdown: Countdown) -> u64 {
    u64::from(countdown.left().unwrap_or(Millis::ZERO).0)
}

/// How long ago a heartbeat was sent, in ms: the periods since then, and what has passed of this one.
pub(super) fn age_ms(
    config: &Config,
    newest: Heartbeat,
    heartbeat: Heartbeat,
    next_ram: Millis,
) -> u64 {
    let period = u64::from(config.settings().ram_period.0);
    let periods = u64::from(newest.0.wrapping_sub(heartbeat.0));
    (periods + 1) * period - period.min(next_ram.0.into())
}

/// True if a timer of `own_ms` is over before one of `theirs_ms`, on any two clocks.
pub(super) fn is_over_before(settings: &Settings, own_ms: u64, theirs_ms: u64) -> bool {
    let (own, theirs) = latest_and_earliest(settings, own_ms, theirs_ms);
    own < theirs
}

/// The latest end of a timer of `own_ms` on the slowest clock, with the time by which its endpoint may be late, and the
/// earliest end of one of `theirs_ms` on the fastest clock, in one unit.
fn latest_and_earliest(settings: &Settings, own_ms: u64, theirs_ms: u64) -> (u64, u64) {
    let (million, drift) = (1_000_000, u64::from(settings.drift_ppm));
    let slowest = million - drift.min(million);
    let own_ms = own_ms + u64::from(settings.delay_max.0);
    (own_ms * (million + drift), theirs_ms * slowest)
}

/// True if a reservation of `t_offer` on the fastest clock outlasts `time_ms` on the slowest, what an endpoint
/// may be late by, and the millisecond to which both count.
pub(super) fn a_reservation_outlasts(config: &Config, time_ms: u64) -> bool {
    let settings = config.settings();
    let (own, reservation) = latest_and_earliest(settings, time_ms + 1, settings.t_offer.0.into());
    own <= reservation
}
