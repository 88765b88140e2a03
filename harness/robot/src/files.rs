//! Files that a configuration names: regular files alone, and none longer than it can be. A FIFO holds no robot up, and a device
//! without an end fills no memory. The type of a file is asked of the open file: nothing is exchanged in between.

use std::fs::{File, Metadata};
use std::io::{Error, ErrorKind, Read as _, Result};
use std::os::unix::fs::{FileTypeExt as _, OpenOptionsExt as _};
use std::path::Path;

use nix::errno::Errno;
use nix::fcntl::OFlag;

/// The longest text that a person writes for a robot, in octets.
pub const TEXT_MAX: u64 = 1 << 20;

/// Why a file that is there is not read.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Unfit {
    /// It is something else than a regular file.
    #[error("is {0}, not a file")]
    Kind(&'static str),
    /// It has more octets than this.
    #[error("longer than {0} octets")]
    TooLong(u64),
}

impl From<Unfit> for Error {
    fn from(unfit: Unfit) -> Self {
        let kind = match unfit {
            Unfit::Kind(_) => ErrorKind::InvalidInput,
            Unfit::TooLong(_) => ErrorKind::FileTooLarge,
        };
        Self::new(kind, unfit)
    }
}

/// Opens a regular file, without waiting for the other end of anything else.
pub(crate) fn open(path: &Path) -> Result<(File, Metadata)> {
    let flags = OFlag::O_NONBLOCK | OFlag::O_NOCTTY;
    let mut options = File::options();
    let opened = options.read(true).custom_flags(flags.bits()).open(path);
    match opened {
        Err(error) if error.raw_os_error() == Some(Errno::ENXIO as i32) => {
            Err(Unfit::Kind("a socket or a device").into())
        }
        opened => regular(opened?),
    }
}

/// The same file, if it is a regular one.
pub(crate) fn regular(file: File) -> Result<(File, Metadata)> {
    let metadata = file.metadata()?;
    let kind = metadata.file_type();
    if kind.is_file() {
        return Ok((file, metadata));
    }
    let unfit = if kind.is_dir() {
        "a folder"
    } else if kind.is_fifo() {
        "a FIFO"
    } else {
        "a device"
    };
    Err(Unfit::Kind(unfit).into())
}

/// Content of an open file, which has at most so many octets.
pub(crate) fn rest(file: File, octets_max: u64) -> Result<Vec<u8>> {
    let mut octets = Vec::new();
    // One octet more than the longest.
    file.take(octets_max + 1).read_to_end(&mut octets)?;
    if octets.len() as u64 > octets_max {
        return Err(Unfit::TooLong(octets_max).into());
    }
    Ok(octets)
}

/// Content of a regular file, which has at most so many octets.
///
/// # Errors
/// When it cannot be read, is no regular file, or is longer.
pub fn read(path: &Path, octets_max: u64) -> Result<Vec<u8>> {
    rest(open(path)?.0, octets_max)
}

/// The same, as text.
///
/// # Errors
/// The errors of [`read`], and a text that is not in UTF-8.
pub fn text(path: &Path, octets_max: u64) -> Result<String> {
    text_of(read(path, octets_max)?)
}

pub(crate) fn text_of(octets: Vec<u8>) -> Result<String> {
    String::from_utf8(octets).map_err(|_| Error::new(ErrorKind::InvalidData, "is no text in UTF-8"))
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::os::unix::fs::symlink;
    use std::os::unix::net::UnixListener;
    use std::sync::mpsc::channel;
    use std::time::Duration;

    use nix::sys::stat::Mode;
    use nix::unistd::mkfifo;

    use super::*;
    use crate::boot;
    use crate::pki::{Holder, RevokedList, read_certificate};
    use crate::plan_file::PlanFile;
    use crate::robot_file::RobotFile;
    use crate::site_file::SiteFile;

    fn told<T>(read: std::result::Result<T, impl std::fmt::Display>) -> Option<String> {
        read.err().map(|error| error.to_string())
    }

    type Maker = fn(&Path);
    type Reader = fn(&Path) -> Option<String>;

    /// Readers of the file of this name in a folder. Each returns its error.
    const READERS: [(&str, Reader); 9] = [
        ("robot.toml", |at| {
            told(RobotFile::read(&at.join("robot.toml")))
        }),
        ("site.toml", |at| {
            told(SiteFile::read(&at.join("site.toml")))
        }),
        ("plan.toml", |at| {
            told(PlanFile::open(&at.join("plan.toml"), SiteFile::street()))
        }),
        ("r.boot", |at| told(boot::take(&at.join("r.boot")))),
        ("r.boot.lock", |at| told(boot::take(&at.join("r.boot")))),
        ("r.boot.time", |at| {
            told(boot::take(&at.join("r.boot")).and_then(boot::Boot::remembering))
        }),
        ("revoked.txt", |at| {
            told(RevokedList::new(at.join("revoked.txt")).read())
        }),
        ("root.cert", |at| {
            told(read_certificate(&at.join("root.cert")))
        }),
        ("root.key", |at| told(Holder::read(at, "root"))),
    ];

    /// Error for an unfit file, and the maker of that file.
    const UNFIT: [(&str, Maker); 5] = [
        ("is a FIFO, not a file", |path| {
            mkfifo(path, Mode::S_IRUSR | Mode::S_IWUSR).unwrap();
        }),
        ("is a device, not a file", |path| {
            symlink("/dev/zero", path).unwrap();
        }),
        ("is a folder, not a file", |path| {
            fs::create_dir(path).unwrap();
        }),
        ("is a socket or a device, not a file", |path| {
            drop(UnixListener::bind(path).unwrap());
        }),
        ("octets", |path| {
            fs::write(path, vec![b'#'; 1 + (1 << 20)]).unwrap();
            fs::set_permissions(path, std::os::unix::fs::PermissionsExt::from_mode(0o600)).unwrap();
        }),
    ];

    /// Hazard: a robot hangs at its start, or while it reads its revocation list again, and nobody knows why.
    #[test]
    fn point_6_only_regular_files_of_some_length_are_read_and_none_is_waited_for() {
        for (name, reader) in READERS {
            for (said, make) in UNFIT {
                let folder = tempfile::tempdir().unwrap();
                let at = folder.path().to_owned();
                if name == "root.key" {
                    let ids = crossguard_codec::Identifiers::default();
                    let pki = crate::pki::Pki::for_a_day(&ids, crate::pki::now()).unwrap();
                    pki.root.write(&at, "root").unwrap();
                    fs::remove_file(at.join("root.key")).unwrap();
                }
                make(&at.join(name));
                let (tell, told) = channel();
                std::thread::spawn(move || tell.send(reader(&at)));
                let told = told.recv_timeout(Duration::from_secs(30));
                let told = told.unwrap_or_else(|_| panic!("{name}: '{said}' is waited for"));
                let told = told.unwrap_or_else(|| panic!("{name}: '{said}' is read"));
                // Where a link is not followed at all, that is said; a counter and a key that are too long are none.
                let is_said = told.contains(said)
                    || name == "r.boot.lock"
                    || said == "octets" && (name == "r.boot" || name == "root.key");
                assert!(is_said, "{name}: {said}: {told}");
            }
        }
    }
}
