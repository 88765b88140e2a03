//! Time stamps: Unix time, `TimestampIts` and `GenerationDeltaTime`.

/// The largest `TimestampIts`, 42 bits; it is reached in the year 2143.
pub const TIMESTAMP_ITS_MAX: u64 = 4_398_046_511_103;

/// 2004-01-01T00:00:00 UTC in Unix time, in milliseconds.
const EPOCH_UNIX_MS: i64 = 1_072_915_200_000;

/// The instants, in Unix time in milliseconds, before which a leap second was inserted since 2004.
///
/// `TimestampIts` counts leap seconds and Unix time does not, so they drift apart by a second at each;
/// since 2017 by 5. A leap second that is yet to be announced has to be added here.
pub const LEAP_SECONDS_UNIX_MS: [i64; 5] = [
    1_136_073_600_000, // 2006-01-01
    1_230_768_000_000, // 2009-01-01
    1_341_100_800_000, // 2012-07-01
    1_435_708_800_000, // 2015-07-01
    1_483_228_800_000, // 2017-01-01
];

/// The `TimestampIts` of an instant in Unix time: milliseconds since 2004, leap seconds counted
/// (TS 102 894-2 v2.4.1, `TimestampIts`). Saturates before 2004 and at the end.
#[must_use]
pub fn timestamp_its(unix_ms: i64) -> u64 {
    let mut timestamp = unix_ms.saturating_sub(EPOCH_UNIX_MS);
    for leap_second in LEAP_SECONDS_UNIX_MS {
        if unix_ms >= leap_second {
            timestamp = timestamp.saturating_add(1_000);
        }
    }
    u64::try_from(timestamp).unwrap_or(0).min(TIMESTAMP_ITS_MAX)
}

/// The instant in Unix time, in milliseconds, of a `TimestampIts`. Within a leap second, which Unix
/// time does not have, it is the instant after it. Saturates at the end.
#[must_use]
pub fn unix_ms(timestamp_its: u64) -> i64 {
    let timestamp = i64::try_from(timestamp_its.min(TIMESTAMP_ITS_MAX)).unwrap_or(i64::MAX);
    let mut unix_ms = timestamp.saturating_add(EPOCH_UNIX_MS);
    for leap_second in LEAP_SECONDS_UNIX_MS {
        if unix_ms >= leap_second {
            unix_ms = (unix_ms - 1_000).max(leap_second);
        }
    }
    unix_ms
}

/// The `GenerationDeltaTime` of a `TimestampIts`: its lowest 16 bits, in milliseconds.
#[must_use]
pub const fn generation_delta_time(timestamp_its: u64) -> u16 {
    (timestamp_its & 0xFFFF) as u16
}

/// The `TimestampIts` of a message that was received at `now`, a `TimestampIts`: the instant with this
/// `generation_delta_time` that is nearest to `now`, at most 32.767 s before it and 32.768 s after.
///
/// Saturates at the beginning of the time scale.
#[must_use]
pub const fn rebuild_timestamp(now: u64, generation_delta_time: u16) -> u64 {
    let age = (self::generation_delta_time(now)).wrapping_sub(generation_delta_time);
    if age < 0x8000 {
        now.saturating_sub(age as u64)
    } else {
        now.saturating_add(0x1_0000 - age as u64)
    }
}
