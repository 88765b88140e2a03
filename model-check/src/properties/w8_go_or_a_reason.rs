//! W8: within the bound a noticed pedestrian sees go, or the application is informed why not.

use super::prelude::*;

property! {
    "W8", Authentication::NAMES;
    timed L "within the bound a noticed pedestrian sees go, or the application is informed why not",
        Some("a pedestrian sees go; and an application is informed why not"),
        Rule::Timed(TimedRule { holds, premise: &[TimedPremise::Step(sees_go), TimedPremise::Step(is_informed)], ends_run: true }),
        "TELLS_OF_NO_END";
}

fn holds(step: &TimedStepView) -> bool {
    let after = step.after;
    let limit = after.setup.limits.waiting;
    after
        .waiting
        .is_none_or(|ticks| !after.is_over(ticks, limit))
}

fn wait_ends(step: &TimedStepView) -> bool {
    step.before.waiting.is_some() && step.after.waiting.is_none()
}

fn sees_go(step: &TimedStepView) -> bool {
    wait_ends(step) && step.after.shows_go[0]
}

fn is_informed(step: &TimedStepView) -> bool {
    wait_ends(step) && !step.after.shows_go[0]
}
