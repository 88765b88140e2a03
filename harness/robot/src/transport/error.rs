//! Why a link cannot be opened.

use std::net::{IpAddr, Ipv4Addr, SocketAddr, SocketAddrV4};
use std::path::PathBuf;

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
        /// The names of the interfaces that exist.
        known: String,
    },
    /// The port of an [`Air`](super::Air) is open already.
    #[error("port {0} of the air is open already; each robot needs its own")]
    PortInUse(usize),
}

/// Why a zenoh network cannot be entered.
#[derive(Debug, thiserror::Error)]
pub enum ZenohError {
    /// The program cannot speak zenoh.
    #[error(
        "this program was built without zenoh; build it with: cargo build --release --features zenoh"
    )]
    NotBuilt,
    /// The file of settings cannot be used.
    #[error("zenoh: {}: {cause}", path.display())]
    Config {
        /// The file.
        path: PathBuf,
        /// Why not.
        cause: String,
    },
    /// A setting is none that zenoh takes.
    #[error("zenoh: {setting} cannot be {value}: {cause}")]
    Setting {
        /// Its name.
        setting: &'static str,
        /// What it was to be.
        value: String,
        /// Why not.
        cause: String,
    },
    /// The key is none.
    #[error("zenoh: '{key}' is no key like crossguard/v2x")]
    Key {
        /// What was given.
        key: String,
    },
    /// An endpoint is none.
    #[error("zenoh: '{endpoint}' is no endpoint like tcp/192.0.2.1:7447; protocols are {known}")]
    Endpoint {
        /// What was given.
        endpoint: String,
        /// The protocols that there are.
        known: String,
    },
    /// A client has no router.
    #[error("zenoh: a client wants a router to connect to, like tcp/127.0.0.1:7447")]
    NoRouter,
    /// No router answers.
    #[error(
        "zenoh: no router can be reached at {endpoints}; is zenohd, or 'crossguard router', running \
         there? RUST_LOG=zenoh=warn tells more"
    )]
    Unreachable {
        /// Where it was looked for.
        endpoints: String,
    },
    /// It cannot listen.
    #[error("zenoh: cannot listen on {endpoints}: {cause}")]
    Unavailable {
        /// Where it was to listen.
        endpoints: String,
        /// Why not.
        cause: String,
    },
    /// The session does not take part in the key.
    #[error("zenoh: {0}")]
    Session(String),
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
