//! L6: two simultaneous requesters: one of them gets to lead, or both return to `Idle`.

use crossguard_protocol::Phase;

use super::{LivenessRule, Subject, Subjects, View, leading_of};

pub(super) const RULE: LivenessRule = LivenessRule {
    subjects: Subjects::Pairs,
    from: |view, Subject { robot, other }| asks(view, robot) && asks(view, other),
    to: |view, Subject { robot, other }| {
        let both = [view.node(robot), view.node(other)];
        both.iter().any(|node| leading_of(node).is_some()) || both.iter().all(|node| node.is_idle())
    },
};

fn asks(view: &View, robot: usize) -> bool {
    let robot = view.node(robot).robot.as_ref();
    robot.is_some_and(|robot| matches!(robot.phase(), Phase::Requesting(_)))
}
