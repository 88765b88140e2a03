//! Exhaustive checks of the Crossguard coordination protocol.
//!
//! ```text
//!   scenarios/*.toml ──► scenario ──► model ◄── crossguard_protocol::Robot::step
//!                                       │
//!                        ┌──────────────┴──────────────┐
//!                     explore ──► fair            stateright
//!              properties of states, steps      second opinion on states
//!              and, under fairness, of runs        and single steps
//!                        └──────────────┬──────────────┘
//!                                     check ──► report
//! ```
//!
//! The model calls the protocol's transition function and has no rule of its own. The environment of the
//! robots is in the model: a channel that loses, delays, repeats and reorders, applications that do
//! anything they may, timers that expire at any moment, crashes. Scenarios bound how often some of
//! this happens, and each verdict says under which bounds it was found.
//!
//! ```
//! use crossguard_model_check::check::{Options, check};
//! use crossguard_model_check::model::Model;
//! use crossguard_model_check::scenario::Scenario;
//!
//! let scenario = Scenario::load("stable").unwrap();
//! let report = check(&Model::new(scenario), &Options::default(), &mut |_| ());
//! assert!(report.exhaustive);
//! assert_eq!(report.violated().count(), 0);
//! ```
//!
//! - [`scenario`] reads what is to be explored, [`model`] says what may happen in it, with the robots of
//!   [`node`], the channel of [`network`] or [`monotone`] and what must be remembered of the past in [`history`].
//! - [`properties`] are the rules, [`check`] and [`report`] say whether they hold, [`fair`] decides
//!   leads-to, [`timed`] is the view in which time passes in ticks.
//! - [`road`] is what bodies, signs and a pedestrian do.
//! - [`odds`] are probabilities and expected times under loss, from the same transition function.
//! - [`sequence`] draws counterexamples, [`replay`] follows them again, [`walk`] goes through a scenario step by
//!   step.
//! - [`monitor`] judges running robots by the same rules; [`universe`], [`transitions`] and [`fsm`] are one
//!   robot against everything, and the diagram of that.
//! - [`paper`] is the paper's text as it stands, which fails.
//!
//! There are no features. In WebAssembly, which stateright is not made for, [`walk`] and what it needs are there: no check, no
//! [`paper`].
//!
//! States that differ in names alone count as one in every scenario. Where a scenario names symmetric robots, so
//! do states that differ in which of these is which; [`symmetry`] says why that is exact.

#![cfg_attr(
    target_arch = "wasm32",
    allow(unused, unreachable_pub, reason = "checks alone need it")
)]

#[cfg(not(target_arch = "wasm32"))]
mod by_stateright;
mod canonical;
mod chart;
#[cfg(not(target_arch = "wasm32"))]
pub mod check;
#[cfg(not(target_arch = "wasm32"))]
pub mod crossing;
mod exploration;
mod explore;
pub mod fair;
mod fairness;
pub mod fsm;
mod held;
pub mod history;
mod intern;
mod lookup;
mod memo;
pub mod model;
pub mod monitor;
pub mod monotone;
pub mod names;
pub mod network;
pub mod node;
mod numbered;
pub mod odds;
#[cfg(not(target_arch = "wasm32"))]
pub mod paper;
pub mod parallel;
pub mod properties;
pub mod replay;
pub mod report;
pub mod road;
mod robots;
mod runs;
pub mod scenario;
pub mod sequence;
mod serial;
mod steps;
mod store;
#[cfg(not(target_arch = "wasm32"))]
pub mod subject;
pub mod symmetry;
pub mod timed;
pub mod transitions;
mod transmission;
pub mod universe;
pub mod utterances;
pub mod walk;

/// The Rust in the README compiles.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

/// The Rust on the page for verifiers compiles, and holds.
#[cfg(doctest)]
#[doc = include_str!("../doc/verifying.md")]
struct Verifying;
