//! The part that a robot has in a session, as the laws read it.

use crate::id::{ManeuverId, SessionId, UniqueNumber};
use crate::message::Progress;
use crate::output::Maneuver;
use crate::state::{Following, Leading, Phase, Requesting, Robot};

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

pub(super) fn requesting(robot: &Robot) -> Option<&Requesting> {
    match robot.phase() {
        Phase::Requesting(requesting) => Some(requesting),
        _ => None,
    }
}

/// Whether the body executes a command with this progress.
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
    let id = ManeuverId {
        session: following.session,
        request: job.request,
    };
    Some(Maneuver { id, task: job.task })
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
