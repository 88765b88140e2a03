//! A Crossguard robot as a node of ROS 2, over zenoh, for systems with `rmw_zenoh`.
//!
//! No part of ROS 2 is needed to build or run it: the node speaks the wire format of `rmw_zenoh_cpp`, and
//! any ROS 2 system with that RMW sees an ordinary lifecycle node. The README says which distributions
//! those are, what is told on which topic, and how it was checked.
//!
//! ```text
//!   crossguard_msgs/msg/*.msg ──► idl ──► types (hashes) ──┐
//!                                                          ▼
//!   msgs, standard (structs) ──► message (CDR) ──► graph (keys, tokens, attachments) ◄──► zenoh
//!                                                          ▲
//!   crossguard_robot::runtime ◄──► robot ◄──► node ──────┘
//!                                               ├── lifecycle, command, report
//! ```
//!
//! # Why the mapping is our own
//!
//! What `rmw_zenoh` puts on the wire is little: two forms of key expressions, 33 octets of attachment, plain
//! CDR and a hash. Crates that have it were looked at on 2026-11-22:
//!
//! - `hiroz` 0.2.1 (the former `ros-z`, by the makers of zenoh) brings Python bindings, actions, shared
//!   memory, a serial transport and zenoh's default transports (its `hiroz-protocol` wants them), and the
//!   hashes of its lifecycle services are written in by hand and are not those of `lifecycle_msgs`.
//! - `natnet_zenoh` 0.1.0 has the mapping within a bridge for motion capture, is of one release, and wants
//!   a newer Rust than this workspace.
//! - CDR is that of `cdr-encoding`, which `RustDDS` is built on; XXH3 is of `xxhash-rust`, SHA-256 of `sha2`.

mod acts;
pub mod attachment;
pub mod command;
pub mod entity;
pub mod graph;
pub mod idl;
pub mod lifecycle;
pub mod message;
pub mod msgs;
pub mod node;
pub mod qos;
mod report;
pub mod robot;
pub mod standard;
pub mod types;

pub use report::SITE_FRAME;
