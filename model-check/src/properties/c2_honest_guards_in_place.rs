//! C2: when a pedestrian steps on the road, every guard that does not lie is in place.
//!
//! A follower that lies takes itself away, and nobody else. The exemption of W1 is the same here.

use crossguard_protocol::SessionId;

use super::prelude::*;
use super::w1_guards_in_place;

property! {
    "C2", Authentication::NAMES;
    untimed T "when a pedestrian steps on the road, every guard that does not lie is in place, or is gone and its leader has not been informed",
        Some("a pedestrian steps on the road"),
        Rule::StepOnRoad(holds),
        "CountsOneForAll";
}

/// Judged when a pedestrian steps on the road at the sign of `session`, where this number of guards is required.
fn holds(view: &View, session: SessionId, required: usize) -> bool {
    let leaders = view.leaders().filter(|(led, _)| *led == session);
    let members = leaders.flat_map(|(_, leading)| leading.members.iter());
    let liars = members.filter(|member| view.world.lies(member.station));
    let honest = required.saturating_sub(liars.count());
    w1_guards_in_place::holds(view, session, honest)
}
