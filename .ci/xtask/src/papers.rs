//! What goes with a release: a bill of materials, and the notices of the packages that are in it.

mod bill;
mod notices;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use cargo_metadata::{DependencyKind, Metadata, Node, Package, PackageId};

use crate::dependencies::{Locked, locked, metadata};
use crate::error::Error;

/// The packages whose programs and libraries are released.
const RELEASED: [&str; 4] = [
    "crossguard-harness",
    "crossguard-c",
    "crossguard-ros2",
    "crossguard-python",
];

/// What is in a release: packages, and who needs which. Tests and their dependencies are not.
struct Release<'a> {
    packages: BTreeMap<&'a PackageId, &'a Package>,
    needs: BTreeMap<&'a PackageId, BTreeSet<&'a PackageId>>,
    locked: Vec<Locked>,
    version: String,
}

/// Writes both.
pub(crate) fn write(root: &Path, folder: &Path) -> Result<(), Error> {
    let metadata = metadata(root)?;
    let release = Release::of(&metadata, locked(&root.join("Cargo.lock"))?);
    let io = |cause| Error::Io {
        path: folder.to_owned(),
        cause,
    };
    fs::create_dir_all(folder).map_err(io)?;
    let (bill, notices) = (bill::of(&release)?, notices::of(&release)?);
    let files = [
        (format!("crossguard-{}.cdx.json", release.version), bill),
        ("THIRD-PARTY-NOTICES.md".to_owned(), notices),
    ];
    for (name, text) in files {
        let path = folder.join(name);
        println!("{}: {} octets", path.display(), text.len());
        fs::write(&path, text).map_err(io)?;
    }
    println!("{} packages of others", release.foreign().count());
    Ok(())
}

impl<'a> Release<'a> {
    fn of(metadata: &'a Metadata, locked: Vec<Locked>) -> Self {
        let all: BTreeMap<_, _> = metadata.packages.iter().map(|it| (&it.id, it)).collect();
        let nodes = metadata.resolve.iter().flat_map(|it| &it.nodes);
        let nodes: BTreeMap<&PackageId, &Node> = nodes.map(|it| (&it.id, it)).collect();
        let is_released = |it: &&&Package| RELEASED.contains(&it.name.as_str());
        let mut open: Vec<_> = all.values().filter(is_released).map(|it| &it.id).collect();
        let version = all.values().find(is_released_one(RELEASED[0]));
        let version = version.map_or_else(String::new, |it| it.version.to_string());
        let (mut packages, mut needs) = (BTreeMap::new(), BTreeMap::new());
        while let Some(id) = open.pop() {
            if packages.insert(id, all[id]).is_none() {
                let needed = needed(nodes[id]);
                open.extend(needed.iter().copied());
                needs.insert(id, needed);
            }
        }
        Self {
            packages,
            needs,
            locked,
            version,
        }
    }

    /// The packages that are not of this repository, by name and version.
    fn foreign(&self) -> impl Iterator<Item = &'a Package> {
        let all = self.packages.values().copied();
        let mut foreign: Vec<_> = all.filter(|it| it.source.is_some()).collect();
        foreign.sort_by(|a, b| (&a.name, &a.version).cmp(&(&b.name, &b.version)));
        foreign.into_iter()
    }
}

fn is_released_one(name: &str) -> impl Fn(&&&Package) -> bool {
    move |it| it.name.as_str() == name
}

/// What a package needs to be built and to run.
fn needed(node: &Node) -> BTreeSet<&PackageId> {
    let is_of_tests = |kind: DependencyKind| kind == DependencyKind::Development;
    let deps = node.deps.iter();
    let deps = deps.filter(|it| !it.dep_kinds.iter().all(|it| is_of_tests(it.kind)));
    deps.map(|it| &it.pkg).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn root() -> &'static Path {
        Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
    }

    #[test]
    fn the_papers_have_what_is_released_and_nothing_of_tests() {
        let folder = tempfile::tempdir().unwrap();
        write(root(), folder.path()).unwrap();
        let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
        let version = env!("CARGO_PKG_VERSION");
        let bill: serde_json::Value =
            serde_json::from_str(&read(&format!("crossguard-{version}.cdx.json"))).unwrap();
        let components = bill["components"].as_array().unwrap();
        let names: BTreeSet<_> = components
            .iter()
            .map(|it| it["name"].as_str().unwrap())
            .collect();
        for name in ["p256", "zenoh", "clap", "pyo3", "crossguard-protocol"] {
            assert!(names.contains(name), "no {name}");
        }
        for name in [
            "proptest",
            "criterion",
            "cryptoki",
            "xtask",
            "crossguard-testkit",
        ] {
            assert!(!names.contains(name), "{name} is of tests");
        }
        let references: BTreeSet<_> = components
            .iter()
            .map(|it| it["bom-ref"].as_str().unwrap())
            .collect();
        assert_eq!(
            references.len(),
            components.len(),
            "each is called by one name"
        );
        for it in components.iter().filter(|it| it["purl"].is_string()) {
            assert_eq!(
                it["hashes"][0]["content"].as_str().unwrap().len(),
                64,
                "{it}"
            );
            assert!(it["licenses"][0]["expression"].is_string(), "{it}");
        }
        for it in bill["dependencies"].as_array().unwrap() {
            for on in it["dependsOn"].as_array().unwrap() {
                assert!(references.contains(on.as_str().unwrap()), "{on}");
            }
        }
        let notices = read("THIRD-PARTY-NOTICES.md");
        for it in components.iter().filter(|it| it["purl"].is_string()) {
            let (name, version) = (
                it["name"].as_str().unwrap(),
                it["version"].as_str().unwrap(),
            );
            assert!(
                notices.contains(&format!("`{name}` {version}")),
                "{name} {version}"
            );
        }
        assert!(notices.contains("Permission is hereby granted"));
    }
}
