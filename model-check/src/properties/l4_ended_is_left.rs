//! L4: an ended session leads to every former member being `Idle`.
//!
//! A follower has no way out of its session but to `Idle`, so what is to be shown is that it leaves.

use super::{LivenessRule, LivenessSubject, LivenessSubjects, View, following_of};

pub(super) const RULE: LivenessRule = LivenessRule {
    subjects: LivenessSubjects::Robots,
    from: is_orphaned,
    to: |view, subject| !is_orphaned(view, subject),
};

/// Whether the robot follows in a session that nobody leads any more.
fn is_orphaned(view: &View, LivenessSubject { robot, .. }: LivenessSubject) -> bool {
    following_of(view.node(robot)).is_some_and(|following| {
        view.leaders()
            .all(|(session, _)| session != following.session)
    })
}
