//! The bill of materials, in the form of `CycloneDX` 1.5: what every package is, where it comes from, and who needs it.

use cargo_metadata::Package;
use serde_json::{Value, json};

use super::Release;
use crate::dependencies::Locked;
use crate::error::Error;

/// The text of the bill. It has no time and no random number: the same lock file gives the same bill.
pub(super) fn of(release: &Release) -> Result<String, Error> {
    let components: Vec<_> = release
        .packages
        .values()
        .map(|it| component(it, release))
        .collect();
    let dependencies: Vec<_> = release
        .needs
        .iter()
        .map(|(id, needs)| {
            let needs: Vec<_> = needs
                .iter()
                .map(|it| reference(release.packages[*it]))
                .collect();
            json!({ "ref": reference(release.packages[*id]), "dependsOn": needs })
        })
        .collect();
    let bill = json!({
        "bomFormat": "CycloneDX",
        "specVersion": "1.5",
        "version": 1,
        "metadata": {
            "component": {
                "type": "application",
                "bom-ref": "crossguard",
                "name": "crossguard",
                "version": release.version,
                "licenses": [{ "expression": "MIT OR Apache-2.0" }],
            },
        },
        "components": components,
        "dependencies": dependencies,
    });
    let text = serde_json::to_string_pretty(&bill);
    text.map(|text| text + "\n")
        .map_err(|cause| Error::Content {
            path: "the bill of materials".into(),
            cause: cause.to_string(),
        })
}

/// By what a package is called within the bill.
fn reference(package: &Package) -> String {
    format!("pkg:cargo/{}@{}", package.name, package.version)
}

fn component(package: &Package, release: &Release) -> Value {
    let mut component = json!({
        "type": "library",
        "bom-ref": reference(package),
        "name": package.name.as_str(),
        "version": package.version.to_string(),
    });
    if let Some(licence) = package.license.as_deref().and_then(canonical) {
        component["licenses"] = json!([{ "expression": licence }]);
    }
    if let Some(repository) = &package.repository {
        component["externalReferences"] = json!([{ "type": "vcs", "url": repository }]);
    }
    // What is of this repository is not on crates.io yet.
    if package.source.is_some() {
        component["purl"] = json!(reference(package));
        if let Some(sum) = checksum(package, release) {
            component["hashes"] = json!([{ "alg": "SHA-256", "content": sum }]);
        }
    }
    component
}

/// A licence as SPDX writes it: some packages still have `/` for `OR`.
fn canonical(licence: &str) -> Option<String> {
    let licence = licence.trim();
    let canonical = spdx::Expression::canonicalize(licence).ok()?;
    Some(canonical.unwrap_or_else(|| licence.to_owned()))
}

fn checksum<'a>(package: &Package, release: &'a Release) -> Option<&'a str> {
    let is_it = |it: &&Locked| it.name == package.name.as_str() && it.version == package.version;
    release.locked.iter().find(is_it)?.checksum.as_deref()
}
