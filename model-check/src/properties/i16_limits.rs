//! I16: retries ≤ `N_ack`; every timer age ≤ its limit.
//!
//! The timers' limits are among the clauses of `is_valid`, which I13 checks on every step.

use super::{StateRule, View};

pub(super) const RULE: StateRule = StateRule { holds, premise };

fn repeats<'a>(view: &View<'a>) -> impl Iterator<Item = u8> + use<'a> {
    view.leaders().flat_map(|(_, leading)| {
        leading
            .members
            .iter()
            .filter_map(|member| Some(member.outstanding?.repeats))
    })
}

fn holds(view: &View) -> bool {
    repeats(view).all(|repeats| repeats <= view.config().settings().n_ack)
}

fn premise(view: &View) -> bool {
    repeats(view).any(|repeats| repeats == view.config().settings().n_ack)
}
