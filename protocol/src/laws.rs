//! The laws of the protocol, as functions that assert, and arbitrary values to call them with.
//!
//! One body, three callers: the `proofs` crate calls each law with symbolic
//! values under Kani, with random ones under proptest, and with all values where there are few. The
//! values come from one description too, written over a [`Source`] of numbers.
//!
//! Not for use in an endpoint, and not part of the stable interface.
//!
//! ```text
//!  Source ──► arbitrary: Config, Robot, Input ──► numbers, lists, lease   laws of values
//!                                                 steps, watch            laws of one step
//!                                                 timers                  laws of elapsed time
//! ```

pub mod arbitrary;
pub mod lease;
pub mod lists;
pub mod numbers;
pub mod steps;
pub mod timers;
pub mod watch;

mod source;

pub use source::Source;
