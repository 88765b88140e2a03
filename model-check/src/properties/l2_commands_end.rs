//! L2: an outstanding command leads to acknowledged or given up.

use super::prelude::*;

property! {
    "L2", Authentication::NAMES;
    untimed L "an outstanding command is acknowledged or given up at some time",
        Some("a command is outstanding"),
        Rule::Live(LivenessRule::ends(LivenessSubjects::Pairs, is_outstanding)),
        "NEVER_REPEATS";
}

fn is_outstanding(view: &View, LivenessSubject { robot, other }: LivenessSubject) -> bool {
    view.node(robot).leading().is_some_and(|leading| {
        let mut members = leading.members.iter();
        members.any(|member| {
            view.world.place_of(member.station) == Some(other) && member.outstanding.is_some()
        })
    })
}
