//! I2: a member of `s` was confirmed by the leader of `s`.

use crossguard_protocol::Confirmation;

use super::prelude::*;

property! {
    "I2", Authentication::truth_of(&[Insider::Leader]);
    untimed S "a follower in a session was confirmed by its leader",
        Some("a robot follows"),
        Rule::State(StateRule { holds, premise: |view| view.followers().next().is_some(), of_two: true }),
        "NeedsNoConfirmation";
}

fn holds(view: &View) -> bool {
    view.followers().all(|(robot, following)| {
        let follower = Confirmation {
            station: robot.station(),
            offer: following.offer,
        };
        view.history().is_confirmed(following.session, follower)
    })
}
