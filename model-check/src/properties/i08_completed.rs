//! I8: the leader counts `(s,q)` as completed only if the follower finished it.

use crossguard_protocol::{ManeuverId, StationId};

use super::{StateRule, View};

pub(super) const RULE: StateRule = StateRule { holds, premise };

fn completed<'a>(view: &View<'a>) -> impl Iterator<Item = (StationId, ManeuverId)> + use<'a> {
    view.leaders().flat_map(|(session, leading)| {
        leading.members.iter().filter_map(move |member| {
            let order = member.order.filter(|_| member.has_completed())?;
            Some((
                member.station,
                ManeuverId {
                    session,
                    request: order.request,
                },
            ))
        })
    })
}

fn holds(view: &View) -> bool {
    completed(view).all(|(station, id)| {
        view.history()
            .command(station, id)
            .is_some_and(|command| command.finished)
    })
}

fn premise(view: &View) -> bool {
    completed(view).next().is_some()
}
