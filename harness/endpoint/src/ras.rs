//! The Robot Awareness Service: when a robot tells of itself, and of the people around it.
//!
//! Pure rules, without a clock, a link or a random source of their own: what was perceived, heard and
//! how late it is goes in, what to send and why comes out. The live [`Endpoint`](crate::Endpoint) and
//! the robots of `crossguard-evaluation` call the same functions.
//!
//! ```text
//!  perceived road users ──► clustering ──► containers ──► RAM ───────► device that understands RAM
//!  robot's motion, events ─► generation ──────────────────┘  │
//!                          │                  cluster VAM ◄──┘ ──────► unmodified ETSI device
//!                          └──► CAM ─────────────────────────────────► unmodified ETSI station
//! ```
//!
//! - [`motion`] is where a station is and how it moves, and what counts as a change of that.
//! - [`generation`] says when a RAM or a CAM is sent, and which trigger caused it.
//! - [`congestion`] says how far apart they have to be on a channel that is busy.
//! - [`clustering`] makes clusters of the road users that a robot perceives, [`area`] is what bounds
//!   them, [`containers`] writes them into a RAM and reads them from one. [`surroundings`] are these
//!   of one robot, together.
//! - [`vam`] makes the VAM of a cluster and [`cam`] the CAM of a robot, for stations that do not know RAM; [`etsi`] is
//!   what the two have in common.

#[cfg(feature = "std")]
pub mod area;
#[cfg(feature = "foreign")]
pub mod cam;
#[cfg(feature = "std")]
pub mod clustering;
pub mod congestion;
#[cfg(feature = "std")]
pub mod containers;
#[cfg(feature = "foreign")]
pub mod etsi;
pub mod generation;
pub mod motion;
#[cfg(feature = "std")]
pub mod surroundings;
#[cfg(feature = "foreign")]
pub mod vam;
