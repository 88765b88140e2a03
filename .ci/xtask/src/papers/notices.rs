//! The notices of others: who wrote what is in a release, under which licence, and its text as they pass it on.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;

use cargo_metadata::Package;

use super::Release;
use crate::error::Error;

/// How the names of files with licences and notices begin.
const NAMES: [&str; 5] = ["LICENSE", "LICENCE", "COPYING", "COPYRIGHT", "NOTICE"];

const HEAD: &str = "# Notices of third parties\n\nWhat is in a release of Crossguard and was written by others: the packages, \
and after them the texts that come with them. `cargo xtask papers` writes this from the packages themselves.\n\n";

/// The text of the notices; each text of a licence stands once, with the packages that it is of.
pub(super) fn of(release: &Release) -> Result<String, Error> {
    let mut page = HEAD.to_owned();
    let mut texts: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let mut without = Vec::new();
    page.push_str("| package | licence | by |\n|---|---|---|\n");
    for package in release.foreign() {
        let name = format!("`{}` {}", package.name, package.version);
        let licence = package.license.as_deref().unwrap_or_default().trim();
        let authors = package.authors.join(", ").replace('|', "/");
        let _ = writeln!(page, "| {name} | {licence} | {authors} |");
        let found = texts_of(package)?;
        if found.is_empty() {
            without.push(format!("{name} ({licence})"));
        }
        for text in found {
            texts.entry(text).or_default().push(name.clone());
        }
    }
    if !without.is_empty() {
        let _ = write!(
            page,
            "\n## Without a text of their own\n\nThese packages name their licence and bring no text of it: {}.\n",
            without.join(", ")
        );
    }
    page.push_str("\n## Texts\n");
    for (text, packages) in texts {
        let text = text.replace("```", "'''");
        let _ = write!(page, "\n{}\n\n```text\n{text}\n```\n", packages.join(", "));
    }
    Ok(page)
}

/// The texts of licences and notices that come with a package.
fn texts_of(package: &Package) -> Result<Vec<String>, Error> {
    let Some(folder) = package.manifest_path.parent() else {
        return Ok(Vec::new());
    };
    let io = |path: PathBuf| move |cause| Error::Io { path, cause };
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).map_err(io(folder.into()))? {
        let entry = entry.map_err(io(folder.into()))?;
        let name = entry.file_name().to_string_lossy().to_uppercase();
        if NAMES.iter().any(|it| name.starts_with(it)) && entry.path().is_file() {
            files.push(entry.path());
        }
    }
    files.sort();
    let read = |path: PathBuf| {
        let octets = fs::read(&path).map_err(io(path))?;
        Ok(String::from_utf8_lossy(&octets)
            .replace("\r\n", "\n")
            .trim()
            .to_owned())
    };
    files.into_iter().map(read).collect()
}
