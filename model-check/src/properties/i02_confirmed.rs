//! I2: a member of `s` was confirmed by the leader of `s`.

use crossguard_protocol::Confirmation;

use super::{StateRule, View};

pub(super) const RULE: StateRule = StateRule { holds, premise };

fn holds(view: &View) -> bool {
    view.followers().all(|(robot, following)| {
        let follower = Confirmation {
            station: robot.station(),
            offer: following.offer,
        };
        view.history().is_confirmed(following.session, follower)
    })
}

fn premise(view: &View) -> bool {
    view.followers().next().is_some()
}
