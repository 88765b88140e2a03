//! The times in `harnesses.toml`, and in `verified.toml` of which sources they are.

use std::fmt::Write as _;
use std::path::Path;
use std::time::SystemTime;

use serde::{Deserialize, Serialize};
use toml_edit::{DocumentMut, Item};

use crate::kept::Kept;
use crate::sources::Sources;

const HARNESSES: &str = "harnesses.toml";
const VERIFIED: &str = "verified.toml";

const HEAD: &str = "\
# The sources on which Kani verified all harnesses of harnesses.toml, as SHA-256. Written by
# `cargo run -p crossguard-proofs --example run -- --record`; `--status` says whether a source has changed since.

";

/// What `verified.toml` says.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Verified {
    /// The day on which it was written.
    date: String,
    sources: Sources,
}

/// Writes to both files in `folder` what `kept` has.
///
/// # Errors
/// A harness is not verified, or the list cannot be read: why, and then neither file is changed. Or one cannot be written.
pub(crate) fn record(folder: &Path, kept: &Kept) -> Result<(), String> {
    let path = folder.join(HARNESSES);
    let failed = |cause: &dyn std::fmt::Display| format!("{}: {cause}", path.display());
    let text = std::fs::read_to_string(&path).map_err(|cause| failed(&cause))?;
    let mut list: DocumentMut = text.parse().map_err(|cause| failed(&cause))?;
    let harnesses = list
        .get_mut("harness")
        .and_then(Item::as_array_of_tables_mut);
    let harnesses = harnesses.ok_or_else(|| failed(&"no harness is in it"))?;
    let mut missing = Vec::new();
    for harness in harnesses.iter_mut() {
        let name = harness.get("name").and_then(Item::as_str);
        let name = name.unwrap_or_default().to_owned();
        let seconds = kept.seconds(&name);
        let time = harness.get_mut("time").and_then(Item::as_value_mut);
        if let (Some(seconds), Some(time)) = (seconds, time) {
            // A comment beside it stays.
            let decor = time.decor().clone();
            *time = format!("{seconds:.1} s").into();
            *time.decor_mut() = decor;
        } else {
            missing.push(name);
        }
    }
    if let Some(first) = missing.first() {
        return Err(format!(
            "nothing is recorded: {} harnesses are not verified on these sources, {first} for one; run all of them",
            missing.len()
        ));
    }
    let now = humantime::format_rfc3339_seconds(SystemTime::now()).to_string();
    let verified = Verified {
        date: now.chars().take_while(|it| *it != 'T').collect(),
        sources: kept.sources().clone(),
    };
    let mut text = HEAD.to_owned();
    text.push_str(&toml::to_string(&verified).map_err(|cause| failed(&cause))?);
    std::fs::write(&path, list.to_string()).map_err(|cause| failed(&cause))?;
    let path = folder.join(VERIFIED);
    std::fs::write(&path, text).map_err(|cause| format!("{}: {cause}", path.display()))
}

/// Whether the files in `folder` are about these sources, and in words what they are about.
///
/// # Errors
/// A file cannot be read, and why.
pub(crate) fn status(folder: &Path, sources: &Sources) -> Result<(bool, String), String> {
    let path = folder.join(VERIFIED);
    let failed = |cause: &dyn std::fmt::Display| format!("{}: {cause}", path.display());
    let text = std::fs::read_to_string(&path).map_err(|cause| failed(&cause))?;
    let verified: Verified = toml::from_str(&text).map_err(|cause| failed(&cause))?;
    let changed = sources.changed_since(&verified.sources);
    let mut said = format!("Kani verified all harnesses on {}", verified.date);
    if changed.is_empty() {
        said.push_str(", on the sources as they are.");
    } else {
        let _ = write!(
            said,
            ". Since then has changed: {}. Nothing says that they still hold; run them again.",
            changed.join(", ")
        );
    }
    Ok((changed.is_empty(), said))
}
