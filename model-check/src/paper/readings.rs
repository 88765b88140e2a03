//! How the text is read where it does not say enough.

use serde::Deserialize;

/// A reading of the text. Every reading but the first differs from it in one point.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Deserialize)]
pub enum Reading {
    /// The text as it stands, with nothing added.
    Literal,
    /// The container of a robot that joins names the leader, and only that robot takes it.
    JoinNamesLeader,
    /// No `requestID` is used twice, and a reissued command has a new one.
    NewRequestIds,
    /// A follower that leaves says so and is free.
    LeaveByFollower,
    /// A leader has an execution timeout too, and may then reissue its command.
    LeaderTimesOut,
    /// A RAM that is older than one heard before is ignored, by its `GenerationDeltaTime`.
    OlderRamIgnored,
}

/// A hazard in another reading.
#[derive(Clone, Debug, Deserialize)]
pub struct OtherReading {
    /// The reading.
    pub reading: Reading,
    /// Whether the checker finds the hazard in it too.
    pub remains: bool,
    /// The difference in reading, and its effect on the hazard.
    pub says: String,
}
