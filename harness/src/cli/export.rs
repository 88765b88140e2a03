//! `crossguard export`.

use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};

use clap::ArgGroup;
use crossguard_judge::mcap_file;
use crossguard_judge::sequence::Sequence;
use crossguard_robot::trace::{Merged, Timed};

use super::{Failure, cause, destinations, open_logs, print};

#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
#[command(group(ArgGroup::new("to").required(true).multiple(true).args(["mcap", "svg", "mermaid"])))]
pub(super) struct Arguments {
    /// The logs: of one robot or of several, from one machine or from several.
    #[arg(required = true, value_name = "LOG")]
    logs: Vec<PathBuf>,
    /// Write an MCAP file, for Foxglove and tools of ROS 2.
    #[arg(long, value_name = "FILE")]
    mcap: Option<PathBuf>,
    /// Write the sequence chart as a picture.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Write the sequence chart as a Mermaid diagram.
    #[arg(long, value_name = "FILE")]
    mermaid: Option<PathBuf>,
}

const AFTER_HELP: &str = "\
Logs are what --log of run, demo and fuzz writes. Those of several robots become one recording, in the \
order of the clocks of their machines. Nothing is judged here: that is what validate is for. In the \
MCAP file all messages are JSON with their schemas; each robot's topics are /NAME/state, /NAME/message, \
/NAME/step, /NAME/counters, /NAME/location, /NAME/corridor, /NAME/places, /NAME/people, /NAME/around and /NAME/crossing, and /robots, /tf and /log \
are those of all.";

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    destinations::files([&arguments.mcap, &arguments.svg, &arguments.mermaid])?;
    if let Some(path) = &arguments.mcap {
        print(write_mcap(merged(&arguments.logs)?, path)?)?;
    }
    if arguments.svg.is_none() && arguments.mermaid.is_none() {
        return Ok(());
    }
    let mut sequence = Sequence::growing();
    let mut steps = Vec::new();
    let mut logs = merged(&arguments.logs)?;
    while let Some(Timed { record, .. }) = logs.take().map_err(Failure::input)? {
        steps.extend(sequence.gathered(&record));
    }
    steps.extend(sequence.rest());
    sequence.end(&mut steps);
    sequence.draw("Crossguard", &steps, |chart| {
        let pictures = [
            (&arguments.svg, chart.svg()),
            (&arguments.mermaid, chart.mermaid()),
        ];
        for (path, picture) in pictures {
            if let Some(path) = path {
                std::fs::write(path, picture).map_err(|error| cannot(path, &error))?;
                print(format_args!("{}: {} steps", path.display(), steps.len()))?;
            }
        }
        Ok(())
    })
}

fn merged(logs: &[PathBuf]) -> Result<Merged<'static>, Failure> {
    Merged::new(open_logs(logs)?).map_err(Failure::input)
}

/// Writes logs as an MCAP file, and says how much there is in it.
pub(super) fn write_mcap(logs: Merged, path: &Path) -> Result<String, Failure> {
    let file = File::create(path).map_err(|error| cannot(path, &error))?;
    let written = mcap_file::write(logs, BufWriter::new(file)).map_err(|error| match error {
        mcap_file::ExportError::Log(error) => Failure::input(error),
        mcap_file::ExportError::Mcap(error) => cannot(path, &cause(&error)),
    })?;
    Ok(format!(
        "{}: {} messages on {} topics",
        path.display(),
        written.values().sum::<u64>(),
        written.len()
    ))
}

fn cannot(path: &Path, error: &dyn std::fmt::Display) -> Failure {
    Failure::Input(format!("{}: {error}", path.display()))
}
