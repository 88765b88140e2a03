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

use bitflags::bitflags;
use rustc_hash::FxBuildHasher;

bitflags! {
    /// A set of classes of transitions, which have the numbers 0 to 127.
    #[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
    pub struct Classes: u128 {
        const _ = !0;
    }
}

impl Classes {
    /// No class.
    pub const NONE: Self = Self::empty();

    /// The one class with this number.
    ///
    /// # Panics
    /// Above 127.
    #[must_use]
    pub const fn one(number: u32) -> Self {
        assert!(number < u128::BITS, "more classes than a set can hold");
        Self::from_bits_retain(1 << number)
    }

    fn each(self) -> impl Iterator<Item = Self> {
        let all = (0..u128::BITS).map(Self::one);
        all.filter(move |class| self.contains(*class))
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
    /// How many states there are, fewer than 2^32 - 1.
    fn states(&self) -> u32;

    /// The transition with this place, from 0, among those out of a state.
    fn edge(&self, state: u32, place: usize) -> Option<Edge>;

    /// The classes that are enabled in a state.
    fn enabled(&self, state: u32) -> Classes;

    /// A shortest run from state 0 to `state`, both included.
    fn run_to(&self, state: u32) -> Vec<u32>;

    /// The transitions out of a state.
    fn edges(&self, state: u32) -> impl Iterator<Item = Edge> {
        (0..).map_while(move |place| self.edge(state, place))
    }
}

/// A run that ends in a cycle.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Lasso {
    /// The states from state 0 to the first state of the cycle, both included.
    pub stem: Vec<u32>,
    /// The transitions from there and back again; none if the run stutters there.
    pub cycle: Vec<Edge>,
}

/// Outcome of a leads-to check.
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
    let mut region = Region::reached(system, &premises, to);
    match region.fair_component(fairness) {
        None => LeadsTo::Holds,
        Some(component) => LeadsTo::Broken(region.lasso(fairness, &premises, &component)),
    }
}

/// The part of a system that can be reached from a premise without visiting the goal.
struct Region<'a, S> {
    system: &'a S,
    /// In the order in which they were reached.
    states: Vec<u32>,
    /// For each state of the system which candidate for a fair component it belongs to, by number.
    belongs: Vec<u32>,
}

/// Not reached, or left out.
const NOWHERE: u32 = 0;
/// In the region, and in no candidate yet.
const REGION: u32 = 1;
const GOAL: u32 = u32::MAX;

impl<'a, S: System> Region<'a, S> {
    fn reached(system: &'a S, premises: &[u32], to: impl Fn(u32) -> bool) -> Self {
        let mut region = Self {
            system,
            states: Vec::new(),
            belongs: vec![NOWHERE; system.states() as usize],
        };
        for &premise in premises {
            region.reach(premise, &to);
        }
        let mut at = 0;
        while at < region.states.len() {
            for edge in system.edges(region.states[at]) {
                region.reach(edge.to, &to);
            }
            at += 1;
        }
        region
    }

    fn reach(&mut self, state: u32, to: impl Fn(u32) -> bool) {
        let belongs = &mut self.belongs[state as usize];
        if *belongs != NOWHERE {
            return;
        }
        if to(state) {
            *belongs = GOAL;
        } else {
            *belongs = REGION;
            self.states.push(state);
        }
    }

    /// A set of states that a fair run can stay in for ever, visiting all of them again and again.
    fn fair_component(&mut self, fairness: Fairness) -> Option<Vec<u32>> {
        let mut todo = vec![std::mem::take(&mut self.states)];
        let mut order = vec![Visit::NOT_YET; self.belongs.len()];
        let mut candidates = REGION;
        while let Some(candidate) = todo.pop() {
            candidates += 1;
            for &state in &candidate {
                self.belongs[state as usize] = candidates;
                order[state as usize] = Visit::NOT_YET;
            }
            let components = self.components(candidate, &mut order);
            for component in components.each() {
                candidates += 1;
                for &state in component {
                    self.belongs[state as usize] = candidates;
                }
                let inside = Inside::of(self, component);
                if !(fairness.weak & inside.always_enabled & !inside.taken).is_empty() {
                    continue;
                }
                let unfair = fairness.strong & inside.enabled & !inside.taken;
                if unfair.is_empty() {
                    return Some(component.to_vec());
                }
                let rest = component.iter().copied();
                let rest = rest.filter(|&state| (self.system.enabled(state) & unfair).is_empty());
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
    fn components(&self, candidate: Vec<u32>, order: &mut [Visit]) -> Components {
        let mut search = Tarjan {
            region: self,
            order,
            visited: 0,
            open: Vec::new(),
            found: Components::default(),
        };
        for state in candidate {
            if search.order[state as usize] == Visit::NOT_YET {
                search.visit(state);
            }
        }
        search.found
    }

    /// A run through `component` that is fair when repeated for ever, with the way there.
    fn lasso(&self, fairness: Fairness, premises: &[u32], component: &[u32]) -> Lasso {
        let entry = component[0];
        let way = self.way(premises, entry);
        let mut stem = self.system.run_to(way[0]);
        stem.extend(&way[1..]);

        let inside = Inside::of(self, component);
        let mut cycle = Cycle {
            region: self,
            edges: Vec::new(),
            at: entry,
        };
        // Every class that is enabled somewhere is taken, or is weak and seen disabled.
        for class in ((fairness.weak | fairness.strong) & inside.enabled).each() {
            if (inside.taken & class).is_empty() {
                cycle.visit(|system, state| (system.enabled(state) & class).is_empty());
            } else {
                cycle.take(class);
            }
        }
        cycle.visit(|_, state| state == entry);
        Lasso {
            stem,
            cycle: cycle.edges,
        }
    }

    /// A shortest way through the region from a premise, both ends included.
    fn way(&self, premises: &[u32], end: u32) -> Vec<u32> {
        let is_inside = |state: u32| !matches!(self.belongs[state as usize], NOWHERE | GOAL);
        let starts = premises.iter().copied().filter(|&start| is_inside(start));
        let mut todo: VecDeque<u32> = starts.collect();
        let mut came_from: HashMap<u32, u32, FxBuildHasher> =
            todo.iter().map(|&start| (start, start)).collect();
        while let Some(state) = todo.pop_front() {
            if state == end {
                break;
            }
            for edge in self.system.edges(state).filter(|edge| is_inside(edge.to)) {
                came_from.entry(edge.to).or_insert_with(|| {
                    todo.push_back(edge.to);
                    state
                });
            }
        }
        let mut way = vec![end];
        let mut at = end;
        while came_from[&at] != at {
            at = came_from[&at];
            way.push(at);
        }
        way.reverse();
        way
    }
}

struct Inside {
    taken: Classes,
    /// Somewhere.
    enabled: Classes,
    always_enabled: Classes,
}

impl Inside {
    fn of(region: &Region<'_, impl System>, component: &[u32]) -> Self {
        let mut inside = Self {
            taken: Classes::NONE,
            enabled: Classes::NONE,
            always_enabled: !Classes::NONE,
        };
        let mark = region.belongs[component[0] as usize];
        for &state in component {
            let enabled = region.system.enabled(state);
            inside.enabled |= enabled;
            inside.always_enabled &= enabled;
            for edge in region.system.edges(state) {
                if region.belongs[edge.to as usize] == mark {
                    inside.taken |= edge.taken;
                }
            }
        }
        inside
    }
}

/// A walk within the component that the state of its beginning belongs to.
struct Cycle<'a, S> {
    region: &'a Region<'a, S>,
    edges: Vec<Edge>,
    at: u32,
}

impl<S: System> Cycle<'_, S> {
    /// Goes to the nearest state that meets `goal`.
    fn visit(&mut self, goal: impl Fn(&S, u32) -> bool) {
        self.walk(|system, state, _| goal(system, state));
    }

    /// Takes a transition of this class, unless the walk has done so.
    fn take(&mut self, class: Classes) {
        let takes = |edge: &Edge| !(edge.taken & class).is_empty();
        if !self.edges.iter().any(takes) {
            self.walk(|_, _, by| by.is_some_and(takes));
        }
    }

    /// Takes a shortest way to where `goal` holds of a state and the transition into it.
    fn walk(&mut self, goal: impl Fn(&S, u32, Option<&Edge>) -> bool) {
        let Region {
            system, belongs, ..
        } = self.region;
        if goal(system, self.at, None) {
            return;
        }
        let mut came_by: HashMap<u32, (u32, Edge), FxBuildHasher> = HashMap::default();
        let mut todo = VecDeque::from([self.at]);
        while let Some(state) = todo.pop_front() {
            for edge in system.edges(state) {
                if belongs[edge.to as usize] != belongs[self.at as usize] {
                    continue;
                }
                if goal(system, edge.to, Some(&edge)) {
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

#[derive(Default)]
struct Components {
    states: Vec<u32>,
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

struct Tarjan<'a, S> {
    region: &'a Region<'a, S>,
    /// For each state; only those of the candidate count.
    order: &'a mut [Visit],
    visited: u32,
    open: Vec<u32>,
    found: Components,
}

impl<S: System> Tarjan<'_, S> {
    fn visit(&mut self, root: u32) {
        let Region {
            system, belongs, ..
        } = self.region;
        let mark = belongs[root as usize];
        let mut calls = vec![(root, 0)];
        self.open(root);
        while let Some((state, next)) = calls.last_mut() {
            let state = *state;
            let Some(edge) = system.edge(state, *next) else {
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
            if belongs[edge.to as usize] != mark {
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
