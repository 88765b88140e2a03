//! How sessions end, and what is said of it.

use crossguard_protocol::{Availability, Coordination, Ending, Farewell, SessionId};

use super::{Met, Told, Trace, first_of_each, met_when, told};
use crate::exchange::RamSeen;
use crate::subject::Local;

statements! {
    "completed-sessions-free" "R19" completed_frees of played_ends:
        "A robot whose leader names the session as completed is free: no part, no duty, and its body stands.";
    "aborted-sessions-are-a-duty" "R19" aborted_is_a_duty:
        "A follower that executes when its session ends otherwise, or when it is not listed any more, is on duty.";
    "own-ends-are-named" "R19" own_ends_are_named of told:
        "A leader or requester names its session as completed when its pedestrian is across, and as aborted when it leaves.";
    "other-ends-change-nothing" "R1" other_ends_change_nothing of played_ends:
        "The end of another session changes no part.";
    "a-bare-none-releases-nobody" "R1" bare_none_changes_nothing:
        "A leader's RAM that says none, and names no session as ended, releases nobody.";
    "farewells-are-said-for-t-farewell" "R21" farewells_last:
        "What is left or ended is named in every RAM for t_farewell, and not for longer.";
    "leaving-is-named" "R21" leaving_is_named of told:
        "A helper or follower that wants to leave names the session as left.";
    "stale-sessions-are-named" "R21" stale_is_named:
        "A robot that hears of a session of its own which is over names it as ended, unless it is naming another one.";
    "a-clear-road-ends-a-duty" "R20" duty_ends:
        "A duty ends when the road is said to be clear, and nothing else ends it.";
    "unavailability-is-said" "R24" unavailability_is_said of told:
        "A robot that becomes unavailable says so in its RAM.";
    "unavailability-ends-the-part" "R24" unavailability_ends_the_part of told:
        "A helper, or a follower that executes nothing, leaves when it becomes unavailable; a requester or leader ends its session.";
}

/// The first RAM in which a station of the tester names a session as ended.
fn played_ends(trace: &Trace) -> Vec<(u64, SessionId, Ending)> {
    let ends = trace.played_rams().filter_map(|(at, played)| {
        let leader = played.ram.station;
        match played.ram.farewell? {
            Farewell::Ended(number, how) if leader != trace.robot => {
                Some((at, SessionId { leader, number }, how))
            }
            _ => None,
        }
    });
    first_of_each(ends, |(_, session, how)| (*session, *how)).collect()
}

fn completed_frees(trace: &Trace, (at, session, how): (u64, SessionId, Ending)) -> Option<Met> {
    let state = trace.state_at(at)?;
    if how != Ending::Completed || state.session() != Some(session) || state.ram.on_duty {
        return None;
    }
    let met = trace.ram_soon(at, "no RAM without part and duty", |state| {
        state.session() != Some(session) && !state.ram.on_duty
    })?;
    // A body needs a moment to stand.
    let stands_ms = at + trace.soon_ms();
    let until_ms = trace.undisturbed_until(at).max(stands_ms + 800);
    let mut later = trace.rams().filter(|(then, state)| {
        *then > stands_ms && *then <= until_ms && state.session().is_none()
    });
    let moves = later.find(|(_, state)| state.moves());
    let moves =
        moves.map(|(then, _)| format!("its body moves {} ms after it was released", then - at));
    let broken = met.broken.or(moves);
    Some(Met { broken, ..met })
}

fn aborted_is_a_duty(trace: &Trace) -> Vec<Met> {
    let aborted = played_ends(trace).into_iter();
    let aborted = aborted.filter(|(.., how)| *how == Ending::Aborted);
    let aborted = aborted.map(|(at, session, _)| (at, session, "aborted"));
    let not_listed = trace.played_rams().filter_map(|(at, played)| {
        let is_it = played.leads() && !played.lists(trace.robot);
        Some((at, played.session().filter(|_| is_it)?, "not listed"))
    });
    let causes = first_of_each(aborted.chain(not_listed), |(_, session, _)| *session);
    let judge = |(at, session, how): (u64, SessionId, &str)| {
        if trace.state_at(at)?.executes() != Some(session) {
            return None;
        }
        let what = "no RAM that says it is on duty and has no part";
        let met = trace.ram_soon(at, what, |state| {
            state.ram.on_duty && state.session() != Some(session)
        })?;
        let situation = format!("{}, {how}", met.situation);
        Some(Met { situation, ..met })
    };
    causes.filter_map(judge).collect()
}

fn own_ends_are_named(trace: &Trace, (at, local, state): Told) -> Option<Met> {
    let expected = match local {
        Local::TaskCompleted => Ending::Completed,
        Local::Leave => Ending::Aborted,
        _ => return None,
    };
    let farewell = Some(Farewell::Ended(state.own_number()?, expected));
    let what = "no RAM that names the session as ended so";
    trace.ram_soon(at, what, |state| state.ram.farewell == farewell)
}

fn leaving_is_named(trace: &Trace, (at, local, state): Told) -> Option<Met> {
    let (session, _) = state.echo().filter(|_| local == Local::Leave)?;
    let what = "no RAM that names the session as left";
    trace.ram_soon(at, what, |state| state.names_as_left(session))
}

fn other_ends_change_nothing(
    trace: &Trace,
    (at, session, _): (u64, SessionId, Ending),
) -> Option<Met> {
    let own = trace.state_at(at)?.session()?;
    // The other parts of that RAM must not be news.
    let spoke = trace
        .played_rams()
        .any(|(then, it)| it.ram.station == session.leader && then < at && then + 300 > at);
    if own == session || !spoke {
        return None;
    }
    Some(trace.met(at, trace.part_unchanged(at)?))
}

fn bare_none_changes_nothing(trace: &Trace) -> Vec<Met> {
    let none = trace.played_rams().filter(|(_, played)| {
        played.ram.coordination == Coordination::None && played.ram.farewell.is_none()
    });
    let judge = |(at, played): (u64, &RamSeen)| {
        let own = trace.state_at(at)?.session()?;
        if own.leader != played.ram.station {
            return None;
        }
        Some(trace.met(at, trace.part_unchanged(at)?))
    };
    none.filter_map(judge).take(1).collect()
}

fn farewells_last(trace: &Trace) -> Vec<Met> {
    let t_farewell_ms = trace.ms(|settings| settings.t_farewell);
    let period_ms = trace.ms(|settings| settings.ram_period);
    let mut all = Vec::new();
    let mut before: Option<Farewell> = None;
    for (at, state) in trace.rams() {
        let is_new = state.ram.farewell.filter(|it| before != Some(*it));
        before = state.ram.farewell;
        let Some(farewell) = is_new else { continue };
        let until_ms = at + t_farewell_ms;
        let end_ms = until_ms + trace.soon_ms();
        if trace.ended_ms < end_ms || trace.restarts().any(|then| then > at && then < end_ms) {
            continue;
        }
        let mut last_ms = at;
        let mut broken = None;
        let during = at + 1..=end_ms;
        for (then, state) in trace.rams().filter(|(then, _)| during.contains(then)) {
            let is_said = state.ram.farewell.is_some();
            let is_early = then + period_ms + trace.terms.early_ms < until_ms;
            let silent_ms = then - last_ms;
            if silent_ms > 3 * period_ms + trace.terms.slack_ms && last_ms + period_ms < until_ms {
                broken = Some(format!("for {silent_ms} ms it did not say it"));
            } else if !is_said && is_early && state.session().is_none() {
                broken = Some(format!("it says it for {} ms", last_ms - at));
            }
            if !is_said || broken.is_some() {
                break;
            }
            last_ms = then;
        }
        let still = trace
            .rams()
            .find(|(then, state)| *then > end_ms && state.ram.farewell == Some(farewell));
        let claimed = trace.played_rams().any(|(then, played)| {
            let session = played.session();
            let is_left = matches!(farewell, Farewell::Left(left, _) if session == Some(left));
            then > at && (is_left || session.is_some_and(|it| it.leader == trace.robot))
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

fn stale_is_named(trace: &Trace) -> Vec<Met> {
    let judge = |(at, played): (u64, &RamSeen)| {
        let ((claimed, _), state) = (played.echo()?, trace.state_at(at)?);
        let is_own = claimed.leader == trace.robot;
        let is_over = state.session() != Some(claimed);
        let names_another =
            |state: &RamSeen| state.ram.farewell.is_some() && !state.names_as_ended(claimed.number);
        // It may have begun to name another one just now.
        let next = trace.rams().find(|(then, _)| *then > at);
        let is_busy = names_another(state) || next.is_some_and(|(_, next)| names_another(next));
        if !is_own || !is_over || is_busy || played.ram.station == trace.robot {
            return None;
        }
        let what = "no RAM that names that session as ended";
        let met = trace.ram_soon(at, what, |state| state.names_as_ended(claimed.number))?;
        Some((claimed, met))
    };
    let stale = first_of_each(trace.played_rams().filter_map(judge), |(claimed, _)| {
        *claimed
    });
    stale.map(|(_, met)| met).collect()
}

fn duty_ends(trace: &Trace) -> Vec<Met> {
    let mut all = Vec::new();
    let mut before: Option<(u64, bool)> = None;
    let cleared = || trace.told().filter(|(_, local)| *local == Local::Clear);
    for (at, state) in trace.rams() {
        if let Some((then, true)) = before
            && !state.ram.on_duty
        {
            let during = then.saturating_sub(10_000)..=at;
            let is_said = cleared().any(|(told, _)| during.contains(&told));
            let restarted = trace.restarts().any(|told| during.contains(&told));
            // A robot may see by itself that nobody is on the road: then nobody at its side has to say so.
            let broken = (!is_said && !restarted && cleared().next().is_some())
                .then(|| "its duty ended before the road was said to be clear".to_owned());
            all.push(met_when(then, "on duty, ends", broken));
        }
        before = Some((at, state.ram.on_duty));
    }
    for (at, _) in cleared() {
        if trace.state_at(at).is_some_and(|state| state.ram.on_duty) {
            // A body has to finish its fallback first.
            all.extend(trace.ram_soon(at, "no RAM without duty", |state| !state.ram.on_duty));
        }
    }
    all
}

fn unavailability_is_said(trace: &Trace, (at, local, _): Told) -> Option<Met> {
    let Local::Unavailable(why) = local else {
        return None;
    };
    trace.ram_soon(at, "no RAM that says it is unavailable", |state| {
        state.availability == Availability::Unavailable(why)
    })
}

fn unavailability_ends_the_part(trace: &Trace, (at, local, state): Told) -> Option<Met> {
    let session = state.session()?;
    if !matches!(local, Local::Unavailable(_)) || state.executes().is_some() {
        return None;
    }
    let ended = state.own_number();
    let ended = ended.map(|number| Farewell::Ended(number, Ending::Aborted));
    let what = "no RAM that fails, leaves or ends";
    trace.ram_soon(at, what, |state| match ended {
        Some(_) => state.ram.farewell == ended,
        None => state.names_as_left(session),
    })
}
