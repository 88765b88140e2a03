//! How stateright explores a model.

use std::hash::Hash;
use std::time::Duration;

use stateright::{Checker, CheckerBuilder};

use crate::exploration::Stop;
use crate::report::CutOff;

/// Lets stateright explore a model until nothing is left, or until `watch` says why it has to end. `watch` receives how many
/// distinct states it has found, and how many steps they are away. Once `drain` is requested nothing happens any more in the
/// model, and all threads end with what they have. stateright's own time limit is not used: it holds up threads that share
/// work, for minutes.
pub(crate) fn by_stateright<M>(
    builder: CheckerBuilder<M>,
    drain: &Stop,
    mut watch: impl FnMut(usize, usize) -> Option<CutOff>,
) -> (impl Checker<M>, Option<CutOff>)
where
    M: stateright::Model + Send + Sync + 'static,
    M::State: Hash + Send + Sync + 'static,
{
    let checker = builder.spawn_bfs();
    let mut cut_off = None;
    while !checker.is_done() {
        std::thread::sleep(Duration::from_millis(20));
        let reached = watch(checker.unique_state_count(), steps(&checker));
        cut_off = cut_off.or(reached);
        if cut_off.is_some() {
            drain.request();
        }
    }
    let checker = checker.join();
    // It goes runs again in order to tell them.
    drain.withdraw();
    (checker, cut_off)
}

/// Steps from the initial state to the farthest one: stateright counts the initial state.
pub(crate) fn steps<M: stateright::Model>(checker: &impl Checker<M>) -> usize {
    checker.max_depth().saturating_sub(1)
}
