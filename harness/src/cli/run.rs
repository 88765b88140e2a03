//! `crossguard run`.
//!
//! ```text
//!   robot ──► journal ─┬─► log file        a thread of its own
//!     ▲                ├─► --json          a thread of its own
//!     │ orders         └─► Console ─► lines for people, by a thread of its own
//!     └──────────────────────┘ ▲
//!                              └── standard input, signals
//! ```
//!
//! The console never waits for anybody but the robot, so that it hears a signal at any time.

mod all;
mod drops;
mod output;
mod typed;

use std::collections::VecDeque;
use std::net::{SocketAddr, SocketAddrV4};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use crossguard_codec::Service;
use crossguard_endpoint::cause::{Cause, Layer};
use crossguard_endpoint::counters::CauseName;
use crossguard_endpoint::station::Mode;
use crossguard_endpoint::station::listen::overhear;
use crossguard_model_check::names::Names;
use crossguard_model_check::timed::{Limits, USUAL_DELAY};
use crossguard_protocol::{Input, Output, Robot, State, StationId};
use crossguard_robot::attachment::Sends;
use crossguard_robot::boot;
use crossguard_robot::journal::{RECORDS, WhenFull};
use crossguard_robot::operator::port::Desk;
use crossguard_robot::operator::{Line, help};
use crossguard_robot::perception::{Announced, Feed};
use crossguard_robot::port::{self, Listening};
use crossguard_robot::robot_file::{Besides, RobotFile};
use crossguard_robot::runtime::{Order, Panicked, Running};
use crossguard_robot::trace::{Entry, Record};
use crossguard_robot::transport::{Faults, Halves, Link, Reopening, Transport, WithFaults};
use drops::Drops;
use output::Outputs;
use typed::{TYPED, Typed};

use super::interrupts::interrupts;
use super::ranges::{any, group, station};
use super::writing::Lines;
use super::{Failure, destinations, print};
use crate::metrics::Shared;

/// Text of a robot when a duty begins.
const ON_DUTY: &str =
    "on duty: it helps nobody else before the road is clear; type clear once nobody is on the road";

/// How long the loop waits before it looks at the other things.
const TICK: Duration = Duration::from_millis(20);

#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
pub(super) struct Arguments {
    /// The robot's configuration.
    #[arg(long, value_name = "FILE", required_unless_present = "all")]
    config: Option<PathBuf>,
    /// Run each robot whose configuration is in this folder, as a process of its own, with its log beside its file. A line
    /// that is typed goes to the robot whose name it begins with, or to all.
    #[arg(long, value_name = "FOLDER", exclusive = true)]
    all: Option<PathBuf>,
    /// The site, instead of that of the configuration; see 'crossguard site'.
    #[arg(long, value_name = "FILE")]
    site: Option<PathBuf>,
    /// What the robot does when it leads, instead of the configured plan: a file, or the name of one that comes with
    /// the kit, like bilateral or trio.
    #[arg(long, value_name = "FILE|NAME")]
    plan: Option<PathBuf>,
    /// Check the configuration, and run nothing.
    #[arg(long)]
    check: bool,
    /// Send to and listen on this multicast group instead of the configured link.
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
    /// Send and listen in Ethernet frames on this interface instead of the configured link; takes
    /// the right to open raw sockets.
    #[arg(long, value_name = "NAME", group = "link")]
    ethernet: Option<String>,
    /// Faults on the way to the robot, like loss=0.2,burst=0.4x8,duplication=0.1,delay=5..50.
    #[arg(long, value_name = "LIST", default_value = "")]
    faults: Faults,
    /// Seed of the faults and of the robot's gait.
    #[arg(long, default_value_t = 1, value_parser = any)]
    seed: u64,
    /// People that the robot's sensors report: a file or pipe of JSON lines, see below.
    #[arg(long, value_name = "FILE")]
    perceived: Option<PathBuf>,
    #[command(flatten)]
    etsi: super::etsi::EtsiArguments,
    #[command(flatten)]
    security: super::security::SecurityArguments,
    /// Write the log to this file, one JSON object per line.
    #[arg(long, value_name = "FILE")]
    log: Option<PathBuf>,
    /// Write all packets that are sent and received to this file, for Wireshark.
    #[arg(long, value_name = "FILE")]
    pcap: Option<PathBuf>,
    #[command(flatten)]
    watch: super::watch::WatchArguments,
    #[command(flatten)]
    wording: super::Wording,
    /// What a station is called; `run --all` says it of all its robots.
    #[arg(long, value_name = "STATION=NAME", value_parser = named, hide = true)]
    named: Vec<(StationId, String)>,
    /// Print the log to standard output, and nothing else.
    #[arg(long)]
    json: bool,
}

const AFTER_HELP: &str =
    "Events are typed or piped in; type 'help' for a list. At the end of piped \
input the robot goes on; 'quit' or Ctrl-C makes it leave its session in order and stop.

A line of --perceived is a frame: everybody whom a sensor source saw at one time, like
  {\"at_s\": 1.5, \"people\": [{\"id\": 7, \"position_m\": [3.0, -1.5], \"velocity_mps\": [1.2, 0.0],
   \"class\": \"pedestrian\", \"confidence\": 0.9, \"error_m\": 0.2}]}
in metres on the site. at_s is when the source looked, in seconds from the start; a source that writes
into a pipe says \"unix_s\", seconds since 1970, instead, for a time in the future is malformed there. Only position_m is needed of a person.
Classes are pedestrian, wheelchairUser, bicyclist, motorcyclist, animal and vehicle. \"covers_m\", a
polygon, says what the source could see, if that is not the whole crossing; \"source\" numbers several
sources from 0 to 3. An empty list says that nobody is there; silence says nothing. A frame that is
older than half a second, or no frame, is dropped and counted. Who is within the radius of [people] in
the configuration (15 m) is announced. With a table [zone] in the configuration, a person who waits
there to cross is detected: nobody has to type 'detect'. A line with one person alone, as it can be
typed, adds that person, and the road is never clear by it.
Try --config harness/examples/kerb.toml --perceived harness/examples/people.jsonl.";

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let (Some(config), None) = (&arguments.config, &arguments.all) else {
        return all::run(arguments.all.as_deref().unwrap_or(Path::new(".")));
    };
    destinations::files([&arguments.log, &arguments.pcap])?;
    let file = RobotFile::read_with(config, besides(arguments));
    let file = file.map_err(Failure::input)?;
    let read = [&arguments.site, &arguments.plan, &arguments.perceived];
    let read = read.into_iter().flatten().chain([config, &file.boot_file]);
    let written = [&arguments.log, &arguments.pcap].into_iter().flatten();
    destinations::others(written, read)?;
    output::warn_of_no_road(&file, arguments.perceived.is_some());
    if arguments.check {
        return print(can_be_run(config, &file));
    }
    let link = configured_link(arguments, &file);
    one_signs(arguments, &link)?;
    let (mut link, address) = open_link(arguments, link)?;
    let capture = super::create_capture(arguments.pcap.as_deref())?;
    if let Some(capture) = &capture {
        link = capture.of_all(link);
    }
    let revoked = file.revoked.as_deref();
    let security = arguments.security.of_robot(&file.name, revoked)?;
    let station = security.station_id(&file.identifiers, file.station);
    let names = names(arguments, &file, station);
    let security_mode = arguments.security.mode().name();
    let (tally, metrics) = arguments.watch.begin(address.clone(), security_mode)?;
    let mut outputs = Outputs::open(arguments.log.as_deref(), arguments.json)?;
    let perceived = super::open_feed(arguments.perceived.as_deref())?;
    let body = file.body_or_port(arguments.seed).map_err(|error| {
        let address = file.body_port.as_ref().map(|port| port.address.to_string());
        Failure::Input(format!("[body] {}: {error}", address.unwrap_or_default()))
    })?;
    let operators = OpenPort::of(&file, &mut outputs)?;
    // The counter is taken last, when nothing else can go wrong, and before anything is sent.
    let boot = boot::take(&file.boot_file).and_then(|boot| {
        if security.signs() {
            boot.remembering()
        } else {
            Ok(boot)
        }
    });
    let boot = boot.map_err(Failure::input)?;
    let counter = boot.counter;
    let mut setup = file.setup(boot, body, security, link, outputs.journal);
    setup.awareness = arguments.etsi.add_to(setup.awareness);
    let clock = setup.clock;
    let mut running = setup.start();
    let operators = operators.map(|port| {
        let desk = Desk {
            robot: file.name.clone(),
            station: station.0,
            boot: counter,
            trusts_ros_graph: file.trust_ros_graph || arguments.security.mode() != Mode::Enforce,
            site: file.site,
            planned: file.plan().map(|plan| plan.request()),
            feed: perceived.clone(),
        };
        desk.serve(port.port, port.records, running.orders(), clock)
    });
    let revoked = file.revoked.iter().cloned();
    revoked.for_each(|list| running.keep_revoked(list));
    let mut console = Console {
        file: &file,
        lines: outputs.lines,
        names,
        tally,
        robot: Robot::new(station, counter),
        doubts_clock: false,
        pending: VecDeque::new(),
        hold: None,
        perceived,
        announced: Announced::default(),
        drops: Drops::default(),
        missing: 0,
    };
    console.say(&format!(
        "{} is station {station}, boot {counter}, on {address}. Type 'help' for help.",
        file.name
    ));
    console.say(&longest_times(config, &file));
    console.say_ports(metrics);
    let interrupted = interrupts();
    let outcome = console.attend(&running, &outputs.records, typed::lines(), &interrupted);
    running.order(Order::Stop);
    let ended = running.wait();
    let served = operators.map_or(Ok(()), JoinHandle::join);
    let missing = console.missing;
    drop(console);
    let written = outputs.writings.finish(missing);
    let captured = super::finish_capture(arguments.pcap.as_deref(), capture);
    let ended = ended.and(served.map_err(|_| Panicked)).map_err(|panicked| {
        super::complain(panicked);
        Failure::Wrong
    });
    // The worst comes first.
    ended.and(outcome).and(captured).and(written)
}

fn besides(arguments: &Arguments) -> Besides<'_> {
    Besides {
        site_file: arguments.site.as_deref(),
        plan_file: arguments.plan.as_deref(),
    }
}

/// The operator port, open, and the records for it.
struct OpenPort {
    port: Listening,
    records: Receiver<Arc<Record>>,
}

impl OpenPort {
    /// Opens the port of a robot file, if it has one.
    fn of(file: &RobotFile, outputs: &mut Outputs) -> Result<Option<Self>, Failure> {
        let Some(address) = &file.operator_port else {
            return Ok(None);
        };
        let port = port::listen(address)
            .map_err(|error| Failure::Input(format!("[operator] {address}: {error}")))?;
        let journal = &mut outputs.journal;
        let records = journal.reader(RECORDS, WhenFull::Skip, Cause::OutputFull);
        Ok(Some(Self { port, records }))
    }
}

/// Text of a check of the configuration.
fn can_be_run(config: &Path, file: &RobotFile) -> String {
    let (config, name, station) = (config.display(), &file.name, file.station);
    format!("{config}: {name}, station {station}, can be run with this configuration")
}

fn named(text: &str) -> Result<(StationId, String), String> {
    let (id, name) = text.split_once('=').ok_or("2=Go2 is wanted")?;
    Ok((station(id)?, name.to_owned()))
}

/// Names of stations: by `--named` and the plan, and this robot by its own name.
fn names(arguments: &Arguments, file: &RobotFile, station: StationId) -> Names {
    if arguments.wording.verbose {
        return Names::short();
    }
    let roles = file.plan_file.iter().flat_map(|plan| &plan.roles);
    let named = roles.filter(|role| !role.any);
    let named = named.filter_map(|role| Some((role.station?, role.robot.clone()?)));
    let given = arguments.named.iter().cloned();
    given
        .chain(named)
        .chain([(station, file.name.clone())])
        .collect()
}

/// How long a failure may go unanswered with these settings.
fn longest_times(config: &Path, file: &RobotFile) -> String {
    let limits = Limits::new(&file.config, USUAL_DELAY);
    format!(
        "With these settings a guard that falls silent closes the corridor within {} ms, and a leader that does stops its \
         followers within {} ms; 'crossguard bounds --config {}' has more such times.",
        limits.corridor_closed.0,
        limits.stopped.0,
        config.display(),
    )
}

/// Refuses what would sign twice, and warns where nobody signs.
fn one_signs(arguments: &Arguments, link: &Link) -> Result<(), Failure> {
    let is_signed_by_unit = matches!(
        link,
        Link::Unit {
            sends: Sends::Btp,
            ..
        }
    );
    if !is_signed_by_unit {
        arguments.security.warn_if_unsigned(link);
    } else if arguments.security.signs() {
        return Err(Failure::Input(
            "[link] sends = \"btp\": a unit signs what it sends itself; leave --security off"
                .to_owned(),
        ));
    }
    Ok(())
}

/// The link of the command line, or else that of the file.
fn configured_link(arguments: &Arguments, file: &RobotFile) -> Link {
    match (
        &arguments.multicast,
        &arguments.interface,
        &arguments.ethernet,
    ) {
        (Some(group), Some(interface), _) => Link::Multicast {
            group: *group,
            interface: interface.clone(),
            framing: file.link.framing(),
        },
        (_, _, Some(interface)) => Link::Ethernet {
            interface: interface.clone(),
        },
        _ => file.link.clone(),
    }
}

/// The link, open, and where it is.
fn open_link(arguments: &Arguments, link: Link) -> Result<(Halves, String), Failure> {
    let address = link.to_string();
    let link = WithFaults::new(Reopening(link), arguments.faults.clone(), arguments.seed).open();
    Ok((link.map_err(Failure::input)?, address))
}

/// The person at the robot: what was typed, and what is printed.
struct Console<'a> {
    file: &'a RobotFile,
    /// Where it says something to people; nowhere, when standard output is the log.
    lines: Option<Lines>,
    names: Names,
    tally: Shared,
    /// The robot as its newest record shows it.
    robot: Robot,
    /// Whether it does not trust its clock.
    doubts_clock: bool,
    pending: VecDeque<Line>,
    hold: Option<Hold>,
    /// The people that the robot's sensors report, from a file.
    perceived: Option<Feed>,
    announced: Announced,
    drops: Drops,
    /// How many records did not get into a log, by the robot's own account.
    missing: u64,
}

/// Whether drops of a cause are many, and all the same; others differ by what is in them.
fn is_frequent(cause: &CauseName) -> bool {
    let many = [Cause::SocketFull, Cause::OtherCrossing].map(CauseName::from);
    matches!(cause.layer, Layer::Inbox | Layer::Perception) || many.contains(cause)
}

/// Time or state that the next line waits for.
enum Hold {
    Time(Instant),
    State(State, Instant),
}

impl Console<'_> {
    fn attend(
        &mut self,
        running: &Running,
        records: &Receiver<Arc<Record>>,
        mut lines: Typed,
        interrupted: &AtomicBool,
    ) -> Result<(), Failure> {
        let mut quits = false;
        loop {
            match records.recv_timeout(TICK) {
                Ok(record) => self.record(&record),
                Err(RecvTimeoutError::Timeout) => {}
                // The robot has stopped, and everything that it said has been taken.
                Err(RecvTimeoutError::Disconnected) => return Ok(()),
            }
            let inbox_full = running.inbox_full();
            if inbox_full > 0 {
                let cause = Cause::InboxFull.into();
                self.tally.with(|it| it.causes.set(&cause, inbox_full));
            }
            while self.pending.len() < TYPED
                && let Some(text) = lines.next()
            {
                match lines.understood(&text, self.file)? {
                    Ok(line) => self.pending.push_back(line),
                    Err(mistake) => self.say(&mistake),
                }
            }
            for perceived in self.perceived.iter().flat_map(Feed::due) {
                running.order(perceived);
            }
            if !quits && (interrupted.load(Ordering::Relaxed) || self.next_line(running)?) {
                quits = true;
                running.order(Order::Stop);
            }
        }
    }

    /// Says where others connect to the robot, its body first. Without one no real robot moves.
    fn say_ports(&mut self, metrics: Option<SocketAddr>) {
        let body = self.file.body_port.as_ref();
        let simulated = || "Its body is simulated: no real robot moves.".to_owned();
        self.say(&body.map_or_else(simulated, |port| {
            format!("Its body connects at {}.", port.address)
        }));
        if let Some(address) = &self.file.operator_port {
            self.say(&format!(
                "Other programs command and watch it at {address}."
            ));
        }
        if let Some(address) = metrics {
            self.say(&format!("Metrics are at http://{address}/metrics."));
        }
    }

    fn record(&mut self, record: &Record) {
        self.tally.with(|tally| tally.record(record));
        if self.lines.is_some() {
            let announced = self.announced(record);
            for line in self.texts(record).into_iter().chain(announced) {
                #[expect(clippy::cast_precision_loss, reason = "centuries of microseconds fit")]
                let time = record.at_us as f64 / 1e6;
                let line = self.names.tell(line);
                self.say(&format!("{time:>9.3} {}: {line}", record.robot));
            }
        }
        match &record.entry {
            Entry::Step { state, .. } => self.robot = (**state).clone(),
            Entry::Clock(clock) => self.doubts_clock = !clock.is_trusted(),
            Entry::Stopped { counters } => {
                self.missing = counters.of(&Cause::LogFull.into());
            }
            _ => {}
        }
    }

    fn say(&mut self, line: &str) {
        if let Some(lines) = &mut self.lines {
            lines.say(line);
        }
    }

    fn texts(&mut self, record: &Record) -> Vec<String> {
        let mut texts = self.drops.over(record.at_us);
        match &record.entry {
            Entry::Step {
                input,
                outputs,
                state,
            } => {
                for output in outputs.iter() {
                    match (output, input) {
                        (Output::Ignored(reason), Input::Local(event)) => {
                            texts.push(format!("{event}: ignored, {reason}"));
                        }
                        // It is extended with every message of a follower.
                        (Output::SendRam | Output::CorridorExtended(_) | Output::Ignored(_), _) => {
                        }
                        (output, _) => texts.push(output.to_string()),
                    }
                }
                if state.state() != self.robot.state() {
                    texts.push(format!("now {:?} ({})", state.state(), state.role()));
                }
                // Nothing else says what ends a duty.
                let is_news = self.robot.duty().is_none() || state.state() != self.robot.state();
                if state.duty().is_some() && is_news {
                    texts.push(ON_DUTY.to_owned());
                }
            }
            Entry::Dropped { cause, detail, .. }
                if cause.layer != Layer::Simulated
                    && !cause.is_own_packet()
                    && (!is_frequent(cause) || self.drops.is_news(record.at_us, cause)) =>
            {
                texts.push(format!("dropped, {cause}: {detail}"));
            }
            Entry::Unrecorded { counters } => {
                for (cause, count) in counters.iter() {
                    self.drops.add(record.at_us, &cause, count);
                }
            }
            Entry::Hindered { why } => texts.push(format!("people may not cross: {why}")),
            // A trusted clock goes without saying, unless it was not trusted before.
            Entry::Clock(clock) if self.doubts_clock || !clock.is_trusted() => {
                texts.push(clock.to_string());
            }
            Entry::Stopped { counters } => {
                texts.push("stopped".to_owned());
                let counted = counters.iter();
                texts.extend(counted.map(|(cause, count)| format!("{count} of {cause}")));
            }
            _ => {}
        }
        texts
    }

    /// News about the people that a RAM announces.
    fn announced(&mut self, record: &Record) -> Option<String> {
        let Entry::Sent {
            message: Service::Ram,
            octets,
            ..
        } = &record.entry
        else {
            return None;
        };
        let ram = overhear(&self.file.identifiers, octets).ok()?;
        self.announced.note(ram.cluster.as_ref())
    }

    /// Takes the next line up if nothing holds it back. Whether it is to quit.
    fn next_line(&mut self, running: &Running) -> Result<bool, Failure> {
        let now = Instant::now();
        match self.hold {
            Some(Hold::Time(until)) if now < until => return Ok(false),
            Some(Hold::State(wanted, until)) if self.robot.state() != wanted => {
                if now < until {
                    return Ok(false);
                }
                let found = self.robot.state();
                self.say(&format!(
                    "{wanted:?} was not reached in time; the state is {found:?}"
                ));
                return Err(Failure::Wrong);
            }
            _ => self.hold = None,
        }
        match self.pending.pop_front() {
            Some(Line::Order(order)) => running.order(order),
            Some(Line::Wait(time)) => self.hold = Some(Hold::Time(now + time)),
            Some(Line::Until(state, time)) => self.hold = Some(Hold::State(state, now + time)),
            Some(Line::Status) => {
                self.say(&self.names.tell(&self.robot));
                self.say(&self.names.tell(self.tally.with(|it| it.surroundings())));
                self.say(&self.tally.with(|it| it.equipment()));
            }
            Some(Line::Help(command)) => self.say(&help(command)),
            Some(Line::Quit) => return Ok(true),
            Some(Line::Blank) | None => {}
        }
        Ok(false)
    }
}
