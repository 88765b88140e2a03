//! What is written of a run that went wrong: its log, and the sequence of messages up to there.

use std::collections::VecDeque;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use super::fuzz::{Failure, Fuzz};
use super::world::run;
use crate::sequence::Sequence;
use crate::trace::{self, Record};

/// How many steps of the sequence chart are kept: the last ones before what went wrong.
const CHART_STEPS: usize = 250;

/// What was written.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Files {
    /// The log, one JSON object per line.
    pub log: PathBuf,
    /// The sequence chart as text.
    pub text: PathBuf,
    /// The sequence chart as a picture.
    pub svg: PathBuf,
}

/// Runs a failed seed once more and writes what it did into `folder`.
///
/// # Errors
/// Those of the files.
pub fn write_failure(folder: &Path, fuzz: &Fuzz, failure: &Failure) -> std::io::Result<Files> {
    std::fs::create_dir_all(folder)?;
    let path = |kind: &str| folder.join(format!("seed-{}.{kind}", failure.seed));
    let files = Files {
        log: path("jsonl"),
        text: path("txt"),
        svg: path("svg"),
    };
    let swarm = fuzz.swarm(failure.seed);
    let robots: Vec<_> = swarm
        .robots
        .iter()
        .map(|r| (r.name.as_str(), r.station))
        .collect();
    let mut sequence = Sequence::new(&robots);
    let mut steps = VecDeque::new();
    let mut log = BufWriter::new(File::create(&files.log)?);
    let mut written = Ok(());
    let mut watch = |record: Record| {
        if written.is_ok() {
            written = trace::write(&mut log, &record);
        }
        steps.extend(sequence.steps(&record));
        let surplus = steps.len().saturating_sub(CHART_STEPS);
        steps.drain(..surplus);
    };
    let _ = run(&swarm, Some(&mut watch));
    written?;
    log.flush()?;
    let finding = &failure.finding;
    let title = format!(
        "{}: {} ({} at {:.3} s)",
        finding.property,
        finding.statement,
        finding.robot,
        std::time::Duration::from_millis(finding.at_ms).as_secs_f64()
    );
    let steps: Vec<_> = steps.into();
    sequence.draw(&title, &steps, |chart| {
        std::fs::write(
            &files.text,
            format!(
                "{title}\n{}\n\n{}",
                fuzz.reproduce(failure.seed),
                chart.text()
            ),
        )?;
        std::fs::write(&files.svg, chart.svg())
    })?;
    Ok(files)
}
