//! C3: a corridor rests on followers that its leader confirmed, each of which speaks for itself alone.
//!
//! So a corridor is never open on the word of a station that was not confirmed.

use crossguard_protocol::{Confirmation, Leading, Member, StationId};

use super::prelude::*;

property! {
    "C3", Authentication::NAMES;
    untimed S "an open corridor rests on followers that were confirmed; what a station says changes no record but its own",
        Some("a leader takes in what a station says that is not its only follower"),
        Rule::StateAndStep(
            StateRule {
                holds: rests_on_the_confirmed,
                premise: |_| false,
                of_two: false,
            },
            StepRule {
                holds: speaks_for_itself,
                premise,
                looks_back: false,
                of_two: false,
            },
        ),
        "AdmitsWhoSaysThatItFollows";
}

fn rests_on_the_confirmed(view: &View) -> bool {
    view.nodes().all(|node| {
        let (Some(leading), Some(robot)) = (node.leading(), &node.robot) else {
            return true;
        };
        let members = leading.members.iter();
        let mut followers = members.map(|member| Confirmation {
            station: member.station,
            offer: member.offer,
        });
        let Some(session) = robot.session() else {
            return true;
        };
        !node.actuation.corridor_open
            || followers.all(|follower| view.history().is_confirmed(session, follower))
    })
}

fn speaks_for_itself(step: &StepView) -> bool {
    let (Some(sender), Some(before)) = (step.sender(), step.before.leading()) else {
        return true;
    };
    let Some(after) = step.after.leading() else {
        return true;
    };
    let joins = after.member(sender).is_some() && before.member(sender).is_none();
    others(before, sender).eq(others(after, sender)) && !joins
}

fn others(leading: &Leading, sender: StationId) -> impl Iterator<Item = &Member> {
    let members = leading.members.iter();
    members.filter(move |member| member.station != sender)
}

fn premise(step: &StepView) -> bool {
    let (Some(sender), Some(leading)) = (step.sender(), step.before.leading()) else {
        return false;
    };
    others(leading, sender).next().is_some()
}
