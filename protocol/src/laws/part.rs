//! The part that a robot has in a session, as the laws read it.

use crate::id::{ManeuverId, RequestId, SessionId, StationId, UniqueNumber};
use crate::list::List;
use crate::message::Progress;
use crate::output::Maneuver;
use crate::state::{Following, Leading, Member, Offer, Phase, Requesting, Robot};

use super::arithmetic::request_is_newer;

pub(super) fn following(robot: &Robot) -> Option<&Following> {
    match robot.phase() {
        Phase::Following(following) => Some(following),
        _ => None,
    }
}

pub(super) fn leading(robot: &Robot) -> Option<&Leading> {
    match robot.phase() {
        Phase::Leading(leading) => Some(leading),
        _ => None,
    }
}

/// The record of `station` among a leader's followers.
pub(super) fn record_of(leading: &Leading, station: StationId) -> Option<&Member> {
    leading
        .members
        .iter()
        .find(|member| member.station == station)
}

pub(super) fn requesting(robot: &Robot) -> Option<&Requesting> {
    match robot.phase() {
        Phase::Requesting(requesting) => Some(requesting),
        _ => None,
    }
}

/// True if the body executes a command with this progress.
pub(super) const fn runs(progress: Progress) -> bool {
    match progress {
        Progress::Executing | Progress::InPosition => true,
        Progress::Completed | Progress::Failed(_) | Progress::SafeIdle => false,
    }
}

/// The maneuver that the robot believes to be running.
pub(super) fn executing(robot: &Robot) -> Option<Maneuver> {
    let following = following(robot)?;
    let job = following.job.filter(|job| runs(job.progress))?;
    let id = ManeuverId::of(following.session, job.request);
    Some(Maneuver { id, task: job.task })
}

/// True if a request is newer than all that the follower has answered.
pub(super) fn is_newer_than_all(request: RequestId, following: &Following) -> bool {
    let is_newer = |answered| request_is_newer(request, answered);
    following.job.is_none_or(|job| is_newer(job.request))
        && following.refused.is_none_or(|it| is_newer(it.request))
}

/// The session that a robot has a part in, and its own number for that part.
pub(super) fn own_number(robot: &Robot) -> Option<(SessionId, UniqueNumber)> {
    let number = match robot.phase() {
        Phase::Idle => return None,
        Phase::Requesting(requesting) => requesting.number.0,
        Phase::Offering(offering) => offering.number.0,
        Phase::Leading(leading) => leading.number.0,
        Phase::Following(following) => following.offer.0,
    };
    robot.session().map(|session| (session, number))
}

/// Gives `law` each follower of `robot`, and the record of its station in `other`.
pub(super) fn each_follower(
    robot: &Robot,
    other: &Robot,
    law: impl FnMut(&Member, Option<&Member>),
) {
    if let Some(leads) = leading(robot) {
        let others = leading(other).map(|other| &other.members);
        each_beside(&leads.members, others, |it| it.station, law);
    }
}

/// Gives `law` each offer that `robot` has heard, and that of its station in `other`.
pub(super) fn each_offer(
    robot: &Requesting,
    other: &Requesting,
    law: impl FnMut(&Offer, Option<&Offer>),
) {
    each_beside(&robot.offers, Some(&other.offers), |it| it.station, law);
}

/// Gives `law` each item, and the one of the same station among the others. Both loops count over slots: to a
/// proof, an item that was found among four is one at any place, which is most of what it would be about.
fn each_beside<T: Copy, const N: usize>(
    items: &List<T, N>,
    others: Option<&List<T, N>>,
    station: impl Fn(&T) -> StationId,
    mut law: impl FnMut(&T, Option<&T>),
) {
    for item in items.iter() {
        let mut is_among_them = false;
        if let Some(others) = others {
            for other in others.iter() {
                if station(other) == station(item) {
                    is_among_them = true;
                    law(item, Some(other));
                }
            }
        }
        if !is_among_them {
            law(item, None);
        }
    }
}
