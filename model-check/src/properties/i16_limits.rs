//! I16: retries ≤ `N_ack`; every timer age ≤ its limit.
//!
//! The timers' limits are among the clauses of `is_valid`, which I13 checks on every step.

use super::prelude::*;

property! {
    "I16", Authentication::NONE;
    untimed S "commands are repeated at most N_ack times",
        Some("a command has been repeated N_ack times"),
        Rule::State(StateRule { holds, premise, of_two: false }),
        "RepeatsOnceTooOften";
    timed S "no timer has more time left than it was started with, and none stays due",
        None,
        Rule::Timed(TimedRule { holds: |step: &TimedStepView| step.robots.are_valid, premise: &[], ends_run: false }),
        "asks_too_long";
}

/// How often each outstanding command was repeated, and how often it may be.
fn repeats<'a>(view: &View<'a>) -> impl Iterator<Item = (u8, u8)> + use<'a> {
    view.configured().flat_map(|(node, config)| {
        let members = node.leading().into_iter().flat_map(|l| l.members.iter());
        members.filter_map(|member| Some((member.outstanding?.repeats, config.settings().n_ack)))
    })
}

fn holds(view: &View) -> bool {
    repeats(view).all(|(repeats, n_ack)| repeats <= n_ack)
}

fn premise(view: &View) -> bool {
    repeats(view).any(|(repeats, n_ack)| repeats == n_ack)
}
