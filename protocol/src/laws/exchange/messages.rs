//! What a message implies of the history. Facts stay known, so it stays true, however late, often and in whatever order
//! the message arrives.
//!
//! A message of a robot that is neither leader nor follower of the exchange implies nothing of it; nor does a farewell: no
//! property rests on what it says. Each `match` names all messages, so that a new one has to be given a meaning here.

use super::{Exchange, History};
use crate::id::RequestId;
use crate::message::{Answer, Command, Coordination, Farewell, Progress, Ram, Rmcm, Verdict};

/// What a RAM implies.
#[must_use]
pub fn ram_is_true(exchange: &Exchange, history: &History, ram: &Ram) -> bool {
    match ram.farewell {
        None | Some(Farewell::Ended(..) | Farewell::Left(..)) => {}
    }
    let is_leader = exchange.is_led_by(ram.station);
    let is_follower = ram.station == exchange.follower;
    match &ram.coordination {
        Coordination::None => true,
        Coordination::NeedHelp { number, .. } => {
            !is_leader || *number != exchange.session.number || history.requested
        }
        Coordination::OfferHelp { session, offer, .. } => {
            let is_watched = *session == exchange.session && *offer == exchange.offer;
            !is_follower || !is_watched || history.offered
        }
        Coordination::Leader {
            number, followers, ..
        } => {
            !is_leader
                || *number != exchange.session.number
                || (history.requested
                    && followers.iter().all(|listed| {
                        listed.station != exchange.follower || history.listed == Some(listed.offer)
                    }))
        }
        Coordination::Follower { session, last, .. } => {
            !is_follower
                || *session != exchange.session
                || (history.joined
                    && last.is_none_or(|report| {
                        report.request != exchange.request
                            || (history.accepted && progress_is_true(history, report.progress))
                    }))
        }
    }
}

/// What the progress of the watched request implies.
pub(super) const fn progress_is_true(history: &History, progress: Progress) -> bool {
    match progress {
        Progress::Executing => history.started,
        Progress::InPosition => history.in_position,
        Progress::Completed => history.completed && history.over,
        Progress::Failed(_) => history.over,
        Progress::SafeIdle => history.fell_back,
    }
}

/// What an RMCM implies.
#[must_use]
pub fn rmcm_is_true(exchange: &Exchange, history: &History, rmcm: Rmcm) -> bool {
    match rmcm {
        Rmcm::Command(Command {
            session,
            to,
            request,
            task,
        }) => {
            (session, to) != (exchange.session, exchange.follower)
                || (exchange.position(request) < RequestId::MAX_PER_SESSION
                    && (request != exchange.request || history.commanded == Some(task)))
        }
        Rmcm::Answer(Answer {
            from,
            session,
            request,
            verdict,
        }) => {
            let is_watched =
                (from, session, request) == (exchange.follower, exchange.session, exchange.request);
            !is_watched
                || match verdict {
                    Verdict::Accepted => history.accepted,
                    Verdict::Rejected(_) => history.refused,
                }
        }
    }
}
