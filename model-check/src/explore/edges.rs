//! The transitions of a graph.

use super::Label;
use crate::fair::{Classes, Edge};
use crate::numbered::Numbered;

/// The transitions out of states, which are added in the order of their numbers.
pub(super) struct Edges {
    /// Successors of all states, one after the other.
    targets: Vec<u32>,
    /// Where the successors of each state begin, and after the last where they end.
    starts: Vec<u32>,
    /// Whether each of the transitions is marked, where marks are kept.
    marks: Option<Vec<bool>>,
    classes: Option<EdgeClasses>,
}

/// The classes of transitions, as numbers of sets.
#[derive(Default)]
struct EdgeClasses {
    /// Of each transition.
    taken: Vec<u16>,
    /// Of each state.
    enabled: Vec<u16>,
    /// Few sets occur.
    sets: Numbered<Classes>,
}

/// There are more transitions, or more sets of classes, than have numbers.
pub(super) struct Full;

impl Edges {
    /// No edges yet. Whether marks are kept, and whether classes are.
    pub(super) fn new(has_marks: bool, has_classes: bool) -> Self {
        Self {
            targets: Vec::new(),
            starts: vec![0],
            marks: has_marks.then(Vec::new),
            classes: has_classes.then(EdgeClasses::default),
        }
    }

    /// Adds the transitions of the next state, each with its target, in which these classes are enabled.
    pub(super) fn add(&mut self, row: &[(u32, Label)], enabled: Classes) -> Result<(), Full> {
        let end = self.targets.len() + row.len();
        let end = u32::try_from(end).map_err(|_| Full)?;
        if let Some(classes) = &mut self.classes {
            let enabled = classes.number(enabled)?;
            classes.enabled.push(enabled);
            for (_, label) in row {
                let taken = classes.number(label.taken)?;
                classes.taken.push(taken);
            }
        }
        self.targets.extend(row.iter().map(|&(to, _)| to));
        if let Some(marks) = &mut self.marks {
            marks.extend(row.iter().map(|(_, label)| label.is_marked));
        }
        self.starts.push(end);
        Ok(())
    }

    pub(super) fn shrink(&mut self) {
        self.targets.shrink_to_fit();
        self.starts.shrink_to_fit();
        if let Some(marks) = &mut self.marks {
            marks.shrink_to_fit();
        }
        if let Some(classes) = &mut self.classes {
            classes.taken.shrink_to_fit();
            classes.enabled.shrink_to_fit();
        }
    }

    /// The transition with this place among those out of a state.
    pub(super) fn edge(&self, state: u32, place: usize) -> Option<Edge> {
        let range = self.range(state as usize);
        let at = range.start + place;
        let set = |classes: &EdgeClasses| *classes.sets.get(classes.taken[at].into());
        (at < range.end).then(|| Edge {
            to: self.targets[at],
            taken: self.classes.as_ref().map(set).unwrap_or_default(),
        })
    }

    /// The classes that are enabled in a state, where they are kept.
    pub(super) fn enabled(&self, state: u32) -> Classes {
        let set = |it: &EdgeClasses| *it.sets.get(it.enabled[state as usize].into());
        self.classes.as_ref().map(set).unwrap_or_default()
    }

    /// The successors of a state by its marked transitions, or by its other ones. Without marks that are kept, all are other ones.
    pub(super) fn targets_with_mark(
        &self,
        state: usize,
        are_marked: bool,
    ) -> impl Iterator<Item = u32> {
        let marks = self.marks.as_deref();
        let is_meant = move |at: &usize| marks.is_some_and(|marks| marks[*at]) == are_marked;
        let range = self.range(state).filter(is_meant);
        range.map(|at| self.targets[at])
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
        u16::try_from(self.sets.add(classes)).map_err(|_| Full)
    }
}
