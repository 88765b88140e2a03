//! The integrator's guide names files and tests; they are there.

use std::path::{Path, PathBuf};

const GUIDE: &str = include_str!("../doc/integration.md");

fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn rust_files(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in folder.read_dir().unwrap().flatten() {
        let path = entry.path();
        if path.is_dir() {
            rust_files(&path, files);
        } else if is_rust(&path) {
            files.push(path);
        }
    }
}

fn is_rust(path: impl AsRef<Path>) -> bool {
    path.as_ref()
        .extension()
        .is_some_and(|extension| extension == "rs")
}

/// What stands between backticks.
fn quoted() -> impl Iterator<Item = &'static str> {
    GUIDE.split('`').skip(1).step_by(2)
}

#[test]
fn the_files_that_the_guide_names_exist() {
    let files: Vec<_> = quoted().filter(|name| is_rust(name)).collect();
    assert!(files.len() >= 10, "{files:?}");
    for file in files {
        assert!(repository().join(file).is_file(), "{file}");
    }
}

#[test]
fn the_tests_that_the_guide_names_exist() {
    let mut files = Vec::new();
    for folder in ["protocol/tests", "model-check/tests", "harness/tests"] {
        rust_files(&repository().join(folder), &mut files);
    }
    let sources: String = files
        .iter()
        .map(|file| std::fs::read_to_string(file).unwrap())
        .collect();
    let names: Vec<_> = quoted()
        .filter(|name| name.matches('_').count() >= 4 && !name.contains(['(', ' ']))
        .filter(|name| name.chars().all(|c| c.is_ascii_lowercase() || c == '_'))
        .collect();
    assert!(names.len() >= 4, "{names:?}");
    for name in names {
        assert!(sources.contains(&format!("fn {name}(")), "{name}");
    }
}
