//! The crossing machine in virtual time: who waits, what is clear, who is where, and whole crossings with real robots.
#![allow(clippy::wildcard_imports, reason = "scripts use the whole vocabulary")]

mod escort;
mod ground;
mod leader;
mod occupancy;
mod outsider;
mod position;
mod scene;
mod sequence;
mod standing;
mod team;
mod tracks;
mod traffic;
mod whole;
