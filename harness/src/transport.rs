//! Datagrams between robots: UDP, to the peers on the loopback interface or to a multicast group.

mod faults;
mod udp;

pub use faults::{Faults, Lossy};
pub use udp::{Link, LinkError, UdpReceiver, UdpSender};

/// Where datagrams go out.
pub trait Sender: Send {
    /// Sends one datagram to everybody in reach.
    ///
    /// # Errors
    /// When the operating system did not take it for everybody.
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

/// Where datagrams come in.
pub trait Receiver: Send {
    /// Waits for the next datagram, at most for a moment. `None` when there was none.
    ///
    /// # Errors
    /// Those of the operating system that will not go away by themselves.
    fn receive(&mut self) -> std::io::Result<Option<Arrival>>;
}

/// What came in.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Arrival {
    /// A datagram.
    Datagram(Vec<u8>),
    /// A datagram that the fault layer lost on purpose.
    Lost(Vec<u8>),
}
