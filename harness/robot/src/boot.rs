//! The boot counter: the only thing of the protocol that a robot persists.
//!
//! Session and offer numbers are built from it, so it must never go back. It is written before the
//! robot takes part in anything, into a file beside it (`.new`) that then takes its name, so that a
//! crash at any moment leaves the old counter or the new one. A counter that is taken and not used is
//! lost, which does no harm. The text ends with its line: one that was cut off, at whatever byte, is
//! corrupt and not a smaller counter.
//!
//! A counter file that was deleted, or put back from a copy, must not make the counter go back (property I15).
//! So the file beside it that is locked (`.lock`) has the newest counter as well, and has it first: the next
//! counter is above both. Only where neither is there does a robot begin at 1. Where the counter file is gone
//! and the other one cannot be read, the robot does not start.
//!
//! A robot that signs keeps two things more beside it, for its security: see [`Memory`].

mod memory;

pub use memory::{AHEAD_US, Memory};

use std::fs::{File, TryLockError};
use std::io::{ErrorKind, Read, Seek, SeekFrom, Write};
use std::os::unix::fs::OpenOptionsExt as _;
use std::path::{Path, PathBuf};

use nix::fcntl::OFlag;

use crate::files;

/// First words of the file.
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
    /// The file is gone, and what is beside it does not tell the counter.
    #[error(
        "{} is gone, and {} does not tell how far this robot's boot counter was. Write the line '{MAGIC} N' into \
         the former, with N larger than at any boot of this robot before",
        path.display(), beside(path).display()
    )]
    Lost {
        /// The file.
        path: PathBuf,
    },
    /// A file beside the counter holds something else.
    #[error("{} cannot be read. If you know that the clock of this robot is right, delete it", path.display())]
    Forgotten {
        /// The file.
        path: PathBuf,
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
    /// Further memory of a robot that signs.
    memory: Option<Memory>,
}

#[derive(Debug)]
struct Kept {
    path: PathBuf,
    /// Held so that no other process takes the same file; it has the counter, too.
    lock: File,
}

impl Boot {
    /// The first counter of a robot of which nothing outlives the process, as in a demonstration.
    #[must_use]
    pub const fn first_of_its_kind() -> Self {
        Self {
            counter: 1,
            kept: None,
            memory: None,
        }
    }

    /// The same for a robot that signs, which remembers more than the counter.
    ///
    /// # Errors
    /// When that cannot be read or kept: the robot had better not start.
    pub fn remembering(mut self) -> Result<Self, BootError> {
        if let Some(kept) = &self.kept {
            self.memory = Some(Memory::beside(&kept.path)?);
        }
        Ok(self)
    }

    /// Memory of a robot that signs; nothing from before this start, unless it is [`Boot::remembering`].
    pub(crate) fn take_memory(&mut self) -> Memory {
        self.memory.take().unwrap_or_else(Memory::nowhere)
    }

    /// Takes the next counter while the robot runs: the numbers of this one are half used up.
    ///
    /// # Errors
    /// Every way in which there is no counter to be had; the robot goes on with the one that it has.
    pub fn renew(&mut self) -> Result<u16, BootError> {
        self.counter = match &self.kept {
            Some(kept) => take_after(&kept.path, &kept.lock, self.counter)?,
            None => self.counter.saturating_add(1),
        };
        Ok(self.counter)
    }
}

/// Takes the next boot counter from `path`. A robot that has no file yet, nor one beside it, begins at 1.
///
/// # Errors
/// Every way in which there is no counter to be had; the file is then as it was.
pub fn take(path: &Path) -> Result<Boot, BootError> {
    let lock = lock(path)?;
    Ok(Boot {
        counter: take_after(path, &lock, 0)?,
        kept: Some(Kept {
            path: path.to_owned(),
            lock,
        }),
        memory: None,
    })
}

/// Takes the next counter, under the lock: larger than in the file, in the one beside it, and than `known`, which
/// this process has had. A file that is gone or was put back must not make the counter go back.
fn take_after(path: &Path, lock: &File, known: u16) -> Result<u16, BootError> {
    let unusable = |cause| BootError::Unusable {
        path: path.to_owned(),
        cause,
    };
    let remembered = remembered(lock).map_err(unusable)?;
    let counter = match files::open(path) {
        Ok((file, _)) => next(path, file)?,
        Err(missing) if missing.kind() == std::io::ErrorKind::NotFound => match remembered {
            Remembered::Unreadable => {
                let path = path.to_owned();
                return Err(BootError::Lost { path });
            }
            Remembered::Nothing | Remembered::Counter(_) => 1,
        },
        Err(cause) => return Err(unusable(cause)),
    };
    let known = match remembered {
        Remembered::Counter(remembered) => known.max(remembered),
        Remembered::Nothing | Remembered::Unreadable => known,
    };
    let above = known.checked_add(1).ok_or_else(|| BootError::Exhausted {
        path: path.to_owned(),
    })?;
    let counter = counter.max(above);
    remember(lock, counter).map_err(unusable)?;
    if let Err(cause) = replace(path, &format!("{MAGIC} {counter}\n")) {
        // Nobody has used it: a robot that is started again and again on a full disk uses no counters up.
        let _ = match remembered {
            Remembered::Counter(before) => remember(lock, before),
            Remembered::Nothing | Remembered::Unreadable => lock.set_len(0),
        };
        return Err(unusable(cause));
    }
    Ok(counter)
}

/// Counter according to the locked file.
#[derive(Clone, Copy, Debug)]
enum Remembered {
    /// The robot has never taken one.
    Nothing,
    /// The newest that was taken, or was about to be.
    Counter(u16),
    /// It was cut off while it was written, or holds something else.
    Unreadable,
}

fn remembered(mut lock: &File) -> std::io::Result<Remembered> {
    let mut octets = Vec::new();
    lock.seek(SeekFrom::Start(0))?;
    lock.take(200).read_to_end(&mut octets)?;
    if octets.is_empty() {
        return Ok(Remembered::Nothing);
    }
    let text = String::from_utf8_lossy(&octets);
    Ok(number(&text).map_or(Remembered::Unreadable, Remembered::Counter))
}

/// Writes over the counter in the locked file, which cannot be replaced while it is locked. A text as long as
/// any other is on the disk in one piece or not at all.
fn remember(mut lock: &File, counter: u16) -> std::io::Result<()> {
    lock.seek(SeekFrom::Start(0))?;
    let text = format!("{MAGIC} {counter:>5}\n");
    lock.write_all(text.as_bytes())?;
    lock.set_len(text.len() as u64)?;
    lock.sync_all()
}

/// The counter in a text that is whole.
fn number(text: &str) -> Option<u16> {
    text.strip_suffix('\n')?
        .strip_prefix(MAGIC)?
        .trim()
        .parse()
        .ok()
}

/// The file that is locked: the counter itself is replaced at every boot.
fn beside(path: &Path) -> PathBuf {
    path.with_added_extension("lock")
}

/// Locks the file beside the counter.
fn lock(path: &Path) -> Result<File, BootError> {
    let lock_path = beside(path);
    let unusable = |cause| BootError::Unusable {
        path: lock_path.clone(),
        cause,
    };
    // Another program that may write in the folder must not have another file written through a link.
    let lock = File::options()
        .create(true)
        .truncate(false)
        .read(true)
        .write(true)
        .custom_flags(OFlag::O_NOFOLLOW.bits())
        .open(&lock_path)
        .and_then(files::regular);
    let (lock, _) = lock.map_err(unusable)?;
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

/// Writes a file so that at any moment it holds the old text or the new one.
pub(crate) fn replace(path: &Path, text: &str) -> std::io::Result<()> {
    let folder = path
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty());
    let folder = folder.unwrap_or(Path::new("."));
    // Nobody else writes it, under the lock; one that a crash has left is removed, and so is a link that somebody
    // else has put there. What is opened then is a file that did not exist.
    let new_path = path.with_added_extension("new");
    match std::fs::remove_file(&new_path) {
        Err(error) if error.kind() != ErrorKind::NotFound => return Err(error),
        _ => {}
    }
    let mut new = File::create_new(&new_path)?;
    new.write_all(text.as_bytes())?;
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
    fn a_counter_that_was_deleted_or_put_back_does_not_begin_again() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("robot.boot");
        for expected in 1..=3 {
            assert_eq!(take(&path).unwrap().counter, expected);
        }
        fs::remove_file(&path).unwrap();
        assert_eq!(take(&path).unwrap().counter, 4);
        fs::write(&path, format!("{MAGIC} 1\n")).unwrap();
        assert_eq!(take(&path).unwrap().counter, 5);
        // The file beside it may be gone, as after an update: this file counts on.
        fs::remove_file(beside(&path)).unwrap();
        assert_eq!(take(&path).unwrap().counter, 6);
        fs::write(beside(&path), "").unwrap();
        assert_eq!(take(&path).unwrap().counter, 7);
    }

    #[test]
    fn where_neither_file_tells_the_counter_the_robot_does_not_start() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("robot.boot");
        take(&path).unwrap();
        fs::write(beside(&path), "crossguard boot coun").unwrap();
        // Alone, a text that was cut off does no harm.
        assert_eq!(take(&path).unwrap().counter, 2);
        fs::write(beside(&path), "crossguard boot coun").unwrap();
        fs::remove_file(&path).unwrap();
        let error = take(&path).unwrap_err().to_string();
        let is_lost = error.contains("does not tell how far");
        assert!(is_lost && error.contains("N larger than"), "{error}");
        fs::write(&path, format!("{MAGIC} 8\n")).unwrap();
        assert_eq!(take(&path).unwrap().counter, 9);
    }

    #[test]
    fn the_last_counter_is_not_followed_by_the_first() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("robot.boot");
        fs::write(&path, format!("{MAGIC} 65535\n")).unwrap();
        assert!(matches!(take(&path), Err(BootError::Exhausted { .. })));
    }

    #[test]
    fn nothing_is_written_through_a_link() {
        let folder = tempfile::tempdir().unwrap();
        let [path, other] = ["robot.boot", "other"].map(|name| folder.path().join(name));
        fs::write(&other, "of somebody else").unwrap();
        let link_to_other = |link: &Path| std::os::unix::fs::symlink(&other, link).unwrap();
        link_to_other(&path.with_added_extension("new"));
        assert_eq!(take(&path).unwrap().counter, 1);
        assert_eq!(fs::read_to_string(&other).unwrap(), "of somebody else");
        assert!(!fs::symlink_metadata(&path).unwrap().is_symlink());
        // A temporary file that a crash has left stands in nobody's way.
        fs::write(path.with_added_extension("new"), "cut o").unwrap();
        assert_eq!(take(&path).unwrap().counter, 2);
        fs::remove_file(beside(&path)).unwrap();
        link_to_other(&beside(&path));
        assert!(matches!(take(&path), Err(BootError::Unusable { .. })));
        assert_eq!(fs::read_to_string(&other).unwrap(), "of somebody else");
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
}
