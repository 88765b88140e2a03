//! Endpoints, transports and the crossing of Crossguard.
//!
//! What surrounds the transition function of [`crossguard_protocol`] on a robot that is really
//! there: messages on a link, a clock, an application with a body, a log, a boot counter. It holds
//! no rule of the protocol.
//!
//! ```text
//!   packets ──► transport ──► station ──► wire ──┐             ┌──► application ──► body
//!                                                ▼             │        │
//!   clock ─────────────────────────────────► endpoint ◄────────┼────────┘ events
//!                                            Robot::step ──────┤
//!   packets ◄── transport ◄── station ◄── wire ◄── ras ◄───────┘──► trace (log)
//! ```
//!
//! ```
//! use crossguard_harness::sim::Fuzz;
//!
//! // Three streets of up to four robots, with whatever goes wrong on them.
//! let streets = Fuzz { first: 1, seeds: 3, robots: 4, faults: None, threads: 1, failures_max: 1 };
//! let totals = streets.run(&|_| true);
//! assert_eq!((totals.seeds, totals.violations), (3, 0));
//! ```
//!
//! - [`endpoint::Endpoint`] joins them without doing any input or output of its own: datagrams,
//!   events and the time go in, datagrams and outputs come out. A robot stack with its own loop
//!   embeds this.
//! - [`station`] is what makes it an ITS station: messages in `GeoNetworking` packets, and a map of
//!   who is around; [`capture`] writes packets to pcap files and reads them, and [`sniffer`] says what
//!   is in them.
//! - [`pki`] has the certificates and keys that it signs with, for tests.
//! - [`ras`] has the rules of the Robot Awareness Service: when a RAM is sent and why, and clusters of
//!   the people around a robot.
//! - [`evaluation`] simulates the paper's street grid: how many people robots see, and the channel load.
//! - [`machine::Machine`] adds an [`application`] with a simulated [`body`] and a [`plan`], still without
//!   input and output.
//! - [`runtime`] is such a loop, with threads and a bounded inbox; [`journal`] is where its records go,
//!   and waits for no reader. [`transport`] has UDP to peers, UDP multicast, Ethernet, zenoh, queues
//!   within a process, and a layer of seeded faults over any of them.
//! - [`sim`] runs many machines in virtual time under seeded faults, and judges every step.
//! - [`trace`] is the log, one JSON object per line; [`validate`] tells whether logs of one or several
//!   robots are of something that could have happened.
//! - [`facts`] works out of logs where robots are and what they do; [`mcap_file`] writes that for Foxglove,
//!   [`report`] for people.
//! - [`readable`] has messages and packets as JSON.
//! - [`observe`] tells `tracing` what a robot does; [`tally`] and [`metrics`] say how it is.
//! - [`sign`] is what people at the road see, [`street`] what robots know of the people.
//! - [`boot`] is the counter that makes session numbers unique over power failures.
//! - [`demo`] is the paper's crossing and its extensions to teams, with simulated [`body`]s; [`timing`] is
//!   its table, [`chart`] its sequence chart.
//! - [`drive`] drives endpoints along a run of the model checker, and compares the two.
//! - [`robot_file`] and [`operator`] are what `crossguard run` reads: a configuration, and what a
//!   person types.
//!
//! There are no features.

pub mod application;
pub mod body;
pub mod boot;
pub mod capture;
pub mod chart;
pub mod counters;
pub mod demo;
pub mod drive;
pub mod endpoint;
pub mod evaluation;
pub mod facts;
pub mod journal;
pub mod machine;
pub mod mcap_file;
pub mod metrics;
pub mod observe;
pub mod operator;
pub mod perception;
pub mod pki;
pub mod plan;
pub mod ras;
pub mod readable;
pub mod report;
pub mod robot_file;
pub mod runtime;
pub mod sequence;
pub mod sign;
pub mod sim;
pub mod site;
pub mod sniffer;
pub mod station;
pub mod street;
pub mod tally;
pub mod timing;
pub mod trace;
pub mod transport;
pub mod validate;
pub mod wire;

/// The Rust in the README compiles.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
