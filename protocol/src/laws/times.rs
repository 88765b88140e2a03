//! Laws of the times with which timers begin. A valid state has no timer above its limit; by these laws none begins
//! with less.

use crate::config::Config;
use crate::input::Input;
use crate::state::{Contact, Identity, Lease, Member, Offer};
use crate::time::{Countdown, Millis};

use super::arithmetic::a_reservation_outlasts;
use super::lease::{Echo, echo_heard};
use super::offers::made;
use super::part::{each_follower, each_offer, following, requesting};
use super::taken::Taken;

/// All laws of this module.
pub fn all(config: &Config, step: &Taken) {
    // Time that passes is taken off what began in the same step.
    if matches!(step.input, Input::Elapsed(_)) {
        return;
    }
    the_robots_own_timers_begin_in_full(config, step);
    contact_is_lost_for_all_of_t_leave(config, step);
    offers_stand_as_long_as_they_can(config, step);
    timers_of_followers_begin_in_full(config, step);
}

fn is_full(countdown: Countdown, time: Millis) -> bool {
    countdown.left() == Some(time)
}

/// I18: identity lock, farewell and RAM timer begin with all their time.
pub fn the_robots_own_timers_begin_in_full(config: &Config, step: &Taken) {
    let (before, after, settings) = (&step.before, &step.after, config.settings());
    if before.identity() == Identity::Unlocked
        && let Identity::Locked(left) = after.identity()
    {
        let session = settings.t_lock.0.saturating_sub(settings.t_farewell.0);
        assert!(is_full(left, Millis(session)));
    }
    if let Some(standing) = after.farewell
        && before.farewell() != Some(standing.farewell)
    {
        assert!(is_full(standing.left, settings.t_farewell));
    }
    if before.next_ram().is_none() && after.next_ram().is_some() {
        assert!(after.next_ram() == Some(settings.ram_period));
    }
}

/// L5: a follower that has lost contact stays for `t_leave`.
pub fn contact_is_lost_for_all_of_t_leave(config: &Config, step: &Taken) {
    let (Some(before), Some(after)) = (following(&step.before), following(&step.after)) else {
        return;
    };
    if let (Contact::Fresh(_), Contact::Lost(left)) = (before.contact, after.contact) {
        assert!(is_full(left, config.settings().t_leave));
    }
}

/// An offer stands as long as its helper is surely reserved, and is selected from `t_select` after the first.
pub fn offers_stand_as_long_as_they_can(config: &Config, step: &Taken) {
    let (Some(before), Some(after)) = (requesting(&step.before), requesting(&step.after)) else {
        return;
    };
    if before.number != after.number {
        return;
    }
    let made = made(config, step);
    each_offer(after, before, |offer, known| {
        let what = |offer: &Offer| (offer.number, offer.echo, offer.standing);
        if known.map(what) != Some(what(offer)) {
            let left = offer.standing.left().unwrap_or(Millis::ZERO);
            let made = made.as_ref().filter(|made| made.is(offer));
            let end = made.map(|made| made.age_ms + u64::from(left.0));
            assert!(left > Millis::ZERO);
            assert!(end.is_some_and(|end| a_reservation_outlasts(config, end)));
            assert!(end.is_some_and(|end| !a_reservation_outlasts(config, end + 1)));
        }
    });
    if before.selection != after.selection {
        assert!(is_full(after.selection, config.settings().t_select));
    }
}

/// I10, L2: each wait of a leader for a follower begins with all its time.
pub fn timers_of_followers_begin_in_full(config: &Config, step: &Taken) {
    let echo = echo_heard(config, step);
    each_follower(&step.after, &step.before, |member, known| {
        let echo = echo.as_ref().filter(|echo| echo.is_newest_of(member));
        lease_begins_in_full(config, echo, known, member);
        command_begins_in_full(config, known, member);
    });
}

fn lease_begins_in_full(
    config: &Config,
    echo: Option<&Echo>,
    known: Option<&Member>,
    member: &Member,
) {
    let settings = config.settings();
    if let Lease::Expired(left) = member.lease
        && known.is_none_or(|known| known.lease.stands())
    {
        let lost = settings.t_safety.0 + settings.t_leave.0;
        assert!(is_full(left, Millis(lost)));
    }
    let (Some(known), Some(echoed)) = (known, member.echoed) else {
        return;
    };
    if known.echoed != Some(echoed) {
        let echo = echo.expect("what is echoed is in the input");
        let end = u64::from(settings.t_lease.0);
        let ends = |left: Millis| echo.age_ms + u64::from(left.0) == end;
        let is_full = matches!(member.lease, Lease::Stands(left) if left.left().is_some_and(ends));
        assert!(echo.age_ms >= end || is_full);
    }
}

fn command_begins_in_full(config: &Config, known: Option<&Member>, member: &Member) {
    let settings = config.settings();
    if let Some(outstanding) = member.outstanding {
        let repeats = known.and_then(|known| known.outstanding);
        if repeats.is_none_or(|known| known != outstanding) {
            assert!(is_full(outstanding.acknowledgement, settings.t_ack));
        }
    }
    if let Some(order) = member.order
        && known
            .and_then(|known| known.order)
            .is_none_or(|known| known.request != order.request)
        && order.is_running()
    {
        let limit = settings.t_exec[usize::from(order.task.value())];
        assert!(is_full(order.execution, limit));
    }
}
