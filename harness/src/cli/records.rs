//! What else a command writes of the log of its robots.

use std::io::Cursor;
use std::path::PathBuf;

use crossguard_robot::site_file::SiteFile;
use crossguard_robot::trace::{Log, Merged};

use super::report::ReportPage;
use super::{Failure, destinations, export, print};

/// What else is written of a log.
#[derive(clap::Args)]
pub(super) struct RecordArguments {
    /// Write an MCAP file, for Foxglove and tools of ROS 2.
    #[arg(long, value_name = "FILE")]
    mcap: Option<PathBuf>,
    /// Write a page about the run: states, map, times, verdicts, sequence chart.
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
}

impl RecordArguments {
    /// Whether what is wanted can be written.
    pub(super) fn check(&self) -> Result<(), Failure> {
        destinations::files([&self.mcap, &self.report])
    }

    /// Writes what is wanted of `log`, which tells of a run on `site`; says so unless the output is for a program.
    pub(super) fn write(
        &self,
        title: &str,
        site: &SiteFile,
        log: &[u8],
        is_json: bool,
    ) -> Result<(), Failure> {
        let logs = || {
            vec![Log {
                name: "the log of this run".to_owned(),
                lines: Box::new(Cursor::new(log.to_vec())),
            }]
        };
        let mut written = Vec::new();
        if let Some(path) = &self.mcap {
            let logs = Merged::new(logs()).map_err(Failure::input)?;
            written.push(export::write_mcap(logs, path)?);
        }
        if let Some(path) = &self.report {
            let page = ReportPage {
                title,
                logs: &["the log of this run".to_owned()],
                time_scale: None,
                site: Some(site),
            };
            // What it says of the log is what the command says of it, too.
            let _ = page.write(path, logs(), logs())?;
            written.push(format!("{}: report", path.display()));
        }
        if !is_json {
            written.iter().try_for_each(print)?;
        }
        Ok(())
    }
}
