//! Stage 2, Help establishment: requests, offers and their reservation, two requesters.

use core::cmp::Reverse;

use crate::claim::Claim;
use crate::id::{Heartbeat, OfferNumber, SessionId, StationId};
use crate::list::List;
use crate::output::{EndReason, Ignored, Notice, Output, Sink};
use crate::robot::{Effect, Step};
use crate::roles::age_of;
use crate::state::{
    Corridor, Leading, Lease, Member, Offer, Offering, Phase, Requesting, Rival, Robot,
};
use crate::task::HelpRequest;
use crate::time::{Countdown, Millis};

impl Rival {
    /// Notes a rival that is heard; whether it counts. The first time `known` is changed and nothing else.
    pub(crate) fn counts(self, known: &mut Option<Self>) -> Result<bool, Ignored> {
        let Some(first) = known else {
            *known = Some(self);
            return Ok(false);
        };
        // R6: one message may be late. A second one counts, whichever rival it is of, so that none hides another.
        if first.session == self.session && !self.heartbeat.is_newer_than(first.heartbeat) {
            return Err(Ignored::FirstHeard);
        }
        Ok(true)
    }
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
        heard: Rival,
        request: HelpRequest,
    ) -> Effect {
        let Rival { session, heartbeat } = heard;
        match &mut self.phase {
            Phase::Idle => self.offer(step, heard, request),
            Phase::Requesting(own) => {
                let claim = Claim::of(own.request);
                Claim::of(request).goes_before(session.leader, claim, self.station)?;
                if heard.counts(&mut own.rival)? {
                    // The request that goes before is helped rather than competed with.
                    self.end_session(step, EndReason::Withdrawn(session.leader));
                    // Where this robot cannot help, it has withdrawn all the same.
                    let _ = self.offer(step, heard, request);
                }
                Ok(())
            }
            Phase::Offering(offering) if offering.session == session => {
                offering.hear_heartbeat(step, heartbeat)
            }
            Phase::Following(following) if following.session == session => Err(Ignored::NothingNew),
            Phase::Offering(_) | Phase::Leading(_) | Phase::Following(_) => Err(Ignored::InSession),
        }
    }

    /// Reserves the robot for one requester.
    fn offer(
        &mut self,
        step: &mut Step<'_, impl Sink>,
        heard: Rival,
        request: HelpRequest,
    ) -> Effect {
        let Rival { session, heartbeat } = heard;
        self.may_join()?;
        let capabilities = step
            .config
            .settings()
            .capabilities
            .intersection(request.tasks);
        if capabilities.is_empty() {
            return Err(Ignored::UnsupportedTask);
        }
        let number = OfferNumber(self.issue_number(step)?);
        let reservation = Countdown::armed(step.config.settings().t_offer);
        self.phase = Phase::Offering(Offering {
            session,
            number,
            capabilities,
            heard: heartbeat,
            t_safety: step.config.settings().t_safety,
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
        t_safety: Millis,
    ) -> Effect {
        if session.leader != self.station {
            return Err(Ignored::NotAddressed);
        }
        let next_ram = self.ram.left().unwrap_or(Millis::ZERO);
        match &mut self.phase {
            Phase::Requesting(requesting) if requesting.number == session.number => {
                // R3: no lease outlives the safety timer of the helper.
                if !step.config.lease_fits(t_safety) {
                    return Err(Ignored::TimersDoNotFit);
                }
                requesting.take_offer(step, offer, next_ram)
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
        // R4: enough offers, or `t_select` once more.
        if !requesting.has_enough_offers() {
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
            // The session and its heartbeats go on.
            heartbeat: requesting.heartbeat,
            members: requesting
                .offers
                .first(usize::from(requesting.request.followers), member),
            corridor: Corridor::Clear,
            rival: None,
            yields_to: None,
        };
        self.phase = Phase::Leading(leading);
        step.out
            .notify(Notice::RolesEstablished(self.own_session(number)));
        step.out.push(Output::SendRam);
    }

    /// No other offer can come: what stands is what there is to choose from.
    pub(crate) fn select_early(&mut self, step: &mut Step<'_, impl Sink>) -> Effect {
        match &self.phase {
            // R4: at once, where enough have offered.
            Phase::Requesting(requesting) if requesting.has_enough_offers() => {
                self.selection_expired(step);
                Ok(())
            }
            _ => Err(Ignored::NothingNew),
        }
    }

    /// The offer of a helper has lapsed: the helper may be free for others by now.
    pub(crate) fn offer_expired(&mut self, step: &mut Step<'_, impl Sink>, station: StationId) {
        let Phase::Requesting(requesting) = &mut self.phase else {
            return;
        };
        requesting.forget_offer(|offer| offer.station == station);
        step.out.notify(Notice::OfferLapsed(station));
    }
}

impl Requesting {
    fn has_enough_offers(&self) -> bool {
        self.offers.len() >= usize::from(self.request.followers)
    }

    /// Takes an offer in, or its newer echo. An older offer of the same helper replaces nothing.
    fn take_offer(
        &mut self,
        step: &mut Step<'_, impl Sink>,
        mut offer: Offer,
        next_ram: Millis,
    ) -> Effect {
        if !self.heartbeat.can_follow(offer.echo) {
            return Err(Ignored::EchoFromFuture);
        }
        let of_helper = |known: &&Offer| known.station == offer.station;
        if let Some(known) = self.offers.iter().find(of_helper) {
            if offer.number < known.number {
                return Err(Ignored::OldOffer);
            }
            if offer.number == known.number && !offer.echo.is_newer_than(known.echo) {
                return Err(Ignored::OldHeartbeat);
            }
        }
        let age = age_of(step.config, self.heartbeat, offer.echo, next_ram);
        let left = step.config.t_offer_lease().saturating_sub(age);
        if left == Millis::ZERO {
            return Err(Ignored::OldHeartbeat);
        }
        offer.standing = Countdown::armed(left);
        self.forget_offer(|known| known.station == offer.station);
        self.offers.insert_ranked(offer, |a, b| rank(a) < rank(b));
        if !self.selection.is_armed() {
            self.selection = Countdown::armed(step.config.settings().t_select);
        }
        Ok(())
    }

    /// Forgets the first offer of which that is true; whether there was any.
    pub(crate) fn forget_offer(&mut self, is_meant: impl Fn(&Offer) -> bool) -> bool {
        self.offers.remove_first(is_meant).is_some()
    }

    /// True if the offers stand in the order of selection, one per station.
    pub(crate) fn offers_are_ranked(&self) -> bool {
        self.offers.is_dense()
            && all_in_order(&self.offers, |a, b| rank(a) < rank(b))
            && all_distinct(&self.offers, |offer| offer.station)
    }
}

impl Offering {
    /// A newer heartbeat of the request keeps the robot reserved for it.
    fn hear_heartbeat(&mut self, step: &mut Step<'_, impl Sink>, heartbeat: Heartbeat) -> Effect {
        if !heartbeat.is_newer_than(self.heard) {
            return Err(Ignored::OldHeartbeat);
        }
        self.heard = heartbeat;
        self.reservation = Countdown::armed(step.config.settings().t_offer);
        Ok(())
    }
}

/// True if each item and the next one stand in order.
fn all_in_order<T: Copy, const N: usize>(
    list: &List<T, N>,
    in_order: impl Fn(&T, &T) -> bool,
) -> bool {
    let mut before = None;
    for item in list.iter() {
        if before.is_some_and(|before| !in_order(before, item)) {
            return false;
        }
        before = Some(item);
    }
    true
}

/// True if no two items have the same key.
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
