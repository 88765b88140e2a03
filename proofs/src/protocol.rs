//! Harnesses of the laws of `crossguard-protocol`.
//!
//! Those of the transition function start from every valid state, whether it can be reached or not,
//! with the default configuration; those of elapsed time and of the start with every configuration
//! whose numbers are in range. Each has inputs of one kind, or
//! of some kinds case by case, in one stage.

pub mod boot;
pub mod exchange;
pub mod following;
pub mod idle;
pub mod ignored;
pub mod leading;
pub mod lease;
pub mod lists;
pub mod numbers;
pub mod offering;
pub mod requesting;
pub mod settings;
pub(crate) mod stage;
pub mod timers;
