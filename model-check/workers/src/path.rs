//! A run, from what may lie on it.

use std::collections::HashSet;

use crossguard_model_check::model::{Action, Model, ModelState};

use crate::table::Fingerprint;
use crate::threads::Candidates;

/// A state on the way, and the ways out of it that were not tried yet.
struct Stop {
    state: ModelState,
    untried: Vec<(Action, ModelState)>,
}

/// A run from the initial state through states of these fingerprints, level by level; `None` where fingerprints
/// collide so that there is none.
pub(crate) fn run(
    model: &Model,
    candidates: &Candidates,
) -> Option<Vec<(ModelState, Option<Action>)>> {
    let out_of = |state: &ModelState, level: usize| {
        let Some(next_ones) = candidates.get(level + 1) else {
            return Vec::new();
        };
        let mut actions = Vec::new();
        model.actions_in(state, &mut actions);
        actions
            .into_iter()
            .filter_map(|action| Some((action, model.successor_up_to_symmetry(state, action)?.0)))
            .filter(|(_, next)| next_ones.contains(&Fingerprint::of(next)))
            .collect()
    };
    let first = model.initial();
    let mut path = vec![Stop {
        untried: out_of(&first, 0),
        state: first,
    }];
    let mut taken: Vec<Action> = Vec::new();
    let mut dead: HashSet<(usize, ModelState)> = HashSet::new();
    while path.len() < candidates.len() {
        let level = path.len();
        let Some((action, next)) = path.last_mut()?.untried.pop() else {
            let end = path.pop()?;
            taken.pop();
            dead.insert((path.len(), end.state));
            continue;
        };
        if !dead.contains(&(level, next.clone())) {
            taken.push(action);
            path.push(Stop {
                untried: out_of(&next, level),
                state: next,
            });
        }
    }
    let actions = taken.into_iter().map(Some).chain([None]);
    Some(
        path.into_iter()
            .map(|stop| stop.state)
            .zip(actions)
            .collect(),
    )
}
