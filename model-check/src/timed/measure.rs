//! What is measured, and the figures that are read off the stop-watches.

use crossguard_protocol::Millis;
use serde::Serialize;

use super::limits::Limits;
use super::section::Timed;
use crate::properties::{PropertyId, listed};

/// A figure: the longest time that something takes, over all runs.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Figure {
    /// The properties that it is about.
    pub id: String,
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
    LeaderHung,
    FollowerHung,
    Unguarded,
    BothGo,
    Unaware,
    Waiting,
}

impl Measure {
    pub(super) const ALL: [Self; 10] = [
        Self::Roles,
        Self::Stopped,
        Self::Left,
        Self::CorridorClosed,
        Self::LeaderHung,
        Self::FollowerHung,
        Self::Unguarded,
        Self::BothGo,
        Self::Unaware,
        Self::Waiting,
    ];

    /// What is measured of a hang of the leader, or of a follower.
    pub(super) const fn of_hang(leader: bool) -> Self {
        if leader {
            Self::LeaderHung
        } else {
            Self::FollowerHung
        }
    }

    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Roles => "from a request to roles or to giving up",
            Self::Stopped => "from the leader's crash to the follower stopped",
            Self::Left => "from the leader's crash to the follower idle",
            Self::CorridorClosed => "from a follower's own failure to the corridor closed",
            Self::LeaderHung => "from a hang of the leader to its sign at stop",
            Self::FollowerHung => "from a hang of a follower to the leader's sign at stop",
            Self::Unguarded => "from a follower's fallback to the leader's sign at stop",
            Self::BothGo => "from two leaders' first hearing to one sign at stop",
            Self::Unaware => "from a guard gone to the leader's application informed",
            Self::Waiting => "from a detection to go or a reason given",
        }
    }

    /// The properties that the figure is about.
    pub(super) const fn properties(self) -> &'static [PropertyId] {
        use PropertyId as P;
        match self {
            Self::Roles => &[P::L1],
            Self::Stopped | Self::Left => &[P::L5],
            Self::CorridorClosed => &[P::I11, P::W1],
            Self::LeaderHung => &[P::W5],
            Self::FollowerHung => &[P::W5, P::W1],
            Self::Unguarded => &[P::W1],
            Self::BothGo => &[P::W3],
            Self::Unaware => &[P::W6],
            Self::Waiting => &[P::W8],
        }
    }

    /// The longest time by calculation.
    pub(super) const fn bound(self, limits: &Limits) -> Millis {
        match self {
            Self::Roles => limits.roles,
            Self::Stopped => limits.stopped,
            Self::Left => limits.left,
            Self::CorridorClosed | Self::LeaderHung | Self::FollowerHung => limits.corridor_closed,
            Self::Unguarded => limits.unguarded,
            Self::BothGo => limits.both_go,
            Self::Unaware => limits.unaware,
            Self::Waiting => limits.waiting,
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

    /// Adds the longest times that another part of the exploration found.
    pub(super) fn add(&mut self, other: Self) {
        for (longest, other) in self.0.iter_mut().zip(other.0) {
            *longest = (*longest).max(other);
        }
    }

    /// The figures in milliseconds, with their bounds: those of the first property that each is about.
    pub(super) fn figures(self, timed: &Timed, limits: &Limits) -> Vec<Figure> {
        let figure = |measure: Measure| Figure {
            id: ids(measure),
            name: measure.name().to_owned(),
            ms: self.0[measure as usize].map(|ticks| timed.clock.millis(ticks).0),
            bound_ms: measure.bound(limits).0,
        };
        let asked = Measure::ALL.into_iter().filter(|measure| {
            let first = measure.properties().first();
            first.is_some_and(|property| timed.claims(*property))
        });
        asked.map(figure).collect()
    }
}

fn ids(measure: Measure) -> String {
    listed(measure.properties().iter().copied())
}
