//! Counterexamples in words, and the documentation page.

use std::fmt::Write as _;

use crossguard_protocol::State as Stage;

use super::hazards::Passage;
use super::model::PaperAction;
use super::road::Move;
use super::robot::{self, HelpStatus, PaperInput, PaperRmcm, PaperRobot, PaperTask, Progression};
use super::world::{Content, FlightKind, PaperFlight, PaperWorld};
use super::{Counterexample, Transition, counterexamples};
use crate::sequence::{Chart, ChartPlace, ChartStep, Fate};

const INTRODUCTION: &str = "\
# The paper's text as it stands

The paper *Multi-Robot Coordination in V2X Environments* (Arockiasamy, Vinel; arXiv 2605.06662)
describes four states, two messages and what robots do with them. `crossguard check paper-literal`
checks a small model of that text (`model-check/src/paper`), and the check must fail. Each
run below was found by stateright, is the shortest of its kind, and is the reason for a
rule that the protocol of this kit adds. `protocol/tests/scripts/paper.txt` tells
P1 to P14 to the protocol, which survives them. [The paper, paragraph by paragraph](paper.md) says where all the rest of it is.

A hazard is one of three kinds, and names the paragraph that it comes from:

- **Stated**: the text has the rule from which it follows;
- **Silent**: the text has no rule for the case;
- **Ambiguous**: the text can be read in more than one way. The model takes the reading that says least. The other one
  is checked too, within the bounds that the check reports, and the section says whether the hazard is found in it.

A hazard is a statement about the text, not about the authors' robots, which may well do more than the text says. Where
the text does not say enough, the model does no more than it says:

- The container of a robot that joins has no field that the requester compares; it takes the first answer that it hears.
- `helpStatus` stays `needHelp` and `offerHelp` until the release: the text sets it at no other moment.
- The helper stays in Idle until the roles are established: only the requester's transition is told.
- RMCM are sent once. A leader counts requestIDs from 0 in each association, and reissues a command with its number.
- Completion needs all three that the text lists: the follower stands, where the task ends, and says `completed`.
- A leader that hears of the safe idle position is in RoleEstablished again, since commands are issued there.
- An execution timeout is that of the robot that executes, and leads to the same fallback.
- A follower that asks for leave is bound until its leader releases it.
- HelpRequested, an offer and a leader's patience have no time limit; no timeout has a value.

This page is generated from what the checker finds; a test fails when the two differ. To write it
anew: `cargo xtask bless paper-literal`.

";

const CLOSED: &str = "
## P10: what the text closes itself

A lost command is waited for by its leader, and the text knows no repetition of RMCM. Yet the follower, which misses a
command for its safety timeout, goes to its safe idle position and says so in RAM, and the leader may reissue. The
checker explores every run of the pair and finds none in which a leader waits for ever for a follower that is there and
follows it: P10 holds, as long as the leader's application reissues what it may. The kit repeats the command after
T_ack, at most N_ack times, and then treats the follower as lost (I16, L2), so that a lost command costs less than a
safety timeout.
";

const ON_ROAD: &str = "
## What it means for a person on the road

The same model, with a road around it: a body of each follower and one pedestrian, judged by the road
properties that the kit's own scenarios keep ([what has been verified](verification.md)). W5, W6 and W8 take time, which
this model does not have.

The text has neither a sign nor a corridor with an end. It says when people go. Beside an escort: the leader tells the
pedestrian to follow the robot dog once the roles are established (III-A, stage 3), so the pedestrian steps on the road
with the dog's `Move` while the leader stops the traffic; before the dog moves, nobody is taken to go. Where a follower
blocks: the two commands form the corridor (III-A, extending FSM control), so the leader lets people cross while it is
in ManeuverExecuting with an acknowledged `block`. The pedestrian is off the road at any time later. An escort guards
from the start of its `Move` on, a blocker where it stands in its place. Applications are truthful: no maneuver is
finished, no leave granted and no task done while somebody is on the road. W1 has the exemption that it has for the kit
without time: a guard that has fallen back, finished or lost power, as long as no message has told its leader so. There
is one crossing, so that W3 is about every two leaders.

`protocol/tests/scripts/paper.txt` does not repeat these runs: the kit's own model has the same road (`model-check/src/road.rs`).
";

/// The documentation page: each counterexample as a sequence chart, where it comes from, what it means, what closes
/// it.
#[must_use]
pub fn page() -> String {
    let all = counterexamples();
    let (on_road, found): (Vec<_>, Vec<_>) = all.iter().partition(|found| found.is_on_road);
    let mut page = INTRODUCTION.to_owned();
    page.push_str("| hazard | kind | section | paragraph |\n|---|---|---|---|\n");
    for text in all.iter().map(|found| found.text) {
        let Passage {
            section, paragraph, ..
        } = text.passage;
        let (id, title, kind) = (text.id, text.title, text.kind.name());
        let _ = writeln!(page, "| {id}: {title} | {kind} | {section} | {paragraph} |");
    }
    for found in found {
        page.push_str(&section("##", found, "Closed by"));
    }
    page.push_str(CLOSED);
    page.push_str(ON_ROAD);
    for found in on_road {
        page.push_str(&section("###", found, "Kept by"));
    }
    page
}

fn section(heading: &str, found: &Counterexample, how_the_kit_answers: &str) -> String {
    let text = found.text;
    let Passage {
        section,
        paragraph,
        words,
    } = text.passage;
    let other = text.other_reading.map_or_else(String::new, |other| {
        let found = if other.remains {
            "it is found there too"
        } else {
            "it is not found there"
        };
        format!(
            "In another reading: {}. By the checker, {found}.\n\n",
            other.says
        )
    });
    format!(
        "\n{heading} {}: {}\n\n**{}**: section {section}, {paragraph} (\"{words}\").\n\n{}\n\nFor a person: {}\n\n{other}Broken property: {}.\n\n```mermaid\n{}```\n\n{how_the_kit_answers}: {}\n",
        text.id,
        text.title,
        text.kind.name(),
        text.explanation,
        text.person,
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
            PaperAction::Local(robot, input) => at(robot, said(input)),
            PaperAction::Crash(robot) => at(robot, "breaks down"),
            PaperAction::Road(Move::StepOn(_)) if self.cast.plan.contains(&PaperTask::Move) => {
                at(0, "the pedestrian steps on the road beside the escort")
            }
            PaperAction::Road(Move::StepOn(robot)) => at(
                robot,
                "lets people cross, and the pedestrian steps on the road",
            ),
            PaperAction::Road(Move::Across) => at(0, "the pedestrian is across"),
            PaperAction::Road(Move::EndFallback(robot)) => at(robot, "has finished its fallback"),
        }
    }
}

/// What a robot takes in that is no message.
const fn said(input: PaperInput) -> &'static str {
    match input {
        PaperInput::Detected => "pedestrian detected",
        PaperInput::Commanded(..) => "gives a command",
        PaperInput::Reissued(_) => "reissues its command",
        PaperInput::Finished => "maneuver finished",
        PaperInput::TaskCompleted => "task completed",
        PaperInput::SafetyTimeout => "safety timeout",
        PaperInput::LeaderTimeout => "execution timeout",
        PaperInput::LeaveAsked => "wants to leave",
        PaperInput::LeaveGranted => "grants the leave",
        PaperInput::Ram(..) | PaperInput::Rmcm(..) => "hears a message",
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
    let mut said = vec![commanded(before, after), stopped(before, after)];
    let has_become = |is: fn(&HelpStatus) -> bool| is(&after.status) && !is(&before.status);
    let offers = has_become(|it| matches!(it, HelpStatus::OfferHelp { .. }));
    said.push(offers.then(|| "offers help".to_owned()));
    let leaving = |it: &HelpStatus| {
        let HelpStatus::Follower { is_leaving, .. } = *it else {
            return false;
        };
        is_leaving
    };
    said.push(has_become(leaving).then(|| "asks for leave".to_owned()));
    let may_reissue = after.is_told_idle && !before.is_told_idle;
    said.push(may_reissue.then(|| "may reissue its command".to_owned()));
    said.push((before.state != after.state).then(|| match after.status {
        HelpStatus::Leader { .. } => format!("{:?} (leader)", after.state),
        HelpStatus::Follower { .. } => format!("{:?} (follower)", after.state),
        _ => format!("{:?}", after.state),
    }));
    said.into_iter().flatten().collect()
}

/// What becomes of a command.
fn commanded(before: &PaperRobot, after: &PaperRobot) -> Option<String> {
    let starts = after
        .executing()
        .filter(|_| before.executing() != after.executing());
    let leads = after.follower().is_some();
    match (starts, before.command, after.command) {
        (Some(command), ..) => Some(format!(
            "acknowledges and starts {} ({})",
            command.request, command.task
        )),
        (None, old, Some(command)) if leads && old != Some(command) => {
            Some(format!("sends {}", PaperRmcm::Command(command)))
        }
        (None, Some(command), None) if leads => {
            Some(format!("counts {} as completed", command.request))
        }
        _ => None,
    }
}

/// What ends a follower's maneuver, or its wait.
fn stopped(before: &PaperRobot, after: &PaperRobot) -> Option<String> {
    let falls_back =
        after.progression == Progression::SafeIdle && before.progression != Progression::SafeIdle;
    let stops = before.executing().is_some() && after.state == Stage::Idle;
    match (falls_back, stops) {
        (true, _) => Some("goes to its safe idle position".to_owned()),
        (_, true) => Some("stops the maneuver".to_owned()),
        _ => None,
    }
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
