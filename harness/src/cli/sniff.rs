//! `crossguard sniff`.

use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::net::{SocketAddr, SocketAddrV4};
use std::path::PathBuf;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use clap::builder::{PossibleValuesParser, TypedValueParser};
use crossguard_codec::si::timestamp_its;
use crossguard_codec::{Identity, Service};
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
    /// Only these messages; may be given several times. '?' is what is not read.
    #[arg(long = "kind", value_name = "KIND", value_parser = kinds(), ignore_case = true)]
    kinds: Vec<String>,
    /// Only messages of these stations; may be given several times.
    #[arg(long = "station", value_name = "ID", value_parser = any_station)]
    stations: Vec<u32>,
    /// Only what is not before this second.
    #[arg(long, value_name = "S", default_value_t = 0.0, hide_default_value = true, value_parser = number(0.0..=1e9))]
    from: f64,
    /// Stop after this many packets.
    #[arg(long, value_name = "N", value_parser = whole::<u64>(1..=u64::MAX.into()))]
    count: Option<u64>,
    /// Stop at this second.
    #[arg(long, value_name = "S", value_parser = number(0.0..=1e9))]
    seconds: Option<f64>,
    /// Write what is heard to this file, for Wireshark.
    #[arg(long, value_name = "FILE", conflicts_with = "file")]
    pcap: Option<PathBuf>,
    #[command(flatten)]
    listening: ListeningArguments,
    /// Print JSON, one object per packet, with the whole message where it is decoded.
    #[arg(long)]
    json: bool,
}

const AFTER_HELP: &str = "Examples:\n  crossguard sniff demo.pcap\n  \
    crossguard sniff road.pcapng --kind SPATEM --kind MAPEM --from 60 --seconds 120\n  \
    crossguard sniff --multicast 239.118.50.1:47400 --interface eth0 --station 2 --json\n\n\
    A line says: seconds since the first packet, message, station, size, what the message says. At the end stands who was \
    around last, how many messages of each kind each station sent, and what each kind costs a channel of ITS-G5 (6 Mbit/s, \
    10 MHz). Signatures are verified with --trust only; 'signed' says that they were not, and 'not verified' that they could \
    not be.";

/// The kinds of messages that have names, and what is not read.
fn kinds() -> impl TypedValueParser<Value = String> {
    let own = Service::ALL.into_iter().map(Service::name);
    let foreign = Service::FOREIGN.into_iter().map(|(_, name)| name);
    PossibleValuesParser::new(own.chain(foreign).chain(["?"]))
}

/// Any station id, also 0: others may go by it.
fn any_station(text: &str) -> Result<u32, String> {
    whole(0..=u32::MAX.into())(text)
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let mut printer = Printer {
        sniffer: Sniffer::new(arguments.listening.identifiers()?)
            .with_signatures(arguments.listening.signatures()?),
        has_seen: false,
        load: Load::default(),
        left: arguments.count.unwrap_or(u64::MAX),
        arguments,
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

fn listen(arguments: &Arguments, link: &Link, printer: &mut Printer<'_>) -> Result<(), Failure> {
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
struct Printer<'a> {
    arguments: &'a Arguments,
    sniffer: Sniffer,
    /// Whether there was any packet, asked for or not.
    has_seen: bool,
    load: Load,
    /// How many packets are yet to be seen.
    left: u64,
}

impl Printer<'_> {
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
        let asked = self.arguments;
        self.has_seen = true;
        if asked.seconds.is_some_and(|end| seen.at_s > end) {
            return Ok(false);
        }
        // What is left out is taken in all the same: a message may need the certificate of one before.
        if seen.at_s < asked.from || !asked.wants(&seen) {
            return Ok(true);
        }
        self.load.add(&seen, seen.at_s - asked.from);
        self.print(&seen)?;
        self.left -= 1;
        Ok(self.left > 0)
    }

    fn print(&self, seen: &Seen) -> Result<(), Failure> {
        if self.arguments.json {
            let line = serde_json::to_string(seen).map_err(Failure::input)?;
            return print(line);
        }
        print(seen)
    }

    /// Who was around in the end, who sent what, what could not be read, and the load.
    fn sum_up(&self) -> Result<(), Failure> {
        if self.arguments.json {
            return Ok(());
        }
        if self.load.kinds.is_empty() {
            print(if self.has_seen {
                "no packet is of that kind, station and time"
            } else {
                "no GeoNetworking packet"
            })?;
        }
        for neighbour in self.sniffer.map().iter() {
            let user = &neighbour.user;
            let (Identity::Station(by) | Identity::Object { by, .. }) = user.identity;
            if !self.arguments.wants_station(Some(by)) {
                continue;
            }
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
        self.load.stations().try_for_each(print)?;
        self.load.lines().try_for_each(print)
    }
}

impl Arguments {
    /// The options let this packet through.
    fn wants(&self, seen: &Seen) -> bool {
        let kinds = &self.kinds;
        let is_kind = kinds.is_empty() || kinds.iter().any(|it| it.eq_ignore_ascii_case(seen.kind));
        is_kind && self.wants_station(seen.station)
    }

    fn wants_station(&self, station: Option<u32>) -> bool {
        let stations = &self.stations;
        stations.is_empty() || station.is_some_and(|station| stations.contains(&station))
    }
}

/// How many stations are told of at the end.
const STATIONS_TOLD: usize = 50;
/// How many are counted one by one.
const STATIONS_MAX: usize = 65_536;

/// What each kind of message costs the channel.
#[derive(Default)]
struct Load {
    kinds: BTreeMap<&'static str, Share>,
    /// How many messages of each kind a station sent.
    stations: BTreeMap<u32, BTreeMap<&'static str, u64>>,
    seconds: f64,
}

#[derive(Default)]
struct Share {
    packets: u32,
    octets: u32,
    air_s: f64,
}

impl Load {
    fn add(&mut self, seen: &Seen, second: f64) {
        let share = self.kinds.entry(seen.kind).or_default();
        share.packets += 1;
        share.octets += u32::try_from(seen.octets).unwrap_or(u32::MAX);
        share.air_s += Duration::from_micros(packet_air_time_us(seen.octets)).as_secs_f64();
        self.seconds = self.seconds.max(second);
        if let Some(station) = seen.station
            && (self.stations.len() < STATIONS_MAX || self.stations.contains_key(&station))
        {
            let kinds = self.stations.entry(station).or_default();
            *kinds.entry(seen.kind).or_default() += 1;
        }
    }

    /// A line for each of the stations that sent most.
    fn stations(&self) -> impl Iterator<Item = String> {
        let mut stations: Vec<_> = self.stations.iter().collect();
        stations.sort_by_cached_key(|(_, kinds)| Reverse(kinds.values().sum::<u64>()));
        let more = stations.len().saturating_sub(STATIONS_TOLD);
        stations.truncate(STATIONS_TOLD);
        let line = |(station, kinds): (&u32, &BTreeMap<&str, u64>)| {
            let kinds = kinds.iter().map(|(kind, count)| format!("{count} {kind}"));
            format!(
                "station {station}: {}",
                kinds.collect::<Vec<_>>().join(", ")
            )
        };
        let more = (more > 0).then(|| format!("and {more} stations that sent less"));
        stations.into_iter().map(line).chain(more)
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
