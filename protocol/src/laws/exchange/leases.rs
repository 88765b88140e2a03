//! From facts to real time (I10, I11): what the leases of a leader, and with them an open corridor, rest on.
//!
//! The watched heartbeat is the newest that the leader has heard echoed by the follower. Then, between any two steps:
//!
//! 1. The follower has heard it, or a later one, and at some moment since then its body executed the task that the corridor
//!    counts on ([`a_corridor_rests_on_the_follower`]).
//! 2. The lease ends `t_lease` after the heartbeat was sent at the latest, by the leader's clock: what is left of the
//!    lease and the age of the heartbeat are no more than `t_lease` together ([`are_covered`]).
//! 3. The heartbeat that it has heard gave the follower `T_safety` in full, and nothing but time shortens that
//!    ([`are_kept`]).
//!
//! A heartbeat is heard after it was sent, so by [`lease`](super::super::lease) the follower's `T_safety` has not run out
//! while the lease stands: since that moment it has not fallen back because it lost contact.

use super::observer::leads;
use super::{Exchange, Heard, History};
use crate::config::Config;
use crate::input::Input;
use crate::laws::arithmetic::{age_ms, left_ms};
use crate::laws::part::{following, leading, runs};
use crate::laws::watch::is_open;
use crate::state::{Contact, Lease, Member, Robot};
use crate::time::Millis;

/// True if each lease that stands ends `t_lease` after the newest heartbeat that its follower has echoed, or earlier.
#[must_use]
pub fn are_covered(config: &Config, robot: &Robot) -> bool {
    let Some(leading) = leading(robot) else {
        return true;
    };
    let next_ram = robot.next_ram().unwrap_or(Millis::ZERO);
    let is_covered = |member: &Member| match member.lease {
        // One that is over expires in the same step.
        Lease::Stands(lease) if left_ms(lease) > 0 => member.echoed.is_some_and(|echo| {
            let age = age_ms(config, leading.heartbeat, echo, next_ram);
            age + left_ms(lease) <= u64::from(config.settings().t_lease.0)
        }),
        Lease::Stands(_) | Lease::Expired(_) => true,
    };
    leading.members.iter().all(is_covered)
}

/// The effect of one step other than time on leases and contact.
///
/// # Panics
/// When it breaks one of these laws.
pub fn are_kept(config: &Config, before: &Robot, input: &Input, after: &Robot) {
    if !matches!(input, Input::Elapsed(_) | Input::Expired(_)) {
        stay_covered(config, before, after);
        contact_is_not_shortened(before, after);
    }
}

/// I10, the leader's half: leases stay [covered](are_covered).
fn stay_covered(config: &Config, before: &Robot, after: &Robot) {
    assert!(
        !are_covered(config, before) || are_covered(config, after),
        "I10: a lease outlasts the heartbeat that it counts from"
    );
}

/// I10, the follower's half: nothing but time shortens `T_safety`.
fn contact_is_not_shortened(before: &Robot, after: &Robot) {
    let (Some(before), Some(after)) = (following(before), following(after)) else {
        return;
    };
    if before.session != after.session {
        return;
    }
    if let Contact::Fresh(was_left) = before.contact {
        assert!(
            matches!(after.contact, Contact::Fresh(is_left) if left_ms(is_left) >= left_ms(was_left)),
            "I10: contact is shortened"
        );
    }
}

/// I10, I11: an open corridor counts on the follower only where this has heard the watched heartbeat, when that is the newest
/// it has echoed, and executed the watched request at some moment since then.
///
/// # Panics
/// When it does on another.
pub fn a_corridor_rests_on_the_follower(exchange: &Exchange, history: &History, robot: &Robot) {
    let Some(leading) = leading(robot) else {
        return;
    };
    if !leads(exchange, robot) || !is_open(robot) {
        return;
    }
    for member in leading.members.iter() {
        // Where it does not run any more, the corridor is closed in the same step.
        let order = member
            .order
            .filter(|order| order.request == exchange.request && order.progress.is_some_and(runs));
        let is_watched = member.echoed == Some(exchange.heartbeat);
        if let (true, true, Some(order)) = (member.station == exchange.follower, is_watched, order)
        {
            // Accepted, and not over when it was heard: it was executed then, or later.
            assert!(
                history.beaten
                    && history.heard == Some(Heard::BeforeTheEnd)
                    && history.accepted
                    && history.commanded == Some(order.task),
                "I10, I11: a corridor rests on who did not guard"
            );
        }
    }
}
