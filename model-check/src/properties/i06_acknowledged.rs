//! I6: the leader counts `(s,q)` as acknowledged only if the follower accepted it; a follower
//! executes only what it acknowledged.

use crossguard_protocol::{ManeuverId, StationId};

use super::{StateRule, View};

pub(super) const RULE: StateRule = StateRule { holds, premise };

fn acknowledged<'a>(view: &View<'a>) -> impl Iterator<Item = (StationId, ManeuverId)> + use<'a> {
    view.leaders().flat_map(|(session, leading)| {
        leading.members.iter().filter_map(move |member| {
            let id = ManeuverId {
                session,
                request: member.order?.request,
            };
            Some((member.station, id))
        })
    })
}

fn holds(view: &View) -> bool {
    let accepted = |station, id| {
        view.history()
            .command(station, id)
            .is_some_and(|command| command.accepted)
    };
    acknowledged(view).all(|(station, id)| accepted(station, id))
        && view.nodes().all(|node| {
            node.actuation
                .running
                .is_none_or(|id| accepted(node.persisted.station, id))
        })
}

fn premise(view: &View) -> bool {
    acknowledged(view).next().is_some()
}
