//! Numbers under loss: probabilities and times of a crossing whose messages get lost at random.
//!
//! ```text
//!   setup ──► team ◄── crossguard_protocol::Robot::step
//!              │  what may follow a state in a tick, and how often something is lost on the way
//!              ▼
//!   stage ──► space ──► flow ──► figures      transient analysis, for every loss rate
//! ```
//!
//! # What the model is of
//!
//! - *Robots.* A leader and as many followers as it asks for, each with the transition function of the kit. A tick is
//!   [`Input::Elapsed`](crossguard_protocol::Input::Elapsed).
//! - *Time* passes on a grid. At each of its points every robot takes in the time, then messages arrive in the order
//!   in which they were sent, then the leader's application acts. A timer that is no multiple of the tick fires up to a
//!   tick late, as an endpoint may be. Clocks do not drift.
//! - *Delay.* Each message takes the same time, a multiple of the tick.
//! - *Loss.* Each message is lost on its way to each receiver with the same probability, independently of everything
//!   else. Or losses come in bursts: the link of each follower to its leader is good or bad, in both directions; it
//!   changes at the ticks, a bad one after its mean length on average; everything is lost on a bad one and nothing
//!   on a good one (the model of Gilbert). Its loss rate is its share of bad ticks, and links are independent.
//! - *Applications.* A pedestrian is detected at time 0. The leader selects once all have offered. It commands `move`
//!   to all once the team is full, and opens the corridor as soon as it may. Bodies do what they are told.
//! - *Nobody crashes* or hangs, and nobody else is around.
//!
//! # How it is solved
//!
//! A crossing is taken in [stages](Stage), whose states need no absolute time. The states in which one stage ends, each
//! with its probability, are those in which the next begins, so nothing is lost between them. The identity lock and
//! `T_exec` are held, since a crossing is shorter; the end of the request, `T_help`, is kept by counting ticks.
//!
//! States do not depend on the loss rate; those of a stage are worked out once for all rates.
//!
//! With several followers the states of the later stages are a power of those of one. So the links are taken
//! [one at a time](Coupling::LinkByLink), unless they are to be taken together.

mod analysis;
mod enclosure;
mod figures;
mod flow;
mod setup;
mod space;
mod stage;
mod team;
mod weight;

pub use analysis::{OddsError, OddsModel, OddsProgress, TeamOdds};
pub use enclosure::Enclosure;
pub use figures::{LossOdds, MilestoneOdds, Quantile, ReachedBy, StageSize};
pub use flow::FlowCut;
pub use setup::{Coupling, FOLLOWERS_MAX, OddsImpossibility, OddsSetup, TimeGrid};
pub use stage::{Milestone, Stage};
