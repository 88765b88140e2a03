//! People: where they are, where they may go, and what the sensor tells of them.

use crossguard_crossing::{Coverage, Frame, Input, Point, RoadUser, Sighting};
use crossguard_protocol::Millis;

use super::street::TICK;

pub(super) const PEOPLE_MAX: usize = 2;

#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum Cell {
    /// On the pavement, at the crossing.
    Near,
    /// On the pavement, where people do not wait and see the sign.
    Aside,
    Lane,
    /// On the carriageway, beside the crossing.
    Beside,
    /// On the other pavement.
    Far,
    /// Out of everybody's sight, off the road.
    Away,
}

impl Cell {
    pub(super) const fn is_road(self) -> bool {
        matches!(self, Self::Lane | Self::Beside)
    }

    /// Where it is. Cells from one of which somebody gets to another within a tick are at most 4.5 m apart.
    const fn place(self, person: usize) -> Point {
        let east = if person == 0 { 100 } else { 0 };
        match self {
            Self::Near => Point::new(east, -30),
            Self::Aside => Point::new(350 + east, -30),
            Self::Lane => Point::new(east, 350),
            Self::Beside => Point::new(450 + east, 350),
            Self::Far => Point::new(east, 730),
            Self::Away => Point::new(east, -4_000),
        }
    }

    /// Where somebody may be a tick later. People step on the road under go or soon after it, and leave it where they like.
    pub(super) const fn moves(self, goes: bool, is_free: bool, is_late: bool) -> &'static [Self] {
        match self {
            Self::Near if goes && is_late => &[Self::Near, Self::Lane, Self::Away, Self::Aside],
            Self::Near if goes => &[Self::Near, Self::Lane, Self::Away],
            Self::Near if is_late => &[Self::Near, Self::Away, Self::Aside],
            Self::Near => &[Self::Near, Self::Away],
            Self::Aside if goes => &[Self::Aside, Self::Near, Self::Away, Self::Beside],
            Self::Aside => &[Self::Aside, Self::Near, Self::Away],
            Self::Lane => &[Self::Lane, Self::Near, Self::Far, Self::Beside],
            Self::Beside => &[Self::Beside, Self::Lane],
            // A person who stays there for longer waits there.
            Self::Far if is_free => &[Self::Away],
            Self::Far => &[Self::Far, Self::Away],
            Self::Away => &[Self::Away],
        }
    }
}

#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) struct Person {
    pub(super) at: Cell,
    /// In how many frames the sensor has missed them in a row.
    pub(super) missed: u8,
    /// Their id by the sensor.
    pub(super) id: u8,
    pub(super) has_walked: bool,
    /// Whether a frame that was taken in at once, by a guard that is on its own while it guarded, had them there.
    pub(super) was_seen_there: bool,
    /// For how many ticks they have been on the road, at most 2.
    pub(super) on_road: u8,
}

/// The cell and the id of each person in a frame; `None` for one that is not in it.
pub(super) type Seen = [Option<(Cell, u8)>; PEOPLE_MAX];

/// Calls `tell` with a frame that is so many ticks old.
pub(super) fn tell_frame(age: u8, seen: Seen, tell: &mut impl FnMut(Input<'_>)) {
    let people = seen.iter().enumerate();
    let people = people.filter_map(|(number, it)| Some(sighting(number, (*it)?)));
    let sightings: Vec<_> = people.collect();
    tell(Input::Frame(Frame {
        source: 0,
        age: Millis(u32::from(age) * TICK.0),
        covers: Coverage::ALL,
        sightings: &sightings,
    }));
}

fn sighting(person: usize, (cell, id): (Cell, u8)) -> Sighting {
    Sighting {
        id: Some(id.into()),
        at: cell.place(person),
        error_cm: 0,
        velocity: None,
        what: RoadUser::Pedestrian,
        confidence: 90,
    }
}
