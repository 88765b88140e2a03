//! Stage 1: a robot without a part in a session.

use crossguard_protocol::laws::arbitrary::Kind;
use crossguard_protocol::laws::steps::all;
use crossguard_protocol::{EventKind, OutputKind, Role};

use super::stage::{From, becomes, steps_with_those_of_leaders};

const FROM: From = From::stage(Role::None);

steps_with_those_of_leaders! { FROM, all;
    @each |step| { "ignored": step.is_ignored() } {
        hears_a_farewell(Kind::RamNone);
        hears_a_command(Kind::Command);
        hears_an_answer(Kind::Answer);
        completes_a_maneuver(Kind::Local(EventKind::ManeuverCompleted));
        fails_a_maneuver(Kind::Local(EventKind::ManeuverFailed));
        completes_the_task(Kind::Local(EventKind::TaskCompleted));
        leaves(Kind::Local(EventKind::LeaveRequested));
        reaches_its_position(Kind::Local(EventKind::InPosition));
        leaves_its_position(Kind::Local(EventKind::OutOfPosition));
        sees_a_person(Kind::Local(EventKind::PersonOnRoad));
        hears_that_all_have_answered(Kind::Local(EventKind::AllAnswered));
    }
    @each |step| {
        "names a session as over": step.said.has(OutputKind::SendRam),
        "ignored": step.is_ignored(),
    } {
        hears_an_offer(Kind::RamOfferHelp);
        hears_a_leader(Kind::RamLeader);
        hears_a_follower(Kind::RamFollower);
    }

    /// A RAM that asks for help.
    hears_a_request(Kind::RamNeedHelp) |step| {
        "offers": becomes(step, Role::Helper),
        "ignored": step.is_ignored(),
    }

    /// A pedestrian.
    detects_a_pedestrian(Kind::Local(EventKind::PedestrianDetected)) |step| {
        "requests": becomes(step, Role::Requester),
        "ignored": step.is_ignored(),
    }

    /// The robot becomes available or unavailable.
    changes_its_availability(Kind::Local(EventKind::AvailabilityChanged)) |step| {
        "changes": step.before != step.after,
        "ignored": step.is_ignored(),
    }

    /// The robot has another pseudonym.
    changes_its_identity(Kind::Local(EventKind::IdentityChanged)) |step| {
        "changes": step.before.station() != step.after.station(),
        "ignored": step.is_ignored(),
    }

    /// The expiry of any timer.
    fires_a_timer(Kind::Expired) |step| {
        "unlocks": step.said.has(OutputKind::UnlockIdentity),
        "repeats its farewell": step.said.has(OutputKind::SendRam),
        "ignored": step.is_ignored(),
    }

    /// The road is clear.
    clears_the_road(Kind::Local(EventKind::RoadClear)) |step| {
        "ends a duty": !step.is_ignored(),
        "ignored": step.is_ignored(),
    }

    /// A larger boot counter has been persisted.
    renews_its_epoch(Kind::Local(EventKind::EpochRenewed)) |step| {
        "renews it": !step.is_ignored(),
        "ignored": step.is_ignored(),
    }
}
