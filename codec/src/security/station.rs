//! One station's security: its pseudonyms, and the authorities that it trusts.

use std::collections::BTreeSet;

use super::envelope::SignedMessage;
use super::hashed_id::HashedId8;
use super::region::Place;
use super::rejected::Rejected;
use super::signer::{Sealer, Ticket, Unsigned};
use super::time::Time64;
use super::trust::TrustStore;
use super::verifier::{Tolerances, Verified, Verifier};

/// A station that signs and verifies.
///
/// Both belong together: a station whose certificate others do not know sends it at once, and one that
/// hears of a certificate that it does not know asks for it (TS 103 097, clause 7.1.1).
#[derive(Clone, Debug)]
pub struct Station {
    sealer: Sealer,
    verifier: Verifier,
}

impl Station {
    /// A station with these pseudonyms that trusts these roots, at `now`.
    ///
    /// # Errors
    /// When no pseudonym is valid.
    pub fn new(
        trust: TrustStore,
        tickets: Vec<Ticket>,
        tolerances: Tolerances,
        now: Time64,
    ) -> Result<Self, Unsigned> {
        let sealer = Sealer::new(tickets, now)?;
        let own = sealer.ids().collect();
        Ok(Self {
            verifier: Verifier::new(trust, tolerances, own).starting(now),
            sealer,
        })
    }

    /// The name of the ticket in use.
    #[must_use]
    pub fn pseudonym(&self) -> HashedId8 {
        self.sealer.ticket().certificate().id()
    }

    /// The ticket in use.
    #[must_use]
    pub fn ticket(&self) -> &Ticket {
        self.sealer.ticket()
    }

    /// The memory of other stations.
    #[must_use]
    pub const fn verifier(&self) -> &Verifier {
        &self.verifier
    }

    /// Takes up the time from before a restart: the newest that was known to have been.
    pub fn remember_time(&mut self, known: Time64) {
        let time = self.verifier.time_mut();
        *time = time.since(known);
    }

    /// Looks at the clock, which shows `now`, when a clock that never leaps shows `steady_ms`. Also while nobody is heard,
    /// it is known then whether it leaps.
    pub fn look_at_clock(&mut self, now: Time64, steady_ms: u64) {
        self.verifier.time_mut().look(now, steady_ms);
    }

    /// Trusts none of these certificates from now on, instead of the ones that were revoked before.
    pub fn set_revoked(&mut self, revoked: BTreeSet<HashedId8>) {
        self.verifier.set_revoked(revoked);
    }

    /// Puts a payload into an envelope, under the permission `its_aid`.
    ///
    /// # Errors
    /// Why it cannot be signed.
    pub fn seal(&mut self, now: Time64, its_aid: u32, payload: &[u8]) -> Result<Vec<u8>, Unsigned> {
        let requests = self.verifier.take_wanted();
        self.sealer.seal(now, its_aid, payload, &requests)
    }

    /// Checks a message that was heard at `now`. `place` is where its sender says it is, in what it
    /// signed.
    ///
    /// # Errors
    /// Why it cannot be relied on.
    pub fn verify(
        &mut self,
        now: Time64,
        place: Option<Place>,
        message: &SignedMessage,
    ) -> Result<Verified, Rejected> {
        let verified = self.verifier.verify(now, place, message);
        match &verified {
            Ok(verified) => {
                if verified.is_new {
                    self.sealer.introduce();
                }
                self.answer(message);
            }
            // A signer that is unknown here does not know this station either.
            Err(Rejected::UnknownSigner(_)) => self.sealer.introduce(),
            Err(_) => {}
        }
        verified
    }

    /// True if the ticket in use is not valid any more at a time, and another one is valid from `now`
    /// until then: for a change that must not wait, so that a session does not outlive its ticket.
    #[must_use]
    pub fn should_change(&self, now: Time64, until: Time64) -> bool {
        !self.ticket().is_valid(until) && self.sealer.next(now, until).is_some()
    }

    /// Changes to the next pseudonym that is valid from `now` until a time, and tells its name. Station
    /// id and link address must change with it, and all of that only while the identity is not locked.
    ///
    /// # Errors
    /// When there is no other.
    pub fn change_pseudonym(&mut self, now: Time64, until: Time64) -> Result<HashedId8, Unsigned> {
        let next = self.sealer.next(now, until);
        self.sealer.change(next.ok_or(Unsigned::NoValidTicket)?);
        Ok(self.pseudonym())
    }

    /// Certificates that another station asks for: the own one, or that of an authority.
    fn answer(&mut self, message: &SignedMessage) {
        let own = self.pseudonym().short();
        for id in message.header.requests() {
            if id == own {
                self.sealer.introduce();
            } else if let Some(authority) = self.verifier.trust().authority(id) {
                let authority = authority.clone();
                self.sealer.pass_on(&authority);
            }
        }
    }
}
