//! L1: `HelpRequested` leads to `RoleEstablished` or `Idle`.

use crossguard_protocol::State;

use super::{LivenessRule, LivenessSubject, LivenessSubjects, View};

pub(super) const RULE: LivenessRule = LivenessRule {
    subjects: LivenessSubjects::Robots,
    from: in_help_requested,
    to: |view, subject| !in_help_requested(view, subject),
};

fn in_help_requested(view: &View, LivenessSubject { robot, .. }: LivenessSubject) -> bool {
    let robot = view.node(robot).robot.as_ref();
    robot.is_some_and(|robot| robot.state() == State::HelpRequested)
}
