//! I15: a robot that rebooted takes part in no session from before.

use crossguard_protocol::{Phase, Robot};

use super::prelude::*;

property! {
    "I15", Authentication::truth_of(&[Insider::Leader]);
    untimed S "a rebooted robot takes part in no session from before its reboot",
        Some("a robot that crashed in a role has a role again"),
        Rule::State(StateRule { holds, premise, of_two: false }),
        "ConfirmsByStationAlone";
}

fn has_role(robot: &Robot) -> bool {
    matches!(robot.phase(), Phase::Leading(_) | Phase::Following(_))
}

fn holds(view: &View) -> bool {
    view.robots().filter(|robot| has_role(robot)).all(|robot| {
        let history = view.history();
        let old = |session| history.had_role_before_crash(robot.station(), session);
        !robot.session().is_some_and(old)
    })
}

fn premise(view: &View) -> bool {
    view.robots()
        .any(|robot| has_role(robot) && view.history().crashed_in_role(robot.station()))
}
