//! Stage 1, Initialization: from `Idle` into a session of one's own, and availability.

use crate::id::{SessionNumber, StationId, UniqueNumber};
use crate::list::List;
use crate::message::{Failure, Progress};
use crate::output::{EndReason, Ignored, Output, ReleaseReason, Sink, StopReason};
use crate::robot::{Effect, Step};
use crate::state::{Identity, Phase, Requesting, Robot};
use crate::task::{Availability, HelpRequest, Unavailability};
use crate::time::Countdown;

impl Robot {
    /// `PedestrianDetected` opens a session.
    pub(crate) fn detect_pedestrian(
        &mut self,
        step: &mut Step<'_, impl Sink>,
        request: HelpRequest,
    ) -> Effect {
        if !request.is_possible() {
            return Err(Ignored::ImpossibleRequest);
        }
        if !matches!(self.phase, Phase::Idle) {
            return Err(Ignored::InSession);
        }
        self.may_join()?;
        let number = SessionNumber(self.issue_number(step)?);
        self.open_session(step, number, request);
        Ok(())
    }

    /// Opens a session with a number that was never used before.
    pub(crate) fn open_session(
        &mut self,
        step: &mut Step<'_, impl Sink>,
        number: SessionNumber,
        request: HelpRequest,
    ) {
        self.phase = Phase::Requesting(Requesting {
            number,
            request,
            heartbeat: step.config.settings().first_heartbeat,
            rival: None,
            offers: List::EMPTY,
            help: Countdown::armed(step.config.settings().t_help),
            selection: Countdown::OFF,
        });
        // A peer may have asked about this number before it was given out, and been told that no such session exists.
        self.withdraw_farewell(self.own_session(number));
        step.out.push(Output::SendRam);
    }

    /// Refuses a new part in a session where the robot itself stands in its way.
    pub(crate) fn may_join(&self) -> Effect {
        if let Availability::Unavailable(reason) = self.availability {
            return Err(Ignored::Unavailable(reason));
        }
        // R20: nothing new before the duty is over.
        if self.duty.is_some() {
            return Err(Ignored::OnDuty);
        }
        match self.identity {
            Identity::Expiring => Err(Ignored::IdentityLockLimit),
            Identity::Unlocked | Identity::Locked(_) => Ok(()),
        }
    }

    /// Availability withdraws an offer, ends the session of a leader, and makes a follower fail or
    /// leave.
    pub(crate) fn change_availability(
        &mut self,
        step: &mut Step<'_, impl Sink>,
        availability: Availability,
    ) -> Effect {
        if self.availability == availability {
            return Err(Ignored::NothingNew);
        }
        self.availability = availability;
        // R24: the status container of its RAM says so at once.
        step.out.push(Output::SendRam);
        if let Availability::Unavailable(reason) = availability {
            self.become_unavailable(step, reason);
        }
        Ok(())
    }

    fn become_unavailable(&mut self, step: &mut Step<'_, impl Sink>, reason: Unavailability) {
        match &mut self.phase {
            Phase::Idle => {}
            Phase::Requesting(_) | Phase::Leading(_) => {
                self.end_session(step, EndReason::Unavailable(reason));
            }
            Phase::Offering(_) => self.leave(step, ReleaseReason::Unavailable(reason)),
            Phase::Following(following) => {
                let failed = Progress::Failed(Failure::Unavailable(reason));
                match following.finish(failed) {
                    Some(maneuver) if reason.can_fall_back() => self.fall_back(step, maneuver),
                    Some(maneuver) => {
                        let why = StopReason::Unavailable(reason);
                        step.out.push(Output::StopManeuver(maneuver, why));
                    }
                    None => self.leave(step, ReleaseReason::Unavailable(reason)),
                }
            }
        }
    }

    /// The pseudonym changes together with everything that is tied to it, and only while no session
    /// knows the robot by its old one. No number of the old one is in use then.
    pub(crate) fn change_identity(
        &mut self,
        station: StationId,
        next: Option<UniqueNumber>,
    ) -> Effect {
        if self.identity != Identity::Unlocked {
            return Err(Ignored::IdentityLocked);
        }
        if self.station == station {
            return Err(Ignored::NothingNew);
        }
        self.station = station;
        if let Some(UniqueNumber { boot, count }) = next {
            self.boot = boot;
            self.next_count = count;
        }
        Ok(())
    }
}
