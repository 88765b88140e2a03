//! Heartbeats, their echoes, and what a follower does without them.

use crossguard_protocol::{Coordination, Farewell, Heartbeat, Progress, SessionId};

use super::{Met, due, met, met_when, news};
use crate::bench::Terms;
use crate::exchange::{Exchange, Happening, Message, following, offer_of, session_of};

statements! {
    "falls-back-not-before-t-safety" "R12" not_before_t_safety:
        "A follower does not fall back before its t_safety is over, counted from the newest heartbeat or command.";
    "falls-back-after-t-safety" "R12" after_t_safety:
        "A follower falls back when t_safety is over, and no old heartbeat, repeated heartbeat or repeated command keeps it from that.";
    "fallback-is-a-duty" "R14" fallback_is_a_duty:
        "A follower that falls back says that it is on duty.";
    "leaves-after-t-leave" "R14" leaves_after_t_leave:
        "A follower without contact names the session as left when t_safety and t_leave are over, and not before.";
    "echoes-what-it-heard" "R13" echoes_what_it_heard:
        "A helper and a follower echo the newest heartbeat that they heard, none that was never sent, and never an older one after it.";
    "heart-beats-in-time" "R13" heart_beats_in_time:
        "The heartbeat of a requester or leader grows in every RAM period, and never by more than the periods that have passed.";
}

/// The heartbeats that the leader of a session played in it.
fn heartbeats(
    exchange: &Exchange,
    session: SessionId,
) -> impl Iterator<Item = (u64, Heartbeat)> + '_ {
    exchange.played_rams().filter_map(move |(at, _, played)| {
        if session_of(&played.ram) != Some(session) || played.ram.station != session.leader {
            return None;
        }
        match played.ram.coordination {
            Coordination::NeedHelp { heartbeat, .. } | Coordination::Leader { heartbeat, .. } => {
                Some((at, heartbeat))
            }
            _ => None,
        }
    })
}

/// When the robot had news of its leader in a session for the last time, by `until_ms`.
fn newest_news(exchange: &Exchange, session: SessionId, until_ms: u64) -> Option<u64> {
    let beats = news(heartbeats(exchange, session)).map(|(at, _)| at);
    // A command that was acknowledged for the first time.
    let mut known = Vec::new();
    let commands = exchange.played_commands().filter_map(|(at, command)| {
        let is_new = command.session == session && !known.contains(&command.request);
        known.push(command.request);
        let mut answers = exchange.answers();
        let is_taken =
            answers.any(|(_, it)| it.session == session && it.request == command.request);
        (is_new && is_taken).then_some(at)
    });
    beats.chain(commands).filter(|at| *at <= until_ms).max()
}

/// The `t_safety` that the robot told in its offer to a session.
fn t_safety_ms(exchange: &Exchange, terms: &Terms, session: SessionId) -> u64 {
    let told = exchange
        .rams()
        .find_map(|(_, state)| match state.ram.coordination {
            Coordination::OfferHelp {
                session: to,
                t_safety,
                ..
            } if to == session => Some(u64::from(t_safety.0)),
            _ => None,
        });
    told.unwrap_or_else(|| terms.ms(|settings| settings.t_safety))
}

/// The first RAM in which the robot reports that it fell back, in each session.
fn fallbacks(exchange: &Exchange) -> Vec<(u64, SessionId)> {
    let mut found: Vec<(u64, SessionId)> = Vec::new();
    for (at, state) in exchange.rams() {
        if let Some((session, Some(last))) = following(&state.ram)
            && last.progress == Progress::SafeIdle
            && found.iter().all(|(_, known)| *known != session)
        {
            found.push((at, session));
        }
    }
    found
}

fn not_before_t_safety(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let judge = |(at, session): (u64, SessionId)| {
        // What arrived just before cannot have been in that RAM.
        let since = newest_news(exchange, session, at.saturating_sub(terms.early_ms))?;
        let t_safety_ms = t_safety_ms(exchange, terms, session);
        let waited_ms = at - since;
        let broken = (waited_ms + terms.early_ms < t_safety_ms).then(|| {
            format!("it fell back {waited_ms} ms after the newest heartbeat, with a t_safety of {t_safety_ms} ms")
        });
        Some(met(exchange, at.saturating_sub(1), broken))
    };
    fallbacks(exchange).into_iter().filter_map(judge).collect()
}

/// How a leader kept silent after `at_ms`, in words.
fn silence(exchange: &Exchange, session: SessionId, at_ms: u64) -> &'static str {
    let mut after = heartbeats(exchange, session).filter(|(at, _)| *at > at_ms);
    match after.next() {
        None => "silence",
        Some(_) => "old heartbeats",
    }
}

/// The sessions in which the robot executes, and since when its leader had given no news by the end.
fn silences(exchange: &Exchange) -> Vec<(u64, SessionId, bool)> {
    let mut sessions: Vec<SessionId> = Vec::new();
    for (_, state) in exchange.rams() {
        if let Some((session, _)) = following(&state.ram)
            && !sessions.contains(&session)
        {
            sessions.push(session);
        }
    }
    let silence = |session| {
        let since = newest_news(exchange, session, u64::MAX)?;
        let (_, state) = exchange.state_at(since + 300)?;
        let (now, last) = following(&state.ram)?;
        let runs = last.is_some_and(|last| last.progress.is_running());
        // The leader ends the session, or lists the robot no more.
        let is_over = exchange.played_rams().any(|(at, _, played)| {
            let ends = matches!(played.ram.farewell, Some(Farewell::Ended(number, _))
                if number == session.number);
            let releases = match played.ram.coordination {
                Coordination::Leader { followers, .. } if at > since => {
                    session_of(&played.ram) == Some(session)
                        && followers.iter().all(|it| it.station != exchange.robot)
                }
                _ => false,
            };
            played.ram.station == session.leader && (ends || releases)
        });
        let intervened =
            exchange.told().any(|(at, _)| at > since) || exchange.restarts().any(|at| at > since);
        (now == session && !is_over && !intervened).then_some((since, session, runs))
    };
    sessions.into_iter().filter_map(silence).collect()
}

fn after_t_safety(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let judge = |(since, session, runs): (u64, SessionId, bool)| {
        let limit_ms = t_safety_ms(exchange, terms, session) + terms.soon_ms();
        if !runs || exchange.ended_ms < since + limit_ms {
            return None;
        }
        let mut after = exchange
            .rams()
            .filter(|(at, _)| (since..=since + limit_ms).contains(at));
        let is_safe = after.any(|(_, state)| {
            following(&state.ram).is_none_or(|(now, last)| {
                now != session || last.is_none_or(|last| !last.progress.is_running())
            })
        });
        let broken = (!is_safe)
            .then(|| format!("{limit_ms} ms after the newest heartbeat it still executes"));
        let situation = format!(
            "{} after {}",
            exchange.situation_at(since + 300),
            silence(exchange, session, since)
        );
        Some(met_when(since, situation, broken))
    };
    silences(exchange).into_iter().filter_map(judge).collect()
}

fn fallback_is_a_duty(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let judge = |(at, _): (u64, SessionId)| {
        due(
            exchange,
            at,
            terms.soon_ms(),
            "no RAM that says it is on duty",
            |seen| matches!(&seen.what, Happening::Said(Message::Ram(state)) if state.ram.on_duty),
        )
    };
    fallbacks(exchange).into_iter().filter_map(judge).collect()
}

fn leaves_after_t_leave(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let t_leave_ms = terms.ms(|settings| settings.t_leave);
    let judge = |(since, session, _): (u64, SessionId, bool)| {
        let due_ms = since + t_safety_ms(exchange, terms, session) + t_leave_ms;
        let limit_ms = due_ms + terms.soon_ms();
        let left = exchange.rams().find(|(at, state)| {
            *at > since
                && matches!(state.ram.farewell, Some(Farewell::Left(it, _)) if it == session)
        });
        let broken = match left {
            Some((at, _)) if at + terms.early_ms < due_ms => {
                Some(format!("it left {} ms too early", due_ms - at))
            }
            Some((at, _)) if at > limit_ms => Some(format!("it left {} ms too late", at - due_ms)),
            Some(_) => None,
            None if exchange.ended_ms >= limit_ms => Some(format!(
                "it had not left {} ms after the newest heartbeat",
                limit_ms - since
            )),
            None => return None,
        };
        Some(met_when(since, exchange.situation_at(since + 300), broken))
    };
    silences(exchange).into_iter().filter_map(judge).collect()
}

fn echoes_what_it_heard(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let mut all = Vec::new();
    let mut before: Option<(SessionId, Heartbeat)> = None;
    // A new offer begins with whatever heartbeat it was made for.
    let mut begun = (None, 0);
    let mut situations = Vec::new();
    for (at, state) in exchange.rams() {
        let (Coordination::OfferHelp { session, echo, .. }
        | Coordination::Follower { session, echo, .. }) = state.ram.coordination
        else {
            before = None;
            continue;
        };
        let part = (session, offer_of(&state.ram).map(|(_, offer)| offer));
        if begun.0 != Some(part) {
            begun = (Some(part), at);
            before = None;
        }
        let newest_by = |since: u64, until: u64| {
            let beats =
                heartbeats(exchange, session).filter(|(at, _)| (since..=until).contains(at));
            news(beats).last().map(|(_, heartbeat)| heartbeat)
        };
        let Some(newest) = newest_by(0, at) else {
            continue;
        };
        let settled = newest_by(begun.1, at.saturating_sub(terms.soon_ms()));
        let broken = if echo.is_newer_than(newest) {
            Some(format!(
                "it echoes {echo}, and the newest heartbeat was {newest}"
            ))
        } else if let Some((known, last)) = before
            && known == session
            && last.is_newer_than(echo)
        {
            Some(format!("it echoes {echo} after {last}"))
        } else if let Some(settled) = settled
            && settled.is_newer_than(echo)
        {
            let soon_ms = terms.soon_ms();
            Some(format!(
                "it echoes {echo}, and {settled} was sent {soon_ms} ms before"
            ))
        } else {
            None
        };
        before = Some((session, echo));
        let is_offer = offer_of(&state.ram).is_some();
        let is_news = !situations.contains(&is_offer);
        situations.push(is_offer);
        if broken.is_some() || is_news {
            let situation = if is_offer { "offering" } else { "following" };
            all.push(met_when(at, situation, broken));
        }
    }
    all
}

fn heart_beats_in_time(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let period_ms = terms.ms(|settings| settings.ram_period);
    let mut all = Vec::new();
    let mut first: Option<(SessionId, u64, Heartbeat)> = None;
    let mut newest: Option<(u64, Heartbeat)> = None;
    for (at, state) in exchange.rams() {
        let (Coordination::NeedHelp { heartbeat, .. } | Coordination::Leader { heartbeat, .. }) =
            state.ram.coordination
        else {
            first = None;
            continue;
        };
        let Some(session) = session_of(&state.ram) else {
            continue;
        };
        let Some((_, begun, begun_with)) = first.filter(|(known, ..)| *known == session) else {
            first = Some((session, at, heartbeat));
            newest = Some((at, heartbeat));
            continue;
        };
        let Some((newest_at, known)) = newest else {
            continue;
        };
        let periods = u64::from(heartbeat.distance_from(begun_with));
        let passed_ms = at - begun;
        // The first may have been on its way for longer than this one.
        let allowed = (passed_ms + terms.slack_ms) / period_ms + 1;
        let late_ms = at - newest_at;
        let broken = if known.is_newer_than(heartbeat) {
            Some(format!("heartbeat {heartbeat} comes after {known}"))
        } else if periods > allowed {
            Some(format!(
                "heartbeat {heartbeat} comes {passed_ms} ms after heartbeat {begun_with}"
            ))
        } else if late_ms > 3 * period_ms + terms.slack_ms && heartbeat == known {
            Some(format!(
                "for {late_ms} ms there was no heartbeat after {known}"
            ))
        } else {
            None
        };
        if heartbeat.is_newer_than(known) {
            newest = Some((at, heartbeat));
        }
        let is_tenth = periods == 5;
        if broken.is_some() || is_tenth {
            all.push(met(exchange, at, broken));
        }
    }
    all
}
