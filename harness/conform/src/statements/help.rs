//! Requests and offers.

use crossguard_protocol::{
    Coordination, Ending, Farewell, HelpRequest, SessionId, SessionNumber, TaskSet, UniqueNumber,
};

use super::{Met, Told, Trace, first_of_each, met_when, news, told};
use crate::exchange::RamSeen;
use crate::subject::Local;

statements! {
    "free-robots-offer" "R3" free_robots_offer of requests:
        "A robot that is free and can do one of the tasks offers, with those tasks.";
    "offers-are-for-what-can-be-done" "R3" impossible_gets_no_offer:
        "A robot that can do none of the tasks does not offer.";
    "offers-lapse-after-t-offer" "R3" offers_lapse of requests:
        "An offer lapses when t_offer is over since the newest heartbeat of the request, and not before.";
    "offers-go-to-one-requester" "R3" one_requester:
        "A robot that offers to one requester, or follows, offers to nobody else.";
    "robots-on-duty-do-not-offer" "R20" on_duty_does_not_offer:
        "A robot that is on duty offers to nobody, and asks nobody.";
    "unavailable-robots-do-not-offer" "R24" unavailable_does_not_offer:
        "An unavailable robot offers to nobody.";
    "pedestrians-are-asked-for" "R4" pedestrians_are_asked_for of told:
        "A robot that has detected a pedestrian asks for as many followers as it needs.";
    "requests-end-at-t-help" "R5" requests_end:
        "A request that nobody meets is named as aborted when t_help is over, and not before.";
    "numbers-never-repeat" "R1" numbers_grow:
        "Numbers of sessions and offers only grow, also after the robot lost power.";
}

/// A request that was played: when first, by which session, and for what.
#[derive(Clone, Copy)]
struct Request {
    at_ms: u64,
    session: SessionId,
    asked: HelpRequest,
}

fn requests(trace: &Trace) -> Vec<Request> {
    let played = trace.played_rams().filter_map(|(at_ms, played)| {
        let Coordination::NeedHelp { request: asked, .. } = played.ram.coordination else {
            return None;
        };
        let session = played.session()?;
        Some(Request {
            at_ms,
            session,
            asked,
        })
    });
    first_of_each(played, |it| it.session).collect()
}

fn free_robots_offer(trace: &Trace, it: Request) -> Option<Met> {
    let tasks = possible(trace, &it);
    if !trace.state_at(it.at_ms)?.is_free() || tasks.is_empty() {
        return None;
    }
    let what = "no offer with the tasks that it can do";
    trace.ram_soon(it.at_ms, what, |state| match state.ram.coordination {
        Coordination::OfferHelp {
            session,
            capabilities,
            ..
        } => {
            session == it.session
                && capabilities.intersection(tasks) == capabilities
                && capabilities != TaskSet::EMPTY
        }
        _ => false,
    })
}

/// Requests that must not be offered to, where the robot's newest RAM is of that kind.
fn not_offered(trace: &Trace, is_case: impl Fn(&RamSeen, &Request) -> bool) -> Vec<Met> {
    let judge = |it: Request| {
        if !is_case(trace.state_at(it.at_ms)?, &it) {
            return None;
        }
        let how = |later_ms| format!("it offers {later_ms} ms later");
        let broken = trace.never(it.at_ms, |state| state.offers_to(it.session), how)?;
        Some(trace.met(it.at_ms, broken))
    };
    requests(trace).into_iter().filter_map(judge).collect()
}

/// The tasks that are asked for and that the robot can do.
fn possible(trace: &Trace, it: &Request) -> TaskSet {
    trace
        .terms
        .settings
        .capabilities
        .intersection(it.asked.tasks)
}

/// Whether the robot can do a task that is asked for, so that only another rule keeps it from an offer.
fn is_possible(trace: &Trace, it: &Request) -> bool {
    !possible(trace, it).is_empty()
}

fn impossible_gets_no_offer(trace: &Trace) -> Vec<Met> {
    not_offered(trace, |_, it| !is_possible(trace, it))
}

fn one_requester(trace: &Trace) -> Vec<Met> {
    not_offered(trace, |state, it| {
        let bound_to = state.echo().map(|(session, _)| session);
        bound_to.is_some_and(|session| session != it.session)
            && is_possible(trace, it)
            && trace.is_in_contact(it.at_ms)
    })
}

fn on_duty_does_not_offer(trace: &Trace) -> Vec<Met> {
    let mut all = not_offered(trace, |state, it| {
        state.ram.on_duty && is_possible(trace, it)
    });
    all.extend(told(trace).filter_map(|(at, local, state)| {
        if !matches!(local, Local::Detect(_)) || !state.ram.on_duty {
            return None;
        }
        let broken = trace.never(at, RamSeen::asks, |_| "it asks for help".to_owned())?;
        Some(met_when(at, "on duty, detects a pedestrian", broken))
    }));
    all
}

fn unavailable_does_not_offer(trace: &Trace) -> Vec<Met> {
    not_offered(trace, |state, it| {
        !state.is_available()
            && is_possible(trace, it)
            && state.ram.coordination == Coordination::None
    })
}

fn offers_lapse(trace: &Trace, it: Request) -> Option<Met> {
    let t_offer_ms = trace.ms(|settings| settings.t_offer);
    let requests = trace.played_rams().filter(|(_, played)| played.asks());
    let beats: Vec<_> = requests
        .filter(|(_, played)| played.session() == Some(it.session))
        .filter_map(|(at, played)| Some((at, played.heartbeat()?)))
        .collect();
    // The first offer: a request that is heard again once it has lapsed is a new one.
    let (first, offering) = trace
        .rams()
        .find(|(_, state)| state.offers_to(it.session))?;
    let offer = offering.offer();
    let (last, _) = trace.rams().rfind(|(_, state)| state.offer() == offer)?;
    let (since, _) = news(beats.iter().copied().filter(|(at, _)| *at <= last)).last()?;
    let since = since.max(first);
    let is_settled = trace.played_rams().any(|(_, played)| {
        let has_ended = matches!(played.ram.farewell, Some(Farewell::Ended(..)));
        played.ram.station == it.session.leader && (played.leads() || has_ended)
    });
    if is_settled || trace.is_disturbed(since.saturating_sub(200)..) {
        return None;
    }
    // Where there is none, it goes on offering, and the tester did not wait for longer.
    let next = trace.rams().map(|(at, _)| at).find(|at| *at > last);
    let limit_ms = t_offer_ms + trace.soon_ms();
    let earliest_ms = since + t_offer_ms.saturating_sub(trace.terms.early_ms);
    let broken = if let Some(at) = next.filter(|at| *at < earliest_ms) {
        let waited_ms = at.saturating_sub(since);
        Some(format!(
            "the offer lapsed {waited_ms} ms after the newest heartbeat"
        ))
    } else if last > since + limit_ms {
        let late_ms = last - since;
        Some(format!(
            "it still offers {late_ms} ms after the newest heartbeat"
        ))
    } else {
        next?;
        None
    };
    let is_silent = beats.last().is_some_and(|(at, _)| *at <= since);
    let how = if is_silent {
        "silence"
    } else {
        "old heartbeats"
    };
    Some(met_when(since, format!("offering after {how}"), broken))
}

fn pedestrians_are_asked_for(trace: &Trace, (at, local, state): Told) -> Option<Met> {
    let Local::Detect(followers) = local else {
        return None;
    };
    if !state.is_free() {
        return None;
    }
    let what = format!("no request for {followers} followers");
    trace.ram_soon(at, &what, |state| {
        matches!(state.ram.coordination, Coordination::NeedHelp { request, .. }
            if request.followers == followers)
    })
}

fn requests_end(trace: &Trace) -> Vec<Met> {
    let t_help_ms = trace.ms(|settings| settings.t_help);
    let mut all = Vec::new();
    let mut begun: Option<(u64, SessionNumber)> = None;
    for (at, state) in trace.rams() {
        match (state.ram.coordination, begun) {
            (Coordination::NeedHelp { number, .. }, known)
                if known.is_none_or(|(_, it)| it != number) =>
            {
                begun = Some((at, number));
            }
            (Coordination::NeedHelp { .. }, Some((since, _)))
                if at > since + t_help_ms + trace.soon_ms() =>
            {
                let text = format!("it still asks {} ms after it began", at - since);
                all.push(met_when(since, "asking", Some(text)));
                begun = None;
            }
            (Coordination::None, Some((since, number))) => {
                begun = None;
                let during = since + 1..=at;
                let mut rivals = trace.played_rams();
                if trace.is_disturbed(during.clone())
                    || rivals.any(|(then, _)| during.contains(&then))
                {
                    continue;
                }
                let waited_ms = at - since;
                let aborted = Farewell::Ended(number, Ending::Aborted);
                let broken = if waited_ms + trace.terms.slack_ms < t_help_ms {
                    Some(format!("it ends after {waited_ms} ms"))
                } else {
                    (state.ram.farewell != Some(aborted))
                        .then(|| "it ends, and does not name its session as aborted".to_owned())
                };
                all.push(met_when(since, "asking", broken));
            }
            _ => {}
        }
    }
    all
}

fn numbers_grow(trace: &Trace) -> Vec<Met> {
    let mut all = Vec::new();
    let mut newest: Option<UniqueNumber> = None;
    let numbers = trace.rams().filter_map(|(at, state)| {
        let (leader, number) = match state.ram.coordination {
            Coordination::NeedHelp { number, .. } => (trace.robot, number.0),
            Coordination::OfferHelp { session, offer, .. } => (session.leader, offer.0),
            _ => return None,
        };
        Some((at, leader, number))
    });
    for (at, leader, number) in first_of_each(numbers, |(_, leader, number)| (*leader, *number)) {
        // The number of an offer may be given out again once nobody can confirm it.
        let is_taken_back = trace.played_rams().any(|(_, played)| {
            played.ram.station == leader && matches!(played.ram.farewell, Some(Farewell::Ended(..)))
        });
        if is_taken_back {
            continue;
        }
        if let Some(before) = newest {
            let broken =
                (number <= before).then(|| format!("number {number} comes after {before}"));
            let restarted = trace.restarts().any(|then| then < at);
            let after = if restarted { ", after a start" } else { "" };
            all.push(met_when(at, format!("a second number{after}"), broken));
        }
        newest = newest.max(Some(number));
    }
    all
}
