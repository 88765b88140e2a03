//! Types that are declared twice under one name in one crate.
//!
//! Types of functions and types that macros make are not looked at. Two declarations in one module
//! are alternatives that `cfg` chooses between.

use std::collections::BTreeMap;
use std::path::Path;

use syn::Item;

use crate::bless;
use crate::sources::Package;
use crate::tokens;

/// Names that one crate declares twice on purpose: crate, name, why.
const ALLOWED: [(&str, &str, &str); 2] = [
    (
        "crossguard-harness",
        "Arguments",
        "the command line of the subcommand that its file is",
    ),
    (
        "crossguard-harness",
        "Command",
        "the subcommands of the command that its file is",
    ),
];

/// Each name with the places of its declarations; entries of the list above that allow nothing.
pub(crate) fn duplicates(root: &Path, packages: &[Package]) -> Vec<String> {
    let mut found = Vec::new();
    for package in packages {
        let types = types(root, package);
        let twice = types.iter().filter(|(_, places)| places.len() > 1);
        let allowed: Vec<_> = ALLOWED
            .iter()
            .filter(|(of, ..)| *of == package.name)
            .collect();
        for (name, places) in twice.clone() {
            if !allowed.iter().any(|(_, it, _)| it == name) {
                let places: Vec<_> = places.values().map(String::as_str).collect();
                let places = places.join("\n    ");
                found.push(format!("{}: type {name}\n    {places}", package.name));
            }
        }
        for (of, name, _) in allowed {
            if !twice.clone().any(|(it, _)| it == name) {
                found.push(format!(
                    "{of}: {name} is declared once; take it off the list"
                ));
            }
        }
    }
    found
}

/// The names of all types, each with its modules and the place of the declaration there.
fn types(root: &Path, package: &Package) -> BTreeMap<String, BTreeMap<Vec<String>, String>> {
    let mut types: BTreeMap<_, BTreeMap<_, _>> = BTreeMap::new();
    for module in package.targets.iter().flat_map(|target| &target.modules) {
        let file = module.file.strip_prefix(root).unwrap_or(&module.file);
        if bless::is_generated(file) {
            continue;
        }
        for item in &module.items {
            let ident = match item {
                Item::Enum(it) => &it.ident,
                Item::Struct(it) => &it.ident,
                Item::Trait(it) => &it.ident,
                Item::Type(it) => &it.ident,
                Item::Union(it) => &it.ident,
                _ => continue,
            };
            let place = format!("{}:{}", file.display(), ident.span().start().line);
            let places = types.entry(tokens::name(ident)).or_default();
            places.entry(module.path.clone()).or_insert(place);
        }
    }
    types
}

#[cfg(test)]
mod tests {
    use crate::sources::Target;

    use super::*;

    #[test]
    fn a_name_that_two_modules_declare_is_found_and_alternatives_are_not() {
        let folder = tempfile::TempDir::new().unwrap();
        let root = folder.path().join("lib.rs");
        let text = "struct Twice;
            mod one { pub enum Twice {} #[cfg(unix)] type Once = u8; #[cfg(windows)] type Once = u16; }
            mod two { fn local() { struct Once; } trait Other { type Once; } }
            #[cfg(test)] mod tests { struct Other; }";
        std::fs::write(&root, text).unwrap();
        let package = Package {
            name: "example".to_owned(),
            targets: vec![Target::read(&root).unwrap()],
        };
        let found = duplicates(folder.path(), &[package]);
        assert_eq!(found, ["example: type Twice\n    lib.rs:1\n    lib.rs:2"]);
    }
}
