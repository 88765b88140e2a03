//! Leads-to under fairness, on any transition system with finitely many states.
//!
//! `from` leads to `to` when every fair run that visits a state in `from` visits one in `to` then or
//! later. It is broken exactly when there is a fair run that visits `from` and from there on avoids
//! `to` for ever. In a finite system such a run can be given as a *lasso*: a stem, and a cycle that is
//! repeated for ever. A run may also *stutter*, that is stay in a state for ever with nothing
//! happening, as far as fairness lets it.
//!
//! Fairness is about *classes* of transitions. A run is fair to a class
//!
//! - *weakly*, if the class is not enabled for ever without being taken again and again;
//! - *strongly*, if the class is not enabled again and again without being taken again and again.
//!
//! The search is the usual one for Streett conditions: among the states that avoid `to`, a strongly
//! connected component in which a weak class is always enabled and never taken holds no fair cycle;
//! one in which a strong class is enabled somewhere and never taken is split by leaving out the states
//! that enable it; any other is a fair cycle.

use std::collections::{HashMap, VecDeque};
use std::ops::{BitAnd, BitOr, BitOrAssign, Not};

use rustc_hash::FxBuildHasher;

/// A set of classes of transitions, which have the numbers 0 to 127.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub struct Classes(pub u128);

impl Classes {
    /// No class.
    pub const NONE: Self = Self(0);

    /// The one class with this number.
    ///
    /// # Panics
    /// Above 127.
    #[must_use]
    pub const fn one(number: u32) -> Self {
        assert!(number < u128::BITS, "more classes than a set can hold");
        Self(1 << number)
    }

    /// Whether the set is empty.
    #[must_use]
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// The classes of the set, one by one.
    fn each(self) -> impl Iterator<Item = Self> {
        (0..u128::BITS)
            .map(move |number| Self(self.0 & (1 << number)))
            .filter(|class| !class.is_empty())
    }
}

impl BitAnd for Classes {
    type Output = Self;

    fn bitand(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }
}

impl BitOr for Classes {
    type Output = Self;

    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl BitOrAssign for Classes {
    fn bitor_assign(&mut self, other: Self) {
        *self = *self | other;
    }
}

impl Not for Classes {
    type Output = Self;

    fn not(self) -> Self {
        Self(!self.0)
    }
}

/// Which classes runs are fair to.
#[derive(Clone, Copy, Debug, Default)]
pub struct Fairness {
    /// To these weakly.
    pub weak: Classes,
    /// To these strongly.
    pub strong: Classes,
}

/// A transition.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Edge {
    /// The state that it leads to.
    pub to: u32,
    /// The classes that it belongs to.
    pub taken: Classes,
}

/// A transition system. States have numbers from 0, and all can be reached from state 0.
pub trait System {
    /// How many states there are.
    fn states(&self) -> u32;

    /// The transitions out of a state, and the classes that are enabled in it.
    fn expand(&self, state: u32, edges: &mut Vec<Edge>) -> Classes;

    /// A shortest run from state 0 to `state`, both included.
    fn run_to(&self, state: u32) -> Vec<u32>;
}

/// A run that ends in a cycle.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Lasso {
    /// The states from state 0 to the first state of the cycle, both included.
    pub stem: Vec<u32>,
    /// The transitions from there and back again; none if the run stutters there.
    pub cycle: Vec<Edge>,
}

/// What came of a leads-to check.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum LeadsTo {
    /// No state meets the premise, so nothing was said.
    Vacuous,
    /// Every fair run keeps it.
    Holds,
    /// This fair run breaks it.
    Broken(Lasso),
}

/// Whether `from` leads to `to` on every fair run of `system`.
pub fn leads_to(
    system: &impl System,
    fairness: Fairness,
    from: impl Fn(u32) -> bool,
    to: impl Fn(u32) -> bool,
) -> LeadsTo {
    let premises: Vec<u32> = (0..system.states()).filter(|&s| from(s)).collect();
    if premises.is_empty() {
        return LeadsTo::Vacuous;
    }
    let region = Region::reached(system, premises, to);
    let all = (0..region.len()).collect();
    match region.fair_component(fairness, all) {
        None => LeadsTo::Holds,
        Some(component) => LeadsTo::Broken(region.lasso(system, fairness, &component)),
    }
}

/// The part of a system that can be reached from a premise without visiting the goal, with numbers of
/// its own.
struct Region {
    /// The state of the system that each state of the region is.
    states: Vec<u32>,
    /// By which state each was reached; a state that meets the premise names itself.
    parents: Vec<u32>,
    /// The numbers of the sets of classes that are enabled in each state.
    enabled: Vec<u32>,
    /// The transitions within the region, state after state.
    edges: Vec<Numbered>,
    /// Where those of each state begin, and after the last where they end.
    starts: Vec<usize>,
    /// Few sets of classes occur; each is stored once.
    sets: Vec<Classes>,
}

/// A transition, with the number of its set of classes.
#[derive(Clone, Copy)]
struct Numbered {
    to: u32,
    taken: u32,
}

impl Region {
    fn reached(system: &impl System, premises: Vec<u32>, to: impl Fn(u32) -> bool) -> Self {
        let states: Vec<u32> = premises.into_iter().filter(|&state| !to(state)).collect();
        let mut numbers: HashMap<u32, u32, FxBuildHasher> =
            states.iter().copied().zip(0..).collect();
        let mut region = Self {
            parents: (0..number(states.len())).collect(),
            states,
            enabled: Vec::new(),
            edges: Vec::new(),
            starts: vec![0],
            sets: Vec::new(),
        };
        let mut sets: HashMap<Classes, u32, FxBuildHasher> = HashMap::default();
        let mut set = |all: &mut Vec<Classes>, classes| {
            *sets.entry(classes).or_insert_with(|| {
                all.push(classes);
                number(all.len() - 1)
            })
        };
        let mut edges = Vec::new();
        let mut at = 0;
        while at < region.states.len() {
            edges.clear();
            let enabled = system.expand(region.states[at], &mut edges);
            region.enabled.push(set(&mut region.sets, enabled));
            for edge in edges.iter().filter(|edge| !to(edge.to)) {
                let to = *numbers.entry(edge.to).or_insert_with(|| {
                    region.states.push(edge.to);
                    region.parents.push(number(at));
                    number(region.states.len() - 1)
                });
                let taken = set(&mut region.sets, edge.taken);
                region.edges.push(Numbered { to, taken });
            }
            region.starts.push(region.edges.len());
            at += 1;
        }
        region
    }

    fn len(&self) -> u32 {
        number(self.states.len())
    }

    fn numbered(&self, state: u32) -> &[Numbered] {
        let state = state as usize;
        &self.edges[self.starts[state]..self.starts[state + 1]]
    }

    fn edges(&self, state: u32) -> impl Iterator<Item = Edge> {
        self.numbered(state).iter().map(|edge| Edge {
            to: edge.to,
            taken: self.sets[edge.taken as usize],
        })
    }

    fn enabled(&self, state: u32) -> Classes {
        self.sets[self.enabled[state as usize] as usize]
    }

    /// A set of states that a fair run can stay in for ever, visiting all of them again and again.
    fn fair_component(&self, fairness: Fairness, all: Vec<u32>) -> Option<Vec<u32>> {
        let mut todo = vec![all];
        // Which candidate each state belongs to; a state that was left out belongs to none.
        let mut belongs = vec![0_u32; self.states.len()];
        let mut order = vec![Visit::NOT_YET; self.states.len()];
        let mut candidates = 0;
        while let Some(candidate) = todo.pop() {
            candidates += 1;
            for &state in &candidate {
                belongs[state as usize] = candidates;
            }
            for component in self.components(&candidate, &belongs, &mut order).each() {
                candidates += 1;
                for &state in component {
                    belongs[state as usize] = candidates;
                }
                let inside = Inside::of(self, component, &belongs);
                if !(fairness.weak & inside.always_enabled & !inside.taken).is_empty() {
                    continue;
                }
                let unfair = fairness.strong & inside.enabled & !inside.taken;
                if unfair.is_empty() {
                    return Some(component.to_vec());
                }
                let rest = component.iter().copied();
                let rest = rest.filter(|&state| (self.enabled(state) & unfair).is_empty());
                let rest: Vec<u32> = rest.collect();
                if !rest.is_empty() {
                    todo.push(rest);
                }
            }
        }
        None
    }

    /// The strongly connected components of the subgraph that `candidate` spans (Tarjan's algorithm,
    /// with a stack of its own).
    fn components(&self, candidate: &[u32], belongs: &[u32], order: &mut [Visit]) -> Components {
        for &state in candidate {
            order[state as usize] = Visit::NOT_YET;
        }
        let mut search = Tarjan {
            region: self,
            belongs,
            order,
            visited: 0,
            open: Vec::new(),
            found: Components::default(),
        };
        for &state in candidate {
            if search.order[state as usize] == Visit::NOT_YET {
                search.visit(state);
            }
        }
        search.found
    }

    /// A run through `component` that is fair when repeated for ever, with the way there.
    fn lasso(&self, system: &impl System, fairness: Fairness, component: &[u32]) -> Lasso {
        let entry = component[0];
        let mut way = vec![entry];
        while self.parents[way[way.len() - 1] as usize] != way[way.len() - 1] {
            way.push(self.parents[way[way.len() - 1] as usize]);
        }
        let premise = way.pop().expect("the way holds its end");
        let mut stem = system.run_to(self.states[premise as usize]);
        stem.extend(way.iter().rev().map(|&state| self.states[state as usize]));

        let mut members = vec![0; self.states.len()];
        for &state in component {
            members[state as usize] = 1;
        }
        let inside = Inside::of(self, component, &members);
        let mut cycle = Cycle {
            region: self,
            members: &members,
            edges: Vec::new(),
            at: entry,
        };
        // Every class that is enabled somewhere is taken, or is weak and seen disabled.
        for class in ((fairness.weak | fairness.strong) & inside.enabled).each() {
            if (inside.taken & class).is_empty() {
                cycle.visit(|region, state| (region.enabled(state) & class).is_empty());
            } else {
                cycle.take(class);
            }
        }
        cycle.visit(|_, state| state == entry);
        let cycle = cycle.edges.into_iter().map(|edge| Edge {
            to: self.states[edge.to as usize],
            ..edge
        });
        Lasso {
            stem,
            cycle: cycle.collect(),
        }
    }
}

/// What happens within a component.
struct Inside {
    taken: Classes,
    /// Somewhere.
    enabled: Classes,
    always_enabled: Classes,
}

impl Inside {
    fn of(region: &Region, component: &[u32], belongs: &[u32]) -> Self {
        let mut inside = Self {
            taken: Classes::NONE,
            enabled: Classes::NONE,
            always_enabled: !Classes::NONE,
        };
        let mark = belongs[component[0] as usize];
        for &state in component {
            inside.enabled |= region.enabled(state);
            inside.always_enabled = inside.always_enabled & region.enabled(state);
            for edge in region.edges(state) {
                if belongs[edge.to as usize] == mark {
                    inside.taken |= edge.taken;
                }
            }
        }
        inside
    }
}

/// A walk within a component.
struct Cycle<'a> {
    region: &'a Region,
    /// Not 0 for the states of the component.
    members: &'a [u32],
    edges: Vec<Edge>,
    at: u32,
}

impl Cycle<'_> {
    /// Goes to the nearest state that meets `goal`.
    fn visit(&mut self, goal: impl Fn(&Region, u32) -> bool) {
        self.walk(|region, state, _| goal(region, state));
    }

    /// Takes a transition of this class, unless the walk has done so.
    fn take(&mut self, class: Classes) {
        let takes = |edge: &Edge| !(edge.taken & class).is_empty();
        if !self.edges.iter().any(takes) {
            self.walk(|_, _, by| by.is_some_and(takes));
        }
    }

    /// Takes a shortest way to where `goal` holds of a state and the transition into it.
    fn walk(&mut self, goal: impl Fn(&Region, u32, Option<&Edge>) -> bool) {
        if goal(self.region, self.at, None) {
            return;
        }
        let mut came_by: HashMap<u32, (u32, Edge), FxBuildHasher> = HashMap::default();
        let mut todo = VecDeque::from([self.at]);
        while let Some(state) = todo.pop_front() {
            for edge in self.region.edges(state) {
                if self.members[edge.to as usize] == 0 {
                    continue;
                }
                if goal(self.region, edge.to, Some(&edge)) {
                    let mut way = vec![edge];
                    let mut back = state;
                    while back != self.at {
                        let (from, edge) = came_by[&back];
                        way.push(edge);
                        back = from;
                    }
                    self.edges.extend(way.into_iter().rev());
                    self.at = edge.to;
                    return;
                }
                if edge.to != self.at && !came_by.contains_key(&edge.to) {
                    came_by.insert(edge.to, (state, edge));
                    todo.push_back(edge.to);
                }
            }
        }
        unreachable!("a component is strongly connected, and holds what is looked for");
    }
}

/// Components, one after the other.
#[derive(Default)]
struct Components {
    states: Vec<u32>,
    /// Where each ends.
    ends: Vec<usize>,
}

impl Components {
    fn each(&self) -> impl Iterator<Item = &[u32]> {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        starts
            .zip(&self.ends)
            .map(|(start, &end)| &self.states[start..end])
    }
}

/// When a state was visited, and the oldest open state that it reaches.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Visit {
    at: u32,
    low: u32,
}

impl Visit {
    const NOT_YET: Self = Self {
        at: u32::MAX,
        low: u32::MAX,
    };

    /// Not yet part of a component.
    const fn is_open(self) -> bool {
        self.low != u32::MAX
    }
}

struct Tarjan<'a> {
    region: &'a Region,
    belongs: &'a [u32],
    /// For each state of the region; only those of the candidate count.
    order: &'a mut [Visit],
    visited: u32,
    open: Vec<u32>,
    found: Components,
}

impl Tarjan<'_> {
    fn visit(&mut self, root: u32) {
        let mark = self.belongs[root as usize];
        let mut calls = vec![(root, 0)];
        self.open(root);
        while let Some((state, next)) = calls.last_mut() {
            let state = *state;
            let Some(edge) = self.region.numbered(state).get(*next) else {
                calls.pop();
                let low = self.order[state as usize].low;
                if !self.close(state)
                    && let Some(&(caller, _)) = calls.last()
                {
                    self.reaches(caller, low);
                }
                continue;
            };
            *next += 1;
            if self.belongs[edge.to as usize] != mark {
                continue;
            }
            let visit = self.order[edge.to as usize];
            if visit == Visit::NOT_YET {
                self.open(edge.to);
                calls.push((edge.to, 0));
            } else if visit.is_open() {
                self.reaches(state, visit.at);
            }
        }
    }

    fn open(&mut self, state: u32) {
        let (at, low) = (self.visited, self.visited);
        self.order[state as usize] = Visit { at, low };
        self.visited += 1;
        self.open.push(state);
    }

    fn reaches(&mut self, state: u32, oldest: u32) {
        let low = &mut self.order[state as usize].low;
        *low = (*low).min(oldest);
    }

    /// All that `state` reaches has been visited: if it reaches nothing older, it and what is open
    /// above it are a component. Returns whether they are.
    fn close(&mut self, state: u32) -> bool {
        let Visit { at, low } = self.order[state as usize];
        if at != low {
            return false;
        }
        let start = self.open.iter().rposition(|&open| open == state);
        let component = self.open.drain(start.expect("it is open")..);
        for member in component {
            self.order[member as usize].low = u32::MAX;
            self.found.states.push(member);
        }
        self.found.ends.push(self.found.states.len());
        true
    }
}

fn number(index: usize) -> u32 {
    u32::try_from(index).expect("fewer than 2^32 states")
}
