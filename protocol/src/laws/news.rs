//! Laws of news: what changes is told to the application in the same step, and to the other robots at once.

use crate::id::{Heartbeat, RequestId};
use crate::input::Input;
use crate::message::{Coordination, Progress};
use crate::output::{EndReason, NoticeKind, OutputKind};
use crate::state::{Contact, Member, Robot, Role};

use super::part::{each_follower, following, leading, own_number, requesting};
use super::road::ending_told;
use super::taken::Taken;

/// All laws of this module.
pub fn all(step: &Taken) {
    a_new_part_is_told(step);
    contact_is_told(step);
    lapsed_offers_are_told(step);
    followers_are_told_of(step);
    progress_is_told(step);
    what_the_ram_says_is_sent_at_once(step);
}

/// News of one kind is told exactly if `happened`. When several timers fire in one step, more can have
/// happened than the state shows.
fn is_told(step: &Taken, notice: NoticeKind, happened: bool) {
    let told = step.said.tells(notice);
    if matches!(step.input, Input::Elapsed(_)) {
        assert!(told || !happened);
    } else {
        assert!(told == happened);
    }
}

/// The application is told of each part that the robot takes, and of each that it has no more.
pub fn a_new_part_is_told(step: &Taken) {
    let (before, after) = (step.before.role(), step.after.role());
    let was_helping = matches!(before, Role::Helper | Role::Follower);
    // A helper whose request a RAM ends and makes anew has another part in it, perhaps by the same number.
    let session = step.before.session().filter(|_| was_helping);
    let is_over = session.is_some_and(|session| ending_told(step, session).is_some());
    let is_other = is_over || own_number(&step.before) != own_number(&step.after);
    let joins = after == Role::Follower && before != Role::Follower;
    is_told(step, NoticeKind::Joined, joins);
    is_told(
        step,
        NoticeKind::Offering,
        after == Role::Helper && is_other,
    );
    is_told(step, NoticeKind::Released, was_helping && is_other);
    let gets_to_lead = before == Role::Requester && after == Role::Leader;
    is_told(step, NoticeKind::RolesEstablished, gets_to_lead);
    let was_asking = matches!(before, Role::Requester | Role::Leader);
    assert!(step.said.ended.is_some() == (was_asking && is_other));
}

/// A follower's application is told that contact is lost, and that it is back.
pub fn contact_is_told(step: &Taken) {
    let (Some(before), Some(after)) = (following(&step.before), following(&step.after)) else {
        return;
    };
    let was_lost = matches!(before.contact, Contact::Lost(_));
    let is_lost = matches!(after.contact, Contact::Lost(_));
    is_told(step, NoticeKind::ContactLost, is_lost && !was_lost);
    is_told(step, NoticeKind::ContactRegained, was_lost && !is_lost);
}

/// A requester's application is told when an offer has lapsed.
pub fn lapsed_offers_are_told(step: &Taken) {
    let (Some(before), Some(after)) = (requesting(&step.before), requesting(&step.after)) else {
        return;
    };
    let by_time = matches!(step.input, Input::Elapsed(_) | Input::Expired(_));
    let has_lapsed = by_time && after.offers.len() < before.offers.len();
    is_told(step, NoticeKind::OfferLapsed, has_lapsed);
}

/// W6: a leader's application is told of each follower that joins, gets or loses its lease, answers or goes.
pub fn followers_are_told_of(step: &Taken) {
    if step.said.ended == Some(EndReason::NoFollowers) {
        assert!(step.said.dropped.is_some());
    }
    let (Some(before), Some(after)) = (leading(&step.before), leading(&step.after)) else {
        return;
    };
    let is_gone = after.members.len() < before.members.len();
    is_told(step, NoticeKind::FollowerGone, is_gone);
    let yields = before.yields_to.is_none() && after.yields_to.is_some();
    is_told(step, NoticeKind::Yielded, yields);
    let (mut joined, mut granted, mut expired) = (false, false, false);
    let (mut acknowledged, mut rejected) = (false, false);
    each_follower(&step.after, &step.before, |member, known| {
        let Some(known) = known else { return };
        joined |= known.echoed.is_none() && member.echoed.is_some();
        granted |= !known.lease.stands() && member.lease.stands();
        expired |= known.lease.stands() && !member.lease.stands();
        if let Some(answered) = known.outstanding
            && member.outstanding.is_none()
        {
            let is_accepted = member
                .order
                .is_some_and(|order| order.request == answered.request);
            acknowledged |= is_accepted;
            rejected |= !is_accepted;
        }
    });
    is_told(step, NoticeKind::FollowerJoined, joined);
    is_told(step, NoticeKind::LeaseGranted, granted);
    is_told(step, NoticeKind::LeaseExpired, expired);
    is_told(step, NoticeKind::CommandAcknowledged, acknowledged);
    is_told(step, NoticeKind::CommandRejected, rejected);
}

/// I8, W6: a leader's application is told of all progress that counts.
pub fn progress_is_told(step: &Taken) {
    if leading(&step.before).is_none() || leading(&step.after).is_none() {
        return;
    }
    let mut told = [false; 5];
    each_follower(&step.after, &step.before, |member, known| {
        if known.is_some_and(|known| progress_of(known) != progress_of(member))
            && let Some((_, Some(progress))) = progress_of(member)
        {
            told[progress.kind() as usize] = true;
        }
    });
    is_told(step, NoticeKind::ManeuverReported, told[0]);
    is_told(step, NoticeKind::ManeuverInPosition, told[1]);
    is_told(step, NoticeKind::ManeuverCompleted, told[2]);
    is_told(step, NoticeKind::ManeuverFailed, told[3]);
    is_told(step, NoticeKind::FollowerSafeIdle, told[4]);
}

fn progress_of(member: &Member) -> Option<(RequestId, Option<Progress>)> {
    member.order.map(|order| (order.request, order.progress))
}

/// W6: a robot whose RAM says something else than before, other than a newer heartbeat or echo, sends it at
/// once.
pub fn what_the_ram_says_is_sent_at_once(step: &Taken) {
    let (before, after) = (&step.before, &step.after);
    let parts = without_heartbeats(before) != without_heartbeats(after);
    let farewell = after.farewell().is_some() && after.farewell() != before.farewell();
    let duty = before.duty().is_some() != after.duty().is_some();
    // The status container tells it.
    let status = before.availability() != after.availability();
    if parts || farewell || duty || status {
        assert!(step.said.has(OutputKind::SendRam));
    }
}

fn without_heartbeats(robot: &Robot) -> Coordination {
    let mut coordination = robot.ram().coordination;
    match &mut coordination {
        Coordination::None => {}
        Coordination::NeedHelp { heartbeat, .. }
        | Coordination::OfferHelp {
            echo: heartbeat, ..
        }
        | Coordination::Leader { heartbeat, .. }
        | Coordination::Follower {
            echo: heartbeat, ..
        } => *heartbeat = Heartbeat(0),
    }
    coordination
}
