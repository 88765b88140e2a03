//! The longest times that the timers' values allow by calculation. The one place that knows them: the timed
//! model holds its figures against them, and so does the simulator that observes running robots.

use crossguard_protocol::{Config, Millis, Settings};
use serde::Serialize;

use super::clock::longest;

/// The longest times that the timers' values allow by calculation, in milliseconds of true time:
/// the figures of a timed scenario are held against them.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Limits {
    /// From a request to roles or to giving up (L1).
    pub roles: Millis,
    /// From a leader's command to its acknowledgement, or to the follower given up (L2).
    pub commands: Millis,
    /// From the leader's crash to the follower stopped (L5).
    pub stopped: Millis,
    /// From the leader's crash to the follower idle (L5).
    pub left: Millis,
    /// From a follower's own failure, crash or hang, or from a hang of the leader, to the sign at stop
    /// (I11, W1, W5): no pedestrian steps on the road later.
    pub corridor_closed: Millis,
    /// From a follower's fallback to the sign at stop (W1): the sign shows stop before.
    pub unguarded: Millis,
    /// From the first message that one of two leaders at a place hears of the other to one sign at stop, where
    /// no heartbeat gets lost from then on (W3).
    pub both_go: Millis,
    /// From a follower's own failure, crash or hang until the leader's application is informed (W6).
    pub unaware: Millis,
    /// From a detection, or from the newest news of a lost lease, to go or to a reason given to the application
    /// (W8). Applications command and open as soon as they may. Where a task holds a place, the time that the
    /// body takes to get there comes on top; `T_exec` after its acknowledgement the application is informed
    /// that it failed.
    pub waiting: Millis,
}

impl Limits {
    /// The limits of robots with these settings, where a message takes at most `delay`.
    #[must_use]
    pub fn new(config: &Config, delay: Millis) -> Self {
        let settings = config.settings();
        let timer = |timer: Millis| longest(timer, settings);
        // The crashed leader's last heartbeat may still be under way.
        let stopped = delay.saturating_add(timer(settings.t_safety));
        // The lease is counted from a heartbeat that was sent before the failure, whichever it is.
        let lease = timer(settings.t_lease);
        // The one that goes behind yields to the second heartbeat that it hears. Periods that are told
        // late do not add up.
        let two_periods = timer(settings.ram_period.saturating_add(settings.ram_period));
        Self {
            roles: timer(settings.t_help),
            commands: acknowledged(settings),
            stopped,
            left: stopped.saturating_add(timer(settings.t_leave)),
            corridor_closed: lease,
            // The leader's lease ends before the follower falls back.
            unguarded: Millis::ZERO,
            both_go: two_periods.saturating_add(delay),
            unaware: lease,
            waiting: waiting(config),
        }
    }
}

/// The longest wait for go. Its parts come one after the other, each as late as it may without being given as a
/// reason: the roles; a follower that joins, without which it is gone after `t_lost`; the acknowledgement of
/// its command; and its first report, for which the leader's lease on it waits.
fn waiting(config: &Config) -> Millis {
    let settings: &Settings = config.settings();
    [settings.t_help, config.t_lost(), settings.t_lease]
        .map(|timer| longest(timer, settings))
        .into_iter()
        .fold(acknowledged(settings), Millis::saturating_add)
}

/// A command is sent once and repeated `n_ack` times; the leader waits `t_ack` after each, and each wait may
/// end late.
fn acknowledged(settings: &Settings) -> Millis {
    let waits = (0..=settings.n_ack).map(|_| longest(settings.t_ack, settings));
    waits.fold(Millis::ZERO, Millis::saturating_add)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_limits_follow_from_the_settings() {
        let settings = Settings {
            drift_ppm: 0,
            ..Settings::default()
        };
        let limits = Limits::new(&Config::new(settings).unwrap(), Millis(30));
        // Each timer may be told 50 ms late.
        assert_eq!(limits.stopped, Millis(30 + 2_050));
        assert_eq!(limits.left, Millis(30 + 2_050 + 5_050));
        // One command and three repetitions.
        assert_eq!(limits.commands, Millis(4 * 650));
        assert_eq!(limits.corridor_closed, Millis(1_950));
        assert_eq!(limits.both_go, Millis(250 + 30));
        assert_eq!(limits.unaware, Millis(1_950));
        let waiting = 10_050 + 7_050 + 1_950 + 4 * 650;
        assert_eq!(limits.waiting, Millis(waiting));
    }
}
