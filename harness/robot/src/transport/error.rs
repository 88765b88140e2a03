//! Why a link cannot be opened.

use std::net::{Ipv4Addr, SocketAddr, SocketAddrV4};

use nix::ifaddrs::getifaddrs;
use nix::net::if_::{InterfaceFlags, if_nametoindex};
use nix::sys::socket::SockaddrStorage;

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
    /// There is no such interface.
    #[error("no interface '{name}' that can be used so; there are: {known}")]
    NoInterface {
        /// The name.
        name: String,
        /// The names of the interfaces that exist.
        known: String,
    },
}

pub(super) fn is_loopback(name: &str) -> bool {
    let mut interfaces = getifaddrs().into_iter().flatten();
    interfaces
        .any(|it| it.interface_name == name && it.flags.contains(InterfaceFlags::IFF_LOOPBACK))
}

/// The first address of an interface that `of` takes, as `of` gives it. Fails where none of that name has one.
pub(super) fn address_of<T>(
    name: &str,
    of: fn(&SockaddrStorage) -> Option<T>,
) -> Result<T, LinkError> {
    let interfaces = getifaddrs().into_iter().flatten();
    let usable = interfaces.filter_map(|it| Some((it.interface_name, of(&it.address?)?)));
    let mut known = Vec::new();
    for (interface, address) in usable {
        if interface == name {
            return Ok(address);
        }
        known.push(interface);
    }
    let known = known.join(", ");
    let name = name.to_owned();
    Err(LinkError::NoInterface { name, known })
}

/// The index and the IPv4 address of an interface. Fails where none of that name has one.
pub(super) fn interface_of(name: &str) -> Result<(u32, Ipv4Addr), LinkError> {
    let address = address_of(name, |it| Some(it.as_sockaddr_in()?.ip()))?;
    let index = if_nametoindex(name).map_err(|cause| LinkError::Unusable {
        address: (address, 0).into(),
        cause: cause.into(),
    })?;
    Ok((index, address))
}
