//! Events of a run, in a few words.

use crossguard_codec::{Heard, Kind, SignalsShown};
use crossguard_protocol::{Event, Input, Notice, Output};
use crossguard_robot::around::{Around, OfKind};
use crossguard_robot::sight::{SeenVehicle, Sight};
use crossguard_robot::zone::Conduct;

/// A slower vehicle stands.
const STANDING_MPS: f64 = 0.5;

/// A message in a few words: what it says to the protocol, where its commands take place, and what its sender
/// shows to people.
#[must_use]
pub fn text_of(heard: &Heard) -> String {
    let shown = shown(heard).filter(SignalsShown::is_anything);
    let shown = shown.map(|shown| format!(", shows {shown}"));
    said_in(heard) + &shown.unwrap_or_default()
}

/// The same, without what its sender shows to people.
pub(super) fn said_in(heard: &Heard) -> String {
    let inputs: Vec<_> = heard.inputs.iter().map(|it| format!("{it:#}")).collect();
    let place = heard.map_place.map(|place| format!(" at {place}"));
    inputs.join("; ") + &place.unwrap_or_default()
}

fn shown(heard: &Heard) -> Option<SignalsShown> {
    heard.state.as_ref()?.slow.as_ref()?.signals
}

/// Text for a robot that shows nothing to people.
pub(super) const SHOWS_NOTHING: &str = "~ shows nothing to people";

/// Text of the signal to people in a RAM, if it has one.
pub(super) fn shown_in(heard: &Heard) -> Option<String> {
    let shown = shown(heard)?;
    Some(if shown.is_anything() {
        format!("~ shows {shown}")
    } else {
        SHOWS_NOTHING.to_owned()
    })
}

/// The people at a crossing, by what a robot's sensors have, and the vehicles that move.
pub(super) fn people(sight: &Sight) -> String {
    let is_moving = |it: &&SeenVehicle| it.velocity.is_none_or(|[x, y]| x.hypot(y) > STANDING_MPS);
    let vehicles = match sight.vehicles.iter().filter(is_moving).count() {
        0 => String::new(),
        1 => "; 1 vehicle moves".to_owned(),
        more => format!("; {more} vehicles move"),
    };
    let counts = [
        (sight.waiting(), "waiting"),
        (sight.on_road(), "on the road"),
        (sight.count(Conduct::Across), "across"),
    ];
    let counts = counts.into_iter().filter(|(count, _)| *count > 0);
    let counts: Vec<_> = counts
        .map(|(count, what)| format!("{count} {what}"))
        .collect();
    if counts.is_empty() {
        return format!("~ people: nobody at the crossing{vehicles}");
    }
    format!("~ people: {}{vehicles}", counts.join(", "))
}

/// The road users that a robot hears, without robots and without what changes all the time.
pub(super) fn road_users(around: &Around) -> String {
    let others = around.kinds.iter().filter(|it| it.kind != Kind::Robot);
    let others: Vec<_> = others.map(OfKind::counted).collect();
    if others.is_empty() {
        return "~ hears no road users".to_owned();
    }
    format!("~ hears {}", others.join(", "))
}

pub(super) fn note_of_input(input: &Input) -> Option<String> {
    match input {
        Input::Local(Event::OpenCorridor | Event::CommandManeuver { .. } | Event::AllAnswered) => {
            None
        }
        Input::Local(event) => Some(format!("* {event}")),
        _ => None,
    }
}

pub(super) fn note_of_output(output: &Output) -> Option<String> {
    Some(match output {
        Output::StartManeuver(_)
        | Output::StopManeuver(..)
        | Output::FallBack(..)
        | Output::CorridorOpened(_)
        | Output::CorridorClosed(_)
        | Output::RenewEpoch => format!("> {output}"),
        Output::Notify(
            notice @ (Notice::FollowerGone(..)
            | Notice::LeaseExpired(_)
            | Notice::CommandRejected(..)
            | Notice::ManeuverInPosition(..)
            | Notice::OfferLapsed(_)
            | Notice::Yielded(_)
            | Notice::ManeuverFailed(..)
            | Notice::ManeuverCompleted(..)
            | Notice::FollowerSafeIdle(..)
            | Notice::SessionEnded(..)
            | Notice::Released(..)
            | Notice::ContactLost(_)
            | Notice::ContactRegained(_)),
        ) => format!("- {notice}"),
        _ => return None,
    })
}
