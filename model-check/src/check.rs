//! Runs the checks of one scenario and reports the results.
//!
//! The kit's own exploration builds the whole graph. It judges states and steps on the way, and what is a fact
//! about all runs afterwards. As a second opinion stateright explores the same model before that, so that its
//! memory is free again. A check with both is exhaustive only when both have visited everything and agree.

use stateright::{Checker, Expectation, HasDiscoveries, Model as _, Property};

use crate::by_stateright::by_stateright;
use crate::chart::chart;
pub use crate::chart::names;
pub use crate::exploration::{CheckProgress, ExplorationLimits, Options, Stop};
use crate::explore::{Graph, Keep, explore};
use crate::fair::{LeadsTo, leads_to};
use crate::fairness::Classifier;
use crate::model::{Action, Model, ModelState};
use crate::parallel::map_chunks;
use crate::properties::{Claim, LivenessRule, PropertyId, Rule, View, for_each_property};
use crate::report::{CutOff, KIT, PropertyReport, STATERIGHT, ScenarioReport};
use crate::scenario::{LyingPart, Scenario, Size};
use crate::sequence::ChartStep;

/// Checks the model of a scenario. `watch` receives the progress now and then.
#[must_use]
pub fn check(
    model: &Model,
    options: &Options,
    watch: &mut dyn FnMut(CheckProgress),
) -> ScenarioReport {
    let limits = options.limits();
    let scenario = model.scenario();
    let progress = CheckProgress {
        expected: scenario.expected.map(|size| size.unique_states),
        ..CheckProgress::default()
    };
    let second = options.second_opinion.then(|| {
        SecondOpinion::of(model, options, &limits, &mut |checked| {
            watch(CheckProgress {
                checked,
                ..progress
            });
        })
    });
    let mut tell = |reached: CheckProgress| {
        let second = second.as_ref();
        watch(CheckProgress {
            checked: second.map_or(reached.checked, |second| second.unique_states),
            expected: progress.expected,
            ..reached
        });
    };
    let keep = keep(scenario, options);
    let (graph, ()) = explore(model, keep, options, &limits, &mut tell);
    let size = Size {
        unique_states: graph.states(),
        depth: graph.depth(),
    };
    let differ = second.as_ref().and_then(|s| s.difference(model, &graph));
    let cut_off = differ
        .or(graph.cut_off())
        .or(second.as_ref().and_then(|second| second.cut_off));
    let findings = Findings {
        model,
        second: second.as_ref(),
        graph: &graph,
        cut_off,
        options,
    };
    ScenarioReport {
        transitions: graph.transitions(),
        engines: match second {
            Some(_) => vec![KIT, STATERIGHT],
            None => vec![KIT],
        },
        properties: findings.all(),
        assumptions: assumed(scenario, options, size.unique_states),
        seconds: limits.elapsed().as_secs_f64(),
        ..ScenarioReport::of_scenario(scenario, size, cut_off)
    }
}

/// Part of the state graph that the scenario's properties are judged on.
fn keep(scenario: &Scenario, options: &Options) -> Keep {
    let claims = scenario.properties.iter().filter_map(|id| id.untimed());
    let keep = claims.map(|claim| match claim.rule {
        Rule::Live(_) => Keep::Classes,
        Rule::Reset => Keep::Transitions,
        _ => Keep::States,
    });
    let wanted = keep.filter(|_| !options.safety_only).max();
    wanted.unwrap_or(Keep::States)
}

/// Result of stateright's exploration.
struct SecondOpinion {
    unique_states: usize,
    cut_off: Option<CutOff>,
    /// In the order of the scenario's properties.
    counterexamples: Vec<Option<Vec<ChartStep>>>,
}

impl SecondOpinion {
    /// Explores the model with stateright. `watch` receives the number of states found now and then.
    fn of(
        model: &Model,
        options: &Options,
        limits: &ExplorationLimits,
        watch: &mut dyn FnMut(usize),
    ) -> Self {
        let drain = Stop::default();
        let drained = model.clone().stopping_at(&drain);
        let mut builder = drained.checker().threads(options.threads.get());
        if let Some(states) = options.states_max {
            builder = builder.target_state_count(states);
        }
        if !options.until_broken.is_empty() {
            let names = options.until_broken.iter().map(|id| id.name()).collect();
            builder = builder.finish_when(HasDiscoveries::AllOf(names));
        }
        let (checker, _) = by_stateright(builder, &drain, |states, _| {
            watch(states);
            limits.time_reached()
        });
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
                Some(charted(model, path.into_vec()))
            })
            .collect();
        Self {
            unique_states: checker.unique_state_count(),
            cut_off,
            counterexamples,
        }
    }

    /// Difference from the kit's own exploration. A counterexample that only one of the two has found counts only where
    /// the other one has visited every state.
    ///
    /// Premises are not compared: what a liar can say to a robot is worked out once for both explorations, and that
    /// a premise is met is noted then.
    fn difference(&self, model: &Model, graph: &Graph<'_, Model>) -> Option<CutOff> {
        let (self_is_whole, graph_is_whole) = (self.cut_off.is_none(), graph.cut_off().is_none());
        let properties = model.scenario().properties.iter();
        for (&id, counterexample) in properties.zip(&self.counterexamples) {
            match (counterexample.is_some(), graph.broken(id).is_some()) {
                (true, false) if graph_is_whole => return Some(CutOff::VerdictsDiffer),
                (false, true) if self_is_whole => return Some(CutOff::VerdictsDiffer),
                _ => {}
            }
        }
        if !self_is_whole || !graph_is_whole {
            return None;
        }
        (self.unique_states != graph.states()).then_some(CutOff::CountsDiffer)
    }
}

struct Findings<'a> {
    model: &'a Model,
    second: Option<&'a SecondOpinion>,
    graph: &'a Graph<'a, Model>,
    cut_off: Option<CutOff>,
    options: &'a Options,
}

impl Findings<'_> {
    fn all(&self) -> Vec<PropertyReport> {
        let safety_only = self.options.safety_only;
        let properties = self.model.scenario().properties.iter().enumerate();
        let properties = properties.filter(|(_, id)| !safety_only || id.is_of_states_or_steps());
        let claimed = properties.filter_map(|(i, &id)| Some((i, id, id.untimed()?)));
        let claimed: Vec<_> = claimed.collect();
        let found = map_chunks(self.options.threads, &claimed, 1, |claimed| {
            let judge = |&(i, id, claim): &(usize, PropertyId, &Claim)| {
                // The search for a fair run that breaks the property notes its premise.
                let (run, repeats_after) = self.counterexample(i, id, claim);
                let is_met = self.model.premise_met(id);
                PropertyReport::judged((id, claim), is_met, run, repeats_after, self.cut_off)
            };
            claimed.iter().flat_map(judge).collect::<Vec<_>>()
        });
        found.into_iter().flatten().collect()
    }

    /// A run that breaks a property, and how many steps of it come before its cycle, if it has one.
    fn counterexample(
        &self,
        i: usize,
        id: PropertyId,
        claim: &Claim,
    ) -> (Option<Vec<ChartStep>>, Option<usize>) {
        match claim.rule {
            Rule::Reset => (self.graph.stuck().map(|stuck| self.run_into(stuck)), None),
            Rule::Live(rule) => self.lasso(id, rule).unzip(),
            _ => (self.broken(i, id), None),
        }
    }

    /// A shortest run that breaks a property of states or steps; stateright's where it alone found one.
    fn broken(&self, i: usize, id: PropertyId) -> Option<Vec<ChartStep>> {
        let Some(broken) = self.graph.broken(id) else {
            return self.second?.counterexamples[i].clone();
        };
        Some(self.run_into(broken))
    }

    fn run_into(&self, state: u32) -> Vec<ChartStep> {
        charted(self.model, self.graph.run_into(state))
    }

    /// A fair run that breaks a liveness property, and how many steps of it come before its cycle.
    /// Notes the property's premise where it is met.
    fn lasso(&self, id: PropertyId, rule: LivenessRule) -> Option<(Vec<ChartStep>, usize)> {
        if self.cut_off.is_some() {
            return None;
        }
        let fairness = Classifier(self.model).fairness();
        for subject in rule.subjects.among(self.model.scenario().robots.len()) {
            let from = |number| {
                let state = self.graph.state(number);
                self.model.look(&state, |view| (rule.from)(view, subject))
            };
            let to = |number| {
                let state = self.graph.state(number);
                let is_reached = |view: &View| rule.is_reached(view, subject);
                // States behind a broken step property were not explored.
                self.model.look(&state, is_reached) || state.is_broken()
            };
            match leads_to(self.graph, fairness, from, to) {
                LeadsTo::Vacuous => {}
                LeadsTo::Holds => self.model.note_premises(id.bit()),
                LeadsTo::Broken(lasso) => {
                    self.model.note_premises(id.bit());
                    let run = self.graph.lasso(&lasso);
                    return Some((chart(self.model, run), lasso.stem.len() - 1));
                }
            }
        }
        None
    }
}

/// The probability that any two of this number of states share a fingerprint of so many bits, where fingerprints are
/// as good as random; an upper bound (the union bound over all pairs).
#[expect(clippy::cast_precision_loss, reason = "an estimate")]
#[must_use]
pub fn collision_probability(states: u64, bits: u32) -> f64 {
    let states = states as f64;
    (states * (states - 1.0).max(0.0) / 2.0) / f64::from(bits).exp2()
}

/// How the explorations that were asked for compare this number of states.
fn compared(options: &Options, states: usize) -> String {
    if options.second_opinion {
        format!(
            "two explorations that agree: the kit's own, which compares whole states, and stateright's, which compares \
             64-bit fingerprints of states: any two of these states share one with a probability of {:.0e}",
            collision_probability(states as u64, u64::BITS)
        )
    } else {
        "one exploration, by the kit itself, which compares whole states".to_owned()
    }
}

fn assumed(scenario: &Scenario, options: &Options, states: usize) -> Vec<String> {
    let mut assumed = assumptions(scenario, compared(options, states));
    if options.safety_only && keep(scenario, &Options::default()) != Keep::States {
        assumed.push("runs were not judged: only states and steps were asked for".to_owned());
    }
    assumed
}

/// A run through states that stand for their classes, as the steps of a chart of real robots.
#[must_use]
pub fn charted(model: &Model, path: Vec<(ModelState, Option<Action>)>) -> Vec<ChartStep> {
    chart(model, model.real_run(path))
}

/// Assumptions of the verdicts on a scenario; `compared` tells how states are compared.
#[must_use]
pub fn assumptions(scenario: &Scenario, compared: String) -> Vec<String> {
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
        format!(
            "of the receivers of one message that is not delayed, {}",
            if scenario.symmetric.is_empty() {
                "the ones listed first hear it first"
            } else {
                "any may hear it first"
            }
        ),
        "a crash stops the robot's body; station ids and boot counters survive it".to_owned(),
        "applications are truthful: a body is where they say that it is, a guard finishes, the road is \
         clear and the task is done only when no pedestrian is on the road"
            .to_owned(),
        "states that differ in the names of heartbeats, sessions and offers alone count as one"
            .to_owned(),
        compared,
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

/// Whether a state keeps the property of this number. stateright wants a plain function for each.
fn holds<const N: usize>(model: &Model, state: &ModelState) -> bool {
    model.keeps(state, PropertyId::ALL[N])
}

const HOLDS: [fn(&Model, &ModelState) -> bool; PropertyId::ALL.len()] = for_each_property!(holds);

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
        let ids = self.scenario().properties.iter().copied();
        let ids = ids.filter(|id| id.is_of_states_or_steps());
        ids.map(|id| Property {
            expectation: Expectation::Always,
            name: id.name(),
            condition: HOLDS[id as usize],
        })
        .collect()
    }
}
