//! Stage 2: a robot that offers help.

use crossguard_protocol::laws::arbitrary::Kind;
use crossguard_protocol::laws::steps::all;
use crossguard_protocol::{EventKind, OutputKind, Role};

use super::stage::{From, becomes, steps_with_those_of_leaders};

const FROM: From = From::stage(Role::Helper);

steps_with_those_of_leaders! { FROM, all;
    @each |step| { "ignored": step.is_ignored() } {
        hears_a_command(Kind::Command);
        hears_an_answer(Kind::Answer);
        detects_a_pedestrian(Kind::Local(EventKind::PedestrianDetected));
        completes_a_maneuver(Kind::Local(EventKind::ManeuverCompleted));
        fails_a_maneuver(Kind::Local(EventKind::ManeuverFailed));
        completes_the_task(Kind::Local(EventKind::TaskCompleted));
        changes_its_identity(Kind::Local(EventKind::IdentityChanged));
        reaches_its_position(Kind::Local(EventKind::InPosition));
        leaves_its_position(Kind::Local(EventKind::OutOfPosition));
        sees_a_person(Kind::Local(EventKind::PersonOnRoad));
        clears_the_road(Kind::Local(EventKind::RoadClear));
        hears_that_all_have_answered(Kind::Local(EventKind::AllAnswered));
    }
    @each |step| {
        "the session ended": becomes(step, Role::None),
        "names a session as over": step.said.has(OutputKind::SendRam),
        "ignored": step.is_ignored(),
    } {
        hears_an_offer(Kind::RamOfferHelp);
        hears_a_follower(Kind::RamFollower);
    }
    @each |step| {
        "withdraws": becomes(step, Role::None),
        "ignored": step.is_ignored(),
    } {
        changes_its_availability(Kind::Local(EventKind::AvailabilityChanged));
        fires_a_timer(Kind::Expired);
    }

    /// A RAM of a leader.
    hears_a_leader(Kind::RamLeader) |step| {
        "joins": becomes(step, Role::Follower),
        "is not listed": becomes(step, Role::None),
        "ignored": step.is_ignored(),
    }

    /// A RAM of a robot without a part in a session.
    hears_a_farewell(Kind::RamNone) |step| {
        "the session ended": becomes(step, Role::None),
        "ignored": step.is_ignored(),
    }

    /// A RAM that asks for help.
    hears_a_request(Kind::RamNeedHelp) |step| {
        "stays reserved": !step.is_ignored() && step.said.is_empty(),
        "the session ended": becomes(step, Role::None),
        "ignored": step.is_ignored(),
    }

    /// The robot is to leave.
    leaves(Kind::Local(EventKind::LeaveRequested)) |step| {
        "leaves": becomes(step, Role::None),
    }

    /// A larger boot counter has been persisted.
    renews_its_epoch(Kind::Local(EventKind::EpochRenewed)) |step| {
        "renews it": !step.is_ignored(),
        "ignored": step.is_ignored(),
    }
}
