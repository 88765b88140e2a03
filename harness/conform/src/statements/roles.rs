//! Confirmations: which robot follows which.

use crossguard_protocol::{Coordination, Farewell, OfferNumber, SessionId};

use super::{Met, due, met, met_when};
use crate::bench::Terms;
use crate::exchange::{Exchange, Happening, Message, following, offer_of, session_of};

statements! {
    "follows-the-leader-that-listed-it" "R2" follows_only_confirmed:
        "A robot follows only after a leader has listed the offer that it made to that session.";
    "takes-the-role" "R2" takes_the_role:
        "A robot whose standing offer is listed follows.";
    "not-listed-is-released" "R2" not_listed_is_released:
        "A helper or follower that its leader does not list, or lists for another offer, has no part any more.";
    "declines-what-does-not-stand" "R2" declines_what_lapsed:
        "A robot that is listed for an offer that has lapsed names the session as left.";
}

/// The offer that the robot made to a session, the newest by `until_ms`.
fn offer_to(exchange: &Exchange, session: SessionId, until_ms: u64) -> Option<OfferNumber> {
    let mut offers = exchange.rams().filter(|(at, _)| *at <= until_ms);
    offers
        .rfind(|(_, state)| offer_of(&state.ram).is_some_and(|(to, _)| to == session))
        .and_then(|(_, state)| Some(offer_of(&state.ram)?.1))
}

/// The RAM in which a station of the tester leads a session: when, which, and the offer of the robot that it lists.
fn lists(exchange: &Exchange) -> impl Iterator<Item = (u64, SessionId, Option<OfferNumber>)> + '_ {
    exchange.played_rams().filter_map(|(at, _, played)| {
        let Coordination::Leader { followers, .. } = played.ram.coordination else {
            return None;
        };
        let mut followers = followers.iter();
        let listed = followers.find(|it| it.station == exchange.robot);
        Some((at, session_of(&played.ram)?, listed.map(|it| it.offer)))
    })
}

/// The first RAM of each kind in a row.
fn first_lists(exchange: &Exchange) -> Vec<(u64, SessionId, Option<OfferNumber>)> {
    let mut all: Vec<(u64, SessionId, Option<OfferNumber>)> = Vec::new();
    for (at, session, listed) in lists(exchange) {
        let last = all.iter().rev().find(|(_, known, _)| *known == session);
        if last.is_none_or(|(_, _, known)| *known != listed) {
            all.push((at, session, listed));
        }
    }
    all
}

fn follows_only_confirmed(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let mut all = Vec::new();
    let mut known: Vec<SessionId> = Vec::new();
    for (at, state) in exchange.rams() {
        let Some((session, _)) = following(&state.ram) else {
            continue;
        };
        if known.contains(&session) {
            continue;
        }
        known.push(session);
        let own = offer_to(exchange, session, at);
        let is_confirmed = lists(exchange).any(|(then, to, listed)| {
            then <= at && to == session && listed.is_some() && listed == own
        });
        let broken = (!is_confirmed)
            .then(|| format!("it follows in {session} without a confirmation of its offer"));
        all.push(met_when(at, "follows", broken));
    }
    // Where it must not.
    for (at, session, listed) in first_lists(exchange) {
        let own = offer_to(exchange, session, at);
        let follows = exchange
            .state_at(at)
            .and_then(|(_, state)| following(&state.ram));
        let is_wrong = listed.is_some() && listed != own || own.is_none();
        if !is_wrong || follows.is_some_and(|(now, _)| now == session) {
            continue;
        }
        let until_ms = exchange.undisturbed_until(at);
        if until_ms < at + terms.soon_ms() {
            continue;
        }
        let mut after = exchange
            .rams()
            .filter(|(then, _)| (at..until_ms).contains(then));
        let joins =
            after.any(|(_, state)| following(&state.ram).is_some_and(|(now, _)| now == session));
        let broken = joins.then(|| format!("it follows in {session}"));
        let how = match (listed, own) {
            (None, _) => "not listed",
            (Some(_), None) => "listed in a session to which it did not offer",
            (Some(_), Some(_)) => "listed for another offer",
        };
        let situation = format!("{}, {how}", exchange.situation_at(at));
        all.push(met_when(at, situation, broken));
    }
    all
}

/// Whether the robot's newest RAM says that the offer stands.
fn stands(exchange: &Exchange, at_ms: u64, session: SessionId, offer: OfferNumber) -> bool {
    let state = exchange.state_at(at_ms);
    state.is_some_and(|(_, state)| offer_of(&state.ram) == Some((session, offer)))
}

fn takes_the_role(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let judge = |(at, session, listed): (u64, SessionId, Option<OfferNumber>)| {
        if !stands(exchange, at, session, listed?) {
            return None;
        }
        due(
            exchange,
            at,
            terms.soon_ms(),
            "no RAM that follows",
            |seen| {
                matches!(&seen.what, Happening::Said(Message::Ram(state))
                if following(&state.ram).is_some_and(|(now, _)| now == session))
            },
        )
    };
    first_lists(exchange)
        .into_iter()
        .filter_map(judge)
        .collect()
}

fn not_listed_is_released(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let judge = |(at, session, listed): (u64, SessionId, Option<OfferNumber>)| {
        let (_, state) = exchange.state_at(at)?;
        let own = offer_to(exchange, session, at)?;
        if session_of(&state.ram) != Some(session) || listed == Some(own) {
            return None;
        }
        let what = "no RAM without a part in the session";
        due(exchange, at, terms.soon_ms(), what, |seen| {
            matches!(&seen.what, Happening::Said(Message::Ram(state))
                if session_of(&state.ram) != Some(session))
        })
    };
    first_lists(exchange)
        .into_iter()
        .filter_map(judge)
        .collect()
}

fn declines_what_lapsed(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let judge = |(at, session, listed): (u64, SessionId, Option<OfferNumber>)| {
        let offer = listed?;
        let (_, state) = exchange.state_at(at)?;
        let was_made = offer_to(exchange, session, at) == Some(offer);
        if !was_made || session_of(&state.ram).is_some() {
            return None;
        }
        let what = "no RAM that names the session as left";
        let met_here = due(exchange, at, terms.soon_ms(), what, |seen| {
            matches!(&seen.what, Happening::Said(Message::Ram(state))
                if matches!(state.ram.farewell, Some(Farewell::Left(it, _)) if it == session))
        })?;
        Some(met(exchange, at, met_here.broken))
    };
    first_lists(exchange)
        .into_iter()
        .filter_map(judge)
        .collect()
}
