//! A crossing zone: what people at a crossing do, as a robot's sensors tell it. Somebody waits to cross, or walks
//! by; the road is clear, or somebody is on it.
//!
//! ```text
//!   elsewhere ──► passing ── stands, or comes to the road ──► waiting ──► PedestrianDetected
//!       ▲            │                                           │
//!       │            └──────────────► on the road ◄──────────────┘
//!       └──────────── across ◄─────────────┘
//! ```
//!
//! A false call costs a few robots a moment. A missed person stands alone at the road, which costs more. A call for
//! each passer-by stops traffic for nothing. So a road user waits to cross when all of these rules hold:
//!
//! | rule | default | why |
//! |---|---|---|
//! | The road user is a pedestrian or a wheelchair user, or a cyclist who stands. | – | Cyclists ride along, vehicles use the road, animals ask for nothing. |
//! | Its confidence is at least `confidence_min` of `[people]`, and half of it once it waits. | 0.5 | The same people are announced in RAM. |
//! | It is in the zone, or on the road in it. | – | A person who stands on the road needs help most: the urgency is *emergency*. |
//! | The newest observation is at most [`SENSORS_LAST_S`] old, and there was no longer gap before it. | 1 s | One old line is no person who waits. |
//! | For `dwell_s` it is slower than `speed_max_mps`, by its velocity and by its places. | 1 s, 0.5 m/s | Slow walkers go at 0.8 m/s, people who stand sway. A feed without velocities still shows walkers. |
//! | Or, on foot or in a wheelchair, it heads for the road for `dwell_s`, and would be on it within `approach_s`. | 3 s | A person who walks up to the road is going to cross it; a person who walks along the kerb is not. |
//! | It did not come from the road within [`ACROSS_S`]. | 20 s | A person who has crossed is no new call. One who stays longer is. |
//!
//! A waiting person goes on waiting, however restless, until the person leaves the zone, steps on the road, or is
//! not observed any more. The zone is deserted when nobody has waited or been on the road for `clear_s` (3 s).
//!
//! Silent sensors may be broken. So the road is clear only while they report something, anywhere, and when everybody
//! they had on the road was seen beside it later. Vehicles on the road are no people on it.

use std::collections::BTreeMap;

use crossguard_endpoint::ras::area::Area;
use crossguard_endpoint::ras::clustering::{PerceivedVru, VruClass};
use crossguard_protocol::Urgency;
use serde::{Deserialize, Serialize};

use crate::site::Place;

/// For how long an observation holds, in seconds.
pub const SENSORS_LAST_S: f64 = 1.0;

/// For how long a person who came from the road counts as across and does not wait, in seconds.
pub const ACROSS_S: f64 = 20.0;

/// A person who leaves the road at least this far from where they stepped on it has crossed it, in metres. Less may
/// be a sensor's error, or a step back.
const CROSSED_MIN_M: f64 = 2.0;

/// Error of a place from one observation to the next, in metres.
const PLACE_ERROR_M: f64 = 0.2;

/// Step at which the straight way to the road is sampled, in seconds.
const APPROACH_STEP_S: f64 = 0.25;

/// Largest speed on foot, in m/s.
const ON_FOOT_MAX_MPS: f64 = 4.0;

/// Capacity for road users. With more of them on it, the road is not known to be clear.
const TRACKED_MAX: usize = 256;

/// A crossing zone.
#[derive(Clone, PartialEq, Debug)]
pub struct Zone {
    /// Where people wait to cross; without it nobody is detected.
    pub waiting: Option<Area>,
    /// The part of the road on which they cross; without it the road is never known to be clear.
    pub road: Option<Area>,
    /// When somebody waits.
    pub rules: WaitingRules,
    /// Smallest confidence of a person who waits, from 0 to 1; half of it is enough once the person waits.
    pub confidence_min: f64,
}

/// When somebody waits to cross: see the [module](self).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct WaitingRules {
    /// For how long somebody has to stand or to come to the road, in seconds.
    pub dwell_s: f64,
    /// Largest speed of a person who stands, in m/s.
    pub speed_max_mps: f64,
    /// A person who heads for the road counts from this many seconds before it. 0: only standing people wait.
    pub approach_s: f64,
    /// The zone is deserted after so many seconds in which nobody waited or was on the road.
    pub clear_s: f64,
}

impl Default for WaitingRules {
    fn default() -> Self {
        Self {
            dwell_s: 1.0,
            speed_max_mps: 0.5,
            approach_s: 3.0,
            clear_s: 3.0,
        }
    }
}

impl Zone {
    /// A zone with this road, in which nobody is detected.
    #[must_use]
    pub fn of_road(road: Area) -> Self {
        Self {
            waiting: None,
            road: Some(road),
            rules: WaitingRules::default(),
            confidence_min: 0.5,
        }
    }

    fn is_road(&self, at: [f64; 2]) -> bool {
        self.road.as_ref().is_some_and(|road| road.contains(at))
    }

    fn is_within(&self, at: [f64; 2]) -> bool {
        self.waiting.as_ref().is_some_and(|it| it.contains(at)) || self.is_road(at)
    }

    /// Whether somebody at a place who goes on like this is on the road soon.
    fn leads_to_road(&self, vru: &PerceivedVru) -> bool {
        let [vx, vy] = vru.velocity_mps;
        let speed = vx.hypot(vy);
        if speed <= self.rules.speed_max_mps || speed > ON_FOOT_MAX_MPS {
            return false;
        }
        let [x, y] = vru.position_m;
        let ahead =
            std::iter::successors(Some(APPROACH_STEP_S), |at_s| Some(at_s + APPROACH_STEP_S));
        let mut ahead = ahead.take_while(|at_s| *at_s <= self.rules.approach_s);
        ahead.any(|at_s| self.is_road([x + vx * at_s, y + vy * at_s]))
    }
}

/// What somebody does at a crossing.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Conduct {
    /// Is somewhere else.
    Elsewhere,
    /// Is in the zone, and does not wait.
    Passing,
    /// Waits to cross.
    Waiting,
    /// Is on the road.
    OnRoad,
    /// Has crossed.
    Across,
}

/// What is known of a road user.
#[derive(Clone, Copy, Debug)]
struct Track {
    vru: PerceivedVru,
    told_s: f64,
    /// Where and since when they have stood, as far as places tell.
    stood: (f64, [f64; 2]),
    /// Since when they have done what somebody who waits does.
    intends_s: Option<f64>,
    waits: bool,
    /// Where they stepped on the road that they are on.
    entered: Option<[f64; 2]>,
    /// When they left the road on another side.
    across_s: Option<f64>,
}

impl Track {
    fn new(now_s: f64, vru: PerceivedVru) -> Self {
        Self {
            vru,
            told_s: now_s,
            stood: (now_s, vru.position_m),
            intends_s: None,
            waits: false,
            entered: None,
            across_s: None,
        }
    }

    fn is_fresh(&self, now_s: f64) -> bool {
        now_s - self.told_s <= SENSORS_LAST_S
    }

    fn is_on_road(&self) -> bool {
        self.entered.is_some()
    }

    /// Takes in one more observation.
    fn update(&mut self, now_s: f64, vru: PerceivedVru, zone: &Zone) {
        if !self.is_fresh(now_s) {
            self.intends_s = None;
            self.waits = false;
            self.stood = (now_s, vru.position_m);
        }
        (self.vru, self.told_s) = (vru, now_s);
        self.walk(now_s, zone);
        self.intend(now_s, zone);
    }

    /// Follows them on the road and off it.
    fn walk(&mut self, now_s: f64, zone: &Zone) {
        let at = self.vru.position_m;
        // One that was a person once does not become a vehicle on the road.
        let is_person = self.vru.class != VruClass::Vehicle || self.is_on_road();
        if zone.is_road(at) && is_person {
            self.entered.get_or_insert(at);
        } else if let Some(entered) = self.entered.take()
            && distance_m(entered, at) >= CROSSED_MIN_M
        {
            self.across_s = Some(now_s);
            self.waits = false;
        }
        let is_over = |across_s: f64| now_s - across_s > ACROSS_S;
        if !zone.is_within(at) || self.across_s.is_some_and(is_over) {
            self.across_s = None;
        }
    }

    /// Whether they wait.
    fn intend(&mut self, now_s: f64, zone: &Zone) {
        let (rules, vru) = (&zone.rules, &self.vru);
        let [vx, vy] = vru.velocity_mps;
        let (since_s, place) = self.stood;
        let reach_m = PLACE_ERROR_M + rules.speed_max_mps * (now_s - since_s);
        let has_moved = distance_m(place, vru.position_m) > reach_m;
        let stands = vx.hypot(vy) <= rules.speed_max_mps && !has_moved;
        if !stands {
            self.stood = (now_s, vru.position_m);
        }
        let comes = is_on_foot(vru.class) && !self.is_on_road() && zone.leads_to_road(vru);
        let may_wait = zone.waiting.is_some()
            && zone.is_within(vru.position_m)
            && self.across_s.is_none()
            && (is_on_foot(vru.class) || vru.class == VruClass::Bicyclist);
        if !may_wait {
            (self.intends_s, self.waits) = (None, false);
            return;
        }
        let share = if self.waits { 0.5 } else { 1.0 };
        if vru.confidence < zone.confidence_min * share {
            (self.intends_s, self.waits) = (None, false);
        } else if stands || comes {
            let since_s = *self.intends_s.get_or_insert(now_s);
            self.waits |= now_s - since_s >= rules.dwell_s;
        } else {
            self.intends_s = None;
            // A person who crosses does not wait any more.
            self.waits &= !self.is_on_road();
        }
    }

    fn conduct(&self, now_s: f64, zone: &Zone) -> Conduct {
        if self.is_on_road() {
            Conduct::OnRoad
        } else if self.across_s.is_some() {
            Conduct::Across
        } else if self.waits && self.is_fresh(now_s) {
            Conduct::Waiting
        } else if zone.is_within(self.vru.position_m) {
            Conduct::Passing
        } else {
            Conduct::Elsewhere
        }
    }
}

fn is_on_foot(class: VruClass) -> bool {
    matches!(class, VruClass::Pedestrian | VruClass::WheelchairUser)
}

fn distance_m(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// What a robot's sensors know of a zone: see the [module](self).
#[derive(Clone, Debug)]
pub struct Watched {
    zone: Zone,
    tracks: BTreeMap<u32, Track>,
    /// Whether there were too many to keep track of.
    is_lost: bool,
    told_s: Option<f64>,
    /// When somebody waited or was on the road last.
    wanted_s: Option<f64>,
}

impl Watched {
    /// A zone of which nothing is known yet.
    #[must_use]
    pub const fn new(zone: Zone) -> Self {
        Self {
            zone,
            tracks: BTreeMap::new(),
            is_lost: false,
            told_s: None,
            wanted_s: None,
        }
    }

    /// The zone.
    #[must_use]
    pub const fn zone(&self) -> &Zone {
        &self.zone
    }

    /// The sensors have somebody at a place on the site, at `now_s`.
    pub fn perceive(&mut self, now_s: f64, vru: &PerceivedVru) {
        self.told_s = Some(now_s);
        // A person who was lost on the road stays there; anybody else is gone.
        self.tracks
            .retain(|_, track| track.is_on_road() || track.is_fresh(now_s));
        if let Some(track) = self.tracks.get_mut(&vru.id) {
            track.update(now_s, *vru, &self.zone);
        } else if self.tracks.len() < TRACKED_MAX {
            let mut track = Track::new(now_s, *vru);
            track.update(now_s, *vru, &self.zone);
            self.tracks.insert(vru.id, track);
        } else if self.zone.is_road(vru.position_m) {
            self.is_lost = true;
        }
        self.elapse(now_s);
    }

    /// The sensors work at `now_s`, and have nobody. A person who was lost on the road stays there.
    pub const fn perceive_nobody(&mut self, now_s: f64) {
        self.told_s = Some(now_s);
    }

    /// Lets time pass until `now_s`.
    pub fn elapse(&mut self, now_s: f64) {
        if self.is_wanted(now_s) {
            self.wanted_s = Some(now_s);
        }
    }

    /// Whether somebody waits or is on the road at `now_s`.
    fn is_wanted(&self, now_s: f64) -> bool {
        self.waiting(now_s).next().is_some() || self.tracks.values().any(Track::is_on_road)
    }

    /// Whether the corridor would be open for somebody at `now_s`. A zone in which nobody is detected does not
    /// know.
    #[must_use]
    pub fn needs_corridor(&self, now_s: f64) -> bool {
        self.zone.waiting.is_none() || self.is_wanted(now_s)
    }

    /// Whether nobody is on the road, as far as the sensors know at `now_s`.
    #[must_use]
    pub fn is_clear(&self, now_s: f64) -> bool {
        let work = |told_s: f64| now_s - told_s <= SENSORS_LAST_S;
        let is_free = !self.tracks.values().any(Track::is_on_road) && !self.is_lost;
        self.zone.road.is_some() && self.told_s.is_some_and(work) && is_free
    }

    /// Somebody who knows has said that nobody is on the road.
    pub fn forget(&mut self) {
        self.tracks.retain(|_, track| !track.is_on_road());
        self.is_lost = false;
    }

    fn waiting(&self, now_s: f64) -> impl Iterator<Item = &Track> {
        let tracks = self.tracks.values();
        tracks.filter(move |track| track.waits && track.is_fresh(now_s))
    }

    /// How urgently somebody waits to cross at `now_s`; `None` when nobody does.
    #[must_use]
    pub fn urgency(&self, now_s: f64) -> Option<Urgency> {
        let urgency = |track: &Track| match track.vru.class {
            _ if track.is_on_road() => Urgency::Emergency,
            VruClass::WheelchairUser => Urgency::High,
            _ => Urgency::Medium,
        };
        self.waiting(now_s).map(urgency).max()
    }

    /// The middle of the people who wait at `now_s`.
    #[must_use]
    pub fn middle(&self, now_s: f64) -> Option<Place> {
        let (mut sum, mut count) = ([0.0, 0.0], 0.0);
        for track in self.waiting(now_s) {
            let [x, y] = track.vru.position_m;
            (sum, count) = ([sum[0] + x, sum[1] + y], count + 1.0);
        }
        (count > 0.0).then(|| Place::new(sum[0] / count, sum[1] / count))
    }

    /// Whether nobody has waited or been on the road for `clear_s` at `now_s`.
    #[must_use]
    pub fn is_deserted(&self, now_s: f64) -> bool {
        let since = |wanted_s: f64| now_s - wanted_s >= self.zone.rules.clear_s;
        self.wanted_s.is_none_or(since)
    }

    /// What a road user that the sensors track by this number does at `now_s`.
    #[must_use]
    pub fn conduct(&self, now_s: f64, id: u32) -> Conduct {
        let track = self.tracks.get(&id);
        track.map_or(Conduct::Elsewhere, |track| track.conduct(now_s, &self.zone))
    }
}

#[cfg(test)]
mod tests;
