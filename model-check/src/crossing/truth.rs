//! What must hold of people, bodies and signs: from the ground truth alone, without a look into any machine.

use super::world::{Cell, State};

/// The guards are free, and the team is idle, at most so many ticks after everybody was off the road for good.
pub(super) const END_MAX: u8 = 20;

/// A person who waits is detected within so many frames.
pub(super) const DETECT_MAX: u8 = 6;

/// Go is shown for so many ticks at most after a guard has left its place.
const ADRIFT_MAX: u8 = 2;

/// A rule of the ground truth.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Rule {
    /// While somebody is on the carriageway, no guard that can stay leaves.
    P1,
    /// Go is shown only while each guard is at its place, or left it a moment ago.
    P2,
    /// Go does not begin while a vehicle that is heard can no longer stop comfortably.
    P3,
    /// A person who waits is detected within some frames.
    P5,
    /// The session ends once everybody is off the road, and the team is free.
    P6,
}

impl Rule {
    /// The rules.
    pub const ALL: [Self; 5] = [Self::P1, Self::P2, Self::P3, Self::P5, Self::P6];

    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::P1 => "P1",
            Self::P2 => "P2",
            Self::P3 => "P3",
            Self::P5 => "P5",
            Self::P6 => "P6",
        }
    }

    pub(super) fn holds(self, state: &State) -> bool {
        match self {
            Self::P1 => !(is_on_road(state) && state.guard.has_left),
            Self::P2 => !state.sign.shows_go() || state.guard.adrift <= ADRIFT_MAX,
            Self::P3 => !(state.sign.has_begun && state.car.is_some_and(cannot_stop)),
            Self::P5 => state.undetected <= DETECT_MAX,
            Self::P6 => state.off_road <= END_MAX,
        }
    }
}

/// Something that must come about in some scenario, or a rule says nothing.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Premise {
    /// Somebody is on the road while go is shown.
    Crosses,
    /// Somebody is on the road, and the sign is at stop.
    Stopped,
    /// Somebody is on the carriageway beside the crossing.
    Beside,
    /// Somebody is on the road whom the sensor has missed as often as it may.
    Missed,
    /// The guard is off its place while somebody is on the road.
    Adrift,
    /// A vehicle could not stop any more, and somebody waited.
    Car,
    /// Somebody is across, and everybody is idle.
    Done,
}

impl Premise {
    /// The premises.
    pub const ALL: [Self; 7] = [
        Self::Crosses,
        Self::Stopped,
        Self::Beside,
        Self::Missed,
        Self::Adrift,
        Self::Car,
        Self::Done,
    ];

    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Crosses => "crosses",
            Self::Stopped => "stopped",
            Self::Beside => "beside",
            Self::Missed => "missed",
            Self::Adrift => "adrift",
            Self::Car => "car",
            Self::Done => "done",
        }
    }

    pub(super) fn is_reached(self, state: &State) -> bool {
        let on_road = is_on_road(state);
        let is_at = |cell| state.people.iter().any(|person| person.at == cell);
        match self {
            Self::Crosses => on_road && state.sign.shows_go(),
            Self::Stopped => on_road && !state.sign.shows_go(),
            Self::Beside => is_at(Cell::Beside),
            Self::Missed => {
                let mut people = state.people.iter();
                people.any(|it| it.at.is_road() && it.missed >= super::MISS_MAX)
            }
            Self::Adrift => on_road && state.guard.adrift > 0,
            Self::Car => is_at(Cell::Near) && state.car.is_some_and(cannot_stop),
            Self::Done => is_at(Cell::Far) && state.is_over,
        }
    }
}

fn is_on_road(state: &State) -> bool {
    state.people.iter().any(|person| person.at.is_road())
}

/// At 50 km/h a driver needs 2 s, which is 27.8 m, and then 32.2 m to stop at 3 m/s²: 60 m.
fn cannot_stop(metres: u8) -> bool {
    metres <= 60
}
