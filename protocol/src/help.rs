//! Stage 2, Help establishment: requests, offers and their reservation, two requesters.

use core::cmp::Reverse;

use crate::id::{OfferNumber, SessionId, StationId};
use crate::list::List;
use crate::output::{EndReason, Ignored, Notice, Output, ReleaseReason, Sink};
use crate::robot::{Effect, Step};
use crate::state::{Leading, Lease, Member, Offer, Offering, Phase, Requesting, Robot};
use crate::task::{HelpRequest, Urgency};
use crate::time::Countdown;

/// A request's place in the total order of requests: the smaller key goes before.
type Precedence = (Reverse<Urgency>, StationId);

const fn precedence(request: HelpRequest, leader: StationId) -> Precedence {
    (Reverse(request.urgency), leader)
}

/// An offer's place in the order of selection: capability match, then distance, then station id.
/// The smaller key is the better offer.
pub(crate) fn rank(offer: &Offer) -> impl Ord + use<> {
    (
        Reverse(offer.capabilities.len()),
        offer.distance,
        offer.station,
    )
}

impl Robot {
    /// `needHelp` of another robot.
    pub(crate) fn hear_request(
        &mut self,
        step: &mut Step<'_, impl Sink>,
        session: SessionId,
        request: HelpRequest,
    ) -> Effect {
        match &self.phase {
            Phase::Idle => self.offer(step, session, request),
            Phase::Requesting(own) => {
                let own_precedence = precedence(own.request, self.station);
                if precedence(request, session.leader) > own_precedence {
                    return Err(Ignored::LowerPrecedence);
                }
                // The request that goes before is helped rather than competed with.
                self.end_session(step, EndReason::Withdrawn(session.leader));
                // Where this robot cannot help, it has withdrawn all the same.
                let _ = self.offer(step, session, request);
                Ok(())
            }
            Phase::Offering(offering) if offering.session == session => Err(Ignored::NothingNew),
            Phase::Following(following) if following.session == session => Err(Ignored::NothingNew),
            Phase::Offering(_) | Phase::Leading(_) | Phase::Following(_) => Err(Ignored::InSession),
        }
    }

    /// Reserves the robot for one requester.
    fn offer(
        &mut self,
        step: &mut Step<'_, impl Sink>,
        session: SessionId,
        request: HelpRequest,
    ) -> Effect {
        self.may_join()?;
        let capabilities = step
            .config
            .settings()
            .capabilities
            .intersection(request.tasks);
        if capabilities.is_empty() {
            return Err(Ignored::UnsupportedTask);
        }
        let number = OfferNumber(self.issue_number()?);
        let reservation = Countdown::armed(step.config.settings().t_offer);
        self.phase = Phase::Offering(Offering {
            session,
            number,
            capabilities,
            reservation,
        });
        self.withdraw_farewell(session);
        step.out.notify(Notice::Offering(session));
        step.out.push(Output::SendRam);
        Ok(())
    }

    /// `offerHelp` of another robot.
    pub(crate) fn hear_offer(
        &mut self,
        step: &mut Step<'_, impl Sink>,
        session: SessionId,
        offer: Offer,
    ) -> Effect {
        if session.leader != self.station {
            return Err(Ignored::NotAddressed);
        }
        match &mut self.phase {
            Phase::Requesting(requesting) if requesting.number == session.number => {
                requesting.take_offer(step, offer)
            }
            Phase::Leading(leading) if leading.number == session.number => {
                // The helper learns from the list of followers whether it is one of them.
                Err(Ignored::RolesAlreadyAssigned)
            }
            _ => self.answer_stale_session(step, session),
        }
    }

    /// The time to gather offers has run out: confirm the best, or gather on.
    pub(crate) fn selection_expired(&mut self, step: &mut Step<'_, impl Sink>) {
        let Phase::Requesting(requesting) = &mut self.phase else {
            return;
        };
        let settings = step.config.settings();
        if requesting.offers.len() < usize::from(requesting.request.followers) {
            requesting.selection = Countdown::armed(settings.t_select);
            return;
        }
        let member = |offer: &Offer| Member {
            station: offer.station,
            offer: offer.number,
            echoed: None,
            lease: Lease::Expired(Countdown::armed(step.config.t_lost())),
            next_request: settings.first_request,
            outstanding: None,
            order: None,
        };
        let number = requesting.number;
        let leading = Leading {
            number,
            request: requesting.request,
            heartbeat: settings.first_heartbeat,
            members: requesting
                .offers
                .iter()
                .take(usize::from(requesting.request.followers))
                .map(member)
                .collect(),
            corridor_open: false,
        };
        self.phase = Phase::Leading(leading);
        // The first heartbeat's period starts with the role.
        self.ram = Countdown::armed(settings.ram_period);
        step.out
            .notify(Notice::RolesEstablished(self.own_session(number)));
        step.out.push(Output::SendRam);
    }

    /// `T_help` has run out.
    pub(crate) fn help_expired(&mut self, step: &mut Step<'_, impl Sink>) {
        self.end_session(step, EndReason::NoHelp);
    }

    /// `T_offer` has run out: the helper is free for other requesters. If the leader confirms it
    /// all the same, it says that it has no part in the session.
    pub(crate) fn reservation_expired(&mut self, step: &mut Step<'_, impl Sink>) {
        self.release(step, ReleaseReason::ReservationExpired);
    }
}

impl Requesting {
    fn take_offer(&mut self, step: &mut Step<'_, impl Sink>, offer: Offer) -> Effect {
        if self.offers.iter().any(|known| *known == offer) {
            return Err(Ignored::NothingNew);
        }
        self.forget_offer(offer.station);
        self.offers.insert_ranked(offer, |a, b| rank(a) < rank(b));
        if !self.selection.is_armed() {
            self.selection = Countdown::armed(step.config.settings().t_select);
        }
        Ok(())
    }

    /// Forgets what `station` offered; whether there was anything.
    pub(crate) fn forget_offer(&mut self, station: StationId) -> bool {
        self.offers
            .remove_first(|offer| offer.station == station)
            .is_some()
    }

    /// Whether the offers stand in the order of selection, one per station.
    pub(crate) fn offers_are_ranked(&self) -> bool {
        self.offers.is_dense()
            && self
                .offers
                .iter()
                .zip(self.offers.iter().skip(1))
                .all(|(a, b)| rank(a) < rank(b))
            && all_distinct(&self.offers, |offer| offer.station)
    }
}

/// Whether no two items have the same key.
pub(crate) fn all_distinct<T: Copy, K: PartialEq, const N: usize>(
    list: &List<T, N>,
    key: impl Fn(&T) -> K,
) -> bool {
    let mut rest = list.iter();
    while let Some(a) = rest.next() {
        if rest.clone().any(|b| key(a) == key(b)) {
            return false;
        }
    }
    true
}
