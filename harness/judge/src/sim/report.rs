//! Files of a run that went wrong: its log and its packets.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::time::Duration;

use crossguard_robot::capture::Capture;
use crossguard_robot::trace::{self, Record};

use super::fuzz::{Failure, Fuzz};
use super::world::{Watch, run};

/// Files that were written.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Files {
    /// The log, one JSON object per line.
    pub log: PathBuf,
    /// The packets, for Wireshark.
    pub pcap: PathBuf,
}

impl Files {
    fn of(folder: &Path, seed: u64) -> Self {
        let path = |kind: &str| folder.join(format!("seed-{seed}.{kind}"));
        Self {
            log: path("jsonl"),
            pcap: path("pcap"),
        }
    }
}

/// Runs a failed seed once more and writes what it did into `folder`.
///
/// # Errors
/// Errors of the files.
pub fn write_failure(folder: &Path, fuzz: &Fuzz, failure: &Failure) -> std::io::Result<Files> {
    std::fs::create_dir_all(folder)?;
    let files = Files::of(folder, failure.seed);
    let swarm = fuzz.swarm(failure.seed);
    let mut recorder = Recorder::new(&files)?;
    // A run that panicked before does so again; its record up to there is wanted.
    let _ = catch_unwind(AssertUnwindSafe(|| run(&swarm, Some(&mut recorder))));
    recorder.finish()?;
    Ok(files)
}

/// Takes down what happens.
struct Recorder {
    log: BufWriter<File>,
    pcap: Capture,
    written: std::io::Result<()>,
}

impl Recorder {
    fn new(files: &Files) -> std::io::Result<Self> {
        Ok(Self {
            log: BufWriter::new(File::create(&files.log)?),
            pcap: Capture::create(&files.pcap).map_err(std::io::Error::other)?,
            written: Ok(()),
        })
    }

    fn finish(mut self) -> std::io::Result<()> {
        self.written?;
        self.log.flush()?;
        self.pcap.finish().map_err(std::io::Error::other)
    }
}

impl Watch for Recorder {
    fn record(&mut self, record: Record) {
        if self.written.is_ok() {
            self.written = trace::write(&mut self.log, &record);
        }
    }

    fn packet(&mut self, at: Duration, packet: &[u8]) {
        self.pcap.record_at(at, packet);
    }
}
