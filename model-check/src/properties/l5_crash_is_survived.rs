//! L5: if the leader crashes for good, every follower stops and is `Idle`.
//!
//! Within which time is what the timed view finds.

use super::{LivenessRule, LivenessSubject, LivenessSubjects, View, following_of};

pub(super) const RULE: LivenessRule = LivenessRule {
    subjects: LivenessSubjects::Robots,
    from: has_lost_its_leader,
    to: |view, LivenessSubject { robot, .. }| {
        view.node(robot).is_idle() && view.node(robot).actuation.running.is_none()
    },
};

fn has_lost_its_leader(view: &View, LivenessSubject { robot, .. }: LivenessSubject) -> bool {
    following_of(view.node(robot)).is_some_and(|following| {
        let leader = view.world.place_of(following.session.leader);
        leader.is_some_and(|leader| view.node(leader).robot.is_none())
            && view.world.restarts_are_over()
    })
}
