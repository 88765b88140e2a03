//! Signing messages under a pseudonym, by a key that lies in memory or elsewhere.

use std::fmt;
use std::sync::Arc;

use super::certificate::Certificate;
use super::crypto::{self, PrivateKey, PublicKey, Signature};
use super::envelope::{self, Header};
use super::hashed_id::{HashedId3, HashedId8};
use super::time::Time64;

/// How long the certificate may be left out: a second (TS 103 097, clause 7.1.1).
const CERTIFICATE_INTERVAL_US: u64 = 1_000_000;

/// A private key of NIST P-256 that signs, wherever it lies: a [`PrivateKey`] is in memory, another one stays in a
/// token or a hardware security module, which signs with it.
///
/// A robot signs in its own loop, some ten messages a second: a key that takes longer than a few
/// milliseconds delays what the robot does next.
pub trait SigningKey: fmt::Debug + Send + Sync {
    /// The public key that goes with the private one.
    fn public_key(&self) -> PublicKey;

    /// Signs a SHA-256 digest by ECDSA.
    ///
    /// # Errors
    /// Why it could not.
    fn sign(&self, digest: &[u8; 32]) -> Result<Signature, KeyFailure>;
}

/// Why a key did not sign: in a few words, for example that its token was removed.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
#[error("the key did not sign: {0}")]
pub struct KeyFailure(pub &'static str);

impl SigningKey for PrivateKey {
    fn public_key(&self) -> PublicKey {
        Self::public_key(self)
    }

    fn sign(&self, digest: &[u8; 32]) -> Result<Signature, KeyFailure> {
        Ok(Self::sign(self, digest))
    }
}

/// A pseudonym: an authorization ticket and its key.
#[derive(Clone, Debug)]
pub struct Ticket {
    certificate: Certificate,
    key: Arc<dyn SigningKey>,
}

/// Why there is no pseudonym, or a message cannot be signed.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Unsigned {
    /// A key is not that of the certificate.
    #[error("the key is not that of certificate {0}")]
    OtherKey(HashedId8),
    /// A certificate of an authority.
    #[error("certificate {0} is not an authorization ticket")]
    NotATicket(HashedId8),
    /// No ticket is given.
    #[error("there is no ticket")]
    NoTicket,
    /// No ticket is valid now.
    #[error("no ticket is valid now")]
    NoValidTicket,
    /// The ticket does not permit such messages.
    #[error("the ticket does not permit ITS-AID {0}")]
    NotPermitted(u32),
    /// The key lies elsewhere, and could not be used.
    #[error("{0}")]
    Key(#[from] KeyFailure),
}

impl Ticket {
    /// A pseudonym.
    ///
    /// # Errors
    /// When the certificate is no ticket, or the key another one's.
    pub fn new(certificate: Certificate, key: impl SigningKey + 'static) -> Result<Self, Unsigned> {
        if !certificate.content().is_ticket() {
            return Err(Unsigned::NotATicket(certificate.id()));
        }
        if certificate.content().key != key.public_key() {
            return Err(Unsigned::OtherKey(certificate.id()));
        }
        let key = Arc::new(key);
        Ok(Self { certificate, key })
    }

    /// Its certificate.
    #[must_use]
    pub const fn certificate(&self) -> &Certificate {
        &self.certificate
    }

    pub(super) fn is_valid(&self, now: Time64) -> bool {
        let validity = &self.certificate.content().validity;
        (validity.from()..validity.until()).contains(&now)
    }
}

/// Signs messages, and knows when the whole certificate is due.
#[derive(Clone, Debug)]
pub(super) struct Sealer {
    tickets: Vec<Ticket>,
    current: usize,
    /// When the certificate was sent the last time.
    certificate_sent: Option<Time64>,
    /// The generation time of the newest message.
    newest: Time64,
    /// An authority's certificate that somebody asked for.
    asked_for: Option<Certificate>,
}

impl Sealer {
    /// Signs with the first of these tickets that is valid at `now`, or says that none is.
    pub(super) fn new(tickets: Vec<Ticket>, now: Time64) -> Result<Self, Unsigned> {
        if tickets.is_empty() {
            return Err(Unsigned::NoTicket);
        }
        let current = tickets.iter().position(|ticket| ticket.is_valid(now));
        Ok(Self {
            current: current.ok_or(Unsigned::NoValidTicket)?,
            tickets,
            certificate_sent: None,
            newest: Time64::default(),
            asked_for: None,
        })
    }

    /// The ticket that messages are signed with.
    pub(super) fn ticket(&self) -> &Ticket {
        &self.tickets[self.current]
    }

    /// The names of all its tickets.
    pub(super) fn ids(&self) -> impl Iterator<Item = HashedId8> {
        self.tickets.iter().map(|ticket| ticket.certificate.id())
    }

    /// The next ticket, other than the one in use, that is valid at `now` and at `until` as well.
    pub(super) fn next(&self, now: Time64, until: Time64) -> Option<usize> {
        let count = self.tickets.len();
        (1..count)
            .map(|step| (self.current + step) % count)
            .find(|at| self.tickets[*at].is_valid(now) && self.tickets[*at].is_valid(until))
    }

    /// Signs with another ticket from now on; its certificate is due at once.
    pub(super) fn change(&mut self, to: usize) {
        self.current = to;
        self.certificate_sent = None;
        self.asked_for = None;
    }

    /// The whole certificate is due with the next message, because somebody does not know it.
    pub(super) const fn introduce(&mut self) {
        self.certificate_sent = None;
    }

    /// The certificate of an authority goes with the next message.
    pub(super) fn pass_on(&mut self, authority: &Certificate) {
        self.asked_for = Some(authority.clone());
    }

    /// An envelope with this payload, under the permission `its_aid`, generated at `now`. `requests`
    /// are certificates to ask for.
    pub(super) fn seal(
        &mut self,
        now: Time64,
        its_aid: u32,
        payload: &[u8],
        requests: &[HashedId3],
    ) -> Result<Vec<u8>, Unsigned> {
        let ticket = &self.tickets[self.current];
        if !ticket.is_valid(now) {
            return Err(Unsigned::NoValidTicket);
        }
        let content = ticket.certificate.content();
        if content.permissions.iter().all(|p| p.its_aid != its_aid) {
            return Err(Unsigned::NotPermitted(its_aid));
        }
        let in_full = self
            .certificate_sent
            .is_none_or(|sent| now.0.abs_diff(sent.0) >= CERTIFICATE_INTERVAL_US);
        // No two messages are generated at the same time, unless the clock was put back.
        let is_same = now <= self.newest && self.newest.0 - now.0 < CERTIFICATE_INTERVAL_US;
        let generated = if is_same {
            Time64(self.newest.0 + 1)
        } else {
            now
        };
        // The certificate of an authority goes with a digest, so that packets stay short.
        let asked_for = self.asked_for.take_if(|_| !in_full);

        let mut octets = Vec::with_capacity(payload.len() + 384);
        octets.extend(envelope::HEAD);
        envelope::put_payload(payload, &mut octets);
        Header::put(
            its_aid,
            generated,
            requests,
            asked_for.as_ref(),
            &mut octets,
        );
        let digest = crypto::to_be_signed(
            &octets[envelope::HEAD.len()..],
            Some(ticket.certificate.digest()),
        );
        envelope::put_signer(&ticket.certificate, in_full, &mut octets);
        octets.extend(ticket.key.sign(&digest)?.octets());
        self.newest = generated;
        if in_full {
            self.certificate_sent = Some(now);
        }
        Ok(octets)
    }
}
