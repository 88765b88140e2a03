//! I19: after the last news of its leader, a follower waits at least `T_safety` on its own clock before it gives
//! the leader up.
//!
//! For how long it has heard nothing is judged from what was delivered, and not from its timers; see
//! `timed/quiet.rs`.

use super::prelude::*;

property! {
    "I19", Authentication::NAMES;
    timed S "after the last news of its leader, a follower waits at least T_safety on its own clock before it gives the leader up",
        Some("a follower gives its leader up"),
        Rule::Timed(TimedRule {
            holds: |step: &TimedStepView| step.robots.keep_contact,
            premise: &[TimedPremise::Step(gives_up)],
            ends_run: false,
        }),
        "RenewsContactBy";
}

fn gives_up(step: &TimedStepView) -> bool {
    let mut robots = step.before.nodes().zip(step.after.nodes());
    robots.any(|(before, after)| !before.has_lost_contact() && after.has_lost_contact())
}
