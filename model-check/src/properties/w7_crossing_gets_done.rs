//! W7: once messages arrive and enough helpers are there, a request leads to a finished crossing.
//!
//! [`Scenario::cooperative`](crate::scenario::Scenario::cooperative) defines both conditions.

use super::l3_help_helps::asks;
use super::prelude::*;

property! {
    "W7", Authentication::truth_of(&[Insider::Follower, Insider::Leader, Insider::Stranger]);
    untimed L "if everything around the robots cooperates, a request leads to a finished crossing",
        Some("a robot asks for help"),
        Rule::Live(LivenessRule {
            to: Some(|view, _| view.history.pedestrian == Pedestrian::Across),
            needs_cooperation: true,
            ..LivenessRule::ends(LivenessSubjects::Robots, asks)
        }),
        "ReadsNoProgress";
}
