//! Verification of secured messages.
//!
//! Checks that cost little come first, signatures last; nothing is remembered of a message that fails one, but that its
//! signature was wrong. Time and place are inputs.
//!
//! | check | costs | a stranger can make it happen |
//! |---|---|---|
//! | time, place, profile, ticket, permission, replay | about a microsecond | with every packet |
//! | signature of an authority | one signature | [`AUTHORITIES_PER_S`] times a second, and only of one that was asked for |
//! | signature of a new ticket, and of its first message | up to two signatures | [`Tolerances::new_per_s`] times a second |
//! | signature of a message of a ticket that is known | one signature | with every packet that names such a ticket |

use std::collections::{BTreeSet, VecDeque};

use super::cache::Cache;
use super::certificate::Certificate;
use super::crypto::{self, Digest};
use super::envelope::{REQUESTS_MAX, SignedMessage, SignerIdentifier};
use super::hashed_id::{HashedId3, HashedId8};
use super::permissions::Ssp;
use super::region::Place;
use super::rejected::Rejected;
use super::thrift::{Budget, Refused};
use super::time::Time64;
use super::trust::{TrustStore, Untrusted, check_validity};
use super::trusted_time::TrustedTime;

/// How many certificates of authorities that were asked for are verified in a second.
pub const AUTHORITIES_PER_S: u32 = 4;
/// How many authorities are waited for.
const MISSING_MAX: usize = 16;
/// How many tickets are remembered that an authority has signed and whose holder has said nothing yet.
const VOUCHED_MAX: usize = 64;

/// Limits for messages of others.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Tolerances {
    /// How long ago a message may have been generated; 2 s by default.
    pub age_max_us: u64,
    /// How far in the future, because clocks differ; 220 ms by default.
    pub ahead_max_us: u64,
    /// How far away its sender may be, in metres; 10 km by default.
    pub distance_max_m: u32,
    /// How many messages with a ticket that is new are verified in a second; 128 by default. Tickets that are known are
    /// not counted, so that nobody who is heard has to wait for strangers.
    pub new_per_s: u32,
}

impl Default for Tolerances {
    fn default() -> Self {
        Self {
            age_max_us: 2_000_000,
            ahead_max_us: 220_000,
            distance_max_m: 10_000,
            new_per_s: 128,
        }
    }
}

/// Parts of the headers of a packet that its envelope covers.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Origin {
    /// Where its source is; `None` if that does not know.
    pub place: Option<Place>,
    /// When it was there: milliseconds of `TimestampIts`, modulo 2^32.
    pub timestamp: u32,
}

/// Checks secured messages, and remembers what that takes.
#[derive(Clone, Debug, Default)]
pub struct Verifier {
    trust: TrustStore,
    tolerances: Tolerances,
    /// The time, which does not go back although the clock may.
    time: TrustedTime,
    cache: Cache,
    /// Certificates of which only the digest was heard, to ask for.
    wanted: Vec<HashedId3>,
    /// Authorities that tickets name and that are not known: their certificates are taken when they come.
    missing: VecDeque<HashedId8>,
    /// Authorities whose certificate came, and is not one to trust.
    untrusted: Refused<HashedId8>,
    /// Certificates and messages whose signature is wrong.
    refused: Refused<Digest>,
    /// Tickets that an authority has signed, and whose holder has said nothing yet.
    vouched: VecDeque<Certificate>,
    new: Budget,
    authorities: Budget,
    /// How many signatures it has checked.
    signatures: u64,
    /// The own tickets.
    own: Vec<HashedId8>,
}

/// A message that can be relied on.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Verified {
    /// The ticket of its signer.
    pub signer: HashedId8,
    /// Under what the signer goes: [`Certificate::holder`].
    pub holder: HashedId8,
    /// Permissions of the ticket within the service.
    pub ssp: Ssp,
    /// True if the ticket was heard of for the first time.
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

    /// The same from `now` on: what was generated before may have been heard before, and is refused.
    #[must_use]
    pub fn starting(self, now: Time64) -> Self {
        Self {
            time: TrustedTime::starting(now, self.tolerances.ahead_max_us),
            ..self
        }
    }

    /// The time, as far as the clock can be trusted.
    #[must_use]
    pub const fn time(&self) -> &TrustedTime {
        &self.time
    }

    pub(super) const fn time_mut(&mut self) -> &mut TrustedTime {
        &mut self.time
    }

    /// The authorities that it trusts.
    #[must_use]
    pub const fn trust(&self) -> &TrustStore {
        &self.trust
    }

    /// Its limits for messages of others.
    #[must_use]
    pub const fn tolerances(&self) -> &Tolerances {
        &self.tolerances
    }

    /// Trusts none of these certificates from now on; see [`TrustStore::set_revoked`].
    pub fn set_revoked(&mut self, revoked: BTreeSet<HashedId8>) {
        self.trust.set_revoked(revoked);
    }

    /// How many signatures of messages and certificates it has checked: nearly all that it costs.
    #[must_use]
    pub const fn signatures(&self) -> u64 {
        self.signatures
    }

    /// The certificates to ask for; they are not told again.
    pub(super) fn take_wanted(&mut self) -> Vec<HashedId3> {
        std::mem::take(&mut self.wanted)
    }

    /// Checks that the headers of a packet, which the envelope covers, fit to the envelope and to a receiver that is
    /// `here`.
    ///
    /// # Errors
    /// The first reason why not.
    pub fn check_origin(
        &self,
        here: Option<Place>,
        origin: &Origin,
        message: &SignedMessage,
    ) -> Result<(), Rejected> {
        let Tolerances {
            age_max_us,
            ahead_max_us,
            distance_max_m,
            ..
        } = self.tolerances;
        if origin.place.is_some_and(|place| !place.is_on_earth()) {
            return Err(Rejected::NotOnEarth("source position"));
        }
        #[expect(clippy::cast_possible_truncation, reason = "it is modulo 2^32")]
        let generated_ms = (message.header.generation_time.0 / 1_000) as u32;
        let by_ms = generated_ms.wrapping_sub(origin.timestamp).cast_signed();
        let is_within = |ms: u32, max_us: u64| u64::from(ms) * 1_000 <= max_us;
        let limit = if by_ms < 0 { ahead_max_us } else { age_max_us };
        if !is_within(by_ms.unsigned_abs(), limit) {
            return Err(Rejected::OtherTime { by_ms });
        }
        let Some(place) = origin.place else {
            return Ok(());
        };
        let metres_to = |other: Option<Place>| other.map_or(0, |other| place.metres_to(other));
        let metres = metres_to(message.header.generation_location);
        if metres > distance_max_m {
            return Err(Rejected::LocationElsewhere { metres });
        }
        match metres_to(here) {
            metres if metres > distance_max_m => Err(Rejected::TooFar { metres }),
            _ => Ok(()),
        }
    }

    /// Verifies a message that is heard at `now`. `place` is the position of its sender, which the
    /// sender signed.
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
        let now = self.time.read(now)?;
        // Before its certificate is known: it need not be asked for.
        if self.trust.revoked().contains(&id) {
            return Err(Rejected::Revoked(id));
        }
        self.check_time(now, message)?;
        self.learn_authority(now, message);
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
        if self.trust.is_revoked(&ticket) {
            return Err(Rejected::Revoked(id));
        }
        let ssp = self.check_ticket(now, place, message, &ticket)?;
        let generated = message.header.generation_time;
        self.cache.check(id, generated, message.to_be_signed())?;
        let fingerprint = message.fingerprint();
        if self.refused.contains(&fingerprint) {
            return Err(Rejected::RefusedBefore);
        }
        let ticket = if is_new {
            self.check_new(now, ticket)?
        } else {
            ticket
        };
        self.signatures += 1;
        if !message.is_signed_by(&ticket) {
            self.refused.remember(fingerprint);
            return Err(Rejected::Signature);
        }
        let fresh = Time64(now.0.saturating_sub(self.tolerances.age_max_us));
        self.cache
            .remember(&ticket, generated, message.to_be_signed(), fresh);
        if is_new {
            self.vouched.retain(|vouched| vouched.id() != id);
        }
        Ok(Verified {
            signer: id,
            holder: ticket.holder(),
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
            _ => self.time.check(generated),
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
            self.miss(id);
            return error;
        }
        let [authority, root] = above?;
        TrustStore::check_ticket(ticket, authority)?;
        // Both where the packet was sent and where its content is about, not one of them.
        let location = message.header.generation_location;
        let [place, other] = [place.or(location), location.or(place)];
        for certificate in [ticket, authority, root] {
            check_validity(certificate, now, place)?;
            check_validity(certificate, message.header.generation_time, other)?;
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

    /// Checks that the authority of a new ticket has signed it; returns that ticket, whose point need not be computed
    /// again.
    fn check_new(&mut self, now: Time64, ticket: Certificate) -> Result<Certificate, Rejected> {
        if self.refused.contains(ticket.digest()) {
            return Err(Rejected::RefusedBefore);
        }
        if !self.new.spend(now, self.tolerances.new_per_s) {
            return Err(Rejected::TooManyNew);
        }
        if let Some(vouched) = self.vouched.iter().find(|it| **it == ticket) {
            return Ok(vouched.clone());
        }
        let [authority, _] = self.trust.above(&ticket)?;
        self.signatures += 1;
        if !ticket.is_signed_by(Some(authority)) {
            self.refused.remember(*ticket.digest());
            return Err(Rejected::CertificateSignature(ticket.id()));
        }
        if self.vouched.len() == VOUCHED_MAX {
            self.vouched.pop_front();
        }
        // Before it is cloned.
        ticket.point();
        self.vouched.push_back(ticket.clone());
        Ok(ticket)
    }

    /// The certificate of an authority that comes with a message vouches for itself, by its root. One that was not
    /// asked for is not looked at, and one that does not vouch for itself is no reason to reject the message.
    fn learn_authority(&mut self, now: Time64, message: &SignedMessage) {
        let Some(octets) = message.header.requested_certificate else {
            return;
        };
        if self.missing.is_empty() {
            return;
        }
        let authority = Certificate::decode(octets);
        let named = |_: &Rejected| HashedId8::of(&crypto::sha256(octets));
        let id = authority.as_ref().map_or_else(named, Certificate::id);
        if !self.missing.contains(&id) || !self.authorities.spend(now, AUTHORITIES_PER_S) {
            return;
        }
        self.missing.retain(|missing| *missing != id);
        self.signatures += 1;
        let learnt = authority.map(|authority| self.trust.learn_authority(authority, now));
        // One that there was no room for may be asked for again.
        if !matches!(learnt, Ok(Ok(()) | Err(Untrusted::TooMany(_)))) {
            self.untrusted.remember(id);
        }
    }

    /// A ticket names an authority that is not known. It is asked for, unless it is known not to be trusted.
    fn miss(&mut self, id: HashedId8) {
        if self.untrusted.contains(&id) {
            return;
        }
        if !self.missing.contains(&id) {
            if self.missing.len() == MISSING_MAX {
                self.missing.pop_front();
            }
            self.missing.push_back(id);
        }
        self.want(id.short());
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
