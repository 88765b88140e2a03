//! A PKI for tests, in memory and in folders: a root, an authority, and pseudonyms.
//!
//! ```text
//!  FOLDER/root.cert  root.key  authority.cert  authority.key
//!        /robots/NAME/root.cert  authority.cert
//!                    /tickets/HASHEDID8.cert  HASHEDID8.key
//! ```
//!
//! The folder of a robot is all that the robot needs: the certificates that it trusts and its own
//! pseudonyms. Certificates are in COER, private keys in PEM (PKCS #8), which only their owner can read.
//! Keys of authorities that matter belong in other places than files.

use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};

use crossguard_codec::security::issue::{self, IssueError, Terms};
use crossguard_codec::security::{
    Certificate, Duration, IssuePermission, Issuer, NoKey, Permission, PrivateKey, Region,
    Rejected, SspRange, Subjects, Ticket, Time64, TrustStore, Unsigned, Untrusted, Validity,
};
use crossguard_codec::si::timestamp_its;
use crossguard_codec::{Identifiers, Part};
use crossguard_protocol::StationId;

use crossguard_endpoint::station::Credentials;

mod permissions;

pub use permissions::{its_aids, robot_permissions};

/// How long before its time a certificate begins to be valid, in seconds: clocks differ.
pub const EARLY_S: u64 = 60;

/// What time it is on the scale of certificates, by the system's clock.
#[must_use]
pub fn now() -> Time64 {
    let unix = SystemTime::now()
        .duration_since(UNIX_EPOCH)
        .unwrap_or_default();
    let unix_ms = i64::try_from(unix.as_millis()).unwrap_or(i64::MAX);
    Time64::of_timestamp_its(timestamp_its(unix_ms))
}

/// A certificate and its key.
#[derive(Clone, Debug)]
pub struct Holder {
    /// The certificate.
    pub certificate: Certificate,
    /// Its key.
    pub key: PrivateKey,
}

/// A root and an authority below it.
#[derive(Clone, Debug)]
pub struct Pki {
    /// The root.
    pub root: Holder,
    /// The authority, which issues pseudonyms.
    pub authority: Holder,
}

/// When a certificate is valid.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Term {
    /// From when on.
    pub from: Time64,
    /// For how long.
    pub duration: Duration,
}

impl Term {
    fn validity(self) -> Validity {
        let seconds = (self.from.0 / 1_000_000).saturating_sub(EARLY_S);
        Validity {
            start: u32::try_from(seconds).unwrap_or(u32::MAX),
            duration: self.duration,
        }
    }
}

fn issues(its_aids: &[u32], min_chain_length: i8) -> Vec<IssuePermission> {
    let these = its_aids.iter().map(|its_aid| (*its_aid, SspRange::All));
    vec![IssuePermission {
        subjects: Subjects::These(these.collect()),
        min_chain_length,
        chain_length_range: 0,
        for_applications: true,
    }]
}

/// A new root, which lets authorities issue pseudonyms for these services.
///
/// # Errors
/// Why there can be none.
pub fn new_root(
    name: &str,
    term: Term,
    region: Option<Region>,
    its_aids: &[u32],
) -> Result<Holder, IssueError> {
    root_with(PrivateKey::generate(), name, term, region, its_aids)
}

fn root_with(
    key: PrivateKey,
    name: &str,
    term: Term,
    region: Option<Region>,
    its_aids: &[u32],
) -> Result<Holder, IssueError> {
    let terms = Terms {
        name: Some(name.to_owned()),
        validity: term.validity(),
        region,
        permissions: Vec::new(),
        issue_permissions: issues(its_aids, 2),
    };
    let certificate = issue::root(&key, &terms)?;
    Ok(Holder { certificate, key })
}

/// A new authority below a root, which issues pseudonyms for these services.
///
/// # Errors
/// Why the root cannot have it.
pub fn new_authority(
    root: &Holder,
    name: &str,
    term: Term,
    region: Option<Region>,
    its_aids: &[u32],
) -> Result<Holder, IssueError> {
    let key = PrivateKey::generate();
    authority_with(key, root, name, term, region, its_aids)
}

fn authority_with(
    key: PrivateKey,
    root: &Holder,
    name: &str,
    term: Term,
    region: Option<Region>,
    its_aids: &[u32],
) -> Result<Holder, IssueError> {
    let terms = Terms {
        name: Some(name.to_owned()),
        validity: term.validity(),
        region,
        permissions: Vec::new(),
        issue_permissions: issues(its_aids, 1),
    };
    let certificate = issue::authority(&root.certificate, &root.key, key.public_key(), &terms)?;
    Ok(Holder { certificate, key })
}

/// A new pseudonym.
///
/// # Errors
/// Why the authority cannot give it.
pub fn new_ticket(
    authority: &Holder,
    term: Term,
    region: Option<Region>,
    permissions: Vec<Permission>,
) -> Result<Holder, IssueError> {
    ticket_with(PrivateKey::generate(), authority, term, region, permissions)
}

fn ticket_with(
    key: PrivateKey,
    authority: &Holder,
    term: Term,
    region: Option<Region>,
    permissions: Vec<Permission>,
) -> Result<Holder, IssueError> {
    let terms = Terms {
        name: None,
        validity: term.validity(),
        region,
        permissions,
        issue_permissions: Vec::new(),
    };
    let holder = key.public_key();
    let certificate = issue::ticket(&authority.certificate, &authority.key, holder, &terms)?;
    Ok(Holder { certificate, key })
}

impl Pki {
    /// A PKI for a day, for the services with these identifiers, that is not kept anywhere.
    ///
    /// # Errors
    /// None that is to be expected.
    pub fn for_a_day(identifiers: &Identifiers, now: Time64) -> Result<Self, IssueError> {
        Self::with_keys(identifiers, now, &mut PrivateKey::generate)
    }

    /// [`for_a_day`](Self::for_a_day) with these keys, for runs that repeat.
    ///
    /// # Errors
    /// None that is to be expected.
    pub fn with_keys(
        identifiers: &Identifiers,
        now: Time64,
        keys: &mut dyn FnMut() -> PrivateKey,
    ) -> Result<Self, IssueError> {
        let term = Term {
            from: now,
            duration: Duration::hours(24),
        };
        let its_aids = its_aids(identifiers);
        let root = root_with(keys(), "test root", term, None, &its_aids)?;
        let name = "test authority";
        let authority = authority_with(keys(), &root, name, term, None, &its_aids)?;
        Ok(Self { root, authority })
    }

    /// The certificates that a robot of this PKI trusts.
    ///
    /// # Errors
    /// Why nobody can trust it.
    pub fn trust(&self) -> Result<TrustStore, Untrusted> {
        let mut trust = TrustStore::default();
        trust.add_root(self.root.certificate.clone())?;
        trust.add_authority(self.authority.certificate.clone())?;
        Ok(trust)
    }

    /// What a robot with this many pseudonyms for a day needs. The first one names this station id, if there is one.
    ///
    /// # Errors
    /// None that is to be expected.
    pub fn credentials(
        &self,
        identifiers: &Identifiers,
        (tickets, named): (usize, Option<StationId>),
        now: Time64,
    ) -> Result<Credentials, PkiError> {
        let keys = &mut PrivateKey::generate;
        self.credentials_with_keys(identifiers, (tickets, named), now, keys)
    }

    /// [`credentials`](Self::credentials) with these keys, for runs that repeat.
    ///
    /// # Errors
    /// None that is to be expected.
    pub fn credentials_with_keys(
        &self,
        identifiers: &Identifiers,
        (tickets, named): (usize, Option<StationId>),
        now: Time64,
        keys: &mut dyn FnMut() -> PrivateKey,
    ) -> Result<Credentials, PkiError> {
        let term = Term {
            from: now,
            duration: Duration::hours(23),
        };
        let ticket = |nth| {
            let named = named.filter(|_| nth == 0);
            let permissions = robot_permissions(identifiers, &[Part::Lead, Part::Help], named);
            let Holder { certificate, key } =
                ticket_with(keys(), &self.authority, term, None, permissions)?;
            Ok(Ticket::new(certificate, key)?)
        };
        Ok(Credentials {
            trust: self.trust()?,
            tickets: (0..tickets).map(ticket).collect::<Result<_, PkiError>>()?,
        })
    }
}

/// Why a PKI cannot be made, written or read.
#[derive(Debug, thiserror::Error)]
pub enum PkiError {
    /// A file cannot be read or written.
    #[error("{}: {cause}", path.display())]
    File {
        /// The file or folder.
        path: PathBuf,
        /// Why.
        cause: io::Error,
    },
    /// A file would be overwritten.
    #[error("{} exists; keys and certificates are not overwritten, name another folder", .0.display())]
    Exists(PathBuf),
    /// A private key that others can read.
    #[error("{} can be read by others than its owner; 'chmod 600' it, and better replace it", .0.display())]
    KeyIsOpen(PathBuf),
    /// A file is no certificate that is taken.
    #[error("{}: {cause}", path.display())]
    Certificate {
        /// The file.
        path: PathBuf,
        /// Why.
        cause: Rejected,
    },
    /// A file holds no key.
    #[error("{}: {cause}", path.display())]
    Key {
        /// The file.
        path: PathBuf,
        /// Why.
        cause: NoKey,
    },
    /// A certificate cannot be trusted.
    #[error("{0}")]
    Untrusted(#[from] Untrusted),
    /// A pseudonym cannot be used.
    #[error("{0}")]
    Unsigned(#[from] Unsigned),
    /// A certificate cannot be issued.
    #[error("{0}")]
    Issue(#[from] IssueError),
    /// A folder has no pseudonyms.
    #[error(
        "{} is no robot's folder of a PKI: there are no tickets in it; 'crossguard pki tickets' makes them",
        .0.display()
    )]
    NoTickets(PathBuf),
}

fn at(path: &Path) -> impl FnOnce(io::Error) -> PkiError {
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
        fs::create_dir_all(folder).map_err(at(folder))?;
        let path = folder.join(format!("{name}.key"));
        let pem = self.key.to_pem().map_err(|cause| PkiError::Key {
            path: path.clone(),
            cause,
        })?;
        let mut options = OpenOptions::new();
        options.write(true).create_new(true);
        #[cfg(unix)]
        std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
        let mut file = options.open(&path).map_err(at(&path))?;
        file.write_all(pem.as_ref().as_bytes()).map_err(at(&path))?;
        write_certificate(&self.certificate, folder, name)
    }

    /// Reads certificate and key from `folder/name.cert` and `.key`.
    ///
    /// # Errors
    /// When one of them cannot be read, or the key can be read by others.
    pub fn read(folder: &Path, name: &str) -> Result<Self, PkiError> {
        let certificate = read_certificate(&folder.join(format!("{name}.cert")))?;
        let path = folder.join(format!("{name}.key"));
        check_private(&path)?;
        let pem = fs::read_to_string(&path).map_err(at(&path))?;
        let key = PrivateKey::of_pem(&pem).map_err(|cause| PkiError::Key { path, cause })?;
        Ok(Self { certificate, key })
    }
}

#[cfg(unix)]
fn check_private(key: &Path) -> Result<(), PkiError> {
    let metadata = fs::metadata(key).map_err(at(key))?;
    let mode = std::os::unix::fs::PermissionsExt::mode(&metadata.permissions());
    #[expect(clippy::verbose_bit_mask, reason = "permissions are read in octal")]
    let is_private = mode & 0o077 == 0;
    if is_private {
        Ok(())
    } else {
        Err(PkiError::KeyIsOpen(key.to_owned()))
    }
}

#[cfg(not(unix))]
fn check_private(_: &Path) -> Result<(), PkiError> {
    Ok(())
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
    if fs::read(&path).is_ok_and(|octets| octets == certificate.octets()) {
        return Ok(());
    }
    let file = OpenOptions::new().write(true).create_new(true).open(&path);
    let written = file.and_then(|mut file| file.write_all(certificate.octets()));
    written.map_err(at(&path))
}

/// Reads a certificate.
///
/// # Errors
/// When it cannot be read, or is none.
pub fn read_certificate(path: &Path) -> Result<Certificate, PkiError> {
    let octets = fs::read(path).map_err(at(path))?;
    Certificate::decode(&octets).map_err(|cause| PkiError::Certificate {
        path: path.to_owned(),
        cause,
    })
}

/// The folder of a robot in that of a PKI.
#[must_use]
pub fn robot_folder(pki: &Path, robot: &str) -> PathBuf {
    pki.join("robots").join(robot)
}

/// Writes a pseudonym to a robot's folder.
///
/// # Errors
/// When it cannot be written.
pub fn write_ticket(ticket: &Holder, folder: &Path) -> Result<(), PkiError> {
    ticket.write(
        &folder.join("tickets"),
        &ticket.certificate.id().to_string(),
    )
}

/// Whom a folder with certificates says to trust, that of a PKI or of a robot: its roots, and the authorities
/// that they vouch for.
///
/// # Errors
/// What is wrong with which file.
pub fn read_trust(folder: &Path) -> Result<TrustStore, PkiError> {
    let mut trust = TrustStore::default();
    let certificates: Vec<_> = certificates_in(folder)?
        .iter()
        .map(|path| read_certificate(path))
        .collect::<Result<_, _>>()?;
    let (roots, others): (Vec<_>, Vec<_>) = certificates
        .into_iter()
        .partition(|certificate| certificate.content().issuer == Issuer::Itself);
    roots
        .into_iter()
        .try_for_each(|root| trust.add_root(root))?;
    others
        .into_iter()
        .try_for_each(|authority| trust.add_authority(authority))?;
    Ok(trust)
}

/// What a robot needs, from its folder.
///
/// # Errors
/// What is wrong with which file.
pub fn read_credentials(folder: &Path) -> Result<Credentials, PkiError> {
    let trust = read_trust(folder)?;
    let folder_of_tickets = folder.join("tickets");
    let paths =
        certificates_in(&folder_of_tickets).map_err(|_| PkiError::NoTickets(folder.to_owned()))?;
    let ticket = |path: &PathBuf| {
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        let Holder { certificate, key } = Holder::read(&folder_of_tickets, &name)?;
        Ok(Ticket::new(certificate, key)?)
    };
    let tickets: Vec<_> = paths.iter().map(ticket).collect::<Result<_, PkiError>>()?;
    if tickets.is_empty() {
        return Err(PkiError::NoTickets(folder.to_owned()));
    }
    Ok(Credentials { trust, tickets })
}

/// What the robot of this name signs with, from its own folder or from that of a PKI.
///
/// # Errors
/// Those of [`read_credentials`].
pub fn credentials_of(folder: &Path, robot: &str) -> Result<Credentials, PkiError> {
    let of_robot = robot_folder(folder, robot);
    let is_pki = folder.join("robots").is_dir();
    read_credentials(if is_pki { &of_robot } else { folder })
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
    use crossguard_endpoint::station::{Mode, Security};

    use super::*;

    fn written() -> (tempfile::TempDir, PathBuf) {
        let folder = tempfile::tempdir().unwrap();
        let identifiers = Identifiers::default();
        let pki = Pki::for_a_day(&identifiers, now()).unwrap();
        pki.root.write(folder.path(), "root").unwrap();
        let robot = robot_folder(folder.path(), "Go2");
        let term = Term {
            from: now(),
            duration: Duration::hours(1),
        };
        let permissions = robot_permissions(&identifiers, &[Part::Help], None);
        let ticket = new_ticket(&pki.authority, term, None, permissions).unwrap();
        write_ticket(&ticket, &robot).unwrap();
        write_certificate(&pki.root.certificate, &robot, "root").unwrap();
        write_certificate(&pki.authority.certificate, &robot, "authority").unwrap();
        (folder, robot)
    }

    #[test]
    fn a_robots_folder_is_all_it_needs() {
        let (_folder, robot) = written();
        let credentials = read_credentials(&robot).unwrap();
        assert_eq!(credentials.tickets.len(), 1);
        assert_eq!(credentials.trust.authorities().len(), 1);
        assert!(Security::new(Mode::Enforce, credentials, None, now()).is_ok());
    }

    #[test]
    fn nothing_is_overwritten() {
        let (folder, _robot) = written();
        let other = Pki::for_a_day(&Identifiers::default(), now()).unwrap();
        let error = other.root.write(folder.path(), "root").unwrap_err();
        assert!(matches!(error, PkiError::Exists(_)), "{error}");
    }

    #[cfg(unix)]
    #[test]
    fn keys_are_private_and_have_to_be() {
        use std::os::unix::fs::PermissionsExt;
        let (folder, _robot) = written();
        let key = folder.path().join("root.key");
        let mode = fs::metadata(&key).unwrap().permissions().mode();
        assert_eq!(mode & 0o777, 0o600);
        fs::set_permissions(&key, fs::Permissions::from_mode(0o644)).unwrap();
        let error = Holder::read(folder.path(), "root").unwrap_err();
        assert!(matches!(error, PkiError::KeyIsOpen(_)), "{error}");
    }
}
