//! A robot in the model: its protocol state, and what its outputs have made its body do.

use std::fmt;

use crossguard_protocol::{
    Config, Corridor, Event, Following, Identity, Input, Leading, List, MAX_TIMERS, ManeuverId,
    Millis, Output, Outputs, Phase, Renaming, Robot, SessionId, StationId, Timer,
};

use smallvec::SmallVec;

use crate::canonical::Renamable;
use crate::road::{Body, Heard};

/// A transition function. The kit has one, [`Protocol`]; to put another in its place shows what a
/// rule is good for.
pub trait Rules: Send + Sync {
    /// Takes one input in; the outputs in order.
    fn step(&self, robot: &mut Robot, config: &Config, input: Input) -> Outputs;
}

impl fmt::Debug for dyn Rules {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Rules")
    }
}

/// The transition function of the kit, [`Robot::step`].
#[derive(Clone, Copy, Debug)]
pub struct Protocol;

impl Rules for Protocol {
    fn step(&self, robot: &mut Robot, config: &Config, input: Input) -> Outputs {
        robot.step(config, input)
    }
}

/// A robot in the model.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub struct Node {
    /// The protocol state; `None` while the robot is down.
    pub robot: Option<Robot>,
    /// The station id that it had when it went down, and its boot counter, which it has persisted.
    pub persisted: Persisted,
    /// State of the body and the application by the outputs so far.
    pub actuation: Actuation,
}

/// State that survives a crash: the boot counter by the protocol's own rule, the station id because the
/// model's robots keep theirs.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Persisted {
    /// The station id.
    pub station: StationId,
    /// The boot counter.
    pub boot: u16,
}

/// State of a robot's body and application by its outputs alone. The properties compare it with the protocol state.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub struct Actuation {
    /// Whether the pedestrian is let across.
    pub corridor_open: bool,
    /// Whether the pseudonym is held.
    pub identity_locked: bool,
    /// Activity of the body, also of its own accord.
    pub body: Body,
    /// Messages that it has received, as a leader, of a leader that goes before it at its place.
    pub heard: Heard,
    /// Whether its sign has shown go, and its application has not said since then that the road is clear.
    pub road_unsure: bool,
}

impl Node {
    /// A robot at its first boot.
    #[must_use]
    pub fn first_boot(station: StationId) -> Self {
        Self::booted(Robot::new(station, 1))
    }

    /// A robot that has just booted.
    #[must_use]
    pub fn booted(robot: Robot) -> Self {
        let (station, boot) = (robot.station(), robot.boot());
        Self {
            robot: Some(robot),
            persisted: Persisted { station, boot },
            actuation: Actuation::default(),
        }
    }

    /// A robot that has never booted.
    #[must_use]
    pub fn down(station: StationId) -> Self {
        Self {
            robot: None,
            persisted: Persisted { station, boot: 0 },
            actuation: Actuation::default(),
        }
    }

    /// The robot after a crash. Its motors stop and it stays where it is; its sign shows nothing.
    #[must_use]
    pub fn crashed(&self) -> Self {
        Self {
            robot: None,
            persisted: self.persisted,
            actuation: Actuation {
                body: self.actuation.body.off(),
                ..Actuation::default()
            },
        }
    }

    /// The robot after it has booted again, with the next boot counter.
    #[must_use]
    pub fn restarted(&self) -> Self {
        let Persisted { station, boot } = self.persisted;
        let mut node = Self::booted(Robot::new(station, boot + 1));
        node.actuation.body = self.actuation.body;
        node
    }

    /// One step of the transition function, and what its outputs make the body do. `None` when the robot is
    /// down.
    pub fn step(
        &self,
        rules: &dyn Rules,
        config: &Config,
        input: Input,
    ) -> Option<(Self, Outputs)> {
        let mut robot = self.robot.clone()?;
        let outputs = rules.step(&mut robot, config, input);
        Some((self.observed(input, &outputs, robot), outputs))
    }

    /// The node after a step that has taken its robot to `after`.
    #[must_use]
    pub fn observed(&self, input: Input, outputs: &Outputs, after: Robot) -> Self {
        let heard = match &self.robot {
            Some(before) => {
                let heard = self.actuation.heard;
                heard.after(&before.ram(), input, &after.ram())
            }
            None => Heard::Nothing,
        };
        let mut next = Self {
            persisted: Persisted {
                station: after.station(),
                ..self.persisted
            },
            robot: Some(after),
            ..*self
        };
        next.actuation.heard = heard;
        next.actuation.body = self.actuation.body.after(input, outputs);
        next.actuation.road_clear(input, outputs);
        for output in outputs.iter() {
            next.actuation.follow(output);
        }
        next
    }

    /// The part of the robot in a session; `None` while it is down.
    #[must_use]
    pub fn phase(&self) -> Option<&Phase> {
        self.robot.as_ref().map(Robot::phase)
    }

    /// Its part as a leader, if it leads.
    #[must_use]
    pub fn leading(&self) -> Option<&Leading> {
        match self.phase()? {
            Phase::Leading(leading) => Some(leading),
            _ => None,
        }
    }

    /// Its part as a follower, if it follows.
    #[must_use]
    pub fn following(&self) -> Option<&Following> {
        match self.phase()? {
            Phase::Following(following) => Some(following),
            _ => None,
        }
    }

    /// The session that it has a part in.
    #[must_use]
    pub fn session(&self) -> Option<SessionId> {
        self.robot.as_ref()?.session()
    }

    /// The timers that run.
    pub(crate) fn timers(&self) -> List<(Timer, Millis), MAX_TIMERS> {
        self.robot.as_ref().map(Robot::timers).unwrap_or_default()
    }

    /// Whether the robot has a part in no session. One that is down has none.
    #[must_use]
    pub fn is_idle(&self) -> bool {
        matches!(self.phase(), None | Some(Phase::Idle))
    }

    /// Whether the robot asks for help.
    #[must_use]
    pub fn is_requesting(&self) -> bool {
        matches!(self.phase(), Some(Phase::Requesting(_)))
    }

    /// Whether the robot follows and has lost contact with its leader.
    #[must_use]
    pub fn has_lost_contact(&self) -> bool {
        self.following().is_some_and(|it| it.contact.is_lost())
    }

    /// Whether what the body does is what the protocol state says.
    #[must_use]
    pub fn actuation_agrees(&self) -> bool {
        let (mut running, mut corridor_open, mut identity_locked) = (None, false, false);
        if let Some(robot) = &self.robot {
            match robot.phase() {
                Phase::Following(following) => running = following.executing().map(|m| m.id),
                Phase::Leading(leading) => corridor_open = leading.corridor == Corridor::Open,
                Phase::Idle | Phase::Requesting(_) | Phase::Offering(_) => {}
            }
            identity_locked = robot.identity() != Identity::Unlocked;
        }
        self.actuation.running() == running
            && self.actuation.corridor_open == corridor_open
            && self.actuation.identity_locked == identity_locked
    }

    /// The node without its durations: every armed timer has 1 ms left. Which timers are armed
    /// stays.
    #[must_use]
    pub fn untimed(&self) -> Self {
        self.renamed(&mut ForgetDurations)
    }

    /// The timers that the last step from a node without durations has armed.
    pub(crate) fn restarted_timers(&self) -> SmallVec<[Timer; 4]> {
        let timers = self.timers();
        let restarted = timers.iter().filter(|(_, left)| *left != FORGOTTEN);
        restarted.map(|(timer, _)| *timer).collect()
    }
}

impl fmt::Display for Node {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(robot) = &self.robot else {
            return f.write_str("down");
        };
        write!(f, "{robot}")?;
        if self.actuation.body != Body::Parked {
            write!(f, "; its body: {}", self.actuation.body)?;
        }
        if self.actuation.corridor_open {
            f.write_str("; the corridor is open")?;
        }
        let timers = robot.timers();
        let timers = timers.iter().map(|(timer, _)| timer.to_string());
        let timers: SmallVec<[String; 4]> = timers.collect();
        write!(f, "; timers: {}", timers.join(", "))
    }
}

impl Renamable for Node {
    fn renamed(&self, to: &mut impl Renaming) -> Self {
        Self {
            robot: self.robot.as_ref().map(|robot| robot.renamed(to)),
            persisted: Persisted {
                station: to.station(self.persisted.station),
                ..self.persisted
            },
            actuation: Actuation {
                body: self.actuation.body.renamed(to),
                heard: self.actuation.heard.renamed(to),
                ..self.actuation
            },
        }
    }
}

/// Time left of an armed timer in a node without durations.
const FORGOTTEN: Millis = Millis(1);

struct ForgetDurations;

impl Renaming for ForgetDurations {
    fn countdown(&mut self, _timer: Timer, _left: Millis) -> Millis {
        FORGOTTEN
    }
}

impl Actuation {
    /// The maneuver that runs.
    #[must_use]
    pub fn running(&self) -> Option<ManeuverId> {
        self.body.running().map(|maneuver| maneuver.id)
    }

    /// The application says itself that the road is clear.
    fn road_clear(&mut self, input: Input, outputs: &Outputs) {
        if let Input::Local(Event::RoadClear | Event::TaskCompleted) = input
            && outputs.ignored().is_none()
        {
            self.road_unsure = false;
        }
    }

    fn follow(&mut self, output: &Output) {
        match output {
            // Without time it shows go until an output closes it; pedestrians may look at any time.
            Output::CorridorOpened(_) => (self.corridor_open, self.road_unsure) = (true, true),
            // A sign that is told to show go for longer shows go, whatever it showed before.
            Output::CorridorExtended(_) => self.corridor_open = true,
            Output::CorridorClosed(_) => self.corridor_open = false,
            Output::LockIdentity => self.identity_locked = true,
            Output::UnlockIdentity => self.identity_locked = false,
            Output::StartManeuver(_)
            | Output::StopManeuver(..)
            | Output::FallBack(..)
            | Output::SendRam
            | Output::SendRmcm(_)
            | Output::RenewEpoch
            | Output::Notify(_)
            | Output::Ignored(_) => {}
        }
    }
}
