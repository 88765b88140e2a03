//! L6: two robots that ask or lead at one place do not both do so for ever.
//!
//! The robots of a scenario ask for one place. Two robots that lead there for ever would be two teams at one
//! crossing.

use crossguard_protocol::Phase;

use super::prelude::*;

property! {
    "L6", Authentication::truth_of(&[Insider::Stranger]);
    untimed L "two robots that ask or lead at one place do not both do so for ever",
        Some("two robots ask or lead"),
        Rule::Live(LivenessRule {
            broken_by_old_requests: true,
            ..LivenessRule::ends(LivenessSubjects::Pairs, both_claim)
        }),
        "InsistsOnItsRequest";
}

fn both_claim(view: &View, LivenessSubject { robot, other }: LivenessSubject) -> bool {
    let claims = |place: usize| {
        let phase = view.node(place).phase();
        matches!(phase, Some(Phase::Requesting(_) | Phase::Leading(_)))
    };
    claims(robot) && claims(other)
}
