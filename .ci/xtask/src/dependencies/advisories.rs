//! Known advisories on packages of the lock files: a list with a date, which `cargo xtask advisories` takes from a
//! clone of `RustSec`'s database.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::Command;

use semver::{Version, VersionReq};
use serde::{Deserialize, Serialize};

use super::foreign;
use crate::error::Error;

const LIST: &str = ".ci/advisories.json";

/// The list.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Advisories {
    /// The day of the newest change in the database.
    pub(crate) as_of: String,
    /// That change.
    commit: String,
    /// The packages that were looked up.
    pub(crate) looked_up: BTreeSet<String>,
    #[serde(rename = "advisories")]
    known: Vec<Advisory>,
}

/// An advisory on a package of the lock files, also where it is about other versions.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Advisory {
    pub(crate) id: String,
    package: String,
    /// `vulnerability`, or `unmaintained`, `unsound` or `notice`.
    pub(crate) kind: String,
    patched: Vec<VersionReq>,
    unaffected: Vec<VersionReq>,
}

impl Advisory {
    /// In which versions there is nothing to fear.
    pub(crate) fn remedy(&self) -> String {
        match &self.patched[..] {
            [] => "without a patched version".to_owned(),
            patched => {
                let patched: Vec<_> = patched.iter().map(VersionReq::to_string).collect();
                format!("patched in {}", patched.join(" and "))
            }
        }
    }

    fn is_of(&self, version: &Version) -> bool {
        // A requirement matches no version before a release, unless it names one; who runs those is told.
        let mut fine = self.patched.iter().chain(&self.unaffected);
        !fine.any(|it| it.matches(version))
    }
}

impl Advisories {
    pub(crate) fn read(root: &Path) -> Result<Self, Error> {
        let path = root.join(LIST);
        let text = fs::read_to_string(&path).map_err(|cause| Error::Io {
            path: path.clone(),
            cause,
        })?;
        serde_json::from_str(&text).map_err(|cause| Error::Content {
            path,
            cause: cause.to_string(),
        })
    }

    /// The advisories about a version of a package.
    pub(crate) fn of(&self, package: &str, version: &Version) -> impl Iterator<Item = &Advisory> {
        let of_package = self.known.iter().filter(move |it| it.package == package);
        of_package.filter(move |it| it.is_of(version))
    }

    /// One advisory on each line, so that people can review a difference.
    fn text(&self) -> Result<String, serde_json::Error> {
        let mut text = String::new();
        let quoted = |it: &String| serde_json::to_string(it);
        let names: Result<Vec<_>, _> = self.looked_up.iter().map(quoted).collect();
        let lines: Result<Vec<_>, _> = self.known.iter().map(serde_json::to_string).collect();
        let _ = write!(
            text,
            "{{\n\"as_of\": {}, \"commit\": {},\n\"looked_up\": [\n{}\n],\n\"advisories\": [\n{}\n]\n}}\n",
            quoted(&self.as_of)?,
            quoted(&self.commit)?,
            names?.join(",\n"),
            lines?.join(",\n")
        );
        Ok(text)
    }
}

/// Writes the list anew from a clone of the database; how many advisories there are.
pub(crate) fn look_up(root: &Path, database: &Path) -> Result<usize, Error> {
    let looked_up: BTreeSet<_> = foreign(root)?.into_iter().map(|it| it.name).collect();
    let newest = git(database, &["log", "-1", "--format=%cs %H"])?;
    let (as_of, commit) = newest.trim().split_once(' ').unwrap_or_default();
    let files = git(
        database,
        &["ls-tree", "-r", "--name-only", "HEAD", "crates/"],
    )?;
    let mut advisories = Vec::new();
    for file in files.lines() {
        let package = file.split('/').nth(1).unwrap_or_default();
        if looked_up.contains(package) {
            let text = git(database, &["show", &format!("HEAD:{file}")])?;
            advisories.extend(parse(file, &text)?);
        }
    }
    advisories.sort_by(|a, b| a.id.cmp(&b.id));
    let list = Advisories {
        as_of: as_of.to_owned(),
        commit: commit.to_owned(),
        looked_up,
        known: advisories,
    };
    let path = root.join(LIST);
    let text = list.text().map_err(|cause| Error::Content {
        path: path.clone(),
        cause: cause.to_string(),
    })?;
    fs::write(&path, text).map_err(|cause| Error::Io { path, cause })?;
    Ok(list.known.len())
}

/// The advisory in a file of the database, unless it was withdrawn: a table in front of its text.
fn parse(file: &str, text: &str) -> Result<Option<Advisory>, Error> {
    #[derive(Deserialize)]
    struct Table {
        advisory: Head,
        versions: Versions,
    }
    #[derive(Deserialize)]
    struct Head {
        id: String,
        package: String,
        informational: Option<String>,
        withdrawn: Option<String>,
    }
    #[derive(Deserialize)]
    struct Versions {
        patched: Vec<VersionReq>,
        #[serde(default)]
        unaffected: Vec<VersionReq>,
    }
    let content = |cause: String| Error::Content {
        path: file.into(),
        cause,
    };
    let table = text
        .split("```")
        .nth(1)
        .and_then(|it| it.strip_prefix("toml"));
    let table = table.ok_or_else(|| content("no table in front".to_owned()))?;
    let Table { advisory, versions } =
        toml::from_str(table).map_err(|cause| content(cause.to_string()))?;
    if advisory.withdrawn.is_some() {
        return Ok(None);
    }
    let kind = advisory.informational;
    Ok(Some(Advisory {
        id: advisory.id,
        package: advisory.package,
        kind: kind.unwrap_or_else(|| "vulnerability".to_owned()),
        patched: versions.patched,
        unaffected: versions.unaffected,
    }))
}

fn git(folder: &Path, arguments: &[&str]) -> Result<String, Error> {
    let mut command = Command::new("git");
    let output = command.arg("-C").arg(folder).args(arguments).output();
    let output = output.map_err(|cause| Error::Start {
        program: "git".to_owned(),
        cause,
    })?;
    if !output.status.success() {
        return Err(Error::Content {
            path: folder.to_owned(),
            cause: String::from_utf8_lossy(&output.stderr).trim().to_owned(),
        });
    }
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "```toml\n[advisory]\nid = \"RUSTSEC-1\"\npackage = \"a\"\ndate = \"2026-01-01\"\n\
        [versions]\npatched = [\">= 1.2.3, < 2.0.0\", \">= 2.1.0\"]\nunaffected = [\"< 1.0.0\"]\n```\n# A ```toml\n";

    #[test]
    fn an_advisory_is_of_the_versions_that_are_neither_patched_nor_unaffected() {
        let advisory = parse("crates/a/RUSTSEC-1.md", TEXT).unwrap().unwrap();
        assert_eq!(advisory.kind, "vulnerability");
        for (version, is_of) in [
            ("0.9.0", false),
            ("1.2.2", true),
            ("1.2.3", false),
            ("2.0.0", true),
            ("2.1.0", false),
        ] {
            assert_eq!(
                advisory.is_of(&version.parse().unwrap()),
                is_of,
                "{version}"
            );
        }
        assert_eq!(advisory.remedy(), "patched in >=1.2.3, <2.0.0 and >=2.1.0");
        let withdrawn = TEXT.replace("date", "withdrawn");
        assert!(parse("a.md", &withdrawn).unwrap().is_none());
        assert!(parse("a.md", "no table").is_err());
    }

    #[test]
    fn a_list_survives_its_file() {
        let list = Advisories {
            as_of: "2026-01-01".to_owned(),
            commit: "abc".to_owned(),
            looked_up: BTreeSet::from(["a".to_owned(), "b".to_owned()]),
            known: parse("a.md", TEXT).unwrap().into_iter().collect(),
        };
        let again: Advisories = serde_json::from_str(&list.text().unwrap()).unwrap();
        assert_eq!(again.looked_up, list.looked_up);
        assert_eq!(again.of("a", &Version::new(2, 0, 0)).count(), 1);
        assert_eq!(again.of("b", &Version::new(2, 0, 0)).count(), 0);
    }
}
