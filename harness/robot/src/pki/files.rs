//! Certificates and keys in files. A file is whole on the disk before it has its name. A key is read only
//! where nobody else can read or replace it, and its text is wiped from memory.

use std::fs::{self, DirBuilder, File, Metadata, Permissions};
use std::io::{self, Read, Write};
use std::os::unix::fs::{DirBuilderExt as _, MetadataExt as _, PermissionsExt as _};
use std::path::{Path, PathBuf};

use crossguard_codec::security::{Certificate, NoKey, PrivateKey};
use zeroize::Zeroizing;

use super::{Holder, PkiError};
use crate::files;

/// How long the file of a key may be, in octets; those of NIST P-256 take 241.
const KEY_LEN_MAX: u64 = 4_096;

/// How long that of a certificate may be, in octets; those of the kit take some 200.
const CERTIFICATE_LEN_MAX: u64 = 65_536;

pub(super) fn at(path: &Path) -> impl FnOnce(io::Error) -> PkiError {
    let path = path.to_owned();
    move |cause| match cause.kind() {
        io::ErrorKind::AlreadyExists => PkiError::Exists(path),
        _ => PkiError::File { path, cause },
    }
}

impl Holder {
    /// Writes certificate and key to `folder/name.cert` and `.key`, the key for its owner only.
    ///
    /// # Errors
    /// When one of the files exists, or cannot be written.
    pub fn write(&self, folder: &Path, name: &str) -> Result<(), PkiError> {
        write_key(&self.key, folder, name)?;
        write_certificate(&self.certificate, folder, name)
    }

    /// Reads certificate and key from `folder/name.cert` and `.key`.
    ///
    /// # Errors
    /// When one of them cannot be read, or others can read or replace the key.
    pub fn read(folder: &Path, name: &str) -> Result<Self, PkiError> {
        let certificate = read_certificate(&folder.join(format!("{name}.cert")))?;
        let path = folder.join(format!("{name}.key"));
        let key = read_key(&path)?;
        Ok(Self { certificate, key })
    }
}

/// Writes a key to `folder/name.key`, for its owner only.
///
/// # Errors
/// When the file exists, or cannot be written.
pub fn write_key(key: &PrivateKey, folder: &Path, name: &str) -> Result<(), PkiError> {
    make_folder(folder).map_err(at(folder))?;
    let path = folder.join(format!("{name}.key"));
    let pem = key.to_pem().map_err(|cause| PkiError::Key {
        path: path.clone(),
        cause,
    })?;
    create(&path, pem.as_ref().as_bytes(), 0o600).map_err(at(&path))
}

/// Reads a key. Its permissions are asked of the open file, so that it is not exchanged in between.
fn read_key(path: &Path) -> Result<PrivateKey, PkiError> {
    let (file, metadata) = files::open(path).map_err(at(path))?;
    check_private(path, &metadata)?;
    // With room for all of it, the text is never moved, which would leave a copy behind.
    let room = usize::try_from(KEY_LEN_MAX).unwrap_or_default() + 1;
    let mut pem = Zeroizing::new(String::with_capacity(room));
    let read = file.take(KEY_LEN_MAX).read_to_string(&mut pem);
    let key = match read {
        Ok(_) => PrivateKey::of_pem(&pem),
        Err(cause) if cause.kind() == io::ErrorKind::InvalidData => Err(NoKey),
        Err(cause) => return Err(at(path)(cause)),
    };
    key.map_err(|cause| PkiError::Key {
        path: path.to_owned(),
        cause,
    })
}

/// Whether this user alone can read a key, and replace it.
fn check_private(path: &Path, metadata: &Metadata) -> Result<(), PkiError> {
    let (owner, user) = (metadata.uid(), nix::unistd::geteuid().as_raw());
    if owner != user {
        return Err(PkiError::KeyOfAnother {
            path: path.to_owned(),
            owner,
            user,
        });
    }
    if metadata.mode() & 0o077 != 0 {
        return Err(PkiError::KeyIsOpen(path.to_owned()));
    }
    let folder = folder_of(path);
    check_unchangeable(folder, &fs::metadata(folder).map_err(at(folder))?)
}

/// Whether nobody but this user and root can change a file, or what is in a folder. In a folder with the sticky bit,
/// others cannot replace what they do not own.
pub(super) fn check_unchangeable(path: &Path, metadata: &Metadata) -> Result<(), PkiError> {
    let is_of_this_user = [nix::unistd::geteuid().as_raw(), 0].contains(&metadata.uid());
    let is_sticky = metadata.is_dir() && metadata.mode() & 0o1000 != 0;
    let is_open = metadata.mode() & 0o022 != 0 && !is_sticky;
    if is_of_this_user && !is_open {
        Ok(())
    } else {
        Err(PkiError::CanBeReplaced(path.to_owned()))
    }
}

fn folder_of(path: &Path) -> &Path {
    let folder = path.parent();
    let folder = folder.filter(|folder| !folder.as_os_str().is_empty());
    folder.unwrap_or(Path::new("."))
}

/// Makes a folder, and those above it, in which only this user can write.
fn make_folder(folder: &Path) -> io::Result<()> {
    if folder.is_dir() {
        return Ok(());
    }
    let mut builder = DirBuilder::new();
    builder.recursive(true).mode(0o755).create(folder)?;
    sync_folder(folder_of(folder))
}

/// Writes a file that is not there yet. At any moment it is whole on the disk, or has not its name.
fn create(path: &Path, octets: &[u8], mode: u32) -> io::Result<()> {
    let new = unnamed(path, octets, mode)?;
    new.persist_noclobber(path).map_err(|error| error.error)?;
    sync_folder(folder_of(path))
}

/// The same for one that may be there, in whose place it comes.
pub(super) fn replace(path: &Path, octets: &[u8]) -> io::Result<()> {
    let new = unnamed(path, octets, 0o644)?;
    new.persist(path).map_err(|error| error.error)?;
    sync_folder(folder_of(path))
}

/// A file beside the path with this content, which is on the disk.
pub(crate) fn unnamed(
    path: &Path,
    octets: &[u8],
    mode: u32,
) -> io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".").suffix(".new");
    builder.permissions(Permissions::from_mode(mode));
    let mut new = builder.tempfile_in(folder_of(path))?;
    new.write_all(octets)?;
    new.as_file().sync_all()?;
    Ok(new)
}

/// Has the names in a folder be on the disk.
///
/// # Errors
/// When the disk cannot.
pub fn sync_folder(folder: &Path) -> io::Result<()> {
    File::open(folder)?.sync_all()
}

/// Writes a certificate to `folder/name.cert`.
///
/// # Errors
/// When the file exists with other content, or cannot be written.
pub fn write_certificate(
    certificate: &Certificate,
    folder: &Path,
    name: &str,
) -> Result<(), PkiError> {
    let path = folder.join(format!("{name}.cert"));
    if files::read(&path, CERTIFICATE_LEN_MAX).is_ok_and(|octets| octets == certificate.octets()) {
        return Ok(());
    }
    create(&path, certificate.octets(), 0o644).map_err(at(&path))
}

/// Reads a certificate.
///
/// # Errors
/// When it cannot be read, or is none.
pub fn read_certificate(path: &Path) -> Result<Certificate, PkiError> {
    let octets = files::read(path, CERTIFICATE_LEN_MAX).map_err(at(path))?;
    Certificate::decode(&octets).map_err(|cause| PkiError::Certificate {
        path: path.to_owned(),
        cause,
    })
}

/// The certificates in a folder, by name.
///
/// # Errors
/// When it cannot be read.
pub fn certificates_in(folder: &Path) -> Result<Vec<PathBuf>, PkiError> {
    paths_in(folder, |path| {
        path.extension()
            .is_some_and(|extension| extension == "cert")
    })
}

/// The folders in a folder, by name.
///
/// # Errors
/// When it cannot be read.
pub fn folders_in(folder: &Path) -> Result<Vec<PathBuf>, PkiError> {
    paths_in(folder, Path::is_dir)
}

fn paths_in(folder: &Path, wanted: impl Fn(&Path) -> bool) -> Result<Vec<PathBuf>, PkiError> {
    let mut paths = Vec::new();
    for entry in fs::read_dir(folder).map_err(at(folder))? {
        let path = entry.map_err(at(folder))?.path();
        if wanted(&path) {
            paths.push(path);
        }
    }
    paths.sort();
    Ok(paths)
}

#[cfg(test)]
mod tests {
    use crossguard_codec::Identifiers;

    use super::super::{Pki, now};
    use super::*;

    fn written() -> (tempfile::TempDir, PathBuf) {
        let folder = tempfile::tempdir().unwrap();
        let pki = Pki::for_a_day(&Identifiers::default(), now()).unwrap();
        let inside = folder.path().join("pki");
        pki.root.write(&inside, "root").unwrap();
        (folder, inside)
    }

    #[test]
    fn what_is_too_long_or_no_text_is_no_key() {
        let (_folder, pki) = written();
        let key = pki.join("root.key");
        let pem = fs::read(&key).unwrap();
        for wrong in [
            &[0xff; 300][..],
            &[b'-'; 10_000],
            &pem[..pem.len() / 2],
            b"",
        ] {
            fs::write(&key, wrong).unwrap();
            let error = Holder::read(&pki, "root").unwrap_err();
            assert!(matches!(error, PkiError::Key { .. }), "{error}");
        }
        fs::write(&key, pem).unwrap();
        assert!(Holder::read(&pki, "root").is_ok());
    }

    #[test]
    fn a_key_that_power_left_half_written_has_not_its_name() {
        let (_folder, pki) = written();
        // A crash leaves a file with the name that it had until then.
        fs::write(pki.join(".abc.new"), "-----BEGIN PRIVATE").unwrap();
        assert!(Holder::read(&pki, "root").is_ok());
        assert_eq!(certificates_in(&pki).unwrap().len(), 1);
    }

    #[test]
    fn keys_are_private_and_have_to_be() {
        let (_folder, pki) = written();
        let key = pki.join("root.key");
        let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode() & 0o7777;
        let set = |path: &Path, mode| {
            fs::set_permissions(path, Permissions::from_mode(mode)).unwrap();
        };
        assert_eq!(mode(&key), 0o600);
        assert_eq!(mode(&pki.join("root.cert")), 0o644);
        assert_eq!(mode(&pki) & 0o022, 0, "only this user puts keys there");
        for open in [0o644, 0o640, 0o602] {
            set(&key, open);
            let error = Holder::read(&pki, "root").unwrap_err();
            assert!(matches!(error, PkiError::KeyIsOpen(_)), "{error}");
        }
        set(&key, 0o400);
        assert!(Holder::read(&pki, "root").is_ok());
        for open in [0o770, 0o707, 0o777] {
            set(&pki, open);
            let error = Holder::read(&pki, "root").unwrap_err();
            assert!(matches!(error, PkiError::CanBeReplaced(_)), "{error}");
        }
        set(&pki, 0o1777);
        assert!(Holder::read(&pki, "root").is_ok(), "as in /tmp");
    }

    /// Only root can give files away; others are told that this was not tried.
    #[test]
    fn a_key_of_somebody_else_is_refused() {
        use std::os::unix::fs::chown;
        if !nix::unistd::geteuid().is_root() {
            println!("SKIPPED a_key_of_somebody_else_is_refused: it takes root");
            return;
        }
        let (_folder, pki) = written();
        let key = pki.join("root.key");
        chown(&key, Some(12_345), None).unwrap();
        let error = Holder::read(&pki, "root").unwrap_err().to_string();
        assert!(error.contains("belongs to user 12345"), "{error}");
        assert!(error.contains("'chown 0' it"), "{error}");
        chown(&key, Some(0), None).unwrap();
        chown(&pki, Some(12_345), None).unwrap();
        let error = Holder::read(&pki, "root").unwrap_err();
        assert!(matches!(error, PkiError::CanBeReplaced(_)), "{error}");
    }
}
