//! Which harnesses were verified, in a file, as long as no source changes.

use std::collections::BTreeSet;
use std::fs::{File, OpenOptions};
use std::hash::{DefaultHasher, Hasher};
use std::io::Write;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::kani::Outcome;

/// The sources that proofs are about, from the root of the workspace.
const SOURCES: [&str; 4] = ["protocol/src", "codec/src", "proofs/src", "Cargo.lock"];

/// Verified harnesses.
pub(crate) struct Kept {
    file: File,
    /// Of all sources, and of what is checked.
    digest: u64,
    names: BTreeSet<String>,
}

/// A line of the file.
#[derive(Serialize, Deserialize)]
struct Line {
    name: String,
    seconds: f64,
    digest: u64,
}

impl Kept {
    /// Opens the file, which need not be there yet. Lines about other sources count for nothing, and about other checks:
    /// with `memory`, each access to memory is checked.
    ///
    /// # Errors
    /// The file or a source cannot be read, and why.
    pub(crate) fn open(path: &Path, memory: bool) -> Result<Self, String> {
        let digest = digest(memory).map_err(|cause| format!("sources: {cause}"))?;
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
        let same = lines.filter(|line: &Line| line.digest == digest);
        Ok(Self {
            file,
            digest,
            names: same.map(|line| line.name).collect(),
        })
    }

    pub(crate) fn verified(&self, name: &str) -> bool {
        self.names.contains(name)
    }

    /// Keeps the outcome if it is good.
    ///
    /// # Errors
    /// The file cannot be written, and why.
    pub(crate) fn keep(&mut self, outcome: &Outcome) -> Result<(), String> {
        if outcome.failure.is_some() {
            return Ok(());
        }
        let line = Line {
            name: outcome.name.clone(),
            seconds: outcome.seconds,
            digest: self.digest,
        };
        let line = serde_json::to_string(&line).map_err(|cause| cause.to_string())?;
        writeln!(self.file, "\n{line}").map_err(|cause| cause.to_string())
    }
}

/// A number that is another one when a source is changed, or what is checked.
fn digest(memory: bool) -> std::io::Result<u64> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut paths: Vec<_> = SOURCES.iter().map(|path| root.join(path)).collect();
    let mut files: Vec<PathBuf> = Vec::new();
    while let Some(path) = paths.pop() {
        if path.is_dir() {
            for entry in path.read_dir()? {
                paths.push(entry?.path());
            }
        } else {
            files.push(path);
        }
    }
    files.sort();
    let mut hasher = DefaultHasher::new();
    for file in files {
        hasher.write(file.to_string_lossy().as_bytes());
        hasher.write(&std::fs::read(file)?);
    }
    hasher.write_u8(memory.into());
    Ok(hasher.finish())
}
