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

#[cfg(feature = "full")]
use crossguard_codec::security::issue::IssueError;
use crossguard_codec::security::{
    Certificate, Issuer, NoHashedId8, NoKey, PrivateKey, Rejected, Ticket, Time64, TrustStore,
    Unsigned, Untrusted,
};
use crossguard_endpoint::station::Credentials;

use crate::runtime::timestamp_now;

mod files;
#[cfg(feature = "full")]
mod issued;
mod revoked;

pub(crate) use files::unnamed;
pub use files::{
    certificates_in, folders_in, read_certificate, sync_folder, write_certificate, write_key,
};
pub use revoked::{REVOKED_LIST, RevokedList, add_revoked};

#[cfg(feature = "full")]
pub use issued::{
    Pki, Term, drawn_ticket, early_us, its_aids, new_authority, new_root, new_ticket,
    robot_permissions,
};

/// How long before its time a certificate begins to be valid, in seconds: clocks differ.
pub const EARLY_S: u64 = 60;

/// Current time on the scale of certificates, by the system's clock.
#[must_use]
pub fn now() -> Time64 {
    Time64::of_timestamp_its(timestamp_now())
}

/// A certificate and its key.
#[derive(Clone, Debug)]
pub struct Holder {
    /// The certificate.
    pub certificate: Certificate,
    /// Its key.
    pub key: PrivateKey,
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
        /// Why it names no certificate.
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
    #[cfg(feature = "full")]
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

/// Certificates to trust from a folder of a PKI or of a robot: its roots, and the authorities
/// that they vouch for.
///
/// # Errors
/// Faulty file, and its fault.
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

/// Credentials of a robot, from its folder.
///
/// # Errors
/// Faulty file, and its fault.
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

/// Credentials of the robot of this name, from its own folder or from that of a PKI.
///
/// # Errors
/// Errors of [`read_credentials`].
pub fn credentials_of(folder: &Path, robot: &str) -> Result<Credentials, PkiError> {
    let of_robot = robot_folder(folder, robot);
    let is_pki = folder.join("robots").is_dir();
    read_credentials(if is_pki { &of_robot } else { folder })
}

/// The same without what is on a revocation list, which the robot does not trust either.
///
/// # Errors
/// Errors of [`read_credentials`], a fault of the list, or that all tickets are on it.
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

#[cfg(all(test, feature = "full"))]
mod tests {
    use crossguard_codec::Identifiers;

    use super::*;

    #[test]
    fn nothing_is_overwritten() {
        let folder = tempfile::tempdir().unwrap();
        let root = || Pki::for_a_day(&Identifiers::default(), now()).unwrap().root;
        root().write(folder.path(), "root").unwrap();
        let error = root().write(folder.path(), "root").unwrap_err();
        assert!(matches!(error, PkiError::Exists(_)), "{error}");
    }
}
