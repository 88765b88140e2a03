//! Implications of a message for the history. Facts stay known, so they stay true, however late, often and in whatever
//! order the message arrives.
//!
//! A message of a robot that is neither leader nor follower of the exchange implies nothing of it; nor does a farewell: no
//! property rests on what it says. Each `match` names all messages, so that a new one has to be given a meaning here.

use super::{Exchange, Heard, History};
use crate::id::{RequestId, SessionId};
use crate::laws::part::runs;
use crate::message::{
    Answer, Command, Coordination, Farewell, Progress, Ram, Report, Rmcm, Verdict,
};

/// Implications of a RAM.
#[must_use]
pub fn ram_is_true(exchange: &Exchange, history: &History, ram: &Ram) -> bool {
    match ram.farewell {
        None | Some(Farewell::Ended(..) | Farewell::Left(..)) => {}
    }
    let is_leader = exchange.is_led_by(ram.station);
    let is_follower = ram.station == exchange.follower;
    match &ram.coordination {
        Coordination::None => true,
        Coordination::NeedHelp {
            number, heartbeat, ..
        } => {
            !is_leader
                || *number != exchange.session.number
                || (history.requested && (history.beaten || !exchange.has_come(*heartbeat)))
        }
        Coordination::OfferHelp { session, offer, .. } => {
            let is_watched = *session == exchange.session && *offer == exchange.offer;
            !is_follower || !is_watched || history.offered
        }
        Coordination::Leader {
            number,
            heartbeat,
            followers,
            ..
        } => {
            !is_leader
                || *number != exchange.session.number
                || (history.requested
                    && (history.beaten || !exchange.has_come(*heartbeat))
                    && followers.iter().all(|listed| {
                        listed.station != exchange.follower || history.listed == Some(listed.offer)
                    }))
        }
        Coordination::Follower {
            session,
            echo,
            last,
            ..
        } => {
            !is_follower
                || *session != exchange.session
                || (history.joined
                    && (!exchange.has_come(*echo)
                        || was_heard(history, says_over(exchange, *last)))
                    && last.is_none_or(|report| {
                        report.request != exchange.request
                            || (history.accepted && progress_is_true(history, report.progress))
                    }))
        }
    }
}

/// True if the follower has heard the watched heartbeat, and before the end of the watched request, where nothing says that
/// this is over.
pub(super) const fn was_heard(history: &History, is_over: bool) -> bool {
    match history.heard {
        None => false,
        Some(Heard::BeforeTheEnd) => true,
        Some(Heard::AfterTheEnd) => is_over,
    }
}

/// True if a report says that the watched request is over.
fn says_over(exchange: &Exchange, last: Option<Report>) -> bool {
    last.is_some_and(|report| {
        let newer = exchange.position(report.request) > exchange.place();
        newer || (report.request == exchange.request && !runs(report.progress))
    })
}

/// Implications of the progress of the watched request.
pub(super) const fn progress_is_true(history: &History, progress: Progress) -> bool {
    match progress {
        Progress::Executing => history.started,
        Progress::InPosition => history.in_position,
        Progress::Completed => history.completed && history.over,
        Progress::Failed(_) => history.over,
        Progress::SafeIdle => history.fell_back,
    }
}

/// True if the heartbeat of the session that a RAM tells [is near](Exchange::is_near).
#[must_use]
pub fn is_near(exchange: &Exchange, ram: &Ram) -> bool {
    let (session, heartbeat) = match ram.coordination {
        Coordination::None | Coordination::OfferHelp { .. } => return true,
        Coordination::NeedHelp {
            number, heartbeat, ..
        }
        | Coordination::Leader {
            number, heartbeat, ..
        } => (SessionId::of(ram.station, number), heartbeat),
        Coordination::Follower { session, echo, .. } => (session, echo),
    };
    session != exchange.session || exchange.is_near(heartbeat)
}

/// Implications of an RMCM.
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
