//! Runs the check of one timed scenario and reports the result.

use crossguard_protocol::Outputs;

use super::model::TimedModel;
use super::section::{Looks, Rates};
use super::state::{TimedAction, TimedState};
use super::system::where_time_stands_still;
use crate::chart::said;
use crate::exploration::{CheckProgress, Options};
use crate::explore::{Keep, RunOf, explore};
use crate::network::Transmission;
use crate::properties::PropertyId;
use crate::report::{KIT, PropertyReport, ScenarioReport};
use crate::robots::TimedCause;
use crate::scenario::Size;
use crate::sequence::{ChartPlace, ChartStep, Fate};

/// Checks a timed model. `watch` receives the progress now and then. Of the options, the limits on
/// states and time and the number of threads count; there is no second opinion.
#[must_use]
pub fn check(
    model: &TimedModel,
    options: &Options,
    watch: &mut dyn FnMut(CheckProgress),
) -> ScenarioReport {
    let (scenario, timed) = (model.scenario(), &model.timed);
    let options = Options {
        until_broken: Vec::new(),
        ..options.clone()
    };
    let limits = options.limits();
    let expected = scenario.expected.map(|size| size.unique_states);
    let mut tell = |reached| {
        watch(CheckProgress {
            expected,
            ..reached
        });
    };
    let (graph, shown) = explore(model, Keep::Transitions, &options, &limits, &mut tell);
    let size = Size {
        unique_states: graph.states(),
        depth: graph.depth(),
    };
    let cut_off = graph.cut_off();
    let is_asked = cut_off.is_none() && graph.broken(PropertyId::I12).is_none();
    let held = is_asked.then(|| where_time_stands_still(&graph)).flatten();
    let claimed = timed.properties.iter();
    let claimed = claimed.filter_map(|&id| Some((id, id.timed()?)));
    let judged = |(id, claim)| {
        let held = held.filter(|_| id == PropertyId::I12);
        let broken = graph.broken(id).or(held);
        let run = broken.map(|broken| chart(model, graph.run_into(broken)));
        PropertyReport::judged((id, claim), shown.premises.met(id), run, None, cut_off)
    };
    ScenarioReport {
        transitions: graph.transitions(),
        engines: vec![KIT],
        properties: claimed.flat_map(judged).collect(),
        figures: shown.longest.figures(timed, &model.limits),
        assumptions: assumptions(model),
        seconds: limits.elapsed().as_secs_f64(),
        ..ScenarioReport::of_scenario(scenario, size, cut_off)
    }
}

/// A run as a chart: what happened at which time, and what the robots put out.
fn chart(model: &TimedModel, run: RunOf<TimedModel>) -> Vec<ChartStep> {
    let mut time = 0;
    let mut steps = Vec::new();
    for (state, action) in run {
        let Some(action) = action else { break };
        if matches!(action, TimedAction::Tick(_)) {
            time += model.timed.clock.tick.0;
        }
        steps.extend(steps_of(model, &state, action, time));
    }
    steps
}

/// Steps of an action in a chart: each robot's input and outputs.
fn steps_of(
    model: &TimedModel,
    state: &TimedState,
    action: TimedAction,
    time: u32,
) -> Vec<ChartStep> {
    let at = |robot: u8, what: String, outputs: &[String]| ChartStep {
        place: ChartPlace::At(robot.into()),
        action: format!("at {time} ms: {what}"),
        outputs: outputs.to_vec(),
    };
    let fault = match action {
        TimedAction::Crash(robot) => Some(at(robot, "crashes for good".to_owned(), &[])),
        TimedAction::Hang(robot) => Some(at(robot, "begins to hang".to_owned(), &[])),
        TimedAction::GoOn(robot) => Some(at(robot, "goes on".to_owned(), &[])),
        TimedAction::Meet => Some(at(
            0,
            "its team and the other reach each other from now on".to_owned(),
            &[],
        )),
        _ => None,
    };
    let step = |(robot, cause, outputs): (u8, TimedCause, Outputs)| {
        let lines: Vec<_> = outputs.iter().map(|it| model.names.tell(it)).collect();
        match (cause, action) {
            (TimedCause::Elapsed(elapsed), _) => at(
                robot,
                format!("its clock shows {} ms more", elapsed.0),
                &lines,
            ),
            (TimedCause::Event(event), _) => at(robot, model.names.tell(event), &lines),
            (TimedCause::Message(number), TimedAction::Deliver(flight)) => {
                let Transmission { from, to, .. } = flight.transmission;
                let delay = model.timed.clock.millis(flight.ticks).0;
                let input = said(&model.names, &model.message(number).input());
                let fate = if delay == 0 {
                    Fate::Arrives
                } else {
                    Fate::ArrivesLate
                };
                ChartStep {
                    place: ChartPlace::Between {
                        from: from.into(),
                        to: to.into(),
                        fate,
                    },
                    action: format!("at {time} ms, after {delay} ms: {input}"),
                    outputs: lines,
                }
            }
            (TimedCause::Message(number), _) => at(
                robot,
                said(&model.names, &model.message(number).input()),
                &lines,
            ),
        }
    };
    let steps = model.outputs(state, action).into_iter().map(step);
    fault.into_iter().chain(steps).collect()
}

fn assumptions(model: &TimedModel) -> Vec<String> {
    let (scenario, timed) = (model.scenario(), &model.timed);
    let clock = &timed.clock;
    let drift = if clock.drifts() {
        let (slow, fast) = (clock.slow.0, clock.fast.0);
        match timed.rates {
            Rates::Changing => format!(
                "clocks: each shows {slow} or {fast} ms of each tick, in any order; that is every clock within {} ppm, read to {} ms",
                scenario.config.settings().drift_ppm,
                fast - slow,
            ),
            Rates::Constant => format!(
                "clocks: each shows {slow} ms of every tick of a run, or {fast} ms of every tick; a clock in between, or that changes its rate, is not covered",
            ),
        }
    } else {
        "clocks do not drift".to_owned()
    };
    let looks = match timed.looks {
        Looks::EachTick => format!(
            "timed: every robot looks at its clock once a tick of {} ms; timers that are due fire then",
            clock.tick.0
        ),
        Looks::Within(late) => format!(
            "timed: each robot looks at its clock at any time, at the latest {} ms after a timer became due, at whole ticks of {} ms",
            late.0, clock.tick.0
        ),
    };
    let fate = if scenario.channel.loss {
        ", or gets lost, per receiver"
    } else {
        ", and arrives"
    };
    let (teams, failures) = if timed.teams.are_two() {
        let apart =
            "two teams reach each other at some time after both signs show go, and not before";
        (Some(apart.to_owned()), "no robot fails")
    } else {
        (None, "one failure in a run, after the request")
    };
    let mut assumptions = vec![
        looks,
        drift,
        format!(
            "channel: each message is under way from 0 to {} ms, in any order{fate}",
            timed.delay.0,
        ),
        format!("at most: {}; {failures}", scenario.bounds),
        "applications command, and open the corridor, as soon as they may; none ends a session or closes the corridor, and no maneuver ends by itself"
            .to_owned(),
        "no run lasts as long as T_lock or T_exec".to_owned(),
        "figures and bounds are true time, and of these timers; a crash stops the robot's body and its sign, a hang neither".to_owned(),
        "one exploration, by the kit itself, which compares whole states".to_owned(),
        "heartbeats are counted from the oldest one in a state; states that differ in the names of sessions and offers alone count as one"
            .to_owned(),
    ];
    assumptions.extend(teams);
    assumptions
}
