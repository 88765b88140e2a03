//! Hand-written files that are too long to be read in one go.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::bless;
use crate::error::Error;

const LINES_MAX: usize = 600;

/// Languages that people write; a script may also have no extension.
const EXTENSIONS: [&str; 16] = [
    "asn", "c", "cmake", "cpp", "css", "h", "hpp", "js", "lua", "md", "pml", "py", "rs", "sh",
    "toml", "yml",
];

/// Longer files, each with why it is not cut.
const ALLOWED: [(&str, &str); 2] = [
    (
        "codec/asn1/Crossguard-CDD.asn",
        "the types of one ASN.1 module of ETSI TS 102 894-2, in one module as there",
    ),
    (
        "proofs/harnesses.toml",
        "a table: an entry for each harness, which a test compares with the source",
    ),
];

/// The files in git that are too long, with their lengths.
pub(crate) fn too_long(root: &Path) -> Result<Vec<String>, Error> {
    let output = Command::new("git")
        .args(["ls-files", "--cached", "--others", "--exclude-standard"])
        .current_dir(root)
        .output()
        .map_err(|cause| Error::Start {
            program: "git".to_owned(),
            cause,
        })?;
    let names = String::from_utf8_lossy(&output.stdout).into_owned();
    let files = names.lines().map(Path::new).filter(|path| is_source(path));
    let mut found = Vec::new();
    for file in files.filter(|file| !bless::is_generated(file)) {
        let Ok(text) = fs::read_to_string(root.join(file)) else {
            continue; // removed, but not yet from git; or no text
        };
        let lines = text.lines().count();
        let is_allowed = ALLOWED.iter().any(|(path, _)| Path::new(path) == file);
        if lines > LINES_MAX && !is_allowed {
            found.push(format!(
                "{}: {lines} lines, at most {LINES_MAX}",
                file.display()
            ));
        }
    }
    Ok(found)
}

fn is_source(path: &Path) -> bool {
    path.extension()
        .is_none_or(|it| EXTENSIONS.iter().any(|known| it == *known))
}
