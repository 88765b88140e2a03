//! Whether a scenario fits a monotone channel; [`monotone`](crate::monotone) says what that is.

use super::file::File;
use super::location::Wrong;

pub(super) fn check(file: &File) -> Result<(), Wrong> {
    let (channel, bounds) = (file.channel, file.bounds);
    let for_monotone = [("heartbeats", bounds.heartbeats), ("offers", bounds.offers)];
    if !channel.monotone {
        let set = for_monotone.into_iter().find(|(_, bound)| bound.is_some());
        return set.map_or(Ok(()), |(key, _)| {
            let cause = format!(
                "'{key}' bounds runs on a monotone channel only; this one lacks 'monotone = true'"
            );
            Err(Wrong::key(key, cause))
        });
    }
    if channel.delayed > 0 {
        let cause = format!(
            "delayed = {} and 'monotone = true' exclude each other: on a monotone channel every message \
             may arrive late; leave 'delayed' out",
            channel.delayed
        );
        return Err(Wrong::key("delayed", cause));
    }
    let loss = |what: &str| {
        format!(
            "'{what}': a monotone channel decides about no loss, a message that never arrives is lost; it \
             needs 'loss = true' and no 'losses'"
        )
    };
    if !channel.loss {
        return Err(Wrong::key("loss =", loss("loss = false")));
    }
    if bounds.losses.is_some() {
        return Err(Wrong::key("losses", loss("losses")));
    }
    if let Some((key, _)) = for_monotone.into_iter().find(|(_, bound)| bound.is_none()) {
        let cause = format!(
            "'monotone = true' needs '{key} = n' in [bounds]: the channel keeps every message, so without a \
             bound there is no end of states"
        );
        return Err(Wrong::key("monotone", cause));
    }
    if file.cooperative {
        let cause = "'cooperative = true' assumes that messages arrive; on a monotone channel any may never arrive";
        return Err(Wrong::key("cooperative", cause));
    }
    file.refuse(|id| {
        let rule = id.liveness_rule()?;
        rule.broken_by_old_requests.then(|| {
            format!(
                "{id} does not hold of a monotone channel: old requests that arrive again and again make robots \
                 offer for ever; leave it out"
            )
        })
    })
}
