//! Laws of farewells: a robot that leaves says so, and is let go.

use crate::id::{OfferNumber, SessionId};
use crate::input::{Event, Input, Timer};
use crate::message::{Coordination, Ending, Farewell};
use crate::state::{Identity, Role};

use super::part::{leading, own_number, record_of, requesting};
use super::taken::Taken;

/// All laws of this module.
pub fn all(step: &Taken) {
    who_leaves_says_so(step);
    who_left_is_let_go(step);
    a_farewell_is_not_prolonged(step);
    only_the_application_completes(step);
}

/// W2: a session is named as completed, which frees its guards, only by the application of its leader, and while it lasts.
/// One of which the robot knows nothing any more was aborted.
pub fn only_the_application_completes(step: &Taken) {
    let (before, after) = (step.before.farewell(), step.after.farewell());
    if let Some(Farewell::Ended(number, Ending::Completed)) = after
        && before != after
    {
        assert!(step.input == Input::Local(Event::TaskCompleted));
        assert!(step.before.session() == Some(SessionId::of(step.before.station(), number)));
    }
}

/// L4: a helper or follower that leaves by its own decision names what it leaves.
pub fn who_leaves_says_so(step: &Taken) {
    let (before, after) = (&step.before, &step.after);
    let decides = matches!(
        step.input,
        Input::Local(Event::LeaveRequested | Event::AvailabilityChanged(_))
            | Input::Expired(Timer::Leave | Timer::IdentityLock)
    );
    if decides
        && matches!(before.role(), Role::Helper | Role::Follower)
        && after.role() == Role::None
        && let Some((session, number)) = own_number(before)
    {
        assert!(after.farewell() == Some(Farewell::Left(session, OfferNumber(number))));
    }
}

/// W6: a session that a helper names as left, by the offer that stands or a newer one, is over for its leader.
pub fn who_left_is_let_go(step: &Taken) {
    let Input::Ram { ram, .. } = step.input else {
        return;
    };
    let Some(Farewell::Left(session, offer)) = ram.farewell else {
        return;
    };
    if step.before.session() != Some(session)
        || ram.station == step.before.station()
        || ram.coordination != Coordination::None
    {
        return;
    }
    if let Some(before) = requesting(&step.before) {
        let mut offers = before.offers.iter();
        let is_left = offers.any(|known| known.station == ram.station && known.number <= offer);
        let after = requesting(&step.after);
        let is_gone = after.is_none_or(|after| after.offers.len() < before.offers.len());
        assert!(is_left == is_gone);
    }
    if let Some(before) = leading(&step.before) {
        let member = record_of(before, ram.station);
        let is_left = member.is_some_and(|member| member.offer <= offer);
        assert!(step.said.dropped.is_some() == is_left);
    }
}

/// I18, W2: a session is named as over for its time and no longer, how it ended stays as it was said, and nothing
/// more is named once the identity has been locked as long as it may.
pub fn a_farewell_is_not_prolonged(step: &Taken) {
    let (before, after) = (step.before.farewell, step.after.farewell);
    let (Some(before), Some(after)) = (before, after) else {
        let is_new = after.is_some();
        assert!(!(is_new && step.before.identity() == Identity::Expiring));
        return;
    };
    if let (Farewell::Ended(was, how), Farewell::Ended(number, ending)) =
        (before.farewell, after.farewell)
    {
        assert!(was != number || how == ending);
    }
    if before.farewell == after.farewell {
        assert!(after.left.left() <= before.left.left());
    } else {
        assert!(step.before.identity() != Identity::Expiring);
    }
}
