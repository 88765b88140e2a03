//! I15: a robot that rebooted takes part in no session from before.

use crossguard_protocol::{Phase, Robot};

use super::{StateRule, View};

pub(super) const RULE: StateRule = StateRule { holds, premise };

fn has_role(robot: &Robot) -> bool {
    matches!(robot.phase(), Phase::Leading(_) | Phase::Following(_))
}

fn holds(view: &View) -> bool {
    view.robots().filter(|robot| has_role(robot)).all(|robot| {
        robot.session().is_none_or(|session| {
            !view
                .history()
                .had_role_before_crash(robot.station(), session)
        })
    })
}

/// A robot that crashed in a role has one again.
fn premise(view: &View) -> bool {
    view.robots()
        .any(|robot| has_role(robot) && view.history().crashed_in_role(robot.station()))
}
