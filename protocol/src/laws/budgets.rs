//! Laws of response times. An obligation has a budget: the time until it is met or given up at the latest. Time uses
//! it up, no input raises it while the obligation stands, and it begins with what the settings say. So each response
//! ends within that time, in runs of any length (properties L1, L2, L4 and L5, one robot's part).

use crate::config::Config;
use crate::id::SessionNumber;
use crate::state::{Contact, Identity, Lease, Member, Outstanding, Robot};
use crate::time::Millis;

use super::arithmetic::left_ms;
use super::part::{each_follower, following, requesting, runs};
use super::taken::Taken;

/// All laws of this module.
pub fn all(config: &Config, step: &Taken) {
    a_request_gets_no_more_time(config, step);
    a_command_gets_no_more_time(config, step);
    a_lost_leader_gets_no_more_time(config, step);
    a_silent_follower_gets_no_more_time(config, step);
    an_execution_gets_no_more_time(config, step);
    an_identity_lock_gets_no_more_time(config, step);
}

/// L1: the time until a request has a team or is given up, and the request.
fn request(robot: &Robot) -> Option<(SessionNumber, u64)> {
    let requesting = requesting(robot)?;
    Some((requesting.number, left_ms(requesting.help)))
}

/// L1: neither offers nor rivals prolong a request. It begins with `T_help`.
pub fn a_request_gets_no_more_time(config: &Config, step: &Taken) {
    let Some((number, budget)) = request(&step.after) else {
        return;
    };
    match request(&step.before) {
        Some((same, before)) if same == number => assert!(budget <= before),
        _ => assert!(budget <= u64::from(config.settings().t_help.0)),
    }
}

/// L2: the time until a command is acknowledged, or its follower given up.
fn command(config: &Config, outstanding: Outstanding) -> u64 {
    let settings = config.settings();
    let repeats = u64::from(settings.n_ack.saturating_sub(outstanding.repeats));
    left_ms(outstanding.acknowledgement) + repeats * u64::from(settings.t_ack.0)
}

/// The record of this follower by the same offer: what is asked of another begins anew.
fn by_the_same_offer<'a>(member: &Member, known: Option<&'a Member>) -> Option<&'a Member> {
    known.filter(|known| known.offer == member.offer)
}

/// L2: nothing but its answer ends the wait for a command early, and nothing prolongs it. It begins with
/// `(N_ack + 1) * T_ack`.
pub fn a_command_gets_no_more_time(config: &Config, step: &Taken) {
    let settings = config.settings();
    let whole = (u64::from(settings.n_ack) + 1) * u64::from(settings.t_ack.0);
    each_follower(&step.after, &step.before, |member, known| {
        let Some(now) = member.outstanding else {
            return;
        };
        match by_the_same_offer(member, known).and_then(|known| known.outstanding) {
            Some(before) if before.request == now.request => {
                assert!(command(config, now) <= command(config, before));
            }
            _ => assert!(command(config, now) <= whole),
        }
    });
}

/// L4, L5: a follower that has lost contact leaves at the end of `T_leave`, unless it hears of its leader; it executes
/// nothing meanwhile. [`contact`](super::contact) says what is news of a leader.
pub fn a_lost_leader_gets_no_more_time(config: &Config, step: &Taken) {
    let Some(after) = following(&step.after) else {
        return;
    };
    let Contact::Lost(now) = after.contact else {
        return;
    };
    assert!(!after.job.is_some_and(|job| runs(job.progress)));
    let lost = following(&step.before).map(|before| before.contact);
    match lost {
        Some(Contact::Lost(before)) => assert!(left_ms(now) <= left_ms(before)),
        _ => assert!(left_ms(now) <= u64::from(config.settings().t_leave.0)),
    }
}

/// L5: a follower of which nothing new is heard loses its lease, then its place, and neither gets more time. The
/// echoes that renew a lease are those of the leader's own heartbeats, so what is new is a newer echo.
pub fn a_silent_follower_gets_no_more_time(config: &Config, step: &Taken) {
    each_follower(&step.after, &step.before, |member, known| {
        let was = by_the_same_offer(member, known)
            .and_then(|known| (known.echoed == member.echoed).then_some(known.lease));
        match (member.lease, was) {
            (Lease::Stands(now), Some(Lease::Stands(before)))
            | (Lease::Expired(now), Some(Lease::Expired(before))) => {
                assert!(left_ms(now) <= left_ms(before));
            }
            (Lease::Stands(_), Some(Lease::Expired(_))) => {
                panic!("a lease stands again without an echo")
            }
            (Lease::Stands(now), None) => {
                assert!(left_ms(now) <= u64::from(config.settings().t_lease.0));
            }
            (Lease::Expired(now), _) => assert!(left_ms(now) <= u64::from(config.t_lost().0)),
        }
    });
}

/// L2: no report gives a command that is executed more time. It begins with the `T_exec` of its task.
pub fn an_execution_gets_no_more_time(config: &Config, step: &Taken) {
    each_follower(&step.after, &step.before, |member, known| {
        let Some(now) = member.order else {
            return;
        };
        match by_the_same_offer(member, known).and_then(|known| known.order) {
            Some(before) if before.request == now.request => {
                assert!(left_ms(now.execution) <= left_ms(before.execution));
            }
            _ => assert!(left_ms(now.execution) <= u64::from(config.t_exec(now.task).0)),
        }
    });
}

/// I18: nothing prolongs the lock of an identity, neither commands nor the renewal of a session.
pub fn an_identity_lock_gets_no_more_time(config: &Config, step: &Taken) {
    let Identity::Locked(now) = step.after.identity() else {
        return;
    };
    match step.before.identity() {
        Identity::Locked(before) => assert!(left_ms(now) <= left_ms(before)),
        Identity::Unlocked => assert!(left_ms(now) <= u64::from(config.t_lock_session().0)),
        Identity::Expiring => panic!("a lock that was over holds again"),
    }
}

/// L1, L2, L4, L5: time that passes is used up: each budget falls by it, or to nothing.
pub fn time_uses_them_up(robot: &Robot, elapsed: Millis) {
    let mut after = robot.clone();
    after.advance(elapsed);
    let less = |before: u64, now: u64| now == before.saturating_sub(u64::from(elapsed.0));
    if let (Some((_, before)), Some((_, now))) = (request(robot), request(&after)) {
        assert!(less(before, now));
    }
    each_follower(robot, &after, |member, now| {
        let now = now.expect("time alone drops nobody");
        if let (Some(before), Some(now)) = (member.outstanding, now.outstanding) {
            let (before, now) = (before.acknowledgement, now.acknowledgement);
            assert!(less(left_ms(before), left_ms(now)));
        }
        assert!(match (member.lease, now.lease) {
            (Lease::Stands(before), Lease::Stands(now))
            | (Lease::Expired(before), Lease::Expired(now)) => less(left_ms(before), left_ms(now)),
            _ => false,
        });
    });
    if let (Some(before), Some(now)) = (following(robot), following(&after)) {
        assert!(match (before.contact, now.contact) {
            (Contact::Fresh(before), Contact::Fresh(now))
            | (Contact::Lost(before), Contact::Lost(now)) => less(left_ms(before), left_ms(now)),
            _ => false,
        });
    }
}
