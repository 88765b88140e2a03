//! The whole state graph, for facts about runs that stateright's exploration does not establish.

use std::hash::BuildHasher;
use std::time::Instant;

use hashbrown::HashTable;
use rustc_hash::FxBuildHasher;

use crate::check::Options;
use crate::model::{Model, State};
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
    states: Vec<State>,
    /// For each state the first one through which it was reached; the initial state names itself.
    parents: Vec<u32>,
    /// Successors of all states, one after the other.
    targets: Vec<u32>,
    /// Where the successors of each state begin, and after the last where they end.
    starts: Vec<usize>,
    /// Whether each state can reach one in which all robots are idle.
    resettable: Vec<bool>,
    depth: usize,
    cut_off: Option<CutOff>,
}

impl Graph {
    /// Explores `model` from its initial state, breadth first. `watch` is told how far it is, and says
    /// whether to stop. Of the options, the limits on states and time count.
    pub(crate) fn build(
        model: &Model,
        options: &Options,
        watch: &mut dyn FnMut(Reached) -> bool,
    ) -> Self {
        let start = Instant::now();
        let initial = model.initial();
        let hash = |state: &State| FxBuildHasher.hash_one(state);
        // Numbers of states, by what the states are; each state is stored once.
        let mut numbers: HashTable<u32> = HashTable::new();
        numbers.insert_unique(hash(&initial), 0, |_| 0);
        let mut graph = Self {
            states: vec![initial],
            parents: vec![0],
            targets: Vec::new(),
            starts: vec![0],
            resettable: Vec::new(),
            depth: 0,
            cut_off: None,
        };
        let mut level_ends = 1;
        let mut actions = Vec::new();
        let mut at = 0;
        while at < graph.states.len() {
            if at == level_ends {
                (graph.depth, level_ends) = (graph.depth + 1, graph.states.len());
            }
            graph.cut_off = options.states_reached(graph.states.len());
            if at % 16_384 == 0 {
                let has_to_stop = watch(graph.reached(at)).then_some(CutOff::FoundBroken);
                let out_of_time = options.time_reached(start.elapsed());
                graph.cut_off = graph.cut_off.or(has_to_stop).or(out_of_time);
            }
            if graph.cut_off.is_some() {
                return graph;
            }
            let state = graph.states[at].clone();
            actions.clear();
            model.actions_in(&state, &mut actions);
            let from = graph.targets.len();
            for &action in &actions {
                let Some((next, _)) = model.successor_up_to_symmetry(&state, action) else {
                    continue;
                };
                let hashed = hash(&next);
                let known = numbers.find(hashed, |&number| graph.states[number as usize] == next);
                let number = known.copied().unwrap_or_else(|| {
                    let fresh = u32::try_from(graph.states.len()).expect("fewer than 2^32 states");
                    numbers.insert_unique(hashed, fresh, |&number| {
                        hash(&graph.states[number as usize])
                    });
                    graph.states.push(next);
                    graph
                        .parents
                        .push(u32::try_from(at).expect("fewer than 2^32 states"));
                    fresh
                });
                if !graph.targets[from..].contains(&number) {
                    graph.targets.push(number);
                }
            }
            graph.starts.push(graph.targets.len());
            at += 1;
        }
        drop(numbers);
        graph.resettable =
            graph.can_reach(|state| model.nodes(state).all(crate::node::Node::is_idle));
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

    pub(crate) fn state(&self, number: u32) -> &State {
        &self.states[number as usize]
    }

    /// The number of `next`, which is a successor of state `number`.
    pub(crate) fn successor_number(&self, number: u32, next: &State) -> u32 {
        let number = number as usize;
        let mut targets = self.targets[self.starts[number]..self.starts[number + 1]].iter();
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

    /// For each state, whether it can reach one that satisfies `goal`.
    fn can_reach(&self, goal: impl Fn(&State) -> bool) -> Vec<bool> {
        let states = self.states.len();
        let mut starts = vec![0_usize; states + 1];
        for &target in &self.targets {
            starts[target as usize + 1] += 1;
        }
        for i in 0..states {
            starts[i + 1] += starts[i];
        }
        let mut sources = vec![0_u32; self.targets.len()];
        let mut fill = starts.clone();
        for (from, range) in self.starts.windows(2).enumerate() {
            for &target in &self.targets[range[0]..range[1]] {
                sources[fill[target as usize]] = u32::try_from(from).expect("fewer than 2^32");
                fill[target as usize] += 1;
            }
        }
        let mut reached: Vec<bool> = self.states.iter().map(&goal).collect();
        let mut todo: Vec<usize> = (0..states).filter(|&i| reached[i]).collect();
        while let Some(state) = todo.pop() {
            for &source in &sources[starts[state]..starts[state + 1]] {
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
        Some(u32::try_from(stuck).expect("fewer than 2^32 states"))
    }
}
