//! Rules on people, bodies and signs, judged from the ground truth alone, without a look into any machine.

use serde::Deserialize;
use stateright::Property;

use super::Watch;
use super::people::Cell;
use super::street::{State, World};

/// The team is free at most so many ticks after everybody was off the road for good: the leader's patience, which ends a session
/// whose guard does not come back, or go that nobody uses, and some seconds.
pub(super) const END_MAX: u8 = 54;

/// A person who waits is detected within so many frames.
pub(super) const DETECT_MAX: u8 = 6;

/// Go is shown for so many ticks at most after a guard has left its place.
pub(super) const AWAY_MAX: u8 = 2;

/// At 50 km/h a driver goes 27.8 m within the 2 s of reaction, and then 32.2 m to stop at 3 m/s².
pub(super) const STOP_M: u8 = 60;

/// Statement and premise of a rule.
#[derive(Clone, Copy, Debug)]
pub struct RuleClaim {
    /// Its id.
    pub id: &'static str,
    /// The id of its premise.
    pub premise_id: &'static str,
    /// The condition that must hold.
    pub statement: &'static str,
    /// The situation without which the rule says nothing.
    pub premise: &'static str,
}

macro_rules! rules {
    ($($id:ident: $statement:literal, where $premise:literal;)*) => {
        /// A rule of the ground truth. P4, escorts beside their people, needs continuous geometry: fuzz and `validate` judge it.
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Deserialize)]
        pub enum Rule {
            $(#[doc = $statement] $id,)*
        }

        impl Rule {
            /// All of them.
            pub const ALL: &'static [Self] = &[$(Self::$id),*];

            /// Its statement and premise.
            #[must_use]
            pub const fn claim(self) -> RuleClaim {
                match self {
                    $(Self::$id => RuleClaim {
                        id: stringify!($id),
                        premise_id: concat!(stringify!($id), "-premise"),
                        statement: $statement,
                        premise: $premise,
                    },)*
                }
            }

            /// All of them, each with its premise.
            pub(super) fn properties() -> Vec<Property<World>> {
                vec![$(
                    Property::always(Self::$id.claim().id, |_, state| Self::$id.holds(state)),
                    Property::sometimes(Self::$id.claim().premise_id, |_, state| {
                        Self::$id.is_premise_met(state)
                    }),
                )*]
            }
        }
    };
}

rules! {
    P1: "while somebody is on the carriageway, no guard that can stay leaves, and no word frees it",
        where "somebody is on the carriageway beside the crossing, at a sign that shows stop, and the sensor has missed them as often as it may";
    P2: "go is shown only while each guard guards at its place, or did at most 1 s ago",
        where "a guard has left its place while go is shown";
    P3: "go does not begin while a vehicle that is heard can no longer stop comfortably",
        where "a vehicle can no longer stop, somebody waits, and the guard is at its place";
    P5: "a person who waits in front of an idle team is detected within 6 frames",
        where "somebody waits in front of an idle team, and has not been seen in the last frame";
    P6: "the team is free within 27 s after everybody was off the road for good, seen on it before or out of sight",
        where "somebody has crossed, and the team is free again";
    P9: "a guard that hears for 0.5 s of a vehicle that can no longer stop does not step on an empty road",
        where "a guard that is to go to its place hears of such a vehicle, and nobody has been on the road";
    P10: "where vehicles are asked, go does not begin while one that has been heard for 0.5 s has not said that it will stop",
        where "a vehicle that can still stop has not said so, somebody waits, and the guard is at its place";
}

impl Rule {
    pub(super) fn holds(self, state: &State) -> bool {
        let mut guards = state.guards.iter();
        match self {
            Self::P1 => !(is_on_road(state) && guards.any(|it| it.has_left)),
            Self::P2 => !state.sign.shows_go() || guards.all(|it| it.away <= AWAY_MAX),
            Self::P3 => !(state.sign.has_begun && cannot_stop(state)),
            Self::P5 => state.undetected <= DETECT_MAX,
            Self::P6 => state.off_road <= END_MAX,
            Self::P9 => !guards.any(|it| it.stepped_out),
            Self::P10 => !state.began_unpromised,
        }
    }

    pub(super) fn is_premise_met(self, state: &State) -> bool {
        let (mut people, mut guards) = (state.people.iter(), state.guards.iter());
        match self {
            Self::P1 => {
                let is_missed =
                    |it: &Cell, missed| *it == Cell::Beside && missed >= state.left.misses;
                !state.sign.shows_go() && people.any(|it| is_missed(&it.at, it.missed))
            }
            Self::P2 => state.sign.shows_go() && guards.any(|it| it.away > 0),
            Self::P3 => {
                let are_guarding = guards.all(|it| it.is_guarding);
                cannot_stop(state) && are_guarding && people.any(|it| it.at == Cell::Near)
            }
            Self::P5 => state.undetected > 0 && people.any(|it| it.missed > 0),
            Self::P6 => state.is_free && people.any(|it| it.at == Cell::Far),
            Self::P9 => guards
                .enumerate()
                .any(|(follower, it)| it.ought_to_wait && state.team.is_sent(follower)),
            Self::P10 => {
                let may_stop = state.is_heard() && !cannot_stop(state) && !state.promised;
                let are_guarding = guards.all(|it| it.is_guarding);
                may_stop && are_guarding && people.any(|it| it.at == Cell::Near)
            }
        }
    }
}

/// Whether somebody is on the road. Where one machine is alone beside an application that says anything, only people count
/// that this machine saw there while it guarded.
fn is_on_road(state: &State) -> bool {
    let is_alone = state.left.watch == Watch::Guard;
    let mut people = state.people.iter();
    people.any(|it| it.at.is_road() && (it.was_seen_there || !is_alone))
}

fn cannot_stop(state: &State) -> bool {
    state.car.is_some_and(|metres| metres <= STOP_M)
}
