//! The states of a model as the rules see them.

use crossguard_protocol::{Config, StationId};
use smallvec::SmallVec;

use super::{Model, ModelState};
use crate::node::Node;
use crate::properties::{Surroundings, View};
use crate::scenario::MAX_ROBOTS;

impl Model {
    /// Shows a state as the rules see it.
    pub(crate) fn look<T>(&self, state: &ModelState, look: impl FnOnce(&View) -> T) -> T {
        let nodes: SmallVec<[&Node; MAX_ROBOTS]> = self.nodes(state).collect();
        look(&View {
            nodes: &nodes,
            history: self.history(state),
            world: &InModel { model: self, state },
        })
    }
}

/// A state as part of its model.
struct InModel<'a> {
    model: &'a Model,
    state: &'a ModelState,
}

impl Surroundings for InModel<'_> {
    fn config(&self, _place: usize) -> &Config {
        &self.model.scenario().config
    }

    fn can_progress(&self) -> bool {
        self.model.can_progress(self.state)
    }

    fn place_of(&self, station: StationId) -> Option<usize> {
        self.model.scenario().place_of(station)
    }

    fn restarts_are_over(&self) -> bool {
        self.state.left().restarts == 0
    }

    fn lies(&self, station: StationId) -> bool {
        let mut liars = self.model.scenario().liars();
        liars.any(|(_, liar, _)| liar == station)
    }
}
