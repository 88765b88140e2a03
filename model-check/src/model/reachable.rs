//! The states of a model one by one, for what needs no graph of them.

use super::{Action, Model, ModelState};
use crate::explore::RunOf;
use crate::numbered::Numbered;

/// All states that actions lead to, in order of their distance from the initial one. States that differ in which of the
/// symmetric robots is which are told apart. A state is expanded when the next one is asked for.
pub struct Reachable<'a> {
    model: &'a Model,
    states: Numbered<ModelState>,
    /// Of each state the one from which it was found, and by which action.
    found_by: Vec<Option<(u32, Action)>>,
    /// How many states were given out.
    given: u32,
}

impl Model {
    /// All states that actions lead to.
    #[must_use]
    pub fn reachable(&self) -> Reachable<'_> {
        let mut reachable = Reachable {
            model: self,
            states: Numbered::default(),
            found_by: Vec::new(),
            given: 0,
        };
        reachable.add(self.initial(), None);
        reachable
    }
}

impl Reachable<'_> {
    /// How many states were found, given out or not.
    pub(crate) const fn found(&self) -> usize {
        self.states.len()
    }

    /// A shortest run into the state that was given out last.
    pub(crate) fn run(&self) -> RunOf<Model> {
        let state = |number| self.states.get(number).clone();
        let mut at = self.given.saturating_sub(1);
        let mut run = vec![(state(at), None)];
        while let Some((before, action)) = self.found_by[at as usize] {
            run.push((state(before), Some(action)));
            at = before;
        }
        run.reverse();
        run
    }

    fn add(&mut self, state: ModelState, found_by: Option<(u32, Action)>) {
        let number = self.states.add(state) as usize;
        if number == self.found_by.len() {
            self.found_by.push(found_by);
        }
    }

    fn expand(&mut self, number: u32) {
        let state = self.states.get(number).clone();
        let mut actions = Vec::new();
        self.model.actions_in(&state, &mut actions);
        for action in actions {
            if let Some((next, _)) = self.model.successor(&state, action) {
                self.add(next, Some((number, action)));
            }
        }
    }
}

impl Iterator for Reachable<'_> {
    type Item = ModelState;

    fn next(&mut self) -> Option<ModelState> {
        if let Some(last) = self.given.checked_sub(1) {
            self.expand(last);
        }
        let next = self.states.values().get(self.given as usize)?.clone();
        self.given += 1;
        Some(next)
    }
}
