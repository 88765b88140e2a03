//! What robots are configured with: where they meet.

use std::fmt;
use std::net::{SocketAddr, SocketAddrV4};

use super::{Halves, LinkError, Transport, Zenoh, ethernet, udp};

/// A robot's link to others.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Link {
    /// A socket of its own, and each peer's.
    Peers {
        /// The robot's own address.
        address: SocketAddr,
        /// Those of the others.
        peers: Vec<SocketAddr>,
    },
    /// A group that everybody has joined.
    Multicast {
        /// The group and its port.
        group: SocketAddrV4,
        /// Name of the interface, like `eth0`.
        interface: String,
    },
    /// Frames on an interface, without UDP and IP.
    Ethernet {
        /// Name of the interface, like `eth0`.
        interface: String,
    },
    /// A zenoh network.
    Zenoh(Zenoh),
}

impl fmt::Display for Link {
    /// Where the link listens.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Peers { address, .. } => address.fmt(f),
            Self::Multicast { group, .. } => group.fmt(f),
            Self::Ethernet { interface } => write!(f, "{interface}, ethertype 0x8947"),
            Self::Zenoh(zenoh) => zenoh.fmt(f),
        }
    }
}

impl Transport for Link {
    fn open(&self) -> Result<Halves, LinkError> {
        match self {
            Self::Peers { address, peers } => udp::open(*address, peers.clone()),
            Self::Multicast { group, interface } => udp::join(*group, interface),
            Self::Ethernet { interface } => ethernet::open(interface),
            Self::Zenoh(zenoh) => zenoh.open(),
        }
    }
}
