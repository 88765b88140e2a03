//! W7: once messages arrive and enough helpers are there, a request leads to a finished crossing.
//!
//! What that means here is said by [`Scenario::cooperative`](crate::scenario::Scenario::cooperative).

use crossguard_protocol::Phase;

use crate::properties::{LivenessRule, LivenessSubject, LivenessSubjects};
use crate::road::Pedestrian;

pub(crate) const RULE: LivenessRule = LivenessRule {
    subjects: LivenessSubjects::Robots,
    from: |view, LivenessSubject { robot, .. }| {
        let robot = view.node(robot).robot.as_ref();
        robot.is_some_and(|robot| matches!(robot.phase(), Phase::Requesting(_)))
    },
    to: |view, _| view.history.pedestrian == Pedestrian::Across,
};
