//! L2: an outstanding command leads to acknowledged or given up.

use super::{LivenessRule, LivenessSubject, LivenessSubjects, View, leading_of};

pub(super) const RULE: LivenessRule = LivenessRule {
    subjects: LivenessSubjects::Pairs,
    from: is_outstanding,
    to: |view, subject| !is_outstanding(view, subject),
};

fn is_outstanding(view: &View, LivenessSubject { robot, other }: LivenessSubject) -> bool {
    leading_of(view.node(robot)).is_some_and(|leading| {
        let mut members = leading.members.iter();
        members.any(|member| {
            view.world.place_of(member.station) == Some(other) && member.outstanding.is_some()
        })
    })
}
