//! Laws of one step that reach the road: the corridor, duties, policies, and which of two robots gives way.
//!
//! The rules are written here once more, from the records of a state and from the input alone. None
//! of these laws calls the function of the protocol that it judges.

use crate::config::Config;
use crate::id::SessionId;
use crate::input::{Event, Input};
use crate::message::{Coordination, Ending, Farewell, Progress};
use crate::output::{EndReason, OutputKind, ReleaseReason, StopReason};
use crate::state::{Corridor, Duty, Identity, Member, Rival, Robot, Role};
use crate::task::{Availability, Place, TaskType, Unavailability};
use crate::time::Millis;

use super::arithmetic::{beat_is_newer, left_ms};
use super::commands::may_guard;
use super::lease::lease_left;
use super::part::{each_follower, executing, following, leading, requesting};
use super::taken::Taken;
use super::watch::is_open;

/// All laws of this module.
pub fn all(config: &Config, step: &Taken) {
    the_corridor_is_open_only_over_guards(config, step);
    go_is_a_lease(step);
    the_road_is_cleared_by_the_application(step);
    guards_are_kept_on_the_road(config, step);
    ends_follow_the_policy(config, step);
    own_sight_lasts_until_the_road_is_clear(step);
    ends_say_how(step);
    a_duty_lasts_until_the_road_is_clear(step);
    way_is_given_at_the_second_message(step);
    the_first_rival_is_noted(step);
}

/// True if the records of a follower say that it guards: nothing is outstanding, its task guards, it was
/// reported to be at it and, where the task guards from a place, there; and the lease stands.
fn is_on_guard(config: &Config, member: &Member) -> bool {
    let settings = config.settings();
    let Some(order) = member.order else {
        return false;
    };
    let bit = 1_u16 << order.task.value();
    let from_a_place = settings.holding.0 & bit != 0;
    let is_at_it = match order.progress {
        Some(Progress::InPosition) => true,
        Some(Progress::Executing) => !from_a_place,
        None | Some(Progress::Completed | Progress::Failed(_) | Progress::SafeIdle) => false,
    };
    is_at_it
        && settings.guarding.0 & bit != 0
        && member.outstanding.is_none()
        && lease_left(member) > Millis::ZERO
}

/// I11, W1: the corridor is open only while all followers that were asked for guard, and no leader that goes
/// before is known. Only the application opens it, and only where a crossing that begins can end.
pub fn the_corridor_is_open_only_over_guards(config: &Config, step: &Taken) {
    if !is_open(&step.after) {
        return;
    }
    let Some(after) = leading(&step.after) else {
        return;
    };
    assert!(after.yields_to.is_none());
    let mut guards = 0;
    for member in after.members.iter() {
        assert!(is_on_guard(config, member));
        guards += 1;
    }
    assert!(guards >= after.request.followers);
    if is_open(&step.before) {
        return;
    }
    assert!(step.input == Input::Local(Event::OpenCorridor));
    let t_cross = u64::from(config.settings().t_cross.0);
    assert!(match step.after.identity() {
        Identity::Locked(lock) => left_ms(lock) >= t_cross,
        Identity::Unlocked | Identity::Expiring => false,
    });
    for member in after.members.iter() {
        let execution = member.order.map(|order| left_ms(order.execution));
        assert!(execution.is_some_and(|left| left >= t_cross));
    }
}

/// W5: *go* is told for no longer than the shortest lease lasts, when the corridor opens and in each step
/// that prolongs a lease.
pub fn go_is_a_lease(step: &Taken) {
    let Some(after) = leading(&step.after) else {
        assert!(step.said.shown.is_none());
        return;
    };
    if let Some(shown) = step.said.shown {
        assert!(is_open(&step.after) && shown > Millis::ZERO);
        for member in after.members.iter() {
            assert!(shown <= lease_left(member));
        }
    }
    if !is_open(&step.after) {
        return;
    }
    let mut is_prolonged = false;
    each_follower(&step.after, &step.before, |member, known| {
        is_prolonged |= known.is_none_or(|known| lease_left(known) < lease_left(member));
    });
    if is_prolonged || !is_open(&step.before) {
        assert!(step.said.shown.is_some());
    }
}

/// W2, W4: a corridor that was open is clear only once the application says so, or with a completed
/// crossing.
pub fn the_road_is_cleared_by_the_application(step: &Taken) {
    let Some(before) = leading(&step.before) else {
        return;
    };
    if before.corridor == Corridor::Clear {
        return;
    }
    let cleared = match leading(&step.after) {
        Some(after) => after.corridor == Corridor::Clear,
        None => step.after.duty().is_none(),
    };
    if cleared {
        assert!(match step.input {
            Input::Local(Event::RoadClear) => before.corridor == Corridor::Clearing,
            Input::Local(Event::TaskCompleted) => true,
            _ => false,
        });
    }
}

/// W2: while people may be on the road, no follower that guards or may guard is commanded, and the session
/// is not renewed.
pub fn guards_are_kept_on_the_road(config: &Config, step: &Taken) {
    let Some(before) = leading(&step.before) else {
        return;
    };
    if before.corridor == Corridor::Clear {
        return;
    }
    assert!(step.said.ended != Some(EndReason::Renewed));
    each_follower(&step.after, &step.before, |member, known| {
        if known.is_some_and(|it| may_guard(config, it) && it.outstanding.is_none()) {
            assert!(member.outstanding.is_none());
        }
    });
}

/// How the input ends `session`, where it is a RAM of its leader that names it.
pub(super) fn ending_told(step: &Taken, session: SessionId) -> Option<Ending> {
    let Input::Ram { ram, .. } = step.input else {
        return None;
    };
    match ram.farewell {
        Some(Farewell::Ended(number, ending))
            if ram.station == session.leader && number == session.number =>
        {
            Some(ending)
        }
        _ => None,
    }
}

/// I9, W2: a maneuver that ends otherwise than by its own application ends by its task's policy, and leaves
/// a duty. It is stopped only for a newer command, when the crossing is completed, and when the body is not
/// the robot's own to command.
pub fn ends_follow_the_policy(config: &Config, step: &Taken) {
    if let Some((maneuver, policy)) = step.said.fallen_back {
        assert!(policy == config.settings().fallback[usize::from(maneuver.task.value())]);
        assert!(step.after.duty() == Some(Duty::FallingBack(maneuver)));
        assert!(!is_body_lost(step));
    }
    if let Some(maneuver) = executing(&step.before)
        && ending_told(step, maneuver.id.session) == Some(Ending::Completed)
    {
        let sees_people = following(&step.before).is_some_and(|before| before.sees_people);
        assert!(step.said.stopped.is_some() != sees_people);
        assert!(step.said.fallen_back.is_some() == sees_people);
    }
    let Some((maneuver, why)) = step.said.stopped else {
        return;
    };
    assert!(match why {
        StopReason::Superseded => step.said.has(OutputKind::StartManeuver),
        StopReason::Released(why) => {
            why == ReleaseReason::TaskCompleted
                && ending_told(step, maneuver.id.session) == Some(Ending::Completed)
        }
        StopReason::Unavailable(why) => {
            let told = Availability::Unavailable(why);
            step.input == Input::Local(Event::AvailabilityChanged(told)) && is_body_lost(step)
        }
    });
}

/// True if the application says that the body is not the robot's own to command any more.
fn is_body_lost(step: &Taken) -> bool {
    matches!(
        step.input,
        Input::Local(Event::AvailabilityChanged(Availability::Unavailable(
            Unavailability::Teleoperated
                | Unavailability::EmergencyStop
                | Unavailability::LocalFault
        )))
    )
}

/// W2: a follower sees people on the road from when its own application says so until that says that the road is clear.
pub fn own_sight_lasts_until_the_road_is_clear(step: &Taken) {
    let Some(after) = following(&step.after) else {
        return;
    };
    let saw = following(&step.before).is_some_and(|before| before.sees_people);
    assert!(
        after.sees_people
            == match step.input {
                Input::Local(Event::PersonOnRoad) => true,
                Input::Local(Event::RoadClear) => false,
                _ => saw,
            }
    );
}

/// W2: a session is named as completed exactly where its application said so.
pub fn ends_say_how(step: &Taken) {
    let (Some(why), Some(session)) = (step.said.ended, step.before.session()) else {
        return;
    };
    let completed = step.input == Input::Local(Event::TaskCompleted);
    assert!((why == EndReason::TaskCompleted) == completed);
    match step.after.farewell() {
        Some(Farewell::Ended(number, ending)) if number == session.number => {
            assert!((ending == Ending::Completed) == completed);
        }
        _ => assert!(step.after.identity() == Identity::Expiring || !step.after.is_bound()),
    }
}

/// True if to do this task in this session is to go on with what the robot fell back from.
pub(super) fn takes_up(duty: Duty, session: SessionId, task: TaskType) -> bool {
    match duty {
        Duty::FallingBack(maneuver) => (maneuver.id.session, maneuver.task) == (session, task),
        Duty::Crossing(_) => false,
    }
}

/// W4: a duty lasts until the application says that the road is clear, or the leader for which the robot fell back
/// commands the same again. Until then nothing is started, asked for or offered. A duty comes from a fallback, or from a
/// session that ended with people on the road.
pub fn a_duty_lasts_until_the_road_is_clear(step: &Taken) {
    let (before, after) = (&step.before, &step.after);
    if let Some(duty) = before.duty() {
        if step.input == Input::Local(Event::RoadClear) {
            assert!(after.duty().is_none());
            return;
        }
        if let Some(started) = step.said.started {
            assert!(takes_up(duty, started.id.session, started.task) && after.duty().is_none());
            return;
        }
        assert!(after.duty() == Some(duty));
        assert!(!step.said.has(OutputKind::StartManeuver));
        assert!(match after.role() {
            Role::None => true,
            Role::Follower => after.session() == before.session(),
            Role::Requester | Role::Helper | Role::Leader => false,
        });
        return;
    }
    match after.duty() {
        None => {}
        Some(Duty::FallingBack(maneuver)) => {
            assert!(executing(before) == Some(maneuver));
            assert!(step.said.has(OutputKind::FallBack));
        }
        Some(Duty::Crossing(session)) => {
            assert!(before.session() == Some(session) && step.said.ended.is_some());
            assert!(leading(before).is_some_and(|before| before.corridor != Corridor::Clear));
        }
    }
}

/// The request in the input, or the leader that has not yielded, that goes before `robot` at what may be the same place.
fn claim_that_counts(robot: &Robot, input: &Input) -> Option<Rival> {
    let Input::Ram { ram, .. } = *input else {
        return None;
    };
    let (number, heartbeat, urgency, place, leads) = match ram.coordination {
        Coordination::NeedHelp {
            number,
            heartbeat,
            request,
        } => (number, heartbeat, request.urgency, request.place, false),
        Coordination::Leader {
            number,
            heartbeat,
            urgency,
            place,
            yields: false,
            ..
        } => (number, heartbeat, urgency, place, true),
        _ => return None,
    };
    if ram.station == robot.station() {
        return None;
    }
    let (own, asks) = match (requesting(robot), leading(robot)) {
        (Some(requesting), _) => (requesting.request, true),
        (_, Some(leading)) => (leading.request, false),
        _ => return None,
    };
    let may_be_one = place == own.place || place == Place::UNKNOWN || own.place == Place::UNKNOWN;
    let goes_before =
        urgency > own.urgency || (urgency == own.urgency && ram.station < robot.station());
    // A request does not move a leader, and a leader goes before every request.
    let counts = if asks {
        leads || goes_before
    } else {
        leads && goes_before
    };
    let session = SessionId::of(ram.station, number);
    (may_be_one && counts).then_some(Rival { session, heartbeat })
}

/// The rival that a requester or leader has noted.
fn noted(robot: &Robot) -> Option<Rival> {
    let rival = requesting(robot).map(|requesting| requesting.rival);
    let rival = rival.or_else(|| leading(robot).map(|leading| leading.rival));
    rival.flatten()
}

/// True if the input is the second one of rivals that go before `robot` at what may be the same place: of another session than
/// the first, or with a newer heartbeat.
fn hears_a_second_rival(robot: &Robot, input: &Input) -> Option<SessionId> {
    let (heard, first) = (claim_that_counts(robot, input)?, noted(robot)?);
    let is_newer = beat_is_newer(heard.heartbeat, first.heartbeat);
    (first.session != heard.session || is_newer).then_some(heard.session)
}

/// W3: a requester withdraws and a leader yields at the second message of rivals that go before at its place, whichever they
/// are, and never at one alone. A leader that yields does so until it ends.
pub fn way_is_given_at_the_second_message(step: &Taken) {
    let again = hears_a_second_rival(&step.before, &step.input).map(|session| session.leader);
    let yielded_before = leading(&step.before).and_then(|before| before.yields_to);
    if let Some(EndReason::Withdrawn(other)) = step.said.ended {
        let is_cleared = step.input == Input::Local(Event::RoadClear);
        assert!(again == Some(other) || (is_cleared && yielded_before == Some(other)));
    }
    let Some(after) = leading(&step.after) else {
        return;
    };
    match (yielded_before, after.yields_to) {
        (Some(before), other) => assert!(other == Some(before)),
        (None, Some(other)) => {
            assert!(again == Some(other) && after.corridor == Corridor::Clearing);
        }
        (None, None) => {
            assert!(again.is_none() || leading(&step.before).is_none());
        }
    }
}

/// W3: the first rival that is heard stays noted as long as the session goes on: none that is heard later, and no time, hides it.
pub fn the_first_rival_is_noted(step: &Taken) {
    if step.before.session().is_none() || step.before.session() != step.after.session() {
        return;
    }
    let begins_to_lead = leading(&step.before).is_none() && leading(&step.after).is_some();
    let has_yielded = leading(&step.before).is_some_and(|before| before.yields_to.is_some());
    let heard = claim_that_counts(&step.before, &step.input).filter(|_| !has_yielded);
    assert!(begins_to_lead || noted(&step.after) == noted(&step.before).or(heard));
}
