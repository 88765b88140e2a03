//! People as chains of observations: who waits to cross, who walks by, who is on the road.
//!
//! ```text
//!   elsewhere ──► passing ── stands, or comes to the road ──► waiting ──► the robot calls
//!       ▲            │                                           │
//!       │            └──────────────► on the road ◄──────────────┘
//!       └──────────── across ◄─────────────┘
//! ```
//!
//! A track is a chain of observations that one body could have walked. An id of a source only helps to choose between
//! tracks that are within reach; an id that jumps is somebody else. Another id continues the track of somebody who stands
//! there, for trackers rename people; elsewhere it is somebody else, for one of two who stand beside each other may be
//! missed. Tracks decide who waits. Whether the road is clear is decided by [`occupancy`](crate::occupancy) alone: tracks
//! may delay that, and never bring it about.
//!
//! A false call costs a few robots a moment. A missed person stands alone at the road, which costs more. A road user waits
//! to cross when all of these rules hold:
//!
//! | rule | default | why |
//! |---|---|---|
//! | A pedestrian or wheelchair user, or a cyclist who stands. | – | Cyclists ride along, vehicles use the road. |
//! | The confidence is at least `confidence_min`, and half of it for a person who waits already. | 50 % | The same people are announced in RAM. |
//! | In the zone, or on the road in it; a cyclist not on the road beside the crossing. | – | A person who stands on the road needs help most: the urgency is *emergency*. |
//! | Observed within the last [`FRESH`]. | 1 s | One old observation is no person who waits. |
//! | For `dwell` slower than `speed_max`, by velocity and by places. | 1 s, 0.5 m/s | Slow walkers go at 0.8 m/s, people who stand sway. |
//! | Or, on foot or in a wheelchair, heads for the road for `dwell`, and would be on it within `approach`. | 3 s | A person who walks up to the road is going to cross it. |
//! | Did not come from the road within [`ACROSS`]. | 20 s | A person who has crossed is no new call. |

use crossguard_protocol::{Millis, StationId, Urgency};

use crate::ground::{Point, Way};
use crate::input::{RoadUser, Sighting};
use crate::setup::Setup;

/// For how long an observation holds.
pub const FRESH: Millis = Millis(1_000);

/// For how long a person who came from the road does not wait.
pub const ACROSS: Millis = Millis(20_000);

/// A person who leaves the road at least so far from where they stepped on it has crossed it, in centimetres.
const CROSSED_MIN_CM: u32 = 200;

/// Step at which the straight way to the road is sampled.
const APPROACH_STEP_MS: u32 = 250;

/// From where an observation is.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) enum Origin {
    /// A source of the robot's own.
    Sensor(u8),
    /// Another station.
    Station(StationId),
}

impl Origin {
    /// Whether an observation of origin `other` may continue a track of this origin. A station continues its own tracks alone, and
    /// sensors continue those of all sensors.
    fn may_continue(self, other: Self) -> bool {
        matches!((self, other), (Self::Sensor(_), Self::Sensor(_))) || self == other
    }
}

/// The conduct of a person at a crossing.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "camelCase"))]
pub enum Conduct {
    /// Is somewhere else.
    Elsewhere,
    /// Is in the zone, and does not wait.
    Passing,
    /// Waits to cross.
    Waiting,
    /// Is on the road, or was when last seen.
    OnRoad,
    /// Has crossed.
    Across,
}

/// A chain of observations.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Track {
    at: Point,
    error_cm: u16,
    what: RoadUser,
    origin: Origin,
    id: Option<u32>,
    /// Time since the newest observation was made.
    unseen: Millis,
    /// Where they have stood, as far as places tell.
    stood: Point,
    /// Time left of the dwell, while they do what somebody who waits does.
    dwell: Option<Millis>,
    waits: bool,
    /// Where they stepped on the road that they are on.
    entered: Option<Point>,
    /// For how long yet they count as across.
    across: Millis,
}

impl Track {
    fn new(origin: Origin, sighting: &Sighting, age: Millis) -> Self {
        Self {
            at: sighting.at,
            error_cm: sighting.error_cm,
            what: sighting.what,
            origin,
            id: sighting.id,
            unseen: age,
            stood: sighting.at,
            dwell: None,
            waits: false,
            entered: None,
            across: Millis::ZERO,
        }
    }

    /// Where they were last.
    #[must_use]
    pub const fn at(&self) -> Point {
        self.at
    }

    /// Their kind.
    #[must_use]
    pub const fn what(&self) -> RoadUser {
        self.what
    }

    /// Whether they were observed within the last [`FRESH`].
    #[must_use]
    pub const fn is_fresh(&self) -> bool {
        self.unseen.0 <= FRESH.0
    }

    /// Whether another station reports them.
    pub(crate) const fn is_hearsay(&self) -> bool {
        matches!(self.origin, Origin::Station(_))
    }

    /// Whether they are on the road, or were when last seen.
    #[must_use]
    pub const fn is_on_road(&self) -> bool {
        self.entered.is_some()
    }

    /// Whether they may be on the crossing, or as near to it as an escort waits for its person: a body waits for nobody else.
    pub(crate) fn is_crossing(&self, setup: &Setup) -> bool {
        let error = self.error_cm.max(setup.sensors.error_cm);
        setup.is_at_crossing(self.at, error.into())
    }

    /// Whether they wait to cross.
    #[must_use]
    pub const fn waits(&self) -> bool {
        self.waits && self.is_fresh()
    }

    /// Whether they waited and have not been seen since.
    const fn is_lost_waiting(&self) -> bool {
        self.waits && !self.is_fresh()
    }

    /// Their conduct.
    #[must_use]
    pub fn conduct(&self, setup: &Setup) -> Conduct {
        if self.is_on_road() {
            Conduct::OnRoad
        } else if self.across > Millis::ZERO {
            Conduct::Across
        } else if self.waits() {
            Conduct::Waiting
        } else if setup.ground.is_zone(self.at) {
            Conduct::Passing
        } else {
            Conduct::Elsewhere
        }
    }

    /// How far somebody may be from where they were, `age` ago.
    fn reach_cm(&self, setup: &Setup, sighting: &Sighting, age: Millis) -> u32 {
        let between = self.unseen.0.abs_diff(age.0);
        let walked = u32::from(setup.sensors.speed_max_cmps).saturating_mul(between) / 1_000;
        let error = |cm: u16| u32::from(cm.max(setup.sensors.error_cm));
        walked
            .saturating_add(error(self.error_cm))
            .saturating_add(error(sighting.error_cm))
    }

    /// Whether the same source calls them something else than a sighting.
    fn has_another_id(&self, origin: Origin, sighting: &Sighting) -> bool {
        let is_known = self.id.is_some() && sighting.id.is_some();
        is_known && self.origin == origin && self.id != sighting.id
    }

    /// Takes in one more observation, made `age` ago.
    fn update(&mut self, setup: &Setup, origin: Origin, sighting: &Sighting, age: Millis) {
        // A source that lags says nothing new of somebody whom another has seen since.
        if age > self.unseen {
            return;
        }
        if !self.is_fresh() {
            self.dwell = None;
            self.stood = sighting.at;
        }
        // One that was a person once does not become a vehicle.
        if sighting.what != RoadUser::Vehicle || self.what == RoadUser::Vehicle {
            self.what = sighting.what;
        }
        (self.at, self.error_cm) = (sighting.at, sighting.error_cm);
        (self.origin, self.id, self.unseen) = (origin, sighting.id, age);
        self.walk(setup);
        self.intend(setup, sighting);
    }

    /// Follows them on the road and off it.
    fn walk(&mut self, setup: &Setup) {
        if setup.is_person_on_road(self.what, self.at, 0) {
            self.entered.get_or_insert(self.at);
        } else if let Some(entered) = self.entered.take()
            && entered.distance_cm(self.at) >= CROSSED_MIN_CM
        {
            self.across = ACROSS;
            self.waits = false;
        }
        if !setup.ground.is_zone(self.at) {
            self.across = Millis::ZERO;
        }
    }

    /// Whether they wait.
    fn intend(&mut self, setup: &Setup, sighting: &Sighting) {
        let rules = &setup.waiting;
        let velocity = sighting.velocity.unwrap_or_default();
        let is_slow = velocity.length_cm() <= u32::from(rules.speed_max_cmps);
        let is_on_foot = matches!(self.what, RoadUser::Pedestrian | RoadUser::WheelchairUser);
        let comes = is_on_foot && !self.is_on_road() && leads_to_road(setup, self.at, velocity);
        if !is_slow || self.stood.distance_cm(self.at) > sway_cm(setup) {
            // If they stand, they stand here from now on.
            self.stood = self.at;
            if !comes {
                self.dwell = None;
            }
            // A person who crosses does not wait any more.
            self.waits &= !self.is_on_road();
        }
        let may_wait = setup.ground.waiting.is_some()
            && setup.ground.is_zone(self.at)
            && self.across == Millis::ZERO
            && (is_on_foot || self.what == RoadUser::Bicyclist)
            && (self.is_on_road() || !setup.ground.is_road(self.at));
        let least = rules.confidence_min / if self.waits { 2 } else { 1 };
        if !may_wait || sighting.confidence < least {
            (self.dwell, self.waits) = (None, false);
        } else if is_slow || comes {
            let left = *self.dwell.get_or_insert(rules.dwell);
            self.waits |= left == Millis::ZERO;
        }
    }
}

/// How far somebody who stands may be from where they have stood.
fn sway_cm(setup: &Setup) -> u32 {
    let (rules, error) = (&setup.waiting, u32::from(setup.sensors.error_cm));
    error + u32::from(rules.speed_max_cmps).saturating_mul(rules.dwell.0) / 1_000
}

/// Whether somebody at a place who goes on like this is on the road soon.
fn leads_to_road(setup: &Setup, at: Point, velocity: Way) -> bool {
    let speed = velocity.length_cm();
    let walks =
        u32::from(setup.waiting.speed_max_cmps) + 1..=u32::from(setup.sensors.speed_max_cmps);
    if !walks.contains(&speed) {
        return false;
    }
    let mut ahead = 1..=setup.waiting.approach.0.min(60_000) / APPROACH_STEP_MS;
    ahead.any(|step| {
        let milliseconds = i32::try_from(step * APPROACH_STEP_MS).unwrap_or(i32::MAX);
        setup
            .ground
            .is_road(at.plus(velocity.part(milliseconds, 1_000)))
    })
}

/// The tracks of a crossing, `N` at most.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub struct Tracks<const N: usize> {
    tracks: [Option<Track>; N],
    /// A person in the zone has no track, for there are too many: they are taken to wait.
    crowd: Millis,
}

impl<const N: usize> Default for Tracks<N> {
    fn default() -> Self {
        Self {
            tracks: [None; N],
            crowd: Millis::ZERO,
        }
    }
}

impl<const N: usize> Tracks<N> {
    /// The tracks.
    pub fn iter(&self) -> impl Iterator<Item = &Track> {
        self.tracks.iter().flatten()
    }

    /// Lets time pass. While go is shown, a person who waited and is out of sight counts for longer.
    pub(crate) fn elapse(&mut self, setup: &Setup, time: Millis, shows_go: bool) {
        let kept = setup.waiting.clear.max(FRESH);
        self.crowd = self.crowd.saturating_sub(time);
        for slot in &mut self.tracks {
            let Some(track) = slot else { continue };
            // An age beyond any limit stays there.
            let oldest = kept.saturating_add(Millis(1));
            track.unseen = track.unseen.saturating_add(time).min(oldest);
            track.across = track.across.saturating_sub(time);
            track.dwell = track.dwell.map(|left| left.saturating_sub(time));
            let is_unresolved =
                track.is_on_road() || track.is_lost_waiting() && shows_go && track.unseen <= kept;
            if !track.is_fresh() && !is_unresolved {
                *slot = None;
            }
        }
    }

    /// Takes in what was seen `age` ago. Calls `person` for each who is no vehicle, or was none before.
    pub(crate) fn observe(
        &mut self,
        setup: &Setup,
        origin: Origin,
        age: Millis,
        sightings: &[Sighting],
        mut person: impl FnMut(&Sighting),
    ) {
        let mut taken = [false; N];
        // Two people of a frame may have one number: neither has the track that the other one begins.
        let before = self.clone();
        // A sighting that keeps its id goes first; the others continue the nearest track that is left.
        for by_id in [true, false] {
            for sighting in sightings {
                let own = before.with_id(setup, origin, age, sighting);
                if own.is_some() != by_id {
                    continue;
                }
                let found = match own.filter(|place| !taken[*place]) {
                    Some(place) => Some(place),
                    None => self.nearest(setup, origin, age, sighting, &taken),
                };
                let free = || self.tracks.iter().position(Option::is_none);
                let place = found.or_else(free);
                let place = place.or_else(|| self.spare(setup, origin, sighting.at));
                let mut seen = *sighting;
                if let Some(place) = place {
                    taken[place] = true;
                    if found.is_none() {
                        self.tracks[place] = None;
                    }
                    let track =
                        self.tracks[place].get_or_insert_with(|| Track::new(origin, sighting, age));
                    if sighting.what == RoadUser::Vehicle {
                        seen.what = track.what;
                    }
                    track.update(setup, origin, sighting, age);
                } else if seen.what != RoadUser::Vehicle && setup.ground.is_zone(seen.at) {
                    self.crowd = FRESH;
                }
                if seen.what != RoadUser::Vehicle {
                    person(&seen);
                }
            }
        }
    }

    /// The track that has the id of a sighting, and is within its reach.
    fn with_id(
        &self,
        setup: &Setup,
        origin: Origin,
        age: Millis,
        sighting: &Sighting,
    ) -> Option<usize> {
        let is_same = |track: &Track| {
            sighting.id.is_some()
                && (track.origin, track.id) == (origin, sighting.id)
                && track.at.distance_cm(sighting.at) <= track.reach_cm(setup, sighting, age)
        };
        let places = self.tracks.iter().enumerate();
        let same = places.filter_map(|(place, slot)| Some((place, slot.as_ref()?)));
        // An id that jumped stands for two people: the newer one has it.
        same.filter(|(_, track)| is_same(track))
            .min_by_key(|(_, track)| track.unseen)
            .map(|(place, _)| place)
    }

    /// The track to replace where there are too many: of somebody elsewhere; of a person who was lost on the road, for occupancy decides
    /// whether it is clear, where there are sensors; and, for somebody in the zone whom the robot sees itself, of those whom others report.
    fn spare(&self, setup: &Setup, origin: Origin, at: Point) -> Option<usize> {
        let takes_hearsay = matches!(origin, Origin::Sensor(_)) && setup.ground.is_zone(at);
        let rank = |track: &Track| {
            if !track.is_on_road() && !setup.ground.is_zone(track.at) {
                Some(0)
            } else if track.is_on_road() && !track.is_fresh() {
                Some(1)
            } else {
                let gives_way = takes_hearsay && track.is_hearsay();
                gives_way.then(|| 2 + u8::from(track.is_on_road()))
            }
        };
        let places = self.tracks.iter().enumerate();
        let ranked = places.filter_map(|(place, slot)| Some((rank(slot.as_ref()?)?, place)));
        ranked.min().map(|(_, place)| place)
    }

    /// The nearest free track within the reach of a sighting.
    fn nearest(
        &self,
        setup: &Setup,
        origin: Origin,
        age: Millis,
        sighting: &Sighting,
        taken: &[bool; N],
    ) -> Option<usize> {
        let tracks = self.tracks.iter().zip(taken).enumerate();
        let free = tracks
            .filter_map(|(place, (slot, taken))| Some((place, slot.as_ref().filter(|_| !taken)?)));
        // A vehicle beside a person who is out of sight is not that person.
        let is_vehicle = |what| what == RoadUser::Vehicle;
        let free = free.filter(|(_, track)| !is_vehicle(sighting.what) || is_vehicle(track.what));
        let free = free.filter(|(_, track)| track.origin.may_continue(origin));
        let near = free.filter_map(|(place, track)| {
            let distance = track.at.distance_cm(sighting.at);
            let is_renamed = track.has_another_id(origin, sighting);
            let sway = if is_renamed { sway_cm(setup) } else { u32::MAX };
            let reach = track.reach_cm(setup, sighting, age).min(sway);
            (distance <= reach).then_some((distance, place))
        });
        near.min().map(|(_, place)| place)
    }

    /// The road is empty: the people who were lost on it are off it. Where a part of it is not in sight, these are the ones whom the
    /// robot saw itself.
    pub(crate) fn resolve(&mut self, is_covered: bool) {
        let is_off = |it: Track| {
            let is_known = is_covered || !it.is_hearsay();
            is_known && it.is_on_road() && !it.is_fresh()
        };
        for slot in &mut self.tracks {
            if slot.is_some_and(is_off) {
                *slot = None;
            }
        }
    }

    /// Whether somebody waits, or waited when go was shown and has not been seen since.
    #[must_use]
    pub fn is_waiting(&self) -> bool {
        // The occupancy judges about people who were lost on the road, once nobody is let on it any more.
        let waits = |track: &Track| track.waits && (track.is_fresh() || !track.is_on_road());
        self.crowd > Millis::ZERO || self.iter().any(waits)
    }

    /// Whether somebody waited and has not been seen since, or there are more people than can be told apart.
    #[must_use]
    pub fn is_somebody_lost(&self) -> bool {
        let is_lost = |track: &Track| track.is_lost_waiting() && !track.is_on_road();
        self.crowd > Millis::ZERO || self.iter().any(is_lost)
    }

    /// Whether somebody was on the road when last seen.
    #[must_use]
    pub fn is_on_road(&self) -> bool {
        self.iter().any(Track::is_on_road)
    }

    /// How urgently somebody waits to cross; `None` when nobody does.
    #[must_use]
    pub fn urgency(&self) -> Option<Urgency> {
        let urgency = |track: &Track| match track.what {
            _ if track.is_on_road() => Urgency::Emergency,
            RoadUser::WheelchairUser => Urgency::High,
            _ => Urgency::Medium,
        };
        let waiting = self.iter().filter(|track| track.waits()).map(urgency).max();
        let crowd = (self.crowd > Millis::ZERO).then_some(Urgency::Medium);
        waiting.max(crowd)
    }

    /// The mean place of the people who wait.
    #[must_use]
    pub fn middle(&self) -> Option<Point> {
        let (mut sum, mut count) = ((0_i64, 0_i64), 0_i64);
        for track in self.iter().filter(|track| track.waits()) {
            sum.0 += i64::from(track.at.east_cm());
            sum.1 += i64::from(track.at.north_cm());
            count += 1;
        }
        let mean = |sum: i64| i32::try_from(sum / count).unwrap_or_default();
        (count > 0).then(|| Point::new(mean(sum.0), mean(sum.1)))
    }
}
