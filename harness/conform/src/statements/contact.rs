//! Heartbeats, their echoes, and what a follower does without them.

use crossguard_protocol::{Coordination, Heartbeat, Progress, SessionId};

use super::{Met, Trace, first_of_each, met_when, news};

statements! {
    "falls-back-not-before-t-safety" "R12" not_before_t_safety of fallbacks:
        "A follower does not fall back before its t_safety is over, counted from the newest heartbeat or command.";
    "falls-back-after-t-safety" "R12" after_t_safety of silences:
        "A follower falls back when t_safety is over, and no old heartbeat, repeated heartbeat or repeated command keeps it from that.";
    "fallback-is-a-duty" "R14" fallback_is_a_duty of fallbacks:
        "A follower that falls back says that it is on duty.";
    "leaves-after-t-leave" "R14" leaves_after_t_leave of silences:
        "A follower without contact names the session as left when t_safety and t_leave are over, and not before.";
    "echoes-what-it-heard" "R13" echoes_what_it_heard:
        "A helper and a follower echo the newest heartbeat that they heard, none that was never sent, and never an older one after it.";
    "heart-beats-in-time" "R13" heart_beats_in_time:
        "The heartbeat of a requester or leader grows in every RAM period, and never by more than the periods that have passed.";
}

/// When the robot had news of its leader in a session for the last time, by `until_ms`.
fn newest_news(trace: &Trace, session: SessionId, until_ms: u64) -> Option<u64> {
    let beats = news(trace.heartbeats(session)).map(|(at, _)| at);
    // A command that was acknowledged for the first time.
    let commands = first_of_each(trace.played_commands(), |(_, it)| it.request);
    let commands = commands.filter_map(|(at, command)| {
        let mut answers = trace.answers();
        let is_taken =
            answers.any(|(_, it)| it.session == session && it.request == command.request);
        (command.session == session && is_taken).then_some(at)
    });
    beats.chain(commands).filter(|at| *at <= until_ms).max()
}

/// The `t_safety` that the robot told in its offer to a session.
fn t_safety_ms(trace: &Trace, session: SessionId) -> u64 {
    let told = trace
        .rams()
        .find_map(|(_, state)| match state.ram.coordination {
            Coordination::OfferHelp { t_safety, .. } if state.offers_to(session) => Some(t_safety),
            _ => None,
        });
    told.map_or_else(|| trace.ms(|settings| settings.t_safety), |it| it.0.into())
}

/// The first RAM in which the robot reports that it fell back, in each session.
fn fallbacks(trace: &Trace) -> Vec<(u64, SessionId)> {
    let fallen_back = trace.rams().filter_map(|(at, state)| {
        let (session, last) = state.following()?;
        (last?.progress == Progress::SafeIdle).then_some((at, session))
    });
    first_of_each(fallen_back, |(_, session)| *session).collect()
}

fn not_before_t_safety(trace: &Trace, (at, session): (u64, SessionId)) -> Option<Met> {
    let early_ms = trace.terms.early_ms;
    // News that arrived just before cannot have been in that RAM.
    let since = newest_news(trace, session, at.saturating_sub(early_ms))?;
    let t_safety_ms = t_safety_ms(trace, session);
    let waited_ms = at - since;
    let broken = (waited_ms + early_ms < t_safety_ms).then(|| {
        format!("it fell back {waited_ms} ms after the newest heartbeat, with a t_safety of {t_safety_ms} ms")
    });
    Some(trace.met(at.saturating_sub(1), broken))
}

/// How a leader kept silent after `at_ms`, in words.
fn silence(trace: &Trace, session: SessionId, at_ms: u64) -> &'static str {
    if trace.heartbeats(session).any(|(at, _)| at > at_ms) {
        "old heartbeats"
    } else {
        "silence"
    }
}

/// The sessions in which the robot executes, and since when its leader had given no news by the end.
fn silences(trace: &Trace) -> Vec<(u64, SessionId, bool)> {
    let followed = trace.rams().filter_map(|(_, state)| state.following());
    let sessions = first_of_each(followed.map(|(session, _)| session), |session| *session);
    let silence = |session: SessionId| {
        let since = newest_news(trace, session, u64::MAX)?;
        let state = trace.state_at(since + 300)?;
        let (now, _) = state.following()?;
        // The leader ends the session, or lists the robot no more.
        let is_over = trace.played_rams().any(|(at, it)| {
            let releases =
                at > since && it.leads() && it.session() == Some(session) && !it.lists(trace.robot);
            it.ram.station == session.leader && (it.names_as_ended(session.number) || releases)
        });
        let runs = state.executes().is_some();
        (now == session && !is_over && !trace.is_disturbed(since + 1..))
            .then_some((since, session, runs))
    };
    sessions.filter_map(silence).collect()
}

fn after_t_safety(trace: &Trace, (since, session, runs): (u64, SessionId, bool)) -> Option<Met> {
    let limit_ms = t_safety_ms(trace, session) + trace.soon_ms();
    if !runs || trace.ended_ms < since + limit_ms {
        return None;
    }
    let during = since..=since + limit_ms;
    let mut after = trace.rams().filter(|(at, _)| during.contains(at));
    let is_safe = after.any(|(_, state)| state.executes() != Some(session));
    let broken =
        (!is_safe).then(|| format!("{limit_ms} ms after the newest heartbeat it still executes"));
    let situation = trace.situation_at(since + 300);
    let how = silence(trace, session, since);
    Some(met_when(since, format!("{situation} after {how}"), broken))
}

fn fallback_is_a_duty(trace: &Trace, (at, _): (u64, SessionId)) -> Option<Met> {
    let what = "no RAM that says it is on duty";
    trace.ram_soon(at, what, |state| state.ram.on_duty)
}

fn leaves_after_t_leave(trace: &Trace, (since, session, _): (u64, SessionId, bool)) -> Option<Met> {
    let t_leave_ms = trace.ms(|settings| settings.t_leave);
    let due_ms = since + t_safety_ms(trace, session) + t_leave_ms;
    let limit_ms = due_ms + trace.soon_ms();
    let mut after = trace.rams().filter(|(at, _)| *at > since);
    let broken = match after.find(|(_, state)| state.names_as_left(session)) {
        Some((at, _)) if at + trace.terms.early_ms < due_ms => {
            Some(format!("it left {} ms too early", due_ms - at))
        }
        Some((at, _)) if at > limit_ms => Some(format!("it left {} ms too late", at - due_ms)),
        Some(_) => None,
        None if trace.ended_ms >= limit_ms => Some(format!(
            "it had not left {} ms after the newest heartbeat",
            limit_ms - since
        )),
        None => return None,
    };
    Some(met_when(since, trace.situation_at(since + 300), broken))
}

fn echoes_what_it_heard(trace: &Trace) -> Vec<Met> {
    let mut all = Vec::new();
    let mut before: Option<Heartbeat> = None;
    // A new offer begins with whatever heartbeat it was made for.
    let mut begun = (None, 0);
    let mut situations = Vec::new();
    for (at, state) in trace.rams() {
        let Some((session, echo)) = state.echo() else {
            before = None;
            continue;
        };
        let part = (session, state.offer().map(|(_, offer)| offer));
        if begun.0 != Some(part) {
            begun = (Some(part), at);
            before = None;
        }
        let newest_by = |since: u64, until: u64| {
            let beats = trace.heartbeats(session);
            let beats = beats.filter(|(at, _)| (since..=until).contains(at));
            news(beats).last().map(|(_, heartbeat)| heartbeat)
        };
        let Some(newest) = newest_by(0, at) else {
            continue;
        };
        let soon_ms = trace.soon_ms();
        let settled = newest_by(begun.1, at.saturating_sub(soon_ms));
        let is_older = |than: &Heartbeat| than.is_newer_than(echo);
        let broken = if echo.is_newer_than(newest) {
            Some(format!(
                "it echoes {echo}, and the newest heartbeat was {newest}"
            ))
        } else if let Some(last) = before.filter(is_older) {
            Some(format!("it echoes {echo} after {last}"))
        } else {
            settled.filter(is_older).map(|settled| {
                format!("it echoes {echo}, and {settled} was sent {soon_ms} ms before")
            })
        };
        before = Some(echo);
        let situation = if state.offer().is_some() {
            "offering"
        } else {
            "following"
        };
        let is_news = !situations.contains(&situation);
        situations.push(situation);
        if broken.is_some() || is_news {
            all.push(met_when(at, situation, broken));
        }
    }
    all
}

fn heart_beats_in_time(trace: &Trace) -> Vec<Met> {
    let period_ms = trace.ms(|settings| settings.ram_period);
    let slack_ms = trace.terms.slack_ms;
    let mut all = Vec::new();
    let mut first: Option<(SessionId, u64, Heartbeat)> = None;
    let mut newest = (0, Heartbeat(0));
    for (at, state) in trace.rams() {
        let (Some(heartbeat), Some(session)) = (state.heartbeat(), state.session()) else {
            first = None;
            continue;
        };
        let Some((_, begun, begun_with)) = first.filter(|(known, ..)| *known == session) else {
            first = Some((session, at, heartbeat));
            newest = (at, heartbeat);
            continue;
        };
        let (newest_at, known) = newest;
        let periods = u64::from(heartbeat.distance_from(begun_with));
        let passed_ms = at - begun;
        // The first may have been on its way for longer than this one.
        let allowed = (passed_ms + slack_ms) / period_ms + 1;
        let late_ms = at - newest_at;
        let broken = if known.is_newer_than(heartbeat) {
            Some(format!("heartbeat {heartbeat} comes after {known}"))
        } else if periods > allowed {
            Some(format!(
                "heartbeat {heartbeat} comes {passed_ms} ms after heartbeat {begun_with}"
            ))
        } else if late_ms > 3 * period_ms + slack_ms && heartbeat == known {
            Some(format!(
                "for {late_ms} ms there was no heartbeat after {known}"
            ))
        } else {
            None
        };
        if heartbeat.is_newer_than(known) {
            newest = (at, heartbeat);
        }
        let is_tenth = periods == 5;
        if broken.is_some() || is_tenth {
            all.push(trace.met(at, broken));
        }
    }
    all
}
