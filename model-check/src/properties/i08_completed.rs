//! I8: the leader counts `(s,q)` as completed or in position only if the follower's body has done that.

use crossguard_protocol::{ManeuverId, Progress, StationId};

use super::prelude::*;

property! {
    "I8", Authentication::truth_of(&[Insider::Follower]);
    untimed S "a leader counts a command as completed or in position only if the follower's body has done that",
        Some("a leader counts a command as completed or in position"),
        Rule::State(StateRule { holds, premise, of_two: true }),
        "TakesAnyProgress";
}

fn counted<'a>(
    view: &View<'a>,
) -> impl Iterator<Item = (StationId, ManeuverId, Progress)> + use<'a> {
    view.leaders().flat_map(|(session, leading)| {
        leading.members.iter().filter_map(move |member| {
            let order = member.order?;
            let request = order.request;
            Some((
                member.station,
                ManeuverId { session, request },
                order.progress?,
            ))
        })
    })
}

fn holds(view: &View) -> bool {
    counted(view).all(|(station, id, progress)| {
        let command = view.history().command(station, id);
        match progress {
            Progress::Completed => command.is_some_and(|command| command.finished),
            Progress::InPosition => command.is_some_and(|command| command.in_position),
            _ => true,
        }
    })
}

fn premise(view: &View) -> bool {
    let counts = |progress| matches!(progress, Progress::Completed | Progress::InPosition);
    counted(view).any(|(_, _, progress)| counts(progress))
}
