//! Counterexamples in words.

use crossguard_protocol::State as Stage;

use super::model::PaperAction;
use super::road::Move;
use super::robot::{self, HelpStatus, PaperInput, PaperRmcm, PaperRobot, PaperTask, Progression};
use super::world::{Content, FlightKind, PaperFlight, PaperWorld};
use super::{Counterexample, Transition};
use crate::sequence::{ChartPlace, ChartStep, Fate};

impl Counterexample {
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

/// Text of an input that is no message.
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

/// Changes in the robot that takes a step, in words.
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

/// End of a follower's maneuver or wait, in words.
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
