//! A property is a value with an id, a statement, the rule that judges it, and the weakening of the
//! protocol that breaks it.

use crossguard_protocol::SessionId;
use serde::Serialize;

use super::authentication::Authentication;
use super::timed_view::{TimedStepView, TimedView};
use super::view::{LivenessSubject, LivenessSubjects, StepView, View};

/// A property, as it is claimed of the model without time, of the timed model, or of both.
#[derive(Debug)]
pub struct Property {
    /// Its id, the same everywhere: `I4`.
    pub id: &'static str,
    /// Its assumptions on senders.
    pub authentication: Authentication,
    /// Its claim about the model without time.
    pub untimed: Option<Claim>,
    /// Its claim about the timed model.
    pub timed: Option<Claim>,
}

impl Property {
    /// One that is claimed of no model.
    pub(super) const OF_NOTHING: Self = Self {
        id: "",
        authentication: Authentication::NONE,
        untimed: None,
        timed: None,
    };
}

/// A property's claim about one model.
#[derive(Debug)]
pub struct Claim {
    /// Its subject.
    pub kind: Kind,
    /// Its statement.
    pub statement: &'static str,
    /// The situation that it is about; `None` for one that is about every state. Two parts are joined by `; and`.
    pub premise: Option<&'static str>,
    pub(crate) rule: Rule,
    /// The weakening of the protocol in `model-check/tests` that breaks it.
    pub weakening: &'static str,
}

/// Subject of a claim.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Serialize)]
pub enum Kind {
    /// Safety: of every reachable state.
    S,
    /// Of every transition.
    T,
    /// Liveness: of every fair run, or that something comes in time.
    L,
}

impl Kind {
    /// Its letter.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::S => "S",
            Self::T => "T",
            Self::L => "L",
        }
    }
}

#[derive(Clone, Copy, Debug)]
pub(crate) enum Rule {
    /// On every state.
    State(StateRule),
    /// On every step of a robot.
    Step(StepRule),
    /// On both.
    StateAndStep(StateRule, StepRule),
    /// When a pedestrian steps on the road at the sign of this session, whose crossing needs this number of guards.
    StepOnRoad(fn(&View, SessionId, usize) -> bool),
    /// On all fair runs.
    Live(LivenessRule),
    /// On the whole graph: some run leads from every state to all robots being idle.
    Reset,
    /// On every step of the timed model.
    Timed(TimedRule),
}

/// Something that holds of every reachable state that meets its premise.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StateRule {
    pub(crate) holds: fn(&View) -> bool,
    pub(crate) premise: fn(&View) -> bool,
    /// Whether it compares what two robots know, so that it says nothing where the past of one is not recorded.
    pub(crate) of_two: bool,
}

/// Something that holds of every robot's step that meets its premise.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StepRule {
    pub(crate) holds: fn(&StepView) -> bool,
    pub(crate) premise: fn(&StepView) -> bool,
    /// Whether the two look at the history.
    pub(crate) looks_back: bool,
    /// As in [`StateRule`].
    pub(crate) of_two: bool,
}

/// Something that leads to something on every fair run.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LivenessRule {
    pub(crate) subjects: LivenessSubjects,
    pub(crate) from: fn(&View, LivenessSubject) -> bool,
    /// Where nothing is said, it is that `from` is over.
    pub(crate) to: Option<fn(&View, LivenessSubject) -> bool>,
    /// Whether it speaks about cooperative scenarios only.
    pub(crate) needs_cooperation: bool,
    /// Whether old requests that arrive again and again break it, as they may on a monotone channel.
    pub(crate) broken_by_old_requests: bool,
}

impl LivenessRule {
    /// Something that does not last for ever.
    pub(crate) const fn ends(
        subjects: LivenessSubjects,
        from: fn(&View, LivenessSubject) -> bool,
    ) -> Self {
        Self {
            subjects,
            from,
            to: None,
            needs_cooperation: false,
            broken_by_old_requests: false,
        }
    }

    /// Whether a state that comes after one in which `from` is so is what it leads to.
    pub(crate) fn is_reached(&self, view: &View, subject: LivenessSubject) -> bool {
        match self.to {
            Some(to) => to(view, subject),
            None => !(self.from)(view, subject),
        }
    }
}

/// Something that holds of every step of the timed model.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TimedRule {
    pub(crate) holds: fn(&TimedStepView) -> bool,
    /// Its parts. Each has to be met somewhere.
    pub(crate) premise: &'static [TimedPremise],
    /// Whether a run ends where it is broken: what is late might never come.
    pub(crate) ends_run: bool,
}

#[derive(Clone, Copy, Debug)]
pub(crate) enum TimedPremise {
    State(fn(&TimedView) -> bool),
    Step(fn(&TimedStepView) -> bool),
}

impl Claim {
    /// Whether a broken one is shown by one run, and not by all that may follow from a state.
    pub(crate) const fn is_shown_by_run(&self) -> bool {
        !matches!(self.rule, Rule::Reset)
    }
}
