//! A requester that selects.

use crossguard_protocol::{Coordination, OfferNumber, SessionId, StationId};

use super::{Met, met_when};
use crate::bench::Terms;
use crate::exchange::{Exchange, RamSeen, following, session_of};

statements! {
    "selects-in-time" "R4" selects_in_time:
        "A requester with offers enough leads when t_select is over.";
    "leads-chosen-helpers-alone" "R4" leads_chosen_helpers_alone:
        "A leader lists as many followers as it asked for, each by an offer that was made to its session, and adds nobody.";
    "the-nearer-is-chosen" "R4" nearer_is_chosen:
        "Of two helpers that can do the same, the nearer one is chosen.";
    "unfit-offers-are-not-taken" "R3" unfit_is_not_taken:
        "A helper whose t_safety does not fit the lease is not confirmed.";
    "older-offers-replace-nothing" "R3" newest_offer_is_confirmed:
        "A helper is confirmed by the newest offer that it made.";
}

/// The offers that the tester made to a session: when, by which station, the number, and its `t_safety`.
fn offers(
    exchange: &Exchange,
    to: SessionId,
) -> impl Iterator<Item = (u64, StationId, OfferNumber, u64)> + '_ {
    exchange
        .played_rams()
        .filter_map(move |(at, _, played)| match played.ram.coordination {
            Coordination::OfferHelp {
                session,
                offer,
                t_safety,
                ..
            } if session == to => Some((at, played.ram.station, offer, u64::from(t_safety.0))),
            _ => None,
        })
}

/// The first RAM in which the robot leads each session, with how many followers it had asked for.
pub(super) fn begun(exchange: &Exchange) -> Vec<(u64, SessionId, &RamSeen, Option<u8>)> {
    let mut all: Vec<(u64, SessionId, &RamSeen, Option<u8>)> = Vec::new();
    let mut asked = None;
    for (at, state) in exchange.rams() {
        match (state.ram.coordination, session_of(&state.ram)) {
            (Coordination::NeedHelp { request, .. }, _) => asked = Some(request.followers),
            (Coordination::Leader { .. }, Some(session))
                if all.iter().all(|(_, known, ..)| *known != session) =>
            {
                all.push((at, session, state, asked));
            }
            _ => {}
        }
    }
    all
}

pub(super) fn listed(state: &RamSeen) -> Vec<(StationId, OfferNumber)> {
    match state.ram.coordination {
        Coordination::Leader { followers, .. } => {
            followers.iter().map(|it| (it.station, it.offer)).collect()
        }
        _ => Vec::new(),
    }
}

/// Whether a helper's `t_safety` is long enough for the robot's lease, in whole ms with the drift left out.
fn fits(terms: &Terms, t_safety_ms: u64) -> bool {
    t_safety_ms > terms.ms(|s| s.t_lease) + terms.ms(|s| s.delay_max)
}

fn selects_in_time(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let t_select_ms = terms.ms(|settings| settings.t_select);
    let mut all: Vec<(SessionId, Met)> = Vec::new();
    for (_, state) in exchange.rams() {
        let (Coordination::NeedHelp { request, .. }, Some(session)) =
            (state.ram.coordination, session_of(&state.ram))
        else {
            continue;
        };
        if all.iter().any(|(known, _)| *known == session) {
            continue;
        }
        let mut helpers: Vec<(StationId, u64)> = Vec::new();
        for (at, station, _, t_safety_ms) in offers(exchange, session) {
            let is_known = helpers.iter().any(|(known, _)| *known == station);
            if !is_known && fits(terms, t_safety_ms) {
                helpers.push((station, at));
            }
        }
        let enough = usize::from(request.followers).checked_sub(1);
        let Some((_, at)) = enough.and_then(|last| helpers.get(last)).copied() else {
            continue;
        };
        let limit_ms = t_select_ms + terms.soon_ms();
        let led = exchange.rams().find(|(_, state)| {
            session_of(&state.ram) == Some(session)
                && matches!(state.ram.coordination, Coordination::Leader { .. })
        });
        let broken = match led {
            Some((led, _)) if led <= at + limit_ms => None,
            _ if exchange.undisturbed_until(at) < at + limit_ms => continue,
            _ => Some(format!("within {limit_ms} ms it does not lead")),
        };
        let situation = format!("{} asked for, {} offered", request.followers, helpers.len());
        all.push((session, met_when(at, situation, broken)));
    }
    all.into_iter().map(|(_, met)| met).collect()
}

fn leads_chosen_helpers_alone(exchange: &Exchange, _: &Terms) -> Vec<Met> {
    let judge = |(at, session, state, asked): (u64, SessionId, &RamSeen, Option<u8>)| {
        let listed = listed(state);
        let asked = usize::from(asked?);
        let unknown = listed.iter().find(|(station, number)| {
            let mut made = offers(exchange, session).filter(|(then, ..)| *then <= at);
            !made.any(|(_, by, offer, _)| by == *station && offer == *number)
        });
        let broken = if listed.len() == asked {
            unknown.map(|(station, _)| format!("it lists {station}, which made no such offer"))
        } else {
            Some(format!(
                "it lists {} followers and asked for {asked}",
                listed.len()
            ))
        };
        Some(met_when(at, format!("{asked} asked for"), broken))
    };
    let mut all: Vec<Met> = begun(exchange).into_iter().filter_map(judge).collect();
    all.extend(nobody_is_added(exchange));
    all
}

/// Who says that it follows, and is not listed, is not listed for that.
fn nobody_is_added(exchange: &Exchange) -> Option<Met> {
    let (at, session, who) = exchange.played_rams().find_map(|(at, _, played)| {
        let (session, _) = following(&played.ram)?;
        let (_, state) = exchange.state_at(at)?;
        let is_led = matches!(state.ram.coordination, Coordination::Leader { .. })
            && session_of(&state.ram) == Some(session);
        let who = played.ram.station;
        let is_listed = listed(state).iter().any(|(station, _)| *station == who);
        (is_led && !is_listed).then_some((at, session, who))
    })?;
    let mut later = exchange
        .rams()
        .filter(|(then, state)| *then > at && session_of(&state.ram) == Some(session));
    let added = later.find(|(_, state)| listed(state).iter().any(|(station, _)| *station == who));
    let broken = added.map(|(then, _)| {
        let late_ms = then - at;
        format!("it lists {who} {late_ms} ms after it said that it follows")
    });
    Some(met_when(at, "somebody follows unasked", broken))
}

/// How long before it leads an offer must have been sent to be sure to count, in ms.
const COUNTS_MS: u64 = 120;

fn nearer_is_chosen(exchange: &Exchange, _: &Terms) -> Vec<Met> {
    let [ada, bo] = exchange.players;
    let judge = |(at, session, state, asked): (u64, SessionId, &RamSeen, Option<u8>)| {
        let has_offered = |who: StationId| {
            offers(exchange, session).any(|(then, by, ..)| by == who && then + COUNTS_MS <= at)
        };
        if asked != Some(1) || !has_offered(ada) || !has_offered(bo) {
            return None;
        }
        let is_nearer = listed(state).iter().any(|(station, _)| *station == bo);
        let broken = (!is_nearer).then(|| format!("it chose {ada}, and {bo} is nearer"));
        Some(met_when(at, "two offers", broken))
    };
    begun(exchange).into_iter().filter_map(judge).collect()
}

fn unfit_is_not_taken(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let mut all: Vec<(StationId, Met)> = Vec::new();
    for (_, state) in exchange.rams() {
        let Some(session) = session_of(&state.ram).filter(|it| it.leader == exchange.robot) else {
            continue;
        };
        for (at, station, offer, t_safety_ms) in offers(exchange, session) {
            let is_known = all.iter().any(|(known, _)| *known == station);
            let limit_ms = terms.ms(|settings| settings.t_select) + terms.soon_ms();
            let was_heard = exchange.ended_ms >= at + limit_ms;
            if fits(terms, t_safety_ms) || is_known || !was_heard {
                continue;
            }
            let confirmed = exchange
                .rams()
                .any(|(_, state)| listed(state).contains(&(station, offer)));
            let broken = confirmed
                .then(|| format!("it confirms {station}, whose t_safety is {t_safety_ms} ms"));
            all.push((station, met_when(at, "asking", broken)));
        }
    }
    all.into_iter().map(|(_, met)| met).collect()
}

fn newest_offer_is_confirmed(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let mut all = Vec::new();
    for (at, session, state, _) in begun(exchange) {
        for (station, confirmed) in listed(state) {
            let made = offers(exchange, session).filter(|(then, by, _, t_safety_ms)| {
                *by == station && then + COUNTS_MS <= at && fits(terms, *t_safety_ms)
            });
            let made: Vec<OfferNumber> = made.map(|(_, _, offer, _)| offer).collect();
            let Some(newest) = made.iter().max().copied() else {
                continue;
            };
            if made.iter().all(|offer| *offer == newest) {
                continue;
            }
            let broken = (confirmed < newest).then(|| {
                format!(
                    "it confirms offer {}, and {} was made",
                    confirmed.0, newest.0
                )
            });
            all.push(met_when(at, "an older and a newer offer", broken));
        }
    }
    all
}
