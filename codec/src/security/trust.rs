//! Trust of a station: roots, the authorities that they vouch for, and what of that is revoked.

use std::collections::BTreeSet;

use super::certificate::{Certificate, Issuer};
use super::hashed_id::{HashedId3, HashedId8};
use super::permissions::{not_to_be_delegated, not_to_be_given};
use super::region::Place;
use super::rejected::Rejected;
use super::time::Time64;

/// How many roots a station trusts at most.
pub const ROOTS_MAX: usize = 16;
/// How many authorities it knows at most by configuration, and as many more by messages.
pub const AUTHORITIES_MAX: usize = 64;

/// Roots that are trusted because they were configured, and authorities below them.
///
/// There are no trust lists (CTL) and revocation lists (CRL) of TS 102 941: what is in here is trusted as long as it
/// is valid, and not among the [revoked](Self::set_revoked) ones.
#[derive(Clone, Debug, Default)]
pub struct TrustStore {
    roots: Vec<Certificate>,
    authorities: Vec<Certificate>,
    /// Authorities that messages told of. They go when they are over.
    learned: Vec<Certificate>,
    revoked: BTreeSet<HashedId8>,
}

/// Why a certificate cannot be added to a [`TrustStore`].
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Untrusted {
    /// It cannot be relied on.
    #[error("{0}")]
    Rejected(#[from] Rejected),
    /// It has an issuer other than itself.
    #[error("certificate {0} is no root: it is not signed by itself")]
    NotARoot(HashedId8),
    /// It may not issue certificates.
    #[error("certificate {0} may not issue certificates")]
    MayNotIssue(HashedId8),
    /// There is no room for another one.
    #[error("there are too many of them, the limit is {0}")]
    TooMany(usize),
}

impl TrustStore {
    /// Trusts a root from now on.
    ///
    /// # Errors
    /// Why it is no root.
    pub fn add_root(&mut self, root: Certificate) -> Result<(), Untrusted> {
        let id = root.id();
        if root.content().issuer != Issuer::Itself {
            return Err(Untrusted::NotARoot(id));
        }
        if root.content().issue_permissions.is_empty() {
            return Err(Untrusted::MayNotIssue(id));
        }
        if !root.is_signed_by(None) {
            return Err(Rejected::CertificateSignature(id).into());
        }
        add(&mut self.roots, root, ROOTS_MAX)
    }

    /// Knows an authority from now on, if a trusted root vouches for it (IEEE 1609.2, clause 5.1.2).
    ///
    /// # Errors
    /// Why it cannot be trusted.
    pub fn add_authority(&mut self, authority: Certificate) -> Result<(), Untrusted> {
        self.check_authority(&authority)?;
        add(&mut self.authorities, authority, AUTHORITIES_MAX)
    }

    /// Knows an authority that a message told of at `now`, until it is over, if a trusted root vouches for it.
    /// Authorities that are over make room.
    pub(super) fn learn_authority(
        &mut self,
        authority: Certificate,
        now: Time64,
    ) -> Result<(), Untrusted> {
        self.learned
            .retain(|known| now < known.content().validity.until());
        if self.is_revoked(&authority) {
            return Err(Rejected::Revoked(authority.id()).into());
        }
        check_validity_in_time(&authority, now)?;
        self.check_authority(&authority)?;
        add(&mut self.learned, authority, AUTHORITIES_MAX)
    }

    /// Certificates that are not to be trusted any more, instead of the ones before: tickets, authorities or roots.
    pub fn set_revoked(&mut self, revoked: BTreeSet<HashedId8>) {
        self.learned
            .retain(|authority| !authority.is_among(&revoked));
        self.revoked = revoked;
    }

    /// The certificates that are not to be trusted any more.
    #[must_use]
    pub const fn revoked(&self) -> &BTreeSet<HashedId8> {
        &self.revoked
    }

    /// True if a certificate, or its mirror with the other s, is revoked.
    #[must_use]
    pub fn is_revoked(&self, certificate: &Certificate) -> bool {
        certificate.is_among(&self.revoked)
    }

    /// Checks that a trusted root vouches for an authority.
    fn check_authority(&self, authority: &Certificate) -> Result<(), Untrusted> {
        let content = authority.content();
        if content.issue_permissions.is_empty() {
            return Err(Untrusted::MayNotIssue(authority.id()));
        }
        let root = find(&self.roots, content.issuer)?;
        let given = &root.content().issue_permissions;
        if !root.content().validity.encloses(&content.validity) {
            return Err(Rejected::BeyondIssuer.into());
        }
        if let Some(its_aid) = not_to_be_delegated(given, &content.issue_permissions) {
            return Err(Rejected::IssuerNotPermitted(its_aid).into());
        }
        if !authority.is_signed_by(Some(root)) {
            return Err(Rejected::CertificateSignature(authority.id()).into());
        }
        Ok(())
    }

    /// The roots.
    #[must_use]
    pub fn roots(&self) -> &[Certificate] {
        &self.roots
    }

    /// The authorities, from the configuration and from messages.
    pub fn authorities(&self) -> impl Iterator<Item = &Certificate> {
        self.authorities.iter().chain(&self.learned)
    }

    /// The authority with this id.
    pub(super) fn authority(&self, id: HashedId3) -> Option<&Certificate> {
        self.authorities()
            .find(|authority| authority.id().short() == id)
    }

    /// The certificates above a ticket: its authority and its root.
    pub(super) fn above(&self, ticket: &Certificate) -> Result<[&Certificate; 2], Rejected> {
        let authority = find(self.authorities(), ticket.content().issuer)?;
        let root = find(&self.roots, authority.content().issuer)?;
        let above = [authority, root];
        match above.iter().find(|it| self.is_revoked(it)) {
            Some(revoked) => Err(Rejected::Revoked(revoked.id())),
            None => Ok(above),
        }
    }

    /// Checks that `ticket` is one that its authority may have issued; all but its signature.
    pub(super) fn check_ticket(
        ticket: &Certificate,
        authority: &Certificate,
    ) -> Result<(), Rejected> {
        let content = ticket.content();
        if !content.is_ticket() {
            return Err(Rejected::NotATicket);
        }
        if !authority.content().validity.encloses(&content.validity) {
            return Err(Rejected::BeyondIssuer);
        }
        let given = &authority.content().issue_permissions;
        match not_to_be_given(given, &content.permissions) {
            Some(its_aid) => Err(Rejected::IssuerNotPermitted(its_aid)),
            None => Ok(()),
        }
    }
}

/// Checks that a certificate is valid at a time and place.
pub(super) fn check_validity(
    certificate: &Certificate,
    time: Time64,
    place: Option<Place>,
) -> Result<(), Rejected> {
    check_validity_in_time(certificate, time)?;
    match (&certificate.content().region, place) {
        (None, _) => Ok(()),
        (Some(region), Some(place)) if region.contains(place) => Ok(()),
        (Some(_), _) => Err(Rejected::OutsideRegion),
    }
}

fn check_validity_in_time(certificate: &Certificate, time: Time64) -> Result<(), Rejected> {
    let validity = &certificate.content().validity;
    if time < validity.from() {
        Err(Rejected::CertificateNotYetValid)
    } else if time >= validity.until() {
        Err(Rejected::CertificateExpired)
    } else {
        Ok(())
    }
}

fn find<'a>(
    among: impl IntoIterator<Item = &'a Certificate>,
    issuer: Issuer,
) -> Result<&'a Certificate, Rejected> {
    match issuer {
        Issuer::Certificate(id) => among
            .into_iter()
            .find(|certificate| certificate.id() == id)
            .ok_or(Rejected::ForeignIssuer(id)),
        Issuer::Itself => Err(Rejected::NotATicket),
    }
}

fn add(to: &mut Vec<Certificate>, new: Certificate, max: usize) -> Result<(), Untrusted> {
    if to.contains(&new) {
        return Ok(());
    }
    if to.len() == max {
        return Err(Untrusted::TooMany(max));
    }
    to.push(new);
    Ok(())
}
