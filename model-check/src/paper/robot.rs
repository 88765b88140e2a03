//! A robot as the paper words it: four states, a `helpStatus` and a leader-follower container in its RAM, a
//! `requestID` and a `jobAdviceID` in its RMCM.
//!
//! ```text
//!          detects                needHelp is answered               RMCM command / ack
//!    Idle ─────────► HelpRequested ──────────────► RoleEstablished ◄──────────► ManeuverExecuting
//!     ▲ │  hears needHelp: offerHelp, joins         ▲   │        completed or safeIdle in RAM │
//!     │ └───────────────────────────────────────────┘   │                                    │
//!     └──────────────────── RAM none ───────────────────┴────────────────────────────────────┘
//! ```
//!
//! This is a model of a text. It shares no rule with the protocol that robots run.

use std::fmt;

use crossguard_protocol::State;

use super::readings::Reading;

/// A robot's place in the cast.
pub(super) type RobotIndex = usize;

/// Status of a robot, as its RAM tells it: `helpStatus` and the leader-follower container.
///
/// The text gives `helpStatus` three values, and says when they are set: `needHelp` by a request, `offerHelp`
/// by an answer, `None` by the release. In between, it stays what it was.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum HelpStatus {
    /// `None`: the idle default, and the release.
    None,
    /// `needHelp`, no container.
    NeedHelp,
    /// `offerHelp`, and a container that joins; of which robot, only a reading asks.
    OfferHelp { to: RobotIndex },
    /// `RoleConfirmed`: still `needHelp`, and a container that names the follower.
    Leader { follower: RobotIndex },
    /// Still `offerHelp`, and a container that names the leader.
    Follower {
        leader: RobotIndex,
        is_leaving: bool,
    },
}

/// Progression of the task, as a RAM tells it. Nothing says of which command.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum Progression {
    Idle,
    Executing,
    Completed,
    /// In its safe idle position, or on its way there.
    SafeIdle,
}

/// Position and motion state, as a RAM tells them.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum Whereabouts {
    /// Stands where it was.
    Start,
    UnderWay,
    /// Stands in the lead position, or in the place from which it blocks.
    Lead,
    /// Stands on the other side of the road.
    FarSide,
    /// Stands in its safe idle position.
    Safe,
}

/// `taskType`.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum PaperTask {
    InitialPos,
    /// The pedestrian's escort.
    Move,
    Block,
}

#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) struct PaperRam {
    pub(super) status: HelpStatus,
    pub(super) progression: Progression,
    pub(super) at: Whereabouts,
}

/// A command. Robots know it by its `requestID` and its task, the properties by its serial number in the run.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) struct PaperCommand {
    pub(super) request: u8,
    pub(super) task: PaperTask,
    /// How often commands were sent before, by anybody. No robot looks at it.
    pub(super) serial: u8,
    /// The serial number with which it was sent first; another one only if it is reissued.
    pub(super) original: u8,
}

#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum PaperRmcm {
    /// `LeaderManeuverContainer` with the `requestID`.
    Command(PaperCommand),
    /// `FollowerManeuverContainer` with the `jobAdviceID`, which is that `requestID`.
    Acknowledgement(PaperCommand),
}

/// Input of a robot.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum PaperInput {
    Ram(RobotIndex, PaperRam),
    Rmcm(RobotIndex, PaperRmcm),
    Detected,
    /// The leader's application sends its next command, with this serial number.
    Commanded(PaperTask, u8),
    /// The leader's application sends the pending command again, with this serial number.
    Reissued(u8),
    /// The follower's body has finished the maneuver.
    Finished,
    /// The leader's application says that the pedestrian is across.
    TaskCompleted,
    /// The safety timeout of a follower runs out, or its execution timeout.
    SafetyTimeout,
    /// The leader's execution timeout runs out, in the reading in which it has one.
    LeaderTimeout,
    LeaveAsked,
    LeaveGranted,
}

#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) struct PaperRobot {
    pub(super) state: State,
    pub(super) status: HelpStatus,
    pub(super) progression: Progression,
    pub(super) at: Whereabouts,
    /// Leader: the command that is not completed yet. Follower: the newest command.
    pub(super) command: Option<PaperCommand>,
    /// Leader: commands given in this association.
    pub(super) commanded: u8,
    /// Leader: the follower has said that it is in its safe idle position, with a command pending.
    pub(super) is_told_idle: bool,
    pub(super) is_asked_for_leave: bool,
    /// Follower: its leader's RAM was heard since the role or the newest RMCM. No rule of the paper
    /// looks at it; property P4 does.
    pub(super) heard_leader: bool,
}

impl PaperTask {
    /// Where a robot that has completed it stands.
    pub(super) const fn target(self) -> Whereabouts {
        match self {
            Self::InitialPos | Self::Block => Whereabouts::Lead,
            Self::Move => Whereabouts::FarSide,
        }
    }
}

impl HelpStatus {
    /// Whether `helpStatus` is `needHelp`.
    const fn asks(self) -> bool {
        matches!(self, Self::NeedHelp | Self::Leader { .. })
    }

    /// The robot that it helps or would help, if `helpStatus` is `offerHelp`.
    const fn offers_to(self) -> Option<RobotIndex> {
        match self {
            Self::OfferHelp { to } => Some(to),
            Self::Follower { leader, .. } => Some(leader),
            _ => None,
        }
    }
}

impl PaperRobot {
    pub(super) const IDLE: Self = Self {
        state: State::Idle,
        status: HelpStatus::None,
        progression: Progression::Idle,
        at: Whereabouts::Start,
        command: None,
        commanded: 0,
        is_told_idle: false,
        is_asked_for_leave: false,
        heard_leader: false,
    };

    pub(super) const fn ram(&self) -> PaperRam {
        PaperRam {
            status: self.status,
            progression: self.progression,
            at: self.at,
        }
    }

    /// One step; the RMCM that it sends, to the robot that `input` is from or about.
    pub(super) fn step(
        &mut self,
        reading: Reading,
        me: RobotIndex,
        input: PaperInput,
    ) -> Option<PaperRmcm> {
        match input {
            PaperInput::Ram(from, ram) => self.hear_ram(reading, me, from, ram),
            PaperInput::Rmcm(from, PaperRmcm::Command(command)) => {
                return self.hear_command(from, command);
            }
            PaperInput::Rmcm(from, PaperRmcm::Acknowledgement(command)) => {
                self.hear_ack(from, command);
            }
            PaperInput::Detected => self.establish(State::HelpRequested, HelpStatus::NeedHelp),
            PaperInput::Commanded(task, serial) => {
                return Some(self.give_command(reading, task, serial));
            }
            PaperInput::Reissued(serial) => return self.reissue(reading, serial),
            PaperInput::Finished => {
                self.state = State::RoleEstablished;
                self.progression = Progression::Completed;
                let target = self.command.map(|command| command.task.target());
                self.at = target.unwrap_or(self.at);
            }
            // The release is a RAM with `helpStatus = None` (paper, stage 5).
            PaperInput::TaskCompleted | PaperInput::LeaveGranted => *self = Self::IDLE,
            PaperInput::SafetyTimeout => {
                self.state = State::RoleEstablished;
                self.progression = Progression::SafeIdle;
                self.at = Whereabouts::Safe;
            }
            PaperInput::LeaderTimeout => self.command_may_be_reissued(),
            PaperInput::LeaveAsked if reading == Reading::LeaveByFollower => *self = Self::IDLE,
            PaperInput::LeaveAsked => {
                if let HelpStatus::Follower { is_leaving, .. } = &mut self.status {
                    *is_leaving = true;
                }
            }
        }
        None
    }

    fn establish(&mut self, state: State, status: HelpStatus) {
        self.state = state;
        self.status = status;
    }

    fn hear_ram(&mut self, reading: Reading, me: RobotIndex, from: RobotIndex, ram: PaperRam) {
        use HelpStatus::{Follower, Leader, NeedHelp, None, OfferHelp};
        let is_answered = |to| reading != Reading::JoinNamesLeader || to == me;
        match (self.status, ram.status) {
            // The text names a transition of the requester, and none of the helper.
            (None, status) if status.asks() => self.status = OfferHelp { to: from },
            (NeedHelp, status) if status.offers_to().is_some_and(is_answered) => {
                self.establish(State::RoleEstablished, Leader { follower: from });
            }
            (OfferHelp { .. }, Leader { follower }) if follower == me => {
                let status = Follower {
                    leader: from,
                    is_leaving: false,
                };
                self.establish(State::RoleEstablished, status);
                self.heard_leader = true;
            }
            (Follower { leader, .. }, None) if leader == from => *self = Self::IDLE,
            (Follower { leader, .. }, Leader { .. }) if leader == from => self.heard_leader = true,
            (Leader { follower }, Follower { is_leaving, .. }) if follower == from => {
                self.is_asked_for_leave |= is_leaving;
                self.view(ram);
            }
            _ => {}
        }
    }

    /// A leader reads its follower's RAM: position, motion state and progression.
    fn view(&mut self, ram: PaperRam) {
        let Some(command) = self.command else {
            return;
        };
        let is_completed =
            ram.progression == Progression::Completed && ram.at == command.task.target();
        if is_completed && self.state == State::ManeuverExecuting {
            self.state = State::RoleEstablished;
            self.command = None;
        }
        if ram.progression == Progression::SafeIdle {
            self.command_may_be_reissued();
        }
    }

    /// Commands are issued in `RoleEstablished` (paper, stage 4), and so are they reissued.
    fn command_may_be_reissued(&mut self) {
        self.state = State::RoleEstablished;
        self.is_told_idle = true;
    }

    fn hear_command(&mut self, from: RobotIndex, command: PaperCommand) -> Option<PaperRmcm> {
        if self.leader() != Some(from) {
            return None;
        }
        self.state = State::ManeuverExecuting;
        self.progression = Progression::Executing;
        let stays = command.task == PaperTask::Block && self.at == Whereabouts::Lead;
        if !stays {
            self.at = Whereabouts::UnderWay;
        }
        self.command = Some(command);
        self.heard_leader = false;
        Some(PaperRmcm::Acknowledgement(command))
    }

    fn hear_ack(&mut self, from: RobotIndex, answered: PaperCommand) {
        let is_outstanding = self.state == State::RoleEstablished
            && self.follower() == Some(from)
            && self.command.map(|command| command.request) == Some(answered.request);
        if is_outstanding {
            self.state = State::ManeuverExecuting;
            self.is_told_idle = false;
        }
    }

    fn give_command(&mut self, reading: Reading, task: PaperTask, serial: u8) -> PaperRmcm {
        let request = match reading {
            Reading::NewRequestIds => serial,
            _ => self.commanded,
        };
        self.commanded += 1;
        self.order(PaperCommand {
            request,
            task,
            serial,
            original: serial,
        })
    }

    fn reissue(&mut self, reading: Reading, serial: u8) -> Option<PaperRmcm> {
        let mut command = self.command?;
        command.serial = serial;
        if reading == Reading::NewRequestIds {
            command.request = serial;
        }
        Some(self.order(command))
    }

    fn order(&mut self, command: PaperCommand) -> PaperRmcm {
        self.command = Some(command);
        self.is_told_idle = false;
        PaperRmcm::Command(command)
    }

    /// Whether its application may give a command or end the task: it leads and waits for nothing.
    pub(super) fn waits_for_nothing(&self) -> bool {
        self.follower().is_some() && self.command.is_none()
    }

    /// Whether its application may send the pending command again.
    pub(super) fn may_reissue(&self) -> bool {
        self.follower().is_some() && self.command.is_some() && self.is_told_idle
    }

    /// Whether its application may ask for leave: it is in its safe idle position.
    pub(super) fn may_ask_for_leave(&self) -> bool {
        let follows = matches!(
            self.status,
            HelpStatus::Follower {
                is_leaving: false,
                ..
            }
        );
        follows && self.progression == Progression::SafeIdle
    }

    /// Whether its safety timeout may run out.
    pub(super) fn may_time_out(&self) -> bool {
        self.leader().is_some() && self.progression != Progression::SafeIdle
    }

    pub(super) const fn leader(&self) -> Option<RobotIndex> {
        match self.status {
            HelpStatus::Follower { leader, .. } => Some(leader),
            _ => None,
        }
    }

    pub(super) const fn follower(&self) -> Option<RobotIndex> {
        match self.status {
            HelpStatus::Leader { follower } => Some(follower),
            _ => None,
        }
    }

    /// The maneuver that it executes as a follower.
    pub(super) fn executing(&self) -> Option<PaperCommand> {
        let executes = self.leader().is_some() && self.state == State::ManeuverExecuting;
        self.command.filter(|_| executes)
    }
}

impl fmt::Display for PaperRam {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self.status {
            HelpStatus::None => "RAM none",
            HelpStatus::NeedHelp => "RAM needHelp",
            HelpStatus::OfferHelp { .. } => "RAM offerHelp, joins",
            HelpStatus::Leader { .. } => "RAM leader",
            HelpStatus::Follower {
                is_leaving: true, ..
            } => "RAM follower, safeIdle, asks for leave",
            HelpStatus::Follower { .. } => match (self.progression, self.at) {
                (Progression::Idle, _) => "RAM follower",
                (Progression::Executing, Whereabouts::UnderWay) => "RAM follower, moves, executing",
                (Progression::Executing, _) => "RAM follower, stands, executing",
                (Progression::Completed, _) => "RAM follower, stands, completed",
                (Progression::SafeIdle, _) => "RAM follower, safeIdle",
            },
        })
    }
}

impl fmt::Display for PaperTask {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::InitialPos => "initialPos",
            Self::Move => "Move",
            Self::Block => "block",
        })
    }
}

impl fmt::Display for PaperRmcm {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Command(command) => {
                write!(f, "RMCM command {} ({})", command.request, command.task)
            }
            Self::Acknowledgement(command) => write!(f, "RMCM ack {}", command.request),
        }
    }
}
