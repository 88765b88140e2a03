//! Laws of commands: which a leader gives, how a follower answers, and what its body says of them.

use crate::config::Config;
use crate::id::RequestId;
use crate::input::{Event, Input};
use crate::message::{Command, Failure, Progress, Rejection, Rmcm, Verdict};
use crate::output::{EndReason, OutputKind};
use crate::state::{Corridor, Member, Robot};
use crate::task::Availability;

use super::part::{
    each_follower, executing, following, is_newer_than_all, leading, record_of, requesting,
};
use super::road::takes_up;
use super::taken::Taken;

/// All laws of this module.
pub fn all(config: &Config, step: &Taken) {
    commands_are_given_where_they_may_be(config, step);
    one_command_stands_at_a_time(step);
    a_renewed_session_asks_for_the_same(step);
    each_command_is_answered(config, step);
    the_body_is_believed(step);
}

/// True if no command may take this follower off its task while people may be on the road: what it is at, or
/// may be at, guards them.
pub(super) fn may_guard(config: &Config, member: &Member) -> bool {
    member.order.is_some_and(|order| {
        let may_be_at_it = match order.progress {
            None | Some(Progress::Executing | Progress::InPosition) => true,
            // The limit is the leader's own: the follower knows nothing of it and goes on.
            Some(Progress::Failed(failure)) => failure == Failure::ExecutionLimit,
            Some(Progress::Completed | Progress::SafeIdle) => false,
        };
        may_be_at_it && config.settings().guarding.0 >> order.task.value() & 1 == 1
    })
}

/// L2, W7: a leader's application commands a follower that has joined and has answered all before, unless that
/// guards people on the road. Where the numbers of the session are used up, the session is renewed.
pub fn commands_are_given_where_they_may_be(config: &Config, step: &Taken) {
    let Input::Local(Event::CommandManeuver { follower, task }) = step.input else {
        return;
    };
    let before = leading(&step.before);
    let ready = before.and_then(|before| {
        let member = record_of(before, follower)?;
        (member.echoed.is_some() && member.outstanding.is_none()).then_some((before, member))
    });
    let Some((before, member)) = ready else {
        assert!(step.is_ignored());
        return;
    };
    let first = config.settings().first_request;
    let is_used_up = member.next_request.0.wrapping_sub(first.0) >= RequestId::MAX_PER_SESSION;
    let on_road = before.corridor != Corridor::Clear;
    if on_road && (is_used_up || may_guard(config, member)) {
        assert!(step.is_ignored());
    } else if is_used_up {
        let is_out_of_numbers = step.before.next_number().count == u16::MAX;
        assert!(step.is_ignored() == is_out_of_numbers);
        assert!((step.said.ended == Some(EndReason::Renewed)) != is_out_of_numbers);
    } else {
        assert!(step.said.commanded);
        let after = leading(&step.after).and_then(|after| record_of(after, follower));
        assert!(after.is_some_and(|after| {
            after.outstanding.is_some_and(|outstanding| {
                (outstanding.request, outstanding.task) == (member.next_request, task)
                    && outstanding.repeats == 0
            })
        }));
    }
}

/// L2: no other command takes the place of one that is not answered yet.
pub fn one_command_stands_at_a_time(step: &Taken) {
    each_follower(&step.after, &step.before, |member, known| {
        let stood = known.and_then(|known| known.outstanding);
        if let (Some(stood), Some(stands)) = (stood, member.outstanding) {
            assert!(stood.request == stands.request);
        }
    });
}

/// A session that is renewed asks for the same again, at once.
pub fn a_renewed_session_asks_for_the_same(step: &Taken) {
    if step.said.ended == Some(EndReason::Renewed) {
        let (before, after) = (leading(&step.before), requesting(&step.after));
        assert!(before.map(|b| b.request) == after.map(|a| a.request) && after.is_some());
    }
}

/// Why a robot must reject a command.
fn refusal(config: &Config, robot: &Robot, command: Command) -> Option<Rejection> {
    let can = config.settings().capabilities.0 >> command.task.value() & 1 == 1;
    match (robot.availability(), robot.duty()) {
        (Availability::Unavailable(why), _) => Some(Rejection::Unavailable(why)),
        (_, Some(duty)) if !takes_up(duty, command.session, command.task) => {
            Some(Rejection::OnDuty)
        }
        _ if !can => Some(Rejection::UnsupportedTask),
        _ => None,
    }
}

/// I4, I5, I6, L2: a follower answers each command of its leader, one that it has answered before by the same
/// words and without any effect, and takes on each new one that nothing stands against.
pub fn each_command_is_answered(config: &Config, step: &Taken) {
    let (Input::Rmcm(Rmcm::Command(command)), Some(before)) = (step.input, following(&step.before))
    else {
        return;
    };
    if command.to != step.before.station() || command.session != before.session {
        return;
    }
    let answered = step.said.answered;
    let refused = before.refused.filter(|r| r.request == command.request);
    let accepted = before.job.filter(|job| job.request == command.request);
    let known = refused.map(|refused| Verdict::Rejected(refused.reason));
    if let Some(verdict) = known.or(accepted.map(|_| Verdict::Accepted)) {
        assert!(answered == Some((command.request, verdict)));
        assert!(step.after == step.before && step.said.len() == 1);
        return;
    }
    if !is_newer_than_all(command.request, before) {
        assert!(step.is_ignored());
        return;
    }
    let after = following(&step.after);
    if let Some(reason) = refusal(config, &step.before, command) {
        assert!(answered == Some((command.request, Verdict::Rejected(reason))));
        let refused = after.and_then(|after| after.refused);
        assert!(refused.is_some_and(|r| (r.request, r.reason) == (command.request, reason)));
        assert!(after.is_some_and(|after| after.job == before.job));
    } else {
        assert!(answered == Some((command.request, Verdict::Accepted)));
        assert!(step.said.has(OutputKind::StartManeuver));
        assert!(after.is_some_and(|after| {
            after.refused.is_none()
                && after.job.is_some_and(|job| {
                    (job.request, job.task) == (command.request, command.task)
                        && job.progress == Progress::Executing
                })
        }));
    }
}

/// I8: the robot reports the words of its body about the maneuver that runs; about any other they are ignored.
pub fn the_body_is_believed(step: &Taken) {
    let (id, told) = match step.input {
        Input::Local(Event::InPosition(id)) => (id, Progress::InPosition),
        Input::Local(Event::OutOfPosition(id)) => (id, Progress::Executing),
        Input::Local(Event::ManeuverCompleted(id)) => (id, Progress::Completed),
        Input::Local(Event::ManeuverFailed(id)) => (id, Progress::Failed(Failure::Maneuver)),
        _ => return,
    };
    let runs = executing(&step.before).is_some_and(|maneuver| maneuver.id == id);
    let job = |robot| following(robot).and_then(|following| following.job);
    let is_news = runs && job(&step.before).is_some_and(|job| job.progress != told);
    assert!(step.is_ignored() != is_news);
    if is_news {
        assert!(job(&step.after).is_some_and(|job| job.progress == told));
    }
}
