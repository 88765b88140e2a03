//! I6: the leader counts `(s,q)` as acknowledged only if the follower accepted it; a follower acknowledges before
//! it starts, which is rule R7 of the protocol.

use crossguard_protocol::{Answer, ManeuverId, Output, Rmcm, Verdict};

use super::prelude::*;

property! {
    "I6", Authentication::truth_of(&[Insider::Follower, Insider::Leader]);
    untimed S "a leader counts a command as acknowledged only if the follower accepted it; a follower acknowledges a command before it starts",
        Some("a leader counts a command as acknowledged"),
        Rule::StateAndStep(
            StateRule {
                holds,
                premise,
                of_two: true,
            },
            StepRule {
                holds: acknowledges_before_it_starts,
                premise: |step| step.started().is_some(),
                looks_back: true,
                of_two: true,
            },
        ),
        "StartsBeforeItAcknowledges";
}

fn acknowledges_before_it_starts(step: &StepView) -> bool {
    let station = step.after.persisted.station;
    let accepts = |output: &Output, id: ManeuverId| match output {
        Output::SendRmcm(Rmcm::Answer(Answer {
            session,
            request,
            verdict: Verdict::Accepted,
            ..
        })) => (*session, *request) == (id.session, id.request),
        _ => false,
    };
    step.outputs.iter().enumerate().all(|(i, output)| {
        let Output::StartManeuver(maneuver) = output else {
            return true;
        };
        let before = step.history.command(station, maneuver.id);
        before.is_some_and(|command| command.accepted)
            || step
                .outputs
                .iter()
                .take(i)
                .any(|output| accepts(output, maneuver.id))
    })
}

fn holds(view: &View) -> bool {
    let accepted = |station, id| {
        view.history()
            .command(station, id)
            .is_some_and(|command| command.accepted)
    };
    view.orders().all(|(station, id, _)| accepted(station, id))
        && view.nodes().all(|node| {
            node.actuation
                .running()
                .is_none_or(|id| accepted(node.persisted.station, id))
        })
}

fn premise(view: &View) -> bool {
    view.orders().next().is_some()
}
