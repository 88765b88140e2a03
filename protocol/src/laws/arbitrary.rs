//! Arbitrary configurations, states and inputs: everything that the types can hold.
//!
//! Nothing here makes a value valid; [`Robot::is_valid`](crate::Robot::is_valid) and [`config`]'s premise do that. Hints let
//! a random source build values that go together: the robot is station [`ME`], in its first boot.

mod exchange;
mod input;
mod message;
mod state;

use super::Source;
use crate::config::{Config, Settings};
use crate::id::{
    Heartbeat, ManeuverId, OfferNumber, RequestId, SessionId, SessionNumber, StationId,
    UniqueNumber,
};
use crate::list::List;
use crate::message::Rmcm;
use crate::output::Maneuver;
use crate::task::{
    Availability, FallbackPolicy, HelpRequest, Place, TaskSet, TaskType, Unavailability, Urgency,
};
use crate::time::Millis;

pub use exchange::{Part, exchange, history};
pub use input::{Kind, event, input};
pub use message::{answer, command, ram};
pub use state::{Peers, robot, valid_robot};

/// The station id that hints give the robot.
pub const ME: u32 = 1;
/// The station id that hints give its first peer; the others follow.
pub const PEER: u32 = 2;
/// The boot counter that hints give.
const BOOT: u16 = 1;
/// The heartbeat that hints give.
const HEARTBEAT: u16 = 3;
/// One that was heard before.
const EARLIER: u16 = HEARTBEAT - 1;
/// The place that hints give.
const PLACE: u32 = 7;
/// The request number that hints give.
const REQUEST: u8 = 1;

/// A type of which there is any value.
pub trait Any: Sized {
    /// Any value.
    fn any(source: &mut impl Source) -> Self;
}

/// An enumeration of [words](crate::words): any word, with anything that comes with it.
pub trait AnyWord: Sized {
    /// Its words alone.
    type Kind;
    /// How many there are.
    const COUNT: usize;

    /// Any value of this word.
    fn any_of(kind: Self::Kind, source: &mut impl Source) -> Self;

    /// Any value of the word of this index. It compares rather than indexes: to a proof, an index that is not
    /// known is all of the table.
    fn nth(index: u32, source: &mut impl Source) -> Self;

    /// Any value; of the word of the index `hint` where that is more interesting.
    fn any_like(source: &mut impl Source, hint: u32) -> Self {
        let last = u32::try_from(Self::COUNT - 1).unwrap_or(0);
        let index = source.number(last, hint);
        Self::nth(index, source)
    }
}

impl<T: AnyWord> Any for T {
    fn any(source: &mut impl Source) -> Self {
        Self::any_like(source, u32::MAX)
    }
}

/// Says what any value is of what comes with words; hints are those for a message or event.
macro_rules! any {
    ($($type:ty = |$source:ident| $any:expr;)+) => {$(
        impl Any for $type {
            fn any($source: &mut impl Source) -> Self {
                $any
            }
        }
    )+};
}

any! {
    // A boot counter.
    u16 = |source| source.u16(BOOT + 1);
    StationId = |source| station(source, PEER);
    SessionId = |source| session(source, PEER);
    ManeuverId = |source| maneuver_id(source);
    Option<UniqueNumber> = |source| option(source, number);
    TaskType = |source| task(source);
    HelpRequest = |source| help_request(source);
    Availability = |source| availability(source);
    Millis = |source| Self(source.number(u32::MAX, 100));
    Maneuver = |source| Self { id: maneuver_id(source), task: task(source) };
    Rmcm = |source| if source.flag() {
        Self::Command(command(source))
    } else {
        Self::Answer(answer(source))
    };
}

/// A configuration in which every timer is within its range, so are the repeats and the drift, and a
/// farewell fits under the identity lock. The other inequalities may be broken: a law that holds here holds for every [`Config`].
///
/// `None` where the farewell does not fit. All ranges hold by construction: to check them would be a loop.
pub fn config(source: &mut impl Source) -> Option<Config> {
    let hints = Settings::default();
    let delay_max = Millis(source.number(Millis::MAX_TIMER.0, hints.delay_max.0));
    let mut time = |hint: Millis| self::time(source, hint);
    let settings = Settings {
        ram_period: time(hints.ram_period),
        t_select: time(hints.t_select),
        t_offer: time(hints.t_offer),
        t_help: time(hints.t_help),
        t_ack: time(hints.t_ack),
        t_safety: time(hints.t_safety),
        t_lease: time(hints.t_lease),
        t_leave: time(hints.t_leave),
        t_farewell: time(hints.t_farewell),
        t_lock: time(hints.t_lock),
        t_cross: time(hints.t_cross),
        delay_max,
        t_exec: of_each_task(|task| time(hints.t_exec[task])),
        n_ack: repeats(source, hints.n_ack),
        drift_ppm: source.number(99_999, hints.drift_ppm),
        capabilities: task_set(source),
        guarding: task_set(source),
        holding: task_set(source),
        fallback: of_each_task(|_| FallbackPolicy::any(source)),
        first_request: RequestId(source.u8(REQUEST)),
        first_heartbeat: Heartbeat(source.u16(0)),
    };
    // Part of `LockOutlastsTask`.
    let fits = settings.t_farewell < settings.t_lock;
    fits.then(|| Config::unchecked(settings))
}

/// Something of each of the 16 types of task. To a proof, a loop over them would be to unwind every loop as often.
#[rustfmt::skip]
fn of_each_task<T>(mut of: impl FnMut(usize) -> T) -> [T; 16] {
    [
        of(0), of(1), of(2), of(3), of(4), of(5), of(6), of(7),
        of(8), of(9), of(10), of(11), of(12), of(13), of(14), of(15),
    ]
}

/// From 1 ms to the longest time of a timer.
fn time(source: &mut impl Source, hint: Millis) -> Millis {
    Millis(1 + source.number(Millis::MAX_TIMER.0 - 1, hint.0 - 1))
}

/// From 1 to 15.
fn repeats(source: &mut impl Source, hint: u8) -> u8 {
    u8::try_from(1 + source.number(14, u32::from(hint) - 1)).unwrap_or(1)
}

/// One of `choices` alternatives, counted from 0.
fn choice(source: &mut impl Source, choices: u32) -> u32 {
    source.number(choices - 1, choices)
}

/// A value, or none.
fn option<S: Source, T>(source: &mut S, value: impl FnOnce(&mut S) -> T) -> Option<T> {
    likely(source, None, value)
}

/// A value, or none, which the hint says to be more interesting.
fn likely<S: Source, T>(
    source: &mut S,
    hint: Option<bool>,
    value: impl FnOnce(&mut S) -> T,
) -> Option<T> {
    source.likely(hint).then(|| value(source))
}

/// A list of `least` to `most` items, without gaps.
fn list<S: Source, T: Copy, const N: usize>(
    source: &mut S,
    (least, most): (usize, usize),
    item: impl Fn(&mut S, u32) -> T,
) -> List<T, N> {
    let mut items = [None; N];
    let mut goes_on = true;
    let mut i = 0;
    while i < most {
        let hint = u32::try_from(i).unwrap_or(0);
        if i >= least {
            goes_on &= source.likely((i == 0).then_some(true));
        }
        if goes_on {
            items[i] = Some(item(source, hint));
        }
        i += 1;
    }
    List::of_slots(items)
}

fn station(source: &mut impl Source, hint: u32) -> StationId {
    StationId(source.number(u32::MAX, hint))
}

fn number(source: &mut impl Source) -> UniqueNumber {
    UniqueNumber {
        boot: source.u16(BOOT),
        count: source.u16(0),
    }
}

fn session(source: &mut impl Source, leader: u32) -> SessionId {
    SessionId::of(station(source, leader), session_number(source))
}

fn session_number(source: &mut impl Source) -> SessionNumber {
    SessionNumber(number(source))
}

fn offer_number(source: &mut impl Source) -> OfferNumber {
    OfferNumber(number(source))
}

fn heartbeat(source: &mut impl Source) -> Heartbeat {
    Heartbeat(source.u16(HEARTBEAT))
}

fn earlier_heartbeat(source: &mut impl Source) -> Heartbeat {
    Heartbeat(source.u16(EARLIER))
}

fn request_id(source: &mut impl Source) -> RequestId {
    RequestId(source.u8(REQUEST))
}

fn maneuver_id(source: &mut impl Source) -> ManeuverId {
    ManeuverId::of(session(source, PEER), request_id(source))
}

fn task(source: &mut impl Source) -> TaskType {
    task_like(source, u32::MAX)
}

fn task_like(source: &mut impl Source, hint: u32) -> TaskType {
    // There are 16 task types, so the default is never taken.
    u8::try_from(source.number(15, hint))
        .ok()
        .and_then(TaskType::new)
        .unwrap_or(TaskType::MOVE)
}

/// Any task. A hint lets a command be for what the robot fell back from.
fn escort(source: &mut impl Source) -> TaskType {
    task_like(source, u32::from(TaskType::MOVE.value()))
}

fn task_set(source: &mut impl Source) -> TaskSet {
    TaskSet(source.u16(0b111))
}

fn help_request(source: &mut impl Source) -> HelpRequest {
    HelpRequest {
        urgency: Urgency::any(source),
        followers: source.u8(3),
        tasks: task_set(source),
        place: place(source),
    }
}

fn place(source: &mut impl Source) -> Place {
    // Now and then one that nobody knows.
    let is_known = source.likely(Some(true));
    let hint = if is_known { PLACE } else { Place::UNKNOWN.0 };
    Place(source.number(u32::MAX, hint))
}

/// Any availability.
pub fn availability(source: &mut impl Source) -> Availability {
    match source.number(1, 0) {
        0 => Availability::Available,
        _ => Availability::Unavailable(Unavailability::any(source)),
    }
}
