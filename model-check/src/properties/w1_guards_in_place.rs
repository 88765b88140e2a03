//! W1: when a pedestrian steps on the road, every required guard is in place.
//!
//! Without time there is one exemption: a guard that has fallen back, finished, failed, left its place or lost power, as
//! long as its leader has not been informed. The timed model finds for how long a sign may show go then.

use crossguard_protocol::SessionId;

use super::prelude::*;

property! {
    "W1", Authentication::truth_of(&[Insider::Follower]);
    untimed T "when a pedestrian steps on the road, every guard is in place, or is gone and its leader has not been informed",
        Some("a pedestrian steps on the road"),
        Rule::StepOnRoad(holds),
        "AsksForFewer";
    timed S "no follower falls back for lack of contact while the sign shows go",
        Some("an executing follower falls back for lack of contact"),
        Rule::Timed(TimedRule {
            holds: |step: &TimedStepView| !step.after.is_unguarded,
            premise: &[TimedPremise::Step(has_fallback)],
            ends_run: false,
        }),
        "SHOWS_GO_TOO_LONG";
}

/// Judged when a pedestrian steps on the road at the sign of `session`, where this number of guards is required.
pub(super) fn holds(view: &View, session: SessionId, required: usize) -> bool {
    let places = view.configured().enumerate();
    let counts = places.filter(|(place, (node, config))| {
        let body = node.actuation.body;
        let of_session = body.maneuver().is_some_and(|id| id.session == session);
        of_session
            && (body.guards(config.settings()).is_some() || is_gone_untold(view, *place, body))
    });
    counts.count() >= required
}

fn is_gone_untold(view: &View, place: usize, body: Body) -> bool {
    let (Body::FallingBack(..) | Body::OutOfPosition(_) | Body::Ended(..), Some(id)) =
        (body, body.maneuver())
    else {
        return false;
    };
    // By its place: it may have changed its pseudonym since. No robot has the name of one that has booted again since.
    let mut commands = view.history.commands_with(id);
    commands.any(|command| {
        let to = view.world.place_of(command.to);
        to.is_none_or(|to| to == place) && !command.told
    })
}
