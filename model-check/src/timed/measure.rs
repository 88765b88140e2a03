//! Measures, and the figures that are read off the stop-watches.

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
    /// The measured time, in words.
    pub name: String,
    /// The longest time found, in milliseconds of true time; `None` when it was never measured.
    pub ms: Option<u32>,
    /// The time that the timers' values allow by calculation, in milliseconds.
    pub bound_ms: u32,
}

/// What there is to say about a measure.
pub(super) struct MeasureClaim {
    pub(super) properties: &'static [PropertyId],
    pub(super) name: &'static str,
    /// The longest time by calculation, and how that follows from the settings.
    pub(super) bound: fn(&Limits) -> Millis,
    pub(super) derivation: &'static str,
}

macro_rules! measures {
    ($($measure:ident: [$($property:ident),+], $name:literal, $bound:ident = $derivation:literal;)+) => {
        #[derive(Clone, Copy, PartialEq, Eq, Debug)]
        pub(super) enum Measure {
            $($measure,)+
        }

        /// In the order of [`Measure`].
        pub(super) const MEASURES: &[MeasureClaim] = &[$(MeasureClaim {
            properties: &[$(PropertyId::$property),+],
            name: $name,
            bound: |limits| limits.$bound,
            derivation: $derivation,
        },)+];
    };
}

measures! {
    Roles: [L1], "from a request to roles or to giving up", roles = "longest(t_help)";
    Stopped: [L5], "from the leader's crash to the follower stopped", stopped = "delay + longest(t_safety)";
    Left: [L5], "from the leader's crash to the follower idle",
        left = "delay + longest(t_safety) + longest(t_leave)";
    CorridorClosed: [I11, W1], "from a follower's own failure to the corridor closed",
        corridor_closed = "longest(t_lease)";
    LeaderHung: [W5], "from a hang of the leader to its sign at stop", corridor_closed = "longest(t_lease)";
    FollowerHung: [W5, W1], "from a hang of a follower to the leader's sign at stop",
        corridor_closed = "longest(t_lease)";
    Unguarded: [W1], "from a follower's fallback to the leader's sign at stop",
        unguarded = "0: the lease ends before the follower falls back";
    BothGo: [W3], "from two leaders' first hearing to one sign at stop",
        both_go = "longest(2 * ram_period) + delay";
    Unaware: [W6], "from a guard gone to the leader's application informed", unaware = "longest(t_lease)";
    Waiting: [W8], "from a detection to go or a reason given",
        waiting = "longest(t_help) + longest(t_lost) + (n_ack + 1) * longest(t_ack) + longest(t_lease)";
}

impl Measure {
    /// Measure of a hang of the leader, or of a follower.
    pub(super) const fn of_hang(leader: bool) -> Self {
        if leader {
            Self::LeaderHung
        } else {
            Self::FollowerHung
        }
    }
}

impl MeasureClaim {
    pub(super) fn ids(&self) -> String {
        listed(self.properties.iter().copied())
    }
}

/// The longest times found so far, in ticks.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Longest([Option<u8>; MEASURES.len()]);

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
        let found = MEASURES.iter().zip(self.0);
        let asked = found.filter(|(claim, _)| timed.claims(claim.properties[0]));
        let figure = |(claim, longest): (&MeasureClaim, Option<u8>)| Figure {
            id: claim.ids(),
            name: claim.name.to_owned(),
            ms: longest.map(|ticks| timed.clock.millis(ticks).0),
            bound_ms: (claim.bound)(limits).0,
        };
        asked.map(figure).collect()
    }
}
