//! Whether a scenario fits a monotone channel; [`monotone`](crate::monotone) says what that is.

use toml::Spanned;

use super::location::Location;
use super::setup::{Bounds, ChannelSetup};
use crate::properties::PropertyId;

/// What does not fit a monotone channel.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Misfit {
    /// Delayed messages are counted.
    #[error(
        "delayed = {0} and 'monotone = true' exclude each other: on a monotone channel every message \
         may arrive late; leave 'delayed' out"
    )]
    Delayed(u8),
    /// Loss is decided about.
    #[error(
        "'{0}': a monotone channel decides about no loss, a message that never arrives is lost; it \
         needs 'loss = true' and no 'losses'"
    )]
    Loss(&'static str),
    /// The set of messages would grow for ever.
    #[error(
        "'monotone = true' needs '{0} = n' in [bounds]: the channel keeps every message, so without a \
         bound there is no end of states"
    )]
    Unbounded(&'static str),
    /// A bound for a monotone channel only.
    #[error("'{0}' bounds runs on a monotone channel only; this one lacks 'monotone = true'")]
    NotMonotone(&'static str),
    /// Messages are assumed to arrive.
    #[error(
        "'cooperative = true' assumes that messages arrive; on a monotone channel any may never arrive"
    )]
    Cooperative,
    /// A property that does not hold of such a channel.
    #[error(
        "{0} does not hold of a monotone channel: old requests that arrive again and again make robots \
         offer for ever; leave it out"
    )]
    Property(PropertyId),
}

/// Whether a scenario's channel and what is said of it fit together.
pub(super) fn check(
    channel: ChannelSetup,
    bounds: Bounds,
    cooperative: bool,
    properties: &[Spanned<String>],
) -> Result<(), (Location, Misfit)> {
    let for_monotone = [("heartbeats", bounds.heartbeats), ("offers", bounds.offers)];
    if !channel.monotone {
        let set = for_monotone.into_iter().find(|(_, bound)| bound.is_some());
        return set.map_or(Ok(()), |(key, _)| {
            Err((Location::Key(key), Misfit::NotMonotone(key)))
        });
    }
    if channel.delayed > 0 {
        return Err((Location::Key("delayed"), Misfit::Delayed(channel.delayed)));
    }
    if !channel.loss {
        return Err((Location::Key("loss ="), Misfit::Loss("loss = false")));
    }
    if bounds.losses.is_some() {
        return Err((Location::Key("losses"), Misfit::Loss("losses")));
    }
    if let Some((key, _)) = for_monotone.into_iter().find(|(_, bound)| bound.is_none()) {
        return Err((Location::Key("monotone"), Misfit::Unbounded(key)));
    }
    if cooperative {
        return Err((Location::Key("cooperative"), Misfit::Cooperative));
    }
    for name in properties {
        if let Ok(id) = name.get_ref().parse::<PropertyId>()
            && let Some(rule) = id.liveness_rule()
            && rule.broken_by_old_requests
        {
            return Err((Location::Offset(name.span().start), Misfit::Property(id)));
        }
    }
    Ok(())
}
