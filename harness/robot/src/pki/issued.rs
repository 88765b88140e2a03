//! A root, an authority and the pseudonyms that it issues, for tests.

use crossguard_codec::security::issue::{self, IssueError, Terms};
use crossguard_codec::security::{
    Duration, IssuePermission, Permission, PrivateKey, PublicKey, Ssp, SspRange, Subjects, Ticket,
    Time64, TrustStore, Untrusted, Validity,
};
use crossguard_codec::{Identifiers, Part, Service};
use crossguard_endpoint::station::Credentials;
use crossguard_protocol::StationId;

use super::{EARLY_S, Holder, PkiError};

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

/// A new root with this key, which lets authorities issue pseudonyms for these services (TS 103 097, clause 7.2.3).
///
/// # Errors
/// Why there can be none.
pub fn new_root(
    key: PrivateKey,
    name: &str,
    term: Term,
    its_aids: &[u32],
) -> Result<Holder, IssueError> {
    let (requests, [version, bits]) = CERTIFICATE_REQUEST;
    let of_authorities = SspRange::Bitmap {
        value: vec![version, bits],
        mask: vec![0xff, !bits],
    };
    let terms = Terms {
        name: Some(name.to_owned()),
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

/// A new authority with this key below a root, which issues pseudonyms for these services, and with whose `encryption`
/// key requests can be encrypted for it (TS 103 097, clause 7.2.4).
///
/// # Errors
/// Why the root cannot have it.
pub fn new_authority(
    (key, encryption): (PrivateKey, PublicKey),
    root: &Holder,
    name: &str,
    term: Term,
    its_aids: &[u32],
) -> Result<Holder, IssueError> {
    let terms = Terms {
        name: Some(name.to_owned()),
        issue_permissions: vec![issues(all_of(its_aids), 1)],
        encryption_key: Some(encryption),
        ..Terms::of_ticket(term.validity(), vec![signs(CERTIFICATE_REQUEST)])
    };
    let certificate = issue::authority(&root.certificate, &root.key, key.public_key(), &terms)?;
    Ok(Holder { certificate, key })
}

/// A new pseudonym with this key.
///
/// # Errors
/// Why the authority cannot give it.
pub fn new_ticket(
    key: PrivateKey,
    authority: &Holder,
    term: Term,
    permissions: Vec<Permission>,
) -> Result<Holder, IssueError> {
    let terms = Terms::of_ticket(term.validity(), permissions);
    let holder = key.public_key();
    let certificate = issue::ticket(&authority.certificate, &authority.key, holder, &terms)?;
    Ok(Holder { certificate, key })
}

/// A new pseudonym with this key, which begins before it is wanted by a time that is drawn, so that the moment does not
/// tell whose it is: at most by a tenth of its duration, and not before its issuer. The same key gives the same
/// pseudonym.
///
/// # Errors
/// Why the authority cannot give it.
pub fn drawn_ticket(
    key: &PrivateKey,
    authority: &Holder,
    term: Term,
    permissions: &[Permission],
) -> Result<Holder, IssueError> {
    let issued = |term| new_ticket(key.clone(), authority, term, permissions.to_vec());
    // The digest of a first one draws. Nobody else sees that one.
    let [a, b, c, d, ..] = issued(term)?.certificate.id().0;
    let drawn = u64::from(u32::from_be_bytes([a, b, c, d])) * 1_000_000;
    let from_us = term.from.0;
    let validity = authority.certificate.content().validity;
    let earliest_us = validity.from().0 + EARLY_S * 1_000_000;
    let span_us = early_us(term.duration).min(from_us.saturating_sub(earliest_us));
    let from = Time64(from_us - drawn % (span_us + 1));
    issued(Term { from, ..term })
}

/// How long before it is wanted a pseudonym that is valid for so long begins at most, in µs: a tenth of that.
#[must_use]
pub const fn early_us(duration: Duration) -> u64 {
    duration.microseconds() / 10
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
        let root = new_root(keys(), "test root", term, &its_aids)?;
        // Nobody sends it requests, so nobody needs the private half of the other one.
        let keys = (keys(), keys().public_key());
        let authority = new_authority(keys, &root, "test authority", term, &its_aids)?;
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
        let term = Term::hours(now, 23);
        let ticket = |nth| {
            let named = named.filter(|_| nth == 0);
            let permissions = robot_permissions(identifiers, &[Part::Lead, Part::Help], named);
            let Holder { certificate, key } =
                drawn_ticket(&keys(), &self.authority, term, &permissions)?;
            Ok(Ticket::new(certificate, key)?)
        };
        Ok(Credentials {
            trust: self.trust()?,
            tickets: (0..tickets).map(ticket).collect::<Result<_, PkiError>>()?,
        })
    }
}

/// The ITS-AIDs of all services that the kit knows.
#[must_use]
pub fn its_aids(identifiers: &Identifiers) -> Vec<u32> {
    let its_aids = Service::ALL.map(|service| service.its_aid(identifiers));
    its_aids.to_vec()
}

/// Service specific permissions for CAM (EN 302 637-2): version 1, and none of the containers and
/// causes that only some vehicles may use.
const CAM_PERMISSIONS: [u8; 3] = [1, 0, 0];

/// Service specific permissions for VAM: version 1 alone.
const VAM_PERMISSIONS: [u8; 1] = [1];

/// The permissions of a robot that takes these parts in sessions: for RAM and RMCM, and for the CAM and
/// cluster VAM by which it speaks to stations that know neither. It goes by the station id that is `named`, or else
/// by one that follows from the ticket.
#[must_use]
pub fn robot_permissions(
    identifiers: &Identifiers,
    parts: &[Part],
    named: Option<StationId>,
) -> Vec<Permission> {
    let parts = match named {
        None => Part::bitmap(parts).to_vec(),
        Some(station) => Part::bitmap_naming(parts, station).to_vec(),
    };
    let services: [(Service, &[u8]); 4] = [
        (Service::Ram, &parts),
        (Service::Rmcm, &parts),
        (Service::Cam, &CAM_PERMISSIONS),
        (Service::Vam, &VAM_PERMISSIONS),
    ];
    services
        .map(|(service, bits)| Permission {
            its_aid: service.its_aid(identifiers),
            ssp: Ssp::Bitmap(bits.to_vec()),
        })
        .to_vec()
}
