//! The C ABI of Crossguard: the verified state machine with its messages and packets, for robot stacks
//! in C, C++ and whatever calls C.
//!
//! ```text
//!   C, C++ ──► ffi ──► live ──► crossguard_protocol::Robot::step
//!   memory,    the     │  └───► crossguard_codec: RAM, RMCM, GeoNetworking, BTP-B
//!   time,      only    ├─► output, why, view: plain numbers
//!   buffers    unsafe  └─► trace: lines for `crossguard validate`
//! ```
//!
//! - Memory, time and buffers are the caller's. Nothing is allocated, nothing is called back, nothing
//!   reads a clock, and there is no global state.
//! - A robot lives in a [`CrossguardRobot`] of fixed size. A stamp in it tells one that was never
//!   initialised, was finished, or is of another version.
//! - Every call returns a [`CrossguardStatus`]. What a robot is to do comes back in order in a
//!   [`CrossguardTurn`], with packets that are ready to be sent.
//! - No panic crosses the boundary: it stops the process, or is the panic handler's without `std`.
//!
//! `include/crossguard.h` is generated from this crate, `include/crossguard.hpp` is a thin layer of C++17
//! over it. The README beside this crate says how to build and link it.
#![no_std]

#[cfg(feature = "std")]
extern crate std;

mod abi;
mod body;
mod cause;
mod config;
mod ffi;
mod live;
mod output;
#[cfg(all(feature = "panic-handler", not(feature = "std")))]
mod stop;
mod trace;
mod view;
mod why;

pub use abi::*;
pub use ffi::*;
