//! I2: a member of `s` was confirmed by the leader of `s`.

use crossguard_protocol::Confirmation;

use super::authentication::{Authentication, Insider};
use super::property::{Claim, Kind, Property, Rule, StateRule};
use super::view::View;

pub(super) const PROPERTY: Property = Property {
    id: "I2",
    authentication: Authentication::truth_of(&[Insider::Leader]),
    untimed: Some(Claim {
        kind: Kind::S,
        statement: "a follower in a session was confirmed by its leader",
        premise: Some("a robot follows"),
        rule: Rule::State(StateRule {
            holds,
            premise,
            of_two: true,
        }),
        weakening: "NeedsNoConfirmation",
    }),
    timed: None,
};

fn holds(view: &View) -> bool {
    view.followers().all(|(robot, following)| {
        let follower = Confirmation {
            station: robot.station(),
            offer: following.offer,
        };
        view.history().is_confirmed(following.session, follower)
    })
}

fn premise(view: &View) -> bool {
    view.followers().next().is_some()
}
