//! The outputs of a step, each checked as it comes.
//!
//! The laws do not ask for the list of outputs but for these notes. To a proof a list of 24
//! outputs of any kind is most of a step.

use crate::id::{RequestId, SessionId, StationId};
use crate::input::{Event, Input};
use crate::message::{Rmcm, Verdict};
use crate::output::{
    EndReason, GoneReason, Ignored, Maneuver, Notice, NoticeKind, Output, OutputKind, Sink,
    StopReason,
};
use crate::state::{Corridor, Identity, Phase, Robot};
use crate::task::FallbackPolicy;
use crate::time::Millis;

use super::part::executing;

/// Notes of all that has been said so far, and of its order.
#[derive(Clone, Debug)]
#[expect(clippy::struct_excessive_bools, reason = "each is a law of its own")]
pub struct Watch {
    /// How many outputs there are, [`Output::SendRam`] once.
    len: usize,
    /// The kinds among them, and those of notices.
    outputs: u32,
    notices: u32,
    /// The maneuver that runs, by what the body has been told.
    pub(super) running: Option<Maneuver>,
    /// Nothing was started over something that runs, and nothing stopped that does not run.
    pub(super) tells_the_body: bool,
    /// The command that was accepted last.
    acknowledged: Option<(SessionId, RequestId)>,
    /// True if a command was sent.
    pub commanded: bool,
    /// The command that was answered last, and how.
    pub answered: Option<(RequestId, Verdict)>,
    /// Why the input is ignored.
    pub(super) ignored: Option<Ignored>,
    /// The maneuver that was started.
    pub(super) started: Option<Maneuver>,
    /// At most one was, behind its acknowledgement.
    pub(super) starts_in_order: bool,
    /// True if the identity is locked.
    pub(super) locked: bool,
    /// True if the corridor is open.
    pub(super) open: bool,
    /// True if neither was said twice.
    pub(super) changes_lock_and_corridor: bool,
    /// For how long the corridor may be shown open, as it was told last.
    pub(super) shown: Option<Millis>,
    /// The maneuver that was stopped last, and why.
    pub(super) stopped: Option<(Maneuver, StopReason)>,
    /// The maneuver that was ended last by a policy.
    pub(super) fallen_back: Option<(Maneuver, FallbackPolicy)>,
    /// Why the robot's own session ended.
    pub ended: Option<EndReason>,
    /// The first follower that was dropped, and why.
    pub(super) dropped: Option<(StationId, GoneReason)>,
}

impl Watch {
    /// Over a step that takes `input` in, from this state.
    #[must_use]
    pub fn new(before: &Robot, input: &Input) -> Self {
        let running = executing(before);
        // The application itself has ended the maneuver.
        let running = match *input {
            Input::Local(Event::ManeuverCompleted(id) | Event::ManeuverFailed(id)) => {
                running.filter(|maneuver| maneuver.id != id)
            }
            _ => running,
        };
        Self {
            len: 0,
            outputs: 0,
            notices: 0,
            running,
            tells_the_body: true,
            acknowledged: None,
            commanded: false,
            answered: None,
            ignored: None,
            started: None,
            starts_in_order: true,
            locked: before.identity() != Identity::Unlocked,
            open: is_open(before),
            changes_lock_and_corridor: true,
            shown: None,
            stopped: None,
            fallen_back: None,
            ended: None,
            dropped: None,
        }
    }

    /// How many outputs there are.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.len
    }

    /// True if there is none.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// True if one of this kind is among them.
    #[must_use]
    pub const fn has(&self, kind: OutputKind) -> bool {
        self.outputs & bit(kind as u8) != 0
    }

    /// True if the application is told of this.
    #[must_use]
    pub const fn tells(&self, kind: NoticeKind) -> bool {
        self.notices & bit(kind as u8) != 0
    }
}

const fn bit(kind: u8) -> u32 {
    1 << kind
}

/// True if the robot leads and has its corridor open.
pub(super) const fn is_open(robot: &Robot) -> bool {
    match robot.phase() {
        Phase::Leading(leading) => matches!(leading.corridor, Corridor::Open),
        _ => false,
    }
}

impl Sink for Watch {
    fn push(&mut self, output: Output) {
        let kind = output.kind();
        if kind == OutputKind::SendRam && self.has(kind) {
            return;
        }
        self.len += 1;
        self.outputs |= bit(kind as u8);
        if let Output::Notify(notice) = output {
            self.notices |= bit(notice.kind() as u8);
        }
        match output {
            Output::SendRmcm(Rmcm::Command(_)) => self.commanded = true,
            Output::SendRmcm(Rmcm::Answer(answer)) => {
                if answer.verdict == Verdict::Accepted {
                    self.acknowledged = Some((answer.session, answer.request));
                }
                self.answered = Some((answer.request, answer.verdict));
            }
            Output::Ignored(why) => self.ignored = Some(why),
            Output::StartManeuver(maneuver) => {
                let id = (maneuver.id.session, maneuver.id.request);
                self.starts_in_order &= self.started.is_none() && self.acknowledged == Some(id);
                self.tells_the_body &= self.running.is_none();
                self.started = Some(maneuver);
                self.running = Some(maneuver);
            }
            Output::StopManeuver(maneuver, why) => {
                self.tells_the_body &= self.running == Some(maneuver);
                self.running = None;
                self.stopped = Some((maneuver, why));
            }
            Output::FallBack(maneuver, policy) => {
                self.tells_the_body &= self.running == Some(maneuver);
                self.running = None;
                self.fallen_back = Some((maneuver, policy));
            }
            Output::LockIdentity | Output::UnlockIdentity => {
                let locks = kind == OutputKind::LockIdentity;
                self.changes_lock_and_corridor &= self.locked != locks;
                self.locked = locks;
            }
            Output::CorridorOpened(left) => {
                self.changes_lock_and_corridor &= !self.open;
                self.open = true;
                self.shown = Some(left);
            }
            Output::CorridorExtended(left) => {
                self.changes_lock_and_corridor &= self.open;
                self.shown = Some(left);
            }
            Output::CorridorClosed(_) => {
                self.changes_lock_and_corridor &= self.open;
                self.open = false;
                self.shown = None;
            }
            Output::Notify(Notice::FollowerGone(station, why)) => {
                self.dropped = self.dropped.or(Some((station, why)));
            }
            Output::Notify(Notice::SessionEnded(_, why)) => self.ended = Some(why),
            _ => {}
        }
    }
}
