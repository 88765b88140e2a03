//! What tests of several crates share. It is not published: a crate whose tests use it leaves its tests
//! out of its package. Each part is a feature, so that a test builds no more than it uses.
#![allow(
    clippy::missing_panics_doc,
    clippy::must_use_candidate,
    missing_docs,
    reason = "tests are its only users, and its panics are their failures"
)]

#[cfg(feature = "c")]
pub mod c;
#[cfg(feature = "command")]
pub mod command;
#[cfg(feature = "ports")]
pub mod ports;
#[cfg(feature = "rules")]
pub mod rules;

#[cfg(any(feature = "c", feature = "command"))]
mod built;
