//! One step, as the laws read it.

use crate::config::Config;
use crate::id::{ManeuverId, OfferNumber, SessionId, StationId, UniqueNumber};
use crate::input::Input;
use crate::message::{Coordination, Progress, Rmcm};
use crate::output::Maneuver;
use crate::state::{Following, Leading, Phase, Requesting, Robot};

use super::watch::{Sort, Watch};

/// One step: the state before, the input, and what came of it.
#[derive(Clone, Debug)]
pub struct Taken {
    /// The state before.
    pub before: Robot,
    /// The input.
    pub input: Input,
    /// What is to be done.
    pub said: Watch,
    /// The state after.
    pub after: Robot,
}

impl Taken {
    /// Takes the step.
    #[must_use]
    pub fn new(config: &Config, before: Robot, input: Input) -> Self {
        let mut after = before.clone();
        let mut said = Watch::new(&before, &input);
        after.step_into(config, input, &mut said);
        Self {
            before,
            input,
            said,
            after,
        }
    }

    /// The station that sent the message which is the input.
    pub(super) const fn sender(&self) -> Option<StationId> {
        Some(match &self.input {
            Input::Ram { ram, .. } => ram.station,
            Input::Rmcm(Rmcm::Command(command)) => command.session.leader,
            Input::Rmcm(Rmcm::Answer(answer)) => answer.from,
            _ => return None,
        })
    }

    /// Whether the input was ignored.
    #[must_use]
    pub fn is_ignored(&self) -> bool {
        self.said.has(Sort::Ignored)
    }
}

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

/// Whether the input is a RAM of the leader of `session` that lists this robot by `offer`.
pub(super) fn is_listed(step: &Taken, session: SessionId, offer: OfferNumber) -> bool {
    let Input::Ram { ram, .. } = step.input else {
        return false;
    };
    match ram.coordination {
        Coordination::Leader {
            number, followers, ..
        } => {
            let me = step.before.station();
            ram.station == session.leader
                && number == session.number
                && followers
                    .iter()
                    .any(|listed| listed.station == me && listed.offer == offer)
        }
        _ => false,
    }
}
