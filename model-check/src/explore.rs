//! The one explorer, breadth first, of every model that the kit explores by itself.
//!
//! Several threads expand states, a batch at a time; then one thread numbers what is new, in the order in which a single
//! thread would have found it. So levels, counts and shortest runs depend on no number of threads.

mod edges;
mod graph;

use self::edges::{Edges, Full};
use crate::exploration::{CheckProgress, ExplorationLimits, Options};
use crate::fair::Classes;
use crate::parallel::map_chunks;
use crate::properties::PropertyId;
use crate::report::CutOff;
use crate::store::Store;

/// How many states are expanded before what they lead to is numbered.
const BATCH: usize = 16_384;

/// How many of them a thread takes at a time.
const CHUNK: usize = 256;

/// A system of states, and of actions that may happen in each.
pub(crate) trait TransitionSystem: Sync {
    type State: PartialEq + Send;
    type Action: Copy;
    /// Where the states are kept.
    type States: Store<Self::State>;
    /// Notes on the states that are expanded, besides the properties that they break.
    type Notes: Clone + Send + Sync;

    /// Whether two actions that lead from one state to another one are counted as two transitions.
    const COUNTS_ACTIONS: bool;

    /// The state in which every run begins.
    fn initial(&self) -> Self::State;

    /// Everything that may happen in a state.
    fn actions_in(&self, state: &Self::State, actions: &mut Vec<Self::Action>);

    /// The state after an action; `None` if the action changes nothing.
    fn state_after(&self, state: &Self::State, action: Self::Action) -> Option<Self::State>;

    /// Takes each of the actions that may happen in a state, calls `lead_to` where one leads to, and judges the state.
    fn expand(
        &self,
        state: &Self::State,
        actions: &[Self::Action],
        keep: Keep,
        notes: &mut Self::Notes,
        lead_to: impl FnMut(Self::State, Label),
    ) -> Judged;

    /// The notes on no state.
    fn no_notes(&self) -> Self::Notes;

    /// Adds what another thread noted.
    fn add_notes(all: &mut Self::Notes, more: Self::Notes);

    /// Whether marks of transitions are kept.
    fn has_marks(&self) -> bool;

    /// The first action that leads from one state to another.
    fn action_between(&self, from: &Self::State, to: &Self::State) -> Option<Self::Action> {
        let mut actions = Vec::new();
        self.actions_in(from, &mut actions);
        let leads_there = |action: &Self::Action| {
            let next = self.state_after(from, *action);
            next.is_some_and(|next| next == *to)
        };
        actions.into_iter().find(leads_there)
    }
}

/// The label of a transition, besides its ends.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(crate) struct Label {
    /// The model's mark: an arrival by chance on a monotone channel, or a step that takes no time.
    pub(crate) is_marked: bool,
    /// The classes of the transition, where classes are kept.
    pub(crate) taken: Classes,
}

/// Broken properties and enabled classes of a state.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Judged {
    /// One bit per property that it breaks.
    pub(crate) broken: u64,
    /// The classes that are enabled in it, where classes are kept.
    pub(crate) enabled: Classes,
}

/// The part of the state graph that an exploration keeps.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) enum Keep {
    /// States alone, which is enough to judge states and steps.
    States,
    /// The transitions between them too, which say what can be reached.
    Transitions,
    /// And the classes of the transitions, which say what fair runs do.
    Classes,
}

/// Every reachable state, and every transition between them where those are kept.
pub(crate) struct Graph<'a, S: TransitionSystem> {
    pub(crate) system: &'a S,
    states: S::States,
    edges: Option<Edges>,
    transitions: usize,
    /// The number of the first state of each level, breadth first.
    levels: Vec<u32>,
    /// For each property, in the order of [`PropertyId::ALL`], the first state that breaks it.
    broken: [Option<u32>; PropertyId::ALL.len()],
    cut_off: Option<CutOff>,
}

/// A run: each state with the action that leads to the next one.
pub(crate) type RunOf<S> = Vec<(
    <S as TransitionSystem>::State,
    Option<<S as TransitionSystem>::Action>,
)>;

/// Explores a system from its initial state, with the threads of `options`, and until what it says is found to be
/// broken. `watch` receives the progress.
pub(crate) fn explore<'a, S: TransitionSystem>(
    system: &'a S,
    keep: Keep,
    options: &Options,
    limits: &ExplorationLimits,
    watch: &mut dyn FnMut(CheckProgress),
) -> (Graph<'a, S>, S::Notes) {
    let mut states = S::States::default();
    states.add(system.initial());
    let has_classes = keep == Keep::Classes;
    let mut exploration = Exploration {
        keep,
        options,
        limits,
        graph: Graph {
            system,
            states,
            edges: (keep != Keep::States).then(|| Edges::new(system.has_marks(), has_classes)),
            transitions: 0,
            levels: vec![0],
            broken: [None; PropertyId::ALL.len()],
            cut_off: None,
        },
        notes: system.no_notes(),
        row: Vec::new(),
    };
    let stopped = exploration.go_through_levels(watch);
    let Exploration {
        mut graph, notes, ..
    } = exploration;
    graph.cut_off = stopped.err();
    graph.states.freeze();
    if let (None, Some(edges)) = (graph.cut_off, &mut graph.edges) {
        edges.shrink();
    }
    (graph, notes)
}

/// An exploration under way.
struct Exploration<'a, 's, S: TransitionSystem> {
    keep: Keep,
    options: &'a Options,
    limits: &'a ExplorationLimits,
    graph: Graph<'s, S>,
    notes: S::Notes,
    /// The transitions of the state that is being added.
    row: Vec<(u32, Label)>,
}

impl<S: TransitionSystem> Exploration<'_, '_, S> {
    fn go_through_levels(&mut self, watch: &mut dyn FnMut(CheckProgress)) -> Result<(), CutOff> {
        // The next state to be expanded, and the first one behind its level.
        let (mut at, mut level_ends) = (0, 1);
        while at < self.graph.states() {
            let states = self.graph.states();
            watch(CheckProgress {
                checked: states,
                explored: states,
                frontier: states - at,
                depth: self.graph.depth(),
                expected: None,
            });
            self.limits.time_reached().map_or(Ok(()), Err)?;
            let batch: Vec<u32> = (short(at)..short(states)).take(BATCH).collect();
            let expand = |states: &[u32]| self.expand(states);
            for expansion in map_chunks(self.options.threads, &batch, CHUNK, expand) {
                S::add_notes(&mut self.notes, expansion.notes);
                let mut transitions = expansion.transitions.into_iter();
                for (judged, count) in expansion.states {
                    if at == level_ends {
                        self.graph.levels.push(short(at));
                        level_ends = self.graph.states();
                    }
                    self.add(short(at), judged, transitions.by_ref().take(count))?;
                    at += 1;
                }
            }
            if self.has_broken_enough() {
                return Err(CutOff::FoundBroken);
            }
        }
        Ok(())
    }

    fn expand(&self, states: &[u32]) -> Expansion<S> {
        let mut expansion = Expansion {
            notes: self.notes.clone(),
            states: Vec::with_capacity(states.len()),
            transitions: Vec::new(),
        };
        let system = self.graph.system;
        let mut actions = Vec::new();
        for &number in states {
            let state = self.graph.state(number);
            actions.clear();
            system.actions_in(&state, &mut actions);
            let from = expansion.transitions.len();
            let lead_to = |next, label| {
                let next = match self.graph.states.find(&next) {
                    Some(number) => Next::Known(number),
                    None => Next::Fresh(next),
                };
                expansion.transitions.push((next, label));
            };
            let notes = &mut expansion.notes;
            let judged = system.expand(&state, &actions, self.keep, notes, lead_to);
            let count = expansion.transitions.len() - from;
            expansion.states.push((judged, count));
        }
        expansion
    }

    /// Adds what the state `from` is and leads to; says why not all of it is added, where it is not.
    fn add(
        &mut self,
        from: u32,
        judged: Judged,
        transitions: impl Iterator<Item = (Next<S::State>, Label)>,
    ) -> Result<(), CutOff> {
        self.note_broken(from, judged.broken);
        self.row.clear();
        for (next, label) in transitions {
            let states = self.graph.states();
            let is_full = self.limits.states_reached(states) || states == u32::MAX as usize;
            let to = match next {
                Next::Known(number) => number,
                Next::Fresh(next) if is_full => {
                    self.graph.states.find(&next).ok_or(CutOff::StateLimit)?
                }
                Next::Fresh(next) => self.graph.states.add(next),
            };
            let is_first = add_transition(&mut self.row, to, label);
            self.graph.transitions += usize::from(S::COUNTS_ACTIONS || is_first);
        }
        let edges = self.graph.edges.as_mut();
        let added = edges.map_or(Ok(()), |edges| edges.add(&self.row, judged.enabled));
        added.map_err(|Full| CutOff::StateLimit)
    }

    /// Notes what the state of this number breaks, one bit per property. States come in their order.
    fn note_broken(&mut self, number: u32, broken: u64) {
        if broken == 0 {
            return;
        }
        for property in PropertyId::ALL {
            if broken & property.bit() != 0 {
                self.graph.broken[property as usize].get_or_insert(number);
            }
        }
    }

    fn has_broken_enough(&self) -> bool {
        let wanted = &self.options.until_broken;
        let is_broken = |id: &PropertyId| self.graph.broken(*id).is_some();
        !wanted.is_empty() && wanted.iter().all(is_broken)
    }
}

/// Adds a transition to those of one state, unless there is one like it. Returns whether it is the first to its target.
fn add_transition(row: &mut Vec<(u32, Label)>, to: u32, label: Label) -> bool {
    let mut is_first = true;
    for (_, known) in row.iter().filter(|(known, _)| *known == to) {
        is_first = false;
        if *known == label {
            return false;
        }
    }
    row.push((to, label));
    is_first
}

/// Findings on some states, with their transitions.
struct Expansion<S: TransitionSystem> {
    notes: S::Notes,
    /// Each with how many transitions it has.
    states: Vec<(Judged, usize)>,
    /// Of all these states, one after the other.
    transitions: Vec<(Next<S::State>, Label)>,
}

enum Next<T> {
    /// A state that had a number before the batch was expanded.
    Known(u32),
    /// A state that had none. An earlier one of the batch may be the same.
    Fresh(T),
}

/// The number of a state.
///
/// # Panics
/// Where there are more states than can be numbered.
fn short(number: usize) -> u32 {
    u32::try_from(number).expect("no more states than can be numbered")
}
