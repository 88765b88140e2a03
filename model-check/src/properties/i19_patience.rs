//! I19: after the last news of its leader, a follower waits at least `T_safety` on its own clock before it gives
//! the leader up.
//!
//! For how long it has heard nothing is judged from what was delivered, and not from its timers; see
//! `timed/quiet.rs`.

use super::authentication::Authentication;
use super::property::{Claim, Kind, Property, Rule, TimedPremise, TimedRule};
use super::timed_view::TimedStepView;

pub(super) const PROPERTY: Property = Property {
    id: "I19",
    authentication: Authentication::NAMES,
    untimed: None,
    timed: Some(Claim {
        kind: Kind::S,
        statement: "after the last news of its leader, a follower waits at least T_safety on its own clock before it gives the leader up",
        premise: Some("a follower gives its leader up"),
        rule: Rule::Timed(TimedRule {
            holds: |step: &TimedStepView| step.robots.keep_contact,
            premise: &[TimedPremise::Step(gives_up)],
            ends_run: false,
        }),
        weakening: "RenewsContactBy",
    }),
};

fn gives_up(step: &TimedStepView) -> bool {
    let mut robots = step.before.nodes().zip(step.after.nodes());
    robots.any(|(before, after)| !before.has_lost_contact() && after.has_lost_contact())
}
