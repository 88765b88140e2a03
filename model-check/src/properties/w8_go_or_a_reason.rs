//! W8: within the bound a noticed pedestrian sees go, or the application is informed why not.

use super::prelude::*;

property! {
    "W8", Authentication::NAMES;
    timed L "within the bound a noticed pedestrian sees go, or the application is informed why not",
        Some("a pedestrian sees go; and an application is informed why not"),
        Rule::Timed(TimedRule { holds, premise: &[TimedPremise::Step(|step| wait_ends(step) && step.after.shows_go[0]), TimedPremise::Step(|step| wait_ends(step) && !step.after.shows_go[0])], ends_run: true }),
        "TELLS_OF_NO_END";
}

fn holds(step: &TimedStepView) -> bool {
    let after = step.after;
    !matches!(after.waiting, Some(ticks) if after.is_over(ticks, after.limits.waiting))
}

fn wait_ends(step: &TimedStepView) -> bool {
    step.before.waiting.is_some() && step.after.waiting.is_none()
}
