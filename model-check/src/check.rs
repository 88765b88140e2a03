//! Runs the checks of one scenario and says what came of them.
//!
//! Two explorations run side by side over the same model. stateright looks for states that break a
//! property. The kit's own builds the whole graph, for what is a fact about all runs, and counts the
//! states a second time. Only when both have visited everything and agree is a check exhaustive.

use std::num::NonZeroUsize;
use std::time::{Duration, Instant};

use stateright::{Checker, Expectation, HasDiscoveries, Model as _, Property};

use crate::graph::{Graph, Limit};
use crate::model::{Action, Delivery, Model, State};
use crate::network::Transmission;
use crate::properties::{Kind, PropertyId};
use crate::report::{ChartStep, CutOff, PropertyReport, ScenarioReport, Verdict};
use crate::scenario::{Scenario, Size};

/// How far and with what a check may go.
#[derive(Clone, Debug)]
pub struct Options {
    /// Threads that stateright explores with.
    pub threads: NonZeroUsize,
    /// Give up after this many states.
    pub states_max: Option<usize>,
    /// Give up after this time.
    pub time_max: Option<Duration>,
    /// Be content as soon as all of these are found to be broken; with none, find all that are.
    pub until_broken: Vec<PropertyId>,
}

impl Default for Options {
    fn default() -> Self {
        let threads = std::thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
        Self {
            threads,
            states_max: None,
            time_max: None,
            until_broken: Vec::new(),
        }
    }
}

/// How far a check is.
#[derive(Clone, Copy, Debug)]
pub struct Progress {
    /// Distinct states that stateright has found.
    pub checked: usize,
    /// Distinct states that the kit's own exploration has found.
    pub explored: usize,
    /// Steps from the initial state to the farthest of the latter.
    pub depth: usize,
    /// How many there will be in the end, where the scenario's file says so.
    pub expected: Option<usize>,
}

/// Checks the model of a scenario. `watch` is told now and then how far it is.
#[must_use]
pub fn check(model: &Model, options: &Options, watch: &mut dyn FnMut(Progress)) -> ScenarioReport {
    let start = Instant::now();
    let scenario = model.scenario();
    let expected = scenario.expected.map(|size| size.unique_states);
    let stateright = configure(model, options).spawn_bfs();
    let limit = Limit {
        states: options.states_max,
        time: options.time_max,
    };
    let graph = Graph::build(model, limit, &mut |explored, depth| {
        watch(Progress {
            checked: stateright.unique_state_count(),
            explored,
            depth,
            expected,
        });
        // What the graph alone can tell is not asked for, or it would still be looked for.
        !options.until_broken.is_empty() && stateright.is_done()
    });
    let (explored, depth) = (graph.states(), graph.depth());
    while !stateright.is_done() {
        std::thread::sleep(Duration::from_millis(20));
        watch(Progress {
            checked: stateright.unique_state_count(),
            explored,
            depth,
            expected,
        });
    }
    let checked = Checked::of(&stateright.join(), model, options, start.elapsed());
    let size = Size {
        unique_states: graph.states(),
        depth: graph.depth(),
    };
    let differ = (checked.unique_states != size.unique_states).then_some(CutOff::CountsDiffer);
    let cut_off = checked.cut_off.or(graph.cut_off()).or(differ);
    let findings = Findings {
        model,
        checked: &checked,
        graph: &graph,
        cut_off,
    };
    ScenarioReport {
        name: scenario.name.clone(),
        summary: scenario.summary.clone(),
        unique_states: size.unique_states,
        transitions: graph.transitions(),
        depth: size.depth,
        exhaustive: cut_off.is_none(),
        cut_off,
        size_as_expected: scenario
            .expected
            .filter(|_| cut_off.is_none())
            .map(|expected| expected == size),
        properties: findings.all(),
        figures: Vec::new(),
        assumptions: assumptions(scenario),
        seconds: start.elapsed().as_secs_f64(),
    }
}

fn configure(model: &Model, options: &Options) -> stateright::CheckerBuilder<Model> {
    let mut builder = model.clone().checker().threads(options.threads.get());
    if let Some(states) = options.states_max {
        builder = builder.target_state_count(states);
    }
    if let Some(time) = options.time_max {
        builder = builder.timeout(time);
    }
    if !options.until_broken.is_empty() {
        let names = options
            .until_broken
            .iter()
            .map(|id| NAMES[*id as usize])
            .collect();
        builder = builder.finish_when(HasDiscoveries::AllOf(names));
    }
    builder
}

/// What stateright's exploration found.
struct Checked {
    unique_states: usize,
    cut_off: Option<CutOff>,
    /// In the order of the scenario's properties.
    counterexamples: Vec<Option<Vec<ChartStep>>>,
}

impl Checked {
    fn of(
        checker: &impl Checker<Model>,
        model: &Model,
        options: &Options,
        elapsed: Duration,
    ) -> Self {
        let mut discoveries = checker.discoveries();
        // stateright says it is done in all of these cases as well.
        let cut_off = if options
            .states_max
            .is_some_and(|max| checker.state_count() >= max)
        {
            Some(CutOff::StateLimit)
        } else if options.time_max.is_some_and(|max| elapsed >= max) {
            Some(CutOff::TimeLimit)
        } else if discoveries.len() == model.properties().len() || !options.until_broken.is_empty()
        {
            Some(CutOff::FoundBroken)
        } else {
            None
        };
        let counterexamples = model
            .scenario()
            .properties
            .iter()
            .map(|id| {
                let path = discoveries.remove(NAMES[*id as usize])?;
                Some(chart(model, path.into_vec()))
            })
            .collect();
        Self {
            unique_states: checker.unique_state_count(),
            cut_off,
            counterexamples,
        }
    }
}

struct Findings<'a> {
    model: &'a Model,
    checked: &'a Checked,
    graph: &'a Graph,
    cut_off: Option<CutOff>,
}

impl Findings<'_> {
    fn all(&self) -> Vec<PropertyReport> {
        let properties = self.model.scenario().properties.iter().enumerate();
        properties
            .flat_map(|(i, &id)| [Some(self.rule(i, id)), self.premise(id)])
            .flatten()
            .collect()
    }

    fn rule(&self, i: usize, id: PropertyId) -> PropertyReport {
        let counterexample = match id {
            PropertyId::L7 => self
                .graph
                .stuck(self.model)
                .map(|path| chart(self.model, path)),
            _ => self.checked.counterexamples[i].clone(),
        };
        let verdict = match (&counterexample, self.cut_off) {
            (Some(_), _) => Verdict::Violated,
            (None, Some(_)) => Verdict::Incomplete,
            (None, None) => Verdict::Holds,
        };
        let kind = match id.kind() {
            Kind::S => "S",
            Kind::T => "T",
        };
        PropertyReport {
            id: id.to_string(),
            kind: kind.to_owned(),
            verdict,
            statement: id.statement().to_owned(),
            counterexample: counterexample.unwrap_or_default(),
        }
    }

    /// The premise of a property; `None` where the property speaks about every state.
    fn premise(&self, id: PropertyId) -> Option<PropertyReport> {
        let verdict = match (self.model.premise_met(id), self.cut_off) {
            (true, _) => Verdict::Reachable,
            (false, Some(_)) => Verdict::Incomplete,
            (false, None) => Verdict::Unreachable,
        };
        id.premise().map(|premise| PropertyReport {
            id: format!("{id}-premise"),
            kind: "premise".to_owned(),
            verdict,
            statement: premise.to_owned(),
            counterexample: Vec::new(),
        })
    }
}

fn chart(model: &Model, path: Vec<(State, Option<Action>)>) -> Vec<ChartStep> {
    path.into_iter()
        .filter_map(|(state, action)| {
            let action = action?;
            let (_, step) = model.successor(&state, action)?;
            let outputs = step.map_or_else(Vec::new, |step| {
                step.outputs().iter().map(ToString::to_string).collect()
            });
            Some(ChartStep {
                action: describe(model, action),
                outputs,
            })
        })
        .collect()
}

/// An action in words.
#[must_use]
pub fn describe(model: &Model, action: Action) -> String {
    let station = |i: u8| model.scenario().robots[usize::from(i)].station;
    let way = |Transmission { from, to, message }, arrow| {
        format!(
            "{} {arrow} {}: {}",
            station(from),
            station(to),
            model.message(message).input()
        )
    };
    match action {
        Action::Deliver { transmission, how } => {
            let how = match how {
                Delivery::AtOnce => "",
                Delivery::Late => " (late)",
                Delivery::LateAndAgain => " (late, and not for the last time)",
            };
            format!("{}{how}", way(transmission, "->"))
        }
        Action::Lose(transmission) => format!("{} (lost)", way(transmission, "-x")),
        Action::Delay(transmission) => format!("{} (delayed)", way(transmission, "-~")),
        Action::Expire(i, timer) => format!("{}: timer {timer} expires", station(i)),
        Action::Local(i, event) => format!("{}: {event}", station(i)),
        Action::Crash(i) => format!("{} crashes", station(i)),
        Action::Restart(i) => format!("{} boots again", station(i)),
    }
}

fn assumptions(scenario: &Scenario) -> Vec<String> {
    let channel = scenario.channel;
    vec![
        "untimed: any armed timer may expire at any moment, so verdicts hold for all timer settings"
            .to_owned(),
        format!("at most: {}", scenario.bounds),
        format!(
            "channel: {}; at most {} delayed at a time, each for any time, in any order, repeated",
            if channel.loss { "loss per receiver" } else { "no loss" },
            channel.delayed,
        ),
        format!("commands are repeated at most {} times", scenario.config.settings().n_ack),
        "all robots are equally far apart, and know all tasks that are asked for".to_owned(),
        "a crash stops the robot's body; station ids and boot counters survive it".to_owned(),
        "states that differ in the names of heartbeats, sessions and offers alone count as one"
            .to_owned(),
        "stateright tells states apart by 64-bit fingerprints".to_owned(),
    ]
}

// stateright wants a plain function for each property; these are them.

fn holds<const N: usize>(model: &Model, state: &State) -> bool {
    let id = PropertyId::ALL[N];
    !Model::is_broken(state, id) && model.state_rule_holds(state, id)
}

macro_rules! per_property {
    ($($n:literal $name:literal),*) => {
        const HOLDS: [fn(&Model, &State) -> bool; PropertyId::ALL.len()] = [$(holds::<$n>),*];
        const NAMES: [&str; PropertyId::ALL.len()] = [$($name),*];
    };
}

per_property!(
    0 "I1", 1 "I2", 2 "I3", 3 "I4", 4 "I5", 5 "I6", 6 "I7", 7 "I8", 8 "I9", 9 "I11", 10 "I12",
    11 "I13", 12 "I14", 13 "I15", 14 "I16", 15 "I17", 16 "I18", 17 "L7"
);

impl stateright::Model for Model {
    type State = State;
    type Action = Action;

    fn init_states(&self) -> Vec<State> {
        vec![self.initial()]
    }

    fn actions(&self, state: &State, actions: &mut Vec<Action>) {
        self.actions_in(state, actions);
    }

    fn next_state(&self, state: &State, action: Action) -> Option<State> {
        self.successor(state, action).map(|(next, _)| next)
    }

    fn properties(&self) -> Vec<Property<Self>> {
        let by_state_or_step =
            |id: &PropertyId| id.state_rule().is_some() || id.step_rule().is_some();
        let ids = self
            .scenario()
            .properties
            .iter()
            .copied()
            .filter(by_state_or_step);
        ids.map(|id| Property {
            expectation: Expectation::Always,
            name: NAMES[id as usize],
            condition: HOLDS[id as usize],
        })
        .collect()
    }

    fn format_action(&self, action: &Action) -> String {
        describe(self, *action)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_property_has_its_name_at_its_place() {
        for id in PropertyId::ALL {
            assert_eq!(NAMES[id as usize], id.to_string());
        }
    }
}
