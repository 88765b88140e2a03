//! I12: no deadlock: every state that is not quiescent has an enabled progress step.
//!
//! Quiescent is a state in which no robot that is up has a part in a session. Progress is a message
//! that arrives or a timer that expires, and that changes the state; it takes no application's help. The
//! timer of periodic RAM does not count: it always runs, and what it sends may always get lost.

use super::prelude::*;

property! {
    "I12", Authentication::NAMES;
    untimed S "a robot with a part in a session can make progress, by more than its periodic RAM",
        Some("a robot has a part in a session"),
        Rule::State(StateRule { holds, premise, of_two: false }),
        "LeadsWithoutTimers";
    timed S "time can always pass, and never stands still for ever",
        None,
        Rule::Timed(TimedRule { holds: time_can_pass, premise: &[], ends_run: false }),
        "AnswersEveryRam";
}

fn holds(view: &View) -> bool {
    !premise(view) || view.world.can_progress()
}

fn premise(view: &View) -> bool {
    view.nodes().any(|node| !node.is_idle())
}

/// A robot with a part in a session waits for a time, and not in vain for a message. That time does not
/// stand still over several steps is found by the exploration, which sees them all.
fn time_can_pass(step: &TimedStepView) -> bool {
    let due = |node: &Node| node.robot.as_ref()?.next_due();
    step.after
        .nodes()
        .all(|node| node.is_idle() || due(node).is_some())
}
