//! The largest encodings of RAM and RMCM, derived from the constraints of their types.
//!
//! They follow from the declarations of the [core](crate::core): extension and presence bits, every
//! OPTIONAL component present, every list full, of a CHOICE the longest alternative. `tests/size.rs`
//! builds these values and encodes them.

use crate::core::max_octets;
use crate::core::ram::RAM;
use crate::core::rmcm::RMCM;

/// The largest message that a packet carries, in octets: the `GeoNetworking` payload of 1398 octets
/// (`itsGnMaxSduSize`, EN 302 636-4-1) less the 4 octets of the BTP header.
///
/// Longer input is refused before it is read. Messages of this crate stay far below, so that there
/// is room for the security envelope, and for extension additions of newer senders.
pub const MESSAGE_LEN_MAX: usize = 1_398 - 4;

/// The largest RAM that this crate encodes, in octets.
pub const RAM_LEN_MAX: usize = max_octets::<RAM>();

/// The largest RMCM that this crate encodes, in octets.
pub const RMCM_LEN_MAX: usize = max_octets::<RMCM>();

const _: () = assert!(RAM_LEN_MAX < MESSAGE_LEN_MAX && RMCM_LEN_MAX < MESSAGE_LEN_MAX);
