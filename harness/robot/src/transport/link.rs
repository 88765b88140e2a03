//! Configuration of a robot's link: where robots meet.

use std::fmt;
use std::net::{Ipv4Addr, SocketAddr, SocketAddrV4};

use super::error::is_loopback;
use super::{Framing, Halves, LinkError, Transport, ethernet, udp, unit};
use crate::attachment::Sends;

/// A robot's link to others.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Link {
    /// A socket of its own, and each peer's.
    Peers {
        /// The robot's own address.
        address: SocketAddr,
        /// Addresses of the others.
        peers: Vec<SocketAddr>,
        /// How packets lie in datagrams.
        framing: Framing,
    },
    /// A group that everybody has joined.
    Multicast {
        /// The group and its port.
        group: SocketAddrV4,
        /// Name of the interface, like `eth0`.
        interface: String,
        /// How packets lie in datagrams.
        framing: Framing,
    },
    /// Frames on an interface, without UDP and IP.
    Ethernet {
        /// Name of the interface, like `eth0`.
        interface: String,
    },
    /// An on-board unit, which sends and receives for the robot.
    Unit {
        /// The unit's address.
        unit: SocketAddr,
        /// The robot's own; any port, if it is not said.
        address: Option<SocketAddr>,
        /// Data that the robot gives to it.
        sends: Sends,
    },
}

impl Link {
    /// A socket at a port of 127.0.0.1, and that of each peer; any free port where it is 0.
    #[must_use]
    pub fn loopback(port: u16, peers: Vec<SocketAddr>) -> Self {
        Self::Peers {
            address: (Ipv4Addr::LOCALHOST, port).into(),
            peers,
            framing: Framing::default(),
        }
    }

    /// How packets lie in its datagrams, as far as it has any.
    #[must_use]
    pub fn framing(&self) -> Framing {
        match self {
            Self::Peers { framing, .. } | Self::Multicast { framing, .. } => *framing,
            Self::Unit { .. } | Self::Ethernet { .. } => Framing::default(),
        }
    }

    /// Whether others than the processes of this machine hear it, or are heard.
    #[must_use]
    pub fn leaves_machine(&self) -> bool {
        match self {
            Self::Peers { address, peers, .. } => {
                let mut all = std::iter::once(address).chain(peers);
                all.any(|address| !address.ip().is_loopback())
            }
            Self::Multicast { interface, .. } | Self::Ethernet { interface } => {
                !is_loopback(interface)
            }
            // A unit is the way out of this machine.
            Self::Unit { .. } => true,
        }
    }
}

impl fmt::Display for Link {
    /// Where the link listens.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Peers { address, .. } => address.fmt(f),
            Self::Multicast { group, .. } => group.fmt(f),
            Self::Ethernet { interface } => write!(f, "{interface}, ethertype 0x8947"),
            Self::Unit { unit, .. } => write!(f, "the unit at {unit}"),
        }
    }
}

impl Transport for Link {
    fn open(&self) -> Result<Halves, LinkError> {
        match self {
            Self::Peers {
                address,
                peers,
                framing,
            } => udp::open(*address, peers.clone(), *framing),
            Self::Multicast {
                group,
                interface,
                framing,
            } => udp::join(*group, interface, *framing),
            Self::Ethernet { interface } => ethernet::open(interface),
            Self::Unit {
                unit,
                address,
                sends,
            } => unit::open(*unit, *address, *sends),
        }
    }
}
