//! Stage 4, Maneuver execution: commands, acknowledgements, repetition, progress.

use core::cmp::Ordering;

use crate::config::Config;
use crate::id::{ManeuverId, RequestId, SessionId, SessionNumber, StationId};
use crate::message::{Answer, Command, Failure, Progress, Rejection, Report, Rmcm, Verdict};
use crate::output::{EndReason, GoneReason, Ignored, Maneuver, Notice, Output, Sink, StopReason};
use crate::robot::{Effect, Step};
use crate::state::{
    Corridor, Duty, Following, Job, Member, Order, Outstanding, Phase, Refusal, Robot,
};
use crate::task::{Availability, TaskType};
use crate::time::Countdown;

// The leader's side.

impl Robot {
    /// The application wants `follower` to do `task`.
    pub(crate) fn command(
        &mut self,
        step: &mut Step<'_, impl Sink>,
        follower: StationId,
        task: TaskType,
    ) -> Effect {
        let Phase::Leading(leading) = &mut self.phase else {
            return Err(Ignored::NotLeading);
        };
        let session = SessionId::of(self.station, leading.number);
        let request = leading.request;
        let member = leading.member(follower);
        let used_up = member
            .is_some_and(|member| member.may_be_commanded().is_ok() && member.is_used_up(step));
        let guards = member.is_some_and(|member| member.guards(step.config));
        if leading.corridor != Corridor::Clear && (used_up || guards) {
            // R18: no message takes a guard off a road on which there may be people.
            return Err(Ignored::RoadOccupied);
        }
        if used_up {
            // A new session, and with it a new number space, before half of this one is used.
            let number = SessionNumber(self.issue_number(step)?);
            self.end_session(step, EndReason::Renewed);
            self.open_session(step, number, request);
            return Ok(());
        }
        let commanded =
            leading.update_member(follower, |member| member.command(step, session, task));
        commanded.unwrap_or(Err(Ignored::NotAFollower))
    }

    /// An acknowledgement or rejection. One that is not for the outstanding command changes nothing
    /// (property I7).
    pub(crate) fn hear_answer(&mut self, step: &mut Step<'_, impl Sink>, answer: Answer) -> Effect {
        if answer.from == self.station {
            return Err(Ignored::OwnStation);
        }
        if answer.session.leader != self.station {
            return Err(Ignored::NotAddressed);
        }
        let Phase::Leading(leading) = &mut self.phase else {
            return Err(Ignored::OtherSession);
        };
        if leading.number != answer.session.number {
            return Err(Ignored::OtherSession);
        }
        let heard = leading.update_member(answer.from, |member| member.hear_answer(step, answer));
        heard.unwrap_or(Err(Ignored::NotAFollower))
    }

    /// `T_ack` ran out: the same command again, or the follower is lost.
    pub(crate) fn acknowledgement_expired(
        &mut self,
        step: &mut Step<'_, impl Sink>,
        station: StationId,
    ) {
        let Phase::Leading(leading) = &mut self.phase else {
            return;
        };
        let session = SessionId::of(self.station, leading.number);
        let n_ack = step.config.settings().n_ack;
        let repeated = leading.update_member(station, |member| {
            let outstanding = member.outstanding.as_mut()?;
            // R10: `n_ack` repeats, then the follower is given up.
            if outstanding.repeats < n_ack {
                outstanding.repeat(step, session, station);
                return None;
            }
            Some(GoneReason::NoAcknowledgement)
        });
        if let Some(Some(why)) = repeated {
            self.drop_follower(step, station, why);
        }
    }

    /// `T_exec` ran out: the command counts as failed.
    pub(crate) fn execution_expired(&mut self, step: &mut Step<'_, impl Sink>, station: StationId) {
        let Phase::Leading(leading) = &mut self.phase else {
            return;
        };
        let session = SessionId::of(self.station, leading.number);
        leading.update_member(station, |member| {
            let Some(order) = &mut member.order else {
                return;
            };
            let failure = Failure::ExecutionLimit;
            order.progress = Some(Progress::Failed(failure));
            order.execution = Countdown::OFF;
            let id = ManeuverId::of(session, order.request);
            step.out
                .notify(Notice::ManeuverFailed(station, id, failure));
        });
    }
}

impl Outstanding {
    fn message(self, session: SessionId, to: StationId) -> Output {
        let command = Command {
            session,
            to,
            request: self.request,
            task: self.task,
        };
        Output::SendRmcm(Rmcm::Command(command))
    }

    /// Sends the same command once more.
    fn repeat(&mut self, step: &mut Step<'_, impl Sink>, session: SessionId, to: StationId) {
        self.repeats += 1;
        self.acknowledgement = Countdown::armed(step.config.settings().t_ack);
        step.out.push(self.message(session, to));
    }
}

impl Member {
    /// Refuses a command to a follower without its role, or before the answer to the last one.
    fn may_be_commanded(&self) -> Effect {
        if !self.has_joined() {
            return Err(Ignored::NotJoined);
        }
        if self.outstanding.is_some() {
            return Err(Ignored::CommandOutstanding);
        }
        Ok(())
    }

    /// True if the follower guards people by what it is known to do or may have begun to do.
    fn guards(&self, config: &Config) -> bool {
        self.order.is_some_and(|order| {
            // The execution limit is the leader's own: the follower knows nothing of it and goes on.
            let is_over_time = order.progress == Some(Progress::Failed(Failure::ExecutionLimit));
            (order.is_running() || is_over_time) && config.settings().guarding.contains(order.task)
        })
    }

    /// True if the follower's request numbers of this session are used up.
    fn is_used_up(&self, step: &Step<'_, impl Sink>) -> bool {
        let first = step.config.settings().first_request;
        self.next_request.distance_from(first) >= RequestId::MAX_PER_SESSION
    }

    /// Sends the next command.
    fn command(
        &mut self,
        step: &mut Step<'_, impl Sink>,
        session: SessionId,
        task: TaskType,
    ) -> Effect {
        self.may_be_commanded()?;
        let outstanding = Outstanding {
            request: self.next_request,
            task,
            repeats: 0,
            acknowledgement: Countdown::armed(step.config.settings().t_ack),
        };
        self.next_request = self.next_request.next();
        self.outstanding = Some(outstanding);
        step.out.push(outstanding.message(session, self.station));
        Ok(())
    }

    /// An answer to a command of this session.
    fn hear_answer(&mut self, step: &mut Step<'_, impl Sink>, answer: Answer) -> Effect {
        let reason = match answer.verdict {
            Verdict::Accepted => return self.acknowledge(step, answer.session, answer.request),
            Verdict::Rejected(reason) => reason,
        };
        self.take_outstanding(answer.request)?;
        let id = ManeuverId::of(answer.session, answer.request);
        step.out
            .notify(Notice::CommandRejected(self.station, id, reason));
        Ok(())
    }

    fn take_outstanding(&mut self, request: RequestId) -> Result<Outstanding, Ignored> {
        let outstanding = self
            .outstanding
            .filter(|outstanding| outstanding.request == request);
        // R9: an answer to anything else changes nothing.
        let outstanding = outstanding.ok_or(Ignored::NotOutstanding)?;
        self.outstanding = None;
        Ok(outstanding)
    }

    /// The follower takes the outstanding command on.
    fn acknowledge(
        &mut self,
        step: &mut Step<'_, impl Sink>,
        session: SessionId,
        request: RequestId,
    ) -> Effect {
        let Outstanding { task, .. } = self.take_outstanding(request)?;
        let execution = Countdown::armed(step.config.t_exec(task));
        self.order = Some(Order {
            request,
            task,
            progress: None,
            execution,
        });
        let id = ManeuverId::of(session, request);
        step.out
            .notify(Notice::CommandAcknowledged(self.station, id));
        Ok(())
    }

    /// Progress as the follower's RAM tells it. It names its command, so a stale RAM cannot speak
    /// for a newer one; and it proves that the command was accepted, so it also stands for an
    /// acknowledgement that was lost. `echo` says how the heartbeat that it echoes stands to all before.
    pub(crate) fn hear_report(
        &mut self,
        step: &mut Step<'_, impl Sink>,
        session: SessionId,
        report: Report,
        echo: Ordering,
    ) -> Effect {
        let acknowledged = self.acknowledge(step, session, report.request);
        let Some(order) = self.order.as_mut().filter(|order| {
            // A delayed RAM undoes nothing, and a final progress stays final.
            let is_news = |known| report.progress.is_news(known, echo);
            // R11: session and command are named. R28: so is which RAM is newer, for a place.
            order.request == report.request && order.progress.is_none_or(is_news)
        }) else {
            return acknowledged.or(Err(Ignored::NothingNew));
        };
        order.progress = Some(report.progress);
        if !report.progress.is_running() {
            order.execution = Countdown::OFF;
        }
        let id = ManeuverId::of(session, report.request);
        step.out.notify(match report.progress {
            Progress::Executing => Notice::ManeuverReported(self.station, id),
            Progress::InPosition => Notice::ManeuverInPosition(self.station, id),
            Progress::Completed => Notice::ManeuverCompleted(self.station, id),
            Progress::Failed(failure) => Notice::ManeuverFailed(self.station, id, failure),
            Progress::SafeIdle => Notice::FollowerSafeIdle(self.station, id),
        });
        Ok(())
    }
}

// The follower's side.

impl Robot {
    /// A command. The follower acknowledges it before it starts, acknowledges a repeated one again
    /// without starting it again, and is not moved by an older one.
    pub(crate) fn hear_command(
        &mut self,
        step: &mut Step<'_, impl Sink>,
        command: Command,
    ) -> Effect {
        if command.session.leader == self.station {
            return Err(Ignored::OwnStation);
        }
        if command.to != self.station {
            return Err(Ignored::NotAddressed);
        }
        let station = self.station;
        let rejection = self.rejection(step, command);
        match &mut self.phase {
            // R1: a command of another session is none.
            Phase::Following(following) if following.session == command.session => {
                let taken = following.take_command(step, station, rejection, command);
                if following.executing().is_some() {
                    // The maneuver that runs now is the duty, if there was one.
                    self.duty = None;
                }
                taken
            }
            // The confirmation is still under way; the leader will repeat the command.
            Phase::Offering(offering) if offering.session == command.session => {
                Err(Ignored::NotJoined)
            }
            // The leader lists this robot in its RAM, and is told then which offer is over.
            _ => Err(Ignored::OtherSession),
        }
    }

    /// The body holds the place from which the maneuver guards, or is on its way there, perhaps once more; or it has
    /// finished the maneuver, or cannot.
    pub(crate) fn report_progress(
        &mut self,
        step: &mut Step<'_, impl Sink>,
        id: ManeuverId,
        progress: Progress,
    ) -> Effect {
        let Phase::Following(following) = &mut self.phase else {
            return Err(Ignored::NotExecuting);
        };
        let runs = following.executing().is_some_and(|it| it.id == id);
        let Some(job) = following.job.as_mut().filter(|_| runs) else {
            return Err(Ignored::NotExecuting);
        };
        if job.progress == progress {
            return Err(Ignored::NothingNew);
        }
        // R28: the RAM that says so is sent at once.
        job.progress = progress;
        step.out.push(Output::SendRam);
        Ok(())
    }

    /// Why the robot must reject a command.
    fn rejection(&self, step: &Step<'_, impl Sink>, command: Command) -> Option<Rejection> {
        if let Availability::Unavailable(reason) = self.availability {
            return Some(Rejection::Unavailable(reason));
        }
        // R27: nothing but what it fell back from.
        if self.duty.is_some_and(|duty| !duty.is_resumed_by(command)) {
            return Some(Rejection::OnDuty);
        }
        if !step.config.settings().capabilities.contains(command.task) {
            return Some(Rejection::UnsupportedTask);
        }
        None
    }
}

impl Duty {
    /// True if the leader for which the robot falls back commands the same task in the same session again.
    fn is_resumed_by(self, command: Command) -> bool {
        matches!(self, Self::FallingBack(maneuver)
            if (maneuver.id.session, maneuver.task) == (command.session, command.task))
    }
}

impl Following {
    fn take_command(
        &mut self,
        step: &mut Step<'_, impl Sink>,
        station: StationId,
        rejection: Option<Rejection>,
        command: Command,
    ) -> Effect {
        let answer = |verdict| {
            let request = command.request;
            let answer = Answer {
                from: station,
                session: command.session,
                request,
                verdict,
            };
            Output::SendRmcm(Rmcm::Answer(answer))
        };
        if let Some(refused) = self
            .refused
            .filter(|refused| refused.request == command.request)
        {
            step.out.push(answer(Verdict::Rejected(refused.reason)));
            return Ok(());
        }
        // R8, R15: acknowledged again, and never started again, whatever became of it.
        if self.job.is_some_and(|job| job.request == command.request) {
            step.out.push(answer(Verdict::Accepted));
            return Ok(());
        }
        // R8: newer than both. After a leap of more than half the number space, which no leader makes, a
        // number can be newer than what was refused and older than what was accepted.
        let is_new = |answered: RequestId| command.request.is_newer_than(answered);
        let is_newest = self.refused.is_none_or(|refused| is_new(refused.request))
            && self.job.is_none_or(|job| is_new(job.request));
        if !is_newest {
            return Err(Ignored::OldCommand);
        }
        self.renew_contact(step);
        if let Some(reason) = rejection {
            self.refused = Some(Refusal {
                request: command.request,
                reason,
            });
            step.out.push(answer(Verdict::Rejected(reason)));
            return Ok(());
        }
        let superseded = self.executing();
        let (request, task) = (command.request, command.task);
        self.job = Some(Job {
            request,
            task,
            progress: Progress::Executing,
        });
        self.refused = None;
        // R7: the acknowledgement stands before the start.
        step.out.push(answer(Verdict::Accepted));
        if let Some(maneuver) = superseded {
            step.out
                .push(Output::StopManeuver(maneuver, StopReason::Superseded));
        }
        let id = ManeuverId::of(self.session, request);
        step.out.push(Output::StartManeuver(Maneuver { id, task }));
        step.out.push(Output::SendRam);
        Ok(())
    }

    /// Ends the running maneuver with a final progress; the maneuver, if one ran.
    pub(crate) fn finish(&mut self, progress: Progress) -> Option<Maneuver> {
        let maneuver = self.executing()?;
        if let Some(job) = &mut self.job {
            job.progress = progress;
        }
        Some(maneuver)
    }
}
