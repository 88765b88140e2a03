//! A leader that commands.

use crossguard_protocol::{Answer, Command, Coordination, Farewell, RequestId, StationId};

use super::select::{begun, listed};
use super::{Breach, Met, due, met, met_when};
use crate::bench::Terms;
use crate::exchange::{Exchange, Happening, Message, RamSeen, following, session_of};
use crate::subject::Local;

statements! {
    "orders-are-commanded" "R10" orders_are_commanded:
        "What the leader's application orders goes out as a command to a follower that has nothing outstanding.";
    "commands-are-repeated-after-t-ack" "R10" repeated_after_t_ack:
        "A command that is not acknowledged is repeated after t_ack, unchanged.";
    "commands-are-repeated-n-ack-times" "R10" repeated_n_ack_times:
        "A command is repeated n_ack times at most.";
    "the-follower-is-given-up" "R10" given_up:
        "A follower that acknowledges nothing is not listed any more, t_ack after the last repetition.";
    "answers-end-the-repetition" "R10" answers_end_repetition:
        "A command that is acknowledged or rejected is not repeated.";
    "reports-end-the-repetition" "R11" reports_end_repetition:
        "A RAM that reports the command acknowledges it as well.";
    "other-answers-do-not-count" "R9" other_answers_do_not_count:
        "An answer of another session, for another command, or by another station acknowledges nothing: the command is repeated.";
    "one-command-is-outstanding" "R9" one_is_outstanding:
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

pub(super) fn sent(exchange: &Exchange) -> Vec<Sent> {
    let mut all: Vec<Sent> = Vec::new();
    for (at, command) in exchange.commands() {
        let is_it = |sent: &&mut Sent| {
            let known = sent.command;
            (known.session, known.to, known.request)
                == (command.session, command.to, command.request)
        };
        match all.iter_mut().find(is_it) {
            Some(sent) => sent.times.push(at),
            None => all.push(Sent {
                command,
                times: vec![at],
                answered: None,
            }),
        }
    }
    for sent in &mut all {
        let command = sent.command;
        let matches = |answer: &Answer| {
            (answer.session, answer.from, answer.request)
                == (command.session, command.to, command.request)
        };
        let mut answers = exchange.played_answers();
        let answered = answers
            .find(|(_, answer)| matches(answer))
            .map(|(at, _)| at);
        let reported = exchange.played_rams().find(|(_, _, played)| {
            played.ram.station == command.to
                && following(&played.ram).is_some_and(|(session, last)| {
                    session == command.session
                        && last.is_some_and(|last| last.request == command.request)
                })
        });
        let reported = reported.map(|(at, ..)| at);
        sent.answered = match (answered, reported) {
            (Some(at), reported) if reported.is_none_or(|then| at <= then) => Some((at, false)),
            (_, Some(at)) => Some((at, true)),
            _ => None,
        };
    }
    all
}

/// Until when nothing but a repetition is to be expected of a command.
fn waits_until(exchange: &Exchange, sent: &Sent) -> u64 {
    let ended = exchange.rams().find(|(at, state)| {
        *at > sent.times[0] && session_of(&state.ram) != Some(sent.command.session)
    });
    let ends = [
        sent.answered.map(|(at, _)| at),
        ended.map(|(at, _)| at),
        exchange.restarts().find(|at| *at > sent.times[0]),
    ];
    let end = ends.into_iter().flatten().min();
    end.unwrap_or(exchange.ended_ms).min(exchange.ended_ms)
}

fn repeated_after_t_ack(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let t_ack_ms = terms.ms(|settings| settings.t_ack);
    let limit_ms = t_ack_ms + terms.soon_ms();
    let n_ack = usize::from(terms.settings.n_ack);
    let mut all = Vec::new();
    for sent in sent(exchange) {
        let until_ms = waits_until(exchange, &sent);
        for (i, at) in sent.times.iter().enumerate() {
            let next = sent.times.get(i + 1).copied();
            let broken = match next {
                Some(next) if next - at + terms.early_ms < t_ack_ms => {
                    Some(format!("it repeats the command after {} ms", next - at))
                }
                Some(next) if next - at > limit_ms => {
                    Some(format!("it repeats the command after {} ms", next - at))
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

fn repeated_n_ack_times(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let n_ack = usize::from(terms.settings.n_ack);
    let judge = |sent: Sent| {
        let repeats = sent.times.len() - 1;
        let last = *sent.times.last()?;
        let broken = (repeats > n_ack).then(|| format!("it repeats the command {repeats} times"));
        // One repetition more would have been seen.
        let is_met =
            repeats >= n_ack && exchange.ended_ms > last + terms.ms(|s| s.t_ack) + terms.soon_ms();
        (is_met || broken.is_some()).then(|| met_when(sent.times[0], "unacknowledged", broken))
    };
    sent(exchange).into_iter().filter_map(judge).collect()
}

fn given_up(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let n_ack = usize::from(terms.settings.n_ack);
    let judge = |sent: Sent| {
        let last = *sent.times.last()?;
        let limit_ms = terms.ms(|settings| settings.t_ack) + terms.soon_ms();
        if sent.times.len() <= n_ack
            || sent.answered.is_some()
            || exchange.ended_ms < last + limit_ms
        {
            return None;
        }
        let (_, state) = exchange.state_at(last + limit_ms)?;
        let is_kept = listed(state)
            .iter()
            .any(|(station, _)| *station == sent.command.to);
        let broken = is_kept.then(|| format!("it still lists {}", sent.command.to));
        Some(met_when(last, "unacknowledged", broken))
    };
    sent(exchange).into_iter().filter_map(judge).collect()
}

/// Whether a command goes on after it was answered; only where a repetition would have been due by the end.
fn goes_on(exchange: &Exchange, terms: &Terms, sent: &Sent, answered_ms: u64) -> Option<Breach> {
    let last = sent
        .times
        .iter()
        .filter(|at| **at <= answered_ms + terms.slack_ms.min(250))
        .max()?;
    if exchange.ended_ms < last + terms.ms(|s| s.t_ack) + terms.soon_ms() {
        return None;
    }
    let later = sent
        .times
        .iter()
        .find(|at| **at > answered_ms + terms.slack_ms.min(250));
    Some(later.map(|at| {
        format!(
            "it repeats the command {} ms after the answer",
            at - answered_ms
        )
    }))
}

fn answers_end_repetition(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let judge = |sent: Sent| {
        let (at, by_report) = sent.answered?;
        if by_report {
            return None;
        }
        Some(met(exchange, at, goes_on(exchange, terms, &sent, at)?))
    };
    sent(exchange).into_iter().filter_map(judge).collect()
}

fn reports_end_repetition(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let judge = |sent: Sent| {
        let (at, by_report) = sent.answered?;
        let is_late = exchange
            .played_answers()
            .all(|(then, _)| then < at || then > at + terms.ms(|s| s.t_ack));
        if !by_report || !is_late {
            return None;
        }
        Some(met(exchange, at, goes_on(exchange, terms, &sent, at)?))
    };
    sent(exchange).into_iter().filter_map(judge).collect()
}

fn other_answers_do_not_count(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let limit_ms = terms.ms(|settings| settings.t_ack) + terms.slack_ms;
    let n_ack = usize::from(terms.settings.n_ack);
    let mut all: Vec<Met> = Vec::new();
    for sent in sent(exchange) {
        let command = sent.command;
        for (at, answer) in exchange.played_answers() {
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
                before > 0 && before <= n_ack && waits_until(exchange, &sent) >= at + limit_ms;
            let is_known = all.iter().any(|met| met.situation == how);
            if !is_outstanding || is_known {
                continue;
            }
            let is_repeated = sent
                .times
                .iter()
                .any(|then| *then > at && *then <= at + limit_ms);
            let broken = (!is_repeated).then(|| "the command is not repeated".to_owned());
            all.push(met_when(at, how, broken));
        }
    }
    all
}

fn orders_are_commanded(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let all_sent = sent(exchange);
    let judge = |(at, local): (u64, Local)| {
        let Local::Order(to, task) = local else {
            return None;
        };
        let (_, state) = exchange.state_at(at)?;
        let session = session_of(&state.ram)?;
        let has_joined = exchange.played_rams().any(|(then, _, played)| {
            then + 200 < at
                && played.ram.station == to
                && following(&played.ram).is_some_and(|(now, _)| now == session)
        });
        let is_bound = all_sent.iter().any(|sent| {
            sent.command.to == to
                && sent.times[0] < at
                && sent.answered.is_none_or(|(then, _)| then + 200 > at)
        });
        let may_be_on_road = exchange
            .told()
            .any(|(then, local)| local == Local::Open && then < at);
        let is_listed = listed(state).iter().any(|(station, _)| *station == to);
        if !has_joined || is_bound || may_be_on_road || !is_listed {
            return None;
        }
        due(exchange, at, terms.soon_ms(), "no command", |seen| {
            matches!(&seen.what, Happening::Said(Message::Command(command))
                if command.to == to && command.task == task && seen.at_ms >= at)
        })
    };
    exchange.told().filter_map(judge).collect()
}

fn one_is_outstanding(exchange: &Exchange, _: &Terms) -> Vec<Met> {
    let all_sent = sent(exchange);
    let mut all = Vec::new();
    for (at, local) in exchange.told() {
        let Local::Order(to, _) = local else { continue };
        let waiting = all_sent.iter().find(|sent| {
            sent.command.to == to
                && sent.times[0] < at
                && sent.answered.is_none_or(|(then, _)| then > at)
        });
        let Some(waiting) = waiting else { continue };
        let is_newer = |request: RequestId| request.is_newer_than(waiting.command.request);
        let until_ms = waits_until(exchange, waiting).min(exchange.undisturbed_until(at));
        let newer = all_sent.iter().find(|sent| {
            sent.command.to == to
                && sent.command.session == waiting.command.session
                && is_newer(sent.command.request)
                && sent.times[0] <= until_ms
        });
        let broken = newer.map(|sent| format!("it sends command {}", sent.command.request));
        all.push(met_when(
            at,
            "an order while a command is outstanding",
            broken,
        ));
    }
    all
}

fn silent_is_dropped(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let lost_ms = terms.ms(|s| s.t_safety) + terms.ms(|s| s.t_leave);
    let lease_ms = terms.ms(|s| s.t_lease);
    let mut all = Vec::new();
    for (_, session, ..) in begun(exchange) {
        for id in exchange.players {
            let echoes = exchange.played_rams().filter_map(|(at, _, played)| {
                match played.ram.coordination {
                    Coordination::Follower {
                        session: now, echo, ..
                    } if now == session && played.ram.station == id => Some((at, echo)),
                    _ => None,
                }
            });
            let Some((since, _)) = super::news(echoes).last() else {
                continue;
            };
            let outstanding = sent(exchange)
                .iter()
                .any(|sent| sent.command.to == id && sent.answered.is_none());
            let has_left = exchange.played_rams().any(|(_, _, played)| {
                played.ram.station == id && matches!(played.ram.farewell, Some(Farewell::Left(..)))
            });
            let limit_ms = lease_ms + lost_ms + terms.soon_ms();
            let intervened = exchange.told().any(|(at, _)| at > since)
                || exchange.restarts().any(|at| at + 1_000 > since);
            if outstanding || has_left || intervened || exchange.ended_ms < since + limit_ms {
                continue;
            }
            let is_listed =
                |state: &RamSeen| listed(state).iter().any(|(station, _)| *station == id);
            let last = exchange.rams().rfind(|(_, state)| is_listed(state));
            let last = last.map_or(since, |(at, _)| at);
            let kept_ms = last - since;
            let broken = if kept_ms > limit_ms {
                Some(format!(
                    "it still lists {id} {kept_ms} ms after its newest echo"
                ))
            } else if kept_ms + 300 + terms.slack_ms < lost_ms {
                Some(format!("it drops {id} {kept_ms} ms after its newest echo"))
            } else {
                None
            };
            all.push(met_when(since, "a silent follower", broken));
        }
    }
    all
}

fn who_leaves_is_dropped_alone(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let mut all: Vec<Met> = Vec::new();
    let mut known: Vec<StationId> = Vec::new();
    for (at, _, played) in exchange.played_rams() {
        let Some(Farewell::Left(session, _)) = played.ram.farewell else {
            continue;
        };
        let leaver = played.ram.station;
        let Some((_, state)) = exchange.state_at(at) else {
            continue;
        };
        let before = listed(state);
        let is_listed = before.iter().any(|(station, _)| *station == leaver);
        if session_of(&state.ram) != Some(session) || !is_listed || known.contains(&leaver) {
            continue;
        }
        known.push(leaver);
        let others: Vec<_> = before.into_iter().filter(|(it, _)| *it != leaver).collect();
        let what = "no RAM that lists the others alone";
        let met_here = due(
            exchange,
            at,
            terms.soon_ms(),
            what,
            |seen| matches!(&seen.what, Happening::Said(Message::Ram(state)) if listed(state) == others),
        );
        let situation = format!("{} followers are left", others.len());
        all.extend(met_here.map(|met| met_when(at, situation, met.broken)));
    }
    all
}
