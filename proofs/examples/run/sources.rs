//! The sources that proofs are about.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

/// What is proved and what says it, from the root of the workspace.
const PARTS: [&str; 3] = ["protocol/src", "codec/src", "proofs/src"];

/// A digest of each part.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(transparent)]
pub(crate) struct Sources(BTreeMap<String, String>);

impl Sources {
    /// Those of the workspace in this folder.
    ///
    /// # Errors
    /// One cannot be read, and why.
    pub(crate) fn of(root: &Path) -> Result<Self, String> {
        let digest = |part: &str| Ok((part.to_owned(), digest(root, part)?));
        PARTS
            .into_iter()
            .map(digest)
            .collect::<Result<_, _>>()
            .map(Self)
    }

    /// The parts that are not what they were then.
    pub(crate) fn changed_since(&self, then: &Self) -> Vec<&str> {
        let parts = self.0.iter();
        let changed = parts.filter(|(part, digest)| then.0.get(*part) != Some(*digest));
        changed.map(|(part, _)| part.as_str()).collect()
    }
}

/// SHA-256 of the names and texts of all files in `root/part`.
fn digest(root: &Path, part: &str) -> Result<String, String> {
    let failed = |path: &Path, cause| format!("{}: {cause}", path.display());
    let mut paths = vec![PathBuf::from(part)];
    let mut files = Vec::new();
    while let Some(path) = paths.pop() {
        let full = root.join(&path);
        if full.is_dir() {
            for entry in full.read_dir().map_err(|cause| failed(&full, cause))? {
                let entry = entry.map_err(|cause| failed(&full, cause))?;
                paths.push(path.join(entry.file_name()));
            }
        } else {
            files.push(path);
        }
    }
    files.sort();
    let mut hasher = Sha256::new();
    for file in files {
        let full = root.join(&file);
        let text = std::fs::read(&full).map_err(|cause| failed(&full, cause))?;
        // Where one ends and the next begins is part of what is hashed.
        for octets in [file.to_string_lossy().as_bytes(), &text] {
            hasher.update((octets.len() as u64).to_be_bytes());
            hasher.update(octets);
        }
    }
    Ok(hex::encode(hasher.finalize()))
}
