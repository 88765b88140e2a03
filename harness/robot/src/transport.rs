//! Datagrams between robots, over whatever carries them.
//!
//! ```text
//!   Transport::open ──► Sender    (one datagram to everybody in reach)
//!                   └─► Receiver  (what comes in, one by one)
//! ```
//!
//! [`Link`] is UDP, to peers or to a multicast group, with an Ethernet header in its datagrams or without
//! ([`Framing`]), an on-board unit ([`attachment`](crate::attachment)), or Ethernet. [`WithFaults`] lays
//! seeded faults over any of them: what becomes of a datagram is drawn by a [`Channel`], the one place
//! where faults are made; the simulator draws from it as well. [`Reopening`] opens one again that has
//! failed.

mod attention;
mod datagrams;
mod error;
mod ethernet;
mod faults;
mod framing;
mod layer;
mod link;
mod reopening;
mod stamps;
mod udp;
mod unit;

pub use error::LinkError;
pub use faults::{Burst, Channel, Delay, Fate, Faults, FaultsError, Outage};
pub use framing::{Framing, FramingError};
pub use layer::WithFaults;
pub use link::Link;
pub use reopening::Reopening;

use std::io::ErrorKind;
use std::net::SocketAddr;
use std::time::{Duration, Instant};

use crossguard_endpoint::cause::Loss;

use crate::attachment::Radio;

/// Longer than any datagram that a robot understands, so that a longer one is seen to be too long.
const DATAGRAM_MAX: usize = 2_048;

/// A way to reach other robots.
pub trait Transport {
    /// Opens it. The two halves may be used by two threads.
    ///
    /// # Errors
    /// Why it cannot be opened.
    fn open(&self) -> Result<Halves, LinkError>;
}

/// An open transport.
pub struct Halves {
    /// Where datagrams go out.
    pub sender: Box<dyn Sender>,
    /// Where datagrams come in.
    pub receiver: Box<dyn Receiver>,
}

impl Halves {
    /// Both of them, boxed.
    pub fn of(sender: impl Sender + 'static, receiver: impl Receiver + 'static) -> Self {
        let (sender, receiver) = (Box::new(sender), Box::new(receiver));
        Self { sender, receiver }
    }
}

/// Where datagrams go out.
pub trait Sender: Send {
    /// Sends one datagram to everybody in reach. It never waits for a receiver.
    ///
    /// # Errors
    /// When it was not taken for everybody.
    fn send(&mut self, octets: &[u8]) -> Result<(), NotSent>;
}

/// A datagram that did not go out to everybody.
#[derive(Debug, thiserror::Error)]
#[error("not sent to {failed} of {receivers}: {cause}")]
pub struct NotSent {
    /// How many receivers it did not go out to.
    pub failed: usize,
    /// How many there are.
    pub receivers: usize,
    /// Why not to the last of them.
    pub cause: std::io::Error,
}

impl NotSent {
    /// It did not go out to the only receiver.
    pub(crate) const fn to_one(cause: std::io::Error) -> Self {
        Self {
            failed: 1,
            receivers: 1,
            cause,
        }
    }

    /// Whether it went out to all of so many receivers, after these failures.
    pub(crate) fn check(
        receivers: usize,
        failures: impl Iterator<Item = std::io::Error>,
    ) -> Result<(), Self> {
        let (failed, cause) = failures.fold((0, None), |(failed, _), it| (failed + 1, Some(it)));
        cause.map_or(Ok(()), |cause| {
            Err(Self {
                failed,
                receivers,
                cause,
            })
        })
    }

    /// Whether it passes without the transport being opened again: there is no room now, or the transport
    /// is looking for the other end by itself.
    #[must_use]
    pub fn is_passing(&self) -> bool {
        matches!(
            self.cause.kind(),
            ErrorKind::WouldBlock | ErrorKind::NotConnected
        )
    }
}

/// Where datagrams come in.
pub trait Receiver: Send {
    /// Waits for the next datagram, for so long at most. `None` when there was none.
    ///
    /// # Errors
    /// Errors of the operating system that will not go away by themselves.
    fn receive(&mut self, at_most: Duration) -> std::io::Result<Option<Arrival>>;
}

/// Sender of a datagram, as far as the transport can tell.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Source {
    /// The address that it came from.
    Address(SocketAddr),
    /// The link-layer address that it came from.
    LinkLayer([u8; 6]),
    /// The transport could name no sender.
    Unknown,
}

impl Arrival {
    fn misframed(cause: &'static str, detail: &impl ToString, octets: &[u8]) -> Self {
        Self::Misframed {
            cause,
            detail: detail.to_string(),
            octets: octets.to_vec(),
        }
    }
}

/// Arrival at a receiver.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Arrival {
    /// A datagram.
    Datagram {
        /// Its sender.
        from: Source,
        /// Its content.
        octets: Vec<u8>,
        /// When it arrived, as far as the transport can tell, and not later: what waits from then on grows
        /// old.
        at: Instant,
    },
    /// A datagram that the fault layer lost on purpose.
    Lost {
        /// How.
        how: Loss,
        /// Its content.
        octets: Vec<u8>,
    },
    /// The socket had no room for so many datagrams.
    Overflow(u32),
    /// How the channel is, from a transport that measures it.
    Channel(Radio),
    /// A datagram that is not framed as it should be.
    Misframed {
        /// The name of the cause, for counters.
        cause: &'static str,
        /// Details of the cause.
        detail: String,
        /// Its content.
        octets: Vec<u8>,
    },
}
