//! What workers have found, kept in files, so that a check goes on after its processes have ended.
//!
//! A worker has one file. It is written at the end of a level, when no state is on its way, and takes the place of the
//! one before it once all workers have written theirs.

use std::collections::BTreeSet;
use std::fs::{self, File, TryLockError};
use std::io::{self, BufReader, BufWriter, Read, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::time::Duration;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

/// Where and how often a check keeps what it has found.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Checkpoints {
    /// A folder, which is made where it is not there. Processes of one check may share it.
    pub folder: PathBuf,
    /// How long a check goes on without a checkpoint, at the least.
    pub every: Duration,
}

/// Why a check cannot use its folder.
#[derive(Debug, thiserror::Error)]
pub enum CheckpointError {
    /// It cannot be read or written.
    #[error("{}: {cause}", path.display())]
    Io {
        /// The file or folder.
        path: PathBuf,
        /// Why.
        cause: io::Error,
    },
    /// Another process works with it.
    #[error("{} is in use: another check keeps its checkpoints there", path.display())]
    InUse {
        /// The file that it holds.
        path: PathBuf,
    },
    /// It has the checkpoint of another check.
    #[error(
        "{} is a checkpoint of another check: of another scenario, other numbers of workers and processes, or another \
         build of crossguard; take another folder, or remove the file",
        path.display()
    )]
    Other {
        /// The file.
        path: PathBuf,
    },
}

/// The files of the workers of this process.
pub(crate) struct Keeping {
    pub(crate) stores: Vec<Store>,
    pub(crate) every: Duration,
}

impl Keeping {
    /// # Errors
    /// As [`Store::open`].
    pub(crate) fn of(
        checkpoints: &Checkpoints,
        digest: u128,
        workers: Range<usize>,
    ) -> Result<Self, CheckpointError> {
        let stores = workers.map(|worker| Store::open(&checkpoints.folder, digest, worker));
        Ok(Self {
            stores: stores.collect::<Result<_, _>>()?,
            every: checkpoints.every,
        })
    }
}

/// What became of the checkpoints.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Kept {
    /// The level that the check went on at, and the states that were known then.
    pub resumed: Option<(u32, u64)>,
    /// The level of the last checkpoint of this run.
    pub level: Option<u32>,
    /// Why the last one could not be written.
    pub error: Option<String>,
}

impl CheckpointError {
    fn io(path: &Path, cause: io::Error) -> Self {
        Self::Io {
            path: path.to_owned(),
            cause,
        }
    }
}

/// With what a file begins.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
struct Header {
    magic: [u8; 8],
    /// Of what has to be the same when the check goes on.
    digest: u128,
    /// No state of it is expanded; all states before it are.
    level: u32,
}

/// With what the names of files end that are being written.
const UNFINISHED: &str = "-unfinished";

const MAGIC: [u8; 8] = *b"crossgc1";

/// The files of one worker.
pub(crate) struct Store {
    folder: PathBuf,
    digest: u128,
    worker: usize,
    /// Held as long as this process lives.
    _lock: File,
}

impl Store {
    /// # Errors
    /// The folder cannot be used, or has a file of another check.
    pub(crate) fn open(
        folder: &Path,
        digest: u128,
        worker: usize,
    ) -> Result<Self, CheckpointError> {
        fs::create_dir_all(folder).map_err(|cause| CheckpointError::io(folder, cause))?;
        let path = folder.join(format!("worker-{worker}.lock"));
        let lock = File::create(&path).map_err(|cause| CheckpointError::io(&path, cause))?;
        match lock.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => return Err(CheckpointError::InUse { path }),
            Err(TryLockError::Error(cause)) => return Err(CheckpointError::io(&path, cause)),
        }
        let store = Self {
            folder: folder.to_owned(),
            digest,
            worker,
            _lock: lock,
        };
        store.levels()?;
        for (name, path) in store.files()? {
            if name.ends_with(UNFINISHED) {
                // Of a process that was killed. Where it stays it takes room, and no more.
                let _ = fs::remove_file(path);
            }
        }
        Ok(store)
    }

    fn path(&self, level: u32) -> PathBuf {
        self.folder.join(format!("{}{level}", self.prefix()))
    }

    fn unfinished(&self, level: u32) -> PathBuf {
        let name = format!("{}{level}{UNFINISHED}", self.prefix());
        self.folder.join(name)
    }

    fn prefix(&self) -> String {
        format!("worker-{}.level-", self.worker)
    }

    /// The files of this worker, each with what its name says behind the prefix.
    fn files(&self) -> Result<Vec<(String, PathBuf)>, CheckpointError> {
        let entries = fs::read_dir(&self.folder).and_then(Iterator::collect);
        let entries: Vec<fs::DirEntry> =
            entries.map_err(|cause| CheckpointError::io(&self.folder, cause))?;
        let own = entries.into_iter().filter_map(|entry| {
            let name = entry.file_name().into_string().ok()?;
            let rest = name.strip_prefix(&self.prefix())?.to_owned();
            Some((rest, entry.path()))
        });
        Ok(own.collect())
    }

    /// The levels that there are files of.
    ///
    /// # Errors
    /// The folder cannot be read, or a file is of another check.
    pub(crate) fn levels(&self) -> Result<BTreeSet<u32>, CheckpointError> {
        let mut levels = BTreeSet::new();
        for (name, path) in self.files()? {
            let Ok(level) = name.parse() else {
                continue;
            };
            let file = File::open(&path).map_err(|cause| CheckpointError::io(&path, cause))?;
            let header = read(&mut BufReader::new(file));
            if !header.is_ok_and(|header: Header| header == self.header(level)) {
                return Err(CheckpointError::Other { path });
            }
            levels.insert(level);
        }
        Ok(levels)
    }

    const fn header(&self, level: u32) -> Header {
        Header {
            magic: MAGIC,
            digest: self.digest,
            level,
        }
    }

    /// Writes what a worker has found, under another name than it will have.
    pub(crate) fn write(
        &self,
        level: u32,
        save: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
    ) -> io::Result<()> {
        let mut file = BufWriter::new(File::create(self.unfinished(level))?);
        write(&mut file, &self.header(level))?;
        save(&mut file)?;
        let file = file.into_inner().map_err(io::IntoInnerError::into_error)?;
        file.sync_all()
    }

    /// Gives a file that was written its name.
    pub(crate) fn finish(&self, level: u32) -> io::Result<()> {
        fs::rename(self.unfinished(level), self.path(level))
    }

    /// Reads what a worker had found.
    pub(crate) fn read(
        &self,
        level: u32,
        restore: impl FnOnce(&mut BufReader<File>) -> io::Result<()>,
    ) -> io::Result<()> {
        let mut file = BufReader::new(File::open(self.path(level))?);
        read::<Header>(&mut file)?;
        restore(&mut file)
    }

    /// Removes all files but the one of a level. What cannot be removed stays, and harms nothing.
    pub(crate) fn remove_all_but(&self, kept: Option<u32>) {
        for level in self.levels().unwrap_or_default() {
            if Some(level) != kept {
                let _ = fs::remove_file(self.path(level));
            }
        }
    }

    /// Removes what was not written to its end.
    pub(crate) fn give_up(&self, level: u32) {
        let _ = fs::remove_file(self.unfinished(level));
    }
}

/// Writes a value behind its length.
pub(crate) fn write(file: &mut impl Write, value: &impl Serialize) -> io::Result<()> {
    let octets = postcard::to_allocvec(value).map_err(io::Error::other)?;
    let len = u32::try_from(octets.len()).map_err(io::Error::other)?;
    file.write_all(&len.to_le_bytes())?;
    file.write_all(&octets)
}

/// Reads what [`write`] has written.
pub(crate) fn read<T: DeserializeOwned>(file: &mut impl Read) -> io::Result<T> {
    let mut len = [0; 4];
    file.read_exact(&mut len)?;
    let len = u32::from_le_bytes(len);
    let mut octets = Vec::new();
    // Not allocated before it is there: the length may be nonsense.
    file.take(len.into()).read_to_end(&mut octets)?;
    postcard::from_bytes(&octets).map_err(|cause| io::Error::new(io::ErrorKind::InvalidData, cause))
}
