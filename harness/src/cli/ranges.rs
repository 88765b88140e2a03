//! Numbers that options take, with their ranges.

/// How many times as fast as real the robots' bodies move.
pub(super) fn speed(text: &str) -> Result<f64, String> {
    in_range(
        text,
        1.0,
        100.0,
        "slower than real time, a maneuver would exceed its limit",
    )
}

/// A number from `min` to `max`; `why` not less or more.
pub(super) fn in_range(text: &str, min: f64, max: f64, why: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if (min..=max).contains(&value) => Ok(value),
        _ => Err(format!("a number from {min} to {max} is wanted ({why})")),
    }
}
