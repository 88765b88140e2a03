//! The crossing machine of Crossguard: from the sensor to the sign.
//!
//! The protocol is verified under the assumption that its application's words are true: *pedestrian detected*, *in
//! position*, *open corridor*, *road clear*, *task completed*. This crate is that application, written once: what a
//! robot believes of the people, guards and vehicles at its crossing, and what it tells the protocol, the sign and
//! the body by that.
//!
//! ```text
//!   frames ───────► tracks ───── who waits ──────────────► call ─┐
//!      └──────────► occupancy ── is the road clear ──────► end   │
//!   CAM, CPM ─────► traffic ──── can they stop ──────┐           ├──► events ──► Robot::step
//!   poses, RAM ───► position ─── is each guard there ┼──► go  ───┤
//!   notices ──────► lead ─────── stages of the plan ─┘           └──► sign, body
//! ```
//!
//! Its beliefs are conservative by construction: silence, old input, a lost track and an unknown field never make
//! anything safer. It is `no_std`, without heap, clock, floating point and `unsafe`, total, and of fixed capacity. Time is an
//! input ([`Input::Elapsed`]); places are centimetres on the site.
//!
//! Its assumptions about sensors are in [`Sensors`].
#![no_std]

#[cfg(test)]
extern crate std;

mod crossing;
mod ground;
mod input;
#[cfg(any(test, feature = "laws"))]
pub mod laws;
mod lead;
pub mod occupancy;
mod plan;
pub mod position;
mod setup;
pub mod tracks;
pub mod traffic;

pub use crossing::Crossing;
pub use ground::{CORNERS_MAX, Coverage, FAR_CM, Ground, Point, Shape, Way};
pub use input::{
    BodyReport, Frame, FrameDrop, Hindrance, Input, MAX_OUTPUTS, Output, Outputs, Pose, RoadUser,
    Sighting, Vehicle,
};
pub use plan::{Leg, Plan, STAGES_MAX, Stage, Who};
pub use setup::{PositionRules, Sensors, Setup, TrafficRules, WaitingRules};
