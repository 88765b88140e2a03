//! L2: an outstanding command leads to acknowledged or given up.

use super::authentication::Authentication;
use super::property::{Claim, Kind, LivenessRule, Property, Rule};
use super::view::{LivenessSubject, LivenessSubjects, View, leading_of};

pub(super) const PROPERTY: Property = Property {
    id: "L2",
    authentication: Authentication::NAMES,
    untimed: Some(Claim {
        kind: Kind::L,
        statement: "an outstanding command is acknowledged or given up at some time",
        premise: Some("a command is outstanding"),
        rule: Rule::Live(LivenessRule {
            subjects: LivenessSubjects::Pairs,
            from: is_outstanding,
            to: |view, subject| !is_outstanding(view, subject),
            needs_cooperation: false,
            broken_by_old_requests: false,
        }),
        weakening: "NEVER_REPEATS",
    }),
    timed: None,
};

fn is_outstanding(view: &View, LivenessSubject { robot, other }: LivenessSubject) -> bool {
    leading_of(view.node(robot)).is_some_and(|leading| {
        let mut members = leading.members.iter();
        members.any(|member| {
            view.world.place_of(member.station) == Some(other) && member.outstanding.is_some()
        })
    })
}
