//! What happens to robots in a run, and when.

use crossguard_protocol::{Availability, StationId, TaskType};

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

/// What can happen to a robot.
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
    /// It leaves its session.
    Leave,
    /// It becomes available or not.
    Availability(Availability),
    /// Its application opens the corridor, whatever the plan says.
    OpenCorridor,
    /// Its application closes the corridor, whatever the plan says.
    CloseCorridor,
    /// Its application commands something out of turn.
    Command(StationId, TaskType),
    /// Its application says that all is done.
    TaskCompleted,
    /// It changes its pseudonym, if it may.
    ChangeIdentity,
    /// Its process hangs for this many milliseconds. What arrives waits for it.
    Hang(u32),
    /// Its body is pushed so far to the east and to the north, in metres.
    Push([f64; 2]),
}
