//! Stage 5, Termination: how sessions end, how robots leave them, and how both are announced.
//!
//! The end of a session is announced by naming it; a bare `helpStatus = none` ends nothing. A
//! farewell stands for a while, and is repeated to every robot that still believes in the session.

use crate::id::{OfferNumber, SessionId, StationId};
use crate::message::{Ending, Farewell};
use crate::output::{
    CorridorClosure, EndReason, GoneReason, Ignored, Maneuver, Notice, Output, ReleaseReason, Sink,
    StopReason,
};
use crate::robot::{Effect, Step};
use crate::state::{Corridor, Duty, Identity, Phase, Robot, StandingFarewell};
use crate::time::Countdown;

impl Robot {
    /// The leader's application says that the pedestrian has crossed.
    pub(crate) fn complete_task(&mut self, step: &mut Step<'_, impl Sink>) -> Effect {
        match self.phase {
            Phase::Requesting(_) | Phase::Leading(_) => {
                self.end_session(step, EndReason::TaskCompleted);
                Ok(())
            }
            Phase::Idle | Phase::Offering(_) | Phase::Following(_) => Err(Ignored::NotLeading),
        }
    }

    /// The application says that the road is clear, and that the body's fallback is finished.
    pub(crate) fn clear_road(&mut self, step: &mut Step<'_, impl Sink>) -> Effect {
        // R20
        if self.duty.take().is_some() {
            step.out.push(Output::SendRam);
            self.forget_people();
            return Ok(());
        }
        let Phase::Leading(leading) = &mut self.phase else {
            return self
                .forget_people()
                .then_some(())
                .ok_or(Ignored::NothingNew);
        };
        match leading.corridor {
            Corridor::Clear => return Err(Ignored::NothingNew),
            Corridor::Open => return Err(Ignored::CorridorOpen),
            Corridor::Clearing => leading.corridor = Corridor::Clear,
        }
        if let Some(other) = leading.yields_to {
            self.end_session(step, EndReason::Withdrawn(other));
        }
        Ok(())
    }

    /// This follower itself sees somebody on the road.
    pub(crate) fn see_person(&mut self) -> Effect {
        let Phase::Following(following) = &mut self.phase else {
            return Err(Ignored::NotExecuting);
        };
        if following.sees_people {
            return Err(Ignored::NothingNew);
        }
        // R29: from now on every end is a fallback.
        following.sees_people = true;
        Ok(())
    }

    /// This follower sees nobody on the road any more; whether it saw somebody.
    fn forget_people(&mut self) -> bool {
        match &mut self.phase {
            Phase::Following(following) => core::mem::take(&mut following.sees_people),
            _ => false,
        }
    }

    /// Another leader goes before at the same place: nobody is let across any more, and the session ends
    /// once the road is clear.
    pub(crate) fn yield_place(&mut self, step: &mut Step<'_, impl Sink>, other: StationId) {
        let Phase::Leading(leading) = &mut self.phase else {
            return;
        };
        leading.yields_to = Some(other);
        step.out.notify(Notice::Yielded(other));
        // R6: nobody steps on the road any more; who is there keeps the guards.
        leading.shut(step, CorridorClosure::Yielded(other));
        if leading.corridor == Corridor::Clear {
            self.end_session(step, EndReason::Withdrawn(other));
        } else {
            step.out.push(Output::SendRam);
        }
    }

    /// Ends a maneuver by its task's policy; the robot is on duty until the road is clear.
    pub(crate) fn fall_back(&mut self, step: &mut Step<'_, impl Sink>, maneuver: Maneuver) {
        let policy = step.config.fallback(maneuver.task);
        step.out.push(Output::FallBack(maneuver, policy));
        // R20: until the application says that the road is clear.
        self.duty = Some(Duty::FallingBack(maneuver));
    }

    /// The application wants to leave: a leader ends its session, a helper or follower leaves it.
    pub(crate) fn leave_on_request(&mut self, step: &mut Step<'_, impl Sink>) -> Effect {
        match self.phase {
            Phase::Idle => return Err(Ignored::NotInSession),
            Phase::Requesting(_) | Phase::Leading(_) => {
                self.end_session(step, EndReason::LeaveRequested);
            }
            Phase::Offering(_) | Phase::Following(_) => {
                self.leave(step, ReleaseReason::LeaveRequested);
            }
        }
        Ok(())
    }

    /// Ends the robot's own session and names it as ended.
    pub(crate) fn end_session(&mut self, step: &mut Step<'_, impl Sink>, why: EndReason) {
        let ending = match why {
            EndReason::TaskCompleted => Ending::Completed,
            _ => Ending::Aborted,
        };
        let number = match &mut self.phase {
            Phase::Requesting(requesting) => requesting.number,
            Phase::Leading(leading) => {
                leading.shut(step, CorridorClosure::SessionEnded);
                // R19: an end under people is a duty.
                if leading.corridor != Corridor::Clear && ending == Ending::Aborted {
                    self.duty = Some(Duty::Crossing(SessionId::of(self.station, leading.number)));
                }
                leading.number
            }
            Phase::Idle | Phase::Offering(_) | Phase::Following(_) => return,
        };
        self.phase = Phase::Idle;
        step.out
            .notify(Notice::SessionEnded(self.own_session(number), why));
        let _ = self.say_farewell(step, Farewell::Ended(number, ending));
    }

    /// Leaves another robot's session and names it as left.
    pub(crate) fn leave(&mut self, step: &mut Step<'_, impl Sink>, why: ReleaseReason) {
        let (session, offer) = match &self.phase {
            Phase::Offering(offering) => (offering.session, offering.number),
            Phase::Following(following) => (following.session, following.offer),
            Phase::Idle | Phase::Requesting(_) | Phase::Leading(_) => return,
        };
        self.release(step, why);
        let _ = self.say_farewell(step, Farewell::Left(session, offer));
    }

    /// Has no part in another robot's session any more; the leader knows already or need not know.
    pub(crate) fn release(&mut self, step: &mut Step<'_, impl Sink>, why: ReleaseReason) {
        let session = match &self.phase {
            Phase::Offering(offering) => offering.session,
            Phase::Following(following) => {
                let session = following.session;
                if let Some(maneuver) = following.executing() {
                    // R19: only a completed crossing frees a guard. R29: and only one that sees nobody.
                    if why == ReleaseReason::TaskCompleted && !following.sees_people {
                        let why = StopReason::Released(why);
                        step.out.push(Output::StopManeuver(maneuver, why));
                    } else {
                        self.fall_back(step, maneuver);
                    }
                }
                session
            }
            Phase::Idle | Phase::Requesting(_) | Phase::Leading(_) => return,
        };
        self.phase = Phase::Idle;
        step.out.notify(Notice::Released(session, why));
        step.out.push(Output::SendRam);
    }

    /// Announces that a session is over, from now on for `T_farewell`.
    pub(crate) fn say_farewell(
        &mut self,
        step: &mut Step<'_, impl Sink>,
        farewell: Farewell,
    ) -> Effect {
        if self.farewell() == Some(farewell) {
            return Err(Ignored::NothingNew);
        }
        if self.identity == Identity::Expiring {
            // Another farewell would keep the identity locked beyond its limit.
            return Err(Ignored::IdentityLockLimit);
        }
        // R21
        let left = Countdown::armed(step.config.settings().t_farewell);
        self.farewell = Some(StandingFarewell { farewell, left });
        step.out.push(Output::SendRam);
        Ok(())
    }

    /// Another robot names a session as over.
    pub(crate) fn hear_farewell(
        &mut self,
        step: &mut Step<'_, impl Sink>,
        from: StationId,
        farewell: Farewell,
    ) -> Effect {
        match farewell {
            Farewell::Ended(number, ending) => {
                let ended = SessionId::of(from, number);
                // R21: named by its number, or not meant.
                if self.session() != Some(ended) {
                    return Err(Ignored::OtherSession);
                }
                if let Phase::Offering(offering) = &self.phase {
                    let number = offering.number;
                    self.take_back_number(number);
                }
                let why = match ending {
                    Ending::Completed => ReleaseReason::TaskCompleted,
                    Ending::Aborted => ReleaseReason::SessionEnded,
                };
                self.release(step, why);
                Ok(())
            }
            Farewell::Left(session, offer) => self.hear_left(step, from, session, offer),
        }
    }

    fn hear_left(
        &mut self,
        step: &mut Step<'_, impl Sink>,
        from: StationId,
        session: SessionId,
        offer: OfferNumber,
    ) -> Effect {
        if session.leader != self.station {
            return Err(Ignored::NotAddressed);
        }
        match &mut self.phase {
            Phase::Requesting(requesting) if requesting.number == session.number => {
                if requesting.forget_offer(|known| known.station == from && known.number <= offer) {
                    Ok(())
                } else {
                    Err(Ignored::NothingNew)
                }
            }
            Phase::Leading(leading) if leading.number == session.number => {
                let member = leading.member(from).ok_or(Ignored::NotAFollower)?;
                if offer < member.offer {
                    return Err(Ignored::OtherOffer);
                }
                self.drop_follower(step, from, GoneReason::Left);
                Ok(())
            }
            _ => Err(Ignored::OtherSession),
        }
    }

    /// Names a session of this robot as ended once more, perhaps one of an earlier life, for a peer that still takes
    /// part in it.
    ///
    /// Anybody can ask so, with any number. While a farewell stands nobody is answered, so made-up numbers bring about
    /// one RAM in the time of a farewell, and take no farewell's place.
    pub(crate) fn answer_stale_session(
        &mut self,
        step: &mut Step<'_, impl Sink>,
        session: SessionId,
    ) -> Effect {
        if self.session() == Some(session) {
            // It is not over; the sender claims a part in it that nobody gave it.
            return Err(Ignored::NotAFollower);
        }
        match self.farewell_session() {
            // How it ended is being said.
            Some(named) if named == session => Err(Ignored::NothingNew),
            Some(_) => Err(Ignored::AnsweringAnother),
            None => self.say_farewell(step, Farewell::Ended(session.number, Ending::Aborted)),
        }
    }

    /// The robot takes part in `session`: to go on saying that it is over would undo that.
    pub(crate) fn withdraw_farewell(&mut self, session: SessionId) {
        if self.farewell_session() == Some(session) {
            self.farewell = None;
        }
    }
}
