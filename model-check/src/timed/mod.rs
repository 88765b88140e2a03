//! The timed view: time passes in ticks, urgent timers cannot be skipped, messages take time, clocks
//! drift.
//!
//! ```text
//!   scenarios/timed-*.toml ──► section ──► model ◄── crossguard_protocol::Robot::step
//!                                            │
//!                       rules, watch ◄── explore ──► check ──► report, figures in ms
//! ```
//!
//! The untimed model ([`model`](crate::model)) lets any armed timer expire at any moment, so it says
//! nothing about how long something takes. This one tells each robot how much time has passed, by the
//! very input that an endpoint uses, and so finds the lease theorem (I10) and the longest times.
//!
//! # What the discretisation stands for
//!
//! - *Endpoints that look once a tick.* All robots are told of time at the same ticks, and of messages
//!   and events between two ticks, which takes no time. Every run of the model is one of real robots
//!   whose endpoints look once a tick; a timer is told to be due up to one tick late, which `delay_max`
//!   must allow. So every counterexample and every figure is one that can happen. What happens
//!   between the ticks of a quicker endpoint is not explored.
//! - *Clocks.* At each tick the clock of each robot shows either [`slow`](Clock::slow) or
//!   [`fast`](Clock::fast), in any order. Let these be *n* u and (*n* + 1) u. A clock whose rate is
//!   anything between the two, and changes as it likes, gains d of *n* u to (*n* + 1) u in a tick. Read
//!   to whole u it gains floor((x + d) / u) - floor(x / u), and that is *n* or *n* + 1. So the two
//!   choices stand for every clock within the drift, if it is read to u.
//! - *Messages* are under way for a whole number of ticks. With endpoints that look once a tick that
//!   leaves out nothing.
//! - *Timers that are held.* The identity lock and `T_exec` last longer than anything that is
//!   measured, and are held at their start: no run is as long as they are.
//! - *Repeated messages.* The same message sent anew while it is still under way is one message, sent
//!   last. Nothing is delivered twice; the untimed model does that.
//! - *Applications* do at once what they may: command, open the corridor. That loses nothing of the
//!   figures: a corridor that opens later is not open longer.
//! - *Heartbeats* are counted from the oldest that occurs in a state, which keeps their distances.

mod channel;
mod check;
mod clock;
mod explore;
mod model;
mod rules;
mod section;
mod watch;

pub use channel::Flight;
pub use check::check;
pub use clock::{Clock, longest};
pub use model::{Action, Model, State};
pub use rules::TimedProperty;
pub(crate) use rules::has_lease_on_lost;
pub(crate) use section::Section;
pub use section::{Timed, TimedImpossibility};
pub use watch::{Figure, Limits, Watch};
