//! The survivors that are explained: a file, which the page on mutants shows.

use std::path::Path;

use serde::Deserialize;

use crate::Failure;
use crate::points::{Mutant, Sources};

/// The file, from the root of the workspace.
const FILE: &str = "model-check/mutants/survivors.toml";

/// All explanations.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Explained {
    #[serde(default)]
    survivor: Vec<Survivor>,
}

/// Mutants that one sentence explains.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Survivor {
    /// As `list` shows them, without number and line.
    mutants: Vec<String>,
    /// Why no judge can or does notice.
    why: String,
    /// Whether a judge should notice: a hole of the specification that is known and not closed.
    #[serde(default)]
    open: bool,
}

impl Explained {
    pub(crate) fn read(root: &Path) -> Result<Self, Failure> {
        let path = root.join(FILE);
        let text = std::fs::read_to_string(&path).map_err(Failure::file(&path))?;
        toml::from_str(&text).map_err(|cause| Failure::Explanations {
            path,
            cause: Box::new(cause),
        })
    }

    /// The explanation of a survivor, or what is known of the hole that it shows.
    pub(crate) fn of(&self, mutant: &Mutant) -> Option<String> {
        let key = mutant.key();
        let of_it = |survivor: &&Survivor| survivor.mutants.contains(&key);
        let survivor = self.survivor.iter().find(of_it)?;
        let standing = if survivor.open { "open" } else { "explained" };
        Some(format!("{standing}: {}", survivor.why))
    }

    /// What is explained and is no mutant any more.
    pub(crate) fn of_nothing(&self, sources: &Sources) -> Vec<&str> {
        let keys: Vec<String> = sources.mutants().iter().map(Mutant::key).collect();
        let texts = self.survivor.iter().flat_map(|survivor| &survivor.mutants);
        texts
            .map(String::as_str)
            .filter(|text| !keys.iter().any(|key| key == text))
            .collect()
    }
}
