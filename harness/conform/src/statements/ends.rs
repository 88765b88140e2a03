//! How sessions end, and what is said of it.

use crossguard_protocol::{Availability, Coordination, Ending, Farewell, SessionId, SessionNumber};

use super::{Met, due, met, met_when, part_unchanged};
use crate::bench::Terms;
use crate::exchange::{Exchange, Happening, Message, RamSeen, Seen, following, session_of};
use crate::subject::Local;

statements! {
    "completed-sessions-free" "R19" completed_frees:
        "A robot whose leader names the session as completed is free: no part, no duty, and its body stands.";
    "aborted-sessions-are-a-duty" "R19" aborted_is_a_duty:
        "A follower that executes when its session ends otherwise, or when it is not listed any more, is on duty.";
    "own-ends-are-named" "R19" own_ends_are_named:
        "A leader or requester names its session as completed when its pedestrian is across, and as aborted when it leaves.";
    "other-ends-change-nothing" "R1" other_ends_change_nothing:
        "The end of another session changes no part.";
    "a-bare-none-releases-nobody" "R1" bare_none_changes_nothing:
        "A leader's RAM that says none, and names no session as ended, releases nobody.";
    "farewells-are-said-for-t-farewell" "R21" farewells_last:
        "What is left or ended is named in every RAM for t_farewell, and not for longer.";
    "leaving-is-named" "R21" leaving_is_named:
        "A helper or follower that wants to leave names the session as left.";
    "stale-sessions-are-named" "R21" stale_is_named:
        "A robot that hears of a session of its own which is over names it as ended, unless it is naming another one.";
    "a-clear-road-ends-a-duty" "R20" duty_ends:
        "A duty ends when the road is said to be clear, and nothing else ends it.";
    "unavailability-is-said" "R24" unavailability_is_said:
        "A robot that becomes unavailable says so in its RAM.";
    "unavailability-ends-the-part" "R24" unavailability_ends_the_part:
        "A helper, or a follower that executes nothing, leaves when it becomes unavailable; a requester or leader ends its session.";
}

/// A body that moves faster than this is under way, in m/s.
const MOVES_MPS: f64 = 0.5;

fn is_ram(seen: &Seen, is_it: impl Fn(&RamSeen) -> bool) -> bool {
    matches!(&seen.what, Happening::Said(Message::Ram(state)) if is_it(state))
}

/// The first RAM in which a station of the tester names a session as ended.
fn played_ends(exchange: &Exchange) -> Vec<(u64, SessionId, Ending)> {
    let mut all: Vec<(u64, SessionId, Ending)> = Vec::new();
    for (at, _, played) in exchange.played_rams() {
        if let Some(Farewell::Ended(number, how)) = played.ram.farewell {
            let session = SessionId {
                leader: played.ram.station,
                number,
            };
            let is_known =
                |(_, known, it): &(u64, SessionId, Ending)| *known == session && *it == how;
            if played.ram.station != exchange.robot && !all.iter().any(is_known) {
                all.push((at, session, how));
            }
        }
    }
    all
}

fn completed_frees(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let judge = |(at, session, how): (u64, SessionId, Ending)| {
        let (_, state) = exchange.state_at(at)?;
        if how != Ending::Completed || session_of(&state.ram) != Some(session) || state.ram.on_duty
        {
            return None;
        }
        let soon_ms = terms.soon_ms();
        let met_here = due(
            exchange,
            at,
            soon_ms,
            "no RAM without part and duty",
            |seen| {
                is_ram(seen, |state| {
                    session_of(&state.ram) != Some(session) && !state.ram.on_duty
                })
            },
        )?;
        // A body needs a moment to stand.
        let mut later = exchange.rams().filter(|(then, state)| {
            *then > at + soon_ms
                && *then <= exchange.undisturbed_until(at).max(at + soon_ms + 800)
                && session_of(&state.ram).is_none()
        });
        let moves = later.find(|(_, state)| state.speed_mps.is_some_and(|speed| speed > MOVES_MPS));
        let moves =
            moves.map(|(then, _)| format!("its body moves {} ms after it was released", then - at));
        Some(met(exchange, at, met_here.broken.or(moves)))
    };
    played_ends(exchange)
        .into_iter()
        .filter_map(judge)
        .collect()
}

fn runs(state: &RamSeen) -> Option<SessionId> {
    let (session, last) = following(&state.ram)?;
    last?.progress.is_running().then_some(session)
}

fn aborted_is_a_duty(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let ends = played_ends(exchange).into_iter();
    let aborted = ends.filter(|(.., how)| *how == Ending::Aborted);
    let mut causes: Vec<(u64, SessionId, &str)> = aborted
        .map(|(at, session, _)| (at, session, "aborted"))
        .collect();
    let unlisted = exchange.played_rams().filter_map(|(at, _, played)| {
        let Coordination::Leader { followers, .. } = played.ram.coordination else {
            return None;
        };
        let is_listed = followers.iter().any(|it| it.station == exchange.robot);
        (!is_listed).then_some((at, session_of(&played.ram)?, "not listed"))
    });
    for (at, session, how) in unlisted {
        if causes.iter().all(|(_, known, _)| *known != session) {
            causes.push((at, session, how));
        }
    }
    let judge = |(at, session, how): (u64, SessionId, &str)| {
        let (_, state) = exchange.state_at(at)?;
        if runs(state) != Some(session) {
            return None;
        }
        let met_here = due(
            exchange,
            at,
            terms.soon_ms(),
            "no RAM that says it is on duty and has no part",
            |seen| {
                is_ram(seen, |state| {
                    state.ram.on_duty && session_of(&state.ram) != Some(session)
                })
            },
        )?;
        let situation = format!("{}, {how}", exchange.situation_at(at));
        Some(met_when(at, situation, met_here.broken))
    };
    causes.into_iter().filter_map(judge).collect()
}

fn own_number(exchange: &Exchange, at_ms: u64) -> Option<SessionNumber> {
    let (_, state) = exchange.state_at(at_ms)?;
    match state.ram.coordination {
        Coordination::NeedHelp { number, .. } | Coordination::Leader { number, .. } => Some(number),
        _ => None,
    }
}

fn own_ends_are_named(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let judge = |(at, local): (u64, Local)| {
        let expected = match local {
            Local::TaskCompleted => Ending::Completed,
            Local::Leave => Ending::Aborted,
            _ => return None,
        };
        let number = own_number(exchange, at)?;
        let what = "no RAM that names the session as ended so";
        due(exchange, at, terms.soon_ms(), what, |seen| {
            is_ram(seen, |state| {
                state.ram.farewell == Some(Farewell::Ended(number, expected))
            })
        })
    };
    exchange.told().filter_map(judge).collect()
}

fn leaving_is_named(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let judge = |(at, local): (u64, Local)| {
        let (_, state) = exchange.state_at(at)?;
        let (Coordination::OfferHelp { session, .. } | Coordination::Follower { session, .. }) =
            state.ram.coordination
        else {
            return None;
        };
        if local != Local::Leave {
            return None;
        }
        due(
            exchange,
            at,
            terms.soon_ms(),
            "no RAM that names the session as left",
            |seen| is_ram(seen, |state| names_as_left(state, session)),
        )
    };
    exchange.told().filter_map(judge).collect()
}

fn names_as_left(state: &RamSeen, session: SessionId) -> bool {
    matches!(state.ram.farewell, Some(Farewell::Left(it, _)) if it == session)
}

fn other_ends_change_nothing(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let judge = |(at, session, _): (u64, SessionId, Ending)| {
        let (_, state) = exchange.state_at(at)?;
        let own = session_of(&state.ram)?;
        // What else that RAM says must not be news.
        let spoke = exchange
            .played_rams()
            .any(|(then, _, it)| it.ram.station == session.leader && then < at && then + 300 > at);
        if own == session || !spoke {
            return None;
        }
        Some(met(exchange, at, part_unchanged(exchange, terms, at)?))
    };
    played_ends(exchange)
        .into_iter()
        .filter_map(judge)
        .collect()
}

fn bare_none_changes_nothing(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let none = exchange.played_rams().filter(|(_, _, played)| {
        played.ram.coordination == Coordination::None && played.ram.farewell.is_none()
    });
    let mut all: Vec<Met> = Vec::new();
    for (at, _, played) in none {
        let Some((_, state)) = exchange.state_at(at) else {
            continue;
        };
        let Some(own) = session_of(&state.ram) else {
            continue;
        };
        let is_first = all.is_empty();
        if own.leader == played.ram.station
            && is_first
            && let Some(outcome) = part_unchanged(exchange, terms, at)
        {
            all.push(met(exchange, at, outcome));
        }
    }
    all
}

fn farewells_last(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let t_farewell_ms = terms.ms(|settings| settings.t_farewell);
    let period_ms = terms.ms(|settings| settings.ram_period);
    let mut all = Vec::new();
    let mut before: Option<Farewell> = None;
    for (at, state) in exchange.rams() {
        let is_new = state.ram.farewell.filter(|it| before != Some(*it));
        before = state.ram.farewell;
        let Some(farewell) = is_new else { continue };
        let until_ms = at + t_farewell_ms;
        let end_ms = until_ms + terms.soon_ms();
        if exchange.ended_ms < end_ms || exchange.restarts().any(|then| then > at && then < end_ms)
        {
            continue;
        }
        let mut last_ms = at;
        let mut broken = None;
        for (then, state) in exchange
            .rams()
            .filter(|(then, _)| *then > at && *then <= end_ms)
        {
            let is_said = state.ram.farewell.is_some();
            let is_early = then + period_ms + terms.early_ms < until_ms;
            if then - last_ms > 3 * period_ms + terms.slack_ms && last_ms + period_ms < until_ms {
                broken = Some(format!("for {} ms it did not say it", then - last_ms));
            } else if !is_said && is_early && session_of(&state.ram).is_none() {
                broken = Some(format!("it says it for {} ms", last_ms - at));
            } else if !is_said {
                break;
            }
            if broken.is_some() {
                break;
            }
            last_ms = then;
        }
        let still = exchange
            .rams()
            .find(|(then, state)| *then > end_ms && state.ram.farewell == Some(farewell));
        let claimed = exchange.played_rams().any(|(then, _, played)| {
            let session = session_of(&played.ram);
            let is_left = matches!(farewell, Farewell::Left(left, _) if session == Some(left));
            then > at && (is_left || session.is_some_and(|it| it.leader == exchange.robot))
        });
        if let (Some((then, _)), false) = (still, claimed) {
            broken = Some(format!("it still says it {} ms later", then - at));
        }
        let situation = match farewell {
            Farewell::Ended(..) => "names a session as ended",
            Farewell::Left(..) => "names a session as left",
        };
        all.push(met_when(at, situation, broken));
    }
    all
}

fn stale_is_named(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let mut all: Vec<(SessionId, Met)> = Vec::new();
    for (at, _, played) in exchange.played_rams() {
        let (Coordination::OfferHelp {
            session: claimed, ..
        }
        | Coordination::Follower {
            session: claimed, ..
        }) = played.ram.coordination
        else {
            continue;
        };
        let Some((_, state)) = exchange.state_at(at) else {
            continue;
        };
        let is_own = claimed.leader == exchange.robot;
        let is_over = session_of(&state.ram) != Some(claimed);
        let is_known = all.iter().any(|(known, _)| *known == claimed);
        let names_another = |state: &RamSeen| {
            let farewell = state.ram.farewell;
            farewell.is_some_and(
                |it| !matches!(it, Farewell::Ended(number, _) if number == claimed.number),
            )
        };
        // It may have begun to name another one just now.
        let next = exchange.rams().find(|(then, _)| *then > at);
        let is_busy = names_another(state) || next.is_some_and(|(_, next)| names_another(next));
        if !is_own || !is_over || is_known || is_busy || played.ram.station == exchange.robot {
            continue;
        }
        let is_named = |state: &RamSeen| matches!(state.ram.farewell, Some(Farewell::Ended(number, _)) if number == claimed.number);
        let what = "no RAM that names that session as ended";
        let found = due(exchange, at, terms.soon_ms(), what, |seen| {
            is_ram(seen, is_named)
        });
        all.extend(found.map(|met| (claimed, met)));
    }
    all.into_iter().map(|(_, met)| met).collect()
}

fn duty_ends(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let mut all = Vec::new();
    let mut before: Option<(u64, bool)> = None;
    for (at, state) in exchange.rams() {
        if let Some((then, true)) = before
            && !state.ram.on_duty
        {
            let is_said = exchange
                .told()
                .any(|(told, local)| local == Local::Clear && told + 10_000 >= then && told <= at);
            let restarted = exchange
                .restarts()
                .any(|told| told + 10_000 >= then && told <= at);
            // A robot may see by itself that nobody is on the road: then nobody at its side has to say so.
            let broken =
                (!is_said && !restarted && exchange.told().any(|(_, it)| it == Local::Clear))
                    .then(|| "its duty ended before the road was said to be clear".to_owned());
            all.push(met_when(then, "on duty, ends", broken));
        }
        before = Some((at, state.ram.on_duty));
    }
    for (at, local) in exchange.told() {
        let on_duty = exchange
            .state_at(at)
            .is_some_and(|(_, state)| state.ram.on_duty);
        if local == Local::Clear && on_duty {
            // A body has to finish its fallback first.
            let limit_ms = terms.soon_ms();
            let found = due(exchange, at, limit_ms, "no RAM without duty", |seen| {
                is_ram(seen, |state| !state.ram.on_duty)
            });
            all.extend(found);
        }
    }
    all
}

fn unavailability_is_said(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let judge = |(at, local): (u64, Local)| {
        let Local::Unavailable(why) = local else {
            return None;
        };
        due(
            exchange,
            at,
            terms.soon_ms(),
            "no RAM that says it is unavailable",
            |seen| {
                is_ram(seen, |state| {
                    state.availability == Availability::Unavailable(why)
                })
            },
        )
    };
    exchange.told().filter_map(judge).collect()
}

fn unavailability_ends_the_part(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let judge = |(at, local): (u64, Local)| {
        if !matches!(local, Local::Unavailable(_)) {
            return None;
        }
        let (_, state) = exchange.state_at(at)?;
        let session = session_of(&state.ram)?;
        if runs(state).is_some() {
            return None;
        }
        let number = own_number(exchange, at);
        due(
            exchange,
            at,
            terms.soon_ms(),
            "no RAM that fails, leaves or ends",
            |seen| {
                is_ram(seen, |state| match number {
                    Some(number) => {
                        state.ram.farewell == Some(Farewell::Ended(number, Ending::Aborted))
                    }
                    None => names_as_left(state, session),
                })
            },
        )
    };
    exchange.told().filter_map(judge).collect()
}
