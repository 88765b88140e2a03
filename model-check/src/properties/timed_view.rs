//! View of timed rules: a state of the timed model, and a step of it.

use crossguard_protocol::Millis;

use crate::node::Node;
use crate::timed::limits::Limits;
use crate::timed::section::Timed;
use crate::timed::teams::MAX_TEAMS;
use crate::timed::told::Told;
use crate::timed::watch::StopWatch;

#[derive(Clone, Copy)]
pub(crate) struct TimedView<'a> {
    /// The robots, in the order of their places.
    pub(crate) nodes: &'a [&'a Node],
    pub(crate) timed: &'a Timed,
    pub(crate) limits: &'a Limits,
    pub(crate) watch: StopWatch,
    pub(crate) shows_go: [bool; MAX_TEAMS],
    /// Whether a sign shows go although a follower of its team fell back for lack of contact.
    pub(crate) is_unguarded: bool,
    /// State of the followers, as the leaders' applications know it.
    pub(crate) told: Told,
    /// For how many ticks the pedestrian has waited for go, or the application for a reason; where that is asked.
    pub(crate) waiting: Option<u8>,
}

/// Findings on single robots' steps in one step of the timed model.
#[derive(Clone, Copy)]
pub(crate) struct RobotSteps {
    /// Every follower that gave its leader up had waited for as long as it promised.
    pub(crate) keep_contact: bool,
    pub(crate) are_valid: bool,
}

#[derive(Clone, Copy)]
pub(crate) struct TimedStepView<'a> {
    pub(crate) before: &'a TimedView<'a>,
    /// With the names of `before`.
    pub(crate) after: &'a TimedView<'a>,
    pub(crate) robots: RobotSteps,
}

impl RobotSteps {
    pub(crate) const NONE: Self = Self {
        keep_contact: true,
        are_valid: true,
    };
}

impl<'a> TimedView<'a> {
    pub(crate) fn nodes(&self) -> impl Iterator<Item = &'a Node> + Clone + use<'a> {
        self.nodes.iter().copied()
    }

    /// The robot of the first team that detects the pedestrian.
    pub(crate) fn leader(&self) -> &'a Node {
        self.nodes[usize::from(self.timed.teams.leaders()[0])]
    }

    pub(crate) const fn shows_go_at(&self, place: u8) -> bool {
        self.shows_go[self.timed.teams.team_of(place)]
    }

    pub(crate) fn leader_hangs(&self) -> bool {
        matches!(self.watch, StopWatch::Hung(place, _) if self.timed.teams.leads(place))
    }

    /// Whether the sign at this robot still shows go when it should have ended, so many ticks after its guard or leader was lost.
    pub(crate) fn shows_go_too_long(&self, place: u8, ticks: u8) -> bool {
        self.shows_go_at(place) && self.is_over(ticks, self.limits.corridor_closed)
    }

    /// Whether this number of ticks is longer than a limit.
    pub(crate) fn is_over(&self, ticks: u8, limit: Millis) -> bool {
        self.timed.clock.millis(ticks) > limit
    }
}

/// Whether a follower that executed falls back for lack of contact in a step of the model.
pub(crate) fn has_fallback(step: &TimedStepView) -> bool {
    let mut robots = step.before.nodes().zip(step.after.nodes());
    robots.any(|(before, after)| falls_back(before, after))
}

/// Whether a follower that executed falls back for lack of contact in its step.
pub(crate) fn falls_back(before: &Node, after: &Node) -> bool {
    let stops = before.actuation.running().is_some() && after.actuation.running().is_none();
    stops && after.has_lost_contact()
}
