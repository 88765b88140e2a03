//! The rules of the protocol and the hazards that they are for, as scripts: robots on a street, what they are told, and what
//! they say.
#![allow(clippy::wildcard_imports, reason = "scripts use the whole vocabulary")]

mod beyond_scripts;
mod every_guard_counts;
mod interpreter;
mod numbers_that_a_peer_cannot_use_up;
mod script;
mod serialization;
mod settings;
mod valid;
