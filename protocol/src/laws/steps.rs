//! Laws of one step from a valid state: what the properties of the design say about one robot.
//!
//! They hold for any valid state, so that with [`keeps_the_state_valid`] they hold in runs of any
//! length and among peers that say anything. Each law is named with its property.

use crate::MAX_OUTPUTS;
use crate::config::Config;
use crate::id::{Heartbeat, RequestId, SessionId, StationId};
use crate::input::{Event, Input};
use crate::message::{Coordination, Failure, Progress, Ram, Rmcm, Verdict};
use crate::output::Maneuver;
use crate::state::{Contact, Following, Identity, Leading, Lease, Member, Phase, Robot};
use crate::time::Millis;

use super::watch::{Sort, Watch, is_open};

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

    /// Whether the input was ignored.
    #[must_use]
    pub fn is_ignored(&self) -> bool {
        self.said.has(Sort::Ignored)
    }
}

/// All laws of one step.
pub fn all(config: &Config, step: &Taken) {
    keeps_the_state_valid(config, step);
    all_but_validity(config, step);
}

/// All laws of one step but [`keeps_the_state_valid`], which is as much to prove as these together.
pub fn all_but_validity(config: &Config, step: &Taken) {
    keeps_within_the_outputs(step);
    ignores_without_effect(step);
    tells_the_body(step);
    starts_only_newer_commands(step);
    final_progress_stays(step);
    answers_count_only_when_outstanding(step);
    reports_count_only_when_heard(step);
    a_dropped_follower_leaves_the_others(step);
    keeps_its_numbers(step);
    tells_of_lock_and_corridor(step);
    leases_count_from_the_echoed_heartbeat(config, step);
    contact_is_renewed_only_by_news(step);
}

/// I13: a robot that has just booted is in a valid state.
pub fn boots_into_a_valid_state(config: &Config, station: StationId, boot: u16) {
    assert!(Robot::new(station, boot).is_valid(config));
}

/// I13: the state after a step is valid.
pub fn keeps_the_state_valid(config: &Config, step: &Taken) {
    assert!(step.after.is_valid(config));
}

/// I13: there is room for all outputs.
pub fn keeps_within_the_outputs(step: &Taken) {
    assert!(step.said.len() <= MAX_OUTPUTS);
}

/// I13: an input that is ignored changes nothing and has no other output, and every step has either
/// an output or an effect, or is the passage of time.
pub fn ignores_without_effect(step: &Taken) {
    if step.is_ignored() {
        assert!(step.said.len() == 1);
        assert!(step.after == step.before);
    }
}

fn following(robot: &Robot) -> Option<&Following> {
    match robot.phase() {
        Phase::Following(following) => Some(following),
        _ => None,
    }
}

fn leading(robot: &Robot) -> Option<&Leading> {
    match robot.phase() {
        Phase::Leading(leading) => Some(leading),
        _ => None,
    }
}

/// The maneuver that the robot believes to be running.
fn executing(robot: &Robot) -> Option<Maneuver> {
    following(robot).and_then(Following::executing)
}

/// I14: what the outputs have told the body is what the state believes; a robot without a part in a
/// session executes nothing. Nothing is started over something that runs, and nothing is stopped
/// that does not run.
pub fn tells_the_body(step: &Taken) {
    assert!(step.said.tells_the_body);
    assert!(step.said.running == executing(&step.after));
}

/// I4, I5, I6: a maneuver starts only on a command of the robot's session that is newer than all it
/// has answered, at most one in a step, and behind its acknowledgement.
pub fn starts_only_newer_commands(step: &Taken) {
    assert!(step.said.starts_in_order);
    if let Some(maneuver) = step.said.started {
        assert!(is_newly_commanded(step, maneuver));
    }
}

fn is_newly_commanded(step: &Taken, maneuver: Maneuver) -> bool {
    let (Input::Rmcm(Rmcm::Command(command)), Some(before)) = (step.input, following(&step.before))
    else {
        return false;
    };
    let id = maneuver.id;
    command.to == step.before.station()
        && (command.session, command.request, command.task)
            == (id.session, id.request, maneuver.task)
        && before.session == id.session
        && before
            .job
            .is_none_or(|job| id.request.is_newer_than(job.request))
        && before
            .refused
            .is_none_or(|refused| id.request.is_newer_than(refused.request))
}

/// I9: progress that is final stays as it is while its command is the newest: a maneuver that fell
/// back, failed or was finished is never executed again.
pub fn final_progress_stays(step: &Taken) {
    let (Some(before), Some(after)) = (following(&step.before), following(&step.after)) else {
        return;
    };
    let (Some(job), Some(then)) = (before.job, after.job) else {
        return;
    };
    if before.session == after.session && job.request == then.request && !job.progress.is_running()
    {
        assert!(then == job);
    }
}

/// I7: an answer that is not for the outstanding command changes nothing.
pub fn answers_count_only_when_outstanding(step: &Taken) {
    let Input::Rmcm(Rmcm::Answer(answer)) = step.input else {
        return;
    };
    let is_outstanding = leading(&step.before).is_some_and(|leading| {
        let outstanding = leading
            .member(answer.from)
            .and_then(|member| member.outstanding);
        step.before.session() == Some(answer.session)
            && outstanding.is_some_and(|outstanding| outstanding.request == answer.request)
    });
    assert_eq!(is_outstanding, !step.is_ignored());
}

/// I6, I8: a leader counts a command as acknowledged only if it was outstanding and its follower
/// answered or reported it, and takes over exactly the progress that the follower reported.
pub fn reports_count_only_when_heard(step: &Taken) {
    let (Some(before), Some(after)) = (leading(&step.before), leading(&step.after)) else {
        return;
    };
    for member in after.members.iter() {
        let known = before.member(member.station);
        let (Some(known), Some(order)) = (known, member.order) else {
            assert!(known.is_some());
            continue;
        };
        if known.order.map(|order| order.request) != Some(order.request) {
            assert!(known.outstanding.is_some_and(|outstanding| {
                (outstanding.request, outstanding.task) == (order.request, order.task)
            }));
            assert!(heard_from(step, member) == Some(order.request));
        }
        let progress_before = known
            .order
            .filter(|before| before.request == order.request)
            .and_then(|order| order.progress);
        if order.progress != progress_before {
            assert!(order.progress == reported_by(step, member) || has_run_out(step, member));
        }
    }
}

/// The newest command that a message of the follower speaks for.
fn heard_from(step: &Taken, member: &Member) -> Option<RequestId> {
    match step.input {
        Input::Rmcm(Rmcm::Answer(answer))
            if answer.from == member.station && answer.verdict == Verdict::Accepted =>
        {
            Some(answer.request)
        }
        Input::Ram { ram, .. } if ram.station == member.station => match ram.coordination {
            Coordination::Follower { last, .. } => last.map(|last| last.request),
            _ => None,
        },
        _ => None,
    }
}

/// The progress that a RAM of the follower reports.
fn reported_by(step: &Taken, member: &Member) -> Option<Progress> {
    let Input::Ram {
        ram: Ram {
            station,
            coordination,
            ..
        },
        ..
    } = step.input
    else {
        return None;
    };
    match coordination {
        Coordination::Follower { last, .. } if station == member.station => {
            last.map(|last| last.progress)
        }
        _ => None,
    }
}

/// Whether the execution limit of the follower's command ran out.
fn has_run_out(step: &Taken, member: &Member) -> bool {
    let failed = Some(Progress::Failed(Failure::ExecutionLimit));
    member.order.is_some_and(|order| order.progress == failed)
        && matches!(step.input, Input::Elapsed(_) | Input::Expired(_))
}

/// I17: where a follower is dropped and nothing else can have changed, the records of the others
/// are as they were.
pub fn a_dropped_follower_leaves_the_others(step: &Taken) {
    let (Some(before), Some(after)) = (leading(&step.before), leading(&step.after)) else {
        return;
    };
    // Elapsed time also runs the others' timers.
    let Some(dropped) = step
        .said
        .dropped
        .filter(|_| !matches!(step.input, Input::Elapsed(_)))
    else {
        return;
    };
    assert!(after.member(dropped).is_none());
    if after.members.len() + 1 == before.members.len() {
        for member in before
            .members
            .iter()
            .filter(|member| member.station != dropped)
        {
            assert!(after.member(member.station) == Some(member));
        }
    }
}

/// I15, I18: the boot counter stays, numbers are never given out again, a session or offer that is
/// new has a number that is new, and the station id changes only on its own event while unlocked.
pub fn keeps_its_numbers(step: &Taken) {
    let (before, after) = (&step.before, &step.after);
    assert!(after.boot() == before.boot());
    let (next_before, next) = (before.next_number().count, after.next_number().count);
    assert!(next >= next_before && next - next_before <= 1);
    let own = |robot: &Robot| match robot.phase() {
        Phase::Idle => None,
        Phase::Requesting(requesting) => Some(requesting.number.0),
        Phase::Offering(offering) => Some(offering.number.0),
        Phase::Leading(leading) => Some(leading.number.0),
        Phase::Following(following) => Some(following.offer.0),
    };
    if let Some(number) = own(after)
        && own(before) != Some(number)
    {
        assert!(number == before.next_number() && next == next_before + 1);
    }
    if after.station() != before.station() {
        assert!(matches!(
            step.input,
            Input::Local(Event::IdentityChanged(_))
        ));
        assert!(before.identity() == Identity::Unlocked && before.session().is_none());
    }
}

/// I11, I18: what the outputs have told of corridor and identity lock is what the state believes.
pub fn tells_of_lock_and_corridor(step: &Taken) {
    assert!(step.said.changes_lock_and_corridor);
    assert!(step.said.locked == (step.after.identity() != Identity::Unlocked));
    assert!(step.said.open == is_open(&step.after));
}

/// I10, the leader's half: a lease is granted or prolonged only by an echo, and ends `t_lease` after
/// the echoed heartbeat can have been sent at the earliest.
pub fn leases_count_from_the_echoed_heartbeat(config: &Config, step: &Taken) {
    let (Some(before), Some(after)) = (leading(&step.before), leading(&step.after)) else {
        return;
    };
    for member in after.members.iter() {
        let Lease::Stands(left) = member.lease else {
            continue;
        };
        let left = left.left().unwrap_or(Millis::ZERO);
        let was_left = match before.member(member.station).map(|member| member.lease) {
            Some(Lease::Stands(left)) => left.left().unwrap_or(Millis::ZERO),
            _ => Millis::ZERO,
        };
        if left <= was_left {
            continue;
        }
        let echo = echoed_by(step, member);
        assert!(echo.is_some() && member.echoed == echo);
        let next_ram = step.before.next_ram().unwrap_or(Millis::ZERO);
        let age = echo.map_or(Millis::ZERO, |echo| before.age_of(config, echo, next_ram));
        assert!(left.saturating_add(age) <= config.settings().t_lease);
    }
}

/// The heartbeat that a RAM of the follower echoes.
fn echoed_by(step: &Taken, member: &Member) -> Option<Heartbeat> {
    let Input::Ram { ram, .. } = step.input else {
        return None;
    };
    match ram.coordination {
        Coordination::Follower { echo, .. } if ram.station == member.station => Some(echo),
        _ => None,
    }
}

/// I10, the follower's half: `T_safety` restarts only on a heartbeat or a command that is newer than
/// all before.
pub fn contact_is_renewed_only_by_news(step: &Taken) {
    let (Some(before), Some(after)) = (following(&step.before), following(&step.after)) else {
        return;
    };
    let Contact::Fresh(left) = after.contact else {
        return;
    };
    let is_renewed = match before.contact {
        Contact::Fresh(was_left) => left.left() > was_left.left(),
        Contact::Lost(_) => true,
    };
    if !is_renewed {
        return;
    }
    assert!(match step.input {
        Input::Ram { ram, .. } => match ram.coordination {
            Coordination::Leader {
                number, heartbeat, ..
            } => {
                before.session
                    == SessionId {
                        leader: ram.station,
                        number,
                    }
                    && heartbeat.is_newer_than(before.heard)
                    && after.heard == heartbeat
            }
            _ => false,
        },
        Input::Rmcm(Rmcm::Command(command)) => {
            command.session == before.session
                && before
                    .newest_request()
                    .is_none_or(|n| command.request.is_newer_than(n))
        }
        _ => false,
    });
}
