//! The effect of a step on the part, the numbers and the leases of a leader; and the outcomes of each input.

use crossguard_protocol::laws::arbitrary::Kind;
use crossguard_protocol::laws::steps::{ignores, of_part_and_numbers};
use crossguard_protocol::{EndReason, EventKind, NoticeKind, OutputKind, Role, TimerKind};

use super::{FROM, IGNORED};
use crate::protocol::stage::{becomes, steps_of_leaders};

steps_of_leaders! { FROM, of_part_and_numbers;
    @each |step| { "ignored": step.is_ignored() } {
        hears_a_request(IGNORED[0], ignores);
        hears_a_command(IGNORED[1], ignores);
        detects_a_pedestrian(IGNORED[2], ignores);
        completes_a_maneuver(IGNORED[3], ignores);
        fails_a_maneuver(IGNORED[4], ignores);
        changes_its_identity(IGNORED[5], ignores);
        reaches_its_position(IGNORED[6], ignores);
        hears_that_all_have_answered(IGNORED[7], ignores);
    }
    @each |step| { "ends its session": becomes(step, Role::None) } {
        completes_the_task(Kind::Local(EventKind::TaskCompleted));
        leaves(Kind::Local(EventKind::LeaveRequested));
        must_unlock(Kind::Fires(TimerKind::IdentityLock));
    }

    /// A RAM of a follower.
    hears_a_follower(Kind::RamFollower) |step| {
        "joins": step.said.tells(NoticeKind::FollowerJoined),
        "grants a lease": step.said.tells(NoticeKind::LeaseGranted),
        "counts as acknowledged": step.said.tells(NoticeKind::CommandAcknowledged),
        "counts as in position": step.said.tells(NoticeKind::ManeuverInPosition),
        "counts as out of position": step.said.tells(NoticeKind::ManeuverReported)
            && step.said.has(OutputKind::CorridorClosed),
        "counts as completed": step.said.tells(NoticeKind::ManeuverCompleted),
        "extends the corridor": step.said.has(OutputKind::CorridorExtended),
        "closes the corridor": step.said.has(OutputKind::CorridorClosed),
        "ignored": step.is_ignored(),
    }

    /// A RAM of a robot without a part in a session.
    hears_a_farewell(Kind::RamNone) |step| {
        "the last follower left": becomes(step, Role::None),
        "a follower left": step.said.tells(NoticeKind::FollowerGone) && becomes(step, Role::Leader),
        "ignored": step.is_ignored(),
    }

    /// A RAM that offers help.
    hears_an_offer(Kind::RamOfferHelp) |step| {
        "names a session as over": step.said.has(OutputKind::SendRam),
        "ignored": step.is_ignored(),
    }

    /// A RAM of a leader.
    hears_a_leader(Kind::RamLeader) |step| {
        "yields": step.said.tells(NoticeKind::Yielded) && becomes(step, Role::Leader),
        "ends for the one that goes before": matches!(step.said.ended, Some(EndReason::Withdrawn(_))),
        "notes a rival": !step.is_ignored() && step.said.is_empty(),
        "names a session as over": step.said.has(OutputKind::SendRam),
        "ignored": step.is_ignored(),
    }

    /// An answer.
    hears_an_answer(Kind::Answer) |step| {
        "acknowledged": step.said.tells(NoticeKind::CommandAcknowledged),
        "rejected": step.said.tells(NoticeKind::CommandRejected),
        "ignored": step.is_ignored(),
    }

    /// The robot becomes available or unavailable.
    changes_its_availability(Kind::Local(EventKind::AvailabilityChanged)) |step| {
        "ends its session": becomes(step, Role::None),
        "ignored": step.is_ignored(),
    }

    /// The end of a lease.
    loses_a_lease(Kind::Fires(TimerKind::Lease)) |step| {
        "a lease ran out": step.said.tells(NoticeKind::LeaseExpired),
        "closes the corridor": step.said.has(OutputKind::CorridorClosed),
        "ignored": step.is_ignored(),
    }

    /// A follower without a lease for too long.
    gives_up_a_follower(Kind::Fires(TimerKind::Lost)) |step| {
        "drops a follower": step.said.tells(NoticeKind::FollowerGone),
        "ends its session": becomes(step, Role::None),
        "ignored": step.is_ignored(),
    }

    /// `T_exec`.
    limits_an_execution(Kind::Fires(TimerKind::Execution)) |step| {
        "the execution limit ran out": step.said.tells(NoticeKind::ManeuverFailed),
        "ignored": step.is_ignored(),
    }

    /// `T_ack`.
    misses_an_acknowledgement(Kind::Fires(TimerKind::Acknowledgement)) |step| {
        "repeats a command": step.said.commanded,
        "drops a follower": step.said.tells(NoticeKind::FollowerGone),
        "ends its session": becomes(step, Role::None),
        "ignored": step.is_ignored(),
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

    /// The road is clear.
    clears_the_road(Kind::Local(EventKind::RoadClear)) |step| {
        "the road is clear": !step.is_ignored() && becomes(step, Role::Leader),
        "ends for the one that goes before": matches!(step.said.ended, Some(EndReason::Withdrawn(_))),
        "ignored": step.is_ignored(),
    }

    /// A larger boot counter has been persisted.
    renews_its_epoch(Kind::Local(EventKind::EpochRenewed)) |step| {
        "renews it": !step.is_ignored(),
        "ignored": step.is_ignored(),
    }
}
