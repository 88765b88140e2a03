//! I8: the leader counts `(s,q)` as completed or in position only if the follower's body has done that.

use crossguard_protocol::Progress;

use super::prelude::*;

property! {
    "I8", Authentication::truth_of(&[Insider::Follower]);
    untimed S "a leader counts a command as completed or in position only if the follower's body has done that",
        Some("a leader counts a command as completed or in position"),
        Rule::State(StateRule { holds, premise, of_two: true }),
        "TakesAnyProgress";
}

fn holds(view: &View) -> bool {
    view.orders().all(|(station, id, progress)| {
        let command = view.history().command(station, id);
        match progress {
            Some(Progress::Completed) => command.is_some_and(|command| command.finished),
            Some(Progress::InPosition) => command.is_some_and(|command| command.in_position),
            _ => true,
        }
    })
}

fn premise(view: &View) -> bool {
    let done = [Some(Progress::Completed), Some(Progress::InPosition)];
    view.orders()
        .any(|(_, _, progress)| done.contains(&progress))
}
