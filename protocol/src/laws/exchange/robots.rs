//! Implications between the state of a robot and the history.
//!
//! Each fact that is *not* known is used only where its owner is the robot itself, so that no step of another robot makes
//! this untrue: [`steps::others_leave_it_so`](super::steps::others_leave_it_so).

use super::messages::{progress_is_true, was_heard};
use super::observer::leads;
use super::{Exchange, History, is_given_out};
use crate::id::{RequestId, UniqueNumber};
use crate::laws::part::{record_of, runs};
use crate::message::{Coordination, Progress, Ram};
use crate::state::{
    Following, Identity, Job, Leading, Member, Outstanding, Phase, Requesting, Robot,
};

/// True if robot and history agree. A robot that is neither leader nor follower knows nothing of the exchange.
#[must_use]
pub fn agrees(exchange: &Exchange, history: &History, robot: &Robot) -> bool {
    (!exchange.is_led_by(robot.station) || leader_agrees(exchange, history, robot))
        && (robot.station != exchange.follower || follower_agrees(exchange, history, robot))
}

/// True if robot and history agree on heartbeats, where these [are near](Exchange::is_near).
#[must_use]
pub fn agrees_on_heartbeats(exchange: &Exchange, history: &History, robot: &Robot) -> bool {
    let is_follower = robot.station == exchange.follower;
    match &robot.phase {
        Phase::Requesting(requesting) if leads(exchange, robot) => {
            history.beaten == exchange.has_come(requesting.heartbeat)
        }
        Phase::Leading(leading) if leads(exchange, robot) => {
            let is_so = |member: &Member| {
                member.station != exchange.follower
                    || !member.echoed.is_some_and(|echo| exchange.has_come(echo))
                    || was_heard(history, is_recorded_as_over(exchange, member))
            };
            history.beaten == exchange.has_come(leading.heartbeat)
                && leading.members.iter().all(is_so)
        }
        Phase::Following(following) if is_follower && following.session == exchange.session => {
            history.heard.is_some() == exchange.has_come(following.heard)
        }
        Phase::Idle
        | Phase::Requesting(_)
        | Phase::Offering(_)
        | Phase::Leading(_)
        | Phase::Following(_) => true,
    }
}

/// True if the leader counts the watched request as over.
fn is_recorded_as_over(exchange: &Exchange, member: &Member) -> bool {
    member.order.is_some_and(|order| {
        let newer = exchange.position(order.request) > exchange.place();
        let over = order.progress.is_some_and(|progress| !runs(progress));
        newer || (order.request == exchange.request && over)
    })
}

/// True if all heartbeats that the robot knows of the session [are near](Exchange::is_near).
#[must_use]
pub fn are_near(exchange: &Exchange, robot: &Robot) -> bool {
    let is_near = |heartbeat| exchange.is_near(heartbeat);
    match &robot.phase {
        Phase::Requesting(requesting) if leads(exchange, robot) => is_near(requesting.heartbeat),
        Phase::Leading(leading) if leads(exchange, robot) => {
            let mut members = leading.members.iter();
            is_near(leading.heartbeat) && members.all(|member| member.echoed.is_none_or(is_near))
        }
        Phase::Following(following) if following.session == exchange.session => {
            is_near(following.heard)
        }
        Phase::Idle
        | Phase::Requesting(_)
        | Phase::Offering(_)
        | Phase::Leading(_)
        | Phase::Following(_) => true,
    }
}

fn leader_agrees(exchange: &Exchange, history: &History, robot: &Robot) -> bool {
    let leads = leads(exchange, robot);
    // I15: a number is given out once, and a session that has ended never is again.
    (!history.requested || is_used_up(robot, exchange.session.number.0))
        && leads == (history.requested && !history.ended)
        // I18.
        && !(leads && matches!(robot.identity, Identity::Unlocked))
        && match &robot.phase {
            Phase::Requesting(requesting) if leads => requester_agrees(exchange, history, requesting),
            Phase::Leading(leading) if leads => leading_agrees(exchange, history, leading),
            Phase::Idle
            | Phase::Requesting(_)
            | Phase::Offering(_)
            | Phase::Leading(_)
            | Phase::Following(_) => true,
        }
}

fn requester_agrees(exchange: &Exchange, history: &History, requesting: &Requesting) -> bool {
    let is_watched = (exchange.follower, exchange.offer);
    history.listed.is_none()
        && !history.dropped
        && (history.offered
            || requesting
                .offers
                .iter()
                .all(|offer| (offer.station, offer.number) != is_watched))
}

/// I17: the record of the follower is there until it is dropped itself.
fn leading_agrees(exchange: &Exchange, history: &History, leading: &Leading) -> bool {
    match record_of(leading, exchange.follower) {
        None => history.listed.is_none() || history.dropped,
        Some(member) => {
            history.listed == Some(member.offer)
                && !history.dropped
                && member_agrees(exchange, history, member)
        }
    }
}

fn member_agrees(exchange: &Exchange, history: &History, member: &Member) -> bool {
    (member.echoed.is_none() || history.joined)
        && (history.commanded.is_none()
            || exchange.place() < exchange.position(member.next_request))
        && (history.commanded.is_none()
            || history.refused
            || awaits_or_counts(exchange, member, exchange.request))
        && member.outstanding.is_none_or(|outstanding| {
            outstanding.request != exchange.request || history.commanded == Some(outstanding.task)
        })
        // I6, I8: requests that the leader counts as accepted or reached.
        && member.order.is_none_or(|order| {
            order.request != exchange.request
                || (history.commanded == Some(order.task)
                    && history.accepted
                    && order.progress.is_none_or(|progress| match progress {
                        // The leader's own execution limit is a failure too.
                        Progress::Failed(_) => true,
                        Progress::Executing
                        | Progress::InPosition
                        | Progress::Completed
                        | Progress::SafeIdle => progress_is_true(history, progress),
                    }))
        })
}

/// True if the leader waits for the answer to a request, or counts this or a newer one as accepted.
fn awaits_or_counts(exchange: &Exchange, member: &Member, request: RequestId) -> bool {
    let is_awaited = |outstanding: Outstanding| outstanding.request == request;
    let position = exchange.position(request);
    member.outstanding.is_some_and(is_awaited)
        || member
            .order
            .is_some_and(|order| position <= exchange.position(order.request))
}

/// The theorem about the exchange with the request that a RAM of the follower reports, which is another one than the
/// watched: it was accepted, so it was commanded and not refused, and the leader waits for its answer or counts it.
#[must_use]
pub fn can_report(exchange: &Exchange, robot: &Robot, ram: &Ram) -> bool {
    let (Phase::Leading(leading), Coordination::Follower { session, last, .. }) =
        (&robot.phase, &ram.coordination)
    else {
        return true;
    };
    if ram.station != exchange.follower || *session != exchange.session || !leads(exchange, robot) {
        return true;
    }
    match (record_of(leading, exchange.follower), last) {
        (Some(member), Some(report)) => awaits_or_counts(exchange, member, report.request),
        _ => true,
    }
}

fn follower_agrees(exchange: &Exchange, history: &History, robot: &Robot) -> bool {
    let following = match &robot.phase {
        Phase::Following(following) if following.session == exchange.session => Some(following),
        Phase::Idle
        | Phase::Requesting(_)
        | Phase::Offering(_)
        | Phase::Leading(_)
        | Phase::Following(_) => None,
    };
    // I15: a robot that has left never enters the session again, because the offer is never made again.
    following.is_some() == (history.joined && !history.left)
        && (!history.joined
            || history
                .listed
                .is_some_and(|offer| is_used_up(robot, offer.0)))
        && match following {
            // I14.
            None => !history.runs(),
            Some(following) => {
                // I1, I2, I18.
                !exchange.is_led_by(robot.station)
                    && history.listed == Some(following.offer)
                    && !matches!(robot.identity, Identity::Unlocked)
                    && following_agrees(exchange, history, following)
            }
        }
}

/// True if the robot never gives out this number again: sessions and offers have theirs from one counter, and only the
/// number of an offer that stands is taken back.
fn is_used_up(robot: &Robot, number: UniqueNumber) -> bool {
    let stands = matches!(&robot.phase, Phase::Offering(offering) if offering.number.0 == number);
    is_given_out(number, robot.next_number()) && !stands
}

fn following_agrees(exchange: &Exchange, history: &History, following: &Following) -> bool {
    let is_of_session = |request| exchange.position(request) < RequestId::MAX_PER_SESSION;
    let job = following.job;
    let accepted = job.map(|job| exchange.position(job.request));
    let refused = following.refused.map(|it| exchange.position(it.request));
    let is_behind = |newest: Option<u8>| newest.is_some_and(|it| exchange.place() <= it);
    job.is_none_or(|job| is_of_session(job.request))
        && following.refused.is_none_or(|it| is_of_session(it.request))
        // I4, I5: an answered request is not answered anew.
        && (!history.accepted || is_behind(accepted))
        && (!history.refused || is_behind(refused) || is_behind(accepted))
        && (!history.newer_started || accepted.is_some_and(|it| exchange.place() < it))
        && (refused != Some(exchange.place()) || history.refused)
        && match job.filter(|job| job.request == exchange.request) {
            None => !history.runs(),
            Some(job) => job_agrees(history, job),
        }
}

/// I9, I14: the body executes exactly what the state says.
fn job_agrees(history: &History, job: Job) -> bool {
    history.accepted
        && history.commanded == Some(job.task)
        && progress_is_true(history, job.progress)
        && history.runs() == runs(job.progress)
}
