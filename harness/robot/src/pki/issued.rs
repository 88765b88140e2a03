//! A root, an authority and the pseudonyms that it issues, for tests.

use crossguard_codec::security::issue::{self, IssueError, Terms};
use crossguard_codec::security::{
    Duration, IssuePermission, Permission, PrivateKey, PublicKey, Region, Ssp, SspRange, Subjects,
    Ticket, Time64, TrustStore, Untrusted, Validity,
};
use crossguard_codec::{Identifiers, Part};
use crossguard_endpoint::station::Credentials;
use crossguard_protocol::StationId;

use super::{EARLY_S, Holder, PkiError, early_us, its_aids, robot_permissions, starts};

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
    /// So many hours from a time on.
    #[must_use]
    pub const fn hours(from: Time64, hours: u16) -> Self {
        let duration = Duration::hours(hours);
        Self { from, duration }
    }

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
        let from = Time64(now.0.saturating_sub(early_us(pseudonyms)));
        let term = Term::hours(from, 27);
        let its_aids = its_aids(identifiers);
        let root = root_with(keys(), "test root", term, None, &its_aids)?;
        let name = "test authority";
        // No station sends it requests, so nobody needs the private half of the other one.
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

    /// Credentials of a robot with this many pseudonyms for a day. The first one names this station id, if any.
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
