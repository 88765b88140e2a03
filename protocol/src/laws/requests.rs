//! Laws of requests: when a robot asks for help, and with what.

use crate::MAX_FOLLOWERS;
use crate::config::Config;
use crate::input::{Event, Input};
use crate::output::OutputKind;
use crate::state::{Identity, Phase, Robot, Role};
use crate::task::Availability;

use super::part::requesting;
use super::taken::Taken;

/// All laws of this module.
pub fn all(config: &Config, step: &Taken) {
    a_pedestrian_is_asked_for_where_that_is_possible(step);
    a_request_begins_with_all_its_time(config, step);
}

/// True if nothing in the robot stands in the way of a new part in a session.
fn is_free(robot: &Robot) -> bool {
    matches!(robot.phase(), Phase::Idle)
        && robot.availability() == Availability::Available
        && robot.duty().is_none()
        && robot.identity() != Identity::Expiring
        && robot.next_number().count != u16::MAX
}

/// L1, W8: a robot that detects a pedestrian asks for one follower or more that have something to do, where
/// it has no other part or duty; everything else it refuses.
pub fn a_pedestrian_is_asked_for_where_that_is_possible(step: &Taken) {
    let Input::Local(Event::PedestrianDetected(request)) = step.input else {
        return;
    };
    let is_possible =
        (1..=MAX_FOLLOWERS).contains(&usize::from(request.followers)) && request.tasks.0 != 0;
    let asks = requesting(&step.after).is_some_and(|asked| asked.request == request)
        && step.before.role() == Role::None;
    assert!(asks == (is_possible && is_free(&step.before)));
    assert!(asks != step.is_ignored());
}

/// L1: a request that begins has `t_help` before it, knows no offer and no rival, and is told at once.
pub fn a_request_begins_with_all_its_time(config: &Config, step: &Taken) {
    let Some(after) = requesting(&step.after) else {
        return;
    };
    let settings = config.settings();
    if step.before.session() != step.after.session() {
        assert!(after.help.left() == Some(settings.t_help) && !after.selection.is_armed());
        assert!(after.offers.is_empty() && after.rival.is_none());
        assert!(after.heartbeat == settings.first_heartbeat);
        assert!(step.said.has(OutputKind::SendRam));
    }
}
