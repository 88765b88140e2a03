//! The parts of a state that are stored for themselves.

use super::ModelState;
use crate::scenario::{Bounds, MAX_ROBOTS};

/// What a state is besides its robots.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) struct Backdrop {
    history: u32,
    broken: u32,
    left: Bounds,
    hung: u8,
    network: u32,
}

impl ModelState {
    /// The numbers of its robots, and the rest.
    pub(crate) const fn parts(&self) -> ([u32; MAX_ROBOTS], Backdrop) {
        let Self {
            nodes,
            history,
            broken,
            left,
            hung,
            network,
        } = *self;
        let backdrop = Backdrop {
            history,
            broken,
            left,
            hung,
            network,
        };
        (nodes, backdrop)
    }

    /// The state with these parts.
    pub(crate) const fn of_parts(nodes: [u32; MAX_ROBOTS], backdrop: Backdrop) -> Self {
        let Backdrop {
            history,
            broken,
            left,
            hung,
            network,
        } = backdrop;
        Self {
            nodes,
            history,
            broken,
            left,
            hung,
            network,
        }
    }
}
