//! The command line: subcommands, and how they end.
//!
//! Exit codes: 0 all is well, 1 something was found to be wrong, 2 bad usage or input, 3 incomplete, also
//! when it was told to stop before it was done. Told to stop a second time, it ends at once with 130.

#![cfg_attr(
    not(feature = "full"),
    allow(dead_code, reason = "commands of a full build share it")
)]

mod bounds;
mod check;
mod choices;
#[cfg(feature = "full")]
mod codec;
#[cfg(feature = "full")]
mod conform;
#[cfg(feature = "full")]
mod csv;
mod demo;
mod destinations;
mod etsi;
#[cfg(feature = "full")]
mod export;
mod fsm;
#[cfg(feature = "full")]
mod full;
#[cfg(feature = "full")]
mod fuzz;
mod interrupts;
#[cfg(feature = "full")]
mod listening;
#[cfg(feature = "full")]
mod new;
#[cfg(feature = "full")]
mod odds;
#[cfg(feature = "full")]
mod pki;
mod printable;
mod ranges;
#[cfg(feature = "full")]
mod report;
#[cfg(feature = "full")]
mod run;
mod security;
#[cfg(feature = "full")]
mod simulate;
mod site;
#[cfg(not(feature = "full"))]
mod small;
#[cfg(feature = "full")]
mod sniff;
#[cfg(feature = "full")]
mod studio;
#[cfg(feature = "full")]
mod validate;
#[cfg(feature = "full")]
mod watch;
mod writing;

#[cfg(not(feature = "full"))]
use std::ffi::OsString;
use std::io::{ErrorKind, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use crossguard_protocol::Config;
#[cfg(feature = "full")]
use crossguard_robot::capture::Capture;
use crossguard_robot::perception::Feed;
#[cfg(feature = "full")]
use crossguard_robot::robot_file::RobotFile;
use crossguard_robot::trace::Log;
use indicatif::{ProgressBar, ProgressStyle};
use printable::{Printable, printable_json};
#[cfg(not(feature = "full"))]
use small::read_config;
use writing::{Complaints, complain};

/// A formally verified coordination kit for robots that work as crossing guards in V2X traffic.
#[derive(Parser)]
#[command(
    name = "crossguard",
    version,
    max_term_width = 100,
    after_help = AFTER_HELP
)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[cfg(feature = "full")]
const AFTER_HELP: &str = "\
Exit codes: 0 all is well, 1 something was found to be wrong, 2 bad usage or input, 3 incomplete. Ctrl-C and SIGTERM end \
a command in order, with what it has: 3 if that is less than was asked for; a second Ctrl-C ends it at once, with 130.";
#[cfg(not(feature = "full"))]
const AFTER_HELP: &str = "\
This is a small build. All commands, among them run, validate, report, studio, fuzz and simulate: \
cargo run --release --features full -- --help";

#[derive(Subcommand)]
enum Command {
    /// Watch robots help a pedestrian across, over real sockets.
    Demo(Box<demo::Arguments>),
    /// Check scenarios exhaustively against the properties of the protocol.
    Check(check::Arguments),
    /// Print how long each response takes at most, with a robot's own settings.
    Bounds(bounds::Arguments),
    /// Print the state diagram of the protocol in Mermaid, drawn from what the transition function does.
    Fsm(fsm::Arguments),
    /// Check the site of a crossing, and a plan on it.
    #[command(subcommand)]
    Site(site::Command),
    #[cfg(feature = "full")]
    #[command(flatten)]
    Other(full::Command),
    #[cfg(not(feature = "full"))]
    #[command(external_subcommand)]
    Other(Vec<OsString>),
}

/// In which words people are told.
#[derive(clap::Args)]
struct Wording {
    /// Name stations, sessions and commands as logs do: in 1#37.0/2, 2 is the command's requestID, 1 the station id of the
    /// leader, and 37.0 its first session (0) since its 37th boot.
    #[arg(short, long)]
    verbose: bool,
}

/// How a subcommand ends, when not well.
#[derive(Debug)]
enum Failure {
    /// Something was found to be wrong; it has been printed.
    Wrong,
    /// The usage or an input is bad.
    Input(String),
    /// It was cut off before it could tell; what is known has been printed.
    Incomplete,
    /// The reader of the output is gone.
    NobodyReads,
}

impl Failure {
    /// The usage or an input is bad.
    fn input(error: impl std::fmt::Display) -> Self {
        Self::Input(error.to_string())
    }

    /// Makes an error the fault of this file or folder.
    fn at<E: std::fmt::Display>(path: &Path) -> impl Fn(E) -> Self {
        move |error| Self::Input(format!("{}: {error}", path.display()))
    }
}

impl From<std::io::Error> for Failure {
    /// Standard output cannot be written to.
    fn from(error: std::io::Error) -> Self {
        match error.kind() {
            ErrorKind::BrokenPipe => Self::NobodyReads,
            _ => Self::input(format!("standard output: {error}")),
        }
    }
}

/// The commands and options that there are.
#[must_use]
pub fn command() -> clap::Command {
    ranges::with_negative_numbers(Arguments::command())
}

/// Does what the arguments of this process say. `version` is what `--version` prints.
#[must_use]
pub fn main(version: &'static str) -> ExitCode {
    let command = command().version(version);
    let arguments = Arguments::from_arg_matches(&command.get_matches());
    let arguments = arguments.unwrap_or_else(|error| error.exit());
    let _complaints = Complaints::begin();
    let done = match arguments.command {
        Command::Demo(arguments) => demo::run(&arguments),
        Command::Check(arguments) => check::run(&arguments),
        Command::Bounds(arguments) => bounds::run(&arguments),
        Command::Fsm(arguments) => fsm::run(&arguments),
        Command::Site(command) => site::run(&command),
        #[cfg(feature = "full")]
        Command::Other(command) => full::carry_out(command),
        #[cfg(not(feature = "full"))]
        Command::Other(_) => Err(small::build_all()),
    };
    match done {
        Ok(()) | Err(Failure::NobodyReads) => ExitCode::SUCCESS,
        Err(Failure::Wrong) => ExitCode::from(1),
        Err(Failure::Input(message)) => {
            complain(message);
            ExitCode::from(2)
        }
        Err(Failure::Incomplete) => ExitCode::from(3),
    }
}

/// Prints a line to standard output.
fn print(line: impl std::fmt::Display) -> Result<(), Failure> {
    Ok(writeln!(std::io::stdout(), "{}", Printable(line))?)
}

fn print_json(value: &impl serde::Serialize) -> Result<(), Failure> {
    match serde_json::to_string_pretty(value) {
        Ok(json) => Ok(writeln!(std::io::stdout(), "{}", printable_json(&json))?),
        Err(error) => Err(std::io::Error::from(error).into()),
    }
}

fn open_logs(paths: &[PathBuf]) -> Result<Vec<Log<'static>>, Failure> {
    let open = |path: &PathBuf| crossguard_robot::trace::open(path).map_err(Failure::at(path));
    paths.iter().map(open).collect()
}

/// Creates a file for packets, if there is to be one.
#[cfg(feature = "full")]
fn create_capture(path: Option<&Path>) -> Result<Option<Capture>, Failure> {
    let Some(path) = path else { return Ok(None) };
    destinations::file(path)?;
    let created = Capture::create(path).map_err(|error| cause(&error));
    created.map(Some).map_err(Failure::at(path))
}

/// Text of the operating system, where an error has that as its source, and does not say it itself.
fn cause(error: &dyn std::error::Error) -> String {
    let source = error.source().map(ToString::to_string);
    source.unwrap_or_else(|| error.to_string())
}

/// Looks whether every packet was written to this file, and tells why not.
#[cfg(feature = "full")]
fn finish_capture(path: Option<&Path>, capture: Option<Capture>) -> Result<(), Failure> {
    if let (Some(path), Some(Err(error))) = (path, capture.map(Capture::finish)) {
        let (path, why) = (path.display(), cause(&error));
        complain(format_args!("{path}: not all packets were written: {why}"));
        return Err(Failure::Incomplete);
    }
    Ok(())
}

/// The protocol's configuration in a robot's file; the default one without a file.
fn config_or_default(file: Option<&Path>) -> Result<Config, Failure> {
    file.map_or_else(|| Ok(Config::default()), read_config)
}

#[cfg(feature = "full")]
fn read_config(file: &Path) -> Result<Config, Failure> {
    let file = RobotFile::read(file).map_err(Failure::input)?;
    Ok(file.config)
}

/// Opens a file of people that sensors report.
fn open_feed(path: Option<&Path>) -> Result<Option<Feed>, Failure> {
    path.map(Feed::open).transpose().map_err(Failure::Input)
}

/// A bar that shows how far a command is: only to people, and never among the output.
fn progress(is_json: bool, template: &str) -> ProgressBar {
    if is_json || !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template(template).expect("the template is well-formed");
    ProgressBar::no_length().with_style(style)
}
