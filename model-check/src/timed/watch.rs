//! Stop-watches, and the figures that are read off them.

use crossguard_protocol::{Config, Millis};
use serde::Serialize;

use super::clock::{Clock, longest};

/// The stop-watch of a run, in ticks. A run measures one thing at a time.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Watch {
    /// Nothing is measured.
    Off,
    /// Since the pedestrian was detected; until the requester has roles or has given up.
    Request(u8),
    /// Since the leader crashed for good.
    LeaderDown(u8),
    /// Since a follower failed while it was executing.
    FollowerFailed(u8),
}

impl Watch {
    /// One tick later.
    pub(super) fn tick(&mut self) {
        match self {
            Self::Off => {}
            Self::Request(ticks) | Self::LeaderDown(ticks) | Self::FollowerFailed(ticks) => {
                *ticks = ticks.saturating_add(1);
            }
        }
    }
}

/// A figure: the longest time that something takes, over all runs.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct Figure {
    /// What is measured.
    pub name: String,
    /// The longest time found, in milliseconds of true time; `None` when it was never measured.
    pub ms: Option<u32>,
    /// The time that the timers' values allow by calculation, in milliseconds.
    pub bound_ms: u32,
}

/// What is measured.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Measure {
    Roles,
    Stopped,
    Left,
    CorridorClosed,
}

impl Measure {
    pub(super) const ALL: [Self; 4] =
        [Self::Roles, Self::Stopped, Self::Left, Self::CorridorClosed];

    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Roles => "from a request to roles or to giving up",
            Self::Stopped => "from the leader's crash to the follower stopped",
            Self::Left => "from the leader's crash to the follower idle",
            Self::CorridorClosed => "from a follower's own failure to the corridor closed",
        }
    }

    /// The longest time by calculation, where a message takes at most `delay`.
    pub(super) fn bound(self, config: &Config, delay: Millis) -> Millis {
        let settings = config.settings();
        match self {
            Self::Roles => longest(settings.t_help, settings),
            // The crashed leader's last heartbeat may still be under way.
            Self::Stopped => delay.saturating_add(longest(settings.t_safety, settings)),
            Self::Left => Self::Stopped
                .bound(config, delay)
                .saturating_add(longest(settings.t_leave, settings)),
            Self::CorridorClosed => longest(settings.t_lease, settings),
        }
    }
}

/// The longest times that the timers' values allow by calculation, in milliseconds of true time:
/// those that the figures of a timed scenario are held against.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
pub struct Limits {
    /// From a request to roles or to giving up (L1).
    pub roles: Millis,
    /// From the leader's crash to the follower stopped (L5).
    pub stopped: Millis,
    /// From the leader's crash to the follower idle (L5).
    pub left: Millis,
    /// From a follower's own failure to the corridor closed (I11).
    pub corridor_closed: Millis,
}

impl Limits {
    /// The limits of robots with these settings, where a message takes at most `delay`.
    #[must_use]
    pub fn new(config: &Config, delay: Millis) -> Self {
        let bound = |measure: Measure| measure.bound(config, delay);
        Self {
            roles: bound(Measure::Roles),
            stopped: bound(Measure::Stopped),
            left: bound(Measure::Left),
            corridor_closed: bound(Measure::CorridorClosed),
        }
    }
}

/// The longest times found so far, in ticks.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Longest([Option<u8>; Measure::ALL.len()]);

impl Longest {
    pub(super) fn note(&mut self, measure: Measure, ticks: u8) {
        let longest = &mut self.0[measure as usize];
        *longest = Some(longest.map_or(ticks, |known| known.max(ticks)));
    }

    /// The figures in milliseconds, with their bounds.
    pub(super) fn figures(self, clock: &Clock, config: &Config, delay: Millis) -> Vec<Figure> {
        let figure = |measure: Measure| Figure {
            name: measure.name().to_owned(),
            ms: self.0[measure as usize].map(|ticks| clock.millis(ticks).0),
            bound_ms: measure.bound(config, delay).0,
        };
        Measure::ALL.map(figure).into()
    }
}
