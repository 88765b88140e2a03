//! The files of this repository, and what they would be without some of it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

pub(crate) struct Repository {
    root: PathBuf,
    /// Files that are other than on the disk; `None` where one is gone.
    changed: BTreeMap<String, Option<String>>,
}

impl Repository {
    pub(crate) fn here() -> Self {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        Self {
            root,
            changed: BTreeMap::new(),
        }
    }

    /// The text of a file, if there is such a file.
    pub(crate) fn text(&self, path: &str) -> Option<String> {
        match self.changed.get(path) {
            Some(changed) => changed.clone(),
            None => std::fs::read_to_string(self.root.join(path)).ok(),
        }
    }

    pub(crate) fn has(&self, path: &str) -> bool {
        match self.changed.get(path) {
            Some(changed) => changed.is_some(),
            None => self.root.join(path).is_file(),
        }
    }

    pub(crate) fn write(&self, path: &str, text: &str) {
        std::fs::write(self.root.join(path), text).unwrap();
    }

    /// The same with another text of a file.
    pub(crate) fn with(&self, path: &str, text: &str) -> Self {
        self.changed_to(path, Some(text.to_owned()))
    }

    /// The same without a file.
    pub(crate) fn without(&self, path: &str) -> Self {
        self.changed_to(path, None)
    }

    fn changed_to(&self, path: &str, text: Option<String>) -> Self {
        let mut changed = self.changed.clone();
        changed.insert(path.to_owned(), text);
        let root = self.root.clone();
        Self { root, changed }
    }

    /// The same with other words in a file.
    pub(crate) fn replaced(&self, path: &str, from: &str, to: &str) -> Self {
        let text = self.text(path).unwrap_or_default();
        self.with(path, &text.replace(from, to))
    }

    /// The rules of the protocol, each with the properties that the index names for it.
    pub(crate) fn rules(&self) -> Vec<(String, Vec<String>)> {
        let page = self.text("protocol/doc/protocol.md").unwrap_or_default();
        let rows = page.lines().filter(|line| line.starts_with("| R"));
        let cells = rows.map(|row| row.split('|').map(str::trim).collect::<Vec<_>>());
        cells
            .map(|cells| {
                let properties = cells[4].split(", ").map(str::to_owned);
                (cells[1].to_owned(), properties.collect())
            })
            .collect()
    }

    /// Whether the integrator's guide has a rule of this number.
    pub(crate) fn has_guide_rule(&self, number: &str) -> bool {
        let guide = self.text("protocol/doc/integration.md").unwrap_or_default();
        guide
            .lines()
            .any(|line| line.starts_with(&format!("| {number} | **")))
    }

    /// The ids of all properties that have been verified.
    pub(crate) fn properties(&self) -> Vec<String> {
        let page = self
            .text("model-check/doc/verification.md")
            .unwrap_or_default();
        let is_id = |id: &&str| {
            let number = id.get(1..).and_then(|number| number.parse::<u8>().ok());
            id.starts_with(['I', 'L', 'W', 'C']) && number.is_some()
        };
        let rows = page.lines().filter_map(|line| line.strip_prefix("| "));
        let ids = rows.filter_map(|row| row.split(" | ").next()).filter(is_id);
        let mut ids: Vec<_> = ids.map(str::to_owned).collect();
        ids.sort();
        ids.dedup();
        ids
    }
}
