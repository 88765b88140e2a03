//! The transitions of a graph.

use std::collections::HashMap;

use rustc_hash::FxBuildHasher;

use crate::fair::{Classes, Edge};

/// The transitions out of states, which are added in the order of their numbers.
pub(super) struct Edges {
    /// Successors of all states, one after the other.
    targets: Vec<u32>,
    /// Where the successors of each state begin, and after the last where they end.
    starts: Vec<u32>,
    /// Whether each of the transitions is nothing but arrivals on a monotone channel, which may never happen; `None`
    /// where the channel is another one.
    by_chance: Option<Vec<bool>>,
    classes: Option<EdgeClasses>,
}

/// The classes of transitions, as numbers of sets.
#[derive(Default)]
struct EdgeClasses {
    /// Of each transition.
    taken: Vec<u16>,
    /// Of each state.
    enabled: Vec<u16>,
    /// Few sets occur; each is stored once.
    sets: Vec<Classes>,
    numbers: HashMap<Classes, u16, FxBuildHasher>,
}

/// How a transition leads to its target.
#[derive(Clone, Copy)]
pub(super) struct Way {
    /// It is nothing but an arrival on a monotone channel.
    pub(super) by_chance: bool,
    /// The classes of the transition, where classes are kept.
    pub(super) taken: Classes,
}

/// There are more transitions, or more sets of classes, than have numbers.
pub(super) struct Full;

impl Edges {
    /// No edges yet. Whether the channel is a monotone one, and whether classes are kept.
    pub(super) fn new(is_monotone: bool, has_classes: bool) -> Self {
        Self {
            targets: Vec::new(),
            starts: vec![0],
            by_chance: is_monotone.then(Vec::new),
            classes: has_classes.then(EdgeClasses::default),
        }
    }

    /// Adds the transitions of the next state, each with its target, in which these classes are enabled.
    pub(super) fn add(&mut self, transitions: &[(u32, Way)], enabled: Classes) -> Result<(), Full> {
        let end = self.targets.len() + transitions.len();
        let end = u32::try_from(end).map_err(|_| Full)?;
        if let Some(classes) = &mut self.classes {
            let enabled = classes.number(enabled)?;
            classes.enabled.push(enabled);
            for (_, way) in transitions {
                let taken = classes.number(way.taken)?;
                classes.taken.push(taken);
            }
        }
        self.targets.extend(transitions.iter().map(|&(to, _)| to));
        if let Some(by_chance) = &mut self.by_chance {
            by_chance.extend(transitions.iter().map(|(_, way)| way.by_chance));
        }
        self.starts.push(end);
        Ok(())
    }

    pub(super) fn shrink(&mut self) {
        self.targets.shrink_to_fit();
        self.starts.shrink_to_fit();
        if let Some(by_chance) = &mut self.by_chance {
            by_chance.shrink_to_fit();
        }
        if let Some(classes) = &mut self.classes {
            classes.taken.shrink_to_fit();
            classes.enabled.shrink_to_fit();
        }
    }

    /// The successors of a state, some more than once where classes are kept.
    pub(super) fn targets(&self, state: usize) -> &[u32] {
        &self.targets[self.range(state)]
    }

    /// The transition with this place among those out of a state.
    pub(super) fn edge(&self, state: u32, place: usize) -> Option<Edge> {
        let range = self.range(state as usize);
        let at = range.start + place;
        let set = |classes: &EdgeClasses| classes.sets[usize::from(classes.taken[at])];
        (at < range.end).then(|| Edge {
            to: self.targets[at],
            taken: self.classes.as_ref().map(set).unwrap_or_default(),
        })
    }

    /// The classes that are enabled in a state, where they are kept.
    pub(super) fn enabled(&self, state: u32) -> Classes {
        let set = |it: &EdgeClasses| it.sets[usize::from(it.enabled[state as usize])];
        self.classes.as_ref().map(set).unwrap_or_default()
    }

    /// The successors of a state that are reached by what happens at some time, without the help of chance.
    pub(super) fn sure_targets(&self, state: usize) -> impl Iterator<Item = u32> {
        let range = self.range(state);
        let by_chance = self.by_chance.as_deref();
        let is_sure = move |at: &usize| by_chance.is_none_or(|by_chance| !by_chance[*at]);
        range.filter(is_sure).map(|at| self.targets[at])
    }

    fn range(&self, state: usize) -> std::ops::Range<usize> {
        self.starts[state] as usize..self.starts[state + 1] as usize
    }

    /// The first state with a transition to this one.
    pub(super) fn first_source(&self, target: u32) -> Option<u32> {
        let at = self.targets.iter().position(|&to| to == target)?;
        let after = self.starts.partition_point(|&start| start as usize <= at);
        u32::try_from(after - 1).ok()
    }
}

impl EdgeClasses {
    fn number(&mut self, classes: Classes) -> Result<u16, Full> {
        if let Some(&known) = self.numbers.get(&classes) {
            return Ok(known);
        }
        let fresh = u16::try_from(self.sets.len()).map_err(|_| Full)?;
        self.sets.push(classes);
        self.numbers.insert(classes, fresh);
        Ok(fresh)
    }
}
