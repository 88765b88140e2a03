//! A state of the timed model, and what can happen to it.

use crossguard_protocol::{Event, Millis};

use super::channel::{Flight, TimedChannel};
use super::quiet::Quiet;
use super::sign::Sign;
use super::teams::MAX_TEAMS;
use super::told::Told;
use super::watch::StopWatch;
use crate::scenario::setup::{Bounds, MAX_ROBOTS};

/// A global state between two ticks.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub struct TimedState {
    pub(super) nodes: [u32; MAX_ROBOTS],
    pub(super) channel: TimedChannel,
    pub(super) left: Bounds,
    pub(super) watch: StopWatch,
    /// Time that each robot's clock has shown since the robot last took in the time.
    pub(super) untold: [Millis; MAX_ROBOTS],
    /// Which clocks are fast, one bit each, where each keeps its rate for a whole run.
    pub(super) rates: Option<u8>,
    pub(super) signs: [Sign; MAX_TEAMS],
    /// Since when a team's sign has shown go although a follower of it fell back for lack of contact, in
    /// ticks.
    pub(super) unguarded: [Option<u8>; MAX_TEAMS],
    /// Since when the pedestrian has waited for go, or the application for a reason, in ticks; where that is
    /// asked.
    pub(super) waiting: Option<u8>,
    /// State of the followers, as the leaders' applications know it.
    pub(super) told: Told,
    /// For how long each robot has heard no news of its leader.
    pub(super) quiet: [Option<Quiet>; MAX_ROBOTS],
    /// Properties that the step into this state broke, one bit each.
    pub(super) broken: u64,
}

impl TimedState {
    pub(super) const fn shows_go(&self, team: usize) -> bool {
        self.signs[team].shows_go()
    }

    pub(super) fn both_go(&self) -> bool {
        self.signs.iter().all(|sign| sign.shows_go())
    }

    /// Whether any sign shows go although a follower fell back for lack of contact.
    pub(super) fn is_unguarded(&self) -> bool {
        self.unguarded.iter().any(Option::is_some)
    }

    /// The place of the robot that hangs.
    pub(super) const fn hung(&self) -> Option<u8> {
        match self.watch {
            StopWatch::Hung(place, _) => Some(place),
            _ => None,
        }
    }
}

/// One thing that can happen.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum TimedAction {
    /// A tick passes. One bit per robot: whether its clock is fast.
    Tick(u8),
    /// A robot's endpoint looks at its clock, which has a timer due.
    Look(u8),
    /// A message arrives.
    Deliver(Flight),
    /// A robot's application does something.
    Local(u8, Event),
    /// A robot crashes for good.
    Crash(u8),
    /// A robot hangs: it takes in nothing and sends nothing, its body goes on.
    Hang(u8),
    /// A robot that hung goes on, and takes in the whole time at once.
    GoOn(u8),
    /// Two teams come within reach of each other.
    Meet,
}
