//! `crossguard export`.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::PathBuf;

use crossguard_judge::facts::{Fact, Observer};
use crossguard_robot::trace::{Merged, Timed};
use serde::Serialize;

use super::{Failure, destinations, open_logs, print};

#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
pub(super) struct Arguments {
    /// The logs: of one robot or of several, from one machine or from several.
    #[arg(required = true, value_name = "LOG")]
    logs: Vec<PathBuf>,
    /// Write a JSON line for each fact that the logs tell: states, places, messages, people, drops.
    #[arg(long, value_name = "FILE")]
    facts: PathBuf,
}

const AFTER_HELP: &str = "\
Logs are what --log of run, demo and fuzz writes. Those of several robots become one recording, in the \
order of the clocks of their machines. Nothing is judged here: that is what validate is for. \
harness/judge/foxglove.py makes an MCAP file for Foxglove of the facts.";

/// A fact of a robot, as a line of a file.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct FactLine<'a> {
    /// Since 1970.
    at_us: u64,
    robot: &'a str,
    #[serde(flatten)]
    fact: Fact,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let path = &arguments.facts;
    destinations::file(path)?;
    let mut logs = Merged::new(open_logs(&arguments.logs)?).map_err(Failure::input)?;
    let file = File::create(path).map_err(Failure::at(path))?;
    let (mut file, mut observer, mut count) = (BufWriter::new(file), Observer::default(), 0_u64);
    while let Some(Timed { at_us, record, .. }) = logs.take().map_err(Failure::input)? {
        for fact in observer.take(&record) {
            let robot = &*record.robot;
            let line = serde_json::to_string(&FactLine { at_us, robot, fact });
            let line = line.map_err(Failure::input)?;
            writeln!(file, "{line}").map_err(Failure::at(path))?;
            count += 1;
        }
    }
    file.flush().map_err(Failure::at(path))?;
    print(format_args!("{}: {count} facts", path.display()))
}
