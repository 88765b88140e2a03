//! A robot as a process: what surrounds the endpoint of [`crossguard_endpoint`] where a robot really is.
//!
//! ```text
//!   packets ──► transport ──► runtime ──► machine ──┬──► endpoint
//!   sensors ──► perception ─────┘  │                └──► application ──► body, sign
//!   log     ◄── journal ◄──────────┘
//! ```
//!
//! - [`machine::Machine`] joins an endpoint and an [`application`] with a [`body`] and a [`plan`], still without
//!   input and output.
//! - [`runtime`] drives it, with threads and a bounded inbox; [`journal`] is where its records go, and waits
//!   for no reader. [`robot_file`] is its configuration.
//! - [`transport`] has UDP to peers, UDP multicast, Ethernet, queues within a process, and a layer of
//!   seeded faults over any of them; [`capture`] writes packets to pcap files and reads them.
//! - [`site`], [`street`], [`zone`] and [`perception`] are what the robot knows of the crossing and the people
//!   there; [`sight`] is what its log says of them, [`around`] what it says of other road users, and [`sign`]
//!   what people at the road see.
//! - [`site_file`] and [`plan_file`] are sites and plans as files, which demonstrations and robots read.
//! - [`trace`] is the log, one JSON object per line; [`tally`] sums it up.
//! - [`boot`] is the counter that makes session numbers unique over power failures, and what a robot that signs
//!   remembers besides; [`clock`] is whether it trusts its clock.
//! - [`operator`] reads what a person types, and serves the port by which other programs do; [`port`] has the sockets.
//! - [`pki`] has the certificates and keys that it signs with, for tests.

pub mod application;
pub mod around;
pub mod attachment;
pub mod body;
pub mod boot;
#[cfg(feature = "full")]
pub mod capture;
pub mod channel;
pub mod clock;
pub mod files;
pub mod journal;
pub mod lines;
mod located;
pub mod machine;
#[cfg(feature = "full")]
pub mod operator;
pub mod perception;
pub mod pki;
pub mod plan;
pub mod plan_file;
#[cfg(feature = "full")]
pub mod port;
#[cfg(feature = "full")]
pub mod robot_file;
pub mod runtime;
pub mod sight;
pub mod sign;
pub mod site;
pub mod site_file;
pub mod street;
#[cfg(test)]
mod table;
pub mod tally;
pub mod trace;
pub mod transport;
pub mod zone;
