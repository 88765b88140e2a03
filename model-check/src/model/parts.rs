//! The parts of a state that are stored for themselves.

use super::ModelState;
use crate::scenario::{Bounds, MAX_ROBOTS};

/// Parts of a state besides its robots, in the order of its fields.
pub(crate) type Backdrop = (u32, u64, Bounds, u8, u32);

impl ModelState {
    /// The numbers of its robots, and the rest.
    pub(crate) const fn parts(&self) -> ([u32; MAX_ROBOTS], Backdrop) {
        let backdrop = (
            self.history,
            self.broken,
            self.left,
            self.hung,
            self.network,
        );
        (self.nodes, backdrop)
    }

    /// The state with these parts.
    pub(crate) const fn of_parts(nodes: [u32; MAX_ROBOTS], backdrop: Backdrop) -> Self {
        let (history, broken, left, hung, network) = backdrop;
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
