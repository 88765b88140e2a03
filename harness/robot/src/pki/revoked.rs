//! Revocation lists: text files with a certificate on each line, by its `HashedId8` in hexadecimal digits.
//!
//! ```text
//!  # Go2 was stolen on 2026-11-20
//!  0f2c5e7a9b1d3f48
//! ```
//!
//! A list is for one operator's robots. It is not signed: who can write to it decides, so it is refused where others
//! than its owner can. Replace it by renaming another file to its name, as [`add_revoked`] does: a list that is read
//! while it is written is not all there.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::fs;
use std::io;
use std::os::unix::fs::MetadataExt as _;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use crossguard_codec::security::HashedId8;

use super::PkiError;
use super::files::{at, check_unchangeable, replace};
use crate::files;

/// The name of the list in the folder of a PKI.
pub const REVOKED_LIST: &str = "revoked.txt";

/// How long a list may be, in octets: some 60,000 certificates.
const LEN_MAX: u64 = 1 << 20;

/// A list, and how its file was when it was read.
#[derive(Clone, Debug)]
pub struct RevokedList {
    path: PathBuf,
    /// `None` for a file that is not there.
    seen: Option<Stamp>,
}

/// By what a file that has changed is noticed.
type Stamp = (Option<SystemTime>, u64, u64);

impl RevokedList {
    /// The list in this file, which is not read yet.
    #[must_use]
    pub const fn new(path: PathBuf) -> Self {
        Self { path, seen: None }
    }

    /// The certificates on the list.
    ///
    /// # Errors
    /// When the file cannot be read, others can change it, or a line names no certificate.
    pub fn read(&mut self) -> Result<BTreeSet<HashedId8>, PkiError> {
        // One that changes after this is read again.
        self.seen = self.stamp();
        let path = &self.path;
        let (file, metadata) = files::open(path).map_err(at(path))?;
        check_unchangeable(path, &metadata)?;
        let text = files::rest(file, LEN_MAX).and_then(files::text_of);
        parse(path, &text.map_err(at(path))?)
    }

    /// The certificates on it, if the file is another one than when it was read the last time, or is gone. A fault of
    /// one file is told once.
    pub fn read_if_changed(&mut self) -> Option<Result<BTreeSet<HashedId8>, PkiError>> {
        (self.stamp() != self.seen).then(|| self.read())
    }

    fn stamp(&self) -> Option<Stamp> {
        let metadata = fs::metadata(&self.path).ok()?;
        Some((metadata.modified().ok(), metadata.len(), metadata.ino()))
    }
}

fn parse(path: &Path, text: &str) -> Result<BTreeSet<HashedId8>, PkiError> {
    let lines = text.lines().enumerate();
    let entries = lines.map(|(at, line)| (at, line.split('#').next().unwrap_or_default().trim()));
    let entries = entries.filter(|(_, entry)| !entry.is_empty());
    let ids = entries.map(|(at, entry)| {
        entry.parse().map_err(|cause| PkiError::Revoked {
            path: path.to_owned(),
            line: at + 1,
            found: entry.chars().take(40).collect(),
            cause,
        })
    });
    ids.collect()
}

/// Adds certificates to a list, which is made if need be. Its entries stay as they are.
///
/// # Errors
/// When the list cannot be read or written.
pub fn add_revoked(path: &Path, ids: &[HashedId8]) -> Result<(), PkiError> {
    let mut text = match files::text(path, LEN_MAX) {
        Err(cause) if cause.kind() == io::ErrorKind::NotFound => String::new(),
        read => read.map_err(at(path))?,
    };
    let there = parse(path, &text)?;
    if !text.is_empty() && !text.ends_with('\n') {
        text.push('\n');
    }
    for id in ids.iter().filter(|id| !there.contains(id)) {
        let _ = writeln!(text, "{id}");
    }
    replace(path, text.as_bytes()).map_err(at(path))
}

#[cfg(test)]
mod tests {
    use nix::sys::stat::Mode;
    use nix::unistd::mkfifo;

    use super::*;

    const ONE: HashedId8 = HashedId8([0x0f, 0x2c, 0x5e, 0x7a, 0x9b, 0x1d, 0x3f, 0x48]);
    const OTHER: HashedId8 = HashedId8([1; 8]);

    #[test]
    fn a_list_is_read_again_only_when_it_has_changed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("revoked.txt");
        let mut list = RevokedList::new(path.clone());
        assert!(list.read().is_err(), "a list that is not there is no list");
        add_revoked(&path, &[ONE]).unwrap();
        assert_eq!(list.read().unwrap(), BTreeSet::from([ONE]));
        assert!(list.read_if_changed().is_none());
        add_revoked(&path, &[ONE, OTHER]).unwrap();
        let both = BTreeSet::from([ONE, OTHER]);
        assert_eq!(list.read_if_changed().unwrap().unwrap(), both);
        assert!(list.read_if_changed().is_none());
        fs::remove_file(&path).unwrap();
        assert!(list.read_if_changed().unwrap().is_err());
        assert!(list.read_if_changed().is_none(), "said once");
        mkfifo(&path, Mode::S_IRUSR).unwrap();
        assert!(list.read_if_changed().unwrap().is_err(), "not waited for");
        assert!(list.read_if_changed().is_none(), "said once");
        assert!(add_revoked(&path, &[OTHER]).is_err(), "nor written over");
        fs::remove_file(&path).unwrap();
        add_revoked(&path, &[OTHER]).unwrap();
        let other = BTreeSet::from([OTHER]);
        assert_eq!(list.read_if_changed().unwrap().unwrap(), other);
    }

    #[test]
    fn comments_are_left_and_other_lines_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("revoked.txt");
        let text = "# stolen\n\n0F2c5e7a9b1d3f48 # Go2";
        fs::write(&path, text).unwrap();
        add_revoked(&path, &[ONE, OTHER]).unwrap();
        let after = fs::read_to_string(&path).unwrap();
        assert_eq!(after, format!("{text}\n0101010101010101\n"));
        for (wrong, line) in [
            ("xyz", 1),
            ("\n0f2c5e7a9b1d3f4", 2),
            ("+f2c5e7a9b1d3f48", 1),
        ] {
            fs::write(&path, wrong).unwrap();
            let error = RevokedList::new(path.clone()).read().unwrap_err();
            assert!(
                error.to_string().contains(&format!("revoked.txt:{line}: ")),
                "{error}"
            );
        }
    }

    #[test]
    fn a_list_that_others_can_write_to_is_refused() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("revoked.txt");
        add_revoked(&path, &[ONE]).unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o666)).unwrap();
        let error = RevokedList::new(path).read().unwrap_err();
        assert!(matches!(error, PkiError::CanBeReplaced(_)), "{error}");
    }
}
