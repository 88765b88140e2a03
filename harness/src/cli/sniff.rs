//! `crossguard sniff`.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::Duration;

use crossguard_codec::si::timestamp_its;
use crossguard_evaluation::messages::packet_air_time_us;
use crossguard_judge::sniffer::{Seen, Sniffer};
use crossguard_robot::capture;

use super::listening::ListeningArguments;
use super::{Failure, print};

#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
pub(super) struct Arguments {
    /// A file in pcap or pcapng.
    #[arg(value_name = "FILE")]
    file: PathBuf,
    #[command(flatten)]
    listening: ListeningArguments,
    /// Print JSON, one object per packet, with the whole message where it is decoded.
    #[arg(long)]
    json: bool,
}

const AFTER_HELP: &str = "A line says: seconds since the first packet, message, station, size, what the message says. At the end \
    stands what could not be read, and what each kind of message costs a channel of ITS-G5 (6 Mbit/s, 10 MHz). Signatures are \
    verified with --trust only; 'signed' says that they were not, and 'not verified' that they could not be. \
    'run --pcap', 'demo --pcap' and tcpdump make such files; tshark with codec/wireshark/crossguard.lua listens live and filters.";

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let mut sniffer = Sniffer::new(arguments.listening.identifiers()?)
        .with_signatures(arguments.listening.signatures()?);
    let mut load = Load::default();
    let mut is_read = Ok(());
    for captured in capture::read(&arguments.file).map_err(Failure::input)? {
        let captured = match captured.map_err(Failure::input) {
            Ok(captured) => captured,
            // Packets before the file turns bad are summed up.
            Err(failure) => {
                is_read = Err(failure);
                break;
            }
        };
        let unix_ms = u64::try_from(captured.at.as_millis()).unwrap_or(u64::MAX);
        let now_its = timestamp_its(i64::try_from(unix_ms).unwrap_or(i64::MAX));
        let seen = sniffer.see(&captured.packet, unix_ms, now_its);
        load.add(&seen);
        if arguments.json {
            print(serde_json::to_string(&seen).map_err(Failure::input)?)?;
        } else {
            print(&seen)?;
        }
    }
    if !arguments.json {
        if load.kinds.is_empty() {
            print("no GeoNetworking packet")?;
        }
        for (cause, count) in sniffer.counters().iter() {
            print(format_args!("not read, {cause}: {count}"))?;
        }
        load.lines().try_for_each(print)?;
    }
    is_read
}

/// Load of the channel by each kind of message.
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
