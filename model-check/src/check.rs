//! Runs the checks of one scenario and reports the results.
//!
//! Two explorations run over the same model, one after the other, so that the memory of the first is free
//! for the second. stateright's looks for states that break a property. The kit's own builds the whole
//! graph, for what is a fact about all runs, and counts the states a second time. Only when both have
//! visited everything and agree is a check exhaustive.

use std::time::Duration;

use stateright::{Checker, Expectation, HasDiscoveries, Model as _, Property};

use crate::confinement::LyingPart;
use crate::cost::Meter;
use crate::exploration::ExplorationLimits;
pub use crate::exploration::{CheckProgress, Options, Stop};
use crate::fair::{LeadsTo, leads_to};
use crate::fairness::Runs;
use crate::graph::Graph;
use crate::model::{Action, Delivery, Model, ModelState};
use crate::network::Transmission;
use crate::properties::{
    Claim, LivenessRule, LivenessSubject, PropertyId, Rule, View, for_each_property,
};
use crate::report::{CheckVerdict, CutOff, PropertyReport, ScenarioReport};
use crate::scenario::{RobotSetup, Scenario, Size};
use crate::sequence::{ChartPlace, ChartStep, Fate};

/// Checks the model of a scenario. `watch` receives the progress now and then.
#[must_use]
pub fn check(
    model: &Model,
    options: &Options,
    watch: &mut dyn FnMut(CheckProgress),
) -> ScenarioReport {
    let (meter, limits) = (Meter::start(), options.limits());
    let scenario = model.scenario();
    let progress = CheckProgress {
        expected: scenario.expected.map(|size| size.unique_states),
        ..CheckProgress::default()
    };
    let checked = Checked::of(model, options, &limits, &mut |checked| {
        watch(CheckProgress {
            checked,
            ..progress
        });
    });
    let graph = Graph::build(model, &limits, &mut |reached| {
        watch(CheckProgress {
            checked: checked.unique_states,
            explored: reached.states,
            frontier: reached.frontier,
            depth: reached.depth,
            ..progress
        });
        // What the graph alone can tell is not asked for.
        !options.until_broken.is_empty()
    });
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
        robots: names(scenario),
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
        assumptions: assumptions(scenario, size.unique_states),
        transitions_taken: model.transitions_taken(),
        seconds: limits.elapsed().as_secs_f64(),
        // One of the two may have been cut off before it began.
        cost: meter.read(size.unique_states.max(checked.unique_states)),
    }
}

/// Once `drain` is requested nothing happens any more in the model, and all threads end with what they have.
/// stateright's own time limit is not used: it holds up threads that share work, for minutes.
fn configure(model: &Model, options: &Options, drain: &Stop) -> stateright::CheckerBuilder<Model> {
    let model = model.clone().stopping_at(drain);
    let mut builder = model.checker().threads(options.threads.get());
    if let Some(states) = options.states_max {
        builder = builder.target_state_count(states);
    }
    if !options.until_broken.is_empty() {
        let names = options.until_broken.iter().map(|id| id.name()).collect();
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
    /// Explores the model with stateright. `watch` receives the number of states found now and then.
    fn of(
        model: &Model,
        options: &Options,
        limits: &ExplorationLimits,
        watch: &mut dyn FnMut(usize),
    ) -> Self {
        let drain = Stop::default();
        let checker = configure(model, options, &drain).spawn_bfs();
        while !checker.is_done() {
            std::thread::sleep(Duration::from_millis(20));
            if limits.time_reached().is_some() {
                drain.request();
            }
            watch(checker.unique_state_count());
        }
        Self::by(&checker.join(), model, options, limits)
    }

    fn by(
        checker: &impl Checker<Model>,
        model: &Model,
        options: &Options,
        limits: &ExplorationLimits,
    ) -> Self {
        let mut discoveries = checker.discoveries();
        // stateright says it is done in all of these cases as well.
        let found_all =
            discoveries.len() == model.properties().len() || !options.until_broken.is_empty();
        let cut_off = limits
            .states_reached(checker.state_count())
            .then_some(CutOff::StateLimit)
            .or(limits.time_reached())
            .or(found_all.then_some(CutOff::FoundBroken));
        let counterexamples = model
            .scenario()
            .properties
            .iter()
            .map(|id| {
                let path = discoveries.remove(id.name())?;
                Some(chart(model, model.real_run(path.into_vec())))
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
        let claimed = properties.filter_map(|(i, &id)| Some((i, id, id.untimed()?)));
        claimed
            .flat_map(|(i, id, claim)| [Some(self.rule(i, id, claim)), self.premise(id, claim)])
            .flatten()
            .collect()
    }

    fn rule(&self, i: usize, id: PropertyId, claim: &Claim) -> PropertyReport {
        let (counterexample, repeats_after) = match claim.rule {
            Rule::Reset => (self.stuck(), None),
            Rule::Live(rule) => match self.lasso(id, rule) {
                Some((chart, repeats_after)) => (Some(chart), Some(repeats_after)),
                None => (None, None),
            },
            _ => (self.checked.counterexamples[i].clone(), None),
        };
        PropertyReport {
            id: id.to_string(),
            kind: claim.kind.name().to_owned(),
            verdict: CheckVerdict::of_property(counterexample.is_some(), self.cut_off),
            statement: claim.statement.to_owned(),
            authentication: Some(id.authentication().to_string()),
            counterexample: counterexample.unwrap_or_default(),
            repeats_after,
        }
    }

    /// A run into a state from which the robots cannot all get idle any more.
    fn stuck(&self) -> Option<Vec<ChartStep>> {
        let runs = self.runs();
        let stem = self.graph.run_to(self.graph.stuck()?);
        let run = self.model.real_run(runs.along(&stem, &[]));
        Some(chart(self.model, run))
    }

    /// A fair run that breaks a liveness property, and how many steps of it come before its cycle.
    /// Notes the property's premise where it is met.
    fn lasso(&self, id: PropertyId, rule: LivenessRule) -> Option<(Vec<ChartStep>, usize)> {
        if self.cut_off.is_some() {
            return None;
        }
        let runs = self.runs();
        let look = |state, rule: fn(&View, LivenessSubject) -> bool, subject| {
            let look = |view: &View| rule(view, subject);
            self.model.look(self.graph.state(state), look)
        };
        for subject in rule.subjects.among(self.model.scenario().robots.len()) {
            let from = |state| look(state, rule.from, subject);
            // What comes after a broken step property was not explored.
            let to = |state| look(state, rule.to, subject) || self.graph.state(state).is_broken();
            match leads_to(&runs, runs.fairness(), from, to) {
                LeadsTo::Vacuous => {}
                LeadsTo::Holds => self.model.note_premise(id),
                LeadsTo::Broken(lasso) => {
                    self.model.note_premise(id);
                    let run = runs.along(&lasso.stem, &lasso.cycle);
                    return Some((chart(self.model, run), lasso.stem.len() - 1));
                }
            }
        }
        None
    }

    const fn runs(&self) -> Runs<'_> {
        Runs {
            model: self.model,
            graph: self.graph,
        }
    }

    /// The premise of a property; `None` where the property speaks about every state.
    fn premise(&self, id: PropertyId, claim: &Claim) -> Option<PropertyReport> {
        claim.premise.map(|premise| PropertyReport {
            id: format!("{id}-premise"),
            kind: "premise".to_owned(),
            verdict: CheckVerdict::of_premise(self.model.premise_met(id), self.cut_off),
            statement: premise.to_owned(),
            authentication: None,
            counterexample: Vec::new(),
            repeats_after: None,
        })
    }
}

pub(crate) fn chart(model: &Model, path: Vec<(ModelState, Option<Action>)>) -> Vec<ChartStep> {
    path.into_iter()
        .filter_map(|(state, action)| {
            let action = action?;
            let (_, step) = model.successor(&state, action)?;
            let outputs = step.map_or_else(Vec::new, |step| {
                step.outputs().iter().map(ToString::to_string).collect()
            });
            let (place, action) = placed(model, action);
            Some(ChartStep {
                place,
                action,
                outputs,
            })
        })
        .collect()
}

/// An action in words, with its place in a chart.
pub(crate) fn placed(model: &Model, action: Action) -> (ChartPlace, String) {
    let between = |Transmission { from, to, message }, fate| {
        let place = ChartPlace::Between {
            from: from.into(),
            to: to.into(),
            fate,
        };
        (place, model.message(message).input().to_string())
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
        Action::Expire(robot, timer) => at(robot, format!("timer {timer} expires")),
        Action::Local(robot, event) => at(robot, event.to_string()),
        Action::Crash(robot) => at(robot, "crashes".to_owned()),
        Action::Restart(robot) => at(robot, "boots again".to_owned()),
        Action::StepOnRoad(robot) => at(robot, "at its sign somebody steps on the road".to_owned()),
        Action::Across(robot) => at(robot, "who stepped on the road there is across".to_owned()),
        Action::Hang(robot) => at(robot, "hangs".to_owned()),
        Action::Resume(robot) => at(robot, "goes on".to_owned()),
    }
}

/// An action in one line.
pub(crate) fn label(model: &Model, action: Action) -> String {
    let (place, action) = placed(model, action);
    let step = ChartStep {
        place,
        action,
        outputs: Vec::new(),
    };
    step.line(&names(model.scenario()))
}

/// The robots' names in charts.
#[must_use]
pub fn names(scenario: &Scenario) -> Vec<String> {
    let name = |robot: &RobotSetup| format!("robot {}", robot.station);
    scenario.robots.iter().map(name).collect()
}

/// The probability that any two of this number of states share a 64-bit fingerprint, where fingerprints are as
/// good as random; an upper bound (the union bound over all pairs).
#[expect(clippy::cast_precision_loss, reason = "an estimate")]
fn collision_probability(states: usize) -> f64 {
    let states = states as f64;
    (states * (states - 1.0) / 2.0) / 2_f64.powi(64)
}

fn assumptions(scenario: &Scenario, states: usize) -> Vec<String> {
    let channel = scenario.channel;
    let mut assumptions = vec![
        "untimed: any armed timer may expire at any moment, so verdicts hold for all timer settings, but \
         for L7, which says that some run exists"
            .to_owned(),
        format!("at most: {}", scenario.bounds),
        if channel.monotone {
            "channel: every message ever sent arrives at any later time, any number of times, in any \
             order, or never, also after its receiver boots again; 'heartbeats' bounds how many periods \
             leaders count, 'offers' how often a message makes a robot offer"
                .to_owned()
        } else {
            format!(
                "channel: {}; at most {} delayed at a time, each for any time, in any order, repeated",
                if channel.loss { "loss per receiver" } else { "no loss" },
                channel.delayed,
            )
        },
        format!("commands are repeated at most {} times", scenario.config.settings().n_ack),
        "all robots are equally far apart, and know all tasks that are asked for".to_owned(),
        receivers(scenario),
        "a crash stops the robot's body; station ids and boot counters survive it".to_owned(),
        "applications are truthful: a body is where they say that it is, a guard finishes, the road is \
         clear and the task is done only when no pedestrian is on the road"
            .to_owned(),
        "states that differ in the names of heartbeats, sessions and offers alone count as one"
            .to_owned(),
        format!(
            "stateright compares 64-bit fingerprints of states: any two of these states share one with \
             a probability of {:.0e}; the kit's own exploration compares whole states",
            collision_probability(states)
        ),
    ];
    if scenario.bounds.hangs > 0 {
        assumptions.push(
            "a robot that hangs does and hears nothing, keeps its state, and goes on at some time; its \
             body does what it did before"
                .to_owned(),
        );
    }
    let liars: Vec<_> = scenario.liars().collect();
    if !liars.is_empty() {
        let stations: Vec<_> = liars.iter().map(|(_, id, _)| id.to_string()).collect();
        assumptions.push(format!(
            "robot {} lies: at any moment, and to each robot apart, it says any RAM or RMCM in its own name, of the \
             numbers that it or its hearer gave out, one newer and one older than all, and request numbers 0 to {}",
            stations.join(", "),
            scenario.bounds.commands,
        ));
    }
    if liars.iter().any(|(_, _, lies)| *lies == LyingPart::Helper) {
        assumptions
            .push("runs in which a leader confirms the robot that lies are left out".to_owned());
    }
    if !scenario.symmetric.is_empty() {
        let robots: Vec<_> = scenario.symmetric.iter().map(ToString::to_string).collect();
        assumptions.push(format!(
            "states that differ by exchanging robots {} count as one",
            robots.join(", ")
        ));
    }
    if scenario.properties.iter().any(|id| id.is_of_runs()) {
        assumptions.push(
            "L: weakly fair: an armed timer expires at some time, unless it is stopped or restarted \
             again and again; a message on air is delivered, lost or delayed at some time"
                .to_owned(),
        );
    }
    if scenario.cooperative {
        assumptions.push(
            "cooperative: an RMCM arrives; of RAM of one kind that are sent one way again and again, \
             some arrive; no timer that guards against silence runs out; applications give their \
             commands, finish maneuvers, and end the task once one is completed, all at some time"
                .to_owned(),
        );
    }
    assumptions
}

/// Which receiver hears a message first.
fn receivers(scenario: &Scenario) -> String {
    let order = if scenario.symmetric.is_empty() {
        "the ones listed first hear it first"
    } else {
        "any may hear it first"
    };
    format!("of the receivers of one message that is not delayed, {order}")
}

/// Whether a state keeps the property of this number. stateright wants a plain function for each.
pub(crate) fn holds<const N: usize>(model: &Model, state: &ModelState) -> bool {
    let id = PropertyId::ALL[N];
    !Model::breaks(state, id) && model.state_rule_holds(state, id)
}

const HOLDS: [fn(&Model, &ModelState) -> bool; PropertyId::ALL.len()] = for_each_property!(holds);

/// The properties of a scenario that stateright can check, each with its condition from `conditions`.
pub(crate) fn checked_properties<M: stateright::Model>(
    scenario: &Scenario,
    conditions: &[fn(&M, &M::State) -> bool; PropertyId::ALL.len()],
) -> Vec<Property<M>> {
    let ids = scenario.properties.iter().copied();
    let ids = ids.filter(|id| id.is_of_states_or_steps());
    ids.map(|id| Property {
        expectation: Expectation::Always,
        name: id.name(),
        condition: conditions[id as usize],
    })
    .collect()
}

impl stateright::Model for Model {
    type State = ModelState;
    type Action = Action;

    fn init_states(&self) -> Vec<ModelState> {
        vec![self.initial()]
    }

    fn actions(&self, state: &ModelState, actions: &mut Vec<Action>) {
        // stateright has no other way to be stopped.
        if !self.has_to_stop() {
            self.actions_in(state, actions);
        }
    }

    fn next_state(&self, state: &ModelState, action: Action) -> Option<ModelState> {
        self.successor_up_to_symmetry(state, action)
            .map(|(next, _)| next)
    }

    fn properties(&self) -> Vec<Property<Self>> {
        checked_properties(self.scenario(), &HOLDS)
    }

    fn format_action(&self, action: &Action) -> String {
        label(self, *action)
    }
}
