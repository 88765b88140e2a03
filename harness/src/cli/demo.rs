//! `crossguard demo`.

use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::builder::{PossibleValue, PossibleValuesParser};
use comfy_table::presets::NOTHING;
use comfy_table::{CellAlignment, Table};
use crossguard_codec::Identifiers;
use crossguard_endpoint::ras::surroundings::Awareness;
use crossguard_endpoint::station::Mode;
use crossguard_judge::chart::Chart;
use crossguard_judge::timing::{Statistic, Summary};
use crossguard_protocol::StationId;
use crossguard_robot::plan_file::PlanFile;
use crossguard_robot::trace::{LogFile, LogLimits, Record};
use crossguard_robot::transport::Faults;

use super::interrupts::interrupts;
use super::ranges::{any, in_range, speed, whole};
#[cfg(feature = "full")]
use super::report::write_page;
#[cfg(not(feature = "full"))]
use super::small::write_page;
use super::{Failure, destinations, print, print_json};
use crate::demo::{self, Links, Options, Outcome, Scenario, Seen};

#[derive(clap::Args)]
pub(super) struct Arguments {
    /// What happens: a plan that comes with the kit.
    #[arg(long, value_name = "NAME", value_parser = names(), default_value = "crossing")]
    scenario: String,
    /// What happens: a plan of your own. Its roles name robot, station, build and where that waits.
    #[arg(long, value_name = "FILE", conflicts_with = "scenario")]
    plan: Option<PathBuf>,
    /// The site that the plan is on; by default the street of the demonstrations.
    #[arg(long, value_name = "FILE")]
    site: Option<PathBuf>,
    /// How many followers a team with optional roles has, like that of --scenario team, 1 to 16.
    #[arg(long, value_name = "N", value_parser = whole::<u8>(1..=MAX_FOLLOWERS))]
    followers: Option<u8>,
    /// How many crossings.
    #[arg(long, default_value_t = 1, value_parser = whole::<u16>(1..=1_000))]
    trials: u16,
    /// How many times as fast as real the robots move; the protocol keeps its real timers.
    #[arg(long, default_value_t = 3.0, value_parser = speed)]
    speed: f64,
    /// Probability with which each robot loses a datagram, from 0 to 0.9.
    #[arg(long, default_value_t = 0.0, value_parser = loss)]
    loss: f64,
    /// More faults on the way to each robot, like burst=0.4x8,duplication=0.1,delay=5..50.
    #[arg(long, value_name = "LIST", default_value = "")]
    faults: Faults,
    /// Seed of the faults and of the robots' gait.
    #[arg(long, default_value_t = 1, value_parser = any)]
    seed: u64,
    /// Port of the first robot on 127.0.0.1; the others have the next ones. [default: the first that are free from 47401
    /// on]
    #[arg(long, value_parser = whole::<u16>(1_024..=65_500))]
    port: Option<u16>,
    #[command(flatten)]
    security: super::security::SecurityArguments,
    /// Write the log to this file, one JSON object per line.
    #[arg(long, value_name = "FILE")]
    log: Option<PathBuf>,
    /// Write all packets to this file, for Wireshark.
    #[arg(long, value_name = "FILE")]
    pcap: Option<PathBuf>,
    /// People that the robots' sensors report: a file of JSON lines as for `crossguard run`.
    #[arg(long, value_name = "FILE")]
    perceived: Option<PathBuf>,
    #[command(flatten)]
    etsi: super::etsi::EtsiArguments,
    /// Write a page about the run: the page After of the studio as one file.
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// Print the results as JSON, and nothing else.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    wording: super::Wording,
    /// Leave the chart out.
    #[arg(long, conflicts_with = "json")]
    quiet: bool,
}

/// How many it can have.
const MAX_FOLLOWERS: i128 = crossguard_protocol::MAX_FOLLOWERS as i128;

/// With more robots the chart is wider than a screen.
const CHARTED: usize = 6;

/// The names of the shipped plans.
fn names() -> PossibleValuesParser {
    let values = Scenario::shipped().map(|(name, what)| PossibleValue::new(name).help(what));
    PossibleValuesParser::new(values)
}

/// Scenario that the arguments name.
fn scenario(arguments: &Arguments) -> Result<Scenario, Failure> {
    let site = super::site::or_street(arguments.site.as_deref())?;
    let shipped = Path::new(&arguments.scenario);
    let plan = PlanFile::open(arguments.plan.as_deref().unwrap_or(shipped), site);
    Scenario::of(plan.map_err(Failure::input)?).map_err(Failure::input)
}

/// How many columns the chart may have: those of the terminal, or what COLUMNS says. As many as it takes
/// where neither is known.
fn columns() -> usize {
    let said = std::env::var("COLUMNS").ok().and_then(|it| it.parse().ok());
    let found = || terminal_size::terminal_size().map(|(width, _)| width.0.into());
    said.or_else(found).unwrap_or(usize::MAX)
}

fn loss(text: &str) -> Result<f64, String> {
    in_range(
        text,
        0.0,
        0.9,
        "with more, robots cannot hear of each other in time",
    )
}

/// How many followers the team has.
fn followers(arguments: &Arguments, scenario: &Scenario) -> Result<u8, Failure> {
    let (usual, [least, most]) = scenario.followers();
    let followers = arguments.followers.unwrap_or(usual);
    if (least..=most).contains(&followers) {
        return Ok(followers);
    }
    let possible = if least == most {
        most.to_string()
    } else {
        format!("{least} to {most}")
    };
    let name = scenario.name();
    Err(Failure::Input(format!(
        "--followers {followers}: plan {name} has roles for {possible}"
    )))
}

/// The lines of the chart for what is seen, by the first of the robots where the pedestrian is seen.
fn lines(chart: &mut Chart, first: &str, seen: Seen<'_>) -> Vec<String> {
    match seen {
        Seen::Record(record) => chart.lines(record),
        Seen::PowerLoss { at_us, robot } => chart.note(at_us, robot, "! loses power"),
        Seen::Pedestrians {
            at_us,
            are_on_road,
            count,
        } => match (are_on_road, count) {
            (true, 1) => {
                let text = "~ the pedestrian sees go and steps on the road";
                chart.note_on_go(at_us, first, text)
            }
            (true, _) => {
                let text = "~ people on both sides see go and step on the road";
                chart.note_on_go(at_us, first, text)
            }
            (false, 1) => chart.note(at_us, first, "~ the pedestrian is across"),
            (false, _) => chart.note(at_us, first, "~ everybody is across"),
        },
    }
}

/// Whether these options can be had of this scenario.
fn check(arguments: &Arguments, scenario: &Scenario) -> Result<(), Failure> {
    #[cfg(not(feature = "full"))]
    if arguments.report.is_some()
        || arguments.pcap.is_some()
        || arguments.etsi.are_given()
        || scenario.car().is_some()
    {
        return Err(super::small::build_all());
    }
    let is_signed = arguments.security.mode() != Mode::Off;
    let why = match (scenario.car(), scenario.victim()) {
        (Some(car), _) if is_signed => format!("{} signs nothing: leave --security away", car.name),
        (_, Some(victim)) if arguments.trials > 1 => format!(
            "--trials {}: {victim} loses power in this scenario, so there is one crossing",
            arguments.trials
        ),
        _ => return Ok(()),
    };
    Err(Failure::Input(why))
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let scenario = scenario(arguments)?;
    check(arguments, &scenario)?;
    let followers = followers(arguments, &scenario)?;
    destinations::files([&arguments.report])?;
    let interrupted = interrupts();
    let participants = scenario.participants(followers);
    let names: Vec<_> = participants.iter().map(|one| &*one.name).collect();
    let options = Options {
        scenario,
        followers,
        trials: usize::from(arguments.trials),
        time_scale: arguments.speed,
        faults: Faults {
            loss: arguments.faults.loss.max(arguments.loss),
            ..arguments.faults.clone()
        },
        seed: arguments.seed,
        port: arguments.port,
        security_mode: arguments.security.mode(),
        security: arguments.security.of_robots(&names)?,
        #[cfg(feature = "full")]
        capture: super::create_capture(arguments.pcap.as_deref())?,
        perceived: super::open_feed(arguments.perceived.as_deref())?,
        awareness: arguments.etsi.add_to(Awareness::default()),
        stop: Arc::clone(&interrupted),
    };
    let mut log_file = arguments.log.as_deref().map(DemoLog::create).transpose()?;
    let is_told = !arguments.json && !arguments.quiet;
    let columns: Vec<_> = participants
        .iter()
        .map(|one| (&*one.name, one.station))
        .collect();
    let mut chart = Chart::new(&columns, Identifiers::default());
    if let Some(car) = options.scenario.car() {
        chart = chart.with_stranger(&car.name, StationId(car.station));
    }
    if arguments.wording.verbose {
        chart = chart.with_short_ids();
    }
    let chart = chart.within(self::columns());
    let shows_chart = is_told && names.len() <= CHARTED && chart.is_some();
    let mut chart = chart.unwrap_or_default();
    let stations = names.len() + usize::from(options.scenario.car().is_some());
    let links = Links::open(&options, stations).map_err(Failure::input)?;
    if is_told {
        let first = usize::from(links.first_port);
        let ports = first..=first + stations - 1;
        introduce(&options, ports, arguments.security.is_throw_away())?;
    }
    if shows_chart {
        print(chart.header())?;
    } else if is_told {
        print("The chart of this many robots is wider than the screen; --report FILE has it.")?;
    }
    // If nobody reads the chart any more, the crossing goes on, and the log is complete.
    let mut reads = true;
    let (outcome, log) = demo::run(&options, links, &mut |seen| {
        if let (Some(file), Seen::Record(record)) = (&mut log_file, seen) {
            file.write(record);
        }
        if shows_chart && reads {
            let rows = lines(&mut chart, names[0], seen);
            reads = rows.iter().all(|line| print(line).is_ok());
        }
    });
    if shows_chart && reads {
        // Where nobody reads any more, the log is complete.
        let _ = chart.rest().iter().try_for_each(print);
    }
    // Where one of these cannot be written, the others are.
    let told = if arguments.json {
        print_json(&outcome)
    } else {
        report(&outcome)
    };
    let told = told.and_then(|()| match (&arguments.report, &arguments.log) {
        (None, None) if !arguments.json => print(NEXT),
        _ => Ok(()),
    });
    #[cfg(feature = "full")]
    let told = told.and(super::finish_capture(
        arguments.pcap.as_deref(),
        options.capture,
    ));
    let written = match &arguments.report {
        Some(path) => write_page(path, options.scenario.street(), &log, arguments.json),
        None => Ok(()),
    };
    told.and(written)?;
    if log_file.is_some_and(|file| file.has_failed) || outcome.stopped && outcome.trace_valid {
        Err(Failure::Incomplete)
    } else if outcome.succeeded() {
        Ok(())
    } else {
        Err(Failure::Wrong)
    }
}

/// The log as it is written: at any time all that has happened is in it.
struct DemoLog {
    path: PathBuf,
    file: LogFile,
    has_failed: bool,
}

impl DemoLog {
    fn create(path: &Path) -> Result<Self, Failure> {
        destinations::file(path)?;
        let file = LogFile::create(path, LogLimits::default()).map_err(Failure::at(path))?;
        Ok(Self {
            path: path.to_owned(),
            file,
            has_failed: false,
        })
    }

    /// Writes a record; complains once when that cannot be done any more.
    fn write(&mut self, record: &Record) {
        if self.has_failed {
            return;
        }
        let written = self.file.write(record);
        if let Err(error) = written.and_then(|()| self.file.flush()) {
            self.has_failed = true;
            super::complain(format_args!(
                "{}: {error}; the demonstration goes on, and nothing more is written there",
                self.path.display()
            ));
        }
    }
}

fn introduce(
    options: &Options,
    ports: RangeInclusive<usize>,
    is_throw_away: bool,
) -> Result<(), Failure> {
    let security = match options.security_mode {
        Mode::Off => "are not signed",
        Mode::Sign => "are signed, and need not be",
        Mode::Enforce => "are signed and verified",
    };
    let pki = match (options.security_mode, is_throw_away) {
        (Mode::Off, _) => "",
        (_, true) => ", by certificates that are made for this run",
        (_, false) => ", by the certificates given",
    };
    // Both maneuvers of the crossing as they are planned, and half a second around them; or some of it,
    // and the time after which robots stop waiting for one that is silent.
    let seconds = match options.scenario.victim() {
        None => 26.0 / options.time_scale + 1.5,
        Some(_) => 4.0 / options.time_scale + 9.0,
    };
    let together = match options.trials {
        1 => String::new(),
        trials => {
            let all_s = seconds * f64::from(u32::try_from(trials).unwrap_or(u32::MAX));
            format!(", {all_s:.0} s for all {trials}")
        }
    };
    let (first, last) = (ports.start(), ports.end());
    let over = format!("UDP on 127.0.0.1, ports {first} to {last}");
    print(format_args!(
        "{} {}\nThe robots coordinate over {over}, and move {} times as fast as \
         real: about\n{seconds:.0} s per crossing{together}. Packets {security}{pki}.\n",
        options.scenario.who_waits(),
        options.scenario.summary(),
        options.time_scale,
    ))
}

fn report(outcome: &Outcome) -> Result<(), Failure> {
    print("")?;
    print(times(&outcome.maneuvers))?;
    print(format_args!("{LEGEND} Here they go over loopback.\n"))?;
    if outcome.stopped {
        print("Stopped before it was done; this is what there was until then.")?;
    }
    for team in &outcome.teams {
        print(format_args!("{team}."))?;
    }
    print(format_args!(
        "{} of {} crossings {}{}; in the end {}.",
        outcome.crossings,
        outcome.trials,
        match outcome.scenario.victim() {
            None => "completed",
            Some(_) => "ended in order after a robot lost power",
        },
        if outcome.retries > 0 {
            format!(", {} begun again", outcome.retries)
        } else {
            String::new()
        },
        outcome
            .final_states
            .iter()
            .map(|(robot, state)| format!("{robot} is {state}"))
            .collect::<Vec<_>>()
            .join(", "),
    ))?;
    for (robot, counters) in &outcome.counters {
        let causes: Vec<_> = counters
            .iter()
            .map(|(cause, n)| format!("{cause} {n}"))
            .collect();
        if !causes.is_empty() {
            print(format_args!(
                "Dropped or ignored at {robot}: {}.",
                causes.join(", ")
            ))?;
        }
    }
    match (&outcome.trace, &outcome.trace_error) {
        (Some(trace), _) => print(format_args!(
            "Log: {} steps of {} robots, replayed through the transition function: every step was one.",
            trace.steps, trace.robots
        )),
        (None, error) => print(format_args!(
            "Log: NOT what the transition function does: {}",
            error.as_deref().unwrap_or_default()
        )),
    }
}

/// Commands for a further look.
const NEXT: &str = "
Next: --report crossing.html makes a page of a run; --log crossing.jsonl keeps it, and
`crossguard studio crossing.jsonl` shows it step by step. --scenario has others: --help.";

/// Meaning of the columns of [`times`].
const LEGEND: &str = "\
T_neg: from the leader's first transmission of the command to its reception at the follower, one way; the paper's \
went\nover IEEE 802.11p. Round trip: from that transmission to the acknowledgement at the leader. T_exec: the motion, \
in the\nrobots' own time; of a block, how long it was held. It is an input here and no finding: the speed of simulated \
bodies\nand the time to cross are set beforehand. T_TMCT = T_neg + T_exec. Mean ± standard deviation.";

/// The times of maneuvers, each beside the paper's.
fn times(summaries: &[Summary]) -> Table {
    let mut table = Table::new();
    table.load_style(NOTHING).set_header([
        "maneuver",
        "completed",
        "T_neg [s]",
        "round trip [s]",
        "T_exec [s]",
        "T_TMCT [s]",
    ]);
    for summary in summaries {
        table.add_row([
            summary.task.clone(),
            summary.trials.to_string(),
            statistic(summary.t_neg_s, 4),
            statistic(summary.round_trip_s, 4),
            statistic(summary.t_exec_s, 2),
            statistic(summary.t_tmct_s, 3),
        ]);
        if let Some(paper) = &summary.paper {
            table.add_row([
                "  in the paper".to_owned(),
                paper.trials.to_string(),
                statistic(paper.t_neg_s, 3),
                String::new(),
                format!("{:.2}", paper.t_exec_s),
                statistic(paper.t_tmct_s, 3),
            ]);
        }
    }
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}

fn statistic(statistic: Statistic, digits: usize) -> String {
    format!("{:.digits$} ± {:.digits$}", statistic.mean, statistic.sd)
}
