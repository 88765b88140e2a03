//! Whether the packages of the lock files may be what they are: licence, source, versions beside each other, and
//! known advisories. Nothing is asked over the network.

pub(crate) mod advisories;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use cargo_metadata::{CargoOpt, Metadata, MetadataCommand, Package};
use semver::Version;
use serde::Deserialize;
use spdx::{Expression, ParseMode};

use crate::error::Error;
use advisories::Advisories;

/// What is allowed.
const RULES: &str = ".ci/dependencies.toml";

/// The lock files: of the workspace, and of the fuzz targets.
const LOCKS: [&str; 2] = ["Cargo.lock", "harness/fuzz/Cargo.lock"];

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Rules {
    licences: BTreeSet<String>,
    single: BTreeSet<String>,
    #[serde(default)]
    exception: Vec<Exception>,
    #[serde(default)]
    accepted: Vec<Accepted>,
}

/// A licence that one package alone may have.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Exception {
    package: String,
    licence: String,
    why: String,
}

/// An advisory that is known to do no harm here.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Accepted {
    advisory: String,
    why: String,
}

/// A package of a lock file.
#[derive(Deserialize, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Locked {
    pub(crate) name: String,
    pub(crate) version: Version,
    /// Where it comes from; `None` for a package of this repository.
    pub(crate) source: Option<String>,
    /// Its SHA-256 at that source.
    pub(crate) checksum: Option<String>,
}

/// The packages of a lock file.
pub(crate) fn locked(path: &Path) -> Result<Vec<Locked>, Error> {
    #[derive(Deserialize)]
    struct Lock {
        package: Vec<Locked>,
    }
    Ok(read::<Lock>(path)?.package)
}

/// The packages of all lock files that are not of this repository.
pub(crate) fn foreign(root: &Path) -> Result<BTreeSet<Locked>, Error> {
    let mut all = BTreeSet::new();
    for lock in LOCKS {
        let packages = locked(&root.join(lock))?.into_iter();
        all.extend(packages.filter(|it| it.source.is_some()));
    }
    Ok(all)
}

fn read<T: serde::de::DeserializeOwned>(path: &Path) -> Result<T, Error> {
    let text = fs::read_to_string(path).map_err(|cause| Error::Io {
        path: path.to_owned(),
        cause,
    })?;
    toml::from_str(&text).map_err(|cause| Error::Content {
        path: path.to_owned(),
        cause: cause.to_string(),
    })
}

/// What cargo knows of the packages of the workspace and of all below it, with all features.
pub(crate) fn metadata(root: &Path) -> Result<Metadata, Error> {
    let mut command = MetadataCommand::new();
    command.current_dir(root).features(CargoOpt::AllFeatures);
    command.other_options(["--locked".to_owned()]);
    Ok(command.exec()?)
}

/// Everything that is not allowed, and every allowance that allows nothing.
pub(crate) fn findings(root: &Path) -> Result<Vec<String>, Error> {
    let rules: Rules = read(&root.join(RULES))?;
    let packages = metadata(root)?.packages;
    let foreign = foreign(root)?;
    let advisories = Advisories::read(root)?;
    let mut found = rules.of_licences(&packages);
    found.extend(rules.of_versions(&packages));
    found.extend(of_sources(&foreign));
    found.extend(rules.of_advisories(&foreign, &advisories));
    found.extend(rules.without_reason());
    println!(
        "{} packages of others; advisories as of {}",
        foreign.len(),
        advisories.as_of
    );
    Ok(found)
}

impl Rules {
    fn of_licences(&self, packages: &[Package]) -> Vec<String> {
        let (mut found, mut used) = (Vec::new(), BTreeSet::new());
        for package in packages {
            let name = package.name.as_str();
            let Some(text) = &package.license else {
                found.push(format!("{name} {}: no licence", package.version));
                continue;
            };
            let Ok(expression) = Expression::parse_mode(text.trim(), ParseMode::LAX) else {
                found.push(format!(
                    "{name} {}: '{text}' is no licence",
                    package.version
                ));
                continue;
            };
            let is_allowed = |licence: &str| self.licences.contains(licence);
            if expression.evaluate(|it| is_allowed(&it.to_string())) {
                continue;
            }
            let exception = |licence: &str| {
                let mut exceptions = self.exception.iter();
                exceptions.any(|it| it.package == name && it.licence == licence)
            };
            if expression.evaluate(|it| is_allowed(&it.to_string()) || exception(&it.to_string())) {
                used.insert(name);
            } else {
                found.push(format!("{name} {}: licence {text}", package.version));
            }
        }
        let idle = self
            .exception
            .iter()
            .filter(|it| !used.contains(&*it.package));
        found.extend(idle.map(|it| {
            format!(
                "{RULES}: the exception for {} allows nothing; take it out",
                it.package
            )
        }));
        found
    }

    fn of_versions(&self, packages: &[Package]) -> Vec<String> {
        let mut versions: BTreeMap<&str, BTreeSet<&Version>> = BTreeMap::new();
        for package in packages {
            versions
                .entry(&package.name)
                .or_default()
                .insert(&package.version);
        }
        let mut found = Vec::new();
        for name in &self.single {
            match versions.get(&**name).map_or(0, BTreeSet::len) {
                0 => found.push(format!(
                    "{RULES}: there is no {name}; take it out of 'single'"
                )),
                1 => {}
                count => found.push(format!("{name}: {count} versions, one is wanted")),
            }
        }
        found
    }

    fn of_advisories(&self, packages: &BTreeSet<Locked>, known: &Advisories) -> Vec<String> {
        let mut found = Vec::new();
        let names: BTreeSet<_> = packages.iter().map(|it| &*it.name).collect();
        for name in names.iter().filter(|it| !known.looked_up.contains(**it)) {
            found.push(format!(
                "{name}: nobody has looked for advisories; cargo xtask advisories FOLDER does, with a clone of \
                 https://github.com/rustsec/advisory-db"
            ));
        }
        let mut used = BTreeSet::new();
        for package in packages {
            for advisory in known.of(&package.name, &package.version) {
                if self.accepted.iter().any(|it| it.advisory == advisory.id) {
                    used.insert(&*advisory.id);
                } else {
                    let Locked { name, version, .. } = package;
                    let (id, kind) = (&advisory.id, &advisory.kind);
                    found.push(format!(
                        "{name} {version}: {kind}, {id}, {}",
                        advisory.remedy()
                    ));
                }
            }
        }
        let idle = self
            .accepted
            .iter()
            .filter(|it| !used.contains(&*it.advisory));
        found.extend(idle.map(|it| {
            format!(
                "{RULES}: {} is of no package here; take it out of 'accepted'",
                it.advisory
            )
        }));
        found
    }

    /// Allowances that do not say why.
    fn without_reason(&self) -> Vec<String> {
        let exceptions = self.exception.iter().map(|it| (&it.package, &it.why));
        let accepted = self.accepted.iter().map(|it| (&it.advisory, &it.why));
        let all = exceptions.chain(accepted);
        all.filter(|(_, why)| why.trim().is_empty())
            .map(|(what, _)| format!("{RULES}: {what}: say why"))
            .collect()
    }
}

/// Packages that come from somewhere else than crates.io.
fn of_sources(packages: &BTreeSet<Locked>) -> Vec<String> {
    const CRATES_IO: &str = "registry+https://github.com/rust-lang/crates.io-index";
    let others = packages
        .iter()
        .filter(|it| it.source.as_deref() != Some(CRATES_IO));
    others
        .map(|it| {
            let source = it.source.as_deref().unwrap_or_default();
            format!(
                "{} {}: from {source}, not from crates.io",
                it.name, it.version
            )
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn root() -> &'static Path {
        Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
    }

    fn rules() -> Rules {
        read(&root().join(RULES)).unwrap()
    }

    #[test]
    fn what_is_locked_is_allowed() {
        assert_eq!(findings(root()).unwrap(), Vec::<String>::new());
    }

    #[test]
    fn a_licence_an_exception_and_a_second_version_are_missed() {
        let packages = metadata(root()).unwrap().packages;
        let mut rules = rules();
        rules.licences.remove("BSL-1.0");
        rules.exception.retain(|it| it.package != "cbindgen");
        rules.exception.push(Exception {
            package: "serde".to_owned(),
            licence: "MPL-2.0".to_owned(),
            why: String::new(),
        });
        let found = rules.of_licences(&packages).join("\n");
        assert!(
            found.contains("xxhash-rust") && found.contains("licence BSL-1.0"),
            "{found}"
        );
        assert!(
            found.contains("cbindgen") && found.contains("licence MPL-2.0"),
            "{found}"
        );
        assert!(
            found.contains("the exception for serde allows nothing"),
            "{found}"
        );
        assert_eq!(found.lines().count(), 3, "{found}");
        assert_eq!(rules.without_reason().len(), 1);
        rules.single.extend(["rand", "nosuch"].map(str::to_owned));
        let found = rules.of_versions(&packages).join("\n");
        assert!(found.contains("rand: 3 versions"), "{found}");
        assert!(found.contains("there is no nosuch"), "{found}");
    }

    #[test]
    fn an_advisory_that_is_not_accepted_is_a_finding_and_so_is_a_package_that_nobody_looked_up() {
        let (mut rules, mut known) = (rules(), Advisories::read(root()).unwrap());
        let packages = foreign(root()).unwrap();
        rules
            .accepted
            .retain(|it| it.advisory != "RUSTSEC-2026-0041");
        rules.accepted.push(Accepted {
            advisory: "RUSTSEC-2018-0003".to_owned(),
            why: "it is patched".to_owned(),
        });
        known.looked_up.remove("serde");
        let found = rules.of_advisories(&packages, &known).join("\n");
        assert!(found.contains("lz4_flex 0.10.0: vulnerability"), "{found}");
        assert!(found.contains("serde: nobody has looked"), "{found}");
        assert!(
            found.contains("RUSTSEC-2018-0003 is of no package here"),
            "{found}"
        );
        assert_eq!(found.lines().count(), 3, "{found}");
    }

    #[test]
    fn a_package_from_elsewhere_is_a_finding() {
        let from = |source: &str| Locked {
            name: "fork".to_owned(),
            version: Version::new(1, 0, 0),
            source: Some(source.to_owned()),
            checksum: None,
        };
        let git = BTreeSet::from([from("git+https://example.org/fork")]);
        assert_eq!(of_sources(&git).len(), 1);
        assert!(of_sources(&foreign(root()).unwrap()).is_empty());
    }
}
