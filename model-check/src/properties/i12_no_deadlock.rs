//! I12: no deadlock: every state that is not quiescent has an enabled progress step.
//!
//! Quiescent is a state in which no robot that is up has a part in a session. Progress is a message
//! that arrives or a timer that expires, and that changes the state; it takes no application's help. The
//! timer of periodic RAM does not count: it always runs, and what it sends may always get lost.

use super::{StateRule, View};

pub(super) const RULE: StateRule = StateRule { holds, premise };

fn holds(view: &View) -> bool {
    !premise(view) || view.world.can_progress()
}

fn premise(view: &View) -> bool {
    view.nodes().any(|node| !node.is_idle())
}
