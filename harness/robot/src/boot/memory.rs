//! Memory of a robot that signs, besides its boot counter, in two files beside it.
//!
//! - `.secret` has what its pseudonyms are drawn with. It is made once, and only its owner can read it. With another
//!   one, a pseudonym that comes back might give out a session number twice; with one that others know, its pseudonyms
//!   tell that they are one robot.
//! - `.time` has a time that the robot will not have gone beyond before the file is written again. So a robot that
//!   lost power knows of no earlier time than it has had, and one that boots at once trusts its clock after
//!   [`AHEAD_US`] at the latest. The file is written once in so long. A robot that stops in order writes the time that
//!   it is.
//!
//! A clock that was far ahead by mistake leaves a time in the file that does not come for long. The robot then says
//! that it does not trust its clock, until somebody who knows what time it is deletes the file.

use std::fs::File;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

use crossguard_codec::security::{Time64, random_octets};
use crossguard_endpoint::station::Secret;

use super::{BootError, replace};
use crate::files;

/// How far ahead the time is kept, in µs, and how often at most it is written.
pub const AHEAD_US: u64 = 5_000_000;

/// First words of the files.
const SECRET: &str = "crossguard secret";
const TIME: &str = "crossguard time";

/// Data that outlive a boot besides the counter.
#[derive(Clone, Debug)]
pub struct Memory {
    /// What the robot draws its pseudonyms with.
    pub secret: Secret,
    /// A time that is not earlier than the newest that the robot has had before this boot.
    pub known: Time64,
    /// Where the time is kept; nowhere, for robots of which nothing outlives the process.
    path: Option<PathBuf>,
}

impl Memory {
    /// Memory of a robot of which nothing outlives the process.
    #[must_use]
    pub fn nowhere() -> Self {
        Self {
            secret: Secret::random(),
            known: Time64::default(),
            path: None,
        }
    }

    /// Memory beside this boot counter; missing files are made. Fails where a file cannot be read or made,
    /// or holds something else.
    pub(super) fn beside(counter: &Path) -> Result<Self, BootError> {
        let (secret, time) = (beside(counter, "secret"), beside(counter, "time"));
        Ok(Self {
            secret: read_secret(&secret)?,
            known: read_time(&time)?,
            path: Some(time),
        })
    }

    /// Writes that the robot will not have gone beyond this time.
    ///
    /// # Errors
    /// Errors of the file; it is then as it was.
    pub fn keep(&self, time: Time64) -> Result<(), BootError> {
        let Some(path) = &self.path else {
            return Ok(());
        };
        let text = format!("{TIME} {}\n", time.0);
        replace(path, &text).map_err(|cause| unusable(path, cause))
    }
}

fn beside(counter: &Path, extension: &str) -> PathBuf {
    counter.with_added_extension(extension)
}

/// Text behind the first words of a file of one line; `None` where there is no file.
fn read(path: &Path, begins: &str) -> Result<Option<String>, BootError> {
    let text = match files::text(path, 200) {
        Ok(text) => text,
        Err(missing) if missing.kind() == ErrorKind::NotFound => return Ok(None),
        Err(no_text) if no_text.kind() == ErrorKind::InvalidData => return Err(forgotten(path)),
        Err(cause) => return Err(unusable(path, cause)),
    };
    let line = text
        .strip_suffix('\n')
        .and_then(|line| line.strip_prefix(begins))
        .map(|rest| rest.trim().to_owned());
    line.map(Some).ok_or_else(|| forgotten(path))
}

fn unusable(path: &Path, cause: std::io::Error) -> BootError {
    BootError::Unusable {
        path: path.to_owned(),
        cause,
    }
}

fn forgotten(path: &Path) -> BootError {
    BootError::Forgotten {
        path: path.to_owned(),
    }
}

fn read_time(path: &Path) -> Result<Time64, BootError> {
    let Some(text) = read(path, TIME)? else {
        return Ok(Time64::default());
    };
    let time = text.parse().map_err(|_| forgotten(path))?;
    Ok(Time64(time))
}

fn read_secret(path: &Path) -> Result<Secret, BootError> {
    if let Some(text) = read(path, SECRET)? {
        let octets = hex::decode(text).ok();
        let octets = octets.and_then(|octets| octets.try_into().ok());
        return octets.map(Secret::new).ok_or_else(|| forgotten(path));
    }
    let octets = random_octets();
    let mut options = File::options();
    options.write(true).create_new(true);
    std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
    let mut file = options.open(path).map_err(|cause| unusable(path, cause))?;
    let line = format!("{SECRET} {}\n", hex::encode(octets));
    file.write_all(line.as_bytes())
        .and_then(|()| file.sync_all())
        .map_err(|cause| unusable(path, cause))?;
    Ok(Secret::new(octets))
}

#[cfg(test)]
mod tests {
    use std::fs;

    use crossguard_protocol::StationId;

    use super::*;

    fn counter() -> (tempfile::TempDir, PathBuf) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("robot.boot");
        (folder, path)
    }

    #[test]
    fn a_secret_is_made_once_and_is_its_owners() {
        let (_folder, counter) = counter();
        let epoch = |memory: &Memory| memory.secret.epoch(StationId(7), 1);
        let first = Memory::beside(&counter).unwrap();
        let again = Memory::beside(&counter).unwrap();
        assert_eq!(epoch(&first), epoch(&again));
        {
            use std::os::unix::fs::PermissionsExt;
            let metadata = fs::metadata(beside(&counter, "secret")).unwrap();
            assert_eq!(metadata.permissions().mode() & 0o777, 0o600);
        }
    }

    #[test]
    fn the_time_outlives_a_crash() {
        let (_folder, counter) = counter();
        let memory = Memory::beside(&counter).unwrap();
        assert_eq!(memory.known, Time64(0));
        for time in [Time64(100), Time64(100 + AHEAD_US)] {
            memory.keep(time).unwrap();
            assert_eq!(Memory::beside(&counter).unwrap().known, time);
        }
        assert_eq!(Memory::nowhere().known, Time64(0));
    }

    #[test]
    fn a_file_that_holds_something_else_is_named_and_left_as_it_is() {
        let (_folder, counter) = counter();
        for (extension, text) in [
            ("time", "crossguard time x\n"),
            ("time", "crossguard time 5"),
            ("time", ""),
            ("secret", "crossguard secret 00\n"),
            ("secret", "\n"),
        ] {
            let path = beside(&counter, extension);
            fs::write(&path, text).unwrap();
            let error = Memory::beside(&counter).unwrap_err().to_string();
            assert!(error.contains("delete it"), "{error}");
            assert_eq!(fs::read_to_string(&path).unwrap(), text);
            fs::remove_file(&path).unwrap();
        }
    }
}
