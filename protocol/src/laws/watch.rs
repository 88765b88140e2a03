//! What a step says, checked output by output as it comes.
//!
//! The laws do not ask for the list of outputs but for what this notes. To a proof a list of 24
//! outputs of any kind is most of a step.

use crate::id::{RequestId, SessionId, StationId};
use crate::input::{Event, Input};
use crate::message::{Rmcm, Verdict};
use crate::output::{EndReason, Maneuver, Notice, Output, Sink};
use crate::state::{Identity, Phase, Robot};

/// The sorts of outputs that somebody asks for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[repr(u8)]
pub enum Sort {
    /// [`Output::SendRam`].
    SendRam,
    /// [`Output::SendRmcm`] with a command.
    Command,
    /// [`Output::SendRmcm`] with an answer.
    Answer,
    /// [`Output::StartManeuver`].
    StartManeuver,
    /// [`Output::StopManeuver`].
    StopManeuver,
    /// [`Output::FallBack`].
    FallBack,
    /// [`Output::CorridorOpened`].
    CorridorOpened,
    /// [`Output::CorridorClosed`].
    CorridorClosed,
    /// [`Output::LockIdentity`].
    LockIdentity,
    /// [`Output::UnlockIdentity`].
    UnlockIdentity,
    /// [`Output::Ignored`].
    Ignored,
    /// [`Notice::FollowerJoined`].
    FollowerJoined,
    /// [`Notice::FollowerGone`].
    FollowerGone,
    /// [`Notice::LeaseGranted`].
    LeaseGranted,
    /// [`Notice::LeaseExpired`].
    LeaseExpired,
    /// [`Notice::CommandAcknowledged`].
    CommandAcknowledged,
    /// [`Notice::CommandRejected`].
    CommandRejected,
    /// [`Notice::ManeuverCompleted`].
    ManeuverCompleted,
    /// [`Notice::ManeuverFailed`].
    ManeuverFailed,
    /// [`Notice::SessionEnded`] for [`EndReason::Renewed`].
    Renewed,
    /// Any other notice.
    OtherNotice,
}

impl Sort {
    fn of(output: &Output) -> Self {
        match output {
            Output::SendRam => Self::SendRam,
            Output::SendRmcm(Rmcm::Command(_)) => Self::Command,
            Output::SendRmcm(Rmcm::Answer(_)) => Self::Answer,
            Output::StartManeuver(_) => Self::StartManeuver,
            Output::StopManeuver(..) => Self::StopManeuver,
            Output::FallBack(..) => Self::FallBack,
            Output::CorridorOpened => Self::CorridorOpened,
            Output::CorridorClosed(_) => Self::CorridorClosed,
            Output::LockIdentity => Self::LockIdentity,
            Output::UnlockIdentity => Self::UnlockIdentity,
            Output::Ignored(_) => Self::Ignored,
            Output::Notify(notice) => match notice {
                Notice::FollowerJoined(_) => Self::FollowerJoined,
                Notice::FollowerGone(..) => Self::FollowerGone,
                Notice::LeaseGranted(_) => Self::LeaseGranted,
                Notice::LeaseExpired(_) => Self::LeaseExpired,
                Notice::CommandAcknowledged(..) => Self::CommandAcknowledged,
                Notice::CommandRejected(..) => Self::CommandRejected,
                Notice::ManeuverCompleted(..) => Self::ManeuverCompleted,
                Notice::ManeuverFailed(..) => Self::ManeuverFailed,
                Notice::SessionEnded(_, EndReason::Renewed) => Self::Renewed,
                _ => Self::OtherNotice,
            },
        }
    }

    const fn bit(self) -> u32 {
        1 << self as u8
    }
}

/// What has been said so far, and whether it was in order.
#[derive(Clone, Debug)]
#[expect(clippy::struct_excessive_bools, reason = "each is a law of its own")]
pub struct Watch {
    /// How many outputs there are, [`Output::SendRam`] once.
    len: usize,
    /// The sorts among them.
    sorts: u32,
    /// The maneuver that runs, by what the body has been told.
    pub(super) running: Option<Maneuver>,
    /// Nothing was started over something that runs, and nothing stopped that does not run.
    pub(super) tells_the_body: bool,
    /// The command that was accepted last.
    acknowledged: Option<(SessionId, RequestId)>,
    /// The maneuver that was started.
    pub(super) started: Option<Maneuver>,
    /// At most one was, behind its acknowledgement.
    pub(super) starts_in_order: bool,
    /// Whether the identity is locked, and whether the corridor is open.
    pub(super) locked: bool,
    pub(super) open: bool,
    /// Neither was said twice.
    pub(super) changes_lock_and_corridor: bool,
    /// The first follower that was dropped.
    pub(super) dropped: Option<StationId>,
}

impl Watch {
    /// Over a step that takes `input` in, from this state.
    #[must_use]
    pub fn new(before: &Robot, input: &Input) -> Self {
        let running = match before.phase() {
            Phase::Following(following) => following.executing(),
            _ => None,
        };
        // The application itself has ended the maneuver.
        let running = match *input {
            Input::Local(Event::ManeuverCompleted(id) | Event::ManeuverFailed(id)) => {
                running.filter(|maneuver| maneuver.id != id)
            }
            _ => running,
        };
        Self {
            len: 0,
            sorts: 0,
            running,
            tells_the_body: true,
            acknowledged: None,
            started: None,
            starts_in_order: true,
            locked: before.identity() != Identity::Unlocked,
            open: is_open(before),
            changes_lock_and_corridor: true,
            dropped: None,
        }
    }

    /// How many outputs there are.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.len
    }

    /// Whether there is none.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Whether one of this sort is among them.
    #[must_use]
    pub const fn has(&self, sort: Sort) -> bool {
        self.sorts & sort.bit() != 0
    }
}

/// Whether the robot leads and has its corridor open.
pub(super) const fn is_open(robot: &Robot) -> bool {
    match robot.phase() {
        Phase::Leading(leading) => leading.corridor_open,
        _ => false,
    }
}

impl Sink for Watch {
    fn push(&mut self, output: Output) {
        let sort = Sort::of(&output);
        if sort == Sort::SendRam && self.has(sort) {
            return;
        }
        self.len += 1;
        self.sorts |= sort.bit();
        match output {
            Output::SendRmcm(Rmcm::Answer(answer)) if answer.verdict == Verdict::Accepted => {
                self.acknowledged = Some((answer.session, answer.request));
            }
            Output::StartManeuver(maneuver) => {
                let id = (maneuver.id.session, maneuver.id.request);
                self.starts_in_order &= self.started.is_none() && self.acknowledged == Some(id);
                self.tells_the_body &= self.running.is_none();
                self.started = Some(maneuver);
                self.running = Some(maneuver);
            }
            Output::StopManeuver(maneuver, _) | Output::FallBack(maneuver, _) => {
                self.tells_the_body &= self.running == Some(maneuver);
                self.running = None;
            }
            Output::LockIdentity | Output::UnlockIdentity => {
                let locks = sort == Sort::LockIdentity;
                self.changes_lock_and_corridor &= self.locked != locks;
                self.locked = locks;
            }
            Output::CorridorOpened | Output::CorridorClosed(_) => {
                let opens = sort == Sort::CorridorOpened;
                self.changes_lock_and_corridor &= self.open != opens;
                self.open = opens;
            }
            Output::Notify(Notice::FollowerGone(station, _)) => {
                self.dropped = self.dropped.or(Some(station));
            }
            _ => {}
        }
    }
}
