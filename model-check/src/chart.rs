//! Runs of the model without time as charts: each action in words, and where it stands.

use crossguard_protocol::{Input, Output};

use crate::explore::RunOf;
use crate::model::{Action, Delivery, Model, ModelState};
use crate::names::Names;
use crate::network::Transmission;
use crate::scenario::{RobotSetup, Scenario};
use crate::sequence::{ChartPlace, ChartStep, Fate};

pub(crate) fn chart(model: &Model, path: RunOf<Model>) -> Vec<ChartStep> {
    path.into_iter()
        .filter_map(|(state, action)| Some(chart_step(model, &state, action?)?.1))
        .collect()
}

/// The effect of an action, and the action in a chart with what the robot puts out; `None` where it is not possible.
pub(crate) fn chart_step(
    model: &Model,
    state: &ModelState,
    action: Action,
) -> Option<(ModelState, ChartStep)> {
    let (next, step) = model.successor(state, action)?;
    let outputs = step.map_or_else(Vec::new, |step| {
        step.outputs()
            .iter()
            .map(|it| worded(model.names(), it))
            .collect()
    });
    let (place, action) = placed(model, action);
    let step = ChartStep {
        place,
        action,
        outputs,
    };
    Some((next, step))
}

/// An output in words. This model has no durations: go lasts until something ends it.
fn worded(names: &Names, output: &Output) -> String {
    match output {
        Output::CorridorOpened(_) => "corridor opened".to_owned(),
        Output::CorridorExtended(_) => "corridor extended".to_owned(),
        output => names.tell(output),
    }
}

pub(crate) fn said(names: &Names, message: &Input) -> String {
    match message {
        Input::Ram { ram, .. } => names.tell(ram),
        other => names.tell(other),
    }
}

/// Text of the step in which the pedestrian gets across the road.
pub(crate) const ACROSS: &str = "who stepped on the road there is across";

pub(crate) fn placed(model: &Model, action: Action) -> (ChartPlace, String) {
    let between = |Transmission { from, to, message }, fate| {
        let place = ChartPlace::Between {
            from: from.into(),
            to: to.into(),
            fate,
        };
        (place, said(model.names(), &model.message(message).input()))
    };
    let at = |robot: u8, what: String| (ChartPlace::At(robot.into()), what);
    match action {
        Action::Deliver { transmission, how } => {
            let fate = match how {
                Delivery::AtOnce | Delivery::AnyTime => Fate::Arrives,
                Delivery::Late => Fate::ArrivesLate,
                Delivery::LateAndAgain => Fate::ArrivesLateAndAgain,
            };
            between(transmission, fate)
        }
        Action::Lie(transmission) => between(transmission, Fate::Arrives),
        Action::Lose(transmission) => between(transmission, Fate::Lost),
        Action::Delay(transmission) => between(transmission, Fate::Delayed),
        Action::Expire(robot, timer) => at(
            robot,
            model.names().tell(format_args!("timer {timer} expires")),
        ),
        Action::Local(robot, event) => at(robot, model.names().tell(event)),
        Action::Crash(robot) => at(robot, "crashes".to_owned()),
        Action::Restart(robot) => at(robot, "boots again".to_owned()),
        Action::StepOnRoad(robot) => at(robot, "at its sign somebody steps on the road".to_owned()),
        Action::Across(robot) => at(robot, ACROSS.to_owned()),
        Action::Hang(robot) => at(robot, "hangs".to_owned()),
        Action::Resume(robot) => at(robot, "goes on".to_owned()),
    }
}

/// The robots' names in charts.
#[must_use]
pub fn names(scenario: &Scenario) -> Vec<String> {
    let name = |robot: &RobotSetup| format!("robot {}", robot.station);
    scenario.robots.iter().map(name).collect()
}
