//! The laws of the protocol, as functions that assert, and arbitrary values to call them with.
//!
//! One body, three callers: the `proofs` crate calls each law with symbolic
//! values under Kani, with random ones under proptest, and with all values where there are few. The
//! values come from one description too, written over a [`Source`] of numbers.
//!
//! Not for use in an endpoint, and not part of the stable interface.
//!
//! ```text
//!  Source ──► arbitrary: Config, Robot, Input ──► numbers, lists, lease, settings laws of values
//!                                                 steps: contact, offers, …      laws of one step
//!                                                 timers                         laws of elapsed time
//! ```

pub mod arbitrary;
pub mod budgets;
pub mod causes;
pub mod commands;
pub mod contact;
pub mod exchange;
pub mod farewells;
pub mod lease;
pub mod liars;
pub mod lists;
pub mod news;
pub mod numbers;
pub mod offers;
pub mod requests;
pub mod road;
pub mod settings;
pub mod steps;
pub mod taken;
pub mod timers;
pub mod times;
pub mod watch;

mod arithmetic;
mod part;
mod source;

pub use source::{Random, Source};
