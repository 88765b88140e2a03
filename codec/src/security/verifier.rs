//! Whether a secured message can be relied on.
//!
//! Checks that cost little come first, signatures last; nothing is remembered of a message that fails
//! one. Time and place are inputs.

use super::cache::Cache;
use super::certificate::Certificate;
use super::envelope::{REQUESTS_MAX, SignedMessage, SignerIdentifier};
use super::hashed_id::{HashedId3, HashedId8};
use super::permissions::Ssp;
use super::region::Place;
use super::rejected::Rejected;
use super::time::Time64;
use super::trust::{TrustStore, check_validity};

/// How old and how new a message may be, in microseconds.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Tolerances {
    /// How long ago it may have been generated; 2 s by default.
    pub age_max_us: u64,
    /// How far in the future, because clocks differ; 220 ms by default.
    pub ahead_max_us: u64,
}

impl Default for Tolerances {
    fn default() -> Self {
        Self {
            age_max_us: 2_000_000,
            ahead_max_us: 220_000,
        }
    }
}

/// Checks secured messages, and remembers what that takes.
#[derive(Clone, Debug, Default)]
pub struct Verifier {
    trust: TrustStore,
    tolerances: Tolerances,
    cache: Cache,
    /// Certificates of which only the digest was heard, to ask for.
    wanted: Vec<HashedId3>,
    /// The own tickets.
    own: Vec<HashedId8>,
}

/// A message that can be relied on.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Verified {
    /// The ticket of its signer.
    pub signer: HashedId8,
    /// What the ticket permits within the service.
    pub ssp: Ssp,
    /// Whether the ticket was heard of for the first time.
    pub is_new: bool,
}

impl Verifier {
    /// A verifier that trusts these roots. `own` are the tickets of the own station, whose messages
    /// come from nobody else.
    #[must_use]
    pub fn new(trust: TrustStore, tolerances: Tolerances, own: Vec<HashedId8>) -> Self {
        Self {
            trust,
            tolerances,
            own,
            ..Self::default()
        }
    }

    /// The authorities that it trusts.
    #[must_use]
    pub const fn trust(&self) -> &TrustStore {
        &self.trust
    }

    /// How many tickets of others it remembers.
    #[must_use]
    pub fn known_tickets(&self) -> usize {
        self.cache.len()
    }

    /// The certificates to ask for; they are not told again.
    pub(super) fn take_wanted(&mut self) -> Vec<HashedId3> {
        std::mem::take(&mut self.wanted)
    }

    /// Whether a message can be relied on, that is heard at `now`. `place` is where the sender says
    /// it is, in what it signed.
    ///
    /// # Errors
    /// The first reason why not.
    pub fn verify(
        &mut self,
        now: Time64,
        place: Option<Place>,
        message: &SignedMessage,
    ) -> Result<Verified, Rejected> {
        let id = message.signer.id();
        if self.own.contains(&id) {
            return Err(Rejected::OwnTicket);
        }
        self.check_time(now, message)?;
        self.learn_authority(message);
        let known = self.cache.ticket(id).cloned();
        let is_new = known.is_none();
        let ticket = match (known, &message.signer) {
            (Some(ticket), _) => ticket,
            (None, SignerIdentifier::Certificate(certificate)) => (**certificate).clone(),
            (None, SignerIdentifier::Digest(id)) => {
                self.want(id.short());
                return Err(Rejected::UnknownSigner(*id));
            }
        };
        let ssp = self.check_ticket(now, place, message, &ticket)?;
        let generated = message.header.generation_time;
        self.cache.check(id, generated, message.to_be_signed())?;
        self.check_signatures(message, &ticket, is_new)?;
        let fresh = Time64(now.0.saturating_sub(self.tolerances.age_max_us));
        self.cache
            .remember(&ticket, generated, message.to_be_signed(), fresh);
        Ok(Verified {
            signer: id,
            ssp,
            is_new,
        })
    }

    fn check_time(&self, now: Time64, message: &SignedMessage) -> Result<(), Rejected> {
        let generated = message.header.generation_time;
        let age_us = now.0.saturating_sub(generated.0);
        if age_us > self.tolerances.age_max_us {
            return Err(Rejected::TooOld { age_us });
        }
        let ahead_us = generated.0.saturating_sub(now.0);
        if ahead_us > self.tolerances.ahead_max_us {
            return Err(Rejected::FromTheFuture { ahead_us });
        }
        match message.header.expiry_time {
            Some(expiry) if expiry <= now => Err(Rejected::MessageExpired),
            _ => Ok(()),
        }
    }

    /// Everything about a ticket but its signature: chain, validity, region and permission.
    fn check_ticket(
        &mut self,
        now: Time64,
        place: Option<Place>,
        message: &SignedMessage,
        ticket: &Certificate,
    ) -> Result<Ssp, Rejected> {
        let above = self.trust.above(ticket);
        if let Err(Rejected::ForeignIssuer(id)) = above {
            let error = Err(Rejected::ForeignIssuer(id));
            self.want(id.short());
            return error;
        }
        let [authority, root] = above?;
        TrustStore::check_ticket(ticket, authority)?;
        let place = message.header.generation_location.or(place);
        for certificate in [ticket, authority, root] {
            check_validity(certificate, now, place)?;
            check_validity(certificate, message.header.generation_time, place)?;
        }
        let its_aid = message.header.its_aid;
        ticket
            .content()
            .permissions
            .iter()
            .find(|permission| permission.its_aid == its_aid)
            .map(|permission| permission.ssp.clone())
            .ok_or(Rejected::NotPermitted(its_aid))
    }

    fn check_signatures(
        &self,
        message: &SignedMessage,
        ticket: &Certificate,
        is_new: bool,
    ) -> Result<(), Rejected> {
        if is_new {
            let [authority, _] = self.trust.above(ticket)?;
            if !ticket.is_signed_by(Some(authority)) {
                return Err(Rejected::CertificateSignature(ticket.id()));
            }
        }
        if message.is_signed_by(ticket) {
            Ok(())
        } else {
            Err(Rejected::Signature)
        }
    }

    /// An authority's certificate that comes with a message vouches for itself, by its root. One
    /// that does not is no reason to reject the message.
    fn learn_authority(&mut self, message: &SignedMessage) {
        let Some(octets) = message.header.requested_certificate else {
            return;
        };
        if let Ok(authority) = Certificate::decode(octets)
            && self.trust.authority(authority.id().short()).is_none()
        {
            let _ = self.trust.add_authority(authority);
        }
    }

    fn want(&mut self, id: HashedId3) {
        if !self.wanted.contains(&id) {
            if self.wanted.len() == REQUESTS_MAX {
                self.wanted.remove(0);
            }
            self.wanted.push(id);
        }
    }
}
