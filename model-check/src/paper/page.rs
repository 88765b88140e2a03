//! Counterexamples in words, and the documentation page.

use std::fmt::Write as _;

use crossguard_protocol::State as Stage;

use super::model::{Action, Content, Flight, Kind, World};
use super::robot::{self, HelpStatus, Rmcm, Robot};
use super::{Counterexample, Transition, counterexamples};
use crate::sequence::{Chart, ChartStep, Fate, Place};

const INTRODUCTION: &str = "\
# The paper's text taken word for word

The paper *Multi-Robot Coordination in V2X Environments* (Arockiasamy, Vinel; arXiv 2605.06662)
describes four states, two messages and what robots do with them. `crossguard check paper-literal`
checks a small model of exactly that wording (`model-check/src/paper`), and the check must fail. Each
counterexample below was found by stateright, is the shortest of its kind, and is the reason for a
rule that the protocol of this kit adds. The same stories, with the same losses, delays and crashes,
are told to real endpoints by `harness/tests/paper_literal.rs`, which survive them; the stories are
the files in `model-check/stories`.

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
            "\n## {}: {}\n\n{}\n\nBroken property: {}.\n\n```mermaid\n{}```\n\nClosed by: {}\n",
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
        let robots: Vec<_> = self
            .cast
            .names
            .iter()
            .map(|&name| name.to_owned())
            .collect();
        let chart = Chart {
            title: self.hazard.text().title,
            robots: &robots,
            steps: &self.chart(),
            repeats_after: self.repeats_after(),
        };
        chart.mermaid()
    }

    /// The run step by step.
    pub(super) fn chart(&self) -> Vec<ChartStep> {
        let steps = self.steps.iter().enumerate();
        let in_words = |(i, step): (usize, &Transition)| {
            let (place, action) = self.placed(i);
            ChartStep {
                place,
                action,
                outputs: consequences(step),
            }
        };
        steps.map(in_words).collect()
    }

    /// What happens in a step, and where.
    fn placed(&self, step: usize) -> (Place, String) {
        let Transition { before, action, .. } = &self.steps[step];
        let between = |from, to, fate| Place::Between { from, to, fate };
        let at = |robot, event: &str| (Place::At(robot), event.to_owned());
        match *action {
            Action::Hear { from, to } => (between(from, to, Fate::Arrives), heard(before, from)),
            Action::Delay { from, to } => (between(from, to, Fate::Delayed), heard(before, from)),
            Action::Arrive { flight, again } => {
                let was_under_way =
                    step > 0 && self.steps[step - 1].before.content(flight).is_some();
                let fate = match again {
                    true => Fate::ArrivesLateAndAgain,
                    false if was_under_way || flight.kind == Kind::Ram => Fate::ArrivesLate,
                    false => Fate::Arrives,
                };
                (
                    between(flight.from, flight.to, fate),
                    content(before, flight),
                )
            }
            Action::Lose(flight) => {
                let place = between(flight.from, flight.to, Fate::Lost);
                (place, content(before, flight))
            }
            Action::Detect(robot) => at(robot, "pedestrian detected"),
            Action::Command(robot) => at(robot, "gives a command"),
            Action::Finish(robot) => at(robot, "maneuver finished"),
            Action::CompleteTask(robot) => at(robot, "task completed"),
            Action::SafetyTimeout(robot) => at(robot, "safety timeout"),
            Action::Crash(robot) => at(robot, "breaks down"),
        }
    }
}

fn heard(world: &World, from: robot::Place) -> String {
    world
        .robot(from)
        .map_or_else(String::new, |sender| sender.ram().to_string())
}

fn content(world: &World, flight: Flight) -> String {
    world
        .content(flight)
        .map_or_else(String::new, |content| content.to_string())
}

/// What a step changes in the robot that takes it.
fn consequences(step: &Transition) -> Vec<String> {
    if is_restarted(step) {
        return vec!["starts the maneuver a second time".to_owned()];
    }
    let robots = step.before.robots().filter_map(|(place, before)| {
        let after = step.after.robot(place)?;
        (before != after).then(|| change(before, after))
    });
    robots.flatten().collect()
}

fn change(before: &Robot, after: &Robot) -> Vec<String> {
    let starts = after
        .executing()
        .filter(|_| before.executing() != after.executing());
    let command = match (starts, after.command, before.command) {
        (Some(command), ..) => Some(format!("acknowledges and starts {}", command.request)),
        (None, Some(command), None) if after.follower().is_some() => {
            Some(format!("sends {}", Rmcm::Command(command)))
        }
        (None, None, Some(command)) if after.follower().is_some() => {
            Some(format!("counts {} as completed", command.request))
        }
        _ => None,
    };
    let stops = before.executing().is_some() && after.state == Stage::Idle;
    let stage = (before.state != after.state).then(|| match after.status {
        HelpStatus::Leader { .. } => format!("{:?} (leader)", after.state),
        HelpStatus::Follower { .. } => format!("{:?} (follower)", after.state),
        _ => format!("{:?}", after.state),
    });
    let stops = stops.then(|| "stops the maneuver".to_owned());
    [command, stops, stage].into_iter().flatten().collect()
}

/// Whether a command is started that was started before.
fn is_restarted(step: &Transition) -> bool {
    let Action::Arrive { flight, .. } = step.action else {
        return false;
    };
    let Some(Content::Rmcm(Rmcm::Command(command))) = step.before.content(flight) else {
        return false;
    };
    let executing = step.after.robot(flight.to).and_then(Robot::executing);
    step.before.memory.started & 1 << command.serial != 0 && executing == Some(command)
}
