//! The properties: one file each, one line each in the list below.
//!
//! ```text
//!   i04_started_once.rs ── PROPERTY ──► list below ──► PropertyId ──► scenario, check, monitor, report
//!                             │
//!         id, and for each model that it is claimed of (untimed, timed):
//!         kind, statement, premise, rule, the weakening that breaks it
//! ```
//!
//! A rule says what must hold, and its premise in which situation. A property counts only when its premise is
//! reachable. The page `doc/verification.md` has a row for each.

/// Declares the property of a file: its id, what it assumes of senders, and for each model that it is claimed of kind,
/// statement, premise, rule, and the weakening that breaks it.
macro_rules! property {
    (
        $id:literal, $authentication:expr;
        $($model:ident $kind:ident $statement:literal, $premise:expr, $rule:expr, $weakening:literal;)*
    ) => {
        #[allow(clippy::needless_update, reason = "some are claimed of both models")]
        pub(super) const PROPERTY: Property = Property {
            id: $id,
            authentication: $authentication,
            $($model: Some(Claim {
                kind: Kind::$kind,
                statement: $statement,
                premise: $premise,
                rule: $rule,
                weakening: $weakening,
            }),)*
            ..Property::OF_NOTHING
        };
    };
}

mod authentication;
mod c1_moved_by_its_leader;
mod c2_honest_guards_in_place;
mod c3_each_for_itself;
mod i01_one_leader;
mod i02_confirmed;
mod i03_commanded;
mod i04_started_once;
mod i05_requests_grow;
mod i06_acknowledged;
mod i07_stray_answer;
mod i08_completed;
mod i09_fallback_is_final;
pub(crate) mod i10_lease;
mod i11_corridor;
mod i12_no_deadlock;
mod i13_total;
mod i14_idle_is_idle;
mod i15_reboot;
mod i16_limits;
mod i17_independent_followers;
mod i18_identity;
mod i19_patience;
mod l1_help_ends;
mod l2_commands_end;
mod l3_help_helps;
mod l4_ended_is_left;
mod l5_crash_is_survived;
mod l6_requesters_agree;
mod l7_reset;
mod property;
pub(crate) mod timed_view;
mod view;
mod w1_guards_in_place;
mod w2_guards_stay;
mod w3_one_sign;
mod w4_nothing_new_on_duty;
mod w5_hang_stops_the_sign;
mod w6_application_is_informed;
mod w7_crossing_gets_done;
mod w8_go_or_a_reason;

mod prelude {
    pub(super) use super::authentication::{Authentication, Insider};
    pub(super) use super::property::{
        Claim, Kind, LivenessRule, Property, Rule, StateRule, StepRule,
    };
    pub(super) use super::property::{TimedPremise, TimedRule};
    pub(super) use super::timed_view::{TimedStepView, TimedView, has_fallback};
    pub(super) use super::view::{LivenessSubject, LivenessSubjects, StepView, View, is_team};
    pub(super) use crate::node::Node;
    pub(super) use crate::road::{Body, Heard, Pedestrian};
    pub(super) use crate::timed::watch::StopWatch;
}

use std::fmt;
use std::str::FromStr;

use crossguard_protocol::SessionId;
use serde::Serialize;

pub use authentication::{Authentication, Insider};
pub use property::{Claim, Kind, Property};
pub(crate) use property::{LivenessRule, Rule, StateRule, StepRule, TimedPremise, TimedRule};
pub(crate) use view::{StepView, Surroundings, View};

/// Declares the ids from the list of properties, and what needs all of them at compile time.
macro_rules! properties {
    (($d:tt) $($id:ident: $file:ident,)*) => {
        /// A property's id.
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize)]
        #[allow(missing_docs, reason = "the statements say what they are")]
        pub enum PropertyId {
            $($id,)*
        }

        const PROPERTIES: &[&Property] = &[$(&$file::PROPERTY,)*];

        impl PropertyId {
            /// All properties, in order.
            pub const ALL: [Self; PROPERTIES.len()] = [$(Self::$id,)*];
        }

        /// An array of a function for each property, in the order of [`PropertyId::ALL`]: stateright wants a
        /// plain function for each.
        macro_rules! for_each_property {
            ($d f:ident) => {
                [$($d f::<{ $crate::properties::PropertyId::$id as usize }>,)*]
            };
        }
        pub(crate) use for_each_property;
    };
}

properties! {
    ($)
    I1: i01_one_leader,
    I2: i02_confirmed,
    I3: i03_commanded,
    I4: i04_started_once,
    I5: i05_requests_grow,
    I6: i06_acknowledged,
    I7: i07_stray_answer,
    I8: i08_completed,
    I9: i09_fallback_is_final,
    I10: i10_lease,
    I11: i11_corridor,
    I12: i12_no_deadlock,
    I13: i13_total,
    I14: i14_idle_is_idle,
    I15: i15_reboot,
    I16: i16_limits,
    I17: i17_independent_followers,
    I18: i18_identity,
    I19: i19_patience,
    L1: l1_help_ends,
    L2: l2_commands_end,
    L3: l3_help_helps,
    L4: l4_ended_is_left,
    L5: l5_crash_is_survived,
    L6: l6_requesters_agree,
    L7: l7_reset,
    W1: w1_guards_in_place,
    W2: w2_guards_stay,
    W3: w3_one_sign,
    W4: w4_nothing_new_on_duty,
    W5: w5_hang_stops_the_sign,
    W6: w6_application_is_informed,
    W7: w7_crossing_gets_done,
    W8: w8_go_or_a_reason,
    C1: c1_moved_by_its_leader,
    C2: c2_honest_guards_in_place,
    C3: c3_each_for_itself,
}

impl PropertyId {
    /// The property.
    #[must_use]
    pub const fn property(self) -> &'static Property {
        PROPERTIES[self as usize]
    }

    /// The id as a text.
    #[must_use]
    pub const fn name(self) -> &'static str {
        self.property().id
    }

    /// Its assumptions on senders.
    #[must_use]
    pub const fn authentication(self) -> Authentication {
        self.property().authentication
    }

    /// Its claim about the model without time.
    #[must_use]
    pub const fn untimed(self) -> Option<&'static Claim> {
        self.property().untimed.as_ref()
    }

    /// Its claim about the timed model.
    #[must_use]
    pub const fn timed(self) -> Option<&'static Claim> {
        self.property().timed.as_ref()
    }

    /// The properties that are claimed of the model without time, in order.
    pub fn all_untimed() -> impl Iterator<Item = Self> + Clone {
        let is_claimed = |id: &Self| id.untimed().is_some();
        Self::ALL.into_iter().filter(is_claimed)
    }

    /// The properties that are claimed of the timed model, in order.
    pub fn all_timed() -> impl Iterator<Item = Self> + Clone {
        let is_claimed = |id: &Self| id.timed().is_some();
        Self::ALL.into_iter().filter(is_claimed)
    }

    /// The property's statement on the model without time, or on the timed one where it is claimed of that alone.
    #[must_use]
    pub fn statement(self) -> &'static str {
        let claim = self.untimed().or_else(|| self.timed());
        claim.map_or("", |claim| claim.statement)
    }

    /// Whether the model without time claims it of all runs.
    pub(crate) fn is_of_runs(self) -> bool {
        self.untimed().is_some_and(|claim| claim.kind == Kind::L)
    }

    pub(crate) fn state_rule(self) -> Option<StateRule> {
        match self.untimed()?.rule {
            Rule::State(rule) | Rule::StateAndStep(rule, _) => Some(rule),
            _ => None,
        }
    }

    pub(crate) fn step_rule(self) -> Option<StepRule> {
        match self.untimed()?.rule {
            Rule::Step(rule) | Rule::StateAndStep(_, rule) => Some(rule),
            _ => None,
        }
    }

    /// Judges whether every guard is in place when a pedestrian steps on the road at the sign of this session, whose
    /// crossing needs this number of guards; `None` where the property is not about that.
    pub(crate) fn keeps_guards(
        self,
        view: &View,
        session: SessionId,
        required: usize,
    ) -> Option<bool> {
        match self.untimed()?.rule {
            Rule::StepOnRoad(holds) => Some(holds(view, session, required)),
            _ => None,
        }
    }

    /// Whether an exploration can judge the property by states and steps alone, without a graph of them.
    #[must_use]
    pub fn is_of_states_or_steps(self) -> bool {
        let claim = self.untimed();
        claim.is_some_and(|claim| !matches!(claim.rule, Rule::Live(_) | Rule::Reset))
    }

    pub(crate) fn liveness_rule(self) -> Option<LivenessRule> {
        match self.untimed()?.rule {
            Rule::Live(rule) => Some(rule),
            _ => None,
        }
    }

    pub(crate) fn timed_rule(self) -> Option<TimedRule> {
        match self.timed()?.rule {
            Rule::Timed(rule) => Some(rule),
            _ => None,
        }
    }

    /// One bit for each property.
    pub(crate) const fn bit(self) -> u64 {
        1 << self as u64
    }
}

pub(crate) fn listed(ids: impl Iterator<Item = PropertyId>) -> String {
    let ids: Vec<_> = ids.map(PropertyId::name).collect();
    ids.join(", ")
}

impl fmt::Display for PropertyId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for PropertyId {
    type Err = ();

    fn from_str(name: &str) -> Result<Self, ()> {
        Self::ALL.into_iter().find(|id| id.name() == name).ok_or(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_claim_has_a_rule_of_its_model() {
        for id in PropertyId::ALL {
            assert!(id.untimed().is_some() || id.timed().is_some(), "{id}");
            let is_timed = |claim: &Claim| matches!(claim.rule, Rule::Timed(_));
            assert!(!id.untimed().is_some_and(is_timed), "{id}");
            assert!(id.timed().is_none_or(is_timed), "{id}");
        }
    }

    #[test]
    fn an_id_is_the_same_wherever_it_stands() {
        for id in PropertyId::ALL {
            assert_eq!(id.to_string().parse(), Ok(id));
            assert_eq!(format!("{id:?}"), id.name());
        }
    }
}
