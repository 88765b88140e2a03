//! Counterexamples in words, as charts, and as the documentation page.

use std::fmt::Write as _;

use crossguard_protocol::State as Stage;

use super::model::{Action, Cast, Content, Flight, World};
use super::robot::{HelpStatus, Place, Rmcm, Robot};
use super::{Counterexample, Transition, counterexamples};

const INTRODUCTION: &str = "\
# The paper's text taken word for word

The paper *Multi-Robot Coordination in V2X Environments* (Arockiasamy, Vinel; arXiv 2605.06662)
describes four states, two messages and what robots do with them. `crossguard check paper-literal`
checks a small model of exactly that wording (`model-check/src/paper`), and the check must fail. Each
counterexample below was found by stateright, is the shortest of its kind, and is the reason for a
rule that the protocol of this kit adds. The same stories, with the same losses, delays and crashes,
are told to real endpoints by `harness/tests/paper_literal.rs`, which survive them; the stories are
the files in `model-check/replays`.

The paper itself was not at hand when this was written, only the summary in the kit's design. Where
that leaves something open, the model takes the most literal reading; the documentation of the module
`paper` lists these readings. A hazard below is a statement about this reading.

This page is generated from what the checker finds; a test fails when the two differ. To write it
anew: `CROSSGUARD_BLESS=1 cargo test -p crossguard-model-check --test paper_literal`.
";

/// The documentation page: each counterexample as a sequence chart, what it means, what closes it.
#[must_use]
pub fn page() -> String {
    let mut page = INTRODUCTION.to_owned();
    for found in counterexamples() {
        let text = found.hazard.text();
        let _ = write!(
            page,
            "\n## {}: {}\n\n{}\n\nBroken property: {}.\n\n{}\nClosed by: {}\n",
            text.id,
            text.title,
            text.explanation,
            text.statement,
            found.mermaid(),
            text.closed_by,
        );
    }
    page
}

impl Counterexample {
    fn mermaid(&self) -> String {
        let names = self.cast.names;
        let mut chart = "```mermaid\nsequenceDiagram\n".to_owned();
        for name in names {
            let _ = writeln!(chart, "    participant {name}");
        }
        for step in &self.steps {
            let _ = writeln!(chart, "    {}", arrow_or_note(&self.cast, step));
            for (place, what) in consequences(step) {
                let _ = writeln!(chart, "    Note over {}: {what}", names[place]);
            }
        }
        let (first, last) = (names[0], names[names.len() - 1]);
        let title = self.hazard.text().title;
        let _ = writeln!(chart, "    Note over {first},{last}: {title}");
        if self.hazard.is_without_end() {
            let _ = writeln!(
                chart,
                "    Note over {first},{last}: nothing happens any more"
            );
        }
        chart + "```\n"
    }
}

fn arrow_or_note(cast: &Cast, step: &Transition) -> String {
    let names = cast.names;
    let way = |from: Place, arrow, to: Place, what| {
        format!("{}{arrow}{}: {what}", names[from], names[to])
    };
    match step.action {
        Action::Hear { from, to } => way(from, "->>", to, heard(&step.before, from)),
        Action::Arrive { flight, again } => {
            let what = content(&step.before, flight) + copies(again);
            way(flight.from, "->>", flight.to, what)
        }
        Action::Lose(flight) => {
            let what = content(&step.before, flight) + " (lost)";
            way(flight.from, "-x", flight.to, what)
        }
        Action::Delay { from, to } => {
            let what = heard(&step.before, from) + " (delayed)";
            way(from, "--)", to, what)
        }
        Action::Detect(place)
        | Action::Command(place)
        | Action::Finish(place)
        | Action::CompleteTask(place)
        | Action::SafetyTimeout(place)
        | Action::Crash(place) => format!("Note over {}: {}", names[place], event(step.action)),
    }
}

/// An action in words.
pub(super) fn describe(cast: &Cast, before: &World, action: Action) -> String {
    let names = cast.names;
    let way = |from: Place, arrow, to: Place, what| {
        format!("{} {arrow} {}: {what}", names[from], names[to])
    };
    match action {
        Action::Hear { from, to } => way(from, "->", to, heard(before, from)),
        Action::Delay { from, to } => {
            way(from, "-~", to, format!("{} (delayed)", heard(before, from)))
        }
        Action::Arrive { flight, again } => {
            let what = content(before, flight) + copies(again);
            way(flight.from, "->", flight.to, what)
        }
        Action::Lose(flight) => {
            let what = content(before, flight) + " (lost)";
            way(flight.from, "-x", flight.to, what)
        }
        Action::Detect(place)
        | Action::Command(place)
        | Action::Finish(place)
        | Action::CompleteTask(place)
        | Action::SafetyTimeout(place)
        | Action::Crash(place) => format!("{}: {}", names[place], event(action)),
    }
}

const fn event(action: Action) -> &'static str {
    match action {
        Action::Detect(_) => "pedestrian detected",
        Action::Command(_) => "gives a command",
        Action::Finish(_) => "maneuver finished",
        Action::CompleteTask(_) => "task completed",
        Action::SafetyTimeout(_) => "safety timeout",
        Action::Crash(_) => "breaks down",
        Action::Hear { .. } | Action::Arrive { .. } | Action::Delay { .. } | Action::Lose(_) => "",
    }
}

const fn copies(again: bool) -> &'static str {
    if again {
        " (a copy is still under way)"
    } else {
        ""
    }
}

fn heard(world: &World, from: Place) -> String {
    world
        .robot(from)
        .map_or_else(String::new, |sender| sender.ram().to_string())
}

fn content(world: &World, flight: Flight) -> String {
    world
        .content(flight)
        .map_or_else(String::new, |content| content.to_string())
}

/// What a step changes, and in whom.
pub(super) fn consequences(step: &Transition) -> Vec<(Place, String)> {
    let robots = step.before.robots().filter_map(|(place, before)| {
        let after = step.after.robot(place)?;
        (before != after).then(|| (place, change(step, place, before, after)))
    });
    let mut consequences: Vec<_> = robots.filter(|(_, what)| !what.is_empty()).collect();
    if let Some(place) = restarted(step) {
        consequences.push((place, "starts the maneuver a second time".to_owned()));
    }
    consequences
}

fn change(step: &Transition, place: Place, before: &Robot, after: &Robot) -> String {
    let starts = after
        .executing()
        .filter(|_| before.executing() != after.executing());
    let command = match (starts, after.command, before.command) {
        _ if restarted(step) == Some(place) => return String::new(),
        (Some(command), ..) => format!("acknowledges and starts {}", command.request),
        (None, Some(command), None) if after.follower().is_some() => {
            return format!("sends {}", Rmcm::Command(command));
        }
        (None, None, Some(command)) if after.follower().is_some() => {
            format!("counts {} as completed", command.request)
        }
        _ => String::new(),
    };
    let stops = before.executing().is_some() && after.state == Stage::Idle;
    let state = match (before.state == after.state, after.status) {
        (true, _) => String::new(),
        (false, _) if stops => "Idle, stops the maneuver".to_owned(),
        (false, HelpStatus::Leader { .. }) => format!("{:?} (leader)", after.state),
        (false, HelpStatus::Follower { .. }) => format!("{:?} (follower)", after.state),
        (false, _) => format!("{:?}", after.state),
    };
    let parts = [command, state];
    let parts: Vec<_> = parts.into_iter().filter(|part| !part.is_empty()).collect();
    parts.join(", ")
}

/// Who started a command that was started before.
fn restarted(step: &Transition) -> Option<Place> {
    let Action::Arrive { flight, .. } = step.action else {
        return None;
    };
    let Some(Content::Rmcm(Rmcm::Command(command))) = step.before.content(flight) else {
        return None;
    };
    let is_started = step.before.memory.started & 1 << command.serial != 0;
    let executes = step.after.robot(flight.to)?.executing() == Some(command);
    (is_started && executes).then_some(flight.to)
}
