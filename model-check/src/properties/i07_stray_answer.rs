//! I7: an acknowledgement that is not the outstanding one changes nothing.

use crossguard_protocol::{Answer, Input, Rmcm};

use super::prelude::*;

property! {
    "I7", Authentication::NAMES;
    untimed T "an answer that is not for the outstanding command changes nothing",
        Some("an answer arrives that is not for the outstanding command"),
        Rule::Step(StepRule { holds, premise, looks_back: false, of_two: false }),
        "TakesAnyAcknowledgement";
}

fn holds(step: &StepView) -> bool {
    !premise(step) || (step.after == step.before && step.outputs.ignored().is_some())
}

fn premise(step: &StepView) -> bool {
    let Input::Rmcm(Rmcm::Answer(answer)) = step.input else {
        return false;
    };
    !is_outstanding(step, answer)
}

fn is_outstanding(step: &StepView, answer: Answer) -> bool {
    step.before.leading().is_some_and(|leading| {
        let outstanding = leading
            .member(answer.from)
            .and_then(|member| member.outstanding);
        leading.number == answer.session.number
            && outstanding.is_some_and(|outstanding| outstanding.request == answer.request)
    })
}
