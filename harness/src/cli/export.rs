//! `crossguard export`.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use clap::ArgGroup;
use crossguard_judge::facts::{Fact, Observer};
use crossguard_judge::sequence::Sequence;
use crossguard_robot::trace::{Merged, Timed};
use serde::Serialize;

use super::{Failure, destinations, open_logs, print};

#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
#[command(group(ArgGroup::new("to").required(true).multiple(true).args(["facts", "mermaid"])))]
pub(super) struct Arguments {
    /// The logs: of one robot or of several, from one machine or from several.
    #[arg(required = true, value_name = "LOG")]
    logs: Vec<PathBuf>,
    /// Write what the logs tell as JSON lines: states, places, messages, people, drops.
    #[arg(long, value_name = "FILE")]
    facts: Option<PathBuf>,
    /// Write the sequence chart as a Mermaid diagram.
    #[arg(long, value_name = "FILE")]
    mermaid: Option<PathBuf>,
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
    destinations::files([&arguments.facts, &arguments.mermaid])?;
    if let Some(path) = &arguments.facts {
        write_facts(merged(&arguments.logs)?, path)?;
    }
    let Some(path) = &arguments.mermaid else {
        return Ok(());
    };
    let mut sequence = Sequence::growing();
    let mut steps = Vec::new();
    let mut logs = merged(&arguments.logs)?;
    while let Some(Timed { record, .. }) = logs.take().map_err(Failure::input)? {
        steps.extend(sequence.gathered(&record));
    }
    steps.extend(sequence.rest());
    sequence.end(&mut steps);
    sequence.draw("Crossguard", &steps, |chart| {
        std::fs::write(path, chart.mermaid()).map_err(Failure::at(path))?;
        print(format_args!("{}: {} steps", path.display(), steps.len()))
    })
}

fn merged(logs: &[PathBuf]) -> Result<Merged<'static>, Failure> {
    Merged::new(open_logs(logs)?).map_err(Failure::input)
}

/// Writes a line for each fact, and says how many there are.
fn write_facts(mut logs: Merged, path: &Path) -> Result<(), Failure> {
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
