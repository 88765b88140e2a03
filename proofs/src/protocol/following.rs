//! Stages 3 and 4: a follower.

use crossguard_protocol::laws::arbitrary::Kind;
use crossguard_protocol::laws::steps::all;
use crossguard_protocol::{EventKind, OutputKind, Phase, Robot, Role};

use super::stage::{From, becomes, steps_with_those_of_leaders};

const FROM: From = From::stage(Role::Follower);

fn sees_people(robot: &Robot) -> bool {
    matches!(robot.phase(), Phase::Following(following) if following.sees_people)
}

steps_with_those_of_leaders! { FROM, all;
    @each |step| { "ignored": step.is_ignored() } {
        hears_an_answer(Kind::Answer);
        detects_a_pedestrian(Kind::Local(EventKind::PedestrianDetected));
        completes_the_task(Kind::Local(EventKind::TaskCompleted));
        changes_its_identity(Kind::Local(EventKind::IdentityChanged));
        hears_that_all_have_answered(Kind::Local(EventKind::AllAnswered));
    }
    @each |step| {
        "reports": !step.is_ignored(),
        "ignored": step.is_ignored(),
    } {
        completes_a_maneuver(Kind::Local(EventKind::ManeuverCompleted));
        fails_a_maneuver(Kind::Local(EventKind::ManeuverFailed));
        reaches_its_position(Kind::Local(EventKind::InPosition));
        leaves_its_position(Kind::Local(EventKind::OutOfPosition));
    }
    @each |step| {
        "stops as the crossing is completed": step.said.has(OutputKind::StopManeuver),
        "falls back as the session is aborted": step.said.has(OutputKind::FallBack),
        "names a session as over": step.said.has(OutputKind::SendRam),
        "ignored": step.is_ignored(),
    } {
        hears_an_offer(Kind::RamOfferHelp);
        hears_a_follower(Kind::RamFollower);
    }

    /// A RAM of a leader.
    hears_a_leader(Kind::RamLeader) |step| {
        "is not listed any more": becomes(step, Role::None),
        "falls back": step.said.has(OutputKind::FallBack),
        "hears a newer heartbeat": !step.is_ignored() && step.said.is_empty(),
        "ignored": step.is_ignored(),
    }

    /// A RAM of a robot without a part in a session.
    hears_a_farewell(Kind::RamNone) |step| {
        "stops as the crossing is completed": step.said.has(OutputKind::StopManeuver),
        "holds as it sees somebody": step.said.has(OutputKind::FallBack)
            && sees_people(&step.before),
        "falls back as the session is aborted": step.said.has(OutputKind::FallBack),
        "ignored": step.is_ignored(),
    }

    /// A RAM that asks for help.
    hears_a_request(Kind::RamNeedHelp) |step| {
        "stops as the crossing is completed": step.said.has(OutputKind::StopManeuver),
        "falls back as the session is aborted": step.said.has(OutputKind::FallBack),
        "ignored": step.is_ignored(),
    }

    /// A command.
    hears_a_command(Kind::Command) |step| {
        "supersedes": step.said.has(OutputKind::StartManeuver) && step.said.has(OutputKind::StopManeuver),
        "accepts": step.said.has(OutputKind::StartManeuver),
        "takes its duty up": step.before.duty().is_some() && step.after.duty().is_none(),
        "answers again": step.said.answered.is_some() && step.before == step.after,
        "rejects": step.said.answered.is_some() && !step.said.has(OutputKind::StartManeuver) && step.before != step.after,
        "ignored": step.is_ignored(),
    }

    /// The robot is to leave.
    leaves(Kind::Local(EventKind::LeaveRequested)) |step| {
        "leaves": becomes(step, Role::None),
        "falls back": step.said.has(OutputKind::FallBack),
    }

    /// The robot becomes available or unavailable.
    changes_its_availability(Kind::Local(EventKind::AvailabilityChanged)) |step| {
        "leaves": becomes(step, Role::None),
        "stops and stays": step.said.has(OutputKind::StopManeuver) && becomes(step, Role::Follower),
        "falls back and stays": step.said.has(OutputKind::FallBack) && becomes(step, Role::Follower),
        "ignored": step.is_ignored(),
    }

    /// The expiry of any timer.
    fires_a_timer(Kind::Expired) |step| {
        "falls back": step.said.has(OutputKind::FallBack),
        "leaves": becomes(step, Role::None),
        "ignored": step.is_ignored(),
    }

    /// It sees somebody on the road.
    sees_a_person(Kind::Local(EventKind::PersonOnRoad)) |step| {
        "sees": !step.is_ignored(),
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
