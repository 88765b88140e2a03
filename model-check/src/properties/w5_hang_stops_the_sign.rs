//! W5: after a robot begins to hang, the sign shows stop within the bound.
//!
//! It ends no run: a hang ends.

use super::prelude::*;

property! {
    "W5", Authentication::truth_of(&[Insider::Follower]);
    timed L "after a robot begins to hang, the sign shows stop within the bound",
        Some("the leader hangs while the sign shows go; and a follower does"),
        Rule::Timed(TimedRule {
            holds,
            premise: &[
                TimedPremise::State(|view| hangs(view, true)),
                TimedPremise::State(|view| hangs(view, false)),
            ],
            ends_run: false,
        }),
        "NeverClosesTheCorridor";
}

fn holds(step: &TimedStepView) -> bool {
    let after = step.after;
    !matches!(after.watch, StopWatch::Hung(place, ticks) if after.shows_go_too_long(place, ticks))
}

/// Whether a robot has just begun to hang, while the sign shows go.
fn hangs(view: &TimedView, leads: bool) -> bool {
    matches!(view.watch, StopWatch::Hung(place, 0)
        if view.shows_go_at(place) && view.timed.teams.leads(place) == leads)
}
