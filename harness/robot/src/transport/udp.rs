//! UDP: fan-out to peers, or a multicast group on a named interface.

use std::io::ErrorKind;
use std::net::{SocketAddr, SocketAddrV4, UdpSocket};
use std::time::Duration;

use nix::sys::socket::MsgFlags;
use socket2::{Domain, InterfaceIndexOrAddress, Protocol, SockRef, Socket, Type};

use super::datagrams::{Datagrams, Taken};
use super::error::interface_of;
use super::{Arrival, Framing, Halves, LinkError, NotSent, Receiver, Sender};

#[derive(Debug)]
struct UdpSender {
    socket: UdpSocket,
    to: Vec<SocketAddr>,
    framing: Framing,
}

#[derive(Debug)]
struct UdpReceiver {
    datagrams: Datagrams<UdpSocket>,
    framing: Framing,
}

/// Opens a socket of this address, with these peers. Fails where the address is in use, or cannot be used.
pub(super) fn open(
    address: SocketAddr,
    peers: Vec<SocketAddr>,
    framing: Framing,
) -> Result<Halves, LinkError> {
    let socket = UdpSocket::bind(address).map_err(open_error(address))?;
    halves(socket, address, peers, framing)
}

/// Joins a group so that several robots on one machine can be in it. Fails where it is no group, there is no such
/// interface, or the address cannot be used.
pub(super) fn join(
    group: SocketAddrV4,
    interface: &str,
    framing: Framing,
) -> Result<Halves, LinkError> {
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
    let socket = open().map_err(open_error(address))?;
    halves(socket, address, vec![address], framing)
}

/// Both halves of a link over a socket of this address.
fn halves(
    socket: UdpSocket,
    address: SocketAddr,
    to: Vec<SocketAddr>,
    framing: Framing,
) -> Result<Halves, LinkError> {
    let unusable = |cause| LinkError::Unusable { address, cause };
    let receiver = UdpReceiver {
        datagrams: Datagrams::of(socket.try_clone().map_err(unusable)?),
        framing,
    };
    let sender = UdpSender {
        socket,
        to,
        framing,
    };
    Ok(Halves::of(sender, receiver))
}

pub(super) fn open_error(address: SocketAddr) -> impl Fn(std::io::Error) -> LinkError {
    move |cause| match cause.kind() {
        ErrorKind::AddrInUse => LinkError::InUse { address },
        _ => LinkError::Unusable { address, cause },
    }
}

impl Sender for UdpSender {
    fn send(&mut self, octets: &[u8]) -> Result<(), NotSent> {
        let (socket, now) = (SockRef::from(&self.socket), MsgFlags::MSG_DONTWAIT.bits());
        let datagram = self.framing.wrap(octets);
        let send = |to: &SocketAddr| socket.send_to_with_flags(&datagram, &(*to).into(), now);
        let failures = self.to.iter().filter_map(|to| send(to).err());
        NotSent::check(self.to.len(), failures)
    }
}

impl Receiver for UdpReceiver {
    fn receive(&mut self, at_most: Duration) -> std::io::Result<Option<Arrival>> {
        let (from, datagram, at) = match self.datagrams.next(at_most)? {
            Some(Taken::Datagram(from, datagram, at)) => (from, datagram, at),
            Some(Taken::Overflow(count)) => return Ok(Some(Arrival::Overflow(count))),
            None => return Ok(None),
        };
        Ok(Some(match self.framing.unwrap(datagram) {
            Ok(packet) => Arrival::Datagram {
                from,
                octets: packet.to_vec(),
                at,
            },
            Err(error) => Arrival::misframed(error.cause(), &error, datagram),
        }))
    }
}

#[cfg(test)]
mod tests {
    use std::net::Ipv4Addr;

    use super::super::{Link, Transport};
    use super::*;

    #[test]
    fn an_address_in_use_is_said_to_be() {
        let holder = UdpSocket::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
        let link = Link::loopback(holder.local_addr().unwrap().port(), Vec::new());
        assert!(matches!(link.open(), Err(LinkError::InUse { .. })));
    }

    #[test]
    fn a_group_that_is_none_and_an_interface_that_is_none_are_told_apart() {
        let open = |group: &str, interface: &str| {
            let link = Link::Multicast {
                group: group.parse().unwrap(),
                interface: interface.to_owned(),
                framing: Framing::default(),
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
