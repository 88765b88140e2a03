//! A PKI for tests, in memory and in folders: a root, an authority, and pseudonyms.
//!
//! ```text
//!  FOLDER/root.cert  root.key  authority.cert  authority.key  authority-encryption.key
//!        /robots/NAME/root.cert  authority.cert
//!                    /tickets/HASHEDID8.cert  HASHEDID8.key
//! ```
//!
//! The folder of a robot is all that the robot needs: the certificates that it trusts and its own
//! pseudonyms. Certificates are in COER, private keys in PEM (PKCS #8), which only their owner can read, and which are
//! refused where others can. Keys of authorities that matter belong in other places than files:
//! [`SigningKey`](crossguard_codec::security::SigningKey).

use std::io;
use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};

use crossguard_codec::security::issue::{self, IssueError, Terms};
use crossguard_codec::security::{
    Certificate, Duration, IssuePermission, Issuer, NoHashedId8, NoKey, Permission, PrivateKey,
    PublicKey, Region, Rejected, Ssp, SspRange, Subjects, Ticket, Time64, TrustStore, Unsigned,
    Untrusted, Validity,
};
use crossguard_codec::si::timestamp_its;
use crossguard_codec::{Identifiers, Part};
use crossguard_protocol::StationId;

use crossguard_endpoint::station::Credentials;

mod files;
mod permissions;
mod revoked;
mod starts;

pub use files::{
    certificates_in, folders_in, read_certificate, sync_folder, write_certificate, write_key,
};
pub use revoked::{REVOKED_LIST, RevokedList, add_revoked};

pub use permissions::{its_aids, robot_permissions};
pub use starts::{drawn_start, early_us};

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

/// The ITS-AIDs of what roots and authorities sign besides certificates, with the permissions that TS 102 941 v2.2.1,
/// annex B, gives them: revocation lists; trust lists of authorities and distribution centres; requests for the
/// validation of an authorization, and responses to requests for one.
const REVOCATION_LIST: (u32, [u8; 1]) = (622, [1]);
const TRUST_LIST: (u32, [u8; 2]) = (624, [1, 0x38]);
const CERTIFICATE_REQUEST: (u32, [u8; 2]) = (623, [1, 0x30]);

fn signs<const N: usize>((its_aid, bits): (u32, [u8; N])) -> Permission {
    let ssp = Ssp::Bitmap(bits.to_vec());
    Permission { its_aid, ssp }
}

/// A permission to issue for these services, with chains of this many certificates below.
const fn issues(these: Vec<(u32, SspRange)>, min_chain_length: i8) -> IssuePermission {
    IssuePermission {
        subjects: Subjects::These(these),
        min_chain_length,
        chain_length_range: 0,
        for_applications: true,
    }
}

/// All permissions of these services.
fn all_of(its_aids: &[u32]) -> Vec<(u32, SspRange)> {
    let these = its_aids.iter().map(|its_aid| (*its_aid, SspRange::All));
    these.collect()
}

/// A new root, which lets authorities issue pseudonyms for these services (TS 103 097, clause 7.2.3).
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
    let (requests, [version, bits]) = CERTIFICATE_REQUEST;
    let of_authorities = SspRange::Bitmap {
        value: vec![version, bits],
        mask: vec![0xff, !bits],
    };
    let terms = Terms {
        name: Some(name.to_owned()),
        region,
        issue_permissions: vec![
            issues(all_of(its_aids), 2),
            issues(vec![(requests, of_authorities)], 1),
        ],
        ..Terms::of_ticket(
            term.validity(),
            vec![signs(REVOCATION_LIST), signs(TRUST_LIST)],
        )
    };
    let certificate = issue::root(&key, &terms)?;
    Ok(Holder { certificate, key })
}

/// A new authority below a root, which issues pseudonyms for these services, and with whose `encryption` key requests
/// can be encrypted for it (TS 103 097, clause 7.2.4).
///
/// # Errors
/// Why the root cannot have it.
pub fn new_authority(
    root: &Holder,
    name: &str,
    term: Term,
    region: Option<Region>,
    its_aids: &[u32],
    encryption: PublicKey,
) -> Result<Holder, IssueError> {
    let keys = (PrivateKey::generate(), encryption);
    authority_with(keys, root, name, term, region, its_aids)
}

fn authority_with(
    (key, encryption): (PrivateKey, PublicKey),
    root: &Holder,
    name: &str,
    term: Term,
    region: Option<Region>,
    its_aids: &[u32],
) -> Result<Holder, IssueError> {
    let terms = Terms {
        name: Some(name.to_owned()),
        region,
        issue_permissions: vec![issues(all_of(its_aids), 1)],
        encryption_key: Some(encryption),
        ..Terms::of_ticket(term.validity(), vec![signs(CERTIFICATE_REQUEST)])
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
        region,
        ..Terms::of_ticket(term.validity(), permissions)
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
        let pseudonyms = Duration::hours(23);
        let term = Term {
            from: Time64(now.0.saturating_sub(early_us(pseudonyms))),
            duration: Duration::hours(27),
        };
        let its_aids = its_aids(identifiers);
        let root = root_with(keys(), "test root", term, None, &its_aids)?;
        let name = "test authority";
        // Nobody sends it requests, so nobody needs the private half of the other one.
        let keys = (keys(), keys().public_key());
        let authority = authority_with(keys, &root, name, term, None, &its_aids)?;
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
        let duration = Duration::hours(23);
        let ticket = |nth| {
            let named = named.filter(|_| nth == 0);
            let permissions = robot_permissions(identifiers, &[Part::Lead, Part::Help], named);
            let key = keys();
            let issued = |from, permissions| {
                let term = Term { from, duration };
                ticket_with(key.clone(), &self.authority, term, None, permissions)
            };
            // The digest of a first one draws when it begins, so that the same keys give the same pseudonyms.
            let [a, b, c, d, ..] = issued(now, permissions.clone())?.certificate.id().0;
            let drawn = u64::from(u32::from_be_bytes([a, b, c, d])) * 1_000_000;
            let from = starts::start_of(&self.authority.certificate, now, duration, drawn);
            let Holder { certificate, key } = issued(from, permissions)?;
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
    /// A private key that somebody else owns.
    #[error(
        "{} belongs to user {owner}, who can read and replace it, and this is user {user}; 'chown {user}' it, and \
         better replace it",
        path.display()
    )]
    KeyOfAnother {
        /// The file.
        path: PathBuf,
        /// The number of the user who owns it.
        owner: u32,
        /// The number of the user who reads it.
        user: u32,
    },
    /// A file that others can replace, or change.
    #[error(
        "{} can be changed by others than this user; 'chmod go-w' it, and let this user or root own it",
        .0.display()
    )]
    CanBeReplaced(PathBuf),
    /// A line of a revocation list names no certificate.
    #[error("{}:{line}: '{found}' is no certificate: {cause}", path.display())]
    Revoked {
        /// The list.
        path: PathBuf,
        /// The line, from 1.
        line: usize,
        /// How the line begins.
        found: String,
        /// What is wanted.
        cause: NoHashedId8,
    },
    /// All pseudonyms of a robot are revoked.
    #[error(
        "all tickets in {} are on the revocation list {}; 'crossguard pki tickets' makes new ones",
        folder.display(), list.display()
    )]
    AllRevoked {
        /// The folder of the robot.
        folder: PathBuf,
        /// The list.
        list: PathBuf,
    },
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

/// What a folder with certificates says to trust, of a PKI or of a robot: its roots, and the authorities
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

/// The same without what is on a revocation list, which the robot does not trust either.
///
/// # Errors
/// Those of [`read_credentials`], what is wrong with the list, or that all tickets are on it.
pub fn credentials_but(
    folder: &Path,
    robot: &str,
    list: Option<&Path>,
) -> Result<Credentials, PkiError> {
    let mut credentials = credentials_of(folder, robot)?;
    if let Some(list) = list {
        let revoked = RevokedList::new(list.to_owned()).read()?;
        let tickets = &mut credentials.tickets;
        tickets.retain(|ticket| !ticket.certificate().is_among(&revoked));
        credentials.trust.set_revoked(revoked);
        if credentials.tickets.is_empty() {
            return Err(PkiError::AllRevoked {
                folder: folder.to_owned(),
                list: list.to_owned(),
            });
        }
    }
    Ok(credentials)
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
        assert_eq!(credentials.trust.authorities().count(), 1);
        assert!(Security::new(Mode::Enforce, credentials, None, now()).is_ok());
    }

    #[test]
    fn nothing_is_overwritten() {
        let (folder, _robot) = written();
        let other = Pki::for_a_day(&Identifiers::default(), now()).unwrap();
        let error = other.root.write(folder.path(), "root").unwrap_err();
        assert!(matches!(error, PkiError::Exists(_)), "{error}");
    }
}
