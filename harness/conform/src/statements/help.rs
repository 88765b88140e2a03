//! Requests and offers.

use crossguard_protocol::{
    Availability, Coordination, Farewell, Heartbeat, HelpRequest, SessionId, SessionNumber,
    StationId, TaskSet, UniqueNumber,
};

use super::{Met, due, is_in_contact, met, met_when, news};
use crate::bench::Terms;
use crate::exchange::{Exchange, Happening, Message, RamSeen, offer_of, session_of};
use crate::subject::Local;

statements! {
    "free-robots-offer" "R3" free_robots_offer:
        "A robot that is free and can do one of the tasks offers, with those tasks.";
    "offers-are-for-what-can-be-done" "R3" impossible_gets_no_offer:
        "A robot that can do none of the tasks does not offer.";
    "offers-lapse-after-t-offer" "R3" offers_lapse:
        "An offer lapses when t_offer is over since the newest heartbeat of the request, and not before.";
    "offers-go-to-one-requester" "R3" one_requester:
        "A robot that offers to one requester, or follows, offers to nobody else.";
    "robots-on-duty-do-not-offer" "R20" on_duty_does_not_offer:
        "A robot that is on duty offers to nobody, and asks nobody.";
    "unavailable-robots-do-not-offer" "R24" unavailable_does_not_offer:
        "An unavailable robot offers to nobody.";
    "pedestrians-are-asked-for" "R4" pedestrians_are_asked_for:
        "A robot that has detected a pedestrian asks for as many followers as it needs.";
    "requests-end-at-t-help" "R5" requests_end:
        "A request that nobody meets is named as aborted when t_help is over, and not before.";
    "numbers-never-repeat" "R1" numbers_grow:
        "Numbers of sessions and offers only grow, also after the robot lost power.";
}

/// A request that was played: when first, by which session, and how long it was played on.
struct Request {
    at_ms: u64,
    session: SessionId,
    asked: HelpRequest,
}

fn requests(exchange: &Exchange) -> Vec<Request> {
    let mut all: Vec<Request> = Vec::new();
    for (at_ms, _, played) in exchange.played_rams() {
        if let (Coordination::NeedHelp { request, .. }, Some(session)) =
            (played.ram.coordination, session_of(&played.ram))
            && all.iter().all(|known| known.session != session)
        {
            all.push(Request {
                at_ms,
                session,
                asked: request,
            });
        }
    }
    all
}

fn offers_to(session: SessionId) -> impl Fn(&RamSeen) -> bool {
    move |state| offer_of(&state.ram).is_some_and(|(to, _)| to == session)
}

fn free_robots_offer(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let can = terms.settings.capabilities;
    let judge = |it: Request| {
        let (_, state) = exchange.state_at(it.at_ms)?;
        let tasks = can.intersection(it.asked.tasks);
        let is_free = state.ram.coordination == Coordination::None
            && !state.ram.on_duty
            && state.availability == Availability::Available;
        if !is_free || tasks.is_empty() {
            return None;
        }
        let what = "no offer with the tasks that it can do";
        due(exchange, it.at_ms, terms.soon_ms(), what, |seen| {
            matches!(&seen.what, Happening::Said(Message::Ram(state))
                if matches!(state.ram.coordination, Coordination::OfferHelp { session, capabilities, .. }
                    if session == it.session && capabilities.intersection(tasks) == capabilities && capabilities != TaskSet::EMPTY))
        })
    };
    requests(exchange).into_iter().filter_map(judge).collect()
}

/// Requests that must not be offered to, where the robot's newest RAM is of that kind.
fn not_offered(
    exchange: &Exchange,
    terms: &Terms,
    is_case: impl Fn(&RamSeen, &Request) -> bool,
) -> Vec<Met> {
    let judge = |it: Request| {
        let (_, state) = exchange.state_at(it.at_ms)?;
        if !is_case(state, &it) {
            return None;
        }
        let until_ms = exchange.undisturbed_until(it.at_ms);
        if until_ms < it.at_ms + terms.soon_ms() {
            return None;
        }
        let mut after = exchange
            .rams()
            .filter(|(at, _)| (it.at_ms..until_ms).contains(at));
        let offer = after.find(|(_, state)| offers_to(it.session)(state));
        let broken = offer.map(|(at, _)| format!("it offers {} ms later", at - it.at_ms));
        Some(met(exchange, it.at_ms, broken))
    };
    requests(exchange).into_iter().filter_map(judge).collect()
}

/// Whether the robot can do a task that is asked for, so that only another rule keeps it from an offer.
fn is_possible(terms: &Terms, it: &Request) -> bool {
    let can = terms.settings.capabilities;
    !can.intersection(it.asked.tasks).is_empty()
}

fn impossible_gets_no_offer(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    not_offered(exchange, terms, |_, it| !is_possible(terms, it))
}

fn one_requester(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    not_offered(exchange, terms, |state, it| {
        let session = session_of(&state.ram);
        let is_bound = matches!(
            state.ram.coordination,
            Coordination::OfferHelp { .. } | Coordination::Follower { .. }
        );
        is_bound
            && is_possible(terms, it)
            && session != Some(it.session)
            && is_in_contact(exchange, it.at_ms)
    })
}

fn on_duty_does_not_offer(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let mut all = not_offered(exchange, terms, |state, it| {
        state.ram.on_duty && is_possible(terms, it)
    });
    let detected = exchange
        .told()
        .filter(|(_, local)| matches!(local, Local::Detect(_)));
    for (at, _) in detected {
        let Some((_, state)) = exchange.state_at(at) else {
            continue;
        };
        let until_ms = exchange.undisturbed_until(at);
        if !state.ram.on_duty || until_ms < at + terms.soon_ms() {
            continue;
        }
        let mut after = exchange
            .rams()
            .filter(|(then, _)| (at..until_ms).contains(then));
        let asks =
            after.any(|(_, state)| matches!(state.ram.coordination, Coordination::NeedHelp { .. }));
        let broken = asks.then(|| "it asks for help".to_owned());
        all.push(met_when(at, "on duty, detects a pedestrian", broken));
    }
    all
}

fn unavailable_does_not_offer(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    not_offered(exchange, terms, |state, it| {
        state.availability != Availability::Available
            && is_possible(terms, it)
            && state.ram.coordination == Coordination::None
    })
}

fn offers_lapse(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let t_offer_ms = terms.ms(|settings| settings.t_offer);
    let judge = |it: Request| {
        let beats =
            exchange
                .played_rams()
                .filter_map(|(at, _, played)| match played.ram.coordination {
                    Coordination::NeedHelp { heartbeat, .. }
                        if session_of(&played.ram) == Some(it.session) =>
                    {
                        Some((at, heartbeat))
                    }
                    _ => None,
                });
        let beats: Vec<(u64, Heartbeat)> = beats.collect();
        // The first offer: a request that is heard again once it has lapsed is a new one.
        let first = exchange
            .rams()
            .find(|(_, state)| offers_to(it.session)(state))?;
        let offer = offer_of(&first.1.ram);
        let last = exchange
            .rams()
            .rfind(|(_, state)| offer_of(&state.ram) == offer)?
            .0;
        let (since, _) = news(beats.iter().copied().filter(|(at, _)| *at <= last)).last()?;
        let since = since.max(first.0);
        let is_settled = exchange.played_rams().any(|(_, _, played)| {
            let is_own = played.ram.station == it.session.leader;
            is_own && matches!(played.ram.coordination, Coordination::Leader { .. })
                || matches!(played.ram.farewell, Some(Farewell::Ended(..)) if is_own)
        });
        let intervened = exchange.told().any(|(at, _)| at + 200 >= since)
            || exchange.restarts().any(|at| at + 200 >= since);
        if is_settled || intervened {
            return None;
        }
        let next = exchange.rams().find(|(at, _)| *at > last);
        let limit_ms = t_offer_ms + terms.soon_ms();
        let broken = match next {
            Some((at, _)) if at < since + t_offer_ms.saturating_sub(terms.early_ms) => {
                let waited_ms = at.saturating_sub(since);
                Some(format!(
                    "the offer lapsed {waited_ms} ms after the newest heartbeat"
                ))
            }
            _ if last > since + limit_ms => Some(format!(
                "it still offers {} ms after the newest heartbeat",
                last - since
            )),
            Some(_) => None,
            // It goes on offering, and the tester did not wait for longer.
            None => return None,
        };
        let is_silent = beats.last().is_some_and(|(at, _)| *at <= since);
        let how = if is_silent {
            "silence"
        } else {
            "old heartbeats"
        };
        Some(met_when(since, format!("offering after {how}"), broken))
    };
    requests(exchange).into_iter().filter_map(judge).collect()
}

fn pedestrians_are_asked_for(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let judge = |(at, local): (u64, Local)| {
        let Local::Detect(followers) = local else {
            return None;
        };
        let (_, state) = exchange.state_at(at)?;
        let is_free = state.ram.coordination == Coordination::None
            && !state.ram.on_duty
            && state.availability == Availability::Available;
        if !is_free {
            return None;
        }
        let what = format!("no request for {followers} followers");
        due(exchange, at, terms.soon_ms(), &what, |seen| {
            matches!(&seen.what, Happening::Said(Message::Ram(state))
                if matches!(state.ram.coordination, Coordination::NeedHelp { request, .. }
                    if request.followers == followers))
        })
    };
    exchange.told().filter_map(judge).collect()
}

fn requests_end(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let t_help_ms = terms.ms(|settings| settings.t_help);
    let mut all = Vec::new();
    let mut begun: Option<(u64, SessionNumber)> = None;
    for (at, state) in exchange.rams() {
        match (state.ram.coordination, begun) {
            (Coordination::NeedHelp { number, .. }, known)
                if known.is_none_or(|(_, it)| it != number) =>
            {
                begun = Some((at, number));
            }
            (Coordination::NeedHelp { .. }, Some((since, _)))
                if at > since + t_help_ms + terms.soon_ms() =>
            {
                let text = format!("it still asks {} ms after it began", at - since);
                all.push(met_when(since, "asking", Some(text)));
                begun = None;
            }
            (Coordination::None, Some((since, number))) => {
                begun = None;
                let told = exchange.told().any(|(then, _)| then > since && then <= at)
                    || exchange.restarts().any(|then| then > since && then <= at);
                let rivals = exchange
                    .played_rams()
                    .any(|(then, ..)| then > since && then <= at);
                if told || rivals {
                    continue;
                }
                let waited_ms = at - since;
                let is_named = matches!(state.ram.farewell, Some(Farewell::Ended(ended, how))
                    if ended == number && how == crossguard_protocol::Ending::Aborted);
                let broken = if waited_ms + terms.slack_ms < t_help_ms {
                    Some(format!("it ends after {waited_ms} ms"))
                } else if is_named {
                    None
                } else {
                    Some("it ends, and does not name its session as aborted".to_owned())
                };
                all.push(met_when(since, "asking", broken));
            }
            _ => {}
        }
    }
    all
}

fn numbers_grow(exchange: &Exchange, _: &Terms) -> Vec<Met> {
    let mut all = Vec::new();
    let mut newest: Option<UniqueNumber> = None;
    let mut known: Vec<(StationId, UniqueNumber)> = Vec::new();
    for (at, state) in exchange.rams() {
        let number = match state.ram.coordination {
            Coordination::NeedHelp { number, .. } => (exchange.robot, number.0),
            Coordination::OfferHelp { session, offer, .. } => (session.leader, offer.0),
            _ => continue,
        };
        if known.contains(&number) {
            continue;
        }
        known.push(number);
        // The number of an offer may be given out again once nobody can confirm it.
        let is_taken_back = exchange.played_rams().any(|(_, _, played)| {
            matches!(played.ram.farewell, Some(Farewell::Ended(..)))
                && played.ram.station == number.0
        });
        if is_taken_back {
            continue;
        }
        if let Some(before) = newest {
            let broken =
                (number.1 <= before).then(|| format!("number {} comes after {before}", number.1));
            let restarted = exchange.restarts().any(|then| then < at);
            let situation = if restarted {
                "a second number, after a start"
            } else {
                "a second number"
            };
            all.push(met_when(at, situation, broken));
        }
        newest = Some(newest.map_or(number.1, |before| before.max(number.1)));
    }
    all
}
