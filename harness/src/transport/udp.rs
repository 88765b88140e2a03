//! UDP: fan-out to peers on the loopback interface, or a multicast group on a named interface.

use std::fmt;
use std::io::ErrorKind;
use std::net::{IpAddr, Ipv4Addr, SocketAddr, SocketAddrV4, UdpSocket};
use std::time::Duration;

use nix::sys::socket::MsgFlags;
use socket2::{Domain, InterfaceIndexOrAddress, Protocol, SockRef, Socket, Type};

use super::{Arrival, Halves, NotSent, Receiver, Sender, Source, Transport};

/// Longer than any datagram that a robot understands, so that a longer one is seen to be too long.
const DATAGRAM_MAX: usize = 2_048;

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
}

impl fmt::Display for Link {
    /// Where the link listens.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Peers { address, .. } => address.fmt(f),
            Self::Multicast { group, .. } => group.fmt(f),
            Self::Ethernet { interface } => write!(f, "{interface}, ethertype 0x8947"),
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

/// The sending half of a link.
#[derive(Debug)]
struct UdpSender {
    socket: UdpSocket,
    to: Vec<SocketAddr>,
}

/// The receiving half of a link.
#[derive(Debug)]
struct UdpReceiver {
    socket: UdpSocket,
    buffer: Box<[u8; DATAGRAM_MAX]>,
    /// For how long the socket waits.
    wait: Duration,
}

impl Transport for Link {
    fn open(&self) -> Result<Halves, LinkError> {
        let (socket, address, to) = match self {
            Self::Peers { address, peers } => (bind(*address)?, *address, peers.clone()),
            Self::Multicast { group, interface } => {
                let address = SocketAddr::V4(*group);
                (join(*group, interface)?, address, vec![address])
            }
            Self::Ethernet { interface } => return super::ethernet::open(interface),
        };
        let unusable = |cause| LinkError::Unusable { address, cause };
        let receiver = UdpReceiver {
            socket: socket.try_clone().map_err(unusable)?,
            buffer: Box::new([0; DATAGRAM_MAX]),
            wait: Duration::ZERO,
        };
        Ok(Halves {
            sender: Box::new(UdpSender { socket, to }),
            receiver: Box::new(receiver),
        })
    }
}

fn open_error(address: SocketAddr) -> impl Fn(std::io::Error) -> LinkError {
    move |cause| match cause.kind() {
        ErrorKind::AddrInUse => LinkError::InUse { address },
        _ => LinkError::Unusable { address, cause },
    }
}

fn bind(address: SocketAddr) -> Result<UdpSocket, LinkError> {
    UdpSocket::bind(address).map_err(open_error(address))
}

/// Joins a group so that several robots on one machine can be in it.
fn join(group: SocketAddrV4, interface: &str) -> Result<UdpSocket, LinkError> {
    if !group.ip().is_multicast() {
        return Err(LinkError::NotMulticast { group });
    }
    let (index, source) = interface_of(interface)?;
    let address = SocketAddr::V4(group);
    let open = || -> std::io::Result<UdpSocket> {
        let socket = Socket::new(Domain::IPV4, Type::DGRAM, Some(Protocol::UDP))?;
        socket.set_reuse_address(true)?;
        socket.bind(&address.into())?;
        socket.join_multicast_v4_n(group.ip(), &InterfaceIndexOrAddress::Index(index))?;
        socket.set_multicast_if_v4(&source)?;
        socket.set_multicast_loop_v4(true)?;
        // Single hop, like the radio.
        socket.set_multicast_ttl_v4(1)?;
        Ok(socket.into())
    };
    open().map_err(open_error(address))
}

fn interface_of(name: &str) -> Result<(u32, Ipv4Addr), LinkError> {
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

impl Sender for UdpSender {
    fn send(&mut self, octets: &[u8]) -> Result<(), NotSent> {
        let (socket, now) = (SockRef::from(&self.socket), MsgFlags::MSG_DONTWAIT.bits());
        let send = |to: &SocketAddr| socket.send_to_with_flags(octets, &(*to).into(), now);
        let failures = self.to.iter().filter_map(|to| send(to).err());
        let (failed, cause) =
            failures.fold((0, None), |(failed, _), cause| (failed + 1, Some(cause)));
        match cause {
            None => Ok(()),
            Some(cause) => Err(NotSent {
                failed,
                receivers: self.to.len(),
                cause,
            }),
        }
    }
}

impl Receiver for UdpReceiver {
    fn receive(&mut self, at_most: Duration) -> std::io::Result<Option<Arrival>> {
        // Zero would stand for no limit.
        let wait = at_most.max(Duration::from_micros(1));
        if wait != self.wait {
            self.socket.set_read_timeout(Some(wait))?;
            self.wait = wait;
        }
        match self.socket.recv_from(&mut *self.buffer) {
            Ok((length, address)) => Ok(Some(Arrival::Datagram {
                from: Source::Address(address),
                octets: self.buffer[..length].to_vec(),
            })),
            // A peer that is gone answers with ICMP, which shows up as a refused connection.
            Err(error)
                if matches!(
                    error.kind(),
                    ErrorKind::WouldBlock
                        | ErrorKind::TimedOut
                        | ErrorKind::Interrupted
                        | ErrorKind::ConnectionRefused
                        | ErrorKind::ConnectionReset
                ) =>
            {
                Ok(None)
            }
            Err(error) => Err(error),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn any_port() -> SocketAddr {
        SocketAddr::from((Ipv4Addr::LOCALHOST, 0))
    }

    #[test]
    fn a_datagram_reaches_every_peer() {
        let (a, b) = (
            UdpSocket::bind(any_port()).unwrap(),
            UdpSocket::bind(any_port()).unwrap(),
        );
        let peers = vec![a.local_addr().unwrap(), b.local_addr().unwrap()];
        let link = Link::Peers {
            address: any_port(),
            peers,
        };
        let mut sender = link.open().unwrap().sender;
        sender.send(b"hello").unwrap();
        for peer in [a, b] {
            let mut buffer = [0; 16];
            assert_eq!(peer.recv(&mut buffer).unwrap(), 5);
        }
    }

    #[test]
    fn an_address_in_use_is_said_to_be() {
        let taken = UdpSocket::bind(any_port()).unwrap().local_addr();
        let holder = UdpSocket::bind(taken.unwrap()).unwrap();
        let address = holder.local_addr().unwrap();
        let link = Link::Peers {
            address,
            peers: Vec::new(),
        };
        assert!(matches!(link.open(), Err(LinkError::InUse { .. })));
    }

    #[test]
    fn a_group_that_is_none_and_an_interface_that_is_none_are_told_apart() {
        let open = |group: &str, interface: &str| {
            let link = Link::Multicast {
                group: group.parse().unwrap(),
                interface: interface.to_owned(),
            };
            link.open().err().unwrap()
        };
        assert!(matches!(
            open("127.0.0.1:4000", "lo"),
            LinkError::NotMulticast { .. }
        ));
        let error = open("239.118.122.97:4000", "no-such-interface");
        assert!(matches!(error, LinkError::NoInterface { .. }), "{error}");
    }
}
