//! Arbitrary inputs, by kind.

use super::{Any, AnyWord, ME, Source, answer, command, number, option, ram, station};
use crate::input::{Decimetres, Event, EventKind, Input, Timer, TimerKind};
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
    Local(EventKind),
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
        Kind::Elapsed => return Input::Elapsed(Millis::any(source)),
        Kind::Expired => return Input::Expired(Timer::any(source)),
        Kind::Fires(timer) => return Input::Expired(Timer::any_of(timer, source)),
        Kind::Local(event) => return Input::Local(self::event(source, event)),
    };
    Input::Ram {
        ram: ram(source, part, farewells),
        distance: Decimetres(source.u16(40)),
    }
}

/// Any event of this kind.
pub fn event(source: &mut impl Source, kind: EventKind) -> Event {
    match kind {
        // A hint that it is the robot's own station, as it was.
        EventKind::IdentityChanged => {
            Event::IdentityChanged(station(source, ME), option(source, number))
        }
        _ => Event::any_of(kind, source),
    }
}
