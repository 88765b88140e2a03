//! Laws of offers: which a requester counts on, for how long, and which it confirms.

use crate::MAX_FOLLOWERS;
use crate::config::Config;
use crate::id::{Heartbeat, OfferNumber, SessionId, StationId};
use crate::input::{Event, Input, Timer};
use crate::message::{Coordination, Farewell};
use crate::state::{Identity, Offer, Requesting, Role};
use crate::time::Millis;

use super::arithmetic::{a_reservation_outlasts, age_ms, beat_is_newer, is_over_before};
use super::part::{each_offer, leading, own_number, requesting};
use super::taken::Taken;

/// All laws of this module.
pub fn all(config: &Config, step: &Taken) {
    an_older_offer_replaces_nothing(config, step);
    an_offer_goes_only_for_a_reason(step);
    an_offer_that_is_taken_back_is_gone(step);
    only_offers_that_stand_are_confirmed(step);
    offers_stand_in_order(step);
    an_offer_that_is_news_is_taken(config, step);
    enough_offers_are_selected(step);
    an_offer_that_does_not_stand_is_declined(step);
}

/// True if a heartbeat is one that the requester may have sent.
const fn is_echo_of(requesting: &Requesting, echo: Heartbeat) -> bool {
    requesting.heartbeat.0.wrapping_sub(echo.0) < 1 << 15
}

fn offer_of(requesting: &Requesting, station: StationId) -> Option<&Offer> {
    requesting
        .offers
        .iter()
        .find(|offer| offer.station == station)
}

/// An offer to this requester's session, as a RAM makes it.
pub(super) struct Made {
    station: StationId,
    number: OfferNumber,
    echo: Heartbeat,
    t_safety: Millis,
    /// How long ago the requester sent what it echoes, in ms.
    pub(super) age_ms: u64,
}

impl Made {
    /// True if this is what the requester knows of the helper.
    pub(super) fn is(&self, offer: &Offer) -> bool {
        (self.station, self.number, self.echo) == (offer.station, offer.number, offer.echo)
    }
}

/// The offer that the input makes.
pub(super) fn made(config: &Config, step: &Taken) -> Option<Made> {
    let (Input::Ram { ram, .. }, Some(before)) = (step.input, requesting(&step.before)) else {
        return None;
    };
    let next_ram = step.before.next_ram().unwrap_or(Millis::ZERO);
    match ram.coordination {
        Coordination::OfferHelp {
            session,
            offer,
            echo,
            t_safety,
            ..
        } if step.before.session() == Some(session) => Some(Made {
            station: ram.station,
            number: offer,
            echo,
            t_safety,
            age_ms: age_ms(config, before.heartbeat, echo, next_ram),
        }),
        _ => None,
    }
}

/// True if a lease of this robot ends before a follower with this `t_safety` can have fallen back.
fn fits(config: &Config, t_safety: Millis) -> bool {
    let settings = config.settings();
    is_over_before(settings, settings.t_lease.0.into(), t_safety.0.into())
}

/// An offer is taken in, or renewed, only from what its helper says, only if the lease fits its `t_safety`,
/// and never over a newer one. For how long it stands then,
/// [`times`](super::times::offers_stand_as_long_as_they_can) says.
pub fn an_older_offer_replaces_nothing(config: &Config, step: &Taken) {
    let (Some(before), Some(after)) = (requesting(&step.before), requesting(&step.after)) else {
        return;
    };
    // It echoes a heartbeat that was sent.
    let made = made(config, step)
        .filter(|made| is_echo_of(before, made.echo) && fits(config, made.t_safety));
    each_offer(after, before, |offer, known| {
        if let Some(known) = known
            && (known.number, known.echo) == (offer.number, offer.echo)
        {
            assert!(offer.standing.left() <= known.standing.left());
            return;
        }
        assert!(made.as_ref().is_some_and(|made| made.is(offer)));
        assert!(known.is_none_or(|known| {
            leaves(step, known)
                || offer.number > known.number
                || (offer.number == known.number && beat_is_newer(offer.echo, known.echo))
        }));
    });
}

/// True if a RAM of the helper names this offer as left, or a newer one.
fn leaves(step: &Taken, offer: &Offer) -> bool {
    let Input::Ram { ram, .. } = step.input else {
        return false;
    };
    match ram.farewell {
        Some(Farewell::Left(session, number)) => {
            ram.station == offer.station
                && step.before.session() == Some(session)
                && number >= offer.number
        }
        _ => false,
    }
}

/// An offer that stood is gone because its helper left by it or a newer one, because it lapsed, or because
/// the list was full of better ones.
pub fn an_offer_goes_only_for_a_reason(step: &Taken) {
    let (Some(before), Some(after)) = (requesting(&step.before), requesting(&step.after)) else {
        return;
    };
    each_offer(before, after, |offer, then| {
        if then.is_some() {
            return;
        }
        assert!(match step.input {
            Input::Elapsed(elapsed) => offer.standing.left() <= Some(elapsed),
            Input::Expired(timer) => timer == Timer::Offer(offer.station),
            Input::Ram { .. } => leaves(step, offer) || before.offers.len() == after.offers.len(),
            _ => false,
        });
    });
}

/// W7: a helper that takes an offer back is not counted on by it, whatever else the same RAM says.
pub fn an_offer_that_is_taken_back_is_gone(step: &Taken) {
    let Some(after) = requesting(&step.after) else {
        return;
    };
    for offer in after.offers.iter() {
        assert!(!leaves(step, offer));
    }
}

/// A requester that becomes a leader confirms as many as it asked for, each by an offer that stands.
pub fn only_offers_that_stand_are_confirmed(step: &Taken) {
    let (Some(before), Some(after)) = (requesting(&step.before), leading(&step.after)) else {
        return;
    };
    assert!(after.number == before.number && after.request == before.request);
    if !matches!(step.input, Input::Elapsed(_)) {
        assert!(after.members.len() == usize::from(before.request.followers));
    }
    let passed = match step.input {
        Input::Elapsed(elapsed) => elapsed,
        _ => Millis::ZERO,
    };
    for member in after.members.iter() {
        let offer = offer_of(before, member.station);
        assert!(offer.is_some_and(|offer| {
            offer.number == member.offer && offer.standing.left() > Some(passed)
        }));
        assert!(!member.has_joined() && member.outstanding.is_none() && member.order.is_none());
    }
}

/// How good an offer is: what its helper can do of what is asked for, then how near it is, then its station id.
fn goodness(offer: &Offer) -> (u32, u16, u32) {
    let can = offer.capabilities.0.count_ones();
    (16 - can, offer.distance.0, offer.station.0)
}

/// The best offer stands first.
pub fn offers_stand_in_order(step: &Taken) {
    let Some(after) = requesting(&step.after) else {
        return;
    };
    let mut better: Option<&Offer> = None;
    for worse in after.offers.iter() {
        assert!(better.is_none_or(|better| goodness(better) < goodness(worse)));
        better = Some(worse);
    }
}

/// W7: an offer that is newer than what is known of its helper is taken, if it stands at all and there is room.
pub fn an_offer_that_is_news_is_taken(config: &Config, step: &Taken) {
    let (Input::Ram { ram, .. }, Some(before)) = (step.input, requesting(&step.before)) else {
        return;
    };
    let Some(made) = made(config, step) else {
        return;
    };
    let Made { number, echo, .. } = made;
    let is_own = ram.station == step.before.station();
    let is_full = before.offers.len() == MAX_FOLLOWERS;
    if is_own || is_full || ram.farewell.is_some() {
        return;
    }
    let is_news = offer_of(before, ram.station).is_none_or(|known| {
        number > known.number || (number == known.number && beat_is_newer(echo, known.echo))
    });
    let stands = a_reservation_outlasts(config, made.age_ms + 1);
    let known = requesting(&step.after).and_then(|after| offer_of(after, ram.station));
    let is_taken = !step.is_ignored() && known.is_some_and(|known| made.is(known));
    assert!(
        is_taken == (is_news && is_echo_of(before, echo) && stands && fits(config, made.t_safety))
    );
}

/// L1, W7: a requester gets to lead as soon as its time to gather is over, or all have answered, and there are
/// as many offers as it asked for; it takes the best.
pub fn enough_offers_are_selected(step: &Taken) {
    let Some(before) = requesting(&step.before) else {
        return;
    };
    let selects = match step.input {
        Input::Local(Event::AllAnswered) => true,
        Input::Expired(Timer::Selection) => before.selection.is_armed(),
        _ => return,
    };
    let wanted = usize::from(before.request.followers);
    let are_enough = before.offers.len() >= wanted;
    let after = leading(&step.after);
    assert!(after.is_some() == (selects && are_enough));
    if let Some(after) = after {
        let mut members = after.members.iter();
        for offer in before.offers.iter() {
            let Some(member) = members.next() else { break };
            assert!(member.station == offer.station);
        }
        assert!(after.members.len() == wanted);
    }
}

/// W6: a leader that lists this robot by an offer which it made and which does not stand is told so.
pub fn an_offer_that_does_not_stand_is_declined(step: &Taken) {
    let (before, Input::Ram { ram, .. }) = (&step.before, step.input) else {
        return;
    };
    let Coordination::Leader {
        number, followers, ..
    } = ram.coordination
    else {
        return;
    };
    let may_compete = matches!(before.role(), Role::Requester | Role::Leader);
    if may_compete || ram.station == before.station() || ram.farewell.is_some() {
        return;
    }
    let session = SessionId::of(ram.station, number);
    let Some(listed) = followers.iter().find(|f| f.station == before.station()) else {
        return;
    };
    let stands = own_number(before) == Some((session, listed.offer.0));
    if before.has_issued(listed.offer.0) && !stands && before.identity() != Identity::Expiring {
        assert!(step.after.farewell() == Some(Farewell::Left(session, listed.offer)));
        assert!(step.after.session() != Some(session));
    }
}
