//! Laws of settings: which of them a robot can be configured with.
//!
//! The inequalities are written here once more, in numbers without a limit that they can reach, from what
//! [`Inequality`] says of each.

use super::arithmetic::is_over_before;
use crate::config::{Config, Inequality, Settings};
use crate::task::{FallbackPolicy, TaskType};
use crate::time::Millis;

const DAY_MS: u64 = 86_400_000;

/// Settings are taken exactly where every inequality holds, and the first that does not is named.
pub fn taken_exactly_where_the_inequalities_hold(settings: &Settings) {
    let mut inequalities = Inequality::ALL.into_iter();
    let first_broken = inequalities.find(|&inequality| !as_written(inequality, settings));
    match Config::new(settings.clone()) {
        Ok(config) => assert!(first_broken.is_none() && config.settings() == settings),
        Err(broken) => assert!(first_broken == Some(broken.0)),
    }
}

/// The limits and policies by default are as [`Settings`] documents them.
pub fn defaults_are_as_documented(settings: &Settings) {
    for (value, limit) in settings.t_exec.iter().enumerate() {
        let is_initial_pos = value == usize::from(TaskType::INITIAL_POS.value());
        assert!(limit.0 == if is_initial_pos { 5_000 } else { 60_000 });
    }
    for (value, &policy) in settings.fallback.iter().enumerate() {
        let is = |task: TaskType| value == usize::from(task.value());
        assert!(match policy {
            FallbackPolicy::EscortToKerb => is(TaskType::MOVE),
            FallbackPolicy::HoldUntilClear => is(TaskType::BLOCK),
            FallbackPolicy::StopInPlace => !is(TaskType::MOVE) && !is(TaskType::BLOCK),
            FallbackPolicy::GoToSafePosition => false,
        });
    }
}

/// True if settings satisfy one of them.
#[must_use]
pub fn as_written(inequality: Inequality, settings: &Settings) -> bool {
    let s = settings;
    match inequality {
        Inequality::TimerInRange => {
            let armed = [
                s.ram_period,
                s.t_select,
                s.t_offer,
                s.t_help,
                s.t_ack,
                s.t_safety,
                s.t_lease,
                s.t_leave,
                s.t_farewell,
                s.t_lock,
                s.t_cross,
            ];
            let mut armed = armed.iter().chain(&s.t_exec);
            armed.all(|&time| (1..=DAY_MS).contains(&ms(time))) && ms(s.delay_max) <= DAY_MS
        }
        Inequality::RepeatsInRange => s.n_ack != 0 && s.n_ack < 16,
        Inequality::DriftInRange => s.drift_ppm < 100_000,
        Inequality::LeaseWithinSafety => is_over_before(s, ms(s.t_lease), ms(s.t_safety)),
        Inequality::HeartbeatsWithinLease => ms(s.t_lease) >= 3 * ms(s.ram_period),
        Inequality::SelectionWithinOffer => s.t_offer > s.t_select,
        Inequality::HeartbeatsWithinOffer => is_over_before(s, 3 * ms(s.ram_period), ms(s.t_offer)),
        Inequality::OfferWithinHelp => s.t_help >= s.t_offer,
        Inequality::FarewellRepeated => ms(s.t_farewell) >= 3 * ms(s.ram_period),
        Inequality::LockOutlastsTask => {
            let longest = limits_of(s, s.capabilities.0).max().unwrap_or(0);
            ms(s.t_lock) > ms(s.t_help) + ms(s.t_farewell) + longest
        }
        Inequality::CrossingWithinLimits => {
            let guarding = s.capabilities.0 & s.guarding.0;
            ms(s.t_lock) > ms(s.t_cross) + ms(s.t_farewell)
                && limits_of(s, guarding).all(|limit| limit >= ms(s.t_cross))
        }
        Inequality::HeartbeatsInNumberSpace => ms(s.t_lock) / ms(s.ram_period).max(1) < 1 << 15,
        Inequality::NamedTasksGuard => s.guarding.0 & 0b110 == 0b110,
        Inequality::BlockHolds => s.holding.0 & 0b100 != 0,
    }
}

/// A time as a number in which nothing overflows.
fn ms(time: Millis) -> u64 {
    time.0.into()
}

/// The limits of some tasks.
fn limits_of(settings: &Settings, tasks: u16) -> impl Iterator<Item = u64> + '_ {
    let limits = settings.t_exec.iter().enumerate();
    limits.filter_map(move |(value, &limit)| (tasks >> value & 1 == 1).then_some(ms(limit)))
}
