//! What robots are configured with: where they meet, and why they cannot.

use std::fmt;
use std::net::{IpAddr, Ipv4Addr, SocketAddr, SocketAddrV4};

use super::{Halves, Transport, Zenoh, ZenohError, ethernet, udp};

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

/// Why a link cannot be opened.
#[derive(Debug, thiserror::Error)]
pub enum LinkError {
    /// The address is taken.
    #[error(
        "{address} is in use; is another robot or demo running there? Choose another address or port"
    )]
    InUse {
        /// The address.
        address: SocketAddr,
    },
    /// The address cannot be used.
    #[error("{address} cannot be used: {cause}")]
    Unusable {
        /// The address.
        address: SocketAddr,
        /// Why.
        cause: std::io::Error,
    },
    /// The group is no multicast group.
    #[error("{group} is not a multicast address; those go from 224.0.0.0 to 239.255.255.255")]
    NotMulticast {
        /// The address.
        group: SocketAddrV4,
    },
    /// A raw socket cannot be opened.
    #[error("raw socket on {interface}: {cause}; it takes the capability CAP_NET_RAW")]
    Ethernet {
        /// Name of the interface.
        interface: String,
        /// Why.
        cause: std::io::Error,
    },
    /// The zenoh network cannot be entered.
    #[error(transparent)]
    Zenoh(#[from] ZenohError),
    /// There is no such interface.
    #[error("no interface '{name}' that can be used so; there are: {known}")]
    NoInterface {
        /// The name.
        name: String,
        /// The names of those that there are.
        known: String,
    },
    /// The port of an [`Air`](super::Air) is open already.
    #[error("port {0} of the air is open already; each robot needs its own")]
    PortInUse(usize),
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

/// The index and the IPv4 address of an interface.
///
/// # Errors
/// When there is none of that name that has such an address.
pub(super) fn interface_of(name: &str) -> Result<(u32, Ipv4Addr), LinkError> {
    let interfaces = if_addrs::get_if_addrs().unwrap_or_default();
    let ipv4 = interfaces
        .iter()
        .filter_map(|interface| match interface.ip() {
            IpAddr::V4(address) => Some((interface, address)),
            IpAddr::V6(_) => None,
        });
    let found = ipv4.clone().find(|(interface, _)| interface.name == name);
    let known = || {
        ipv4.map(|(interface, _)| interface.name.clone())
            .collect::<Vec<_>>()
            .join(", ")
    };
    match found.and_then(|(interface, address)| Some((interface.index?, address))) {
        Some(found) => Ok(found),
        None => Err(LinkError::NoInterface {
            name: name.to_owned(),
            known: known(),
        }),
    }
}
