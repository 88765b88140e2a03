//! W3: at one place one sign shows go.
//!
//! Without time there is one exemption: leaders of which the one that goes behind has not received two
//! messages of the other, the second with a newer heartbeat. One message alone may be from a session that is
//! long over. How long two signs can show go once the two hear each other is what the timed view finds.

use crate::properties::{StateRule, View};
use crate::road::Heard;

pub(crate) const RULE: StateRule = StateRule { holds, premise };

fn holds(view: &View) -> bool {
    view.nodes()
        .all(|node| node.actuation.heard != Heard::Twice || !node.actuation.corridor_open)
}

fn premise(view: &View) -> bool {
    view.nodes()
        .any(|node| node.actuation.heard == Heard::Twice)
}
