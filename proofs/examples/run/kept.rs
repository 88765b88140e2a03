//! Which harnesses were verified, in a file, as long as no source changes.

use std::collections::BTreeMap;
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::kani::Outcome;
use crate::sources::Sources;

/// Verified harnesses.
pub(crate) struct Kept {
    file: File,
    /// The folder of the workspace.
    root: PathBuf,
    sources: Sources,
    memory: bool,
    /// How many seconds each took.
    seconds: BTreeMap<String, f64>,
}

/// A line of the file.
#[derive(Serialize, Deserialize)]
struct Line {
    name: String,
    seconds: f64,
    /// Whether each access to memory was checked.
    memory: bool,
    sources: Sources,
}

impl Kept {
    /// Opens the file about the workspace in `root`; it need not be there yet. Lines about other sources count for nothing, and about other checks:
    /// with `memory`, each access to memory is checked.
    ///
    /// # Errors
    /// The file or a source cannot be read, and why.
    pub(crate) fn open(path: &Path, root: &Path, memory: bool) -> Result<Self, String> {
        let sources = Sources::of(root)?;
        let failed = |cause| format!("{}: {cause}", path.display());
        let mut options = OpenOptions::new();
        let file = options
            .create(true)
            .append(true)
            .open(path)
            .map_err(failed)?;
        let text = std::fs::read_to_string(path).map_err(failed)?;
        // A line that is cut is one that was being written when the run was stopped.
        let lines = text
            .lines()
            .filter_map(|line| serde_json::from_str(line).ok());
        let same = lines.filter(|line: &Line| line.sources == sources && line.memory == memory);
        let seconds = same.map(|line| (line.name, line.seconds)).collect();
        Ok(Self {
            file,
            root: root.to_owned(),
            sources,
            memory,
            seconds,
        })
    }

    /// What they were verified on.
    pub(crate) const fn sources(&self) -> &Sources {
        &self.sources
    }

    /// How many seconds it took to verify this harness, if it is verified.
    pub(crate) fn seconds(&self, name: &str) -> Option<f64> {
        self.seconds.get(name).copied()
    }

    /// Keeps the outcome if it is good.
    ///
    /// # Errors
    /// A source has changed since the run began, so nobody knows what was verified; or the file cannot be written, and why.
    pub(crate) fn keep(&mut self, outcome: &Outcome) -> Result<(), String> {
        if outcome.failure.is_some() {
            return Ok(());
        }
        if let [changed, ..] = Sources::of(&self.root)?.changed_since(&self.sources)[..] {
            return Err(format!(
                "{changed} has changed while harnesses ran: run again, what was verified before is kept for the sources of before"
            ));
        }
        self.seconds.insert(outcome.name.clone(), outcome.seconds);
        let line = Line {
            name: outcome.name.clone(),
            seconds: outcome.seconds,
            memory: self.memory,
            sources: self.sources.clone(),
        };
        let line = serde_json::to_string(&line).map_err(|cause| cause.to_string())?;
        writeln!(self.file, "\n{line}").map_err(|cause| cause.to_string())
    }
}
