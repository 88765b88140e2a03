//! What is generated from the modules in `asn1` is what is in the repository: the types of the core,
//! those of rasn, and the list of types that the tests go through.
//!
//! This test needs the crate to compile: after a change of a module generate first, and adapt the
//! crate then.

mod declarations;
mod notation;
mod rasn;
mod syntax;
mod table;

use std::path::{Path, PathBuf};
use std::{env, fs};

/// In the order of their imports.
const MODULES: [&str; 9] = [
    "CDD", "Common", "VAM", "RAM", "RMCM", "CAM", "CPM", "CDD211", "DENM",
];

/// Set to write the generated files instead of comparing them.
const BLESS: &str = "CROSSGUARD_BLESS";

fn manifest_dir() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn module_paths() -> Vec<PathBuf> {
    let path = |name| manifest_dir().join(format!("asn1/Crossguard-{name}.asn"));
    MODULES.into_iter().map(path).collect()
}

/// Compares a file with what was generated for it, or writes it.
fn compare(path: &str, generated: &str) {
    let file = manifest_dir().join(path);
    if env::var_os(BLESS).is_some() {
        fs::write(&file, generated).expect("the generated file can be written");
        return;
    }
    let present = fs::read_to_string(&file).unwrap_or_default();
    assert!(
        generated == present,
        "{path} is out of date; run: cargo xtask bless generated.rs"
    );
}

#[test]
fn the_types_of_rasn_are_those_of_the_modules() {
    compare("src/asn1/generated.rs", &rasn::generate());
}

#[test]
fn the_types_of_the_core_are_those_of_the_modules() {
    for (path, text) in declarations::generate(&syntax::parse()) {
        compare(&path, &text);
    }
}
