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

use crate::support::blessed;

/// In the order of their imports.
const MODULES: [&str; 8] = [
    "CDD", "Common", "VAM", "RAM", "RMCM", "CAM", "CPM", "CDD211",
];

fn module_paths() -> Vec<PathBuf> {
    let asn1 = Path::new(env!("CARGO_MANIFEST_DIR")).join("asn1");
    let path = |name| asn1.join(format!("Crossguard-{name}.asn"));
    MODULES.into_iter().map(path).collect()
}

/// Compares a file with what was generated for it.
fn compare(path: &str, generated: &str) {
    let present = blessed(path, || generated.to_owned());
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
