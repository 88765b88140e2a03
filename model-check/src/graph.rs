//! The whole state graph, for facts about runs that stateright's exploration does not establish.

use std::hash::BuildHasher;

use hashbrown::HashTable;
use rustc_hash::FxBuildHasher;

use crate::exploration::ExplorationLimits;
use crate::model::{Action, Delivery, Model, ModelState};
use crate::node::Node;
use crate::report::CutOff;

/// How far an exploration is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reached {
    pub(crate) states: usize,
    /// How many of them are still to be expanded.
    pub(crate) frontier: usize,
    pub(crate) depth: usize,
}

/// Every reachable state and every transition between them.
pub(crate) struct Graph {
    states: Vec<ModelState>,
    /// For each state the first one through which it was reached; the initial state names itself.
    parents: Vec<u32>,
    /// Successors of all states, one after the other.
    targets: Vec<u32>,
    /// Whether each of these is reached by nothing but arrivals on a monotone channel, which may never
    /// happen.
    by_chance: Vec<bool>,
    /// Where the successors of each state begin, and after the last where they end.
    starts: Vec<u32>,
    /// Whether each state can reach one in which all robots are idle.
    resettable: Vec<bool>,
    depth: usize,
    cut_off: Option<CutOff>,
}

/// A graph that is being built.
struct Building {
    graph: Graph,
    /// Numbers of states, by what the states are; each state is stored once.
    numbers: HashTable<u32>,
}

impl Building {
    /// That of the initial state.
    fn of(model: &Model) -> Self {
        let mut building = Self {
            graph: Graph {
                states: Vec::new(),
                parents: Vec::new(),
                targets: Vec::new(),
                by_chance: Vec::new(),
                starts: vec![0],
                resettable: Vec::new(),
                depth: 0,
                cut_off: None,
            },
            numbers: HashTable::new(),
        };
        building.add(model.initial(), 0);
        building
    }

    /// Adds the transitions out of a state, and the states that they lead to; says why not all of them
    /// are added, where they are not.
    fn expand(
        &mut self,
        model: &Model,
        limits: &ExplorationLimits,
        at: usize,
        actions: &mut Vec<Action>,
    ) -> Option<CutOff> {
        let state = self.graph.states[at].clone();
        actions.clear();
        model.actions_in(&state, actions);
        let from = self.graph.targets.len();
        for &action in &*actions {
            let Some((next, _)) = model.successor_up_to_symmetry(&state, action) else {
                continue;
            };
            let number = match self.known(&next) {
                Some(number) => number,
                None if limits.states_reached(self.graph.states.len()) => {
                    return Some(CutOff::StateLimit);
                }
                None => self.add(next, short(at)),
            };
            let by_chance = matches!(
                action,
                Action::Deliver {
                    how: Delivery::AnyTime,
                    ..
                }
            );
            let known = self.graph.targets[from..].iter().position(|&t| t == number);
            if let Some(known) = known {
                self.graph.by_chance[from + known] &= by_chance;
            } else {
                self.graph.targets.push(number);
                self.graph.by_chance.push(by_chance);
            }
        }
        self.graph.starts.push(short(self.graph.targets.len()));
        None
    }

    /// The graph, without room for more.
    fn finished(self) -> Graph {
        let mut graph = self.graph;
        graph.states.shrink_to_fit();
        graph.parents.shrink_to_fit();
        graph.targets.shrink_to_fit();
        graph.by_chance.shrink_to_fit();
        graph.starts.shrink_to_fit();
        graph
    }

    fn known(&self, state: &ModelState) -> Option<u32> {
        let is_it = |number: &u32| self.graph.states[*number as usize] == *state;
        self.numbers.find(hash(state), is_it).copied()
    }

    fn add(&mut self, state: ModelState, parent: u32) -> u32 {
        let states = &mut self.graph.states;
        let fresh = short(states.len());
        let hashed = hash(&state);
        states.push(state);
        let rehash = |&number: &u32| hash(&states[number as usize]);
        self.numbers.insert_unique(hashed, fresh, rehash);
        self.graph.parents.push(parent);
        fresh
    }
}

fn hash(state: &ModelState) -> u64 {
    FxBuildHasher.hash_one(state)
}

/// A number of a state or transition.
///
/// # Panics
/// When there are 2^32 or more, far beyond what fits in memory.
fn short(number: usize) -> u32 {
    u32::try_from(number).expect("fewer than 2^32 states and transitions")
}

impl Graph {
    /// Explores `model` from its initial state, breadth first. `watch` receives the progress, and says
    /// whether to stop.
    pub(crate) fn build(
        model: &Model,
        limits: &ExplorationLimits,
        watch: &mut dyn FnMut(Reached) -> bool,
    ) -> Self {
        let mut building = Building::of(model);
        let mut level_ends = 1;
        let mut actions = Vec::new();
        let mut at = 0;
        while at < building.graph.states.len() {
            let graph = &mut building.graph;
            if at == level_ends {
                (graph.depth, level_ends) = (graph.depth + 1, graph.states.len());
            }
            let mut cut_off = None;
            if at % 16_384 == 0 {
                let has_to_stop = watch(graph.reached(at)).then_some(CutOff::FoundBroken);
                cut_off = has_to_stop.or(limits.time_reached());
            }
            cut_off = cut_off.or_else(|| building.expand(model, limits, at, &mut actions));
            if cut_off.is_some() {
                building.graph.cut_off = cut_off;
                return building.graph;
            }
            at += 1;
        }
        let mut graph = building.finished();
        // What comes after a broken step property was not explored.
        let is_reset =
            |state: &ModelState| model.nodes(state).all(Node::is_idle) || state.is_broken();
        graph.resettable = graph.can_reach(is_reset);
        graph
    }

    fn reached(&self, expanded: usize) -> Reached {
        Reached {
            states: self.states.len(),
            frontier: self.states.len() - expanded,
            depth: self.depth,
        }
    }

    pub(crate) fn states(&self) -> usize {
        self.states.len()
    }

    /// Steps from the initial state to the farthest state.
    pub(crate) const fn depth(&self) -> usize {
        self.depth
    }

    pub(crate) fn transitions(&self) -> usize {
        self.targets.len()
    }

    pub(crate) const fn cut_off(&self) -> Option<CutOff> {
        self.cut_off
    }

    pub(crate) fn state(&self, number: u32) -> &ModelState {
        &self.states[number as usize]
    }

    /// The successors of a state.
    fn targets(&self, state: usize) -> &[u32] {
        let (start, end) = (self.starts[state], self.starts[state + 1]);
        &self.targets[start as usize..end as usize]
    }

    /// The number of `next`, which is a successor of state `number`.
    pub(crate) fn successor_number(&self, number: u32, next: &ModelState) -> u32 {
        let mut targets = self.targets(number as usize).iter();
        *targets
            .find(|&&target| self.state(target) == next)
            .expect("it is a successor")
    }

    /// A shortest run from the initial state, both ends included.
    pub(crate) fn run_to(&self, number: u32) -> Vec<u32> {
        let mut run = vec![number];
        while run[run.len() - 1] != 0 {
            run.push(self.parents[run[run.len() - 1] as usize]);
        }
        run.reverse();
        run
    }

    /// For each state, whether it can reach one that satisfies `goal`, on a monotone channel without the
    /// help of any message.
    fn can_reach(&self, goal: impl Fn(&ModelState) -> bool) -> Vec<bool> {
        let states = self.states.len();
        // The predecessors of each state, one after the other. Each place is filled from its end, which
        // leaves its beginning in `starts`.
        let mut starts = vec![0_u32; states + 1];
        let relied_on = |&(_, by_chance): &(&u32, &bool)| !by_chance;
        let transitions = self.targets.iter().zip(&self.by_chance);
        for (&target, _) in transitions.filter(relied_on) {
            starts[target as usize] += 1;
        }
        let mut end = 0;
        for start in &mut starts {
            end += *start;
            *start = end;
        }
        let mut sources = vec![0_u32; self.targets.len()];
        for from in 0..states {
            let (first, end) = (self.starts[from] as usize, self.starts[from + 1] as usize);
            let transitions = self.targets[first..end].iter();
            let transitions = transitions.zip(&self.by_chance[first..end]);
            for (&target, _) in transitions.filter(relied_on) {
                let start = &mut starts[target as usize];
                *start -= 1;
                sources[*start as usize] = short(from);
            }
        }
        let mut reached: Vec<bool> = self.states.iter().map(&goal).collect();
        let mut todo: Vec<usize> = (0..states).filter(|&i| reached[i]).collect();
        while let Some(state) = todo.pop() {
            for &source in &sources[starts[state] as usize..starts[state + 1] as usize] {
                if !reached[source as usize] {
                    reached[source as usize] = true;
                    todo.push(source as usize);
                }
            }
        }
        reached
    }

    /// A state from which the robots cannot all get idle any more, as near as possible.
    pub(crate) fn stuck(&self) -> Option<u32> {
        let stuck = self.resettable.iter().position(|&resettable| !resettable)?;
        Some(short(stuck))
    }
}
