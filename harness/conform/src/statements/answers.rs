//! A follower and its commands.

use crossguard_protocol::{
    Answer, Command, Coordination, Progress, Rejection, Report, SessionId, TaskSet, Verdict,
};

use super::{Breach, Met, Told, Trace, first_of_each, told};
use crate::exchange::{Happening, RamSeen};
use crate::subject::Local;
use crate::words;

statements! {
    "acknowledged-before-executed" "R7" acknowledged_before_executed:
        "A command is acknowledged by an RMCM before a RAM reports it.";
    "commands-are-answered" "R7" commands_are_answered of new_commands:
        "A new command of the own leader is answered.";
    "impossible-commands-are-rejected" "R7" impossible_is_rejected:
        "A command for a task that was not offered is rejected, with that reason.";
    "repeats-are-acknowledged-again" "R8" repeats_are_answered of repeats:
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
    "progress-is-reported" "R11" progress_is_reported of told:
        "What the body has done is reported in a RAM that names session, command and progress.";
    "unavailable-robots-reject" "R24" unavailable_rejects:
        "An unavailable follower rejects a new command, with that reason.";
    "robots-on-duty-reject" "R20" on_duty_rejects:
        "A follower that is on duty rejects a new command, with that reason, unless it is to go on with what it fell back from.";
}

/// A command as it was sent once: when, and what the robot's newest RAM reported then.
type Commanded = (u64, Command, Option<Report>);

/// The commands of the session in which the robot follows at that time, each time they were sent.
fn own_commands(trace: &Trace) -> impl Iterator<Item = Commanded> {
    trace.played_commands().filter_map(|(at, command)| {
        let (session, last) = trace.state_at(at)?.following()?;
        let is_own = command.session == session && command.to == trace.robot;
        is_own.then_some((at, command, last))
    })
}

/// The first transmissions of commands that are newer than all before.
fn new_commands(trace: &Trace) -> Vec<Commanded> {
    let mut new: Vec<Commanded> = Vec::new();
    for (at, command, last) in own_commands(trace) {
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

fn acknowledged_before_executed(trace: &Trace) -> Vec<Met> {
    let reports = trace.rams().filter_map(|(at, state)| {
        let (session, report) = state.following()?;
        Some((at, session, report?))
    });
    let first = first_of_each(reports, |(_, session, report)| (*session, report.request));
    let judge = |(at, session, report): (u64, SessionId, Report)| {
        let Report { request, progress } = report;
        let mut answers = trace.answers().filter(|(then, _)| *then <= at);
        let is_acknowledged = answers.any(|(_, it)| {
            (it.session, it.request, it.verdict) == (session, request, Verdict::Accepted)
        });
        let broken = (!is_acknowledged).then(|| {
            let progress = words::progress(progress);
            format!("it reports command {request} as {progress}, which it has not acknowledged")
        });
        trace.met(at.saturating_sub(1), broken)
    };
    first.map(judge).collect()
}

fn is_to(answer: &Answer, command: &Command) -> bool {
    (answer.session, answer.request) == (command.session, command.request)
}

/// A command, which is sent four times, has to be answered by such a verdict.
fn answered(
    trace: &Trace,
    at_ms: u64,
    command: &Command,
    what: &str,
    is_it: impl Fn(Verdict) -> bool,
) -> Option<Met> {
    trace.due(at_ms, trace.soon_ms(), what, |said| {
        let answer = said.answer().filter(|answer| is_to(answer, command));
        answer.is_some_and(|answer| is_it(answer.verdict))
    })
}

fn commands_are_answered(trace: &Trace, (at, command, _): Commanded) -> Option<Met> {
    answered(trace, at, &command, "no answer", |_| true)
}

/// New commands that must be rejected for a reason, where the robot's newest RAM is of that kind.
fn rejected_where(
    trace: &Trace,
    is_case: impl Fn(&RamSeen, &Command) -> bool,
    is_reason: impl Fn(Rejection) -> bool,
) -> Vec<Met> {
    let is_rejected = |verdict| matches!(verdict, Verdict::Rejected(why) if is_reason(why));
    let judge = |(at, command, _): Commanded| {
        let what = "no rejection with that reason";
        is_case(trace.state_at(at)?, &command)
            .then(|| answered(trace, at, &command, what, is_rejected))?
    };
    new_commands(trace).into_iter().filter_map(judge).collect()
}

fn offered(trace: &Trace) -> Option<TaskSet> {
    let mut rams = trace.rams();
    rams.find_map(|(_, state)| match state.ram.coordination {
        Coordination::OfferHelp { capabilities, .. } => Some(capabilities),
        _ => None,
    })
}

fn impossible_is_rejected(trace: &Trace) -> Vec<Met> {
    let Some(offered) = offered(trace) else {
        return Vec::new();
    };
    let is_case = |state: &RamSeen, command: &Command| {
        !offered.contains(command.task) && !state.ram.on_duty && state.is_available()
    };
    rejected_where(trace, is_case, |why| why == Rejection::UnsupportedTask)
}

fn unavailable_rejects(trace: &Trace) -> Vec<Met> {
    let is_reason = |why| matches!(why, Rejection::Unavailable(_));
    rejected_where(trace, |state, _| !state.is_available(), is_reason)
}

fn on_duty_rejects(trace: &Trace) -> Vec<Met> {
    let is_case = |state: &RamSeen, command: &Command| {
        state.ram.on_duty && state.is_available() && !takes_up(trace, state, command)
    };
    rejected_where(trace, is_case, |why| why == Rejection::OnDuty)
}

/// Whether a command is to do again what the robot falls back from in the same session.
fn takes_up(trace: &Trace, state: &RamSeen, command: &Command) -> bool {
    let Some((session, Some(report))) = state.following() else {
        return false;
    };
    own_commands(trace).any(|(_, first, _)| {
        (first.session, first.request) == (session, report.request)
            && (first.session, first.task) == (command.session, command.task)
    })
}

/// The first transmission of each play that repeats a command which was answered before, with that verdict.
fn repeats(trace: &Trace) -> Vec<(Commanded, Verdict)> {
    let mut all: Vec<(Commanded, Verdict)> = Vec::new();
    for (at, command, last) in own_commands(trace) {
        let play_ms = play_before(trace, at);
        let mut before = trace.answers().filter(|(then, _)| *then < play_ms);
        let answer = before.find(|(_, answer)| is_to(answer, &command));
        let is_newest = last.is_none_or(|last| last.request == command.request);
        let is_first = all.iter().all(|((then, ..), _)| *then < play_ms);
        if let (Some((_, answer)), true, true) = (answer, is_newest, is_first) {
            all.push(((at, command, last), answer.verdict));
        }
    }
    all
}

/// When the play began in which something was sent.
fn play_before(trace: &Trace, at_ms: u64) -> u64 {
    let plays = trace.seen.iter().rev();
    let mut plays = plays.filter(|seen| matches!(seen.what, Happening::Play(_)));
    let play = plays.find(|seen| seen.at_ms <= at_ms);
    play.map_or(0, |seen| seen.at_ms)
}

fn repeats_are_answered(
    trace: &Trace,
    ((at, command, _), verdict): (Commanded, Verdict),
) -> Option<Met> {
    let what = "no answer to the repeated command like the one before";
    answered(trace, at, &command, what, |it| it == verdict)
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
fn starts_anew(trace: &Trace, at_ms: u64) -> Option<Breach> {
    let before = trace.state_at(at_ms)?;
    let (session, last) = before.following()?;
    let stood = before.stands() && last.is_none_or(|last| rank(last.progress) > 0);
    let mut heard = false;
    for (at, state) in trace.afterwards(at_ms) {
        heard = true;
        let later_ms = at - at_ms;
        let Some((_, now)) = state.following().filter(|(now_in, _)| *now_in == session) else {
            continue;
        };
        if let Some(Report { request, progress }) = now {
            let goes_back =
                |last: Report| last.request != request || rank(progress) < rank(last.progress);
            let how = match last {
                None => Some(format!("it reports command {request}")),
                Some(last) if goes_back(last) => {
                    let progress = words::progress(progress);
                    Some(format!("it reports command {request} as {progress}"))
                }
                Some(_) => None,
            };
            if let Some(how) = how {
                return Some(Some(format!("{how} {later_ms} ms later")));
            }
        }
        if stood && !state.ram.on_duty && state.moves() {
            return Some(Some(format!("its body sets out {later_ms} ms later")));
        }
    }
    heard.then_some(None)
}

/// Repeated commands must start nothing, where the robot's newest RAM reports that.
fn start_nothing_where(trace: &Trace, is_case: impl Fn(Option<Report>) -> bool) -> Vec<Met> {
    let repeats = repeats(trace).into_iter();
    let repeats = repeats.filter(|((_, _, last), _)| is_case(*last));
    repeats
        .filter_map(|((at, ..), _)| Some(trace.met(at, starts_anew(trace, at)?)))
        .collect()
}

fn repeats_start_nothing(trace: &Trace) -> Vec<Met> {
    start_nothing_where(trace, |_| true)
}

fn fallen_back_stays(trace: &Trace) -> Vec<Met> {
    start_nothing_where(trace, |last| {
        last.is_some_and(|last| last.progress == Progress::SafeIdle)
    })
}

/// Commands that must not be answered and must start nothing.
fn change_nothing(trace: &Trace, commands: impl Iterator<Item = (u64, Command)>) -> Vec<Met> {
    let judge = |(at_ms, command): (u64, Command)| {
        let until_ms = trace.undisturbed_until(at_ms);
        let mut answers = trace.answers();
        let answered =
            answers.any(|(at, it)| (at_ms..until_ms).contains(&at) && is_to(&it, &command));
        let broken = if answered {
            Some(format!("it answers command {}", command.request))
        } else {
            starts_anew(trace, at_ms)?
        };
        Some(trace.met(at_ms, broken))
    };
    commands.filter_map(judge).collect()
}

fn older_changes_nothing(trace: &Trace) -> Vec<Met> {
    let older = own_commands(trace).filter(|(_, command, last)| {
        last.is_some_and(|last| last.request.is_newer_than(command.request))
    });
    change_nothing(trace, older.map(|(at, command, _)| (at, command)))
}

fn elsewhere_changes_nothing(trace: &Trace) -> Vec<Met> {
    let elsewhere = trace.played_commands().filter(|(at, command)| {
        let own = trace.state_at(*at).and_then(RamSeen::following);
        command.to == trace.robot && own.is_some_and(|(session, _)| session != command.session)
    });
    change_nothing(trace, elsewhere)
}

fn to_others_changes_nothing(trace: &Trace) -> Vec<Met> {
    let commands = trace.played_commands();
    change_nothing(trace, commands.filter(|(_, it)| it.to != trace.robot))
}

fn progress_is_reported(trace: &Trace, (at, local, state): Told) -> Option<Met> {
    let (session, report) = state.following()?;
    let request = report.filter(|it| it.progress.is_running())?.request;
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
    trace.ram_soon(at, "no RAM that reports it", |state| {
        let last = state.following().filter(|(now, _)| *now == session);
        let last = last.and_then(|(_, last)| last);
        last.is_some_and(|last| last.request == request && is_it(last.progress))
    })
}
