//! Counterexamples in words, and the documentation page.

use crossguard_protocol::State as Stage;

use super::model::PaperAction;
use super::road::Move;
use super::robot::{self, HelpStatus, PaperRmcm, PaperRobot};
use super::world::{Content, FlightKind, PaperFlight, PaperWorld};
use super::{Counterexample, Transition, broken_on_road, counterexamples};
use crate::sequence::{Chart, ChartPlace, ChartStep, Fate};

const INTRODUCTION: &str = "\
# The paper's text taken word for word

The paper *Multi-Robot Coordination in V2X Environments* (Arockiasamy, Vinel; arXiv 2605.06662)
describes four states, two messages and what robots do with them. `crossguard check paper-literal`
checks a small model of exactly that wording (`model-check/src/paper`), and the check must fail. Each
counterexample below was found by stateright, is the shortest of its kind, and is the reason for a
rule that the protocol of this kit adds. The same stories, with the same losses, delays and crashes,
are told to real endpoints by `harness/testkit/tests/paper_literal.rs`, which survive them; the stories are
the files in `model-check/stories`.

The paper itself was not at hand when this was written, only the summary in the kit's design. Where
that leaves something open, the model takes the most literal reading; the documentation of the module
`paper` lists these readings. A hazard below is a statement about this reading.

This page is generated from what the checker finds; a test fails when the two differ. To write it
anew: `cargo xtask bless paper-literal`.
";

const ON_ROAD: &str = "
## What it means for a person on the road

The same model, with a road around it: a body of each follower, a sign, and one pedestrian, judged by the road
properties that the kit's own scenarios keep ([what has been verified](verification.md)). W5, W6 and W8 take time, which
this model does not have.

What is assumed, for the wording has neither a sign nor a corridor: a leader invites the pedestrian as long as it is in
ManeuverExecuting, which means that its follower has acknowledged a command and has not yet reported it completed. This
is a favourable reading; in the paper's proof of concept the leader tells the pedestrian to follow already in
RoleEstablished. The pedestrian steps on the road at any moment while somebody invites, and is off it at any time later.
A follower that escorts guards from the start of its maneuver on; one that blocks guards once it is in its place; one
that has run into its safety timeout falls back for some time. Applications are truthful: no maneuver is finished and no
task is done while somebody is on the road. W1 has the exemption that it has for the kit without time: a guard that has
fallen back, finished or lost power, as long as no message has told its leader so. There is one
crossing, so that W3 is about every two leaders.

Four of the six runs have no lost and no late message. They are not told to real endpoints: the kit's own model has the
same road (`model-check/src/road.rs`).
";

/// The documentation page: each counterexample as a sequence chart, what it means, what closes it.
#[must_use]
pub fn page() -> String {
    let mut page = INTRODUCTION.to_owned();
    for found in counterexamples() {
        page.push_str(&section("##", &found, "Closed by"));
    }
    page.push_str(ON_ROAD);
    for found in broken_on_road() {
        page.push_str(&section("###", &found, "Kept by"));
    }
    page
}

fn section(heading: &str, found: &Counterexample, how_the_kit_answers: &str) -> String {
    let text = found.text;
    format!(
        "\n{heading} {}: {}\n\n{}\n\nBroken property: {}.\n\n```mermaid\n{}```\n\n{how_the_kit_answers}: {}\n",
        text.id,
        text.title,
        text.explanation,
        text.statement,
        found.mermaid(),
        text.closed_by,
    )
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
            title: self.text.title,
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
    fn placed(&self, step: usize) -> (ChartPlace, String) {
        let Transition { before, action, .. } = &self.steps[step];
        let between = |from, to, fate| ChartPlace::Between { from, to, fate };
        let at = |robot, event: &str| (ChartPlace::At(robot), event.to_owned());
        match *action {
            PaperAction::Hear { from, to } => {
                (between(from, to, Fate::Arrives), heard(before, from))
            }
            PaperAction::Delay { from, to } => {
                (between(from, to, Fate::Delayed), heard(before, from))
            }
            PaperAction::Arrive { flight, again } => {
                let was_under_way =
                    step > 0 && self.steps[step - 1].before.content(flight).is_some();
                let fate = match again {
                    true => Fate::ArrivesLateAndAgain,
                    false if was_under_way || flight.kind == FlightKind::Ram => Fate::ArrivesLate,
                    false => Fate::Arrives,
                };
                (
                    between(flight.from, flight.to, fate),
                    content(before, flight),
                )
            }
            PaperAction::Lose(flight) => {
                let place = between(flight.from, flight.to, Fate::Lost);
                (place, content(before, flight))
            }
            PaperAction::Detect(robot) => at(robot, "pedestrian detected"),
            PaperAction::Command(robot) => at(robot, "gives a command"),
            PaperAction::Finish(robot) => at(robot, "maneuver finished"),
            PaperAction::CompleteTask(robot) => at(robot, "task completed"),
            PaperAction::SafetyTimeout(robot) => at(robot, "safety timeout"),
            PaperAction::Crash(robot) => at(robot, "breaks down"),
            PaperAction::Road(Move::StepOn(robot)) => {
                at(robot, "invites, and the pedestrian steps on the road")
            }
            PaperAction::Road(Move::Across) => at(0, "the pedestrian is across"),
            PaperAction::Road(Move::Reach(robot)) => at(robot, "is in its place"),
            PaperAction::Road(Move::EndFallback(robot)) => at(robot, "has finished its fallback"),
        }
    }
}

fn heard(world: &PaperWorld, from: robot::RobotIndex) -> String {
    world
        .robot(from)
        .map_or_else(String::new, |sender| sender.ram().to_string())
}

fn content(world: &PaperWorld, flight: PaperFlight) -> String {
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

fn change(before: &PaperRobot, after: &PaperRobot) -> Vec<String> {
    let starts = after
        .executing()
        .filter(|_| before.executing() != after.executing());
    let command = match (starts, after.command, before.command) {
        (Some(command), ..) => Some(format!("acknowledges and starts {}", command.request)),
        (None, Some(command), None) if after.follower().is_some() => {
            Some(format!("sends {}", PaperRmcm::Command(command)))
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
    let PaperAction::Arrive { flight, .. } = step.action else {
        return false;
    };
    let Some(Content::Rmcm(PaperRmcm::Command(command))) = step.before.content(flight) else {
        return false;
    };
    let executing = step.after.robot(flight.to).and_then(PaperRobot::executing);
    step.before.memory.started & 1 << command.serial != 0 && executing == Some(command)
}
