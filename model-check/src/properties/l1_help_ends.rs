//! L1: `HelpRequested` leads to `RoleEstablished` or `Idle`.

use crossguard_protocol::State;

use super::prelude::*;

property! {
    "L1", Authentication::NAMES;
    untimed L "HelpRequested leads to RoleEstablished or Idle",
        Some("a robot is in HelpRequested"),
        Rule::Live(LivenessRule::ends(LivenessSubjects::Robots, in_help_requested)),
        "ASKS_FOR_EVER";
    timed L "a request has roles or is given up within the bound",
        Some("a requester gets roles; and one gives up"),
        Rule::Timed(TimedRule {
            holds: ends_in_time,
            premise: &[
                TimedPremise::Step(|step| request_ends(step) && !step.after.leader().is_idle()),
                TimedPremise::Step(|step| request_ends(step) && step.after.leader().is_idle()),
            ],
            ends_run: true,
        }),
        "asks_too_long";
}

fn in_help_requested(view: &View, LivenessSubject { robot, .. }: LivenessSubject) -> bool {
    let robot = view.node(robot).robot.as_ref();
    robot.is_some_and(|robot| robot.state() == State::HelpRequested)
}

fn ends_in_time(step: &TimedStepView) -> bool {
    let after = step.after;
    !matches!(after.watch, StopWatch::Request(ticks) if after.is_over(ticks, after.limits.roles))
}

fn request_ends(step: &TimedStepView) -> bool {
    matches!(
        (step.before.watch, step.after.watch),
        (StopWatch::Request(_), StopWatch::Off)
    )
}
