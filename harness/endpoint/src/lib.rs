//! One robot without input and output: the verified state machine of [`crossguard_protocol`] joined to packets.
//!
//! Packets, events and the time go in; packets, acts and records for the log come out. A robot stack that has
//! a loop of its own embeds this crate; `crossguard-robot` is such a loop.
//!
//! ```text
//!   packet ──► station ──► wire ──► inputs ─┐                  ┌─► act (start, stop, corridor, notice)
//!   event ──────────────────────────────────┼─► Robot::step ───┤
//!   time ───────────────────────────────────┘                  └─► ras ──► wire ──► station ──► packet
//! ```
//!
//! - [`Endpoint`] joins them.
//! - [`station`] is what makes it an ITS station: messages in `GeoNetworking` packets, security, and a map of
//!   the stations around.
//! - [`wire`] encodes and decodes the messages of robots.
//! - [`ras`] has the rules of the Robot Awareness Service: when a RAM is sent and why, and clusters of the
//!   people around a robot.
//! - [`counters`] names the cause of every drop.

pub mod counters;
mod endpoint;
pub mod ras;
pub mod station;
pub mod wire;

pub use endpoint::{Act, Effect, Endpoint, Moment, Stimulus};

/// The Rust in the README compiles.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
