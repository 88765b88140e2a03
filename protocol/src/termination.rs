//! Stage 5, Termination: how sessions end, how robots leave them, and how both are announced.
//!
//! The end of a session is announced by naming it; a bare `helpStatus = none` ends nothing. A
//! farewell stands for a while, and is repeated to whoever still believes in the session.

use crate::id::{SessionId, StationId};
use crate::message::Farewell;
use crate::output::{
    CorridorClosure, EndReason, GoneReason, Ignored, Notice, Output, ReleaseReason, Sink,
    StopReason,
};
use crate::robot::{Effect, Step};
use crate::state::{Identity, Phase, Robot, StandingFarewell};
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
        let number = match &self.phase {
            Phase::Requesting(requesting) => requesting.number,
            Phase::Leading(leading) => {
                if leading.corridor_open {
                    step.out
                        .push(Output::CorridorClosed(CorridorClosure::SessionEnded));
                }
                leading.number
            }
            Phase::Idle | Phase::Offering(_) | Phase::Following(_) => return,
        };
        self.phase = Phase::Idle;
        step.out
            .notify(Notice::SessionEnded(self.own_session(number), why));
        let _ = self.say_farewell(step, Farewell::Ended(number));
    }

    /// Leaves another robot's session and names it as left.
    pub(crate) fn leave(&mut self, step: &mut Step<'_, impl Sink>, why: ReleaseReason) {
        if let Some(session) = self.session() {
            self.release(step, why);
            let _ = self.say_farewell(step, Farewell::Left(session));
        }
    }

    /// Has no part in another robot's session any more; the leader knows already or need not know.
    pub(crate) fn release(&mut self, step: &mut Step<'_, impl Sink>, why: ReleaseReason) {
        let session = match &self.phase {
            Phase::Offering(offering) => offering.session,
            Phase::Following(following) => {
                if let Some(maneuver) = following.executing() {
                    step.out
                        .push(Output::StopManeuver(maneuver, StopReason::Released(why)));
                }
                following.session
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
            Farewell::Ended(number) => {
                let ended = SessionId {
                    leader: from,
                    number,
                };
                if self.session() != Some(ended) {
                    return Err(Ignored::OtherSession);
                }
                self.release(step, ReleaseReason::SessionEnded);
                Ok(())
            }
            Farewell::Left(session) => self.hear_left(step, from, session),
        }
    }

    fn hear_left(
        &mut self,
        step: &mut Step<'_, impl Sink>,
        from: StationId,
        session: SessionId,
    ) -> Effect {
        if session.leader != self.station {
            return Err(Ignored::NotAddressed);
        }
        match &mut self.phase {
            Phase::Requesting(requesting) if requesting.number == session.number => {
                if requesting.forget_offer(from) {
                    Ok(())
                } else {
                    Err(Ignored::NothingNew)
                }
            }
            Phase::Leading(leading) if leading.number == session.number => {
                if leading.member(from).is_none() {
                    return Err(Ignored::NotAFollower);
                }
                self.drop_follower(step, from, GoneReason::Left);
                Ok(())
            }
            _ => Err(Ignored::OtherSession),
        }
    }

    /// Somebody still takes part in a session of this robot that is over, perhaps one of an earlier
    /// life: name it as ended once more.
    pub(crate) fn answer_stale_session(
        &mut self,
        step: &mut Step<'_, impl Sink>,
        session: SessionId,
    ) -> Effect {
        if self.session() == Some(session) {
            // It is not over; the sender claims a part in it that nobody gave it.
            return Err(Ignored::NotAFollower);
        }
        self.say_farewell(step, Farewell::Ended(session.number))
    }

    /// The robot takes part in `session`: to go on saying that it is over would undo that.
    pub(crate) fn withdraw_farewell(&mut self, session: SessionId) {
        if self.farewell_session() == Some(session) {
            self.farewell = None;
        }
    }

    /// `T_farewell` ran out.
    pub(crate) fn farewell_expired(&mut self) {
        self.farewell = None;
    }
}
