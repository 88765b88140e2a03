//! `crossguard conform`.

use std::net::SocketAddr;
use std::path::PathBuf;
use std::time::Duration;

use crossguard_codec::geonet::Envelope;
use crossguard_conform::Terms;
use crossguard_conform::campaign::{Campaign, Report, Verdict};
use crossguard_conform::case::{Case, Table};
use crossguard_conform::live::{Events, Live};
use crossguard_conform::rules::{RULES, Rule};
use crossguard_conform::statements::Statement;
use crossguard_conform::subject::{Gone, Subject as _};
use crossguard_protocol::StationId;
use crossguard_robot::robot_file::RobotFile;
use crossguard_robot::transport::{Link, Transport as _};

use super::interrupts::interrupts;
use super::ranges::{address, station, whole};
use super::{Failure, print, print_json, progress};

/// The names under which the tester's stations find their tickets.
const NAMES: [&str; 2] = ["Ada", "Bo"];

#[derive(clap::Args)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "each is a flag of the command"
)]
#[command(after_help = AFTER_HELP)]
pub(super) struct Arguments {
    /// The robot's configuration, if it is one of 'crossguard run': its station id, addresses, timers and identifiers.
    #[arg(long, value_name = "FILE")]
    config: Option<PathBuf>,
    /// The address at which the tester listens: the peer of the robot. That of the configuration by default.
    #[arg(long, value_name = "ADDRESS:PORT", value_parser = address::<SocketAddr>)]
    address: Option<SocketAddr>,
    /// The address of the robot.
    #[arg(long, value_name = "ADDRESS:PORT", value_parser = address::<SocketAddr>)]
    peer: Option<SocketAddr>,
    /// The station id of the robot.
    #[arg(long, value_name = "ID", value_parser = station)]
    station: Option<StationId>,
    /// The first of the two station ids by which the tester goes.
    #[arg(long, value_name = "ID", default_value_t = 9001, value_parser = whole::<u32>(1..=4_000_000_000))]
    tester: u32,
    /// The command that starts the robot; it is started anew for every case.
    #[arg(long, value_name = "COMMAND")]
    start: Option<String>,
    /// Tell the robot what happens at it by lines on its standard input, as 'crossguard run' takes them.
    #[arg(long, requires = "start", group = "events")]
    typed: bool,
    /// Tell it by this command, to which the words of the line are added; it ends with 0 when that was done.
    #[arg(long, value_name = "COMMAND", group = "events")]
    hook: Option<String>,
    /// Ask the person at the robot.
    #[arg(long, group = "events")]
    ask: bool,
    /// The robot detects and commands by itself: wait for it.
    #[arg(long, group = "events")]
    unattended: bool,
    /// Judge these rules alone, as R8; may be given several times.
    #[arg(long, value_name = "RULE", value_parser = rule)]
    rule: Vec<&'static Rule>,
    /// How many ms later than by its timers the robot may do something.
    #[arg(long, value_name = "MS", default_value_t = 500, value_parser = whole::<u64>(50..=10_000))]
    slack: u64,
    /// List the rules, their statements and the cases, and play nothing.
    #[arg(long)]
    list: bool,
    #[command(flatten)]
    security: super::security::SecurityArguments,
    /// Print the results as JSON, and nothing else.
    #[arg(long)]
    json: bool,
}

const AFTER_HELP: &str =
    "The tester plays two stations, Ada and Bo, against the robot, and judges what it hears. Try:

  crossguard conform --config go2.toml --start 'crossguard run --config go2.toml' --typed

Exit codes: 0 every rule that can be judged was kept, 1 a rule was broken, 3 a rule was never met.";

fn rule(text: &str) -> Result<&'static Rule, String> {
    Rule::of_id(text).ok_or_else(|| format!("a rule from R1 to R{} is wanted", RULES.len()))
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let rules: Vec<&'static Rule> = if arguments.rule.is_empty() {
        RULES.iter().collect()
    } else {
        arguments.rule.clone()
    };
    let campaign = Campaign::new(&rules);
    if arguments.list {
        return list(&rules, &campaign.cases());
    }
    let (link, mut table) = reach(arguments)?;
    let stop = interrupts();
    let halves = link.open().map_err(Failure::input)?;
    let mut robot = Live::new(halves, arguments.start.clone(), events(arguments), stop);
    let (report, cut_off) = play_all(arguments, campaign, &mut robot, &mut table)?;
    robot.end();
    if arguments.json {
        print_json(&report)?;
    } else {
        show(&report)?;
        if cut_off {
            print("The tester was stopped before all cases were played.")?;
        }
    }
    if report.has_failed() {
        Err(Failure::Wrong)
    } else if cut_off || report.is_incomplete() {
        Err(Failure::Incomplete)
    } else {
        Ok(())
    }
}

fn events(arguments: &Arguments) -> Events {
    match &arguments.hook {
        Some(command) => Events::Hook(command.clone()),
        None if arguments.typed => Events::Typed,
        None if arguments.ask => Events::Ask,
        None if arguments.unattended => Events::Unattended,
        None => Events::Nobody,
    }
}

/// The link to the robot, and the tester's side.
fn reach(arguments: &Arguments) -> Result<(Link, Table), Failure> {
    let file = arguments.config.as_deref().map(RobotFile::read).transpose();
    let file = file.map_err(Failure::input)?;
    let file = file.as_ref();
    let missing =
        |what: &str| Failure::input(format!("{what} is wanted, or a --config that says it"));
    // The tester is the robot's peer.
    let turned = match file.map(|file| &file.link) {
        Some(Link::Peers { address, peers, .. }) => (peers.first().copied(), Some(*address)),
        _ => (None, None),
    };
    let framing = file.map(|file| file.link.framing()).unwrap_or_default();
    let address = arguments.address.or(turned.0);
    let address = address.ok_or_else(|| missing("--address"))?;
    let peer = arguments.peer.or(turned.1);
    let peer = peer.ok_or_else(|| missing("--peer"))?;
    let station = arguments.station.or(file.map(|file| file.station));
    let robot = station.ok_or_else(|| missing("--station"))?;
    let identifiers = file.map(|file| file.identifiers).unwrap_or_default();
    let securities = arguments.security.of_robots(&NAMES)?;
    let ids = [StationId(arguments.tester), StationId(arguments.tester + 1)];
    let players = [0, 1].map(|i| match securities.get(i) {
        Some(security) => security.station_id(&identifiers, ids[i]),
        None => ids[i],
    });
    if players.contains(&robot) {
        return Err(Failure::input(format!(
            "--tester: station {robot} is the robot; choose other ids for the tester"
        )));
    }
    let mut envelopes = securities.into_iter().map(|security| security.envelope);
    let envelopes = [(); 2].map(|()| envelopes.next().unwrap_or(Envelope::Off));
    let settings = file.map(|file| file.config.settings().clone());
    let settings = settings.unwrap_or_default();
    let link = Link::Peers {
        address,
        peers: vec![peer],
        framing,
    };
    let table = Table {
        robot,
        terms: Terms {
            settings,
            slack_ms: arguments.slack,
            identifiers,
            players,
            ..Terms::default()
        },
        envelopes,
        boot: boot(),
    };
    Ok((link, table))
}

/// A boot counter larger than that of any run before, but for a run in the same minute.
fn boot() -> u16 {
    let since = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH);
    let minutes = since.unwrap_or(Duration::ZERO).as_secs() / 60;
    u16::try_from(minutes % 32_768).unwrap_or_default()
}

fn play_all(
    arguments: &Arguments,
    mut campaign: Campaign,
    robot: &mut Live,
    table: &mut Table,
) -> Result<(Report, bool), Failure> {
    let cases = campaign.cases();
    let bar = progress(arguments.json, "{bar:30} {pos}/{len} {msg}");
    bar.set_length(cases.len() as u64);
    let mut cut_off = false;
    for case in &cases {
        bar.inc(1);
        bar.set_message(case.words());
        if robot.is_started_here() {
            robot.restart().map_err(Failure::input)?;
        }
        match campaign.play(robot, table, case) {
            Ok(()) => {}
            Err(Gone::Stopped) => {
                cut_off = true;
                break;
            }
            Err(error) => return Err(Failure::input(error)),
        }
    }
    bar.finish_and_clear();
    Ok((campaign.report(table.robot), cut_off))
}

const fn word(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Pass => "pass",
        Verdict::Fail => "FAIL",
        Verdict::NotObserved => "not observed",
        Verdict::Beyond => "cannot be judged",
    }
}

fn show(report: &Report) -> Result<(), Failure> {
    for rule in &report.rules {
        let (id, verdict, says, kept) = (rule.rule, word(rule.verdict), rule.says, rule.kept);
        print(format_args!(
            "{id:<4} {verdict:<16} {says} ({kept} times kept)"
        ))?;
        if let Some(why) = rule.unjudged {
            print(format_args!("       not judged: {why}"))?;
        }
        for name in &rule.not_observed {
            print(format_args!("       never met: {name}"))?;
        }
        for broken in &rule.broken {
            let (name, says, how) = (broken.statement, broken.says, &broken.how);
            print(format_args!("     {name}: {says}"))?;
            print(format_args!("       {}: {how}", broken.situation))?;
            for line in broken.chart.lines() {
                print(format_args!("       {line}"))?;
            }
        }
    }
    for why in &report.stopped {
        print(format_args!("A case was not played to its end: {why}."))?;
    }
    let (played, cases) = (report.played, report.cases);
    print(format_args!(
        "{played} of {cases} cases were played to their end."
    ))
}

fn list(rules: &[&'static Rule], cases: &[Case]) -> Result<(), Failure> {
    let statements = Statement::all();
    for rule in rules {
        print(format_args!("{}: {}", rule.id, rule.says))?;
        for statement in statements.iter().filter(|it| it.rule == rule.id) {
            print(format_args!("  {}: {}", statement.name, statement.says))?;
        }
        if let Some(why) = rule.unjudged {
            print(format_args!("  not judged: {why}"))?;
        }
    }
    for (i, case) in cases.iter().enumerate() {
        print(format_args!("case {}: {}", i + 1, case.words()))?;
    }
    Ok(())
}
