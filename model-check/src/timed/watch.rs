//! The stop-watch of a run.

/// The stop-watch of a run, in ticks. A run measures one thing at a time.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum StopWatch {
    /// Nothing is measured.
    Off,
    /// Since the pedestrian was detected; until the requester has roles or has given up.
    Request(u8),
    /// Since the leader crashed for good.
    LeaderDown(u8),
    /// Since the follower at this place failed while it was executing.
    FollowerFailed(u8, u8),
    /// Since the robot at this place began to hang; until it goes on.
    Hung(u8, u8),
    /// Two teams do not reach each other.
    Apart,
    /// Two teams reach each other, and neither leader has heard the other.
    Near,
    /// Since one of two leaders heard the other first; until one sign shows stop.
    BothGo(u8),
}

impl StopWatch {
    pub(super) fn tick(&mut self) {
        match self {
            Self::Off | Self::Apart | Self::Near => {}
            Self::Request(ticks)
            | Self::LeaderDown(ticks)
            | Self::FollowerFailed(_, ticks)
            | Self::Hung(_, ticks)
            | Self::BothGo(ticks) => {
                *ticks = ticks.saturating_add(1);
            }
        }
    }
}
