//! Laws of causes: an input that is ignored is counted under a cause that is so.

use crate::id::SessionId;
use crate::input::{Event, Input};
use crate::message::{Coordination, Rmcm};
use crate::output::Ignored;
use crate::state::Role;

use super::part::{leading, record_of};
use super::taken::Taken;

/// All laws of this module.
pub fn all(step: &Taken) {
    only_the_robots_own_messages_are_its_own(step);
    the_cause_is_so(step);
    commands_before_the_confirmation_are_early(step);
    offers_to_a_leader_are_late(step);
    requests_that_are_known_are_nothing_new(step);
}

/// The session that a message is about.
fn session(input: &Input) -> Option<SessionId> {
    Some(match *input {
        Input::Rmcm(Rmcm::Command(command)) => command.session,
        Input::Rmcm(Rmcm::Answer(answer)) => answer.session,
        Input::Ram { ram, .. } => match ram.coordination {
            Coordination::None => return None,
            Coordination::NeedHelp { number, .. } | Coordination::Leader { number, .. } => {
                SessionId::of(ram.station, number)
            }
            Coordination::OfferHelp { session, .. } | Coordination::Follower { session, .. } => {
                session
            }
        },
        _ => return None,
    })
}

/// I18: a message with the robot's own station id, an echo or a namesake's, is ignored as that.
pub fn only_the_robots_own_messages_are_its_own(step: &Taken) {
    let is_own = step.sender() == Some(step.before.station());
    assert!((step.said.ignored == Some(Ignored::OwnStation)) == is_own);
}

/// A command that comes before the confirmation is told from one of another session: the leader repeats it.
pub fn commands_before_the_confirmation_are_early(step: &Taken) {
    let Input::Rmcm(Rmcm::Command(command)) = step.input else {
        return;
    };
    let is_early = step.before.role() == Role::Helper
        && step.before.session() == Some(command.session)
        && command.to == step.before.station();
    assert!((step.said.ignored == Some(Ignored::NotJoined)) == is_early);
}

/// An offer to a session that has its roles is ignored as that: the list of followers answers it.
pub fn offers_to_a_leader_are_late(step: &Taken) {
    let Input::Ram { ram, .. } = step.input else {
        return;
    };
    if let Coordination::OfferHelp { session, .. } = ram.coordination
        && ram.farewell.is_none()
    {
        let is_late = step.before.role() == Role::Leader
            && step.before.session() == Some(session)
            && ram.station != step.before.station();
        assert!((step.said.ignored == Some(Ignored::RolesAlreadyAssigned)) == is_late);
    }
}

/// A follower that hears the request of its own session again has heard nothing new; any other is of no use to
/// it.
pub fn requests_that_are_known_are_nothing_new(step: &Taken) {
    let Input::Ram { ram, .. } = step.input else {
        return;
    };
    let is_request = matches!(ram.coordination, Coordination::NeedHelp { .. });
    if is_request && step.before.role() == Role::Follower && ram.farewell.is_none() {
        let is_known = session(&step.input) == step.before.session();
        assert!((step.said.ignored == Some(Ignored::NothingNew)) == is_known);
    }
}

/// The causes that name something which the state before shows.
pub fn the_cause_is_so(step: &Taken) {
    let (before, input) = (&step.before, &step.input);
    let is_of_its_session = before.session() == session(input);
    match step.said.ignored {
        Some(Ignored::InSession) => {
            assert!(before.role() != Role::None);
            assert!(!is_of_its_session || matches!(input, Input::Local(_)));
        }
        // Before the roles are assigned, nobody has a part of which an answer or a farewell could speak.
        Some(Ignored::OtherSession) => assert!(
            !is_of_its_session
                || matches!(input, Input::Ram { ram, .. } if ram.farewell.is_some())
                || matches!(before.role(), Role::Requester | Role::Helper)
        ),
        Some(Ignored::NotAFollower) => {
            let station = match *input {
                Input::Local(Event::CommandManeuver { follower, .. }) => Some(follower),
                _ => step.sender(),
            };
            let member = station.and_then(|s| leading(before).and_then(|l| record_of(l, s)));
            assert!(member.is_none());
        }
        Some(Ignored::NotLeading) => assert!(before.role() != Role::Leader),
        Some(Ignored::NotInSession) => assert!(before.role() == Role::None),
        Some(Ignored::OnDuty) => assert!(before.duty().is_some()),
        _ => {}
    }
}
