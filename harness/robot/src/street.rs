//! People at a simulated crossing, and what a robot knows of people on a real road.
//!
//! ```text
//!   arrives ──► waits ── a sign shows go ──► on the road ── some time later ──► across
//! ```
//!
//! A pedestrian does not turn back because a sign changes. What a robot knows of the road decides when
//! its application says `RoadClear`: nothing, unless sensors or a simulation tell.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use crate::zone::Watched;

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

    /// Whether the corridor would be open for somebody at `now_s`, as far as is known.
    #[must_use]
    pub fn needs_corridor(&self, now_s: f64) -> bool {
        match self {
            Self::Watched(watched) => watched.needs_corridor(now_s),
            Self::Unknown | Self::Known(_) | Self::Own(_) => true,
        }
    }

    /// Whether everybody who wanted to cross is known to be across at `now_s`.
    #[must_use]
    pub fn everybody_is_across(&self, now_s: f64) -> bool {
        match self {
            Self::Unknown => false,
            Self::Watched(watched) => watched.is_clear(now_s) && watched.urgency(now_s).is_none(),
            Self::Known(street) | Self::Own(street) => street.everybody_is_across(),
        }
    }
}

#[cfg(test)]
mod tests {
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
}
