//! What a leader shows to pedestrians, where its RAM say so.

use crossguard_codec::PublicSignal;
use crossguard_protocol::{Command, Coordination, Heartbeat, Progress, SessionId, StationId};

use super::{Met, due, met_when, news};
use crate::bench::Terms;
use crate::exchange::{Exchange, Happening, Message, RamSeen, following, session_of};
use crate::subject::Local;

statements! {
    "go-is-shown-over-guards" "R16" go_over_guards:
        "Go is shown only while every follower that was asked for is listed and reports that it guards, from its place where it has one.";
    "go-can-be-shown" "R16" go_can_be_shown:
        "Go is shown when the application asks for it and every follower guards.";
    "go-ends-by-itself" "R17" go_ends_by_itself:
        "Go is not shown for longer than the lease after a follower's newest echo.";
    "reports-of-other-commands-do-not-count" "R11" other_reports_do_not_count:
        "A report of another command than the follower's does not end go.";
    "guards-are-not-commanded-away" "R18" guards_are_kept:
        "While people may be on the road no guard is commanded to do something else.";
}

/// RAM say what is shown twice a second.
const SAID_MS: u64 = 500;

fn shows_go(state: &RamSeen) -> bool {
    state.sign == Some(PublicSignal::Go)
}

fn listed(state: &RamSeen) -> Vec<StationId> {
    match state.ram.coordination {
        Coordination::Leader { followers, .. } => followers.iter().map(|it| it.station).collect(),
        _ => Vec::new(),
    }
}

/// The newest command to a follower by this time.
fn command_to(
    exchange: &Exchange,
    session: SessionId,
    to: StationId,
    until_ms: u64,
) -> Option<Command> {
    let mut commands = exchange.commands();
    let newest = commands.rfind(|(at, it)| *at <= until_ms && it.session == session && it.to == to);
    newest.map(|(_, command)| command)
}

/// What a follower has reported at last of a command by this time.
fn progress_of(exchange: &Exchange, command: Command, until_ms: u64) -> Option<Progress> {
    let mut newest: Option<Heartbeat> = None;
    let mut known = None;
    for (_, _, played) in exchange.played_rams().filter(|(at, ..)| *at <= until_ms) {
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

/// When a follower echoed something new for the last time by this time.
fn newest_echo(
    exchange: &Exchange,
    session: SessionId,
    from: StationId,
    until_ms: u64,
) -> Option<u64> {
    let echoes = exchange.played_rams().filter_map(|(at, _, played)| {
        let Coordination::Follower {
            session: now, echo, ..
        } = played.ram.coordination
        else {
            return None;
        };
        let is_of_it = (played.ram.station, now) == (from, session);
        (is_of_it && at <= until_ms).then_some((at, echo))
    });
    news(echoes).last().map(|(at, _)| at)
}

/// Why go may not be shown at this time.
fn obstacle(exchange: &Exchange, terms: &Terms, session: SessionId, at_ms: u64) -> Option<String> {
    let state = exchange.state_at(at_ms)?.1;
    let listed = listed(state);
    let asked = exchange
        .rams()
        .find_map(|(_, state)| match state.ram.coordination {
            Coordination::NeedHelp { request, .. } if session_of(&state.ram) == Some(session) => {
                Some(usize::from(request.followers))
            }
            _ => None,
        });
    if listed.len() < asked.unwrap_or(1) {
        return Some("a follower is missing".to_owned());
    }
    for station in listed {
        let Some(command) = command_to(exchange, session, station, at_ms) else {
            return Some(format!("{station} has no command"));
        };
        let Some(progress) = progress_of(exchange, command, at_ms) else {
            return Some(format!("{station} reports nothing of its command"));
        };
        if !terms.settings.guarding.contains(command.task) {
            return Some(format!("{station} does not guard"));
        }
        let is_in_place = progress == Progress::InPosition
            || (progress == Progress::Executing && !terms.settings.holding.contains(command.task));
        if !is_in_place {
            let progress = crate::words::progress(progress);
            return Some(format!("{station} reports {progress}"));
        }
        let since = newest_echo(exchange, session, station, at_ms);
        if since.is_none_or(|since| since + terms.ms(|s| s.t_lease) < at_ms) {
            return Some(format!("{station} echoes nothing new"));
        }
    }
    None
}

fn go_over_guards(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let mut all: Vec<Met> = Vec::new();
    // Each order to open that must be refused, and each time that go is shown.
    for (at, local) in exchange.told() {
        let Some((_, state)) = exchange.state_at(at) else {
            continue;
        };
        let Some(session) = session_of(&state.ram).filter(|it| it.leader == exchange.robot) else {
            continue;
        };
        let says = exchange.rams().any(|(_, state)| state.sign.is_some());
        let is_settled = exchange.undisturbed_until(at) >= at + SAID_MS + 150;
        if local == Local::Open
            && says
            && is_settled
            && let Some(why) = obstacle(exchange, terms, session, at)
        {
            // The sentences name stations; the situation does not.
            let why = why.trim_start_matches(|c: char| c.is_ascii_digit() || c == ' ');
            all.push(met_when(at, format!("asked to open, {why}"), None));
        }
    }
    for (at, state) in exchange.rams().filter(|(_, state)| shows_go(state)) {
        let Some(session) = session_of(&state.ram) else {
            all.push(met_when(
                at,
                "without a session",
                Some("it shows go".to_owned()),
            ));
            continue;
        };
        // What was so a moment ago may have been what it knew.
        let since = at.saturating_sub(terms.soon_ms());
        let times = exchange.seen.iter().map(|seen| seen.at_ms);
        let mut times = times
            .filter(|then| (since..=at).contains(then))
            .chain([since, at]);
        let has_reason = times.any(|then| obstacle(exchange, terms, session, then).is_none());
        let why = obstacle(exchange, terms, session, at);
        let broken = (!has_reason).then(|| format!("it shows go, and {}", why.unwrap_or_default()));
        let is_first = all.iter().all(|met| met.situation != "go is shown");
        if broken.is_some() || is_first {
            all.push(met_when(at, "go is shown", broken));
        }
    }
    for met in ended_by_reports(exchange, terms) {
        all.push(met);
    }
    all
}

/// Reports after which go must not be shown any more.
fn ended_by_reports(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let mut all = Vec::new();
    let mut shown = None;
    for (at, state) in exchange.rams() {
        match (shows_go(state), state.sign.is_some()) {
            (true, _) => shown = Some((at, session_of(&state.ram))),
            (false, true) => {
                if let Some((before, Some(session))) = shown.take()
                    && let Some(why) = obstacle(exchange, terms, session, at)
                {
                    let why = why.trim_start_matches(|c: char| c.is_ascii_digit() || c == ' ');
                    all.push(met_when(before, format!("go ends, {why}"), None));
                }
            }
            _ => {}
        }
    }
    all
}

fn go_can_be_shown(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let judge = |(at, local): (u64, Local)| {
        let (_, state) = exchange.state_at(at)?;
        let session = session_of(&state.ram).filter(|it| it.leader == exchange.robot)?;
        let says = exchange.rams().any(|(_, state)| state.sign.is_some());
        // What is so must have been heard.
        let was_so = obstacle(exchange, terms, session, at.saturating_sub(200)).is_none();
        let is_so = obstacle(exchange, terms, session, at).is_none();
        if local != Local::Open || !says || !is_so || !was_so {
            return None;
        }
        let limit_ms = SAID_MS + terms.soon_ms();
        due(
            exchange,
            at,
            limit_ms,
            "no RAM that shows go",
            |seen| matches!(&seen.what, Happening::Said(Message::Ram(state)) if shows_go(state)),
        )
    };
    exchange.told().filter_map(judge).collect()
}

fn go_ends_by_itself(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let lease_ms = terms.ms(|settings| settings.t_lease);
    let mut all: Vec<Met> = Vec::new();
    for (at, state) in exchange.rams().filter(|(_, state)| shows_go(state)) {
        let Some(session) = session_of(&state.ram) else {
            continue;
        };
        for station in listed(state) {
            let Some(since) = newest_echo(exchange, session, station, at) else {
                continue;
            };
            let shown_ms = at - since;
            let broken = (shown_ms > lease_ms + terms.slack_ms)
                .then(|| format!("it shows go {shown_ms} ms after the newest echo of {station}"));
            if broken.is_some() {
                all.push(met_when(since, "a silent follower", broken));
            }
        }
    }
    // Where a follower was silent for long enough, go had to end.
    let shown = exchange.rams().rfind(|(_, state)| shows_go(state));
    if let Some((last, state)) = shown
        && let Some(session) = session_of(&state.ram)
    {
        let echoes = exchange
            .played_rams()
            .filter(|(_, _, played)| following(&played.ram).is_some_and(|(now, _)| now == session));
        let newest = echoes.map(|(at, ..)| at).max().unwrap_or_default();
        let told = exchange.told().any(|(at, _)| at > newest);
        if !told
            && exchange.ended_ms > newest + lease_ms + SAID_MS + terms.slack_ms
            && last >= newest
        {
            all.push(met_when(newest, "a silent follower", None));
        }
    }
    all
}

fn other_reports_do_not_count(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let mut all: Vec<Met> = Vec::new();
    for (at, _, played) in exchange.played_rams() {
        let Some((session, Some(report))) = following(&played.ram) else {
            continue;
        };
        let newest = exchange.commands().rfind(|(then, it)| {
            *then <= at && it.to == played.ram.station && it.session == session
        });
        let is_other = newest.is_some_and(|(_, it)| it.request != report.request);
        // The newest RAM that says what is shown.
        let mut before = exchange
            .rams()
            .filter(|(then, state)| *then <= at && state.sign.is_some());
        let showed = before.next_back().is_some_and(|(_, state)| shows_go(state));
        let until_ms = exchange.undisturbed_until(at);
        let is_settled = until_ms >= at + SAID_MS + 100;
        if !is_other || !showed || !is_settled || !all.is_empty() {
            continue;
        }
        let limit_ms = at + terms.soon_ms() + SAID_MS;
        let mut after = exchange
            .rams()
            .filter(|(then, _)| (at + 1..=until_ms.min(limit_ms)).contains(then));
        let ends = after.find(|(_, state)| state.sign.is_some() && !shows_go(state));
        let broken = ends.map(|(then, _)| format!("go ends {} ms later", then - at));
        all.push(met_when(at, "go is shown", broken));
    }
    all
}

fn guards_are_kept(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let judge = |(at, local): (u64, Local)| {
        let Local::Order(to, _) = local else {
            return None;
        };
        let (_, state) = exchange.state_at(at)?;
        let session = session_of(&state.ram)?;
        let mut shown = exchange.rams().filter(|(then, state)| {
            *then <= at && shows_go(state) && session_of(&state.ram) == Some(session)
        });
        let (opened, _) = shown.next()?;
        let is_clear = exchange
            .told()
            .any(|(then, local)| local == Local::Clear && then > opened && then <= at);
        let guards = obstacle(exchange, terms, session, at).is_none();
        let until_ms = exchange.undisturbed_until(at);
        if is_clear || !guards || until_ms < at + terms.soon_ms() {
            return None;
        }
        let mut commands = exchange
            .commands()
            .filter(|(then, _)| (at..until_ms).contains(then));
        let commanded = commands.find(|(_, command)| command.to == to);
        let broken = commanded
            .map(|(then, command)| format!("it commands {} {} ms later", command.task, then - at));
        Some(met_when(at, "people may be on the road", broken))
    };
    exchange.told().filter_map(judge).collect()
}
