//! L6: two robots that ask or lead at one place do not both do so for ever.
//!
//! The robots of a scenario ask for one place. Two robots that lead there for ever would be two teams at one
//! crossing.

use crossguard_protocol::Phase;

use super::authentication::{Authentication, Insider};
use super::property::{Claim, Kind, LivenessRule, Property, Rule};
use super::view::{LivenessSubject, LivenessSubjects, View};

pub(super) const PROPERTY: Property = Property {
    id: "L6",
    authentication: Authentication::truth_of(&[Insider::Stranger]),
    untimed: Some(Claim {
        kind: Kind::L,
        statement: "two robots that ask or lead at one place do not both do so for ever",
        premise: Some("two robots ask or lead"),
        rule: Rule::Live(LivenessRule {
            subjects: LivenessSubjects::Pairs,
            from: both_claim,
            to: |view, subject| !both_claim(view, subject),
            needs_cooperation: false,
            broken_by_old_requests: true,
        }),
        weakening: "InsistsOnItsRequest",
    }),
    timed: None,
};

fn both_claim(view: &View, LivenessSubject { robot, other }: LivenessSubject) -> bool {
    let claims = |place: usize| {
        let robot = view.node(place).robot.as_ref();
        robot.is_some_and(|r| matches!(r.phase(), Phase::Requesting(_) | Phase::Leading(_)))
    };
    claims(robot) && claims(other)
}
