//! The states of a model as the rules see them.

use crossguard_protocol::{Config, StationId, Timer};
use smallvec::SmallVec;

use super::{Model, ModelState};
use crate::node::Node;
use crate::properties::{Surroundings, View};
use crate::scenario::MAX_ROBOTS;
use crate::steps::Cause;

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

    /// Leaving aside the timer of periodic RAM. A robot that hangs goes on at some time, so its timers count; that a
    /// message of a monotone channel arrives at all is not sure, so it does not.
    fn can_progress(&self) -> bool {
        let Self { model, state } = self;
        let effective = |i: usize, cause| {
            let step = model.step(state.nodes[i], cause);
            step.is_some_and(|step| step.after != state.nodes[i] || !step.sends.is_empty())
        };
        let by_timer = model.nodes(state).enumerate().any(|(i, node)| {
            let timers = node.timers();
            let mut others = timers.iter().filter(|(timer, _)| *timer != Timer::Ram);
            others.any(|(timer, _)| effective(i, Cause::Timer(*timer)))
        });
        if by_timer {
            return true;
        }
        let network = model.network(state);
        let mut heard = (model.next_on_air(state).into_iter()).chain(network.delayed());
        heard.any(|sent| effective(sent.to.into(), Cause::Message(sent.message)))
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
