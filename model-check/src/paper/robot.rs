//! A robot as the paper words it: four states, a `helpStatus` in its RAM, a `requestID` and a
//! `jobAdviceID` in its RMCM.
//!
//! ```text
//!          detects / hears needHelp        offerHelp / leader        RMCM command / ack
//!    Idle ─────────────────► HelpRequested ─────────► RoleEstablished ◄───────► ManeuverExecuting
//!     ▲                                                    │        completion in RAM    │
//!     └────────────── RAM none, safety timeout ────────────┴─────────────────────────────┘
//! ```
//!
//! This is a model of a text. It shares no rule with the protocol that robots run.

use std::fmt;

use crossguard_protocol::State;

/// A robot's place in the cast.
pub(super) type RobotIndex = usize;

/// `helpStatus` of a RAM (paper, stages 1 to 3).
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum HelpStatus {
    /// The idle default, and the release of followers.
    None,
    NeedHelp,
    /// Names nobody.
    OfferHelp,
    /// `RoleConfirmed`: names the follower.
    Leader {
        follower: RobotIndex,
    },
    /// Names the leader.
    Follower {
        leader: RobotIndex,
    },
}

/// Progression of the task, as a RAM tells it. Nothing says of which command.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum Progression {
    Idle,
    Executing,
    Completed,
}

/// A Robot Awareness Message.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) struct PaperRam {
    pub(super) status: HelpStatus,
    pub(super) progression: Progression,
}

/// A command. Robots know it by its `requestID`, the properties by its serial number in the run.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) struct PaperCommand {
    /// `requestID`; a leader counts from 0.
    pub(super) request: u8,
    /// How many commands were given before, by anybody. No robot looks at it.
    pub(super) serial: u8,
}

/// A Robot Maneuver Coordination Message.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum PaperRmcm {
    /// `LeaderManeuverContainer` with the `requestID`.
    Command(PaperCommand),
    /// `FollowerManeuverContainer` with the `jobAdviceID`, which is that `requestID`.
    Acknowledgement(PaperCommand),
}

/// What a robot takes in.
#[derive(Clone, Copy, Debug)]
pub(super) enum PaperInput {
    Ram(RobotIndex, PaperRam),
    Rmcm(RobotIndex, PaperRmcm),
    /// A pedestrian is detected.
    Detected,
    /// The leader's application gives the command with this serial number.
    Commanded(u8),
    /// The follower's body has finished the maneuver.
    Finished,
    /// The leader's application says that the pedestrian is across.
    TaskCompleted,
    /// The safety timeout runs out.
    SafetyTimeout,
}

/// A robot.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) struct PaperRobot {
    pub(super) state: State,
    pub(super) status: HelpStatus,
    pub(super) progression: Progression,
    /// Leader: the command that is not completed yet. Follower: the newest command.
    pub(super) command: Option<PaperCommand>,
    /// Leader: `requestID` of the next command.
    next_request: u8,
    /// Follower: its leader's RAM was heard since the role or the newest RMCM. No rule of the paper
    /// looks at it; property P4 does.
    pub(super) heard_leader: bool,
}

impl PaperRobot {
    pub(super) const IDLE: Self = Self {
        state: State::Idle,
        status: HelpStatus::None,
        progression: Progression::Idle,
        command: None,
        next_request: 0,
        heard_leader: false,
    };

    /// The RAM that it sends periodically.
    pub(super) const fn ram(&self) -> PaperRam {
        PaperRam {
            status: self.status,
            progression: self.progression,
        }
    }

    /// One step; the RMCM that it sends, to the robot that `input` is from or about.
    pub(super) fn step(&mut self, me: RobotIndex, input: PaperInput) -> Option<PaperRmcm> {
        match input {
            PaperInput::Ram(from, ram) => self.hear_ram(me, from, ram),
            PaperInput::Rmcm(from, PaperRmcm::Command(command)) => {
                return self.hear_command(from, command);
            }
            PaperInput::Rmcm(from, PaperRmcm::Acknowledgement(command)) => {
                self.hear_ack(from, command);
            }
            PaperInput::Detected => self.establish(State::HelpRequested, HelpStatus::NeedHelp),
            PaperInput::Commanded(serial) => return Some(self.give_command(serial)),
            PaperInput::Finished => {
                self.state = State::RoleEstablished;
                self.progression = Progression::Completed;
            }
            // Release is a RAM with `helpStatus = none`: the idle default (paper, stage 5).
            PaperInput::TaskCompleted | PaperInput::SafetyTimeout => *self = Self::IDLE,
        }
        None
    }

    fn establish(&mut self, state: State, status: HelpStatus) {
        self.state = state;
        self.status = status;
    }

    fn hear_ram(&mut self, me: RobotIndex, from: RobotIndex, ram: PaperRam) {
        use HelpStatus::{Follower, Leader, NeedHelp, None, OfferHelp};
        match (self.status, ram.status) {
            (None, NeedHelp) => self.establish(State::HelpRequested, OfferHelp),
            (NeedHelp, OfferHelp) => {
                self.establish(State::RoleEstablished, Leader { follower: from });
            }
            (OfferHelp, Leader { follower }) if follower == me => {
                self.establish(State::RoleEstablished, Follower { leader: from });
                self.heard_leader = true;
            }
            (Follower { leader }, None) if leader == from => *self = Self::IDLE,
            (Follower { leader }, Leader { .. }) if leader == from => self.heard_leader = true,
            (Leader { follower }, Follower { .. })
                if follower == from
                    && self.state == State::ManeuverExecuting
                    && ram.progression == Progression::Completed =>
            {
                self.state = State::RoleEstablished;
                self.command = Option::None;
            }
            _ => {}
        }
    }

    fn hear_command(&mut self, from: RobotIndex, command: PaperCommand) -> Option<PaperRmcm> {
        if self.status != (HelpStatus::Follower { leader: from }) {
            return None;
        }
        self.state = State::ManeuverExecuting;
        self.progression = Progression::Executing;
        self.command = Some(command);
        self.heard_leader = false;
        Some(PaperRmcm::Acknowledgement(command))
    }

    fn hear_ack(&mut self, from: RobotIndex, answered: PaperCommand) {
        let is_outstanding = self.state == State::RoleEstablished
            && self.status == (HelpStatus::Leader { follower: from })
            && self.command.map(|command| command.request) == Some(answered.request);
        if is_outstanding {
            self.state = State::ManeuverExecuting;
        }
    }

    fn give_command(&mut self, serial: u8) -> PaperRmcm {
        let request = self.next_request;
        let command = PaperCommand { request, serial };
        self.next_request += 1;
        self.command = Some(command);
        PaperRmcm::Command(command)
    }

    /// Whether its application may give a command: it leads and waits for nothing.
    pub(super) fn may_command(&self) -> bool {
        matches!(self.status, HelpStatus::Leader { .. }) && self.command.is_none()
    }

    /// Whether its application may call the task done: something was done.
    pub(super) fn may_complete_task(&self) -> bool {
        self.may_command() && self.next_request > 0
    }

    /// Whether it is a follower: then its safety timeout runs.
    pub(super) const fn leader(&self) -> Option<RobotIndex> {
        match self.status {
            HelpStatus::Follower { leader } => Some(leader),
            _ => None,
        }
    }

    /// The robot that it leads.
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
            HelpStatus::OfferHelp => "RAM offerHelp",
            HelpStatus::Leader { .. } => "RAM leader",
            HelpStatus::Follower { .. } => match self.progression {
                Progression::Idle => "RAM follower",
                Progression::Executing => "RAM follower, executing",
                Progression::Completed => "RAM follower, completed",
            },
        })
    }
}

impl fmt::Display for PaperRmcm {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Command(command) => write!(f, "RMCM command {}", command.request),
            Self::Acknowledgement(command) => write!(f, "RMCM ack {}", command.request),
        }
    }
}
