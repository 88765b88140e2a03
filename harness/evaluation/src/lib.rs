//! The paper's evaluation of the Robot Awareness Service: how many people robots see, and how much less
//! is on the air when they stand in for people's devices.
//!
//! ```text
//!  SUMO (a process) ──► trace ──► coverage ───────────────────────► matrix ──► table, JSON, CSV
//!                         └─────► simulation: stations by the rules of `ras` ──┘
//!                                  radio: air time, carrier sense, EDCA
//! ```
//!
//! - [`grid`] is the street grid, [`net`] any other streets, [`stationing`] where robots are on them, [`schedule`] the same
//!   by a file. [`sumo`] makes mobility, [`fcd`] reads it, [`trace`] keeps it, [`shipped`] are the traces that come along.
//! - [`coverage`] is the observation coverage ratio, and the greedy placement of robots.
//! - [`vru`] is the station of a road user: when it sends a VAM, when it leaves that to a robot, and when it takes it up
//!   again.
//! - [`simulation`] is a run on the air of stations with one [`behaviour`], with [`messages`] of real size, on the channel of [`radio`].
//! - [`matrix`] are all cells of the evaluation, over seeds and cores; [`statistics`] their mean and
//!   deviation, [`paper`] what the paper states, [`statements`] whether a run meets it.
//!
//! `harness/doc/evaluation.md` says which assumptions reproduce the paper, and which do not.

pub mod behaviour;
pub mod coverage;
mod crew;
mod device;
mod dispatch;
pub mod fcd;
pub mod grid;
pub mod matrix;
pub mod messages;
pub mod net;
pub mod paper;
pub mod radio;
mod robot;
pub mod schedule;
pub mod shipped;
pub mod simulation;
pub mod statements;
pub mod stationing;
pub mod statistics;
pub mod sumo;
pub mod trace;
pub mod vru;
mod xml;

pub use crew::Sessions;
pub use robot::RobotError;
pub use xml::SumoFileError;
