//! Stage 3, Role assignment: joining, heartbeats, leases, loss of contact.
//!
//! The lease theorem (property I10). A leader counts its lease on a follower from the moment at
//! which it *sent* the newest heartbeat that the follower echoed. The follower restarts `T_safety`
//! when it *hears* a newer heartbeat, which is never before it was sent. The lease is shorter than
//! `T_safety` by more than two clocks can drift apart
//! ([`Inequality::LeaseWithinSafety`](crate::Inequality::LeaseWithinSafety)). So while the lease
//! stands, the follower cannot have fallen back for lack of contact, however messages are delayed.

use core::cmp::Ordering;

use crate::claim::Claim;
use crate::config::Config;
use crate::id::{Heartbeat, OfferNumber, SessionId, StationId};
use crate::message::{Farewell, Followers, Progress, Report};
use crate::output::{EndReason, GoneReason, Ignored, Notice, Output, ReleaseReason, Sink};
use crate::robot::{Effect, Step};
use crate::state::{Contact, Following, Leading, Lease, Member, Phase, Rival, Robot};
use crate::time::{Countdown, Millis};

impl Robot {
    /// The RAM of a leader: it confirms, keeps alive, or leaves out.
    pub(crate) fn hear_leader(
        &mut self,
        step: &mut Step<'_, impl Sink>,
        heard: Rival,
        followers: &Followers,
        claim: Option<Claim>,
    ) -> Effect {
        let Rival { session, heartbeat } = heard;
        let listed = followers
            .iter()
            .find(|f| f.station == self.station)
            .map(|f| f.offer);
        match &mut self.phase {
            Phase::Offering(offering) if offering.session == session => {
                // R2: listed by the number of this offer.
                if listed == Some(offering.number) {
                    let offer = offering.number;
                    self.join(step, heard, offer);
                    return Ok(());
                }
            }
            Phase::Following(following) if following.session == session => {
                // R2: and so at every RAM.
                if listed == Some(following.offer) {
                    return following.hear_heartbeat(step, heartbeat);
                }
            }
            _ => {
                let competed = self.compete(step, heard, claim);
                // Listed for an offer that has expired, or that an earlier life of this robot made. Where the
                // robot has just ended its own session, that is what it says first.
                return match (competed, listed) {
                    (Err(_), Some(offer)) => self.decline(step, session, offer),
                    _ => competed,
                };
            }
        }
        self.release(step, ReleaseReason::NotListed);
        if let Some(offer) = listed {
            // The leader believes that an earlier offer of this robot still stands.
            let _ = self.decline(step, session, offer);
        }
        Ok(())
    }

    /// Tells a leader that the offer which it lists does not stand.
    fn decline(
        &mut self,
        step: &mut Step<'_, impl Sink>,
        session: SessionId,
        offer: OfferNumber,
    ) -> Effect {
        if !self.has_issued(offer.0) {
            return Err(Ignored::NeverOffered);
        }
        self.say_farewell(step, Farewell::Left(session, offer))
    }

    /// A requester withdraws for a leader at the same place; a leader yields to one that goes before.
    /// Both do so at the second message.
    fn compete(
        &mut self,
        step: &mut Step<'_, impl Sink>,
        heard: Rival,
        claim: Option<Claim>,
    ) -> Effect {
        let station = self.station;
        let other = heard.session.leader;
        match &mut self.phase {
            Phase::Requesting(own) => {
                let claim = claim.ok_or(Ignored::Yielding)?;
                if !claim.place.may_be(own.request.place) {
                    return Err(Ignored::OtherPlace);
                }
                if heard.counts(&mut own.rival)? {
                    self.end_session(step, EndReason::Withdrawn(other));
                }
                Ok(())
            }
            Phase::Leading(own) => {
                let claim = claim.ok_or(Ignored::Yielding)?;
                claim.goes_before(other, Claim::of(own.request), station)?;
                if own.yields_to.is_some() {
                    return Err(Ignored::NothingNew);
                }
                if heard.counts(&mut own.rival)? {
                    self.yield_place(step, other);
                }
                Ok(())
            }
            Phase::Idle | Phase::Offering(_) | Phase::Following(_) => Err(Ignored::NotAddressed),
        }
    }

    fn join(&mut self, step: &mut Step<'_, impl Sink>, leader: Rival, offer: OfferNumber) {
        step.out.notify(Notice::Joined(leader.session));
        self.phase = Phase::Following(Following {
            session: leader.session,
            offer,
            heard: leader.heartbeat,
            contact: Contact::Fresh(Countdown::armed(step.config.settings().t_safety)),
            job: None,
            refused: None,
            sees_people: false,
        });
        step.out.push(Output::SendRam);
    }

    /// The RAM of a follower: it has joined, echoes a heartbeat, reports progress.
    pub(crate) fn hear_follower(
        &mut self,
        step: &mut Step<'_, impl Sink>,
        from: StationId,
        session: SessionId,
        echo: Heartbeat,
        last: Option<Report>,
    ) -> Effect {
        if session.leader != self.station {
            return Err(Ignored::NotAddressed);
        }
        let next_ram = self.ram.left().unwrap_or(Millis::ZERO);
        match &mut self.phase {
            Phase::Leading(leading) if leading.number == session.number => {
                if !leading.heartbeat.can_follow(echo) {
                    return Err(Ignored::EchoFromFuture);
                }
                let age = age_of(step.config, leading.heartbeat, echo, next_ram);
                let heard = leading.update_member(from, |member| {
                    let echoed = member.hear_echo(step, echo, age);
                    let Some(report) = last else { return echoed };
                    let order = match echoed {
                        Ok(()) => Ordering::Greater,
                        Err(_) if member.echoed == Some(echo) => Ordering::Equal,
                        Err(_) => Ordering::Less,
                    };
                    let reported = member.hear_report(step, session, report, order);
                    echoed.or(reported)
                });
                heard.unwrap_or(Err(Ignored::NotAFollower))
            }
            _ => self.answer_stale_session(step, session),
        }
    }

    /// `T_safety` ran out: the maneuver is stopped by its task's policy (I9).
    pub(crate) fn safety_expired(&mut self, step: &mut Step<'_, impl Sink>) {
        let Phase::Following(following) = &mut self.phase else {
            return;
        };
        following.contact = Contact::Lost(Countdown::armed(step.config.settings().t_leave));
        let session = following.session;
        // R14: by the task's policy; then `t_leave` runs.
        if let Some(maneuver) = following.finish(Progress::SafeIdle) {
            self.fall_back(step, maneuver);
            step.out.push(Output::SendRam);
        }
        step.out.notify(Notice::ContactLost(session));
    }

    /// The lease on a follower ran out.
    pub(crate) fn lease_expired(&mut self, step: &mut Step<'_, impl Sink>, station: StationId) {
        let Phase::Leading(leading) = &mut self.phase else {
            return;
        };
        leading.update_member(station, |member| {
            member.lease = Lease::Expired(Countdown::armed(step.config.t_lost()));
            step.out.notify(Notice::LeaseExpired(station));
        });
    }

    /// Removes one follower; the records of the others stay as they are (property I17).
    pub(crate) fn drop_follower(
        &mut self,
        step: &mut Step<'_, impl Sink>,
        station: StationId,
        why: GoneReason,
    ) {
        let Phase::Leading(leading) = &mut self.phase else {
            return;
        };
        // R22: this record alone.
        leading
            .members
            .remove_first(|member| member.station == station);
        let nobody_left = leading.members.is_empty();
        step.out.notify(Notice::FollowerGone(station, why));
        // The new list tells the follower, should it still be there.
        step.out.push(Output::SendRam);
        if nobody_left {
            self.end_session(step, EndReason::NoFollowers);
        }
    }
}

/// How long ago `heartbeat` can have been sent at the earliest, where `newest` is the newest and the next
/// RAM is due in `next_ram`. Heartbeats count periods, so this is never less than the true age.
#[must_use]
pub(crate) fn age_of(
    config: &Config,
    newest: Heartbeat,
    heartbeat: Heartbeat,
    next_ram: Millis,
) -> Millis {
    let period = config.settings().ram_period;
    let periods = u32::from(newest.distance_from(heartbeat));
    let in_this_period = period.saturating_sub(next_ram);
    Millis(periods.saturating_mul(period.0)).saturating_add(in_this_period)
}

impl Leading {
    /// A follower whose newest echo this leader will not be able to put in order in `periods`.
    pub(crate) fn follower_out_of_order(&self, periods: u16) -> Option<StationId> {
        let lag = |echoed| u32::from(self.heartbeat.distance_from(echoed)) + u32::from(periods);
        let out_of_order = |member: &&Member| {
            member
                .echoed
                .is_some_and(|e| lag(e) >= Heartbeat::HALF_SPACE)
        };
        let member = self.members.iter().find(out_of_order)?;
        Some(member.station)
    }
}

impl Member {
    /// An echo of a heartbeat that was sent `age` ago.
    fn hear_echo(
        &mut self,
        step: &mut Step<'_, impl Sink>,
        echo: Heartbeat,
        age: Millis,
    ) -> Effect {
        match self.echoed {
            Some(newest) if !echo.is_newer_than(newest) => return Err(Ignored::OldHeartbeat),
            Some(_) => {}
            None => step.out.notify(Notice::FollowerJoined(self.station)),
        }
        self.echoed = Some(echo);
        // R13: from when the heartbeat was sent, not from now.
        let left = step.config.settings().t_lease.saturating_sub(age);
        if left > Millis::ZERO {
            if !self.lease.stands() {
                step.out.notify(Notice::LeaseGranted(self.station));
            }
            self.lease = Lease::Stands(Countdown::armed(left));
            step.renewed = true;
        }
        Ok(())
    }
}

impl Following {
    /// Only a *newer* heartbeat restarts `T_safety`: a delayed or repeated RAM proves nothing about
    /// the leader's present.
    fn hear_heartbeat(&mut self, step: &mut Step<'_, impl Sink>, heartbeat: Heartbeat) -> Effect {
        // R12: an older heartbeat renews nothing.
        if !heartbeat.is_newer_than(self.heard) {
            return Err(Ignored::OldHeartbeat);
        }
        self.heard = heartbeat;
        self.renew_contact(step);
        Ok(())
    }

    /// Restarts `T_safety`.
    pub(crate) fn renew_contact(&mut self, step: &mut Step<'_, impl Sink>) {
        if self.contact.is_lost() {
            step.out.notify(Notice::ContactRegained(self.session));
        }
        // R12: in full, by whatever is newer.
        self.contact = Contact::Fresh(Countdown::armed(step.config.settings().t_safety));
    }
}
