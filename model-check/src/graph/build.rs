//! How a graph is built. Several threads judge and expand states, a batch at a time; then one thread numbers what is
//! new, in the order in which a single thread would have found it. So levels, counts and shortest runs depend on no
//! number of threads.

use super::edges::{Edges, Full, NewEdge};
use super::{Graph, Keep, Reached};
use crate::exploration::{BATCH, CHUNK, ExplorationLimits, Options};
use crate::fair::Classes;
use crate::fairness::Classifier;
use crate::model::{Action, Delivery, Model, ModelState};
use crate::parallel::map_chunks;
use crate::properties::PropertyId;
use crate::report::CutOff;
use crate::store::States;

/// A graph that is being built.
struct Building<'a> {
    model: &'a Model,
    options: &'a Options,
    limits: &'a ExplorationLimits,
    /// Finds the classes of transitions, where those are kept.
    classifier: Option<Classifier<'a>>,
    graph: Graph,
    /// The number of the next state to be expanded.
    at: usize,
    /// The first number behind the level that is being expanded.
    level_ends: usize,
}

/// What some states are found to be, and where their transitions lead.
struct Expansion {
    states: Vec<ExpandedState>,
    /// Of all these states, one after the other.
    successors: Vec<Successor>,
}

struct ExpandedState {
    /// One bit per property that it breaks.
    broken: u32,
    /// The classes that are enabled in it, where classes are kept.
    enabled: Classes,
    /// How many successors it has.
    successors: usize,
}

struct Successor {
    next: Next,
    /// Whether it is reached by an arrival on a monotone channel.
    by_chance: bool,
    /// The classes of the transition, where classes are kept.
    taken: Classes,
}

enum Next {
    /// A state that had a number before the batch was expanded.
    Known(u32),
    /// A state that had none. An earlier one of the batch may be the same.
    Fresh(ModelState),
}

impl Graph {
    /// Explores `model` from its initial state, breadth first, with the threads of `options`, and until
    /// what it says is found to be broken. `watch` receives the progress.
    pub(crate) fn build(
        model: &Model,
        keep: Keep,
        options: &Options,
        limits: &ExplorationLimits,
        watch: &mut dyn FnMut(Reached),
    ) -> Self {
        let is_monotone = model.scenario().channel.monotone;
        let mut states = States::default();
        states.add(&model.initial());
        let has_classes = keep == Keep::Classes;
        let mut building = Building {
            model,
            options,
            limits,
            classifier: has_classes.then_some(Classifier(model)),
            graph: Self {
                states,
                edges: (keep != Keep::States).then(|| Edges::new(is_monotone, has_classes)),
                transitions: 0,
                levels: vec![0],
                resettable: Vec::new(),
                broken: [None; PropertyId::ALL.len()],
                cut_off: None,
            },
            at: 0,
            level_ends: 1,
        };
        building.graph.cut_off = building.explore(watch);
        let mut graph = building.graph;
        graph.states.freeze();
        if let (None, Some(edges)) = (graph.cut_off, &mut graph.edges) {
            edges.shrink();
            graph.resettable = graph.can_be_reset(model);
        }
        graph
    }
}

impl Building<'_> {
    /// Explores to the end; says why it stopped before, where it did.
    fn explore(&mut self, watch: &mut dyn FnMut(Reached)) -> Option<CutOff> {
        let wanted = &self.options.until_broken;
        while self.at < self.graph.states() {
            watch(self.graph.reached(self.at));
            if let Some(cut_off) = self.limits.time_reached() {
                return Some(cut_off);
            }
            for expansion in self.expand_batch() {
                if let Some(cut_off) = self.add_all(expansion) {
                    return Some(cut_off);
                }
            }
            let found_all = wanted.iter().all(|&id| self.graph.broken(id).is_some());
            if !wanted.is_empty() && found_all {
                return Some(CutOff::FoundBroken);
            }
        }
        None
    }

    /// Judges and expands the next states.
    fn expand_batch(&self) -> Vec<Expansion> {
        let end = self.graph.states().min(self.at + BATCH);
        let batch: Vec<u32> = (short(self.at)..short(end)).collect();
        map_chunks(self.options.threads, &batch, CHUNK, |states| {
            self.expand(states)
        })
    }

    fn expand(&self, states: &[u32]) -> Expansion {
        let mut expansion = Expansion {
            states: Vec::with_capacity(states.len()),
            successors: Vec::new(),
        };
        let mut actions = Vec::new();
        for &number in states {
            let state = self.graph.state(number);
            let broken = self.model.broken_in(&state);
            let mut enabled = self.enabled_off_air(&state);
            actions.clear();
            self.model.actions_in(&state, &mut actions);
            let from = expansion.successors.len();
            for &action in &actions {
                let next = self.model.successor_up_to_symmetry(&state, action);
                let Some((next, step)) = next else {
                    continue;
                };
                let classifier = self.classifier;
                let classes = classifier.map(|it| (it.enabled_by(action), it.taken(action, step)));
                let (enabled_by, taken) = classes.unwrap_or_default();
                enabled |= enabled_by;
                expansion.successors.push(Successor {
                    next: match self.graph.states.find(&next) {
                        Some(number) => Next::Known(number),
                        None => Next::Fresh(next),
                    },
                    by_chance: is_by_chance(action),
                    taken,
                });
            }
            expansion.states.push(ExpandedState {
                broken,
                enabled,
                successors: expansion.successors.len() - from,
            });
        }
        expansion
    }

    /// The classes that are enabled while the fate of messages on air is decided first.
    fn enabled_off_air(&self, state: &ModelState) -> Classes {
        let classifier = self.classifier.filter(|_| self.model.is_on_air(state));
        classifier.map_or(Classes::NONE, |it| it.enabled_off_air(state))
    }

    /// Adds what an expansion found; says why not all of it is added, where it is not.
    fn add_all(&mut self, expansion: Expansion) -> Option<CutOff> {
        let mut successors = expansion.successors.into_iter();
        let mut transitions = Vec::new();
        for state in expansion.states {
            if self.at == self.level_ends {
                self.graph.levels.push(short(self.at));
                self.level_ends = self.graph.states();
            }
            self.graph.note_broken(short(self.at), state.broken);
            transitions.clear();
            for successor in successors.by_ref().take(state.successors) {
                let to = match successor.next {
                    Next::Known(number) => number,
                    Next::Fresh(next) => match self.number(&next) {
                        Some(number) => number,
                        None => return Some(CutOff::StateLimit),
                    },
                };
                let (by_chance, taken) = (successor.by_chance, successor.taken);
                let edge = NewEdge {
                    to,
                    by_chance,
                    taken,
                };
                self.graph.transitions += usize::from(add_edge(&mut transitions, edge));
            }
            if let Some(edges) = &mut self.graph.edges
                && let Err(Full) = edges.add(&transitions, state.enabled)
            {
                return Some(CutOff::StateLimit);
            }
            self.at += 1;
        }
        None
    }

    /// The number of a state that may be new; none where there are as many as there may be.
    fn number(&mut self, state: &ModelState) -> Option<u32> {
        let states = &mut self.graph.states;
        let is_full = self.limits.states_reached(states.len()) || states.len() == States::MAX;
        if is_full {
            return states.find(state);
        }
        Some(states.add(state))
    }
}

/// Adds a transition to those of one state, unless there is one like it. Returns whether it is the first to its target.
fn add_edge(edges: &mut Vec<NewEdge>, edge: NewEdge) -> bool {
    let mut is_first = true;
    for known in edges.iter_mut().filter(|known| known.to == edge.to) {
        is_first = false;
        if known.taken == edge.taken {
            known.by_chance &= edge.by_chance;
            return false;
        }
    }
    edges.push(edge);
    is_first
}

/// Whether an action is an arrival that may never happen.
const fn is_by_chance(action: Action) -> bool {
    matches!(
        action,
        Action::Deliver {
            how: Delivery::AnyTime,
            ..
        }
    )
}

/// The number of a state.
///
/// # Panics
/// Above [`States::MAX`].
fn short(number: usize) -> u32 {
    u32::try_from(number).expect("no more states than can be numbered")
}
