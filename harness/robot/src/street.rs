//! People at a simulated crossing, and what a robot knows of people on a real road.
//!
//! ```text
//!   arrives ──► waits ── a sign shows go ──► on the road ── some time later ──► across
//! ```
//!
//! A pedestrian walks straight from one kerb to the other, and does not turn back because a sign changes. Robots that
//! know a simulated street have it as a sensor that misses nobody.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use crossguard_crossing::{Sensors, Setup, Sighting, WaitingRules};
use crossguard_endpoint::ras::area::Area;
use crossguard_endpoint::ras::clustering::PerceivedVru;
use crossguard_protocol::Millis;

use crate::site::Place;
use crate::zone::{Zone, sighting};

/// How far the kerbs are from the places where people wait, and from where an escort begins, in metres.
const PAVEMENT_M: f64 = 1.0;

/// How far from the kerb people wait, and how far on the road the first step leads, in metres. Each is more than
/// a place may be wrong by, and a step is within reach.
const WAITS_M: f64 = 0.1;
const STEP_M: f64 = 0.01;

/// For how long somebody who is across is to be seen at least, in microseconds.
const STAYS_US: u64 = 1_000_000;

/// Error of a place, in metres.
const ERROR_M: f64 = 0.05;

/// Half of the length of the road that is simulated, in metres.
const HALF_ROAD_M: f64 = 10.0;

/// The simulated people at one crossing. Clones are the same crossing.
#[derive(Clone, Debug)]
pub struct Street {
    people: Arc<Mutex<People>>,
    /// From where to where people walk, from pavement to pavement.
    way: [Place; 2],
}

#[derive(Debug, Default)]
struct People {
    /// When somebody looked last, in microseconds.
    now_us: u64,
    /// People at the kerbs.
    waiting: Vec<Waiting>,
    /// People on the road, and people who have just crossed.
    walking: Vec<Walker>,
}

#[derive(Clone, Copy, Debug)]
struct Waiting {
    /// How long they take to cross, in microseconds.
    crossing_us: u64,
    /// Whether they come from the other side.
    comes_back: bool,
}

#[derive(Clone, Copy, Debug)]
struct Walker {
    /// Whether they come from the other side.
    comes_back: bool,
    /// When they stepped on the road, in microseconds.
    began_us: u64,
    /// When they are off it.
    across_us: u64,
}

impl Walker {
    /// How far they have come from the kerb, on a road of this width, in metres.
    #[expect(clippy::cast_precision_loss, reason = "a crossing takes seconds")]
    fn walked_m(&self, now_us: u64, width_m: f64) -> f64 {
        let takes = self.across_us.saturating_sub(self.began_us).max(1) as f64;
        now_us.saturating_sub(self.began_us) as f64 / takes * width_m
    }
}

impl Default for Street {
    /// The street of the demonstrations.
    fn default() -> Self {
        Self::between(Place::new(1.0, -1.0), Place::new(1.0, 8.0))
    }
}

impl Street {
    /// A street that people cross between these places on its pavements.
    #[must_use]
    pub fn between(from: Place, to: Place) -> Self {
        Self {
            people: Arc::default(),
            way: [from, to],
        }
    }

    fn people(&self) -> MutexGuard<'_, People> {
        self.people.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A person comes to cross the road, from one side or from each of both, and takes so long for it. No person comes
    /// while another one waits: robots that see the same person tell of one.
    pub fn arrive(&self, crossing_us: u64, sides: usize) {
        let mut people = self.people();
        if people.waiting.is_empty() {
            let sides = [false, true].into_iter().take(sides);
            people.waiting.extend(sides.map(|comes_back| Waiting {
                crossing_us,
                comes_back,
            }));
        }
    }

    /// Everybody looks at the signs: a person who waits steps on the road when one shows *go*. A person who has had the
    /// time is across, and walks on to the end of the pavement.
    pub fn look(&self, now_us: u64, a_sign_shows_go: bool) {
        let width_m = self.width_m();
        let mut people = self.people();
        people.now_us = now_us;
        people.walking.retain(|walker| {
            let is_walking = walker.walked_m(now_us, width_m) < width_m + PAVEMENT_M;
            is_walking || now_us < walker.across_us.saturating_add(STAYS_US)
        });
        if a_sign_shows_go {
            let set_out = std::mem::take(&mut people.waiting).into_iter();
            people.walking.extend(set_out.map(|person| Walker {
                comes_back: person.comes_back,
                began_us: now_us,
                across_us: now_us.saturating_add(person.crossing_us),
            }));
        }
    }

    /// How many are on the road.
    #[must_use]
    pub fn on_road(&self) -> usize {
        let people = self.people();
        let is_on_road = |walker: &&Walker| walker.across_us > people.now_us;
        people.walking.iter().filter(is_on_road).count()
    }

    /// Whether nobody is on the road.
    #[must_use]
    pub fn is_clear(&self) -> bool {
        self.on_road() == 0
    }

    fn width_m(&self) -> f64 {
        let [from, to] = self.way;
        (from.distance(to) - 2.0 * PAVEMENT_M).max(0.1)
    }

    /// Everybody who waits, is on the road, or has just crossed it, and where.
    #[must_use]
    pub fn sightings(&self) -> Vec<Sighting> {
        let width_m = self.width_m();
        let people = self.people();
        let [from, to] = self.way;
        let walking = people.walking.iter();
        let walking = walking.map(|walker| {
            let walked_m = walker.walked_m(people.now_us, width_m);
            let metres = PAVEMENT_M + walked_m.clamp(STEP_M, width_m + PAVEMENT_M);
            (walker.comes_back, metres)
        });
        let waiting = people.waiting.iter();
        let waiting = waiting.map(|person| (person.comes_back, PAVEMENT_M - WAITS_M));
        let at = waiting.chain(walking).map(|(comes_back, metres)| {
            let (from, to) = if comes_back { (to, from) } else { (from, to) };
            from.towards(to, metres)
        });
        let seen = (1..).zip(at).map(|(id, at)| {
            let vru = PerceivedVru::pedestrian(id, [at.east, at.north]);
            sighting(&vru, ERROR_M)
        });
        seen.collect()
    }

    /// The zone of this street.
    #[must_use]
    pub fn zone(&self) -> Zone {
        let [from, to] = self.way;
        let strip = |beyond_m: f64, half_m: f64| {
            let length = from.distance(to).max(0.1);
            let along = [
                (to.east - from.east) / length,
                (to.north - from.north) / length,
            ];
            let corner = |place: Place, on: f64, side: f64| {
                [
                    place.east + along[0] * on - along[1] * side,
                    place.north + along[1] * on + along[0] * side,
                ]
            };
            Area::Polygon(vec![
                corner(from, -beyond_m, -half_m),
                corner(to, beyond_m, -half_m),
                corner(to, beyond_m, half_m),
                corner(from, -beyond_m, half_m),
            ])
        };
        Zone {
            waiting: Some(strip(PAVEMENT_M, HALF_ROAD_M)),
            // Its people step on the road as soon as they see go. Its time may pass many times as fast as real.
            rules: WaitingRules {
                dwell: Millis(0),
                step_off: Millis(10),
                ..WaitingRules::default()
            },
            // It misses nobody, and is looked at whenever the robot does something.
            sensors: Sensors {
                miss_max: 0,
                error_cm: 0,
                gap_max: Millis(60_000),
                linger: Millis(10),
                heard: Millis(10),
                ..Sensors::default()
            },
            ..Zone::of_road(strip(-PAVEMENT_M, HALF_ROAD_M))
        }
    }
}

/// Knowledge of a robot of the people on the road.
#[derive(Clone, Debug, Default)]
pub enum Road {
    /// Nothing: a person says when it is clear.
    #[default]
    Unknown,
    /// Reports of others on people and vehicles there: it has no sensors for them. A person says when it is clear.
    Heard(Area),
    /// Road users in a zone, by its sensors.
    Watched(Zone),
    /// Everything, in a simulation.
    Known(Street),
    /// Everything, in a simulation that this robot keeps: people come when it leads, and look at its sign.
    Own(Street),
}

impl Road {
    /// The zone that it knows people in.
    #[must_use]
    pub fn zone(&self) -> Option<Zone> {
        match self {
            Self::Unknown | Self::Heard(_) => None,
            Self::Watched(zone) => Some(zone.clone()),
            Self::Known(street) | Self::Own(street) => Some(street.zone()),
        }
    }

    /// The setup of the crossing machine of a robot that knows this of the road.
    #[must_use]
    pub(crate) fn set_up(&self, setup: Setup) -> Setup {
        let zone = match self {
            Self::Heard(road) => Some(Zone::of_road(road.clone())),
            _ => self.zone(),
        };
        match (self, zone) {
            (Self::Watched(_), Some(zone)) => zone.watched(setup),
            (_, Some(zone)) => Setup {
                watches: false,
                calls: false,
                ..zone.watched(setup)
            },
            (_, None) => Setup {
                watches: false,
                calls: false,
                ground: crossguard_crossing::Ground::default(),
                ..setup
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pedestrian_waits_for_go_and_does_not_turn_back() {
        let street = Street::default();
        street.arrive(5_000_000, 1);
        street.arrive(5_000_000, 1);
        street.look(1_000_000, false);
        assert!(street.is_clear() && !street.people().waiting.is_empty());
        street.look(2_000_000, true);
        street.look(6_999_999, false);
        assert!(!street.is_clear());
        street.look(7_000_000, true);
        assert!(street.is_clear() && street.people().waiting.is_empty());
    }

    #[test]
    fn people_are_on_the_road_of_their_zone_while_they_cross() {
        let street = Street::default();
        let ground = street.zone().ground();
        street.arrive(10_000_000, 1);
        for (now_us, is_on_road) in [
            (0, false),
            (1, true),
            (5_000_000, true),
            (10_500_000, false),
        ] {
            street.look(now_us, now_us == 1);
            let seen = street.sightings();
            assert_eq!(seen.len(), 1, "{now_us}");
            assert_eq!(ground.is_road(seen[0].at), is_on_road, "{now_us}");
            assert!(ground.is_zone(seen[0].at), "{now_us}");
        }
    }
}
