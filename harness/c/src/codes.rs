//! Codes that cross the boundary.

mod generated;

pub use generated::*;

/// Result of a call.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[repr(u32)]
pub enum CrossguardStatus {
    /// It did what it is for.
    Ok = 0,
    /// A pointer that must point to something is null.
    Null = 1,
    /// A buffer is too short; nothing has happened.
    ShortBuffer = 2,
    /// Header and library are of different versions, or the robot was made by another version.
    WrongVersion = 3,
    /// The robot was never initialised, or its memory has been overwritten.
    NotInitialised = 4,
    /// The robot was finished.
    Finished = 5,
    /// A pointer is not aligned as its type demands.
    Misaligned = 6,
    /// A code is none of its enumeration, or a number is out of range; nothing has happened.
    BadArgument = 7,
    /// The settings break an inequality; `crossguard_config_check` says which.
    BrokenSettings = 8,
    /// There is no more.
    End = 9,
    /// The library was built without this.
    Unsupported = 10,
    /// Another call is in this robot, of another thread; nothing has happened, and its time is yet to be told.
    InUse = 11,
}

/// Task types that have names; a robot may give meaning to the others, up to 15.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[repr(u8)]
pub enum CrossguardTask {
    // <named tasks>
    /// Go to the place where the maneuver starts.
    InitialPos = 0,
    /// Escort: move along with the pedestrian.
    Move = 1,
    /// Hold back one direction of traffic.
    Block = 2,
    // </named tasks>
}

/// A duty on the road that outlives its command or its session. It ends with an event `RoadClear`.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[repr(u8)]
pub enum CrossguardDuty {
    /// None.
    None = 0,
    /// The body carries out the fallback of a maneuver.
    FallingBack = 1,
    /// The robot led a session that ended while people may have been on the road.
    Crossing = 2,
}

/// A message of robots.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[repr(u8)]
pub enum CrossguardMessage {
    /// None.
    None = 0,
    /// Robot awareness message.
    Ram = 1,
    /// Robot maneuver coordination message.
    Rmcm = 2,
}
