//! An on-board unit to attach a robot to: the attachment protocol on one side, and on the other Ethernet frames, or
//! a UDP multicast group as a stand-in for the radio channel.
//!
//! ```text
//! Usage: unit LISTEN (multicast GROUP:PORT INTERFACE | ethernet INTERFACE) [BUSY_RATIO]
//! ```
//!
//! A robot whose file says `unit = "127.0.0.1:4747"` under `[link]` is attached to `unit 127.0.0.1:4747 ethernet
//! wlan0`. A real unit measures the busy ratio of its channel and the power of each reception; this one says the
//! ratio that it is given, and no power. It serves the robot that it heard last.

use std::error::Error;
use std::net::{SocketAddr, UdpSocket};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, SystemTime};

use crossguard_robot::attachment::{Frame, Kind, Radio, Side, packet_of, unix_us};
use crossguard_robot::transport::{
    Arrival, Framing, Halves, Link, Receiver, Reopening, Sender, Transport,
};

/// How long the radio side waits before it looks whether it still may.
const PATIENCE: Duration = Duration::from_millis(100);

/// Why a unit cannot go on.
pub(crate) type Problem = Box<dyn Error + Send + Sync>;

/// A unit, open on both sides.
struct Unit {
    socket: UdpSocket,
    /// The robot that was heard last.
    robot: Arc<Mutex<Option<SocketAddr>>>,
    radio: Radio,
}

impl Unit {
    fn robot(&self) -> Option<SocketAddr> {
        *self.robot.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Gives a frame to the robot, if there is one.
    fn tell(&self, frame: &Frame<'_>) -> Result<(), Problem> {
        let frame = Frame {
            radio: self.radio,
            unix_us: Some(unix_us(SystemTime::now())),
            ..*frame
        };
        if let Some(robot) = self.robot() {
            // A robot that is not there any more may come back.
            let _ = self.socket.send_to(&frame.encode()?, robot);
        }
        Ok(())
    }

    /// Does what robots ask for, for ever.
    fn serve_robot(&self, radio: &mut dyn Sender) -> Result<(), Problem> {
        let mut buffer = [0; 2_048];
        loop {
            let (length, from) = match self.socket.recv_from(&mut buffer) {
                Ok(received) => received,
                // What was sent to a robot that is gone comes back as an error.
                Err(error) if error.kind() == std::io::ErrorKind::ConnectionRefused => continue,
                Err(error) => return Err(error.into()),
            };
            let frame = match Frame::decode(&buffer[..length], Side::Robot) {
                Ok(frame) => frame,
                Err(error) => {
                    eprintln!("dropped, {}: {error}", error.cause());
                    continue;
                }
            };
            *self.robot.lock().unwrap_or_else(PoisonError::into_inner) = Some(from);
            let sent = match frame.kind {
                Kind::SendPacket => radio.send(frame.body),
                // A unit with GeoNetworking of its own gives it the payload.
                Kind::SendPayload => radio.send(&packet_of(frame.btp, frame.body)?),
                _ => {
                    self.tell(&Frame::new(Kind::Channel, &[]))?;
                    continue;
                }
            };
            if let Err(error) = sent {
                eprintln!("{error}");
            }
        }
    }

    /// Hands receptions to the robot, for ever.
    fn serve_radio(&self, radio: &mut dyn Receiver) -> Result<(), Problem> {
        loop {
            if let Some(Arrival::Datagram { octets, .. }) = radio.receive(PATIENCE)? {
                self.tell(&Frame::new(Kind::ReceivedPacket, &octets))?;
            }
        }
    }
}

/// The link that stands for the radio, and the busy ratio.
fn radio(arguments: &[String]) -> Result<(Link, Option<&String>), Problem> {
    match arguments {
        [medium, group, interface, rest @ ..] if medium == "multicast" => {
            let link = Link::Multicast {
                group: group.parse()?,
                interface: interface.clone(),
                framing: Framing::default(),
            };
            Ok((link, rest.first()))
        }
        [medium, interface, rest @ ..] if medium == "ethernet" => {
            let interface = interface.clone();
            Ok((Link::Ethernet { interface }, rest.first()))
        }
        _ => Err(
            "usage: unit LISTEN (multicast GROUP:PORT INTERFACE | ethernet INTERFACE) [BUSY_RATIO]"
                .into(),
        ),
    }
}

/// Runs a unit with these arguments until something of it fails.
pub(crate) fn serve(arguments: &[String]) -> Result<(), Problem> {
    let (listen, rest) = arguments
        .split_first()
        .ok_or("where to listen is missing")?;
    let (link, busy) = radio(rest)?;
    let busy = busy.map(|ratio| ratio.parse::<f64>()).transpose()?;
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "from 0 to 10,000"
    )]
    let permyriad = |ratio: f64| (ratio.clamp(0.0, 1.0) * 10_000.0).round() as u16;
    let unit = Unit {
        socket: UdpSocket::bind(listen)?,
        robot: Arc::default(),
        radio: Radio {
            power_decidbm: None,
            busy_permyriad: busy.map(permyriad),
        },
    };
    let Halves {
        mut sender,
        mut receiver,
    } = Reopening(link).open()?;
    std::thread::scope(|scope| {
        let of_robot = scope.spawn(|| unit.serve_robot(&mut *sender));
        unit.serve_radio(&mut *receiver)?;
        of_robot.join().unwrap_or(Ok(()))
    })
}

#[allow(dead_code, reason = "a test calls what is above")]
fn main() -> Result<(), Problem> {
    let arguments: Vec<_> = std::env::args().skip(1).collect();
    serve(&arguments)
}
