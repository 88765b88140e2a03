//! Whole endpoints in virtual time: real packets, seeded faults, and the properties judged at every
//! step.
//!
//! ```text
//!   seed ──► swarm (who, which faults, when what happens)
//!              │
//!              ▼        ┌─ wakes ──► Machine (endpoint, body) ─► steps ──► Monitor, times
//!            world ─────┤                 │ packets, sign ─► people, road
//!                       └─ arrivals ◄── Channel of each way (loss, bursts, delay, outage …)
//! ```
//!
//! A run has two phases. At first robots detect pedestrians, crash, hang, boot again, change their minds and
//! hear each other badly: the safety properties must hold all the same. Then the network is healed. Where a
//! team can exist somebody waits, and a crossing must be completed; then all robots must come to rest. Everything is
//! drawn from the seed, so one number names the whole run; the same program takes the same steps in every run.
//!
//! The robots run the code that real ones run: [`Machine`](crossguard_robot::machine::Machine), codec and ITS
//! station included. The simulator's own parts are a clock, an order of events and a radio.

mod clock;
mod fuzz;
mod insider;
mod place;
mod report;
mod road;
mod ruled;
mod security;
mod swarm;
mod times;
mod world;

pub use fuzz::{Failure, Fuzz, Planned, Totals};
pub use insider::InsiderDraw;
pub use place::{CONFLICT_S, Measured};
pub use report::{Files, write_failure};
pub use ruled::Ruled;
pub use swarm::{
    Arrival, CarDraw, Deed, Demand, Habits, Happening, Hazard, Ids, Replay, RobotDraw, Sensing,
    SourceDraw, Swarm,
};
pub use times::{Longest, Measure, Worst};
pub use world::{Finding, Outcome, Waits, Watch, run, run_recorded, run_with};
