//! What is written of a run that went wrong: its log, its packets, and what people look at.

use std::collections::VecDeque;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::time::Duration;

use crossguard_model_check::sequence::ChartStep;
use crossguard_robot::capture::Capture;
use crossguard_robot::trace::{self, Record};

use super::fuzz::{Failure, Fuzz};
use super::swarm::Swarm;
use super::world::{Watch, run};
use crate::sequence::Sequence;

/// How many steps of the sequence chart are kept: the last ones before what went wrong.
const CHART_STEPS: usize = 250;

/// What was written.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Files {
    /// The log, one JSON object per line.
    pub log: PathBuf,
    /// The packets, for Wireshark.
    pub pcap: PathBuf,
    /// The sequence chart as text.
    pub text: PathBuf,
    /// The sequence chart as a Mermaid diagram.
    pub mermaid: PathBuf,
}

impl Files {
    fn of(folder: &Path, seed: u64) -> Self {
        let path = |kind: &str| folder.join(format!("seed-{seed}.{kind}"));
        Self {
            log: path("jsonl"),
            pcap: path("pcap"),
            text: path("txt"),
            mermaid: path("mmd"),
        }
    }
}

/// Runs a failed seed once more and writes what it did into `folder`.
///
/// # Errors
/// Those of the files.
pub fn write_failure(folder: &Path, fuzz: &Fuzz, failure: &Failure) -> std::io::Result<Files> {
    std::fs::create_dir_all(folder)?;
    let files = Files::of(folder, failure.seed);
    let swarm = fuzz.swarm(failure.seed);
    let mut recorder = Recorder::new(&files, &swarm)?;
    // What panicked before does so again; what it did up to there is what is wanted.
    let _ = catch_unwind(AssertUnwindSafe(|| run(&swarm, Some(&mut recorder))));
    let again = fuzz.reproduce(failure.seed);
    recorder.finish(&files, &failure.finding.to_string(), &again)?;
    Ok(files)
}

/// Takes down what happens.
struct Recorder {
    log: BufWriter<File>,
    pcap: Capture,
    sequence: Sequence,
    steps: VecDeque<ChartStep>,
    written: std::io::Result<()>,
}

impl Recorder {
    fn new(files: &Files, swarm: &Swarm) -> std::io::Result<Self> {
        let robots = swarm.robots.iter();
        let robots: Vec<_> = robots.map(|it| (it.name.as_str(), it.station)).collect();
        Ok(Self {
            log: BufWriter::new(File::create(&files.log)?),
            pcap: Capture::create(&files.pcap).map_err(std::io::Error::other)?,
            sequence: Sequence::new(&robots),
            steps: VecDeque::new(),
            written: Ok(()),
        })
    }

    fn finish(mut self, files: &Files, title: &str, again: &str) -> std::io::Result<()> {
        self.written?;
        self.log.flush()?;
        self.pcap.finish().map_err(std::io::Error::other)?;
        self.steps.extend(self.sequence.rest());
        let steps: Vec<_> = self.steps.into();
        self.sequence.draw(title, &steps, |chart| {
            let text = format!("{title}\n{again}\n\n{}", chart.text());
            std::fs::write(&files.text, text)?;
            std::fs::write(&files.mermaid, chart.mermaid())
        })
    }
}

impl Watch for Recorder {
    fn record(&mut self, record: Record) {
        if self.written.is_ok() {
            self.written = trace::write(&mut self.log, &record);
        }
        self.steps.extend(self.sequence.gathered(&record));
        let surplus = self.steps.len().saturating_sub(CHART_STEPS);
        self.steps.drain(..surplus);
    }

    fn packet(&mut self, at: Duration, packet: &[u8]) {
        self.pcap.record_at(at, packet);
    }
}
