//! The C ABI of Crossguard: the verified state machine with its messages and packets, for robot stacks
//! in C, C++ and whatever calls C.
//!
//! ```text
//!   C, C++ ──► ffi ──► live ──► crossguard_protocol::Robot::step
//!   memory,    the     │  └───► crossguard_codec: RAM, RMCM, GeoNetworking, BTP-B
//!   time,      only    ├─► output, view: plain numbers
//!   buffers    unsafe  └─► trace: lines for `crossguard validate`
//! ```
//!
//! - Memory, time and buffers are the caller's. Nothing is allocated, nothing is called back, nothing
//!   reads a clock, and there is no global state.
//! - A robot lives in a [`CrossguardRobot`] of fixed size. A stamp in it tells one that was never
//!   initialised, was finished, or is of another version.
//! - Every call returns a [`CrossguardStatus`]. The robot's outputs come back in order in a
//!   [`CrossguardTurn`], with packets that are ready to be sent.
//! - No panic crosses the boundary: it stops the process, or is the panic handler's without `std`.
//!
//! ```c
//! CrossguardConfig config;
//! crossguard_config_init(&config);
//! config.station = 2;
//! config.boot = boot;                       /* counted up, and on the disk before this */
//! static CrossguardRobot robot;
//! static CrossguardTurn turn;
//! static uint8_t packets[CROSSGUARD_PACKETS_LEN];
//! crossguard_turn_init(&turn, packets, sizeof packets, NULL, 0);
//! if (crossguard_robot_init(&robot, sizeof robot, CROSSGUARD_ABI_VERSION, &config) != CROSSGUARD_STATUS_OK)
//!     return 1;
//! crossguard_elapse(&robot, elapsed_ms, &turn);   /* time first, then what happened in it */
//! for (size_t i = 0; i < turn.outputs_length; i++)
//!     carry_out(&turn.outputs[i], packets);
//! ```
//!
//! | module | what is in it |
//! |---|---|
//! | `abi`, `codes` | the types and constants of the header |
//! | `ffi` | the functions; the only `unsafe` |
//! | `live` | a robot: state machine, codec stack, log |
//! | `config`, `body`, `output`, `view`, `cause` | Rust's types as plain numbers, and back |
//! | `trace` | lines of the log |
//!
//! Features: `std` (default) links the standard library for its panic handler and nothing else, `trace`
//! (default) writes logs, `panic-handler` brings a panic handler where there is no `std`.
//!
//! `include/crossguard.h` is generated from this crate, `include/crossguard.hpp` is a thin layer of C++17
//! over it. The README beside this crate says how to build and link it.
#![no_std]

#[cfg(feature = "std")]
extern crate std;

mod abi;
mod body;
mod codes;
mod config;
mod counters;
mod ffi;
mod live;
mod output;
mod place;
#[cfg(all(feature = "panic-handler", not(feature = "std")))]
mod stop;
mod trace;
mod view;

pub use abi::*;
pub use ffi::*;
