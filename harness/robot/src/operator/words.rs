//! Words in a line, and what they can be.

use std::borrow::Cow;
use std::fmt::Display;
use std::time::Duration;

use crate::robot_file::job_named;
use crossguard_codec::{JobRole, MapPlace, PublicSignal, SignalMeans};
use crossguard_protocol::{
    Event, EventKind, State, TaskNames, TaskSet, TaskType, Unavailability, Urgency,
};

use super::Misunderstood;

pub(super) const SEGMENT: &str = "segment";
pub(super) const INTERSECTION: &str = "intersection";
pub(super) const NONE: &str = "none";
pub(super) const CHARGING: &str = "charging";

const MEANS: [(&str, SignalMeans); 4] = [
    ("gesture", SignalMeans::GESTURE),
    ("display", SignalMeans::DISPLAY),
    ("lights", SignalMeans::LIGHTS),
    ("speech", SignalMeans::SPEECH),
];

const SIGNALS: [PublicSignal; 4] = [
    PublicSignal::None,
    PublicSignal::Stop,
    PublicSignal::Go,
    PublicSignal::Caution,
];

fn tasks() -> impl Iterator<Item = TaskType> {
    TaskSet(u16::MAX).iter()
}

/// Name of a value in a line: its display text, in one word.
fn name_of(value: impl Display) -> String {
    value.to_string().replace(' ', "-")
}

/// An event that comes with nothing, and is not for the kit alone.
pub(super) fn event_of(name: &str) -> Option<Event> {
    let event = EventKind::named(name).and_then(Event::bare);
    event.filter(|event| super::port::order_of(*event).is_ok())
}

pub(super) fn event_names() -> Vec<&'static str> {
    let names = EventKind::ALL.iter().map(|kind| kind.name());
    names.filter(|name| event_of(name).is_some()).collect()
}

pub(super) fn wrong(word: &str, wanted: impl Into<Cow<'static, str>>) -> Misunderstood {
    Misunderstood::Word {
        word: word.to_owned(),
        wanted: wanted.into(),
    }
}

/// A command that takes no words was given none.
pub(super) fn nothing(words: &[&str]) -> Result<(), Misunderstood> {
    words.last().map_or(Ok(()), |last| Err(surplus(last)))
}

/// The only word of a command.
pub(super) fn only<'a>(
    words: &[&'a str],
    command: &'static str,
    wanted: &'static str,
) -> Result<&'a str, Misunderstood> {
    match words {
        [] => Err(Misunderstood::Missing { command, wanted }),
        [word] => Ok(word),
        [.., last] => Err(surplus(last)),
    }
}

pub(super) fn surplus(word: &str) -> Misunderstood {
    Misunderstood::Surplus(word.to_owned())
}

pub(super) fn number(word: &str) -> Option<f64> {
    word.parse().ok().filter(|number: &f64| number.is_finite())
}

pub(super) fn seconds(word: &str) -> Result<Duration, Misunderstood> {
    let seconds = number(word).filter(|seconds| (0.0..=86_400.0).contains(seconds));
    seconds
        .map(Duration::from_secs_f64)
        .ok_or_else(|| wrong(word, "a number of seconds up to a day"))
}

pub(super) fn task(name: &str) -> Result<TaskType, Misunderstood> {
    let task = tasks().find(|task| task.to_string() == name);
    task.ok_or_else(|| wrong(name, format!("a task: {TaskNames}")))
}

pub(super) fn urgency(name: &str) -> Option<Urgency> {
    Urgency::named(name)
}

pub(super) fn unavailability(name: &str) -> Result<Unavailability, Misunderstood> {
    let mut all = Unavailability::ALL.into_iter();
    all.find(|reason| name_of(reason) == name)
        .ok_or_else(|| wrong(name, "a reason to be unavailable; see 'help'"))
}

pub(super) fn state(name: &str) -> Result<State, Misunderstood> {
    let mut all = State::ALL.into_iter();
    all.find(|state| name_of(state) == name)
        .ok_or_else(|| wrong(name, "a state; see 'help'"))
}

pub(super) fn job(name: &str) -> Result<JobRole, Misunderstood> {
    job_named(name).ok_or_else(|| wrong(name, "a job; see 'help'"))
}

pub(super) fn signal(name: &str) -> Option<PublicSignal> {
    let mut all = SIGNALS.into_iter();
    all.find(|signal| signal.to_string() == name)
}

pub(crate) fn means(name: &str) -> Result<SignalMeans, Misunderstood> {
    let means = MEANS.into_iter().find(|(it, _)| *it == name);
    means
        .map(|(_, means)| means)
        .ok_or_else(|| wrong(name, "gesture, display, lights or speech"))
}

/// Form of a place of the map.
pub(super) const MAP_PLACE: &str =
    "a road segment or intersection, like 'segment 276:12' or 'intersection 4711'";

pub(super) fn map_place(kind: &str, reference: &str) -> Result<MapPlace, Misunderstood> {
    let text = format!("{kind} {reference}");
    text.parse().map_err(|_| wrong(&text, MAP_PLACE))
}
