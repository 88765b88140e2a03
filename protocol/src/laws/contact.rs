//! Laws of contact: what restarts the timers by which a robot counts on another, and from what time on
//! (property I10, the follower's half, and the same for a helper).

use crate::config::Config;
use crate::id::SessionId;
use crate::input::Input;
use crate::message::{Coordination, Rmcm};
use crate::state::{Contact, Following, Offering, Phase, Robot};

use super::arithmetic::beat_is_newer;
use super::part::{following, is_newer_than_all};
use super::road::ending_told;
use super::taken::{Taken, is_listed};

/// All laws of this module.
pub fn all(config: &Config, step: &Taken) {
    contact_is_renewed_only_by_news(step);
    news_renews_contact_in_full(config, step);
    a_reservation_beats_with_its_request(config, step);
}

/// True if the input is news of the leader: its RAM with a newer heartbeat that lists the follower, or a
/// command that is newer than all that were answered.
fn is_news(step: &Taken, before: &Following) -> bool {
    match step.input {
        Input::Ram { ram, .. } => match ram.coordination {
            Coordination::Leader { heartbeat, .. } => {
                is_listed(step, before.session, before.offer)
                    && beat_is_newer(heartbeat, before.heard)
            }
            _ => false,
        },
        Input::Rmcm(Rmcm::Command(command)) => {
            command.session == before.session
                && command.to == step.before.station()
                && is_newer_than_all(command.request, before)
        }
        _ => false,
    }
}

/// I10: `T_safety` restarts only on a heartbeat or a command that is newer than all before.
pub fn contact_is_renewed_only_by_news(step: &Taken) {
    let (Some(before), Some(after)) = (following(&step.before), following(&step.after)) else {
        return;
    };
    let Contact::Fresh(left) = after.contact else {
        return;
    };
    let is_renewed = match before.contact {
        Contact::Fresh(was_left) => left.left() > was_left.left(),
        Contact::Lost(_) => true,
    };
    if is_renewed {
        assert!(is_news(step, before));
    }
    let is_heard = after.heard != before.heard;
    assert!(!is_heard || is_news(step, before));
}

/// I10: news restarts `T_safety` in full, and so does joining. A follower that restarted with less would fall
/// back while its leader's lease stands.
pub fn news_renews_contact_in_full(config: &Config, step: &Taken) {
    let Some(after) = following(&step.after) else {
        return;
    };
    if following(&step.before).is_none_or(|before| is_news(step, before)) {
        assert!(match after.contact {
            Contact::Fresh(left) => left.left() == Some(config.settings().t_safety),
            Contact::Lost(_) => false,
        });
        if let Input::Ram { ram, .. } = step.input
            && let Coordination::Leader { heartbeat, .. } = ram.coordination
        {
            // It is what the follower echoes.
            assert!(after.heard == heartbeat);
        }
    }
}

fn offering(robot: &Robot) -> Option<&Offering> {
    match robot.phase() {
        Phase::Offering(offering) => Some(offering),
        _ => None,
    }
}

/// A helper is reserved for `T_offer` from the newest heartbeat of its request on, in full; nothing else
/// prolongs that. Its offer echoes that heartbeat.
pub fn a_reservation_beats_with_its_request(config: &Config, step: &Taken) {
    let Some(after) = offering(&step.after) else {
        return;
    };
    // One that a message ends and asks for anew is another one.
    let known = offering(&step.before).filter(|before| {
        before.session == after.session && ending_told(step, before.session).is_none()
    });
    let told = match step.input {
        Input::Ram { ram, .. } => match ram.coordination {
            Coordination::NeedHelp {
                number, heartbeat, ..
            } => (after.session == SessionId::of(ram.station, number)).then_some(heartbeat),
            _ => None,
        },
        _ => None,
    };
    let news = told.filter(|told| known.is_none_or(|known| beat_is_newer(*told, known.heard)));
    if news.is_some() {
        assert!(Some(after.heard) == news);
        assert!(after.reservation.left() == Some(config.settings().t_offer));
    } else {
        assert!(known.is_some_and(|known| {
            after.heard == known.heard
                && after.number == known.number
                && after.reservation.left() <= known.reservation.left()
        }));
    }
}
