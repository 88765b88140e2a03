//! Looks whether a command can write where it will write, before it does anything else: nobody should lose
//! the result of a long run to a folder that is missing.

use std::fs::{self, OpenOptions};
use std::io;
use std::os::unix::fs::MetadataExt as _;
use std::path::{Path, PathBuf};

use super::Failure;

/// Whether these files can be written. Their content stays.
pub(super) fn files<'a>(
    paths: impl IntoIterator<Item = &'a Option<PathBuf>>,
) -> Result<(), Failure> {
    paths.into_iter().flatten().try_for_each(|path| file(path))
}

/// Whether none of the files to write is a file that is read, or another one that is written: a log takes the place of an
/// older file.
pub(super) fn others<'a>(
    written: impl IntoIterator<Item = &'a PathBuf>,
    read: impl IntoIterator<Item = &'a PathBuf>,
) -> Result<(), Failure> {
    let is_one = |one: &Path, other: &Path| match (fs::metadata(one), fs::metadata(other)) {
        (Ok(one), Ok(other)) => {
            one.is_file() && (one.dev(), one.ino()) == (other.dev(), other.ino())
        }
        _ => one == other,
    };
    let mut taken: Vec<_> = read.into_iter().collect();
    for path in written {
        if taken.iter().any(|it| is_one(path, it)) {
            let why = "this robot reads it, or writes something else there; choose another name";
            return Err(cannot(path, why));
        }
        taken.push(path);
    }
    Ok(())
}

/// Whether files can be written into these folders, or into folders that are still to be made.
pub(super) fn folders<'a>(
    paths: impl IntoIterator<Item = &'a Option<PathBuf>>,
) -> Result<(), Failure> {
    paths
        .into_iter()
        .flatten()
        .try_for_each(|path| folder(path))
}

/// Whether a file can be written. Its content stays.
pub(super) fn file(path: &Path) -> Result<(), Failure> {
    if path.as_os_str().is_empty() {
        return Err(Failure::input("'' is no name of a file to write"));
    }
    match fs::metadata(path) {
        Ok(it) if it.is_dir() => Err(cannot(path, "it is a folder, and a file is wanted")),
        Ok(it) if it.is_file() => {
            let opened = OpenOptions::new().append(true).open(path);
            opened.map(drop).map_err(|error| cannot(path, error))
        }
        // A device or a pipe: to open it could wait for its reader.
        Ok(_) => Ok(()),
        Err(_) => probe(path).map_err(|error| in_folder(path, &error)),
    }
}

/// Whether files can be written into a folder, or into one that is still to be made.
pub(super) fn folder(path: &Path) -> Result<(), Failure> {
    if path.as_os_str().is_empty() {
        return Err(Failure::input("'' is no name of a folder to write to"));
    }
    let is_there = |it: &&Path| it.exists();
    let there = path.ancestors().find(is_there).unwrap_or(Path::new("."));
    if !there.is_dir() {
        let why = format!("{} is no folder", there.display());
        return Err(cannot(path, why));
    }
    let name = format!(".crossguard-{}", std::process::id());
    probe(&there.join(name)).map_err(|error| cannot(path, error))
}

/// Makes a file that is not there, and takes it away again.
fn probe(path: &Path) -> io::Result<()> {
    OpenOptions::new().write(true).create_new(true).open(path)?;
    fs::remove_file(path)
}

fn in_folder(path: &Path, error: &io::Error) -> Failure {
    let folder = path.parent().filter(|it| !it.as_os_str().is_empty());
    match folder {
        Some(folder) if !folder.exists() => {
            let why = format!(
                "the folder {} is not there; make it first",
                folder.display()
            );
            cannot(path, why)
        }
        Some(folder) if !folder.is_dir() => {
            cannot(path, format!("{} is no folder", folder.display()))
        }
        _ => cannot(path, error),
    }
}

fn cannot(path: &Path, why: impl std::fmt::Display) -> Failure {
    Failure::Input(format!("{} cannot be written: {why}", path.display()))
}
