//! People who walk as they like: they wait at the kerb, and go, stand still, turn back and walk along the road once a sign has let them on
//! it.

use crossguard_protocol::SessionId;
use crossguard_robot::site::Place;
use rand::Rng;
use rand::seq::IndexedRandom;
use rand_chacha::ChaCha8Rng;
use serde::Serialize;

use super::people::OnRoad;
use super::{Finding, World};
use crate::sim::place::ROAD_M;
use crate::sim::swarm::{SECOND_US, longest_us};

/// The kerbs of the street, in metres to the north.
const KERBS: [f64; 2] = [0.0, ROAD_M];

/// Where people wait, where they come from, and where they go to.
pub(super) const WAITS_AT: f64 = -0.5;
pub(super) const COMES_FROM: f64 = -4.0;
pub(super) const GOES_TO: f64 = 12.0;

/// Most people who wait.
const WAITING_MAX: usize = 4;

/// A person on the street.
#[derive(Clone, Debug)]
pub(super) struct Walker {
    /// Their number.
    pub(super) id: u32,
    /// Since when they wait.
    pub(super) since_us: u64,
    /// Until when they do.
    pub(super) patient_until_us: u64,
    /// Whether the faults of the run were over by then.
    pub(super) is_after_healing: bool,
    pub(super) waits: bool,
    /// At whose sign they stepped on the road.
    pub(super) session: Option<SessionId>,
    /// Where they are when, in order of time.
    pub(super) way: Vec<(u64, Place)>,
}

impl Walker {
    /// A person who comes from a place to the kerb, at a speed in m/s, and waits there for as long as it takes.
    pub(super) fn comes(id: u32, now_us: u64, [from, to]: [Place; 2], speed_mps: f64) -> Self {
        let mut way = vec![(now_us, from)];
        walk(&mut way, to, speed_mps);
        Self {
            id,
            since_us: way[1].0,
            patient_until_us: u64::MAX,
            is_after_healing: false,
            waits: true,
            session: None,
            way,
        }
    }

    /// Whether they stand at the kerb and wait.
    pub(super) fn stands(&self, now_us: u64) -> bool {
        self.waits && self.since_us <= now_us
    }

    /// Waits no longer, and goes away to a place.
    pub(super) fn goes_away(&mut self, now_us: u64, to: Place, speed_mps: f64) {
        self.way = vec![(now_us, self.place(now_us))];
        self.waits = false;
        walk(&mut self.way, to, speed_mps);
    }

    /// Waits no longer, and steps on the road: at the sign of a session, or without one.
    pub(super) fn sets_out(&mut self, way: Vec<(u64, Place)>, session: Option<SessionId>) {
        (self.way, self.waits, self.session) = (way, false, session);
    }

    /// Where they are.
    pub(super) fn place(&self, now_us: u64) -> Place {
        let next = self.way.iter().position(|(at_us, _)| *at_us > now_us);
        let last = self
            .way
            .last()
            .map_or(Place::default(), |(_, place)| *place);
        let Some(next) = next.filter(|next| *next > 0) else {
            return if next == Some(0) { self.way[0].1 } else { last };
        };
        let ((from_us, from), (to_us, to)) = (self.way[next - 1], self.way[next]);
        #[expect(clippy::cast_precision_loss, reason = "walks take seconds")]
        let share = (now_us - from_us) as f64 / (to_us - from_us) as f64;
        from.towards(to, from.distance(to) * share)
    }

    /// Whether they are on the carriageway.
    pub(super) fn is_on_road(&self, now_us: u64) -> bool {
        let north = self.place(now_us).north;
        north > KERBS[0] && north < KERBS[1]
    }

    pub(super) fn is_gone(&self, now_us: u64) -> bool {
        !self.waits && self.way.last().is_none_or(|(at_us, _)| *at_us <= now_us)
    }
}

/// Walks on to a place at a speed.
pub(super) fn walk(way: &mut Vec<(u64, Place)>, to: Place, speed_mps: f64) {
    if let Some((at_us, from)) = way.last().copied() {
        way.push((at_us + time_us(from.distance(to) / speed_mps), to));
    }
}

/// How people have fared.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Waits {
    /// How long people who were let across had waited at the kerb, in milliseconds.
    pub waited_ms: Vec<u32>,
    /// How many others went away, or waited still when the run was over.
    pub left: u64,
}

impl Waits {
    /// Takes in those of another run.
    pub fn add(&mut self, other: &Self) {
        self.waited_ms.extend(&other.waited_ms);
        self.left += other.left;
    }

    /// The time that this share of the people, from 0 to 1, waited at most, in milliseconds.
    #[must_use]
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_precision_loss,
        reason = "there are thousands of people"
    )]
    pub fn quantile_ms(&self, share: f64) -> Option<u32> {
        let mut waited_ms = self.waited_ms.clone();
        waited_ms.sort_unstable();
        let last = waited_ms.len().checked_sub(1)?;
        waited_ms
            .get((last as f64 * share).round() as usize)
            .copied()
    }
}

impl Serialize for Waits {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        #[serde(rename_all = "camelCase")]
        struct Fared {
            crossed: usize,
            left: u64,
            median_wait_ms: Option<u32>,
            longest_wait_ms: Option<u32>,
        }
        let fared = Fared {
            crossed: self.waited_ms.len(),
            left: self.left,
            median_wait_ms: self.quantile_ms(0.5),
            longest_wait_ms: self.quantile_ms(1.0),
        };
        fared.serialize(serializer)
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "walks take seconds"
)]
fn time_us(seconds: f64) -> u64 {
    (seconds * 1e6) as u64 + 1
}

impl World<'_> {
    /// Some people come to the kerb, unless there are people enough.
    pub(super) fn walkers_come(&mut self) {
        let (now_us, scale) = (self.now_us, self.seats[0].draw.time_scale);
        let waiting = self.walkers.iter().filter(|it| it.waits).count();
        let come = self.draws.random_range(1..=3_usize);
        for _ in 0..come.min(WAITING_MAX.saturating_sub(waiting)) {
            self.walkers_came += 1;
            let east = self.draws.random_range(-0.5..2.5);
            let speed_mps = scale * self.draws.random_range(0.8..1.8);
            let ends = [COMES_FROM, WAITS_AT].map(|north| Place::new(east, north));
            let mut walker = Walker::comes(self.walkers_came, now_us, ends, speed_mps);
            walker.is_after_healing = self.is_healed;
            if !self.is_healed && self.draws.random_bool(0.15) {
                let waits_us = self.draws.random_range(SECOND_US..20 * SECOND_US);
                walker.patient_until_us = walker.since_us + waits_us;
            }
            self.walkers.push(walker);
        }
        self.plan_look(0);
    }

    /// Everybody who waits looks at the signs.
    pub(super) fn walkers_look(&mut self) -> Result<(), Finding> {
        let now_us = self.now_us;
        self.walkers.retain(|it| !it.is_gone(now_us));
        for number in 0..self.walkers.len() {
            let walker = &self.walkers[number];
            if !walker.stands(now_us) {
                continue;
            }
            // In the end nobody waits for what does not come.
            let is_at_end = self.is_healed && self.progress.as_ref().is_none_or(|it| it.is_done);
            if walker.patient_until_us <= now_us || is_at_end && self.draws.random_bool(0.02) {
                let to = Place::new(walker.place(now_us).east, COMES_FROM);
                let walker = &mut self.walkers[number];
                walker.goes_away(now_us, to, 1.0);
                self.waits[usize::from(walker.is_after_healing)].left += 1;
                continue;
            }
            let signs = self.road.signs_at(0);
            let Some(&leader) = signs.choose(&mut self.draws) else {
                continue;
            };
            if self.draws.random_bool(0.7)
                && let Some(session) = self.step_on(leader)?
            {
                self.sets_out(number, session);
            }
        }
        if self.somebody_waits() {
            self.plan_look(0);
        }
        Ok(())
    }

    /// A person steps on the road.
    fn sets_out(&mut self, number: usize, session: SessionId) {
        let (now_us, draw) = (self.now_us, self.seats[0].draw);
        let most_us = longest_us(draw.config.settings());
        let walker = &mut self.walkers[number];
        let from = walker.place(now_us);
        let way = cross(&mut self.draws, from, now_us, draw.time_scale, most_us);
        walker.sets_out(way, Some(session));
        let waited_ms = (now_us - walker.since_us) / 1_000;
        let waits = &mut self.waits[usize::from(walker.is_after_healing)];
        (waits.waited_ms).push(u32::try_from(waited_ms).unwrap_or(u32::MAX));
        self.is_on_road(number, session);
    }

    /// A person is on the road, at the sign of a session, until the last leg of their way, which leads from a kerb on.
    pub(super) fn is_on_road(&mut self, number: usize, session: SessionId) {
        let way = &self.walkers[number].way;
        self.people.push(OnRoad {
            session,
            corner: 0,
            across_us: way[way.len() - 2].0,
            is_after_healing: self.is_healed,
        });
    }

    /// The places of the people on the road who stepped on it at the sign of a session.
    pub(super) fn on_road(&self, session: SessionId) -> impl Iterator<Item = Place> {
        let now_us = self.now_us;
        let of = self.walkers.iter();
        let of = of.filter(move |it| it.session == Some(session) && it.is_on_road(now_us));
        of.map(move |it| it.place(now_us))
    }

    /// How people fared, once the run is over.
    pub(super) fn waits(&self) -> [Waits; 2] {
        let mut waits = self.waits.clone();
        for walker in self.walkers.iter().filter(|it| it.waits) {
            waits[usize::from(walker.is_after_healing)].left += 1;
        }
        waits
    }

    /// Whether somebody waits at the kerb, or comes to it.
    pub(super) fn somebody_waits(&self) -> bool {
        self.walkers.iter().any(|it| it.waits)
    }

    /// Whether nobody is on the road.
    pub(super) fn nobody_walks_on_road(&self) -> bool {
        self.walkers.iter().all(|it| !it.is_on_road(self.now_us))
    }
}

/// A way across the road or back, from the kerb on to a place away from it.
fn cross(
    draws: &mut ChaCha8Rng,
    from: Place,
    now_us: u64,
    scale: f64,
    most_us: u64,
) -> Vec<(u64, Place)> {
    let mut way = vec![(now_us, from)];
    let speed_mps = scale * draws.random_range(0.8..1.8);
    let middle = draws.random_range(1.0..6.0);
    let mut east = from.east;
    let mut ends = [KERBS[1] + 0.1, GOES_TO];
    match draws.random_range(0..6) {
        // Straight across.
        0 | 1 => {}
        // With a pause.
        2 => {
            walk(&mut way, Place::new(east, middle), speed_mps);
            if let Some((at_us, place)) = way.last().copied() {
                let pause_us = draws.random_range(SECOND_US / 2..8 * SECOND_US);
                way.push((at_us + pause_us, place));
            }
        }
        // Back again.
        3 => {
            walk(&mut way, Place::new(east, middle), speed_mps);
            ends = [KERBS[0] - 0.1, COMES_FROM];
        }
        // Along the road.
        4 => {
            walk(&mut way, Place::new(east, middle), speed_mps);
            east += draws.random_range(-6.0..6.0);
            walk(&mut way, Place::new(east, middle), speed_mps);
        }
        // Running.
        _ => {
            walk(&mut way, Place::new(east, middle), scale * 3.5);
            east += draws.random_range(-2.0..2.0);
            walk(
                &mut way,
                Place::new(east, draws.random_range(1.0..6.0)),
                scale * 3.5,
            );
        }
    }
    walk(&mut way, Place::new(east, ends[0]), speed_mps);
    if way
        .last()
        .is_some_and(|(at_us, _)| at_us - now_us > most_us)
    {
        way.truncate(1);
        (east, ends) = (from.east, [KERBS[1] + 0.1, GOES_TO]);
        walk(&mut way, Place::new(east, ends[0]), scale * 1.2);
    }
    walk(&mut way, Place::new(east, ends[1]), speed_mps);
    way
}
