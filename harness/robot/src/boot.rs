//! The boot counter: the only thing that a robot persists.
//!
//! Session and offer numbers are built from it, so it must never go back. It is written before the
//! robot takes part in anything, into a file beside it (`.new`) that then takes its name, so that a
//! crash at any moment leaves the old counter or the new one. A counter that is taken and not used is
//! lost, which does no harm. The text ends with its line: one that was cut off, at whatever byte, is
//! corrupt and not a smaller counter.

use std::fs::{File, TryLockError};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};

/// What the file begins with.
const MAGIC: &str = "crossguard boot counter";

/// Why there is no boot counter.
#[derive(Debug, thiserror::Error)]
pub enum BootError {
    /// The file or its folder cannot be used.
    #[error(
        "the boot counter cannot be kept in {}: {cause}. The robot does not start, because its next \
         session numbers might be those of this boot",
        path.display()
    )]
    Unusable {
        /// The file.
        path: PathBuf,
        /// Why.
        cause: std::io::Error,
    },
    /// The file holds something else.
    #[error(
        "{} does not hold a boot counter: it begins with '{found}'. If the counter is lost, write \
         the line '{MAGIC} N' into it, with N larger than at any boot of this robot before",
        path.display()
    )]
    Corrupt {
        /// The file.
        path: PathBuf,
        /// How it begins.
        found: String,
    },
    /// The counter cannot go on.
    #[error("{}: this was the last of 65535 boots; give the robot a new station id and a new file", path.display())]
    Exhausted {
        /// The file.
        path: PathBuf,
    },
    /// Another process runs with the same file.
    #[error("{} is in use by another process: one robot, one process", path.display())]
    InUse {
        /// The file.
        path: PathBuf,
    },
}

/// A boot counter that is in use. It is free again when this is dropped.
#[derive(Debug)]
pub struct Boot {
    /// The counter of this boot.
    pub counter: u16,
    /// Where it is kept; nowhere, for robots of which nothing outlives the process.
    kept: Option<Kept>,
}

#[derive(Debug)]
struct Kept {
    path: PathBuf,
    /// Held so that no other process takes the same file.
    _lock: File,
}

impl Boot {
    /// The first counter of a robot of which nothing outlives the process, as in a demonstration.
    #[must_use]
    pub const fn first_of_its_kind() -> Self {
        Self {
            counter: 1,
            kept: None,
        }
    }

    /// Takes the next counter while the robot runs: the numbers of this one are half used up.
    ///
    /// # Errors
    /// Every way in which there is no counter to be had; the robot goes on with the one that it has.
    pub fn renew(&mut self) -> Result<u16, BootError> {
        self.counter = match &self.kept {
            Some(kept) => take_after(&kept.path, self.counter)?,
            None => self.counter.saturating_add(1),
        };
        Ok(self.counter)
    }
}

/// Takes the next boot counter from `path`. A file that does not exist begins at 1.
///
/// # Errors
/// Every way in which there is no counter to be had; the file is then as it was.
pub fn take(path: &Path) -> Result<Boot, BootError> {
    let lock = lock(path)?;
    Ok(Boot {
        counter: take_after(path, 0)?,
        kept: Some(Kept {
            path: path.to_owned(),
            _lock: lock,
        }),
    })
}

/// Takes the next counter, under the lock: larger than in the file, and than `known`, which this process has
/// had. A file that is gone or was put back must not make the counter go back.
fn take_after(path: &Path, known: u16) -> Result<u16, BootError> {
    let unusable = |cause| BootError::Unusable {
        path: path.to_owned(),
        cause,
    };
    let counter = match File::open(path) {
        Ok(file) => next(path, file)?,
        Err(missing) if missing.kind() == std::io::ErrorKind::NotFound => 1,
        Err(cause) => return Err(unusable(cause)),
    };
    let above = known.checked_add(1).ok_or_else(|| BootError::Exhausted {
        path: path.to_owned(),
    })?;
    let counter = counter.max(above);
    replace(path, counter).map_err(unusable)?;
    Ok(counter)
}

/// The counter itself is replaced at every boot, so the lock is on a file beside it.
fn lock(path: &Path) -> Result<File, BootError> {
    let lock_path = path.with_added_extension("lock");
    let unusable = |cause| BootError::Unusable {
        path: lock_path.clone(),
        cause,
    };
    let lock = File::options()
        .create(true)
        .append(true)
        .open(&lock_path)
        .map_err(unusable)?;
    match lock.try_lock() {
        Ok(()) => Ok(lock),
        Err(TryLockError::WouldBlock) => Err(BootError::InUse {
            path: path.to_owned(),
        }),
        Err(TryLockError::Error(cause)) => Err(unusable(cause)),
    }
}

fn next(path: &Path, file: File) -> Result<u16, BootError> {
    let mut text = String::new();
    let read = file.take(200).read_to_string(&mut text);
    let number = |text: &str| {
        text.strip_suffix('\n')?
            .strip_prefix(MAGIC)?
            .trim()
            .parse()
            .ok()
    };
    let last: Option<u16> = read.ok().and_then(|_| number(&text));
    let Some(last) = last else {
        let found = text.chars().take(40).collect();
        return Err(BootError::Corrupt {
            path: path.to_owned(),
            found,
        });
    };
    last.checked_add(1).ok_or_else(|| BootError::Exhausted {
        path: path.to_owned(),
    })
}

/// Writes the counter so that at any moment the file holds the old one or the new one.
fn replace(path: &Path, counter: u16) -> std::io::Result<()> {
    let folder = path
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty());
    let folder = folder.unwrap_or(Path::new("."));
    // Nobody else writes it, under the lock; one that a crash has left is written over.
    let new_path = path.with_added_extension("new");
    let mut new = File::create(&new_path)?;
    new.write_all(format!("{MAGIC} {counter}\n").as_bytes())?;
    new.sync_all()?;
    std::fs::rename(new_path, path)?;
    // The name itself is on the disk only when the folder is.
    File::open(folder)?.sync_all()
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn each_boot_takes_the_next_counter() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("robot.boot");
        for expected in 1..=3 {
            assert_eq!(take(&path).unwrap().counter, expected);
        }
    }

    #[test]
    fn a_counter_is_renewed_while_it_is_in_use() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("robot.boot");
        let mut boot = take(&path).unwrap();
        assert_eq!((boot.renew().unwrap(), boot.counter), (2, 2));
        fs::remove_file(&path).unwrap();
        fs::create_dir(&path).unwrap();
        assert!(boot.renew().is_err());
        assert_eq!(boot.counter, 2);
        fs::remove_dir(&path).unwrap();
        // Not 1, although there is no file; and not 2, which an old file would have next.
        assert_eq!(boot.renew().unwrap(), 3);
        fs::write(&path, format!("{MAGIC} 1\n")).unwrap();
        assert_eq!(boot.renew().unwrap(), 4);
        drop(boot);
        assert_eq!(take(&path).unwrap().counter, 5);
    }

    #[test]
    fn a_corrupt_file_is_refused_and_left_as_it_is() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("robot.boot");
        for garbage in [
            "",
            "17",
            "crossguard boot counter",
            "crossguard boot counter x",
            "\u{0}\u{1}",
        ] {
            fs::write(&path, garbage).unwrap();
            let error = take(&path).unwrap_err();
            assert!(
                matches!(error, BootError::Corrupt { .. }),
                "{garbage:?}: {error}"
            );
            assert!(
                error
                    .to_string()
                    .contains("write the line 'crossguard boot counter N'")
            );
            assert_eq!(fs::read_to_string(&path).unwrap(), garbage);
        }
        fs::write(&path, [0xff, 0xfe]).unwrap();
        assert!(matches!(take(&path), Err(BootError::Corrupt { .. })));
    }

    #[test]
    fn the_way_out_of_a_corrupt_file_works() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("robot.boot");
        fs::write(&path, "crossguard boot counter 41\n").unwrap();
        assert_eq!(take(&path).unwrap().counter, 42);
    }

    #[test]
    fn the_last_counter_is_not_followed_by_the_first() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("robot.boot");
        fs::write(&path, format!("{MAGIC} 65535\n")).unwrap();
        assert!(matches!(take(&path), Err(BootError::Exhausted { .. })));
    }

    #[test]
    fn two_processes_do_not_share_a_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("robot.boot");
        let first = take(&path).unwrap();
        assert!(matches!(take(&path), Err(BootError::InUse { .. })));
        drop(first);
        assert_eq!(take(&path).unwrap().counter, 2);
    }

    #[test]
    fn a_folder_that_does_not_exist_is_named() {
        let error = take(Path::new("/no/such/folder/robot.boot")).unwrap_err();
        assert!(
            error.to_string().contains("/no/such/folder/robot.boot"),
            "{error}"
        );
    }
}
