//! A requester that selects.

use crossguard_protocol::{Coordination, OfferNumber, SessionId, StationId};

use super::{Met, Trace, first_of_each, met_when};
use crate::exchange::RamSeen;

statements! {
    "selects-in-time" "R4" selects_in_time:
        "A requester with offers enough leads when t_select is over.";
    "leads-chosen-helpers-alone" "R4" leads_chosen_helpers_alone:
        "A leader lists as many followers as it asked for, each by an offer that was made to its session, and adds nobody.";
    "the-nearer-is-chosen" "R4" nearer_is_chosen of begun:
        "Of two helpers that can do the same, the nearer one is chosen.";
    "unfit-offers-are-not-taken" "R3" unfit_is_not_taken:
        "A helper whose t_safety does not fit the lease is not confirmed.";
    "older-offers-replace-nothing" "R3" newest_offer_is_confirmed:
        "A helper is confirmed by the newest offer that it made.";
}

/// The offers that the tester made to a session: when, by which station, the number, and its `t_safety`.
fn offers(
    trace: &Trace,
    to: SessionId,
) -> impl Iterator<Item = (u64, StationId, OfferNumber, u64)> {
    let played = trace.played_rams();
    played.filter_map(move |(at, played)| match played.ram.coordination {
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
pub(super) fn begun<'a>(trace: &'a Trace) -> Vec<(u64, SessionId, &'a RamSeen, Option<u8>)> {
    let mut asked = None;
    let led = trace.rams().filter_map(|(at, state)| {
        if let Coordination::NeedHelp { request, .. } = state.ram.coordination {
            asked = Some(request.followers);
        }
        Some((at, state.session().filter(|_| state.leads())?, state, asked))
    });
    first_of_each(led, |(_, session, ..)| *session).collect()
}

/// Whether a helper's `t_safety` is long enough for the robot's lease, in whole ms with the drift left out.
fn fits(trace: &Trace, t_safety_ms: u64) -> bool {
    t_safety_ms > trace.ms(|s| s.t_lease) + trace.ms(|s| s.delay_max)
}

fn selects_in_time(trace: &Trace) -> Vec<Met> {
    let limit_ms = trace.ms(|settings| settings.t_select) + trace.soon_ms();
    let judge = |(_, state): (u64, &RamSeen)| {
        let Coordination::NeedHelp { request, .. } = state.ram.coordination else {
            return None;
        };
        let session = state.session()?;
        let fit = offers(trace, session).filter(|(.., t_safety_ms)| fits(trace, *t_safety_ms));
        let helpers: Vec<_> = first_of_each(fit, |(_, station, ..)| *station).collect();
        let (at, ..) = *helpers.get(usize::from(request.followers).checked_sub(1)?)?;
        let led = trace
            .rams()
            .find(|(_, state)| state.leads() && state.session() == Some(session));
        let broken = match led {
            Some((led, _)) if led <= at + limit_ms => None,
            _ if trace.undisturbed_until(at) < at + limit_ms => return None,
            _ => Some(format!("within {limit_ms} ms it does not lead")),
        };
        let situation = format!("{} asked for, {} offered", request.followers, helpers.len());
        Some((session, met_when(at, situation, broken)))
    };
    let selected = first_of_each(trace.rams().filter_map(judge), |(session, _)| *session);
    selected.map(|(_, met)| met).collect()
}

fn leads_chosen_helpers_alone(trace: &Trace) -> Vec<Met> {
    let judge = |(at, session, state, asked): (u64, SessionId, &RamSeen, Option<u8>)| {
        let listed = state.listed();
        let asked = usize::from(asked?);
        let unknown = listed.iter().find(|(station, number)| {
            let mut made = offers(trace, session).filter(|(then, ..)| *then <= at);
            !made.any(|(_, by, offer, _)| by == *station && offer == *number)
        });
        let broken = if listed.len() == asked {
            unknown.map(|(station, _)| format!("it lists {station}, which made no such offer"))
        } else {
            let count = listed.len();
            Some(format!("it lists {count} followers and asked for {asked}"))
        };
        Some(met_when(at, format!("{asked} asked for"), broken))
    };
    let mut all: Vec<Met> = begun(trace).into_iter().filter_map(judge).collect();
    all.extend(nobody_is_added(trace));
    all
}

/// A station that says that it follows, and is not listed, is not listed for that.
fn nobody_is_added(trace: &Trace) -> Option<Met> {
    let (at, session, who) = trace.played_rams().find_map(|(at, played)| {
        let (session, _) = played.following()?;
        let (state, who) = (trace.state_at(at)?, played.ram.station);
        let is_led = state.leads() && state.session() == Some(session);
        (is_led && !state.lists(who)).then_some((at, session, who))
    })?;
    let mut later = trace.rams().filter(|(then, _)| *then > at);
    let added = later.find(|(_, state)| state.session() == Some(session) && state.lists(who));
    let broken = added.map(|(then, _)| {
        let late_ms = then - at;
        format!("it lists {who} {late_ms} ms after it said that it follows")
    });
    Some(met_when(at, "somebody follows unasked", broken))
}

/// How long before it leads an offer must have been sent to be sure to count, in ms.
const COUNTS_MS: u64 = 120;

fn nearer_is_chosen(
    trace: &Trace,
    (at, session, state, asked): (u64, SessionId, &RamSeen, Option<u8>),
) -> Option<Met> {
    let [ada, bo] = trace.players;
    let has_offered = |who: StationId| {
        offers(trace, session).any(|(then, by, ..)| by == who && then + COUNTS_MS <= at)
    };
    if asked != Some(1) || !has_offered(ada) || !has_offered(bo) {
        return None;
    }
    let broken = (!state.lists(bo)).then(|| format!("it chose {ada}, and {bo} is nearer"));
    Some(met_when(at, "two offers", broken))
}

fn unfit_is_not_taken(trace: &Trace) -> Vec<Met> {
    let limit_ms = trace.ms(|settings| settings.t_select) + trace.soon_ms();
    let sessions = trace.rams().filter_map(|(_, state)| state.session());
    let own = first_of_each(sessions, |session| *session).filter(|it| it.leader == trace.robot);
    let unfit = own.flat_map(|session| offers(trace, session));
    let unfit = unfit.filter(|(at, .., t_safety_ms)| {
        !fits(trace, *t_safety_ms) && trace.ended_ms >= at + limit_ms
    });
    let judge = |(at, station, offer, t_safety_ms): (u64, StationId, OfferNumber, u64)| {
        let mut rams = trace.rams();
        let confirmed = rams.any(|(_, state)| state.listed().contains(&(station, offer)));
        let broken =
            confirmed.then(|| format!("it confirms {station}, whose t_safety is {t_safety_ms} ms"));
        met_when(at, "asking", broken)
    };
    let first = first_of_each(unfit, |(_, station, ..)| *station);
    first.map(judge).collect()
}

fn newest_offer_is_confirmed(trace: &Trace) -> Vec<Met> {
    let mut all = Vec::new();
    for (at, session, state, _) in begun(trace) {
        for (station, confirmed) in state.listed() {
            let made = offers(trace, session).filter(|(then, by, _, t_safety_ms)| {
                *by == station && then + COUNTS_MS <= at && fits(trace, *t_safety_ms)
            });
            let made: Vec<OfferNumber> = made.map(|(_, _, offer, _)| offer).collect();
            let (oldest, newest) = (made.iter().min(), made.iter().max());
            let Some(newest) = newest.filter(|newest| oldest != Some(*newest)) else {
                continue;
            };
            let broken = (confirmed < *newest).then(|| {
                let (confirmed, newest) = (confirmed.0, newest.0);
                format!("it confirms offer {confirmed}, and {newest} was made")
            });
            all.push(met_when(at, "an older and a newer offer", broken));
        }
    }
    all
}
