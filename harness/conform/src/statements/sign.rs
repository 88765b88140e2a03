//! Sign of a leader to pedestrians, where its RAM tell it.

use crossguard_protocol::{Command, Coordination, Heartbeat, Progress, SessionId};

use super::{Met, Told, Trace, met_when, news, told};
use crate::exchange::RamSeen;
use crate::subject::Local;

statements! {
    "go-is-shown-over-guards" "R16" go_over_guards:
        "Go is shown only while every follower that was asked for is listed and reports that it guards, from its place where it has one.";
    "go-can-be-shown" "R16" go_can_be_shown of orders_to_open:
        "Go is shown when the application asks for it and every follower guards.";
    "go-ends-by-itself" "R17" go_ends_by_itself:
        "Go is not shown for longer than the lease after a follower's newest echo.";
    "reports-of-other-commands-do-not-count" "R11" other_reports_do_not_count:
        "A report of another command than the follower's does not end go.";
    "guards-are-not-commanded-away" "R18" guards_are_kept of told:
        "While people may be on the road no guard is commanded to do something else.";
}

/// RAM say what is shown twice a second.
const SAID_MS: u64 = 500;

/// The last report of a follower on a command by this time.
fn progress_of(trace: &Trace, command: Command, until_ms: u64) -> Option<Progress> {
    let mut newest: Option<Heartbeat> = None;
    let mut known = None;
    for (_, played) in trace.played_rams().filter(|(at, _)| *at <= until_ms) {
        let Coordination::Follower {
            session,
            echo,
            last,
        } = played.ram.coordination
        else {
            continue;
        };
        if (played.ram.station, session) != (command.to, command.session) {
            continue;
        }
        let is_newer = newest.is_none_or(|newest| echo.is_newer_than(newest));
        if is_newer {
            newest = Some(echo);
        }
        let Some(report) = last.filter(|it| it.request == command.request) else {
            continue;
        };
        // A place counts as taken by a newer echo, and as left by one that is as new.
        let is_old = match (known, report.progress) {
            (Some(Progress::Executing), Progress::InPosition) => !is_newer,
            (Some(Progress::InPosition), Progress::Executing) => newest != Some(echo),
            _ => false,
        };
        if !is_old {
            known = Some(report.progress);
        }
    }
    known
}

/// Why go may not be shown at this time.
fn obstacle(trace: &Trace, session: SessionId, at_ms: u64) -> Option<String> {
    let listed = trace.state_at(at_ms)?.listed();
    let asked = trace
        .rams()
        .find_map(|(_, state)| match state.ram.coordination {
            Coordination::NeedHelp { request, .. } if state.session() == Some(session) => {
                Some(usize::from(request.followers))
            }
            _ => None,
        });
    if listed.len() < asked.unwrap_or(1) {
        return Some("a follower is missing".to_owned());
    }
    for (station, _) in listed {
        let mut commands = trace.commands();
        let command =
            commands.rfind(|(at, it)| *at <= at_ms && (it.session, it.to) == (session, station));
        let Some((_, command)) = command else {
            return Some(format!("{station} has no command"));
        };
        let Some(progress) = progress_of(trace, command, at_ms) else {
            return Some(format!("{station} reports nothing of its command"));
        };
        let settings = &trace.terms.settings;
        if !settings.guarding.contains(command.task) {
            return Some(format!("{station} does not guard"));
        }
        let is_in_place = progress == Progress::InPosition
            || (progress == Progress::Executing && !settings.holding.contains(command.task));
        if !is_in_place {
            let progress = crate::words::progress(progress);
            return Some(format!("{station} reports {progress}"));
        }
        let echoes = trace.echoes(session, station);
        let newest = news(echoes.filter(|(at, _)| *at <= at_ms)).last();
        if newest.is_none_or(|(since, _)| since + trace.ms(|s| s.t_lease) < at_ms) {
            return Some(format!("{station} echoes nothing new"));
        }
    }
    None
}

/// Why go may not be shown, as a situation: sentences begin with the number of a station.
fn situation(why: &str) -> &str {
    why.trim_start_matches(|c: char| c.is_ascii_digit() || c == ' ')
}

/// The orders to open, each with the robot's session, where its RAM say what is shown.
fn orders_to_open(trace: &Trace) -> impl Iterator<Item = (u64, SessionId)> {
    let says = trace.rams().any(|(_, state)| state.sign.is_some());
    told(trace).filter_map(move |(at, local, state)| {
        let session = state.session().filter(|it| it.leader == trace.robot)?;
        (local == Local::Open && says).then_some((at, session))
    })
}

fn go_over_guards(trace: &Trace) -> Vec<Met> {
    // Each order to open that must be refused, and each time that go is shown.
    let refused = orders_to_open(trace).filter_map(|(at, session)| {
        let is_settled = trace.undisturbed_until(at) >= at + SAID_MS + 150;
        let why = obstacle(trace, session, at).filter(|_| is_settled)?;
        Some(met_when(
            at,
            format!("asked to open, {}", situation(&why)),
            None,
        ))
    });
    let mut all: Vec<Met> = refused.collect();
    for (at, state) in trace.rams().filter(|(_, state)| state.shows_go()) {
        let Some(session) = state.session() else {
            let broken = Some("it shows go".to_owned());
            all.push(met_when(at, "without a session", broken));
            continue;
        };
        // The robot may have known only the situation of a moment ago.
        let since = at.saturating_sub(trace.soon_ms());
        let times = trace.seen.iter().map(|seen| seen.at_ms);
        let times = times.filter(|then| (since..=at).contains(then));
        let has_reason = times
            .chain([since, at])
            .any(|then| obstacle(trace, session, then).is_none());
        let broken = (!has_reason).then(|| {
            let why = obstacle(trace, session, at).unwrap_or_default();
            format!("it shows go, and {why}")
        });
        let is_first = all.iter().all(|met| met.situation != "go is shown");
        if broken.is_some() || is_first {
            all.push(met_when(at, "go is shown", broken));
        }
    }
    all.extend(ended_by_reports(trace));
    all
}

/// Reports after which go must not be shown any more.
fn ended_by_reports(trace: &Trace) -> Vec<Met> {
    let mut all = Vec::new();
    let mut shown = None;
    for (at, state) in trace.rams().filter(|(_, state)| state.sign.is_some()) {
        if state.shows_go() {
            shown = Some((at, state.session()));
        } else if let Some((before, Some(session))) = shown.take()
            && let Some(why) = obstacle(trace, session, at)
        {
            all.push(met_when(
                before,
                format!("go ends, {}", situation(&why)),
                None,
            ));
        }
    }
    all
}

fn go_can_be_shown(trace: &Trace, (at, session): (u64, SessionId)) -> Option<Met> {
    // The robot must have had time to hear of the situation.
    let was_so = obstacle(trace, session, at.saturating_sub(200)).is_none();
    if !was_so || obstacle(trace, session, at).is_some() {
        return None;
    }
    let limit_ms = SAID_MS + trace.soon_ms();
    trace.ram_due(at, limit_ms, "no RAM that shows go", RamSeen::shows_go)
}

fn go_ends_by_itself(trace: &Trace) -> Vec<Met> {
    let lease_ms = trace.ms(|settings| settings.t_lease);
    let slack_ms = trace.terms.slack_ms;
    let mut all: Vec<Met> = Vec::new();
    for (at, state) in trace.rams().filter(|(_, state)| state.shows_go()) {
        let Some(session) = state.session() else {
            continue;
        };
        for (station, _) in state.listed() {
            let echoes = trace.echoes(session, station);
            let Some((since, _)) = news(echoes.filter(|(then, _)| *then <= at)).last() else {
                continue;
            };
            let shown_ms = at - since;
            if shown_ms > lease_ms + slack_ms {
                let how = format!("it shows go {shown_ms} ms after the newest echo of {station}");
                all.push(met_when(since, "a silent follower", Some(how)));
            }
        }
    }
    // Where a follower was silent for long enough, go had to end.
    let shown = trace.rams().rfind(|(_, state)| state.shows_go());
    if let Some((last, state)) = shown
        && let Some(session) = state.session()
    {
        let echoes = trace.played_rams().filter(|(_, it)| it.follows(session));
        let newest = echoes.map(|(at, _)| at).max().unwrap_or_default();
        let told = trace.told().any(|(at, _)| at > newest);
        if !told && trace.ended_ms > newest + lease_ms + SAID_MS + slack_ms && last >= newest {
            all.push(met_when(newest, "a silent follower", None));
        }
    }
    all
}

fn other_reports_do_not_count(trace: &Trace) -> Vec<Met> {
    let judge = |(at, played): (u64, &RamSeen)| {
        let (session, report) = played.following()?;
        let follower = (session, played.ram.station);
        let mut commands = trace.commands();
        let (_, newest) =
            commands.rfind(|(then, it)| *then <= at && (it.session, it.to) == follower)?;
        // The newest RAM that says what is shown.
        let mut before = trace.rams().filter(|(_, state)| state.sign.is_some());
        let (_, showed) = before.rfind(|(then, _)| *then <= at)?;
        let until_ms = trace.undisturbed_until(at);
        let is_settled = until_ms >= at + SAID_MS + 100;
        if newest.request == report?.request || !showed.shows_go() || !is_settled {
            return None;
        }
        let until_ms = until_ms.min(at + trace.soon_ms() + SAID_MS);
        let mut after = trace
            .rams()
            .filter(|(then, _)| *then > at && *then <= until_ms);
        let ends = after.find(|(_, state)| state.sign.is_some() && !state.shows_go());
        let broken = ends.map(|(then, _)| format!("go ends {} ms later", then - at));
        Some(met_when(at, "go is shown", broken))
    };
    trace.played_rams().filter_map(judge).take(1).collect()
}

fn guards_are_kept(trace: &Trace, (at, local, state): Told) -> Option<Met> {
    let Local::Order(to, _) = local else {
        return None;
    };
    let session = state.session()?;
    let mut shown = trace.rams().filter(|(_, state)| state.shows_go());
    let (opened, _) =
        shown.find(|(then, state)| *then <= at && state.session() == Some(session))?;
    let is_clear = trace
        .told()
        .any(|(then, local)| local == Local::Clear && then > opened && then <= at);
    let until_ms = trace.undisturbed_until(at);
    if is_clear || obstacle(trace, session, at).is_some() || until_ms < at + trace.soon_ms() {
        return None;
    }
    let mut commands = trace.commands().filter(|(_, command)| command.to == to);
    let commanded = commands.find(|(then, _)| (at..until_ms).contains(then));
    let broken = commanded
        .map(|(then, command)| format!("it commands {} {} ms later", command.task, then - at));
    Some(met_when(at, "people may be on the road", broken))
}
