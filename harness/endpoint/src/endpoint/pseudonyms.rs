//! Security of an endpoint: verification of received packets, and its own pseudonyms.

use std::collections::BTreeSet;

use crossguard_codec::geonet::Envelope;
use crossguard_codec::security::{HashedId8, Time64, TrustedTime};
use crossguard_protocol::{Availability, Event, Identity, StateMachine, Unavailability};

use super::Endpoint;
use super::turn::Turn;
use crate::cause::Cause;
use crate::exchange::{Exchange, Host as _};
pub(super) use crate::station::Pseudonyms;
use crate::station::Security;

impl<P: StateMachine> Endpoint<P> {
    /// The same with security.
    #[must_use]
    pub fn with_security(mut self, security: Security) -> Self {
        self.pseudonyms = Pseudonyms::new(security.secret, security.pseudonym_period_ms);
        *self.exchange.stack.envelope_mut() = security.envelope;
        self
    }

    /// The time that packets are verified by, and whether the clock is trusted. `None` without security.
    #[must_use]
    pub const fn trusted_time(&self) -> Option<&TrustedTime> {
        match self.exchange.stack.envelope() {
            Envelope::Secured(secured) => Some(secured.station().verifier().time()),
            _ => None,
        }
    }

    /// Trusts none of these certificates from now on, instead of the ones that were revoked before.
    pub fn set_revoked(&mut self, revoked: BTreeSet<HashedId8>) {
        if let Envelope::Secured(secured) = self.exchange.stack.envelope_mut() {
            secured.set_revoked(revoked);
        }
    }
}

impl Pseudonyms {
    /// Looks at the clock, and changes the pseudonym when that is due and no session knows the robot by its old one. A
    /// robot that has none for a session takes part in none.
    pub(super) fn renew<P: StateMachine>(
        &mut self,
        exchange: &mut Exchange<P>,
        turn: &mut Turn<'_>,
    ) {
        let (ego, now_ms) = (turn.ego(), turn.moment().now_ms);
        if let Envelope::Secured(secured) = exchange.stack.envelope_mut() {
            secured.look_at_clock(&ego, now_ms);
        }
        if exchange.robot().identity() != Identity::Unlocked {
            return;
        }
        let lock_ms = u64::from(exchange.config().settings().t_lock.0);
        let (identifiers, robot) = (*exchange.identifiers(), exchange.robot().clone());
        let envelope = exchange.stack.envelope_mut();
        if let Some(taken) = self.take(envelope, &identifiers, &ego, &robot, lock_ms) {
            exchange.change_identity(turn, taken.station, Some(taken.next));
            let surroundings = &mut turn.around.surroundings;
            surroundings.renew_ids(now_ms, taken.clusters);
            self.fall_silent(taken.station, now_ms);
        }
        self.watch_end(exchange, turn, lock_ms);
    }

    /// Makes the robot unavailable while the ticket in use ends within `lock_ms`, as long as a session may take: a robot
    /// that began one would fall silent in the middle of a crossing.
    fn watch_end<P: StateMachine>(
        &mut self,
        exchange: &mut Exchange<P>,
        turn: &mut Turn<'_>,
        lock_ms: u64,
    ) {
        let Envelope::Secured(secured) = exchange.stack.envelope() else {
            return;
        };
        let validity = secured.station().ticket().certificate().content().validity;
        let session_end = turn.moment().timestamp_its.saturating_add(lock_ms);
        let lasts = Time64::of_timestamp_its(session_end) < validity.until();
        let not_safe = Availability::Unavailable(Unavailability::NotSafe);
        let availability = match exchange.robot().availability() {
            Availability::Available if !lasts => not_safe,
            told if lasts && self.have_ended && told == not_safe => Availability::Available,
            _ => return,
        };
        self.have_ended = !lasts;
        if self.have_ended {
            let detail = format_args!(
                "no ticket is valid for {} s from now, as long as a session may take (t_lock); the robot is unavailable \
                 until one is. Make new ones ('crossguard pki tickets') and start it again",
                lock_ms / 1_000
            );
            turn.dropped(Cause::TicketsEnd, &detail, &[]);
        }
        exchange.event(turn, Event::AvailabilityChanged(availability));
    }

    /// The event as the protocol is to have it: another boot counter stands for one that was persisted.
    pub(super) fn disguise<P: StateMachine>(
        &mut self,
        exchange: &Exchange<P>,
        event: Event,
    ) -> Event {
        if let Event::AvailabilityChanged(_) = event {
            self.have_ended = false;
        }
        match (event, exchange.stack.envelope()) {
            (Event::EpochRenewed(boot), Envelope::Secured(_)) => {
                Event::EpochRenewed(self.epoch(exchange.robot().station(), boot))
            }
            (event, _) => event,
        }
    }
}
