//! A copy of the workspace in which the protocol has all its mutants built in.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::Failure;
use crate::points::{IN_CONSTANTS, Source, Sources};

/// What the mutants are switched by; appended to the protocol's `lib.rs`.
const SWITCH: &str = include_str!("switch.txt");

/// What calls functions of the protocol.
const CONST_FREE: [&str; 6] = [
    "protocol/src/",
    "model-check/src/",
    "harness/endpoint/src/",
    "harness/robot/src/",
    "harness/judge/src/",
    "harness/src/",
];

/// Where the copy, its build and the verdicts are.
pub(crate) fn folder(root: &Path) -> PathBuf {
    root.join("target/mutants")
}

/// Writes the copy; where it is. Files that have not changed are left alone, so little is built anew.
pub(crate) fn write(root: &Path, sources: &Sources) -> Result<PathBuf, Failure> {
    let tree = folder(root).join("tree");
    let name = |source: &Source| {
        source
            .path
            .strip_prefix(root)
            .unwrap_or(&source.path)
            .to_owned()
    };
    let changed: Vec<PathBuf> = sources.files.iter().map(name).collect();
    let lib = Path::new("protocol/src/lib.rs");
    for file in files(root)? {
        if changed.contains(&file) || file == lib {
            continue;
        }
        let from = root.join(&file);
        // A file that was deleted and not committed yet.
        if let Ok(text) = std::fs::read(&from) {
            update(&tree.join(&file), &adapted(&file, text))?;
        }
    }
    for (file, source) in changed.iter().zip(&sources.files) {
        update(&tree.join(file), &adapted(file, source.schema().into()))?;
    }
    let mut text = std::fs::read(root.join(lib)).map_err(Failure::file(lib))?;
    text.extend(SWITCH.bytes());
    update(&tree.join(lib), &adapted(lib, text))?;
    Ok(tree)
}

/// A file as it is in the copy.
fn adapted(file: &Path, text: Vec<u8>) -> Vec<u8> {
    let name = file.to_string_lossy();
    let Ok(text) = String::from_utf8(text.clone()) else {
        return text;
    };
    if name.starts_with("model-check/scenarios/") {
        // A mutant may change how many states there are: that breaks nothing.
        let end = text.find("[expected]").unwrap_or(text.len());
        return text[..end].into();
    }
    let is_code = CONST_FREE.iter().any(|folder| name.starts_with(folder));
    if !is_code || !name.ends_with(".rs") {
        return text.into();
    }
    let lines = text.lines().map(|line| match line.split_once("const fn ") {
        Some((before, after)) if !is_in_constants(after) => format!("{before}fn {after}\n"),
        _ => format!("{line}\n"),
    });
    lines.collect::<String>().into()
}

fn is_in_constants(function: &str) -> bool {
    let name = function.split(['(', '<']).next();
    name.is_some_and(|name| IN_CONSTANTS.contains(&name))
}

/// The files of the workspace that git knows.
fn files(root: &Path) -> Result<Vec<PathBuf>, Failure> {
    let failure = |text: String| Failure::Command {
        command: "git ls-files".to_owned(),
        text,
    };
    let output = Command::new("git")
        .args([
            "ls-files",
            "-z",
            "--cached",
            "--others",
            "--exclude-standard",
        ])
        .current_dir(root)
        .output()
        .map_err(|cause| failure(cause.to_string()))?;
    if !output.status.success() {
        return Err(failure(
            String::from_utf8_lossy(&output.stderr).into_owned(),
        ));
    }
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let names = text.split('\0').filter(|name| !name.is_empty());
    Ok(names.map(PathBuf::from).collect())
}

fn update(path: &Path, text: &[u8]) -> Result<(), Failure> {
    if std::fs::read(path).is_ok_and(|present| present == text) {
        return Ok(());
    }
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(Failure::file(folder))?;
    }
    std::fs::write(path, text).map_err(Failure::file(path))
}
