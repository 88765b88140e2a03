//! `crossguard report`.

use std::path::{Path, PathBuf};

use crossguard_judge::report::Report;
use crossguard_judge::validate::{self, Invalid, Validated};
use crossguard_robot::site_file::SiteFile;
use crossguard_robot::trace::{Log, Merged};

use super::validate::verdict;
use super::{Failure, open_logs, print};

#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
pub(super) struct Arguments {
    /// The logs: of one robot or of several, from one machine or from several.
    #[arg(required = true, value_name = "LOG")]
    logs: Vec<PathBuf>,
    /// The page to write.
    #[arg(short, long, value_name = "FILE", default_value = "report.html")]
    output: PathBuf,
    /// What stands at the top of the page.
    #[arg(long, value_name = "TEXT", default_value = "Crossguard run")]
    title: String,
    /// The site, for kerbs and lanes on the map: a file, or `street` for the street of the demonstrations.
    #[arg(long, value_name = "FILE|street")]
    site: Option<PathBuf>,
    /// How many times as fast as real the robots' bodies moved, for the table of times, where their logs do
    /// not say it, or wrongly.
    #[arg(long, value_name = "N", value_parser = super::ranges::speed)]
    speed: Option<f64>,
}

const AFTER_HELP: &str = "\
Writes one static page that opens from disk without a network: states over time, a map, times, counters, \
what validation says, and the sequence chart. It is written for logs that are not valid, too; then the \
exit code is 1, and 3 if records are missing.";

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    super::destinations::file(&arguments.output)?;
    let open = || open_logs(&arguments.logs);
    let names: Vec<_> = arguments
        .logs
        .iter()
        .map(|path| path.display().to_string())
        .collect();
    let site = super::site::named(arguments.site.as_deref())?;
    let page = ReportPage {
        title: &arguments.title,
        logs: &names,
        time_scale: arguments.speed,
        site: site.as_ref(),
    };
    let result = page.write(&arguments.output, open()?, open()?)?;
    let text = match &result {
        Ok(valid) if valid.missing > 0 => "valid, and not all of it is there".to_owned(),
        Ok(_) => "valid".to_owned(),
        Err(invalid) => format!("not valid: {invalid}"),
    };
    print(format_args!("{}: {text}", arguments.output.display()))?;
    verdict(&result)
}

/// A page to be written.
pub(super) struct ReportPage<'a> {
    /// What stands at the top.
    pub(super) title: &'a str,
    /// The names of the logs.
    pub(super) logs: &'a [String],
    /// How many times as fast as real the robots' bodies moved, where the logs do not say it.
    pub(super) time_scale: Option<f64>,
    /// The site, for kerbs and lanes on the map.
    pub(super) site: Option<&'a SiteFile>,
}

impl ReportPage<'_> {
    /// Validates logs and writes their page; they are read twice. What validation says.
    pub(super) fn write(
        &self,
        path: &Path,
        logs: Vec<Log>,
        again: Vec<Log>,
    ) -> Result<Result<Validated, Invalid>, Failure> {
        let result = validate::all(logs);
        let report = Report {
            title: self.title,
            logs: self.logs,
            verdict: result.as_ref(),
            finding: None,
            time_scale: self.time_scale,
            site: self.site,
            reproduce: None,
        };
        let page = Merged::new(again).and_then(|logs| report.page(logs));
        let page = page.map_err(Failure::input)?;
        std::fs::write(path, page)
            .map_err(|error| Failure::Input(format!("{}: {error}", path.display())))?;
        Ok(result)
    }
}
