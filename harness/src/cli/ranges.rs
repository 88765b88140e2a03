//! Numbers that options take. A number out of its range is refused with the range.

use std::net::SocketAddrV4;
use std::num::NonZeroUsize;
use std::ops::RangeInclusive;
use std::str::FromStr;

use clap::{Arg, Command};
use crossguard_protocol::StationId;

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
    number(min..=max)(text).map_err(|wanted| format!("{wanted} ({why})"))
}

/// Takes a number of this range.
pub(super) fn number(
    range: RangeInclusive<f64>,
) -> impl Fn(&str) -> Result<f64, String> + Clone + Send + Sync {
    move |text| {
        let value = text.parse().ok().filter(|value| range.contains(value));
        value.ok_or_else(|| {
            format!(
                "a number from {} to {} is wanted",
                range.start(),
                range.end()
            )
        })
    }
}

/// Takes a whole number of this range.
pub(super) fn whole<T: TryFrom<i128>>(
    range: RangeInclusive<i128>,
) -> impl Fn(&str) -> Result<T, String> + Clone + Send + Sync {
    move |text| {
        let value = text.parse().ok().filter(|value| range.contains(value));
        let value = value.and_then(|value| T::try_from(value).ok());
        value.ok_or_else(|| {
            let (start, end) = (range.start(), range.end());
            format!("a whole number from {start} to {end} is wanted")
        })
    }
}

/// A station id. No station is 0.
pub(super) fn station(text: &str) -> Result<StationId, String> {
    let id = whole(1..=u32::MAX.into())(text);
    let wanted = "a station id from 1 to 4294967295 is wanted";
    id.map(StationId).map_err(|_| wanted.to_owned())
}

/// Any number that a `u64` holds, as seeds are.
pub(super) fn any(text: &str) -> Result<u64, String> {
    whole(0..=u64::MAX.into())(text)
}

/// How many threads there are to be.
pub(super) fn threads(text: &str) -> Result<NonZeroUsize, String> {
    at_least_one(1_024)(text)
}

/// A whole number from 1 to `max`.
pub(super) fn at_least_one(
    max: u64,
) -> impl Fn(&str) -> Result<NonZeroUsize, String> + Clone + Send + Sync {
    move |text| {
        let value = whole::<usize>(1..=max.into())(text)?;
        Ok(NonZeroUsize::new(value).unwrap_or(NonZeroUsize::MIN))
    }
}

/// An address and a port.
pub(super) fn address<T: FromStr>(text: &str) -> Result<T, String> {
    let wanted = "an address and a port like 127.0.0.1:3000 is wanted";
    text.parse().map_err(|_| wanted.to_owned())
}

/// A multicast group and a port.
pub(super) fn group(text: &str) -> Result<SocketAddrV4, String> {
    let group = text.parse::<SocketAddrV4>().ok();
    let group = group.filter(|it| it.ip().is_multicast());
    group.ok_or_else(|| "a multicast group and a port like 239.118.50.1:47400 is wanted".to_owned())
}

/// The same command, in which `--option -5` is the option with a value, and not two options: the value is
/// then refused with its range.
pub(super) fn with_negative_numbers(command: Command) -> Command {
    let takes = |arg: Arg| {
        let is_option = !arg.is_positional() && arg.get_action().takes_values();
        if is_option {
            arg.allow_negative_numbers(true)
        } else {
            arg
        }
    };
    command
        .mut_args(takes)
        .mut_subcommands(with_negative_numbers)
}
