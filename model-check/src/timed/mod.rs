//! The timed view: time passes in ticks, urgent timers cannot be skipped, messages take time, clocks
//! drift.
//!
//! ```text
//!   scenarios/timed-*.toml ──► section ──► model ◄── crossguard_protocol::Robot::step
//!                                            │
//!             state, what may happen in it (actions), what comes of it (successor)
//!                                            │
//!          properties ◄── judge, measure ◄── explore ──► check ──► report, figures in ms
//! ```
//!
//! The untimed model ([`model`](crate::model)) lets any armed timer expire at any moment, so it says
//! nothing about how long something takes. This one gives each robot the time that has passed, by the
//! very input that an endpoint uses, and so finds the lease theorem (I10) and the longest times.
//!
//! # What the discretisation stands for
//!
//! - *Endpoints that look once a tick* (`free = false`). All robots take in the time at the same ticks, and
//!   messages and events between two ticks, which takes no time. Every run of the model is one of real
//!   robots whose endpoints look once a tick; a timer may fire up to one tick late, which
//!   `delay_max` must allow. So every counterexample and every figure is one that can happen.
//! - *Endpoints that look when they like* (`free = true`). After each tick each endpoint looks, or does
//!   not, in any order with the messages and events of that tick; it looks at the latest `delay_max` after
//!   a timer of its robot became due, on its own clock, for it has no other. A robot takes in the time before a
//!   message or an event. As long as none of its timers is due it makes no difference when it does (what passes
//!   in two parts passes in one), so in the model it does at once, and only a robot with a due timer waits. Every
//!   run of the synchronous view is one of these, and every one of these is one of real robots. Endpoints that
//!   look between two ticks are not explored: their delays count as whole ticks, and a message that arrives just
//!   before a timer becomes due counts as one of the tick before.
//! - *Late endpoints* (`late_ms`). How late free endpoints are in truth, where that is not the
//!   `delay_max` of the settings. The bounds are of the settings.
//! - *Clocks.* At each tick the clock of each robot shows either [`slow`](Clock::slow) or
//!   [`fast`](Clock::fast), in any order. Let these be *n* u and (*n* + 1) u. A clock whose rate is
//!   anything between the two, and changes as it likes, gains d of *n* u to (*n* + 1) u in a tick. Read
//!   to whole u it gains floor((x + d) / u) - floor(x / u), and that is *n* or *n* + 1. So the two
//!   choices stand for every clock within the drift, if it is read to u.
//! - *Clocks that keep their rates* (`rates = "constant"`). Each clock is slow for a whole run, or fast for a
//!   whole run, in every combination. That is less than at every tick anew: a clock that changes its rate, or
//!   runs at one in between, is not covered. It is there for models that are too large otherwise.
//! - *Messages* are under way for a whole number of ticks. With endpoints that look once a tick that
//!   leaves out nothing.
//! - *Hangs.* A robot that hangs takes in nothing and sends nothing; its body does what it did
//!   before. After any number of ticks, up to `hang_ms` on its own clock, it goes on and takes in the
//!   whole time at once. Messages that arrived meanwhile are lost: an endpoint throws away what waited longer
//!   than `delay_max`. One robot hangs at a time.
//! - *Two teams.* Where two robots detect, each leads the robots that are listed after it. The teams do not
//!   reach each other until both signs show go, as if they came from two sides; from some moment then every
//!   message between them arrives, as it does within a team. No robot fails, and the run is over once one sign
//!   shows stop.
//! - *News and notices.* For how long a follower has heard no news (I19) and what an application knows
//!   (W6, W8) is judged by the messages that were delivered and the outputs; see `quiet` and `told`.
//! - *The sign* of the leader runs on the leader's clock and ends by itself where its time is limited, also
//!   while the leader hangs. A crash of the leader puts it out.
//! - *Timers that are held.* The identity lock and `T_exec` last longer than anything that is
//!   measured, and are held at their start: no run is as long as they are.
//! - *Repeated messages.* The same message sent anew while it is still under way is one message, sent
//!   last. Nothing is delivered twice; the untimed model does that.
//! - *Applications* do at once what they may: command, open the corridor. That loses nothing of the
//!   figures: a corridor that opens later is not open longer.
//! - *Heartbeats* are counted from the oldest that occurs in a state, which keeps their distances.

mod actions;
mod bounds;
mod channel;
mod check;
pub(crate) mod clock;
mod judge;
pub(crate) mod limits;
mod measure;
mod model;
mod premises;
mod quiet;
pub(crate) mod section;
mod sign;
mod state;
mod successor;
mod system;
pub(crate) mod teams;
pub(crate) mod told;
pub(crate) mod watch;

pub use bounds::{Bound, USUAL_DELAY, bounds};
pub use channel::Flight;
pub use check::check;
pub use clock::{Clock, longest};
pub use limits::Limits;
pub use measure::Figure;
pub use model::TimedModel;
pub use section::{Looks, Rates, Timed};
pub(crate) use section::{Section, no_place_for};
pub use state::{TimedAction, TimedState};
pub use watch::StopWatch;

pub use crate::properties::i10_lease::{has_lease_on_lost, leases};
