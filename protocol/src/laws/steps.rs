//! Laws of one step from a valid state: what the properties of the design say about one robot.
//!
//! They hold for any valid state, so that with [`keeps_the_state_valid`] they hold in runs of any
//! length and among peers that say anything. Each law is named with its property.

use crate::MAX_OUTPUTS;
use crate::config::Config;
use crate::id::{OfferNumber, RequestId, SessionId, StationId, UniqueNumber};
use crate::input::{Event, Input};
use crate::message::{Coordination, Failure, Farewell, Progress, Ram, Rmcm, Verdict};
use crate::output::{GoneReason, Maneuver, OutputKind};
use crate::state::{Identity, Leading, Member, Phase, Robot, Role, State};
use crate::time::Millis;

use super::arithmetic::{beat_is_newer, request_is_newer};
use super::lease::{echo_heard, lease_left};
use super::part::{each_follower, executing, following, leading, own_number, record_of, runs};
use super::taken::{Taken, is_listed};
use super::watch::is_open;
use super::{
    budgets, causes, commands, contact, farewells, lease, liars, news, offers, requests, road,
    times,
};

/// All laws of one step but [`keeps_the_state_valid`], which is as much to prove as these together.
pub fn all(config: &Config, step: &Taken) {
    of_part_and_numbers(config, step);
    of_peers(config, step);
    of_the_road(config, step);
}

/// The effect of a step on the robot's part, its numbers and its leases.
pub fn of_part_and_numbers(config: &Config, step: &Taken) {
    keeps_within_the_outputs(step);
    ignores_without_effect(step);
    tells_the_body(step);
    shows_the_state_of_the_paper(step);
    starts_only_newer_commands(step);
    final_progress_stays(step);
    answers_count_only_when_outstanding(step);
    reports_count_only_when_heard(step);
    a_place_counts_by_the_newest_echo(step);
    a_dropped_follower_leaves_the_others(step);
    keeps_its_numbers(step);
    tells_of_lock_and_corridor(step);
    leases_count_from_the_echoed_heartbeat(config, step);
    lease::heartbeats_count_time_alone(step);
    farewells_name_what_was_left(step);
}

/// The effects that peers can have, and how long they take.
pub fn of_peers(config: &Config, step: &Taken) {
    causes::all(step);
    of_peers_for_any_cause(config, step);
}

/// [`of_peers`], but for the causes of what is ignored.
fn of_peers_for_any_cause(config: &Config, step: &Taken) {
    liars::all(step);
    commands::all(config, step);
    budgets::all(config, step);
    contact::all(config, step);
}

/// Offers, news and ends, and the road.
pub fn of_the_road(config: &Config, step: &Taken) {
    farewells::all(step);
    offers::all(config, step);
    requests::all(config, step);
    news::all(step);
    times::all(config, step);
    road::all(config, step);
}

/// An input that is always ignored where the robot is: it changes nothing, and the cause is so. The other laws
/// depend on neither the cause nor the transition function then: [`of_an_ignored_input`] has them for all such inputs at once.
pub fn ignores(_: &Config, step: &Taken) {
    assert!(step.is_ignored());
    ignores_without_effect(step);
    causes::all(step);
}

/// All laws but those of validity and causes, of [`Taken::ignored`].
pub fn of_an_ignored_input(config: &Config, step: &Taken) {
    of_part_and_numbers(config, step);
    of_peers_for_any_cause(config, step);
    of_the_road(config, step);
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
    } else if !matches!(step.input, Input::Elapsed(_) | Input::Expired(_)) {
        assert!(!step.said.is_empty() || step.after != step.before);
    }
}

/// I14: what the outputs have told the body is what the state believes; a robot without a part in a
/// session executes nothing. Nothing is started over something that runs, and nothing is stopped
/// that does not run.
pub fn tells_the_body(step: &Taken) {
    assert!(step.said.tells_the_body);
    assert!(step.said.running == executing(&step.after));
}

/// The state of the paper's model is that of the robot's part, and *executing* exactly while a command of it
/// runs.
pub fn shows_the_state_of_the_paper(step: &Taken) {
    let robot = &step.after;
    let is_at_it = match robot.phase() {
        Phase::Leading(leading) => leading
            .members
            .iter()
            .any(|member| member.order.is_some_and(|o| o.progress.is_none_or(runs))),
        Phase::Following(following) => following.job.is_some_and(|job| runs(job.progress)),
        Phase::Idle | Phase::Requesting(_) | Phase::Offering(_) => false,
    };
    if let Some(leading) = leading(robot) {
        for member in leading.members.iter() {
            let progress = member.order.and_then(|order| order.progress);
            assert!(member.has_completed() == (progress == Some(Progress::Completed)));
        }
    }
    assert!(match robot.state() {
        State::Idle => robot.role() == Role::None,
        State::HelpRequested => matches!(robot.role(), Role::Requester | Role::Helper),
        State::RoleEstablished =>
            matches!(robot.role(), Role::Leader | Role::Follower) && !is_at_it,
        State::ManeuverExecuting => is_at_it,
    });
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
            .is_none_or(|job| request_is_newer(id.request, job.request))
        && before
            .refused
            .is_none_or(|refused| request_is_newer(id.request, refused.request))
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
        let outstanding = record_of(leading, answer.from).and_then(|member| member.outstanding);
        step.before.session() == Some(answer.session)
            && outstanding.is_some_and(|outstanding| outstanding.request == answer.request)
    });
    assert_eq!(is_outstanding, !step.is_ignored());
}

/// I6, I8: a leader counts a command as acknowledged only if it was outstanding and its follower
/// answered or reported it, and takes over exactly the progress that the follower reported.
pub fn reports_count_only_when_heard(step: &Taken) {
    if leading(&step.before).is_none() {
        return;
    }
    each_follower(&step.after, &step.before, |member, known| {
        let known = known.expect("a leader takes nobody on");
        let Some(order) = member.order else {
            return;
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
    });
}

/// W1: a follower that was out of position counts as in it again by a newer heartbeat than all before alone, and one that was
/// in position counts as out of it by one that is as new. L2: that a maneuver has ended is believed of any.
pub fn a_place_counts_by_the_newest_echo(step: &Taken) {
    let Input::Ram { ram, .. } = step.input else {
        return;
    };
    let Coordination::Follower { echo, .. } = ram.coordination else {
        return;
    };
    each_follower(&step.after, &step.before, |member, known| {
        let (Some(known), Some(order)) = (known, member.order) else {
            return;
        };
        let was = known.order.filter(|was| was.request == order.request);
        let told =
            reported_by(step, member).filter(|_| heard_from(step, member) == Some(order.request));
        match (was.and_then(|was| was.progress), told) {
            (Some(Progress::Executing), Some(Progress::InPosition)) => {
                let counts = order.progress == told;
                assert!(counts == (member.echoed != known.echoed));
            }
            (Some(Progress::InPosition), Some(Progress::Executing)) => {
                let counts = order.progress == told;
                assert!(counts == (member.echoed == Some(echo)));
            }
            // An end counts whichever heartbeat it echoes, if that was sent at all.
            (Some(Progress::Executing | Progress::InPosition), Some(end)) if !runs(end) => {
                // Half of the number space away a heartbeat is neither older nor newer, so it was not sent.
                let is_sent = |leads: &Leading| leads.heartbeat.0.wrapping_sub(echo.0) < 0x8000;
                let counts = order.progress == told;
                assert!(counts == leading(&step.before).is_some_and(is_sent));
            }
            _ => {}
        }
    });
}

/// The newest command that a message of the follower speaks for.
fn heard_from(step: &Taken, member: &Member) -> Option<RequestId> {
    match step.input {
        Input::Rmcm(Rmcm::Answer(answer))
            if answer.from == member.station
                && answer.verdict == Verdict::Accepted
                && step.before.session() == Some(answer.session) =>
        {
            Some(answer.request)
        }
        Input::Ram { ram, .. } if ram.station == member.station => match ram.coordination {
            Coordination::Follower { session, last, .. }
                if step.before.session() == Some(session) =>
            {
                last.map(|last| last.request)
            }
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
        Coordination::Follower { session, last, .. }
            if station == member.station && step.before.session() == Some(session) =>
        {
            last.map(|last| last.progress)
        }
        _ => None,
    }
}

/// True if the execution limit of the follower's command ran out.
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
    let Some((dropped, _)) = step
        .said
        .dropped
        .filter(|_| !matches!(step.input, Input::Elapsed(_)))
    else {
        return;
    };
    assert!(record_of(after, dropped).is_none());
    if after.members.len() + 1 == before.members.len() {
        for member in before.members.iter() {
            assert!(member.station == dropped || after.members.iter().any(|it| it == member));
        }
    }
}

/// I15, I18: a session or offer that is new has a number that was not given out, or was taken back since
/// its request ended; a boot counter changes only to a larger one; a new one is asked for from half of the
/// numbers on; and the station id changes only on its own event while unlocked, with the numbers that the event says.
pub fn keeps_its_numbers(step: &Taken) {
    let (before, after) = (&step.before, &step.after);
    if let Input::Local(Event::EpochRenewed(boot)) = step.input
        && boot > before.boot()
    {
        assert!(after.next_number() == UniqueNumber { boot, count: 0 });
        return;
    }
    if after.station() != before.station() {
        let Input::Local(Event::IdentityChanged(station, next)) = step.input else {
            panic!("the station id changes on its own event only");
        };
        assert!(after.station() == station);
        assert!(before.identity() == Identity::Unlocked && before.session().is_none());
        assert!(after.next_number() == next.unwrap_or(before.next_number()));
        assert!(!step.said.has(OutputKind::RenewEpoch));
        return;
    }
    assert!(after.boot() == before.boot());
    let free = taken_back(step).unwrap_or(before.next_number());
    let next = after.next_number().count;
    assert!(next >= free.count && next - free.count <= 1);
    let is_new = own_number(after).is_some() && own_number(after) != own_number(before);
    if let Some((_, number)) = own_number(after).filter(|_| is_new) {
        assert!(number == free && next == free.count + 1);
    }
    // A number that was given out is of the state after, or was given out and lost in one step.
    let is_late = next > free.count && next > u16::MAX / 2;
    assert!(step.said.has(OutputKind::RenewEpoch) == is_late);
}

/// The number of an offer of this boot that nobody has confirmed, where the input says that its request is
/// over.
fn taken_back(step: &Taken) -> Option<UniqueNumber> {
    let (Phase::Offering(offering), Input::Ram { ram, .. }) = (step.before.phase(), step.input)
    else {
        return None;
    };
    let Some(Farewell::Ended(number, _)) = ram.farewell else {
        return None;
    };
    let ended = SessionId::of(ram.station, number);
    let is_own = offering.number.0.boot == step.before.boot();
    (offering.session == ended && is_own).then_some(offering.number.0)
}

/// A leader drops a follower as left only if that names this session and the offer that was confirmed or a
/// newer one. A robot names a session as left only where it had that part in it, or where a leader lists an
/// offer that it made once.
pub fn farewells_name_what_was_left(step: &Taken) {
    let (before, after) = (&step.before, &step.after);
    if let Some((station, GoneReason::Left)) = step.said.dropped {
        let member = leading(before).and_then(|leading| record_of(leading, station));
        assert!(left_by(step, station).is_some_and(|(session, offer)| {
            before.session() == Some(session) && member.is_some_and(|m| offer >= m.offer)
        }));
    }
    if after.farewell() == before.farewell() {
        return;
    }
    let Some(Farewell::Left(session, offer)) = after.farewell() else {
        return;
    };
    let had_part = own_number(before) == Some((session, offer.0));
    assert!(had_part || is_listed(step, session, offer) && before.has_issued(offer.0));
}

/// The session and offer that a RAM of `station` names as left.
fn left_by(step: &Taken, station: StationId) -> Option<(SessionId, OfferNumber)> {
    match step.input {
        Input::Ram { ram, .. } if ram.station == station => match ram.farewell {
            Some(Farewell::Left(session, offer)) => Some((session, offer)),
            _ => None,
        },
        _ => None,
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
    if leading(&step.before).is_none() {
        return;
    }
    let echo = echo_heard(config, step);
    each_follower(&step.after, &step.before, |member, known| {
        let echo = echo.as_ref().filter(|echo| echo.is_newest_of(member));
        let echoed = known.and_then(|known| known.echoed);
        if member.echoed != echoed {
            assert!(echo.is_some_and(|echo| {
                echoed.is_none_or(|known| beat_is_newer(echo.heartbeat, known))
            }));
        }
        let left = lease_left(member);
        if left > known.map_or(Millis::ZERO, lease_left) {
            let t_lease = u64::from(config.settings().t_lease.0);
            assert!(echo.is_some_and(|echo| echo.age_ms + u64::from(left.0) <= t_lease));
        }
    });
}
