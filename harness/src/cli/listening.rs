//! Arguments of commands that read packets and messages of others.

use std::path::{Path, PathBuf};

use crossguard_codec::{Dictionary, Identifiers};
use crossguard_judge::signature::Signatures;
use crossguard_robot::{files, pki};
use serde::Deserialize;

use super::Failure;

/// Facts that no header tells, and certificates to trust.
#[derive(clap::Args)]
pub(super) struct ListeningArguments {
    /// The common data dictionary that VAM and CPM are built on; no header tells. [default: 2.4.1, or that of
    /// --config]
    #[arg(long, value_enum)]
    dictionary: Option<Version>,
    /// Take ports, messageIds and ITS-AIDs from [identifiers] in this file, that of a robot or one with nothing
    /// else.
    #[arg(long, value_name = "FILE")]
    config: Option<PathBuf>,
    /// Verify signatures by the roots and authorities in this folder, that of a PKI or of a robot.
    #[arg(long, value_name = "FOLDER")]
    trust: Option<PathBuf>,
}

/// A version of TS 102 894-2.
#[derive(Clone, Copy, clap::ValueEnum)]
enum Version {
    /// TS 103 300-3 v2.2.1, TS 103 324 v2.1.1 as published.
    #[value(name = "2.1.1")]
    V2_1_1,
    /// TS 103 300-3 v2.3.1; the same bits as 2.2.1 and 2.3.1.
    #[value(name = "2.4.1")]
    V2_4_1,
}

/// The part of a robot's file that says what no standard has assigned.
#[derive(Deserialize)]
struct IdentifiersFile {
    #[serde(default)]
    identifiers: Identifiers,
}

/// The identifiers in a file; those of the kit without one.
pub(super) fn identifiers_of(file: Option<&Path>) -> Result<Identifiers, Failure> {
    let Some(path) = file else {
        return Ok(Identifiers::default());
    };
    let text = files::text(path, files::TEXT_MAX).map_err(Failure::at(path))?;
    let file: IdentifiersFile = toml::from_str(&text).map_err(Failure::at(path))?;
    let checked = file.identifiers.check();
    let checked = checked.map_err(|error| format!("[identifiers] {error}"));
    checked.map_err(Failure::at(path))?;
    Ok(file.identifiers)
}

impl ListeningArguments {
    /// Identifiers that no standard has assigned, as the channel has them.
    pub(super) fn identifiers(&self) -> Result<Identifiers, Failure> {
        let mut identifiers = identifiers_of(self.config.as_deref())?;
        if let Some(version) = self.dictionary {
            identifiers.dictionary = match version {
                Version::V2_1_1 => Dictionary::V2_1_1,
                Version::V2_4_1 => Dictionary::V2_4_1,
            };
        }
        Ok(identifiers)
    }

    /// Checker of signatures.
    pub(super) fn signatures(&self) -> Result<Signatures, Failure> {
        let Some(folder) = &self.trust else {
            return Ok(Signatures::default());
        };
        let trust = pki::read_trust(folder).map_err(Failure::input)?;
        if trust.roots().is_empty() {
            return Err(Failure::Input(format!(
                "{}: there is no root certificate in it",
                folder.display()
            )));
        }
        Ok(Signatures::trusting(trust))
    }
}
