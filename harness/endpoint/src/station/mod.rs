//! Parts of an ITS station besides its packets: a map of the road users around, and pseudonyms.
//!
//! - [`LocalDynamicMap`] is who is around, as heard lately, by robots and by other stations.
//! - [`Security`] is whether a robot signs and verifies, and under which pseudonyms.
//! - [`vehicle`] is the other side of a question to a vehicle.
//! - [`listen`] reads packets and messages that are meant for any receiver, for sniffers and charts.

mod extent;
pub mod listen;
mod map;
mod namesakes;
mod neighbours;
#[cfg(feature = "foreign")]
mod observe;
#[cfg(feature = "security")]
mod pseudonyms;
#[cfg(feature = "security")]
mod security;
pub mod vehicle;

pub use map::{LocalDynamicMap, MEASURED_MS, Neighbour, USERS_MAX, lifetime_ms};
pub use namesakes::{NAMES_MAX, NotAdmitted};
pub(crate) use neighbours::Neighbours;
#[cfg(feature = "foreign")]
pub use observe::{Unobserved, service_of};
#[cfg(feature = "security")]
pub(crate) use pseudonyms::Pseudonyms;
#[cfg(feature = "security")]
pub use pseudonyms::Secret;
#[cfg(feature = "security")]
pub use security::{Credentials, Mode, NoSuchMode, Security};
