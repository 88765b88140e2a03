//! Ethernet: `GeoNetworking` packets in frames of ethertype 0x8947, over a raw socket.
//!
//! It takes the right to open such sockets (`CAP_NET_RAW`); within a network namespace of one's own
//! everybody has it.

use std::os::fd::{AsRawFd, OwnedFd};
use std::sync::Arc;
use std::time::Duration;

use crossguard_codec::geonet::ethernet;
use crossguard_endpoint::station::listen::link_layer_of;
use nix::errno::Errno;
use nix::sys::socket::{
    AddressFamily, MsgFlags, SockFlag, SockProtocol, SockType, bind, send, socket,
};

use super::datagrams::{Datagrams, Taken};
use super::error::address_of;
use super::{Arrival, Halves, LinkError, NotSent, Receiver, Sender, Source};

/// Opens a raw socket on an interface. Fails where there is none, or without the right to open raw sockets.
pub(super) fn open(interface: &str) -> Result<Halves, LinkError> {
    let failed = |errno: Errno| LinkError::Ethernet {
        interface: interface.to_owned(),
        cause: errno.into(),
    };
    // The address that stands for the interface.
    let address = address_of(interface, |it| it.as_link_addr().copied())?;
    let socket = socket(
        AddressFamily::Packet,
        SockType::Raw,
        SockFlag::SOCK_CLOEXEC,
        SockProtocol::EthAll,
    );
    let socket = Arc::new(socket.map_err(failed)?);
    bind(socket.as_raw_fd(), &address).map_err(failed)?;
    let receiver = EthernetReceiver {
        frames: Datagrams::of(Arc::clone(&socket)),
    };
    Ok(Halves::of(EthernetSender { socket }, receiver))
}

struct EthernetSender {
    socket: Arc<OwnedFd>,
}

impl Sender for EthernetSender {
    fn send(&mut self, octets: &[u8]) -> Result<(), NotSent> {
        let frame = [&ethernet::header(link_layer_of(octets))[..], octets].concat();
        let sent = send(self.socket.as_raw_fd(), &frame, MsgFlags::MSG_DONTWAIT);
        sent.map(drop)
            .map_err(|errno| NotSent::to_one(errno.into()))
    }
}

struct EthernetReceiver {
    frames: Datagrams<Arc<OwnedFd>>,
}

impl Receiver for EthernetReceiver {
    fn receive(&mut self, at_most: Duration) -> std::io::Result<Option<Arrival>> {
        let (frame, at) = match self.frames.next(at_most)? {
            Some(Taken::Datagram(_, frame, at)) => (frame, at),
            Some(Taken::Overflow(count)) => return Ok(Some(Arrival::Overflow(count))),
            None => return Ok(None),
        };
        // A frame that is not for the service is not looked at, and not worth a count.
        Ok(
            ethernet::packet(frame).map(|(source, packet)| Arrival::Datagram {
                from: Source::LinkLayer(source),
                octets: packet.to_vec(),
                at,
            }),
        )
    }
}
