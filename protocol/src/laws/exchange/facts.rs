//! Implications between facts, and who makes which known.

use super::{Exchange, Heard, History};
use crate::id::StationId;

/// Implications between facts, for leader and follower alike. Each consequence is known before its cause becomes known,
/// and stays known.
#[must_use]
pub fn are_consistent(exchange: &Exchange, history: &History) -> bool {
    let History {
        requested,
        ended,
        listed,
        dropped,
        beaten,
        commanded,
        offered,
        joined,
        left,
        heard,
        accepted,
        refused,
        started,
        newer_started,
        in_position: _,
        completed: _,
        fell_back,
        over,
    } = *history;
    (requested || (!ended && !dropped && !beaten && listed.is_none()))
        && (offered || listed != Some(exchange.offer))
        // I2: a follower was listed.
        && (listed.is_some() || (!joined && commanded.is_none()))
        // I10: a heartbeat that is heard was sent.
        && ((joined && beaten) || heard.is_none())
        && (over || heard != Some(Heard::AfterTheEnd))
        && (joined || (!left && !accepted && !refused && !newer_started))
        // I3: an answered request was commanded.
        && (commanded.is_some() || (!accepted && !refused))
        && !(accepted && refused)
        // I6: an accepted request is started in the same step, and nothing else is.
        && started == accepted
        && (started || !over)
        && (over || !fell_back)
}

/// True if all that is known before is known after, as it was.
#[must_use]
pub fn only_grow(before: &History, after: &History) -> bool {
    the_leaders_only_grow(before, after) && the_followers_only_grow(before, after)
}

fn grows<T: Copy + PartialEq>(before: Option<T>, after: Option<T>) -> bool {
    before.is_none() || before == after
}

fn the_leaders_only_grow(before: &History, after: &History) -> bool {
    (!before.requested || after.requested)
        && (!before.ended || after.ended)
        && grows(before.listed, after.listed)
        && (!before.dropped || after.dropped)
        && (!before.beaten || after.beaten)
        && grows(before.commanded, after.commanded)
}

fn the_followers_only_grow(before: &History, after: &History) -> bool {
    (!before.offered || after.offered)
        && (!before.joined || after.joined)
        && (!before.left || after.left)
        && grows(before.heard, after.heard)
        && (!before.accepted || after.accepted)
        && (!before.refused || after.refused)
        && (!before.started || after.started)
        && (!before.newer_started || after.newer_started)
        && (!before.in_position || after.in_position)
        && (!before.completed || after.completed)
        && (!before.fell_back || after.fell_back)
        && (!before.over || after.over)
}

/// True if all facts are as they were that are not those of `station`.
#[must_use]
pub fn are_only_of(
    exchange: &Exchange,
    station: StationId,
    before: &History,
    after: &History,
) -> bool {
    (exchange.is_led_by(station) || the_leaders_only_grow(after, before))
        && (station == exchange.follower || the_followers_only_grow(after, before))
}

/// The history in which the facts of `station` are those of `own`, and those of all others are as in `others`.
#[must_use]
pub fn with_others(
    exchange: &Exchange,
    station: StationId,
    own: &History,
    others: &History,
) -> History {
    let (leaders, followers) = if exchange.is_led_by(station) {
        (own, others)
    } else if station == exchange.follower {
        (others, own)
    } else {
        (others, others)
    };
    History {
        requested: leaders.requested,
        ended: leaders.ended,
        listed: leaders.listed,
        dropped: leaders.dropped,
        beaten: leaders.beaten,
        commanded: leaders.commanded,
        ..*followers
    }
}
