//! W3: of two leaders at one place that hear each other, only one shows go.
//!
//! Without time there is one exemption: a leader that has received one message alone of leaders that go before it. That may be
//! from a session that is long over. A second one counts, of the same session with a newer heartbeat or of any other: nobody
//! hides a leader by what it says. How long two signs can show go once the two hear each other is what the timed view finds.

use super::prelude::*;

property! {
    "W3", Authentication::NAMES;
    untimed S "of two leaders at one place that hear each other, only one shows go",
        Some("a leader has heard two messages of leaders that go before it"),
        Rule::State(StateRule { holds, premise, of_two: false }),
        "HearsNoLeader";
    timed L "after one of two leaders at a place hears the other, both signs show go no longer than the bound",
        Some("two leaders whose signs show go hear each other"),
        Rule::Timed(TimedRule { holds: one_stops_in_time, premise: &[TimedPremise::State(|view| view.watch == StopWatch::BothGo(0))], ends_run: true }),
        "YieldsLate";
}

fn holds(view: &View) -> bool {
    view.nodes()
        .all(|node| node.actuation.heard != Heard::Twice || !node.actuation.corridor_open)
}

fn premise(view: &View) -> bool {
    view.nodes()
        .any(|node| node.actuation.heard == Heard::Twice)
}

fn one_stops_in_time(step: &TimedStepView) -> bool {
    let after = step.after;
    !matches!(after.watch, StopWatch::BothGo(ticks) if after.is_over(ticks, after.limits.both_go))
}
