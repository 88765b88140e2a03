//! Why a link cannot be opened.

use std::net::{IpAddr, Ipv4Addr, SocketAddr, SocketAddrV4};

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

impl LinkError {
    /// There is no interface of this name, but there are these.
    pub(super) fn no_interface<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> Self {
        Self::NoInterface {
            name: name.to_owned(),
            known: known.collect::<Vec<_>>().join(", "),
        }
    }
}

/// Whether this is the name of a loopback interface.
pub(super) fn is_loopback(name: &str) -> bool {
    let interfaces = if_addrs::get_if_addrs().unwrap_or_default();
    let mut of_that_name = interfaces.iter().filter(|it| it.name == name);
    of_that_name.any(if_addrs::Interface::is_loopback)
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
    let known = ipv4.map(|(interface, _)| &*interface.name);
    found
        .and_then(|(interface, address)| Some((interface.index?, address)))
        .ok_or_else(|| LinkError::no_interface(name, known))
}
