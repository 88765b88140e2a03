//! People at a simulated crossing, and what a robot knows of people on a real road.
//!
//! ```text
//!   arrives ──► waits ── a sign shows go ──► on the road ── some time later ──► across
//! ```
//!
//! A pedestrian does not turn back because a sign changes. What a robot knows of the road decides when
//! its application says `RoadClear`: nothing, unless sensors or a simulation tell.

use std::collections::BTreeSet;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use crossguard_endpoint::ras::clustering::PerceivedVru;

use crate::site::Place;

/// The simulated people at one crossing. Clones are the same crossing.
#[derive(Clone, Debug, Default)]
pub struct Street(Arc<Mutex<People>>);

#[derive(Debug, Default)]
struct People {
    /// How long each person who waits takes to cross, in microseconds.
    waiting_us: Vec<u64>,
    /// When each of those on the road is across.
    across_at_us: Vec<u64>,
}

impl Street {
    fn people(&self) -> MutexGuard<'_, People> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Somebody comes to cross the road, and takes so long for it. Nobody comes while somebody waits: robots
    /// that see the same person tell of one.
    pub fn arrive(&self, crossing_us: u64) {
        let mut people = self.people();
        if people.waiting_us.is_empty() {
            people.waiting_us.push(crossing_us);
        }
    }

    /// Everybody looks at the signs: who waits steps on the road when one shows *go*, who has had the time is
    /// across.
    pub fn look(&self, now_us: u64, a_sign_shows_go: bool) {
        let mut people = self.people();
        people.across_at_us.retain(|&across_us| across_us > now_us);
        if a_sign_shows_go {
            let set_out = std::mem::take(&mut people.waiting_us).into_iter();
            people
                .across_at_us
                .extend(set_out.map(|crossing_us| now_us.saturating_add(crossing_us)));
        }
    }

    /// Whether nobody is on the road.
    #[must_use]
    pub fn is_clear(&self) -> bool {
        self.people().across_at_us.is_empty()
    }

    /// Whether everybody who came is across.
    #[must_use]
    pub fn everybody_is_across(&self) -> bool {
        let people = self.people();
        people.across_at_us.is_empty() && people.waiting_us.is_empty()
    }
}

/// A crossing zone on the site: the part of the road on which people cross.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Zone {
    /// Its corner in the south-west.
    pub south_west: Place,
    /// Its corner in the north-east.
    pub north_east: Place,
}

impl Zone {
    fn contains(&self, [east, north]: [f64; 2]) -> bool {
        (self.south_west.east..=self.north_east.east).contains(&east)
            && (self.south_west.north..=self.north_east.north).contains(&north)
    }
}

/// For how long sensors that have told of somebody are known to work, in seconds.
const SENSORS_LAST_S: f64 = 1.0;

/// People who are kept track of. With more, the zone is not known to be clear.
const TRACKED_MAX: usize = 256;

/// What a robot's sensors know of the people in a zone.
///
/// Silent sensors may be broken ones. So the zone is clear only while they tell of somebody, anywhere, and
/// when everybody that they had in the zone was seen outside of it later.
#[derive(Clone, Debug)]
pub struct Watched {
    zone: Zone,
    /// Who was seen last in the zone.
    inside: BTreeSet<u32>,
    /// Whether there were too many to keep track of.
    is_lost: bool,
    told_s: Option<f64>,
}

impl Watched {
    /// A zone of which nothing is known yet.
    #[must_use]
    pub const fn new(zone: Zone) -> Self {
        Self {
            zone,
            inside: BTreeSet::new(),
            is_lost: false,
            told_s: None,
        }
    }

    /// The sensors have somebody at a place on the site, at `now_s`.
    pub fn perceive(&mut self, now_s: f64, vru: &PerceivedVru) {
        self.told_s = Some(now_s);
        if !self.zone.contains(vru.position_m) {
            self.inside.remove(&vru.id);
        } else if self.inside.len() < TRACKED_MAX {
            self.inside.insert(vru.id);
        } else if !self.inside.contains(&vru.id) {
            self.is_lost = true;
        }
    }

    /// Whether nobody is in the zone, as far as the sensors know at `now_s`.
    #[must_use]
    pub fn is_clear(&self, now_s: f64) -> bool {
        let work = |told_s: f64| now_s - told_s <= SENSORS_LAST_S;
        self.told_s.is_some_and(work) && self.inside.is_empty() && !self.is_lost
    }

    /// Somebody who knows has said that nobody is there.
    pub fn forget(&mut self) {
        self.inside.clear();
        self.is_lost = false;
    }
}

/// What a robot knows of the people on the road.
#[derive(Clone, Debug, Default)]
pub enum Road {
    /// Nothing: a person has to say when the road is clear.
    #[default]
    Unknown,
    /// What its sensors tell.
    Watched(Watched),
    /// Everything, in a simulation.
    Known(Street),
    /// Everything, in a simulation that this robot keeps: people come when it leads, and look at its sign.
    Own(Street),
}

impl Road {
    /// Whether the road is known to be clear at `now_s`.
    #[must_use]
    pub fn is_clear(&self, now_s: f64) -> bool {
        match self {
            Self::Unknown => false,
            Self::Watched(watched) => watched.is_clear(now_s),
            Self::Known(street) | Self::Own(street) => street.is_clear(),
        }
    }

    /// Whether everybody who wanted to cross is known to be across.
    #[must_use]
    pub fn everybody_is_across(&self) -> bool {
        match self {
            Self::Unknown | Self::Watched(_) => false,
            Self::Known(street) | Self::Own(street) => street.everybody_is_across(),
        }
    }
}

#[cfg(test)]
mod tests {
    use crossguard_endpoint::ras::clustering::VruClass;

    use super::*;

    #[test]
    fn a_pedestrian_waits_for_go_and_does_not_turn_back() {
        let street = Street::default();
        street.arrive(5_000_000);
        street.arrive(5_000_000);
        street.look(1_000_000, false);
        assert!(street.is_clear() && !street.everybody_is_across());
        street.look(2_000_000, true);
        street.look(6_999_999, false);
        assert!(!street.is_clear());
        street.look(7_000_000, true);
        assert!(street.is_clear() && street.everybody_is_across());
    }

    fn at(id: u32, east: f64, north: f64) -> PerceivedVru {
        PerceivedVru {
            id,
            position_m: [east, north],
            velocity_mps: [0.0; 2],
            class: VruClass::Pedestrian,
            confidence: 1.0,
        }
    }

    #[test]
    fn a_zone_is_clear_once_everybody_was_seen_outside_of_it() {
        let zone = Zone {
            south_west: Place::new(-3.0, 0.0),
            north_east: Place::new(3.0, 7.0),
        };
        let mut watched = Watched::new(zone);
        assert!(!watched.is_clear(0.0), "nothing is known");
        watched.perceive(0.0, &at(1, 0.0, -1.0));
        assert!(watched.is_clear(1.0) && !watched.is_clear(1.1));
        watched.perceive(2.0, &at(1, 0.0, 3.0));
        watched.perceive(3.0, &at(2, 9.0, 3.0));
        assert!(!watched.is_clear(3.0), "1 was seen last on the road");
        watched.perceive(4.0, &at(1, 0.0, 7.5));
        assert!(watched.is_clear(4.0));
    }

    #[test]
    fn more_people_than_can_be_kept_track_of_are_not_forgotten() {
        let zone = Zone {
            south_west: Place::default(),
            north_east: Place::new(1.0, 1.0),
        };
        let mut watched = Watched::new(zone);
        let ids = 0..u32::try_from(TRACKED_MAX).unwrap() + 1;
        ids.clone()
            .for_each(|id| watched.perceive(0.0, &at(id, 0.5, 0.5)));
        ids.for_each(|id| watched.perceive(0.0, &at(id, 2.0, 0.5)));
        assert!(!watched.is_clear(0.0));
        watched.forget();
        assert!(watched.is_clear(0.0));
    }
}
