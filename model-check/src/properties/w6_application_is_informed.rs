//! W6: the leader's application is informed of a lost guard within the bound, and of a fallback before it happens.
//!
//! It ends no run: a follower that is gone is dropped at some time.

use super::prelude::*;

property! {
    "W6", Authentication::truth_of(&[Insider::Follower]);
    timed L "the leader's application is informed of a lost guard within the bound, and of a fallback before it happens",
        Some("a guard that the application counts on is gone; and one falls back"),
        Rule::Timed(TimedRule {
            holds,
            premise: &[
                TimedPremise::State(guard_is_gone),
                TimedPremise::Step(has_fallback),
            ],
            ends_run: false,
        }),
        "TELLS_OF_NO_LOST_GUARD";
}

fn holds(step: &TimedStepView) -> bool {
    let after = step.after;
    let in_time = match after.watch {
        StopWatch::FollowerFailed(place, ticks) | StopWatch::Hung(place, ticks) => {
            let limit = after.limits.unaware;
            !(after.told.counts_on(place) && after.is_over(ticks, limit))
        }
        _ => true,
    };
    in_time && knows_of_fallbacks(after)
}

/// Of fallbacks: the application of a leader that does not hang counts on no robot whose body falls back.
fn knows_of_fallbacks(view: &TimedView) -> bool {
    let falls_back = |node: &Node| matches!(node.actuation.body, Body::FallingBack(..));
    let mut robots = (0..).zip(view.nodes());
    view.leader_hangs()
        || robots.all(|(place, node)| !(falls_back(node) && view.told.counts_on(place)))
}

fn guard_is_gone(view: &TimedView) -> bool {
    match view.watch {
        StopWatch::FollowerFailed(place, 0) => view.told.counts_on(place),
        StopWatch::Hung(place, 0) => view.shows_go_at(place) && view.told.counts_on(place),
        _ => false,
    }
}
