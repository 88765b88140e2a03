//! The demonstration, and what the `crossguard` command adds to the crates below it.
//!
//! ```text
//!   crossguard-harness     the command, the demonstration
//!    ├─► crossguard-evaluation   the paper's evaluation: coverage, channel load
//!    ├─► crossguard-judge        simulation, validation, replay, reports
//!    │    └─► crossguard-robot        a robot as a process
//!    └───────► ├─► crossguard-endpoint     a robot without input and output
//!              │    └─► crossguard-codec         messages, packets, security
//!              └────────► crossguard-protocol    the verified state machine
//! ```
//!
//! - [`demo`] is the paper's crossing and its extensions to teams, with simulated bodies.
//! - [`studio`] serves a page on which logs are looked at.
//! - [`metrics`] serves what Prometheus wants to know of a running robot.

// A standard error that cannot be written to ends nothing.
#![deny(clippy::print_stderr)]

#[doc(hidden)]
pub mod cli;
pub mod demo;
#[cfg(feature = "full")]
mod http;
#[cfg(feature = "full")]
pub mod metrics;
#[cfg(feature = "full")]
pub mod studio;

/// The Rust in the README compiles.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
