//! A robot that asks for help or leads.

use super::{
    EventKind, Kind, Laws, OutputKind, Part, Phase, Role, TimerKind, any_step, runs, settles,
    shows_go, stage,
};

steps! {
    @each {
        asks_and_hears_a_request(Requester, Kind::RamNeedHelp);
        asks_and_hears_a_leader(Requester, Kind::RamLeader);
        asks_and_hears_a_follower(Requester, Kind::RamFollower);
        loses_an_offer(Requester, Kind::Fires(TimerKind::Offer));
        must_unlock_as_it_asks(Requester, Kind::Fires(TimerKind::IdentityLock));
        ends_a_farewell_as_it_asks(Requester, Kind::Fires(TimerKind::Farewell));
        needs_no_help(Requester, Kind::Local(EventKind::TaskCompleted));
        leaves_as_it_asks(Requester, Kind::Local(EventKind::LeaveRequested));
        changes_its_availability_as_it_asks(Requester, Kind::Local(EventKind::AvailabilityChanged));
        renews_its_epoch_as_it_asks(Requester, Kind::Local(EventKind::EpochRenewed));
        leads_and_hears_a_request(Leader, Kind::RamNeedHelp);
        leads_and_hears_an_offer(Leader, Kind::RamOfferHelp);
        ends_a_farewell(Leader, Kind::Fires(TimerKind::Farewell));
        clears_the_road(Leader, Kind::Local(EventKind::RoadClear));
        changes_its_availability(Leader, Kind::Local(EventKind::AvailabilityChanged));
        closes_the_corridor(Leader, Kind::Local(EventKind::CloseCorridor));
        renews_its_epoch(Leader, Kind::Local(EventKind::EpochRenewed));
    }
    @others {
        shows_go_as_it_opens_the_corridor => shows_go(Kind::Local(EventKind::OpenCorridor), OutputKind::CorridorOpened);
        shows_go_as_it_hears_a_follower => shows_go(Kind::RamFollower, OutputKind::CorridorExtended);
        runs_as_it_asks => runs(Role::Requester);
        runs_as_it_leads => runs(Role::Leader);
        settles_as_it_asks => settles(Role::Requester, Kind::Local(EventKind::PedestrianDetected));
        settles_as_it_leads => settles(Role::Leader, Kind::Local(EventKind::AllAnswered));
    }

    /// It is offered help.
    hears_an_offer(Requester, Kind::RamOfferHelp) |kept| {
        "takes it": kept.was.offered && kept.before != kept.after,
        "does not": !kept.was.offered && kept.before == kept.after,
    }

    /// A helper takes its offer back.
    hears_a_farewell_of_a_helper(Requester, Kind::RamNone) |kept| {
        "forgets it": kept.before != kept.after,
    }

    /// It chooses its followers.
    selects(Requester, Kind::Local(EventKind::AllAnswered)) |kept| {
        "lists it": kept.was.listed.is_none() && kept.now.listed.is_some(),
        "lists others": matches!(kept.after.phase(), Phase::Leading(_)) && kept.now.listed.is_none(),
    }

    /// A follower answers.
    hears_an_answer(Leader, Kind::Answer) |kept| {
        "counts it": kept.was.accepted && kept.before != kept.after,
        "is refused": kept.was.refused && kept.before != kept.after,
        "does not": kept.before == kept.after,
    }

    /// A follower reports: facts.
    hears_a_follower(Leader, Kind::RamFollower, Facts) |kept| {
        "counts it as joined": kept.was.joined && kept.before != kept.after,
        "is of another": !kept.was.joined && kept.before != kept.after,
    }

    /// A follower reports: heartbeats and leases.
    hears_an_echo(Leader, Kind::RamFollower, Heartbeats) |kept| {
        "counts it as joined": kept.was.joined && kept.before != kept.after,
        "is of another": !kept.was.joined && kept.before != kept.after,
    }

    /// A follower leaves: facts.
    hears_a_farewell(Leader, Kind::RamNone, Facts) |kept| {
        "drops it": !kept.was.dropped && kept.now.dropped,
        "drops another": kept.before != kept.after && !kept.now.dropped,
    }

    /// A follower leaves: heartbeats and leases.
    counts_on_the_others(Leader, Kind::RamNone, Heartbeats) |kept| {
        "drops it": !kept.was.dropped && kept.now.dropped,
        "drops another": kept.before != kept.after && !kept.now.dropped,
    }

    /// It commands: facts.
    commands(Leader, Kind::Local(EventKind::CommandManeuver), Facts) |kept| {
        "commands it": kept.was.commanded.is_none() && kept.now.commanded.is_some(),
        "commands something else": !kept.changed() && kept.before != kept.after,
    }

    /// It commands: heartbeats and leases.
    commands_within_leases(Leader, Kind::Local(EventKind::CommandManeuver), Heartbeats) |kept| {
        "commands it": kept.was.commanded.is_none() && kept.now.commanded.is_some(),
        "commands something else": !kept.changed() && kept.before != kept.after,
    }

    /// It repeats a command or drops the follower.
    repeats_a_command(Leader, Kind::Fires(TimerKind::Acknowledgement)) |kept| {
        "repeats": !kept.now.dropped && kept.before != kept.after,
        "drops it": !kept.was.dropped && kept.now.dropped,
    }

    /// It loses a follower.
    loses_a_follower(Leader, Kind::Fires(TimerKind::Lost)) |kept| {
        "drops it": !kept.was.dropped && kept.now.dropped,
        "drops another": kept.before != kept.after && !kept.now.dropped,
    }

    /// A command takes too long.
    gives_a_command_up(Leader, Kind::Fires(TimerKind::Execution)) |kept| {
        "gives it up": kept.was.accepted,
    }

    /// It has had time to choose.
    has_chosen(Requester, Kind::Fires(TimerKind::Selection)) |kept| {
        "lists it": kept.was.listed.is_none() && kept.now.listed.is_some(),
    }

    /// Nobody helps.
    finds_no_help(Requester, Kind::Fires(TimerKind::Help)) |kept| {
        "ends it": !kept.was.ended && kept.now.ended,
    }

    /// A lease ends.
    ends_a_lease(Leader, Kind::Fires(TimerKind::Lease)) |kept| {
        "of a follower": kept.was.joined && kept.before != kept.after,
    }

    /// The identity cannot be locked any longer.
    must_unlock(Leader, Kind::Fires(TimerKind::IdentityLock)) |kept| {
        "ends it": !kept.was.ended && kept.now.ended,
    }

    /// It tells that it asks for help.
    beats_as_it_asks(Requester, Kind::Fires(TimerKind::Ram)) |kept| {
        "beats it": !kept.was.beaten && kept.now.beaten,
    }

    /// It tells that it leads: facts.
    tells_that_it_leads(Leader, Kind::Fires(TimerKind::Ram), Facts) |kept| {
        "beats it": !kept.was.beaten && kept.now.beaten,
    }

    /// It tells that it leads: heartbeats.
    beats(Leader, Kind::Fires(TimerKind::Ram), Heartbeats) |kept| {
        "beats it": !kept.was.beaten && kept.now.beaten,
    }

    /// It opens the corridor.
    opens_the_corridor(Leader, Kind::Local(EventKind::OpenCorridor)) |kept| {
        "counts on it": kept.was.accepted && kept.before != kept.after,
    }

    /// It hears another leader at its place.
    hears_a_rival(Leader, Kind::RamLeader) |kept| {
        "gives way": !kept.was.ended && kept.now.ended,
        "goes on": kept.before != kept.after && !kept.now.ended,
    }

    /// It is to leave.
    leaves(Leader, Kind::Local(EventKind::LeaveRequested)) |kept| {
        "ends it": !kept.was.ended && kept.now.ended,
    }

    /// It completes the task.
    completes_the_task(Leader, Kind::Local(EventKind::TaskCompleted)) |kept| {
        "ends it": !kept.was.ended && kept.now.ended,
        "ends another": kept.was.ended,
    }
}
