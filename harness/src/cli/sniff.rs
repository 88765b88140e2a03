//! `crossguard sniff`.

use std::collections::BTreeMap;
use std::net::{SocketAddr, SocketAddrV4};
use std::path::PathBuf;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use crossguard_codec::si::timestamp_its;
use crossguard_evaluation::messages::packet_air_time_us;
use crossguard_judge::sniffer::{self, Seen, Sniffer};
use crossguard_robot::capture::{self, Captured, NoCapture};
use crossguard_robot::transport::{Arrival, Framing, Link, Transport};

use super::interrupts::interrupts;
use super::listening::ListeningArguments;
use super::ranges::{address, group, number, whole};
use super::{Failure, print};

/// How long the loop waits before it looks whether it is to stop.
const TICK: Duration = Duration::from_millis(50);

#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
pub(super) struct Arguments {
    /// Read this file, in pcap or pcapng, instead of listening.
    #[arg(value_name = "FILE", group = "link")]
    file: Option<PathBuf>,
    /// Listen on this UDP address; robots send there if it is one of their peers.
    #[arg(long, value_name = "ADDRESS:PORT", value_parser = address::<SocketAddr>, group = "link")]
    address: Option<SocketAddr>,
    /// Listen to this multicast group.
    #[arg(
        long,
        value_name = "GROUP:PORT",
        value_parser = group,
        requires = "interface",
        group = "link"
    )]
    multicast: Option<SocketAddrV4>,
    /// The interface of the multicast group.
    #[arg(long, value_name = "NAME", requires = "multicast")]
    interface: Option<String>,
    /// Listen to Ethernet frames on this interface; takes the right to open raw sockets.
    #[arg(long, value_name = "NAME", group = "link")]
    ethernet: Option<String>,
    /// Stop after this many packets.
    #[arg(long, value_name = "N", value_parser = whole::<u64>(1..=u64::MAX.into()))]
    count: Option<u64>,
    /// Stop after this many seconds.
    #[arg(long, value_name = "S", value_parser = number(0.0..=1e9))]
    seconds: Option<f64>,
    /// Write what is heard to this file, for Wireshark.
    #[arg(long, value_name = "FILE", conflicts_with = "file")]
    pcap: Option<PathBuf>,
    #[command(flatten)]
    listening: ListeningArguments,
    /// Print JSON, one object per packet.
    #[arg(long)]
    json: bool,
}

const AFTER_HELP: &str = "Examples:\n  crossguard sniff demo.pcap\n  \
    crossguard sniff --multicast 239.118.50.1:47400 --interface eth0\n\n\
    A line says: seconds, message, station, size, what the message says. At the end stands who was \
    around last, and what each kind of message costs a channel of ITS-G5 (6 Mbit/s, 10 MHz). Signatures are verified with \
    --trust only; 'signed' says that they were not, and 'not verified' that they could not be.";

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let mut printer = Printer {
        sniffer: Sniffer::new(arguments.listening.identifiers()?)
            .with_signatures(arguments.listening.signatures()?),
        is_json: arguments.json,
        load: Load::default(),
        left: arguments.count.unwrap_or(u64::MAX),
    };
    let mut is_read = Ok(());
    match (&arguments.file, link(arguments)) {
        (Some(path), _) => {
            let packets = capture::read(path).map_err(Failure::input)?;
            // What was seen before the file turns bad is summed up.
            is_read = printer.see_all(packets);
        }
        (None, Some(link)) => listen(arguments, &link, &mut printer)?,
        (None, None) => {
            return Err(Failure::Input(
                "nothing to listen to: name a capture file, --address, --multicast or --ethernet \
                 (see --help)"
                    .to_owned(),
            ));
        }
    }
    printer.sum_up()?;
    is_read
}

fn link(arguments: &Arguments) -> Option<Link> {
    if let Some(address) = arguments.address {
        return Some(Link::Peers {
            address,
            peers: Vec::new(),
            framing: Framing::default(),
        });
    }
    if let (Some(group), Some(interface)) = (arguments.multicast, &arguments.interface) {
        let interface = interface.clone();
        return Some(Link::Multicast {
            group,
            interface,
            framing: Framing::default(),
        });
    }
    let interface = arguments.ethernet.clone()?;
    Some(Link::Ethernet { interface })
}

fn listen(arguments: &Arguments, link: &Link, printer: &mut Printer) -> Result<(), Failure> {
    let mut halves = link.open().map_err(Failure::input)?;
    let capture = super::create_capture(arguments.pcap.as_deref())?;
    if let Some(capture) = &capture {
        halves = capture.of_all(halves);
    }
    let interrupted = interrupts();
    let began = Instant::now();
    let enough = |began: Instant| {
        let limit = arguments.seconds;
        limit.is_some_and(|limit| began.elapsed().as_secs_f64() >= limit)
    };
    if super::shows_progress(arguments.json) {
        eprintln!("Listening on {link}; Ctrl-C stops.");
    }
    while !interrupted.load(Ordering::Relaxed) && !enough(began) {
        let arrival = halves.receiver.receive(TICK);
        let arrival = arrival.map_err(|error| Failure::Input(format!("{link}: {error}")))?;
        if let Some(Arrival::Datagram { octets, .. }) = arrival {
            let now = SystemTime::now().duration_since(UNIX_EPOCH);
            if !printer.see(&octets, now.unwrap_or_default())? {
                break;
            }
        }
    }
    super::finish_capture(capture)
}

/// What is seen, as it is printed.
struct Printer {
    sniffer: Sniffer,
    is_json: bool,
    load: Load,
    /// How many packets are yet to be seen.
    left: u64,
}

impl Printer {
    /// Prints packets to the end, or up to one that cannot be read.
    fn see_all(
        &mut self,
        packets: impl Iterator<Item = Result<Captured, NoCapture>>,
    ) -> Result<(), Failure> {
        for captured in packets {
            let captured = captured.map_err(Failure::input)?;
            if !self.see(&captured.packet, captured.at)? {
                break;
            }
        }
        Ok(())
    }

    /// Prints a packet. Whether to go on.
    fn see(&mut self, packet: &[u8], at: Duration) -> Result<bool, Failure> {
        if self.left == 0 {
            return Ok(false);
        }
        let unix_ms = u64::try_from(at.as_millis()).unwrap_or(u64::MAX);
        let now_its = timestamp_its(i64::try_from(unix_ms).unwrap_or(i64::MAX));
        let seen = self.sniffer.see(packet, unix_ms, now_its);
        self.load.add(&seen);
        self.print(&seen)?;
        self.left -= 1;
        Ok(self.left > 0)
    }

    fn print(&self, seen: &Seen) -> Result<(), Failure> {
        if self.is_json {
            let line = serde_json::to_string(seen).map_err(Failure::input)?;
            return print(line);
        }
        print(seen)
    }

    /// Who was around in the end, what could not be read, and the load.
    fn sum_up(&self) -> Result<(), Failure> {
        if self.is_json {
            return Ok(());
        }
        if self.load.kinds.is_empty() {
            print("no GeoNetworking packet")?;
        }
        for neighbour in self.sniffer.map().iter() {
            let user = &neighbour.user;
            print(format_args!(
                "around: {} {}, {}",
                user.kind,
                user.identity,
                sniffer::place(user)
            ))?;
        }
        for (cause, count) in self.sniffer.counters().iter() {
            print(format_args!("not read, {cause}: {count}"))?;
        }
        self.load.lines().try_for_each(print)
    }
}

/// What each kind of message costs the channel.
#[derive(Default)]
struct Load {
    kinds: BTreeMap<&'static str, Share>,
    seconds: f64,
}

#[derive(Default)]
struct Share {
    packets: u32,
    octets: u32,
    air_s: f64,
}

impl Load {
    fn add(&mut self, seen: &Seen) {
        let share = self.kinds.entry(seen.kind).or_default();
        share.packets += 1;
        share.octets += u32::try_from(seen.octets).unwrap_or(u32::MAX);
        share.air_s += Duration::from_micros(packet_air_time_us(seen.octets)).as_secs_f64();
        self.seconds = self.seconds.max(seen.at_s);
    }

    /// A line for each kind; none where no time has passed.
    fn lines(&self) -> impl Iterator<Item = String> {
        let kinds = self.kinds.iter().filter(|_| self.seconds > 0.0);
        kinds.map(|(kind, share)| {
            format!(
                "load: {kind} {:.1} packets/s of {:.0} B, {:.3} % of the channel",
                f64::from(share.packets) / self.seconds,
                f64::from(share.octets) / f64::from(share.packets),
                share.air_s / self.seconds * 100.0
            )
        })
    }
}
