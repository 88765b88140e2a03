//! A follower and its commands.

use crossguard_protocol::{
    Answer, Availability, Command, Progress, Rejection, Report, SessionId, TaskSet, Verdict,
};

use super::{Breach, Met, afterwards, due, met};
use crate::bench::Terms;
use crate::exchange::{Exchange, Happening, Message, RamSeen, Seen, following, offer_of};
use crate::subject::Local;
use crate::words;

statements! {
    "acknowledged-before-executed" "R7" acknowledged_before_executed:
        "A command is acknowledged by an RMCM before a RAM reports it.";
    "commands-are-answered" "R7" commands_are_answered:
        "A new command of the own leader is answered.";
    "impossible-commands-are-rejected" "R7" impossible_is_rejected:
        "A command for a task that was not offered is rejected, with that reason.";
    "repeats-are-acknowledged-again" "R8" repeats_are_answered:
        "A repeated command is answered as before.";
    "repeats-start-nothing" "R8" repeats_start_nothing:
        "A repeated command is not started again: its progress does not go back, and a body that stands goes on standing.";
    "older-commands-change-nothing" "R8" older_changes_nothing:
        "A command that is older than the newest one is not answered and not started.";
    "commands-of-other-sessions-change-nothing" "R1" elsewhere_changes_nothing:
        "A command of another session is not answered and not started.";
    "commands-to-others-change-nothing" "R1" to_others_changes_nothing:
        "A command to another station is not answered and not started.";
    "fallen-back-stays" "R15" fallen_back_stays:
        "A command that fell back is never reported as running again, whatever is repeated.";
    "progress-is-reported" "R11" progress_is_reported:
        "What the body has done is reported in a RAM that names session, command and progress.";
    "unavailable-robots-reject" "R24" unavailable_rejects:
        "An unavailable follower rejects a new command, with that reason.";
    "robots-on-duty-reject" "R20" on_duty_rejects:
        "A follower that is on duty rejects a new command, with that reason, unless it is to go on with what it fell back from.";
}

/// A body that moves faster than this is under way, in m/s.
const MOVES_MPS: f64 = 0.5;

fn is_answer(seen: &Seen, is_it: impl Fn(&Answer) -> bool) -> bool {
    matches!(&seen.what, Happening::Said(Message::Answer(answer)) if is_it(answer))
}

/// The commands of the session in which the robot follows at that time, each time they were sent: with when the
/// robot's newest RAM says so.
fn own_commands(exchange: &Exchange) -> impl Iterator<Item = (u64, Command, Option<Report>)> + '_ {
    exchange.played_commands().filter_map(|(at, command)| {
        let (_, state) = exchange.state_at(at)?;
        let (session, last) = following(&state.ram)?;
        let is_own = command.session == session && command.to == exchange.robot;
        is_own.then_some((at, command, last))
    })
}

/// The first transmissions of commands that are newer than all before.
fn new_commands(exchange: &Exchange) -> Vec<(u64, Command, Option<Report>)> {
    let mut new: Vec<(u64, Command, Option<Report>)> = Vec::new();
    for (at, command, last) in own_commands(exchange) {
        let is_newer = new.iter().all(|(_, known, _)| {
            known.session != command.session || command.request.is_newer_than(known.request)
        });
        let is_news = last.is_none_or(|last| command.request.is_newer_than(last.request));
        if is_newer && is_news {
            new.push((at, command, last));
        }
    }
    new
}

fn acknowledged_before_executed(exchange: &Exchange, _: &Terms) -> Vec<Met> {
    let mut found: Vec<(SessionId, Report)> = Vec::new();
    let mut all = Vec::new();
    for (at, state) in exchange.rams() {
        let Some((session, Some(report))) = following(&state.ram) else {
            continue;
        };
        let is_known = |(s, r): &(SessionId, Report)| *s == session && r.request == report.request;
        if found.iter().any(is_known) {
            continue;
        }
        found.push((session, report));
        let mut answers = exchange.answers().filter(|(then, _)| *then <= at);
        let is_acknowledged = answers.any(|(_, answer)| {
            answer.session == session
                && answer.request == report.request
                && answer.verdict == Verdict::Accepted
        });
        let broken = (!is_acknowledged).then(|| {
            let (request, progress) = (report.request, words::progress(report.progress));
            format!("it reports command {request} as {progress}, which it has not acknowledged")
        });
        all.push(met(exchange, at.saturating_sub(1), broken));
    }
    all
}

/// How long after its first transmission a command that is sent four times has to be answered.
fn patience_ms(terms: &Terms) -> u64 {
    terms.soon_ms()
}

fn commands_are_answered(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let judge = |(at, command, _): (u64, Command, Option<Report>)| {
        due(exchange, at, patience_ms(terms), "no answer", |seen| {
            is_answer(seen, |answer| {
                answer.session == command.session && answer.request == command.request
            })
        })
    };
    new_commands(exchange)
        .into_iter()
        .filter_map(judge)
        .collect()
}

/// New commands that must be rejected for a reason, where the robot's newest RAM is of that kind.
fn rejected_where(
    exchange: &Exchange,
    terms: &Terms,
    is_case: impl Fn(&RamSeen, &Command) -> bool,
    is_reason: impl Fn(Rejection) -> bool,
) -> Vec<Met> {
    let judge = |(at, command, _): (u64, Command, Option<Report>)| {
        let (_, state) = exchange.state_at(at)?;
        if !is_case(state, &command) {
            return None;
        }
        let what = "no rejection with that reason";
        due(exchange, at, patience_ms(terms), what, |seen| {
            is_answer(seen, |answer| {
                answer.session == command.session
                    && answer.request == command.request
                    && matches!(answer.verdict, Verdict::Rejected(why) if is_reason(why))
            })
        })
    };
    new_commands(exchange)
        .into_iter()
        .filter_map(judge)
        .collect()
}

/// The tasks that the robot offered.
fn offered(exchange: &Exchange) -> Option<TaskSet> {
    let mut offers = exchange.rams().filter_map(|(_, state)| {
        offer_of(&state.ram)?;
        match state.ram.coordination {
            crossguard_protocol::Coordination::OfferHelp { capabilities, .. } => Some(capabilities),
            _ => None,
        }
    });
    offers.next()
}

fn impossible_is_rejected(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let Some(offered) = offered(exchange) else {
        return Vec::new();
    };
    let is_case = |state: &RamSeen, command: &Command| {
        !offered.contains(command.task)
            && !state.ram.on_duty
            && state.availability == Availability::Available
    };
    rejected_where(exchange, terms, is_case, |why| {
        why == Rejection::UnsupportedTask
    })
}

fn unavailable_rejects(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let is_case = |state: &RamSeen, _: &Command| state.availability != Availability::Available;
    rejected_where(exchange, terms, is_case, |why| {
        matches!(why, Rejection::Unavailable(_))
    })
}

fn on_duty_rejects(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let is_case = |state: &RamSeen, command: &Command| {
        state.ram.on_duty
            && state.availability == Availability::Available
            && !takes_up(exchange, state, command)
    };
    rejected_where(exchange, terms, is_case, |why| why == Rejection::OnDuty)
}

/// Whether a command is to do again what the robot falls back from in the same session.
fn takes_up(exchange: &Exchange, state: &RamSeen, command: &Command) -> bool {
    let Some((session, Some(report))) = following(&state.ram) else {
        return false;
    };
    own_commands(exchange).any(|(_, first, _)| {
        first.session == session
            && first.request == report.request
            && (first.session, first.task) == (command.session, command.task)
    })
}

/// The first transmission of each play that repeats a command which was answered before.
fn repeats(exchange: &Exchange) -> Vec<(u64, Command, Option<Report>, Verdict)> {
    let mut all: Vec<(u64, Command, Option<Report>, Verdict)> = Vec::new();
    for (at, command, last) in own_commands(exchange) {
        let play_ms = play_before(exchange, at);
        let mut before = exchange.answers().filter(|(then, _)| *then < play_ms);
        let answer = before.find(|(_, answer)| {
            answer.session == command.session && answer.request == command.request
        });
        let is_newest = last.is_none_or(|last| last.request == command.request);
        let is_first = all.iter().all(|(then, ..)| *then < play_ms);
        if let (Some((_, answer)), true, true) = (answer, is_newest, is_first) {
            all.push((at, command, last, answer.verdict));
        }
    }
    all
}

/// When the play began in which something was sent.
fn play_before(exchange: &Exchange, at_ms: u64) -> u64 {
    let plays = exchange.seen.iter().rev();
    let mut plays = plays.filter(|seen| matches!(seen.what, Happening::Play(_)));
    let play = plays.find(|seen| seen.at_ms <= at_ms);
    play.map_or(0, |seen| seen.at_ms)
}

fn repeats_are_answered(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let judge = |(at, command, _, verdict): (u64, Command, Option<Report>, Verdict)| {
        let what = "no answer to the repeated command like the one before";
        due(exchange, at, patience_ms(terms), what, |seen| {
            is_answer(seen, |answer| {
                answer.session == command.session
                    && answer.request == command.request
                    && answer.verdict == verdict
            })
        })
    };
    repeats(exchange).into_iter().filter_map(judge).collect()
}

/// How far a progress is: it never gets less.
const fn rank(progress: Progress) -> u8 {
    match progress {
        Progress::Executing => 0,
        Progress::InPosition => 1,
        Progress::Completed | Progress::Failed(_) | Progress::SafeIdle => 2,
    }
}

/// Whether the robot starts something anew after `at_ms`; `None` if nothing was heard of it.
fn starts_anew(exchange: &Exchange, at_ms: u64) -> Option<Breach> {
    let (_, before) = exchange.state_at(at_ms)?;
    let (session, last) = following(&before.ram)?;
    let stands = |state: &RamSeen| {
        state
            .speed_mps
            .is_some_and(|speed| speed.abs() <= MOVES_MPS)
    };
    let stood = stands(before) && last.is_none_or(|last| rank(last.progress) > 0);
    let mut heard = false;
    for (at, state) in afterwards(exchange, at_ms) {
        heard = true;
        let later_ms = at - at_ms;
        let Some((now_in, now)) = following(&state.ram) else {
            continue;
        };
        if now_in != session {
            continue;
        }
        match (last, now) {
            (_, None) => {}
            (None, Some(now)) => {
                let request = now.request;
                return Some(Some(format!(
                    "it reports command {request} {later_ms} ms later"
                )));
            }
            (Some(last), Some(now)) => {
                let (request, progress) = (now.request, words::progress(now.progress));
                let is_older = last.request.is_newer_than(now.request);
                let goes_back =
                    last.request == now.request && rank(now.progress) < rank(last.progress);
                if is_older || goes_back || now.request != last.request {
                    let text =
                        format!("it reports command {request} as {progress} {later_ms} ms later");
                    return Some(Some(text));
                }
            }
        }
        if stood && !state.ram.on_duty && state.speed_mps.is_some_and(|speed| speed > MOVES_MPS) {
            return Some(Some(format!("its body sets out {later_ms} ms later")));
        }
    }
    heard.then_some(None)
}

fn repeats_start_nothing(exchange: &Exchange, _: &Terms) -> Vec<Met> {
    let repeats = repeats(exchange).into_iter();
    let judge = |(at, ..): (u64, Command, Option<Report>, Verdict)| {
        Some(met(exchange, at, starts_anew(exchange, at)?))
    };
    repeats.filter_map(judge).collect()
}

fn fallen_back_stays(exchange: &Exchange, _: &Terms) -> Vec<Met> {
    let fell_back =
        |last: &Option<Report>| last.is_some_and(|last| last.progress == Progress::SafeIdle);
    let repeats = repeats(exchange).into_iter();
    let repeats = repeats.filter(|(_, _, last, _)| fell_back(last));
    let judge = |(at, ..): (u64, Command, Option<Report>, Verdict)| {
        Some(met(exchange, at, starts_anew(exchange, at)?))
    };
    repeats.filter_map(judge).collect()
}

/// What must not be answered and must start nothing.
fn changes_nothing(exchange: &Exchange, at_ms: u64, command: Command) -> Option<Met> {
    let until_ms = exchange.undisturbed_until(at_ms);
    let mut answers = exchange.answers();
    let answered = answers.any(|(at, answer)| {
        (at_ms..until_ms).contains(&at)
            && answer.session == command.session
            && answer.request == command.request
    });
    let broken = if answered {
        Some(format!("it answers command {}", command.request))
    } else {
        starts_anew(exchange, at_ms)?
    };
    Some(met(exchange, at_ms, broken))
}

fn older_changes_nothing(exchange: &Exchange, _: &Terms) -> Vec<Met> {
    let older = own_commands(exchange).filter(|(_, command, last)| {
        last.is_some_and(|last| last.request.is_newer_than(command.request))
    });
    older
        .filter_map(|(at, command, _)| changes_nothing(exchange, at, command))
        .collect()
}

fn elsewhere_changes_nothing(exchange: &Exchange, _: &Terms) -> Vec<Met> {
    let elsewhere = exchange.played_commands().filter(|(at, command)| {
        let state = exchange.state_at(*at);
        let own = state.and_then(|(_, state)| following(&state.ram));
        command.to == exchange.robot && own.is_some_and(|(session, _)| session != command.session)
    });
    elsewhere
        .filter_map(|(at, command)| changes_nothing(exchange, at, command))
        .collect()
}

fn to_others_changes_nothing(exchange: &Exchange, _: &Terms) -> Vec<Met> {
    let others = exchange
        .played_commands()
        .filter(|(_, command)| command.to != exchange.robot);
    others
        .filter_map(|(at, command)| changes_nothing(exchange, at, command))
        .collect()
}

fn progress_is_reported(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let judge = |(at, local): (u64, Local)| {
        let (_, state) = exchange.state_at(at)?;
        let (session, report) = following(&state.ram)?;
        let request = report
            .filter(|report| report.progress.is_running())?
            .request;
        let is_it = |progress: Progress| match local {
            // A body may be in position and done in one RAM period.
            Local::InPosition => progress != Progress::Executing,
            Local::Done => progress == Progress::Completed,
            Local::Fail => matches!(progress, Progress::Failed(_)),
            _ => false,
        };
        if !matches!(local, Local::InPosition | Local::Done | Local::Fail) {
            return None;
        }
        due(
            exchange,
            at,
            terms.soon_ms(),
            "no RAM that reports it",
            |seen| {
                matches!(&seen.what, Happening::Said(Message::Ram(ram))
                if following(&ram.ram).is_some_and(|(now, last)| now == session
                    && last.is_some_and(|last| last.request == request && is_it(last.progress))))
            },
        )
    };
    exchange.told().filter_map(judge).collect()
}
