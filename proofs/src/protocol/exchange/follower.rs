//! A robot that helps or follows, or has no part in a session yet.

use super::{EventKind, Kind, Laws, Part, Phase, Role, TimerKind, any_step, runs, settles, stage};

steps! {
    @each {
        hears_an_offer(None, Kind::RamOfferHelp);
        hears_of_a_leader(None, Kind::RamLeader);
        hears_of_a_follower(None, Kind::RamFollower);
        unlocks(None, Kind::Fires(TimerKind::IdentityLock));
        ends_a_farewell(None, Kind::Fires(TimerKind::Farewell));
        tells_a_farewell(None, Kind::Fires(TimerKind::Ram));
        clears_the_road(None, Kind::Local(EventKind::RoadClear));
        becomes_available(None, Kind::Local(EventKind::AvailabilityChanged));
        renews_its_epoch(None, Kind::Local(EventKind::EpochRenewed));
        helps_and_hears_a_request(Helper, Kind::RamNeedHelp);
        helps_and_hears_an_offer(Helper, Kind::RamOfferHelp);
        helps_and_hears_a_follower(Helper, Kind::RamFollower);
        must_unlock_as_it_helps(Helper, Kind::Fires(TimerKind::IdentityLock));
        ends_a_farewell_as_it_helps(Helper, Kind::Fires(TimerKind::Farewell));
        leaves_as_it_helps(Helper, Kind::Local(EventKind::LeaveRequested));
        changes_its_availability_as_it_helps(Helper, Kind::Local(EventKind::AvailabilityChanged));
        renews_its_epoch_as_it_helps(Helper, Kind::Local(EventKind::EpochRenewed));
        follows_and_hears_a_request(Follower, Kind::RamNeedHelp);
        follows_and_hears_an_offer(Follower, Kind::RamOfferHelp);
        follows_and_hears_a_follower(Follower, Kind::RamFollower);
        ends_a_farewell_as_it_follows(Follower, Kind::Fires(TimerKind::Farewell));
        clears_the_road_as_it_follows(Follower, Kind::Local(EventKind::RoadClear));
        renews_its_epoch_as_it_follows(Follower, Kind::Local(EventKind::EpochRenewed));
        leaves_its_position(Follower, Kind::Local(EventKind::OutOfPosition));
        sees_a_person(Follower, Kind::Local(EventKind::PersonOnRoad));
    }
    @others {
        runs_without_a_part => runs(Role::None);
        runs_as_it_helps => runs(Role::Helper);
        runs_as_it_follows => runs(Role::Follower);
        settles_without_a_part => settles(Role::None, Kind::Local(EventKind::AllAnswered));
        settles_as_it_helps => settles(Role::Helper, Kind::Local(EventKind::AllAnswered));
        settles_as_it_follows => settles(Role::Follower, Kind::Local(EventKind::AllAnswered));
    }

    /// It opens a session, which may be the watched one.
    detects_a_pedestrian(None, Kind::Local(EventKind::PedestrianDetected)) |kept| {
        "opens it": !kept.was.requested && kept.now.requested,
        "opens another": kept.was.ended && kept.before != kept.after,
    }

    /// It takes another station id, which may be that of the leader or the follower.
    takes_a_station(None, Kind::Local(EventKind::IdentityChanged)) |kept| {
        "the leader's": !kept.is(Part::Leader) && Part::Leader.is_of(&kept.exchange, &kept.after),
        "the follower's": !kept.is(Part::Follower) && Part::Follower.is_of(&kept.exchange, &kept.after),
        "neither": kept.before != kept.after && Part::Bystander.is_of(&kept.exchange, &kept.after),
    }

    /// It is asked for help.
    hears_a_request(None, Kind::RamNeedHelp) |kept| {
        "makes the offer": !kept.was.offered && kept.now.offered,
        "makes another": !kept.now.offered && kept.before != kept.after,
    }

    /// It hears which helpers follow.
    is_chosen(Helper, Kind::RamLeader) |kept| {
        "joins": !kept.was.joined && kept.now.joined,
        "joins another session": !kept.now.joined && matches!(kept.after.phase(), Phase::Following(_)),
        "is not listed": matches!(kept.after.phase(), Phase::Idle),
    }

    /// The session ends before it is chosen.
    takes_its_offer_back(Helper, Kind::RamNone) |kept| {
        "takes it back": kept.before != kept.after,
    }

    /// It hears its leader.
    hears_a_leader(Follower, Kind::RamLeader) |kept| {
        "leaves": !kept.was.left && kept.now.left,
        "stays": kept.was.joined && !kept.now.left && kept.before != kept.after,
    }

    /// It is commanded.
    hears_a_command(Follower, Kind::Command) |kept| {
        "starts it": !kept.was.started && kept.now.started,
        "refuses it": !kept.was.refused && kept.now.refused,
        "starts a newer one": !kept.was.newer_started && kept.now.newer_started,
        "stops it for another": !kept.was.over && kept.now.over,
        "answers again": kept.was.accepted && kept.before == kept.after,
    }

    /// Its body holds its place.
    reaches_its_position(Follower, Kind::Local(EventKind::InPosition)) |kept| {
        "reaches it": !kept.was.in_position && kept.now.in_position,
        "another": !kept.changed() && kept.before != kept.after,
    }

    /// Its body has done what was commanded.
    completes_a_maneuver(Follower, Kind::Local(EventKind::ManeuverCompleted)) |kept| {
        "completes it": !kept.was.completed && kept.now.completed && kept.now.over,
        "another": !kept.changed() && kept.before != kept.after,
    }

    /// Its body fails.
    fails_a_maneuver(Follower, Kind::Local(EventKind::ManeuverFailed)) |kept| {
        "fails at it": !kept.was.over && kept.now.over,
    }

    /// It does not hear its leader any more.
    falls_back(Follower, Kind::Fires(TimerKind::Safety)) |kept| {
        "falls back": !kept.was.fell_back && kept.now.fell_back,
        "executes nothing": !kept.changed(),
    }

    /// It leaves a leader that is silent.
    leaves_the_silent(Follower, Kind::Fires(TimerKind::Leave)) |kept| {
        "leaves": !kept.was.left && kept.now.left,
    }

    /// Its offer is over.
    is_not_chosen(Helper, Kind::Fires(TimerKind::Reservation)) |kept| {
        "gives it up": kept.was.offered && kept.before != kept.after,
    }

    /// The identity cannot be locked any longer.
    must_unlock(Follower, Kind::Fires(TimerKind::IdentityLock)) |kept| {
        "leaves": !kept.was.left && kept.now.left,
        "falls back": !kept.was.fell_back && kept.now.fell_back,
    }

    /// It is told that the session ended.
    is_released(Follower, Kind::RamNone) |kept| {
        "leaves": !kept.was.left && kept.now.left,
        "stops": !kept.was.over && kept.now.over && !kept.now.fell_back,
        "falls back": !kept.was.fell_back && kept.now.fell_back,
    }

    /// It is to leave.
    leaves(Follower, Kind::Local(EventKind::LeaveRequested)) |kept| {
        "leaves": !kept.was.left && kept.now.left,
        "falls back": !kept.was.fell_back && kept.now.fell_back,
    }

    /// It tells that it offers help.
    tells_its_offer(Helper, Kind::Fires(TimerKind::Ram)) |kept| {
        "tells it": kept.was.offered && !kept.was.joined,
    }

    /// It tells what it does.
    tells_what_it_does(Follower, Kind::Fires(TimerKind::Ram)) |kept| {
        "tells of it": kept.was.accepted && !kept.was.over,
    }

    /// It becomes available or unavailable.
    changes_its_availability(Follower, Kind::Local(EventKind::AvailabilityChanged)) |kept| {
        "stops": !kept.was.over && kept.now.over,
        "leaves": !kept.was.left && kept.now.left,
    }
}
