//! The robot under test, as a tester reaches it: packets, the time, and a person at its side.

use std::fmt;

use crossguard_protocol::{StationId, TaskType, Unavailability};

/// Something that happens at the robot under test, and that no packet can bring about.
///
/// Its text is a line that `crossguard run` understands when it is typed.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Local {
    /// A pedestrian needs help by this many followers, who will be asked for `initialPos`, `move` and `block`.
    Detect(u8),
    /// The robot commands a follower.
    Order(StationId, TaskType),
    /// Its body holds the place from which it guards.
    InPosition,
    /// The maneuver that runs is finished.
    Done,
    /// The maneuver that runs cannot be finished.
    Fail,
    /// The road is clear, and the body has finished its fallback.
    Clear,
    /// Let the pedestrian cross.
    Open,
    /// Hold the pedestrian back again.
    Close,
    /// The pedestrian has crossed.
    TaskCompleted,
    /// Leave the session.
    Leave,
    /// It takes no part for this reason.
    Unavailable(Unavailability),
    /// It takes part again.
    Available,
}

impl fmt::Display for Local {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Detect(followers) => write!(f, "detect {followers} medium initialPos move block"),
            Self::Order(station, task) => write!(f, "order {station} {task}"),
            Self::InPosition => f.write_str("in-position"),
            Self::Done => f.write_str("done"),
            Self::Fail => f.write_str("fail"),
            Self::Clear => f.write_str("clear"),
            Self::Open => f.write_str("open"),
            Self::Close => f.write_str("close"),
            Self::TaskCompleted => f.write_str("task-completed"),
            Self::Leave => f.write_str("leave"),
            Self::Unavailable(why) => {
                let why = why.to_string().replace(' ', "-");
                write!(f, "unavailable {why}")
            }
            Self::Available => f.write_str("available"),
        }
    }
}

/// Why something could not be brought about at the robot.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum NotTold {
    /// There is no way to tell it such a thing.
    #[error("nobody tells the robot '{0}': say how by --typed, --hook or --ask")]
    NoWay(String),
    /// It cannot be started anew.
    #[error("nobody starts the robot anew: say how by --start")]
    NoRestart,
    /// The way failed.
    #[error("'{what}': {why}")]
    Failed {
        /// The event that was to be told.
        what: String,
        /// Why it was not.
        why: String,
    },
}

/// How something comes about at the robot.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Telling {
    /// It was told.
    Told,
    /// The robot does such things by itself, whenever it likes: they are waited for.
    Awaited,
}

/// The link or the robot is gone.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Gone {
    /// Nothing can be sent or received any more.
    #[error("the link failed: {0}")]
    Link(String),
    /// The robot under test cannot be started, or has ended at once.
    #[error("the robot under test: {0}")]
    Robot(String),
    /// The robot under test, which was started here, has ended by itself.
    #[error("the robot under test has ended by itself")]
    Ended,
    /// The tester was told to stop.
    #[error("stopped")]
    Stopped,
}

/// A packet of the robot under test, or of anybody else on the link.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Packet {
    /// When it arrived, in ms on the tester's clock.
    pub at_ms: u64,
    /// The packet itself.
    pub octets: Vec<u8>,
}

/// The robot under test.
pub trait Subject {
    /// The time, in ms since any fixed moment.
    fn now_ms(&self) -> u64;

    /// The time as `TimestampIts`.
    fn timestamp_its(&self) -> u64;

    /// Waits for the next packet, until this time at the latest. It never returns `None` before.
    ///
    /// # Errors
    /// The link or the robot is gone.
    fn listen(&mut self, until_ms: u64) -> Result<Option<Packet>, Gone>;

    /// Sends a packet to it.
    ///
    /// # Errors
    /// The link is gone.
    fn send(&mut self, packet: &[u8]) -> Result<(), Gone>;

    /// Brings something about at the robot.
    ///
    /// # Errors
    /// Why it did not happen.
    fn tell(&mut self, local: Local) -> Result<Telling, NotTold>;

    /// Ends the robot without a word, and starts it again.
    ///
    /// # Errors
    /// Why it was not started.
    fn restart(&mut self) -> Result<(), NotTold>;
}
