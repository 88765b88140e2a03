//! The coordination state machine of Crossguard.
//!
//! Robots that act as crossing guards find each other, take the roles of leader and follower, and
//! carry out maneuvers under a leader's commands, over a radio that loses, repeats, delays and
//! reorders messages, while robots crash and come back. This crate is the protocol between them,
//! after the paper *Multi-Robot Coordination in V2X Environments* (Arockiasamy, Vinel; ITSC 2026):
//! one transition function, [`Robot::step`], that the model checker, the proofs, the simulator and
//! the live endpoint all call.
//!
//! It is `no_std`, free of heap and of unsafe code, total, and reads no clock: time enters as an
//! [`Input`]. Its decisions come out as [`Outputs`] for the endpoint to carry out in order.
//!
//! ```
//! use crossguard_protocol::{
//!     Config, Decimetres, Event, HelpRequest, Input, Millis, Output, Place, Robot, State, StationId,
//!     TaskSet, TaskType, Urgency,
//! };
//!
//! let config = Config::default();
//! let mut ari = Robot::new(StationId(1), 1); // station id, boot counter
//! let mut go2 = Robot::new(StationId(2), 1);
//!
//! // ARI sees a pedestrian and asks for one robot that can go somewhere and escort.
//! let tasks = TaskSet::of(&[TaskType::INITIAL_POS, TaskType::MOVE]);
//! let request = HelpRequest { urgency: Urgency::Medium, followers: 1, tasks, place: Place(7) };
//! let outputs = ari.step(&config, Input::Local(Event::PedestrianDetected(request)));
//! assert!(outputs.iter().any(|output| *output == Output::SendRam));
//!
//! // Its RAM reaches Go2, which offers; Go2's RAM reaches ARI, which selects after a while.
//! let distance = Decimetres(40);
//! go2.step(&config, Input::Ram { ram: ari.ram(), distance });
//! ari.step(&config, Input::Ram { ram: go2.ram(), distance });
//! ari.step(&config, Input::Elapsed(Millis(300)));
//! go2.step(&config, Input::Ram { ram: ari.ram(), distance });
//! assert_eq!((ari.state(), go2.state()), (State::RoleEstablished, State::RoleEstablished));
//! ```
//!
//! # What is where
//!
//! | | |
//! |---|---|
//! | the robot, and what it remembers | [`Robot`], [`Phase`] with [`Requesting`], [`Offering`], [`Leading`], [`Following`] |
//! | what goes in | [`Input`]: [`Ram`], [`Rmcm`], elapsed [`Millis`], an [`Event`] of the application |
//! | what comes out | [`Output`], in order; [`Notice`] tells the application, [`Ignored`] why nothing came of an input |
//! | its settings, and what must hold between them | [`Config`], [`Settings`], [`Inequality`] |
//! | names and numbers | [`StationId`], [`SessionId`], [`RequestId`], [`Heartbeat`], [`OfferNumber`] |
//! | what there is to say, as tables: events, outputs, notices, reasons | [`words`], and `ALL`, `kind`, `name` and `code` of each |
//! | what is asked for and done | [`HelpRequest`], [`TaskType`], [`FallbackPolicy`], [`Availability`] |
//!
//! The enums that tell stages, inputs and outputs apart are `repr(u8)`: their tag is a byte of its own
//! instead of an unused value of some field, so that a proof about one stage is about no other.
//!
//! # Features
//!
//! - `serde`: every public type is serialized and deserialized, for logs and bindings.
//! - `laws`: what proofs and property tests call; no part of the stable interface.
//! - `renaming`: states and messages under other names, for the model checker; no part of it either.
#![no_std]
#![cfg_attr(docsrs, feature(doc_cfg))]

#[cfg(any(test, doctest))]
extern crate std;

mod claim;
mod config;
mod corridor;
mod display;
mod help;
mod id;
mod identity;
mod idle;
mod input;
#[cfg(any(test, feature = "laws"))]
#[doc(hidden)]
pub mod laws;
mod list;
mod maneuver;
mod message;
mod output;
#[cfg(any(test, feature = "renaming"))]
mod rename;
mod robot;
mod roles;
mod state;
mod task;
mod termination;
mod time;
mod timers;
mod valid;
pub mod words;

#[cfg(feature = "serde")]
pub use config::SettingsInFiles;
pub use config::{BrokenInequality, Config, Inequality, Settings};
pub use id::{
    Heartbeat, ManeuverId, OfferNumber, RequestId, SessionId, SessionNumber, StationId,
    UniqueNumber,
};
pub use input::{Decimetres, Event, EventKind, Input, Timer, TimerKind};
pub use list::{Full, List};
pub use message::{
    Answer, Command, Confirmation, Coordination, Ending, Failure, FailureKind, Farewell, Followers,
    Progress, ProgressKind, Ram, Rejection, RejectionKind, Report, Rmcm, Verdict,
};
pub use output::{
    CorridorClosure, CorridorClosureKind, Disengagement, DisengagementKind, EndReason,
    EndReasonKind, GoneReason, Ignored, IgnoredKind, Maneuver, Notice, NoticeKind, Output,
    OutputKind, Outputs, ReleaseReason, ReleaseReasonKind, StopReason, StopReasonKind,
};
#[cfg(feature = "renaming")]
pub use rename::Renaming;
pub use robot::StateMachine;
pub use state::{
    Contact, Corridor, Duty, Following, Identity, Job, Leading, Lease, Member, Offer, Offering,
    Order, Outstanding, Phase, Refusal, Requesting, Rival, Robot, Role, StandingFarewell, State,
};
pub use task::{
    Availability, FallbackPolicy, HelpRequest, NoSuchTask, Place, TaskNames, TaskSet, TaskType,
    Unavailability, Urgency,
};
pub use time::{Countdown, Millis};

/// How many followers a leader can have: 16, as many as a RAM has room for, or what the environment variable
/// `CROSSGUARD_MAX_FOLLOWERS` says when this crate is compiled, from 1 to 16. Robots of different capacity understand
/// each other; one with a smaller capacity takes no message that names more followers. The proofs are for 4.
pub const MAX_FOLLOWERS: usize = if cfg!(kani) {
    4
} else {
    capacity(option_env!("CROSSGUARD_MAX_FOLLOWERS"))
};

/// The capacity that a text says.
const fn capacity(text: Option<&str>) -> usize {
    let Some(text) = text else {
        return 16;
    };
    match u8::from_str_radix(text, 10) {
        Ok(number @ 1..=16) => number as usize,
        _ => panic!("CROSSGUARD_MAX_FOLLOWERS is no number from 1 to 16"),
    }
}

/// How many timers a robot can have armed at once: three for each follower, and identity lock, farewell and RAM.
pub const MAX_TIMERS: usize = 3 * MAX_FOLLOWERS + 3;

/// How many outputs one step can have: one for each timer and each follower, a RAM, and four with which a part in a
/// session ends and the step settles.
pub const MAX_OUTPUTS: usize = MAX_TIMERS + MAX_FOLLOWERS + 5;

/// The Rust in the README compiles.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
