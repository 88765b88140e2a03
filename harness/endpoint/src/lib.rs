//! One robot without input and output: the verified state machine of [`crossguard_protocol`] joined to packets.
//!
//! Packets, events and the time go in; packets, acts and records for the log come out. A robot stack that has
//! a loop of its own embeds this crate; `crossguard-robot` is such a loop.
//!
//! ```text
//!   packet ──► stack ──► message ──► inputs ─┐                  ┌─► act (start, stop, corridor, notice)
//!   event ───────────────────────────────────┼─► Robot::step ───┤
//!   time ────────────────────────────────────┘                  └─► message ──► stack ──► packet
//! ```
//!
//! - [`exchange`] is that picture, without heap and standard library. The C library is a skin on it.
//! - [`Endpoint`] adds what needs a heap: a map of the stations around, clusters of people, security.
//! - [`ras`] has the rules of the Robot Awareness Service: when a RAM is sent and why, and clusters of the
//!   people around a robot.
//! - [`station`] has the map, pseudonyms, and what a listener makes of packets.
//! - [`cause`] names why something is dropped, [`counters`] counts it.
//!
//! Without the feature `std` there are [`exchange`], [`cause`] and the generation rules. Without `foreign`, messages
//! of other stations than robots are neither read nor sent; without `security`, nothing is signed or verified.
#![cfg_attr(not(any(feature = "std", test)), no_std)]

pub mod cause;
#[cfg(feature = "std")]
pub mod counters;
#[cfg(feature = "std")]
mod endpoint;
pub mod exchange;
pub mod ras;
#[cfg(feature = "std")]
pub mod station;

#[cfg(feature = "std")]
pub use endpoint::{Effect, Endpoint, Served, Stimulus};
pub use exchange::Moment;

/// The Rust in the README compiles.
#[cfg(all(doctest, feature = "foreign", feature = "security"))]
#[doc = include_str!("../README.md")]
struct Readme;
