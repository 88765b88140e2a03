//! Messages to and from what the protocol reads and writes, and what the application adds.
//!
//! | from | to | by |
//! |---|---|---|
//! | robot state, view of the protocol | RAM | [`ram_from`] |
//! | RAM | view, state, availability | [`view_of_ram`], [`state_of`], [`availability_of`] |
//! | commands with their task parameters | RMCM | [`rmcm_from_commands`] |
//! | answer with its execution status | RMCM | [`rmcm_from_answer`] |
//! | RMCM | views, one per commanded follower | [`views_of_rmcm`] |
//! | RMCM | task parameters, map reference, status | [`task_parameters_of`], [`map_place_of`], [`execution_of`] |
//! | basic container | position | [`position_of`](crate::position_of) |
//!
//! The mapping is lossless on everything that the transition function reads, which the [`laws`] say. A message that
//! contradicts itself is refused with the contradiction, in either direction, so what one robot can
//! say every other one understands.

pub mod laws;
mod ram;
mod rmcm;
mod role;
mod task;

use crossguard_protocol::{List, StationId};

use crate::error::ViewError;

pub use ram::{availability_of, ram_from, state_of, view_of_ram};
pub use rmcm::{
    execution_of, map_place_of, rmcm_from_answer, rmcm_from_commands, task_parameters_of,
    views_of_rmcm,
};
pub use task::{ExecutionStatus, MapPlace, NoMapPlace, Target, TaskParameters};

/// Checks that a leader names every follower once, and not itself.
fn check_followers(
    leader: StationId,
    followers: impl Iterator<Item = StationId> + Clone,
) -> Result<(), ViewError> {
    let mut rest = followers;
    while let Some(follower) = rest.next() {
        if follower == leader {
            return Err(ViewError::OwnFollower(leader));
        }
        if rest.clone().any(|other| other == follower) {
            return Err(ViewError::NamedTwice(follower));
        }
    }
    Ok(())
}

/// The list of all these items, if there are not more than it can hold.
fn all_of<T: Copy, const N: usize>(items: impl Iterator<Item = T>) -> Option<List<T, N>> {
    let mut list = List::EMPTY;
    for item in items {
        list.push(item).ok()?;
    }
    Some(list)
}
