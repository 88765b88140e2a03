//! An on-board unit, attached by the frames of [`attachment`](crate::attachment) over UDP.
//!
//! The robot says [`Kind::Hello`] once a second; a unit answers, and gives what it receives to the address that the
//! newest hello came from. A unit that says nothing for longer is told of as a link that has failed.

use std::io::{Error, ErrorKind};
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr, UdpSocket};
use std::time::{Duration, Instant, SystemTime};

use nix::sys::socket::MsgFlags;
use socket2::SockRef;

use super::datagrams::{Datagrams, Taken};
use super::udp::open_error;
use super::{Arrival, Halves, LinkError, NotSent, Receiver, Sender, Source};
use crate::attachment::{Frame, Kind, Radio, Sends, Side, packet_of, payload_of, waited};

/// How often the robot says that it is here.
const HELLO_PERIOD: Duration = Duration::from_secs(1);

/// For how long a unit may say nothing.
const SILENCE_MAX: Duration = Duration::from_secs(3);

/// How often the robot takes in how the channel is, at most.
const CHANNEL_PERIOD: Duration = Duration::from_millis(100);

/// Opens the link to the unit at this address, from `address` or from any port. Fails where that cannot be used.
pub(super) fn open(
    unit: SocketAddr,
    address: Option<SocketAddr>,
    sends: Sends,
) -> Result<Halves, LinkError> {
    let any: IpAddr = match (unit.ip().is_loopback(), unit) {
        (true, _) => unit.ip(),
        (false, SocketAddr::V4(_)) => Ipv4Addr::UNSPECIFIED.into(),
        (false, SocketAddr::V6(_)) => Ipv6Addr::UNSPECIFIED.into(),
    };
    let address = address.unwrap_or(SocketAddr::new(any, 0));
    let connected = |address| {
        let socket = UdpSocket::bind(address)?;
        // No other sender is heard on it then.
        socket.connect(unit)?;
        let (hello, receiver) = (socket.try_clone()?, socket.try_clone()?);
        Ok((socket, hello, receiver))
    };
    let (socket, hello, receiver) = connected(address).map_err(open_error(address))?;
    let now = Instant::now();
    let receiver = UnitReceiver {
        unit,
        hello,
        datagrams: Datagrams::of(receiver),
        said_hello: None,
        heard: now,
        told_channel: None,
        next: None,
    };
    Ok(Halves::of(UnitSender { socket, sends }, receiver))
}

#[derive(Debug)]
struct UnitSender {
    socket: UdpSocket,
    sends: Sends,
}

impl UnitSender {
    fn frame(&self, packet: &[u8]) -> Result<Vec<u8>, Error> {
        let impossible = |why: String| Error::new(ErrorKind::WouldBlock, why);
        let frame = match self.sends {
            Sends::GeoNetworking => Frame::new(Kind::SendPacket, packet),
            Sends::Btp => {
                let (btp, payload) =
                    payload_of(packet).map_err(|error| impossible(error.to_string()))?;
                Frame {
                    btp,
                    ..Frame::new(Kind::SendPayload, payload)
                }
            }
        };
        frame
            .encode()
            .map_err(|error| impossible(error.to_string()))
    }
}

impl Sender for UnitSender {
    fn send(&mut self, octets: &[u8]) -> Result<(), NotSent> {
        let now = MsgFlags::MSG_DONTWAIT.bits();
        let sent = self.frame(octets).and_then(|frame| {
            let socket = SockRef::from(&self.socket);
            socket.send_with_flags(&frame, now).map_err(|error| {
                // A unit that is started again is found at the same address.
                match error.kind() {
                    ErrorKind::ConnectionRefused => {
                        Error::new(ErrorKind::NotConnected, "no unit is there")
                    }
                    _ => error,
                }
            })
        });
        sent.map(drop).map_err(NotSent::to_one)
    }
}

#[derive(Debug)]
struct UnitReceiver {
    unit: SocketAddr,
    hello: UdpSocket,
    datagrams: Datagrams<UdpSocket>,
    said_hello: Option<Instant>,
    /// When the unit was heard last, or its silence was told of.
    heard: Instant,
    told_channel: Option<Instant>,
    /// Datagram of a frame that also told how the channel is.
    next: Option<Arrival>,
}

impl UnitReceiver {
    fn say_hello(&mut self) {
        let is_due = |said: Instant| said.elapsed() >= HELLO_PERIOD;
        if self.said_hello.is_none_or(is_due) {
            self.said_hello = Some(Instant::now());
            if let Ok(hello) = Frame::new(Kind::Hello, &[]).encode() {
                // A unit that is not there yet hears the next one.
                let _ = self.hello.send(&hello);
            }
        }
    }

    /// How the channel is, if that is to be told now.
    fn channel(&mut self, radio: Radio) -> Option<Arrival> {
        let is_early = self
            .told_channel
            .is_some_and(|told| told.elapsed() < CHANNEL_PERIOD);
        if radio.is_unknown() || is_early {
            return None;
        }
        self.told_channel = Some(Instant::now());
        Some(Arrival::Channel(radio))
    }
}

/// Packet or payload in a frame for the robot, if there is one.
fn packet_in(frame: &Frame<'_>, unit: SocketAddr, at: Instant) -> Option<Arrival> {
    let octets = match frame.kind {
        Kind::ReceivedPacket => Ok(frame.body.to_vec()),
        Kind::ReceivedPayload => packet_of(frame.btp, frame.body),
        _ => return None,
    };
    let octets = match octets {
        Ok(octets) => octets,
        Err(error) => return Some(Arrival::misframed("frame body", &error, frame.body)),
    };
    let waited = frame.unix_us.map(|us| waited(us, SystemTime::now()));
    // By the unit it was there earlier than by the socket.
    let by_unit = waited.and_then(|waited| Instant::now().checked_sub(waited));
    Some(Arrival::Datagram {
        from: Source::Address(unit),
        octets,
        at: by_unit.map_or(at, |by_unit| by_unit.min(at)),
    })
}

impl Receiver for UnitReceiver {
    fn receive(&mut self, at_most: Duration) -> std::io::Result<Option<Arrival>> {
        if let Some(next) = self.next.take() {
            return Ok(Some(next));
        }
        self.say_hello();
        let (octets, at) = match self.datagrams.next(at_most)? {
            Some(Taken::Datagram(_, octets, at)) => (octets, at),
            Some(Taken::Overflow(count)) => return Ok(Some(Arrival::Overflow(count))),
            None if self.heard.elapsed() < SILENCE_MAX => return Ok(None),
            None => {
                self.heard = Instant::now();
                let (unit, seconds) = (self.unit, SILENCE_MAX.as_secs());
                let silent = format!("the unit at {unit} has been silent for {seconds} s");
                return Err(Error::new(ErrorKind::TimedOut, silent));
            }
        };
        self.heard = Instant::now();
        match Frame::decode(octets, Side::Unit) {
            Ok(frame) => {
                let (radio, packet) = (frame.radio, packet_in(&frame, self.unit, at));
                let Some(channel) = self.channel(radio) else {
                    return Ok(packet);
                };
                self.next = packet;
                Ok(Some(channel))
            }
            Err(error) => Ok(Some(Arrival::misframed(error.cause(), &error, octets))),
        }
    }
}
