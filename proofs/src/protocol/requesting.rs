//! Stage 2: a robot that asks for help, with at most two offers.

use crossguard_protocol::laws::arbitrary::Kind;
use crossguard_protocol::laws::steps::{all, ignores};
use crossguard_protocol::{EndReason, EventKind, NoticeKind, OutputKind, Role, TimerKind};

use super::stage::{From, becomes, peers, steps_with_those_of_leaders};

pub(super) const FROM: From = From {
    peers: peers(Role::Requester),
    ..From::stage(Role::Requester)
};

/// Inputs that a requester always ignores, besides those that only leaders act on. [`ignored`](super::ignored) proves the other laws of such a step.
pub(super) const IGNORED: [Kind; 10] = [
    Kind::Command,
    Kind::Answer,
    Kind::Local(EventKind::PedestrianDetected),
    Kind::Local(EventKind::ManeuverCompleted),
    Kind::Local(EventKind::ManeuverFailed),
    Kind::Local(EventKind::IdentityChanged),
    Kind::Local(EventKind::InPosition),
    Kind::Local(EventKind::RoadClear),
    Kind::Local(EventKind::OutOfPosition),
    Kind::Local(EventKind::PersonOnRoad),
];

steps_with_those_of_leaders! { FROM, all, ignores;
    @each |step| { "ignored": step.is_ignored() } {
        hears_a_command(IGNORED[0], ignores);
        hears_an_answer(IGNORED[1], ignores);
        detects_a_pedestrian(IGNORED[2], ignores);
        completes_a_maneuver(IGNORED[3], ignores);
        fails_a_maneuver(IGNORED[4], ignores);
        changes_its_identity(IGNORED[5], ignores);
        reaches_its_position(IGNORED[6], ignores);
        clears_the_road(IGNORED[7], ignores);
        leaves_its_position(IGNORED[8], ignores);
        sees_a_person(IGNORED[9], ignores);
    }
    @each |step| { "ends its session": becomes(step, Role::None) } {
        completes_the_task(Kind::Local(EventKind::TaskCompleted));
        leaves(Kind::Local(EventKind::LeaveRequested));
        gives_up(Kind::Fires(TimerKind::Help));
        must_unlock(Kind::Fires(TimerKind::IdentityLock));
    }

    /// A RAM that asks for help as well.
    hears_a_request(Kind::RamNeedHelp) |step| {
        "helps the one that goes before": becomes(step, Role::Helper),
        "withdraws": becomes(step, Role::None),
        "notes a rival": !step.is_ignored() && step.said.is_empty(),
        "ignored": step.is_ignored(),
    }

    /// A RAM of a robot without a part in a session.
    hears_a_farewell(Kind::RamNone) |step| {
        "forgets an offer": !step.is_ignored() && step.said.is_empty(),
        "ignored": step.is_ignored(),
    }

    /// A RAM that offers help.
    hears_an_offer(Kind::RamOfferHelp) |step| {
        "takes it": !step.is_ignored() && step.said.is_empty(),
        "names a session as over": step.said.has(OutputKind::SendRam),
        "ignored": step.is_ignored(),
    }

    /// A RAM of a leader.
    hears_a_leader(Kind::RamLeader) |step| {
        "withdraws": matches!(step.said.ended, Some(EndReason::Withdrawn(_))),
        "notes a rival": !step.is_ignored() && step.said.is_empty(),
        "names a session as over": step.said.has(OutputKind::SendRam),
        "ignored": step.is_ignored(),
    }

    /// A RAM of a follower.
    hears_a_follower(Kind::RamFollower) |step| {
        "names a session as over": step.said.has(OutputKind::SendRam),
        "ignored": step.is_ignored(),
    }

    /// The robot becomes available or unavailable.
    changes_its_availability(Kind::Local(EventKind::AvailabilityChanged)) |step| {
        "ends its session": becomes(step, Role::None),
        "ignored": step.is_ignored(),
    }

    /// The end of the time for selection.
    selects(Kind::Fires(TimerKind::Selection)) |step| {
        "establishes the roles": becomes(step, Role::Leader),
        "goes on": becomes(step, Role::Requester),
    }

    /// The next RAM.
    repeats_itself(Kind::Fires(TimerKind::Ram)) |step| {
        "sends": step.said.has(OutputKind::SendRam),
    }

    /// The end of a farewell.
    ends_a_farewell(Kind::Fires(TimerKind::Farewell)) |step| {
        "ends it": !step.is_ignored(),
        "ignored": step.is_ignored(),
    }

    /// All robots nearby have answered.
    hears_that_all_have_answered(Kind::Local(EventKind::AllAnswered)) |step| {
        "establishes the roles": becomes(step, Role::Leader),
        "ignored": step.is_ignored(),
    }

    /// A larger boot counter has been persisted.
    renews_its_epoch(Kind::Local(EventKind::EpochRenewed)) |step| {
        "renews it": !step.is_ignored(),
        "ignored": step.is_ignored(),
    }

    /// The end of an offer.
    forgets_an_offer(Kind::Fires(TimerKind::Offer)) |step| {
        "it lapses": step.said.tells(NoticeKind::OfferLapsed),
        "ignored": step.is_ignored(),
    }
}
