//! A leader that commands.

use crossguard_protocol::{Command, Farewell, StationId};

use super::select::begun;
use super::{Breach, Met, Told, Trace, first_of_each, met_when, told};
use crate::exchange::RamSeen;
use crate::subject::Local;

statements! {
    "orders-are-commanded" "R10" orders_are_commanded of told:
        "What the leader's application orders goes out as a command to a follower that has nothing outstanding.";
    "commands-are-repeated-after-t-ack" "R10" repeated_after_t_ack:
        "A command that is not acknowledged is repeated after t_ack, unchanged.";
    "commands-are-repeated-n-ack-times" "R10" repeated_n_ack_times of (&sent):
        "A command is repeated n_ack times at most.";
    "the-follower-is-given-up" "R10" given_up of (&sent):
        "A follower that acknowledges nothing is not listed any more, t_ack after the last repetition.";
    "answers-end-the-repetition" "R10" answers_end_repetition of (&sent):
        "A command that is acknowledged or rejected is not repeated.";
    "reports-end-the-repetition" "R11" reports_end_repetition of (&sent):
        "A RAM that reports the command acknowledges it as well.";
    "other-answers-do-not-count" "R9" other_answers_do_not_count:
        "An answer of another session, for another command, or by another station acknowledges nothing: the command is repeated.";
    "one-command-is-outstanding" "R9" one_is_outstanding of told:
        "A follower is commanded anew only when it has answered the command before.";
    "silent-followers-are-dropped" "R13" silent_is_dropped:
        "A follower that echoes nothing is listed until its lease and t_lost are over, and not for longer.";
    "who-leaves-is-dropped-alone" "R22" who_leaves_is_dropped_alone:
        "A follower that names the session as left is not listed any more, and the others are as before.";
}

/// A command of the robot: when it was sent each time, and when it was answered.
pub(super) struct Sent {
    command: Command,
    times: Vec<u64>,
    /// When it was answered, and whether by a report in a RAM alone.
    pub(super) answered: Option<(u64, bool)>,
}

pub(super) fn sent(trace: &Trace) -> Vec<Sent> {
    let mut all: Vec<Sent> = Vec::new();
    for (at, command) in trace.commands() {
        let id = |it: Command| (it.session, it.to, it.request);
        match all.iter_mut().find(|sent| id(sent.command) == id(command)) {
            Some(sent) => sent.times.push(at),
            None => all.push(Sent {
                command,
                times: vec![at],
                answered: answered(trace, command),
            }),
        }
    }
    all
}

/// When a command was answered, and whether by a report in a RAM alone.
fn answered(trace: &Trace, command: Command) -> Option<(u64, bool)> {
    let Command {
        session,
        to,
        request,
        ..
    } = command;
    let answer = trace
        .played_answers()
        .find(|(_, it)| (it.session, it.from, it.request) == (session, to, request));
    let report = trace.played_rams().find(|(_, it)| {
        let last = it.following().filter(|(now, _)| *now == session);
        it.ram.station == to
            && last.is_some_and(|(_, last)| last.is_some_and(|last| last.request == request))
    });
    let answer = answer.map(|(at, _)| (at, false));
    // Of both at once, the answer counts.
    answer
        .into_iter()
        .chain(report.map(|(at, _)| (at, true)))
        .min()
}

/// Until when nothing but a repetition is to be expected of a command.
fn waits_until(trace: &Trace, sent: &Sent) -> u64 {
    let mut later = trace.rams().filter(|(at, _)| *at > sent.times[0]);
    let ended = later.find(|(_, state)| state.session() != Some(sent.command.session));
    let ends = [
        sent.answered.map(|(at, _)| at),
        ended.map(|(at, _)| at),
        trace.restarts().find(|at| *at > sent.times[0]),
    ];
    ends.into_iter().flatten().fold(trace.ended_ms, u64::min)
}

fn repeated_after_t_ack(trace: &Trace) -> Vec<Met> {
    let t_ack_ms = trace.ms(|settings| settings.t_ack);
    let limit_ms = t_ack_ms + trace.soon_ms();
    let n_ack = usize::from(trace.terms.settings.n_ack);
    let mut all = Vec::new();
    for sent in sent(trace) {
        let until_ms = waits_until(trace, &sent);
        for (i, at) in sent.times.iter().enumerate() {
            let broken = match sent.times.get(i + 1).map(|next| next - at) {
                Some(after_ms)
                    if after_ms + trace.terms.early_ms < t_ack_ms || after_ms > limit_ms =>
                {
                    Some(format!("it repeats the command after {after_ms} ms"))
                }
                Some(_) => None,
                None if i >= n_ack || until_ms < at + limit_ms => continue,
                None => Some(format!(
                    "within {limit_ms} ms it does not repeat the command"
                )),
            };
            all.push(met_when(*at, format!("transmission {}", i + 1), broken));
        }
    }
    all
}

fn repeated_n_ack_times(trace: &Trace, sent: &Sent) -> Option<Met> {
    let n_ack = usize::from(trace.terms.settings.n_ack);
    let repeats = sent.times.len() - 1;
    let last = *sent.times.last()?;
    let broken = (repeats > n_ack).then(|| format!("it repeats the command {repeats} times"));
    // One repetition more would have been seen.
    let is_met =
        repeats >= n_ack && trace.ended_ms > last + trace.ms(|s| s.t_ack) + trace.soon_ms();
    (is_met || broken.is_some()).then(|| met_when(sent.times[0], "unacknowledged", broken))
}

fn given_up(trace: &Trace, sent: &Sent) -> Option<Met> {
    let n_ack = usize::from(trace.terms.settings.n_ack);
    let (last, to) = (*sent.times.last()?, sent.command.to);
    let due_ms = last + trace.ms(|settings| settings.t_ack) + trace.soon_ms();
    if sent.times.len() <= n_ack || sent.answered.is_some() || trace.ended_ms < due_ms {
        return None;
    }
    let is_kept = trace.state_at(due_ms)?.lists(to);
    let broken = is_kept.then(|| format!("it still lists {to}"));
    Some(met_when(last, "unacknowledged", broken))
}

/// Whether a command goes on after it was answered; only where a repetition would have been due by the end.
fn goes_on(trace: &Trace, sent: &Sent, answered_ms: u64) -> Option<Breach> {
    let on_its_way_ms = answered_ms + trace.terms.slack_ms.min(250);
    let mut times = sent.times.iter();
    let last = times.clone().filter(|at| **at <= on_its_way_ms).max()?;
    if trace.ended_ms < last + trace.ms(|s| s.t_ack) + trace.soon_ms() {
        return None;
    }
    let later = times.find(|at| **at > on_its_way_ms);
    let later = later.map(|at| at - answered_ms);
    Some(later.map(|ms| format!("it repeats the command {ms} ms after the answer")))
}

fn answers_end_repetition(trace: &Trace, sent: &Sent) -> Option<Met> {
    let (at, by_report) = sent.answered?;
    if by_report {
        return None;
    }
    Some(trace.met(at, goes_on(trace, sent, at)?))
}

fn reports_end_repetition(trace: &Trace, sent: &Sent) -> Option<Met> {
    let (at, by_report) = sent.answered?;
    let soon = at..=at + trace.ms(|s| s.t_ack);
    let is_late = trace
        .played_answers()
        .all(|(then, _)| !soon.contains(&then));
    if !by_report || !is_late {
        return None;
    }
    Some(trace.met(at, goes_on(trace, sent, at)?))
}

fn other_answers_do_not_count(trace: &Trace) -> Vec<Met> {
    let limit_ms = trace.ms(|settings| settings.t_ack) + trace.terms.slack_ms;
    let n_ack = usize::from(trace.terms.settings.n_ack);
    let mut all: Vec<Met> = Vec::new();
    for sent in sent(trace) {
        let command = sent.command;
        for (at, answer) in trace.played_answers() {
            let how = if answer.session != command.session {
                "in another session"
            } else if answer.from != command.to {
                "by another station"
            } else if answer.request != command.request {
                "for another command"
            } else {
                continue;
            };
            let before = sent.times.iter().filter(|then| **then <= at).count();
            let is_outstanding =
                before > 0 && before <= n_ack && waits_until(trace, &sent) >= at + limit_ms;
            let is_known = all.iter().any(|met| met.situation == how);
            if !is_outstanding || is_known {
                continue;
            }
            let due = at + 1..=at + limit_ms;
            let is_repeated = sent.times.iter().any(|then| due.contains(then));
            let broken = (!is_repeated).then(|| "the command is not repeated".to_owned());
            all.push(met_when(at, how, broken));
        }
    }
    all
}

fn orders_are_commanded(trace: &Trace, (at, local, state): Told) -> Option<Met> {
    let all_sent = sent(trace);
    let Local::Order(to, task) = local else {
        return None;
    };
    let session = state.session()?;
    let has_joined = trace.played_rams().any(|(then, played)| {
        then + 200 < at && played.ram.station == to && played.follows(session)
    });
    let is_bound = all_sent.iter().any(|sent| {
        sent.command.to == to
            && sent.times[0] < at
            && sent.answered.is_none_or(|(then, _)| then + 200 > at)
    });
    let may_be_on_road = trace
        .told()
        .any(|(then, local)| local == Local::Open && then < at);
    if !has_joined || is_bound || may_be_on_road || !state.lists(to) {
        return None;
    }
    trace.due(at, trace.soon_ms(), "no command", |said| {
        said.command()
            .is_some_and(|it| (it.to, it.task) == (to, task))
    })
}

fn one_is_outstanding(trace: &Trace, (at, local, _): Told) -> Option<Met> {
    let all_sent = sent(trace);
    let Local::Order(to, _) = local else {
        return None;
    };
    let mut to_it = all_sent.iter().filter(|sent| sent.command.to == to);
    let waiting = to_it
        .clone()
        .find(|sent| sent.times[0] < at && sent.answered.is_none_or(|(then, _)| then > at))?;
    let until_ms = waits_until(trace, waiting).min(trace.undisturbed_until(at));
    let newer = to_it.find(|sent| {
        sent.command.session == waiting.command.session
            && sent.command.request.is_newer_than(waiting.command.request)
            && sent.times[0] <= until_ms
    });
    let broken = newer.map(|sent| format!("it sends command {}", sent.command.request));
    Some(met_when(
        at,
        "an order while a command is outstanding",
        broken,
    ))
}

fn silent_is_dropped(trace: &Trace) -> Vec<Met> {
    let lost_ms = trace.ms(|s| s.t_safety) + trace.ms(|s| s.t_leave);
    let limit_ms = trace.ms(|s| s.t_lease) + lost_ms + trace.soon_ms();
    let mut all = Vec::new();
    for (_, session, ..) in begun(trace) {
        for id in trace.players {
            let Some((since, _)) = super::news(trace.echoes(session, id)).last() else {
                continue;
            };
            let outstanding = sent(trace)
                .iter()
                .any(|sent| sent.command.to == id && sent.answered.is_none());
            let has_left = trace.played_rams().any(|(_, played)| {
                played.ram.station == id && matches!(played.ram.farewell, Some(Farewell::Left(..)))
            });
            let intervened = trace.told().any(|(at, _)| at > since)
                || trace.restarts().any(|at| at + 1_000 > since);
            if outstanding || has_left || intervened || trace.ended_ms < since + limit_ms {
                continue;
            }
            let last = trace.rams().rfind(|(_, state)| state.lists(id));
            let kept_ms = last.map_or(since, |(at, _)| at) - since;
            let broken = if kept_ms > limit_ms {
                Some(format!(
                    "it still lists {id} {kept_ms} ms after its newest echo"
                ))
            } else {
                (kept_ms + 300 + trace.terms.slack_ms < lost_ms)
                    .then(|| format!("it drops {id} {kept_ms} ms after its newest echo"))
            };
            all.push(met_when(since, "a silent follower", broken));
        }
    }
    all
}

fn who_leaves_is_dropped_alone(trace: &Trace) -> Vec<Met> {
    let leaving = trace.played_rams().filter_map(|(at, played)| {
        let (state, leaver) = (trace.state_at(at)?, played.ram.station);
        let of_it = state.session().is_some_and(|it| played.names_as_left(it));
        (of_it && state.lists(leaver)).then_some((at, leaver, state))
    });
    let judge = |(at, leaver, state): (u64, StationId, &RamSeen)| {
        let mut others = state.listed();
        others.retain(|(station, _)| *station != leaver);
        let what = "no RAM that lists the others alone";
        let met = trace.ram_soon(at, what, |state| state.listed() == others)?;
        let situation = format!("{} followers are left", others.len());
        Some(Met { situation, ..met })
    };
    let first = first_of_each(leaving, |(_, leaver, _)| *leaver);
    first.filter_map(judge).collect()
}
