//! Compiles C and C++ against the static library that cargo has built for the tests.

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::built;

/// What programs of `harness/c` are compiled with: no warning, and every sanitizer that gcc has for C.
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

/// The program that `source`, a path in `harness/c`, compiles to. Where there is no compiler, says that
/// `test` is skipped.
pub fn compile(test: &str, language: Language, source: &str) -> Option<PathBuf> {
    let folder = built::programs().join("c").join(test);
    std::fs::create_dir_all(&folder).unwrap();
    let program = folder.join(format!("{language:?}"));
    let mut command = compiler(test, language)?;
    command
        .arg(crate_folder().join(source))
        .arg("-o")
        .arg(&program)
        .arg(library())
        .args(["-lpthread", "-ldl", "-lm"]);
    succeed(&mut command);
    Some(program)
}

/// Compiles `source`, and links nothing.
pub fn compile_to_object(test: &str, language: Language, source: &Path) {
    if let Some(mut command) = compiler(test, language) {
        let object = source.with_extension("o");
        succeed(command.arg("-c").arg(source).arg("-o").arg(object));
    }
}

/// The compiler with its flags. Where there is none, says that `test` is skipped.
fn compiler(test: &str, language: Language) -> Option<Command> {
    let [compiler, standard] = language.compiler();
    if Command::new(compiler).arg("--version").output().is_err() {
        // Not by eprintln!, which the test runner would capture.
        let _ = writeln!(
            std::io::stderr(),
            "SKIPPED {test}: {compiler} is not installed"
        );
        return None;
    }
    let mut command = Command::new(compiler);
    command.arg(standard).args(FLAGS);
    command.arg("-I").arg(crate_folder().join("include"));
    Some(command)
}

fn succeed(compiler: &mut Command) {
    let output = compiler.output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{compiler:?}:\n{said}");
}

/// The folder of the library for C.
fn crate_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../harness/c")
}

/// The newest static library of those beside this test; cargo has built it before the test.
fn library() -> PathBuf {
    let libraries = built::libraries().read_dir().unwrap().filter_map(|entry| {
        let path = entry.unwrap().path();
        let name = path.file_name()?.to_str()?;
        let is_it = name.starts_with("libcrossguard") && path.extension()? == "a";
        let is_it = is_it && matches!(name.as_bytes()["libcrossguard".len()], b'-' | b'.');
        is_it.then(|| (path.metadata().unwrap().modified().unwrap(), path))
    });
    libraries.max().expect("a library").1
}
