//! Laws of the lease: the arithmetic under the lease theorem (property I10).
//!
//! The laws of [`steps`](super::steps) say how one step changes leases and contact.

use crate::config::{Config, Inequality, Settings};
use crate::id::{Heartbeat, StationId};
use crate::input::{Input, Timer};
use crate::message::Coordination;
use crate::roles;
use crate::state::{Lease, Member, Robot};
use crate::time::Millis;

use super::arithmetic::age_ms;
use super::exchange::leases::are_covered;
use super::part::leading;
use super::taken::Taken;
use super::timers::fire;

/// How far two clocks have come since the leader sent a heartbeat, all in milliseconds.
#[derive(Clone, Copy, Debug)]
pub struct Clocks {
    /// True time.
    pub real: u32,
    /// By the leader's clock, which counts the lease.
    pub leader: u32,
    /// By the follower's clock, which counts `T_safety`. It hears the heartbeat later than it was
    /// sent, so this is the most that it can have counted.
    pub follower: u32,
}

impl Clocks {
    /// True if both clocks are within `drift_ppm` of true time, to the millisecond that they count.
    #[must_use]
    pub fn are_within(self, drift_ppm: u32) -> bool {
        let within = |clock: u32| {
            let (clock, real) = (u64::from(clock) * 1_000_000, u64::from(self.real));
            let drift = u64::from(drift_ppm);
            clock <= real * (1_000_000 + drift) && clock >= real * (1_000_000 - drift)
        };
        within(self.leader) && within(self.follower)
    }
}

/// While the lease stands, and for as long as the endpoint may be late to say that it does not, the
/// follower's `T_safety` has not run out, whatever the two clocks do.
///
/// The premise is [`Inequality::LeaseWithinSafety`]. Gives whether it holds and the lease stands.
#[must_use]
pub fn the_lease_ends_before_safety(settings: &Settings, clocks: Clocks) -> bool {
    let premise = [
        Inequality::TimerInRange,
        Inequality::DriftInRange,
        Inequality::LeaseWithinSafety,
    ]
    .iter()
    .all(|inequality| inequality.holds(settings));
    let lease_ends = settings.t_lease.saturating_add(settings.delay_max);
    let stands =
        premise && clocks.are_within(settings.drift_ppm) && Millis(clocks.leader) <= lease_ends;
    assert!(!stands || Millis(clocks.follower) < settings.t_safety);
    stands
}

/// While a requester counts on an offer, and for as long as its endpoint may be late to say that it lapsed,
/// the reservation of a helper with the same `t_offer` has not run out, whatever the two clocks do.
///
/// Gives whether it counts on it.
#[must_use]
pub fn an_offer_lapses_before_its_reservation(settings: &Settings, clocks: Clocks) -> bool {
    let premise = [Inequality::TimerInRange, Inequality::DriftInRange]
        .iter()
        .all(|inequality| inequality.holds(settings));
    let lease = Config::unchecked(settings.clone()).t_offer_lease();
    let counts = premise
        && lease > Millis::ZERO
        && clocks.are_within(settings.drift_ppm)
        && Millis(clocks.leader) <= lease.saturating_add(settings.delay_max);
    assert!(!counts || Millis(clocks.follower) < settings.t_offer);
    counts
}

/// The robot once time has passed. Its RAM timer, which has `left`, has fired where it was due, and no other timer.
fn once_passed(config: &Config, robot: &Robot, elapsed: Millis, left: Millis) -> Robot {
    let mut after = robot.clone();
    after.advance(elapsed);
    if after.next_ram() != Some(Millis::ZERO) {
        return after;
    }
    fire(config, &after, Timer::Ram, elapsed.saturating_sub(left)).after
}

/// The age of a heartbeat grows exactly as time passes, also when the RAM of several periods are
/// late: so a lease that starts with it is never too long, and never loses time.
///
/// `robot` is a leader whose followers are not out of order.
pub fn heartbeats_age_as_time_passes(
    config: &Config,
    robot: &Robot,
    heartbeat: Heartbeat,
    elapsed: Millis,
) {
    let (Some(before), Some(left)) = (age_of(config, robot, heartbeat), robot.next_ram()) else {
        return;
    };
    let after = once_passed(config, robot, elapsed, left);
    let Some(age) = age_of(config, &after, heartbeat) else {
        return;
    };
    // Up to the age that the number space can tell.
    let period = config.settings().ram_period;
    let longest = u64::from(u16::MAX) * u64::from(period.0);
    let expected = u64::from(before.0) + u64::from(elapsed.0);
    if expected < longest {
        assert!(u64::from(age.0) == expected);
    }
}

/// How long a follower's lease stands still; no time where it does not.
pub(super) fn lease_left(member: &Member) -> Millis {
    match member.lease {
        Lease::Stands(countdown) => countdown.left().unwrap_or(Millis::ZERO),
        Lease::Expired(_) => Millis::ZERO,
    }
}

/// The echo of a leader's heartbeat.
pub(super) struct Echo {
    /// The follower.
    station: StationId,
    /// The heartbeat that it echoes.
    pub(super) heartbeat: Heartbeat,
    /// How long ago the leader sent that, in ms.
    pub(super) age_ms: u64,
}

impl Echo {
    /// True if this is what the leader has last heard echoed by this follower.
    pub(super) fn is_newest_of(&self, member: &Member) -> bool {
        (self.station, Some(self.heartbeat)) == (member.station, member.echoed)
    }
}

/// The echo in the input, where it is a RAM of a follower in this leader's session.
pub(super) fn echo_heard(config: &Config, step: &Taken) -> Option<Echo> {
    let (Input::Ram { ram, .. }, Some(before)) = (step.input, leading(&step.before)) else {
        return None;
    };
    match ram.coordination {
        Coordination::Follower { session, echo, .. } if step.before.session() == Some(session) => {
            let next_ram = step.before.next_ram().unwrap_or(Millis::ZERO);
            Some(Echo {
                station: ram.station,
                heartbeat: echo,
                age_ms: age_ms(config, before.heartbeat, echo, next_ram),
            })
        }
        _ => None,
    }
}

/// Heartbeats of a leader count time alone: a step that is neither time nor the RAM's timer leaves the newest heartbeat and the
/// time until the next one as they are. Otherwise leases would count from later than their heartbeats were sent.
pub fn heartbeats_count_time_alone(step: &Taken) {
    if matches!(step.input, Input::Elapsed(_) | Input::Expired(Timer::Ram)) {
        return;
    }
    if let (Some(before), Some(after)) = (leading(&step.before), leading(&step.after))
        && before.number == after.number
    {
        assert!(before.heartbeat == after.heartbeat);
        assert!(step.before.next_ram() == step.after.next_ram());
    }
}

/// Leases stay [covered](are_covered) by the heartbeats that they count from, however much time passes at once and however
/// late the RAM is.
///
/// `robot` is a leader whose followers are not out of order. Gives whether it has a lease that stands before and after.
#[must_use]
pub fn time_leaves_leases_covered(config: &Config, robot: &Robot, elapsed: Millis) -> bool {
    let Some(left) = robot.next_ram() else {
        return false;
    };
    if !are_covered(config, robot) {
        return false;
    }
    let after = once_passed(config, robot, elapsed, left);
    assert!(are_covered(config, &after));
    let stands = |robot: &Robot| {
        leading(robot).is_some_and(|leading| {
            let mut members = leading.members.iter();
            members.any(|member| lease_left(member) > Millis::ZERO)
        })
    };
    stands(robot) && stands(&after)
}

fn age_of(config: &Config, robot: &Robot, heartbeat: Heartbeat) -> Option<Millis> {
    let newest = leading(robot)?.heartbeat;
    Some(roles::age_of(config, newest, heartbeat, robot.next_ram()?))
}
