//! Events of robots in a run, and their times.

use crossguard_protocol::Event;

/// Something that happens to one robot.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Happening {
    /// When, in microseconds since the run began.
    pub at_us: u64,
    /// To which robot, by its place.
    pub place: usize,
    /// What.
    pub deed: Deed,
}

/// Event that can happen to a robot.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Deed {
    /// It detects a pedestrian.
    Detect,
    /// It loses its volatile state.
    Crash,
    /// It boots with the next boot counter, if it is down.
    Boot,
    /// Its body cannot finish what it does.
    Fail,
    /// Its application says this, whatever the plan says.
    Event(Event),
    /// It changes its pseudonym, if it may.
    ChangeIdentity,
    /// Its process hangs for this many milliseconds. Packets that arrive wait for it.
    Hang(u32),
    /// Its body is pushed so far to the east and to the north, in metres.
    Push([f64; 2]),
}
