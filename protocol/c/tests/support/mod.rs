//! Compiles C and C++ against the static library that cargo has built for the tests.
#![allow(dead_code, unreachable_pub, reason = "each test uses what it needs")]

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

/// What programs of this crate are compiled with: no warning, and every sanitizer that gcc has for C.
const FLAGS: [&str; 9] = [
    "-Wall",
    "-Wextra",
    "-Wconversion",
    "-Werror",
    "-pedantic",
    "-g",
    "-O1",
    "-fsanitize=address,undefined",
    "-fno-sanitize-recover=all",
];

/// A language, and its compiler.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Language {
    C,
    Cpp,
}

impl Language {
    const fn compiler(self) -> [&'static str; 2] {
        match self {
            Self::C => ["gcc", "-std=c11"],
            Self::Cpp => ["g++", "-std=c++17"],
        }
    }
}

/// The program that `source`, a path in this crate, compiles to. Where there is no compiler, says that
/// `test` is skipped.
pub fn compile(test: &str, language: Language, source: &str) -> Option<PathBuf> {
    let [compiler, standard] = language.compiler();
    if Command::new(compiler).arg("--version").output().is_err() {
        // Not by eprintln!, which the test runner would capture.
        let _ = writeln!(
            std::io::stderr(),
            "SKIPPED {test}: {compiler} is not installed"
        );
        return None;
    }
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(test);
    std::fs::create_dir_all(&folder).unwrap();
    let program = folder.join(format!("{language:?}"));
    let here = crate_folder();
    let output = Command::new(compiler)
        .arg(standard)
        .args(FLAGS)
        .arg("-I")
        .arg(here.join("include"))
        .arg(here.join(source))
        .arg("-o")
        .arg(&program)
        .arg(library())
        .args(["-lpthread", "-ldl", "-lm"])
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{source}:\n{said}");
    Some(program)
}

/// The folder of this crate, also for tests of other crates.
fn crate_folder() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    if here.ends_with("harness") {
        here.join("../protocol/c")
    } else {
        here.to_owned()
    }
}

/// The newest static library of those beside this test; cargo has built it before the test.
fn library() -> PathBuf {
    let test = std::env::current_exe().unwrap();
    let libraries = test
        .parent()
        .unwrap()
        .read_dir()
        .unwrap()
        .filter_map(|entry| {
            let path = entry.unwrap().path();
            let name = path.file_name()?.to_str()?;
            let is_it = name.starts_with("libcrossguard") && path.extension()? == "a";
            let is_it = is_it && matches!(name.as_bytes()["libcrossguard".len()], b'-' | b'.');
            is_it.then(|| (path.metadata().unwrap().modified().unwrap(), path))
        });
    libraries.max().expect("a library").1
}
