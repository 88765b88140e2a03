//! Arbitrary inputs, by kind.

use super::{
    BOOT, ME, PEER, Source, answer, availability, choice, command, help_request, maneuver_id,
    number, option, ram, station, task,
};
use crate::input::{Decimetres, Event, Input, Timer};
use crate::message::Rmcm;
use crate::time::Millis;

/// The kinds of inputs, one for each way through the transition function.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Kind {
    /// A RAM of a robot without a part in a session.
    RamNone,
    /// A RAM that asks for help.
    RamNeedHelp,
    /// A RAM that offers help.
    RamOfferHelp,
    /// A RAM of a leader.
    RamLeader,
    /// A RAM of a follower.
    RamFollower,
    /// A command.
    Command,
    /// An answer to a command.
    Answer,
    /// Elapsed time.
    Elapsed,
    /// The expiry of any timer.
    Expired,
    /// The expiry of such a timer.
    Fires(TimerKind),
    /// An event of the application.
    Local(Happening),
}

/// The kinds of events.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Happening {
    /// [`Event::PedestrianDetected`].
    PedestrianDetected,
    /// [`Event::CommandManeuver`].
    CommandManeuver,
    /// [`Event::InPosition`].
    InPosition,
    /// [`Event::ManeuverCompleted`].
    ManeuverCompleted,
    /// [`Event::ManeuverFailed`].
    ManeuverFailed,
    /// [`Event::TaskCompleted`].
    TaskCompleted,
    /// [`Event::RoadClear`].
    RoadClear,
    /// [`Event::AllAnswered`].
    AllAnswered,
    /// [`Event::LeaveRequested`].
    LeaveRequested,
    /// [`Event::AvailabilityChanged`].
    AvailabilityChanged,
    /// [`Event::OpenCorridor`].
    OpenCorridor,
    /// [`Event::CloseCorridor`].
    CloseCorridor,
    /// [`Event::IdentityChanged`].
    IdentityChanged,
    /// [`Event::EpochRenewed`].
    EpochRenewed,
}

/// The kinds of timers.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[allow(missing_docs, reason = "each is the timer of that name")]
pub enum TimerKind {
    Safety,
    Leave,
    Lease,
    Lost,
    Execution,
    Acknowledgement,
    Offer,
    Help,
    Selection,
    Reservation,
    IdentityLock,
    Farewell,
    Ram,
}

impl TimerKind {
    /// All of them.
    pub const ALL: [Self; 13] = [
        Self::Safety,
        Self::Leave,
        Self::Lease,
        Self::Lost,
        Self::Execution,
        Self::Acknowledgement,
        Self::Offer,
        Self::Help,
        Self::Selection,
        Self::Reservation,
        Self::IdentityLock,
        Self::Farewell,
        Self::Ram,
    ];

    /// Any timer of this kind.
    pub fn timer(self, source: &mut impl Source) -> Timer {
        match self {
            Self::Safety => Timer::Safety,
            Self::Leave => Timer::Leave,
            Self::Lease => Timer::Lease(station(source, PEER)),
            Self::Lost => Timer::Lost(station(source, PEER)),
            Self::Execution => Timer::Execution(station(source, PEER)),
            Self::Acknowledgement => Timer::Acknowledgement(station(source, PEER)),
            Self::Offer => Timer::Offer(station(source, PEER)),
            Self::Help => Timer::Help,
            Self::Selection => Timer::Selection,
            Self::Reservation => Timer::Reservation,
            Self::IdentityLock => Timer::IdentityLock,
            Self::Farewell => Timer::Farewell,
            Self::Ram => Timer::Ram,
        }
    }
}

impl Kind {
    /// All events.
    pub const EVENTS: [Self; 14] = [
        Self::Local(Happening::PedestrianDetected),
        Self::Local(Happening::CommandManeuver),
        Self::Local(Happening::InPosition),
        Self::Local(Happening::ManeuverCompleted),
        Self::Local(Happening::ManeuverFailed),
        Self::Local(Happening::TaskCompleted),
        Self::Local(Happening::RoadClear),
        Self::Local(Happening::AllAnswered),
        Self::Local(Happening::LeaveRequested),
        Self::Local(Happening::AvailabilityChanged),
        Self::Local(Happening::OpenCorridor),
        Self::Local(Happening::CloseCorridor),
        Self::Local(Happening::IdentityChanged),
        Self::Local(Happening::EpochRenewed),
    ];
}

/// Any input of this kind. With `farewells` a RAM may name a session as over.
pub fn input(source: &mut impl Source, kind: Kind, farewells: bool) -> Input {
    let part = match kind {
        Kind::RamNone => 0,
        Kind::RamNeedHelp => 1,
        Kind::RamOfferHelp => 2,
        Kind::RamLeader => 3,
        Kind::RamFollower => 4,
        Kind::Command => return Input::Rmcm(Rmcm::Command(command(source))),
        Kind::Answer => return Input::Rmcm(Rmcm::Answer(answer(source))),
        Kind::Elapsed => return Input::Elapsed(Millis(source.number(u32::MAX, 100))),
        Kind::Expired => return Input::Expired(timer(source)),
        Kind::Fires(countdown) => return Input::Expired(countdown.timer(source)),
        Kind::Local(happening) => return Input::Local(event(source, happening)),
    };
    Input::Ram {
        ram: ram(source, part, farewells),
        distance: Decimetres(source.u16(40)),
    }
}

/// Any event of this kind.
pub fn event(source: &mut impl Source, happening: Happening) -> Event {
    match happening {
        Happening::PedestrianDetected => Event::PedestrianDetected(help_request(source)),
        Happening::CommandManeuver => Event::CommandManeuver {
            follower: station(source, PEER),
            task: task(source),
        },
        Happening::InPosition => Event::InPosition(maneuver_id(source)),
        Happening::ManeuverCompleted => Event::ManeuverCompleted(maneuver_id(source)),
        Happening::ManeuverFailed => Event::ManeuverFailed(maneuver_id(source)),
        Happening::TaskCompleted => Event::TaskCompleted,
        Happening::RoadClear => Event::RoadClear,
        Happening::AllAnswered => Event::AllAnswered,
        Happening::LeaveRequested => Event::LeaveRequested,
        Happening::AvailabilityChanged => Event::AvailabilityChanged(availability(source)),
        Happening::OpenCorridor => Event::OpenCorridor,
        Happening::CloseCorridor => Event::CloseCorridor,
        Happening::IdentityChanged => {
            Event::IdentityChanged(station(source, ME), option(source, number))
        }
        Happening::EpochRenewed => Event::EpochRenewed(source.u16(BOOT + 1)),
    }
}

/// Any timer.
pub fn timer(source: &mut impl Source) -> Timer {
    TimerKind::ALL[choice(source, 13) as usize].timer(source)
}
