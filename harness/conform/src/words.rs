//! Words for reports.

use crossguard_protocol::{Coordination, Progress};

/// How far a command is, in a word.
pub(crate) const fn progress(progress: Progress) -> &'static str {
    match progress {
        Progress::Executing => "executing",
        Progress::InPosition => "in position",
        Progress::Completed => "completed",
        Progress::Failed(_) => "failed",
        Progress::SafeIdle => "safe idle",
    }
}

/// A robot's part in a session, in a few words.
pub(crate) fn part(coordination: &Coordination) -> &'static str {
    match coordination {
        Coordination::None => "idle",
        Coordination::NeedHelp { .. } => "asking",
        Coordination::OfferHelp { .. } => "offering",
        Coordination::Leader { yields: true, .. } => "leading, yields",
        Coordination::Leader { .. } => "leading",
        Coordination::Follower { last: None, .. } => "following",
        Coordination::Follower {
            last: Some(report), ..
        } => match report.progress {
            Progress::Executing => "following, executing",
            Progress::InPosition => "following, in position",
            Progress::Completed => "following, completed",
            Progress::Failed(_) => "following, failed",
            Progress::SafeIdle => "following, safe idle",
        },
    }
}
