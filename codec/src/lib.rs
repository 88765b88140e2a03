//! RAM and RMCM on the wire.
//!
//! The messages of Crossguard, from what the protocol and the application say to octets and back:
//!
//! ```text
//!  crossguard_protocol::Ram ─┐               ┌─ core ─┐             ┌────────┐
//!  RobotState (SI units) ────┼── view ───────┤  RAM   ├── message ──┤ octets │
//!  TaskParameters ───────────┘   by si       │  RMCM  │  header     └────────┘
//!  crossguard_protocol::Rmcm                 └───┬────┘
//!                                              asn1: the same of rasn, as reference
//! ```
//!
//! - `asn1/*.asn` in this crate are the messages, as ASN.1 modules that any compiler takes.
//! - [`core`] has the types of RAM and RMCM that follow from them and their codec, bit by bit and
//!   without heap, with its laws; it decides what is a message.
//! - [`encode`] and [`decode`] are strict with them: exactly the canonical unaligned PER encodings of
//!   valid messages are accepted, extension additions of newer senders are skipped, and everything else
//!   is an error that names the field. [`encode_into`] writes to a buffer of the caller's.
//! - [`asn1`] has the types that rasn makes of the modules: the reference that the core is compared
//!   with, and what the core does not have.
//! - [`its`] has the messages of other stations: CAM, VAM and CPM. These are read in every
//!   encoding that their senders choose, and [`Received::is_canonical`] tells.
//! - [`si`] converts physical quantities, and saturates.
//! - [`ram_from`], [`view_of_ram`], [`rmcm_from_commands`], [`rmcm_from_answer`] and [`views_of_rmcm`]
//!   map to and from the protocol's view; [`view`] has its laws. [`Heard`] is all that a message says.
//! - [`geonet`] has what is under a message, `GeoNetworking` and BTP-B: headers, whole packets and
//!   the [`Stack`](geonet::Stack) that makes and takes them; [`Service`] says how each message goes.
//! - `security` (with the feature of that name) signs and verifies packets by TS 103 097.
//! - [`Identifiers`] holds what no standard has assigned.
//!
//! ```
//! use crossguard_codec::{
//!     Identifiers, Message, Position, RobotState, decode, distance, encode, ram_from, state_of,
//!     view_of_ram,
//! };
//! use crossguard_codec::core::ram::RAM;
//! use crossguard_protocol::{Availability, Decimetres, Robot, StationId};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let identifiers = Identifiers::default();
//! let robot = Robot::new(StationId(7), 1);
//! let state = RobotState {
//!     position: Position::at(48.765_432_1, 9.123_456_7),
//!     speed: Some(1.2.into()),
//!     ..RobotState::default()
//! };
//! let ram = ram_from(&identifiers, &state, &robot.ram(), Availability::Available, 12_345, false)?;
//! let octets = encode(&identifiers, &ram)?;
//!
//! let received = decode::<RAM>(&identifiers, &octets)?.message;
//! assert_eq!(view_of_ram(&received)?, robot.ram());
//! let here = Position::at(48.765_432_1, 9.123_500_0);
//! assert_eq!(distance(&here, &state_of(&received).position), Decimetres(32));
//! # Ok(())
//! # }
//! ```
//!
//! # Features
//!
//! - `std`, on by default. Without it the crate is `no_std` and needs no heap: RAM, RMCM, their mapping
//!   and [`geonet`] remain; `encode` and what else needs a vector do not.
//! - `foreign`, on by default, brings `asn1`, `its` and JSON of messages, and with them rasn; it needs `std`.
//! - `security` brings signatures, and with them elliptic curves; it needs `std`.
//! - `laws` and `golden` are for proofs and tests; no part of the stable interface.

#![cfg_attr(not(feature = "std"), no_std)]
#![cfg_attr(docsrs, feature(doc_cfg))]

#[cfg(feature = "foreign")]
pub mod asn1;
mod containers;
pub mod core;
mod distance;
mod error;
pub mod geonet;
#[cfg(feature = "golden")]
#[doc(hidden)]
pub mod golden;
mod heard;
mod identifiers;
#[cfg(feature = "foreign")]
pub mod its;
mod message;
mod named;
mod part;
#[cfg(feature = "std")]
mod road_user;
#[cfg(feature = "security")]
pub mod security;
mod service;
pub mod si;
mod size;
mod state;
pub mod view;
mod wire;

pub use crate::core::Fault;
pub use crate::core::cdd::{PATH_HISTORY_MAX, PATH_PREDICTION_MAX};
pub use containers::position_of;
pub use distance::distance;
pub use error::{DecodeError, EncodeError, FieldPath, ViewError};
pub use heard::{Heard, Unheard};
pub use identifiers::{Dictionary, IdentifierClash, Identifiers, MessageIdentifiers};
#[cfg(feature = "std")]
pub use message::encode;
pub use message::{Message, Pdu, Received, decode, encode_into};
pub use part::{Part, SSP_VERSION};
#[cfg(feature = "std")]
pub use road_user::{Identity, Kind, RoadUser};
pub use service::Service;
pub use size::{MESSAGE_LEN_MAX, RAM_LEN_MAX, RMCM_LEN_MAX};
pub use state::{
    Battery, Capabilities, ConfidenceEllipse, ControlMode, Dimensions, DriveDirection, JobRole,
    Lights, Measurement, PastPosition, Position, PublicSignal, RobotCategory, RobotState,
    SignalMeans, SignalsShown, SlowState, TaskProgression,
};
#[doc(no_inline)]
pub use view::{
    ExecutionStatus, MapPlace, NoMapPlace, Target, TaskParameters, availability_of, execution_of,
    map_place_of, ram_from, rmcm_from_answer, rmcm_from_commands, state_of, task_parameters_of,
    view_of_ram, views_of_rmcm,
};

/// The Rust in the README compiles.
#[cfg(all(doctest, feature = "foreign"))]
#[doc = include_str!("../README.md")]
struct Readme;
