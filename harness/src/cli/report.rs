//! `crossguard report`, and what it shares with `crossguard studio`.

use std::path::{Path, PathBuf};

use crossguard_judge::playback::{Playback, written_us};
use crossguard_judge::validate::{self, Invalid, Validated};
use crossguard_robot::site_file::SiteFile;
use crossguard_robot::trace::{Log, Merged};

use super::validate::verdict;
use super::{Failure, open_logs, print};
use crate::studio::{Studied, saved};

#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
pub(super) struct Arguments {
    /// The logs: of one robot or of several, from one machine or from several.
    #[arg(required = true, value_name = "LOG")]
    logs: Vec<PathBuf>,
    /// The page to write.
    #[arg(short, long, value_name = "FILE", default_value = "report.html")]
    output: PathBuf,
    /// The site, for kerbs and lanes on the map: a file, or `street` for the street of the demonstrations.
    #[arg(long, value_name = "FILE|street")]
    site: Option<PathBuf>,
}

const AFTER_HELP: &str = "\
Writes the page After of the studio as one file, with the run in it; it opens from disk without a network. \
It is written for logs that are not valid, too; then the exit code is 1, and 3 if records are missing.";

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    super::destinations::file(&arguments.output)?;
    let names = names(&arguments.logs);
    let site = super::site::named(arguments.site.as_deref())?;
    let studied = study(|| open_logs(&arguments.logs), names, site)?;
    write(&arguments.output, &studied)?;
    let text = match &studied.validated {
        Ok(valid) if valid.missing > 0 => "valid, and not all of it is there".to_owned(),
        Ok(_) => "valid".to_owned(),
        Err(invalid) => format!("not valid: {invalid}"),
    };
    print(format_args!("{}: {text}", arguments.output.display()))?;
    verdict(&studied.validated)
}

/// How logs are called.
pub(super) fn names(logs: &[PathBuf]) -> Vec<String> {
    logs.iter().map(|path| path.display().to_string()).collect()
}

/// Reads logs with these names and judges them, both at once. They are opened several times.
pub(super) fn study<'a>(
    open: impl Fn() -> Result<Vec<Log<'a>>, Failure> + Sync,
    names: Vec<String>,
    street: Option<SiteFile>,
) -> Result<Studied, Failure> {
    let logs = Merged::new(open()?).map_err(Failure::input)?;
    let judge = || open().map(validate::all);
    let (playback, validated) = std::thread::scope(|scope| {
        let judged = scope.spawn(judge);
        (Playback::of(logs, street), judged.join())
    });
    let validated =
        validated.unwrap_or_else(|_| Err(Failure::input("the logs cannot be judged")))?;
    let invalid_us = when(open, &names, &validated);
    Ok(Studied {
        playback,
        logs: names,
        validated,
        invalid_us,
        findings: Vec::new(),
    })
}

/// Reads and judges logs, each a name and its octets.
pub(super) fn study_octets(
    logs: &[(String, &[u8])],
    street: Option<SiteFile>,
) -> Result<Studied, Failure> {
    let log = |(name, octets): &(String, _)| Log::new(name, *octets);
    let names = logs.iter().map(|(name, _)| name.clone()).collect();
    study(|| Ok(logs.iter().map(log).collect()), names, street)
}

/// When the record that does not fit was written.
fn when<'a>(
    open: impl Fn() -> Result<Vec<Log<'a>>, Failure>,
    names: &[String],
    validated: &Result<Validated, Invalid>,
) -> Option<u64> {
    let invalid = validated.as_ref().err()?;
    let place = names.iter().position(|name| *name == invalid.log)?;
    written_us(open().ok()?.swap_remove(place), invalid.line)
}

/// Writes the page of a run.
pub(super) fn write(path: &Path, studied: &Studied) -> Result<(), Failure> {
    std::fs::write(path, saved(studied)).map_err(Failure::at(path))
}

/// Writes the page of a run on a street; says so unless the output is for a program.
pub(super) fn write_page(
    path: &Path,
    street: &SiteFile,
    log: &[u8],
    is_json: bool,
) -> Result<(), Failure> {
    let name = "the log of this run".to_owned();
    // The page says the same of the log as the command does.
    let studied = study_octets(&[(name, log)], Some(street.clone()))?;
    write(path, &studied)?;
    if is_json {
        return Ok(());
    }
    print(format_args!("{}: report", path.display()))
}
