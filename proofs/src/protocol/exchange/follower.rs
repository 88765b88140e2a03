//! A robot that is the follower of the exchange.

use super::{
    Happening, Kind, Laws, Part, Phase, Stage, TimerKind, any_firing, any_step, harnesses, kani,
    stage,
};

steps! { Follower;
    /// It is asked for help.
    hears_a_request(Idle, Kind::RamNeedHelp) |kept| {
        "makes the offer": !kept.was.offered && kept.now.offered,
        "makes another": !kept.now.offered && kept.before != kept.after,
    }

    /// It hears which helpers follow.
    is_chosen(Offering, Kind::RamLeader) |kept| {
        "joins": !kept.was.joined && kept.now.joined,
        "joins another session": !kept.now.joined && matches!(kept.after.phase(), Phase::Following(_)),
        "is not listed": matches!(kept.after.phase(), Phase::Idle),
    }

    /// The session ends before it is chosen.
    takes_its_offer_back(Offering, Kind::RamNone) |kept| {
        "takes it back": kept.before != kept.after,
    }

    /// It hears its leader.
    hears_a_leader(Following, Kind::RamLeader) |kept| {
        "leaves": !kept.was.left && kept.now.left,
        "stays": kept.was.joined && !kept.now.left && kept.before != kept.after,
    }

    /// It is commanded.
    hears_a_command(Following, Kind::Command) |kept| {
        "starts it": !kept.was.started && kept.now.started,
        "refuses it": !kept.was.refused && kept.now.refused,
        "starts a newer one": !kept.was.newer_started && kept.now.newer_started,
        "stops it for another": !kept.was.over && kept.now.over,
        "answers again": kept.was.accepted && kept.before == kept.after,
    }

    /// Its body holds its place.
    reaches_its_position(Following, Kind::Local(Happening::InPosition)) |kept| {
        "reaches it": !kept.was.in_position && kept.now.in_position,
        "another": !kept.changed() && kept.before != kept.after,
    }

    /// Its body has done what was commanded.
    completes_a_maneuver(Following, Kind::Local(Happening::ManeuverCompleted)) |kept| {
        "completes it": !kept.was.completed && kept.now.completed && kept.now.over,
        "another": !kept.changed() && kept.before != kept.after,
    }

    /// Its body fails.
    fails_a_maneuver(Following, Kind::Local(Happening::ManeuverFailed)) |kept| {
        "fails at it": !kept.was.over && kept.now.over,
    }

    /// It does not hear its leader any more.
    falls_back(Following, Kind::Fires(TimerKind::Safety)) |kept| {
        "falls back": !kept.was.fell_back && kept.now.fell_back,
        "executes nothing": !kept.changed(),
    }

    /// It leaves a leader that is silent.
    leaves_the_silent(Following, Kind::Fires(TimerKind::Leave)) |kept| {
        "leaves": !kept.was.left && kept.now.left,
    }

    /// Its offer is over.
    is_not_chosen(Offering, Kind::Fires(TimerKind::Reservation)) |kept| {
        "gives it up": kept.was.offered && kept.before != kept.after,
    }

    /// The identity cannot be locked any longer.
    must_unlock(Following, Kind::Fires(TimerKind::IdentityLock)) |kept| {
        "leaves": !kept.was.left && kept.now.left,
        "falls back": !kept.was.fell_back && kept.now.fell_back,
    }

    /// It is told that the session ended.
    is_released(Following, Kind::RamNone) |kept| {
        "leaves": !kept.was.left && kept.now.left,
        "stops": !kept.was.over && kept.now.over && !kept.now.fell_back,
        "falls back": !kept.was.fell_back && kept.now.fell_back,
    }

    /// It is to leave.
    leaves(Following, Kind::Local(Happening::LeaveRequested)) |kept| {
        "leaves": !kept.was.left && kept.now.left,
        "falls back": !kept.was.fell_back && kept.now.fell_back,
    }

    /// It tells that it offers help.
    tells_its_offer(Offering, Kind::Fires(TimerKind::Ram)) |kept| {
        "tells it": kept.was.offered && !kept.was.joined,
    }

    /// It tells what it does.
    tells_what_it_does(Following, Kind::Fires(TimerKind::Ram)) |kept| {
        "tells of it": kept.was.accepted && !kept.was.over,
    }

    /// It becomes available or unavailable.
    changes_its_availability(Following, Kind::Local(Happening::AvailabilityChanged)) |kept| {
        "stops": !kept.was.over && kept.now.over,
        "leaves": !kept.was.left && kept.now.left,
    }
}
