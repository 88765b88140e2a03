//! Inputs of the crossing machine from a robot: its body, its sensors, a simulated street, and other stations.

use std::borrow::Cow;
use std::collections::BTreeMap;

use crossguard_codec::security::Rejected;
use crossguard_codec::{Identity, Kind, Position, TaskParameters};
use crossguard_crossing::{
    BodyReport, Coverage, Frame, FrameDrop, Input, Point, Pose, RoadUser, Sighting, Vehicle, Way,
    traffic,
};
use crossguard_endpoint::Moment;
use crossguard_endpoint::cause::Cause;
use crossguard_endpoint::ras::clustering::PerceivedVru;
use crossguard_endpoint::ras::motion::degrees;
use crossguard_endpoint::station::{LocalDynamicMap, MEASURED_MS, Neighbour};
use crossguard_protocol::{Millis, Phase, Robot, StationId};

use super::{Application, Conduct};
use crate::body::Report;
use crate::perception::{Perceived, SensorFrame};
use crate::sight::{Seen, SeenVehicle, Sight, VEHICLES_MAX};
use crate::street::Road;
use crate::zone::{metres_per_second, place, point, sighting, velocity};

/// Shortest time between two sights in which as many people are on the road, in seconds of the robot's own time.
const SIGHT_PERIOD_S: f64 = 0.2;

/// Length of a way in the direction of a vehicle, in metres: long enough to tell directions apart by whole centimetres.
const DIRECTION_M: f64 = 1e3;

/// Vulnerable road users who ride, by ETSI: `TrafficParticipantType` of TS 102 894-2. The last two are no slower than cars.
const CYCLIST: u8 = 2;
const MOPED: u8 = 3;
const MOTORCYCLE: u8 = 4;

/// Error of a vehicle's place that its message does not say, in centimetres.
const UNSAID_ERROR_CM: u16 = 1_000;

/// A vehicle that was not heard says again within this time where it is (CAM, EN 302 637-2, `T_GenCamMax`).
const SAYS_AGAIN: Millis = Millis(1_000);

/// The sources of people who come one by one, and of vehicles that are heard.
const ONE_BY_ONE: u8 = u8::MAX;
const HEARD: u8 = u8::MAX - 1;

/// Frames of one source whose times differ by no more are one, in ms: its time was read off two clocks, one after the other.
const SAME_MS: i64 = 2;

/// For how long a sight has somebody who came in no newer frame, and a vehicle after its last message, which may be a
/// second apart, in seconds.
const SEEN_S: f64 = 1.0;
const HEARD_S: f64 = 1.5;

/// Most road users who come alone that a sight is made of, however fast somebody sends messages with ever new ids.
const ALONE_MAX: usize = 256;

/// A road user as a sensor source had it in its newest frame, or as it said itself.
#[derive(Clone, Copy, Debug)]
struct Observed {
    source: u8,
    /// When they were seen there, in seconds.
    at_s: f64,
    sighting: Sighting,
}

impl Observed {
    fn is_there(&self, now_s: f64) -> bool {
        let stays_s = if self.source == HEARD {
            HEARD_S
        } else {
            SEEN_S
        };
        now_s - self.at_s <= stays_s
    }
}

/// The last reports of road users.
#[derive(Debug, Default)]
pub(super) struct Said {
    /// The road users in the newest frames and messages. A log is judged by them, so the robot's own conclusions play
    /// no part.
    observed: Vec<Observed>,
    /// When each source made its newest frame, in seconds.
    newest_s: BTreeMap<u8, f64>,
    /// When each source made its newest frame, as it says and at the latest, in ms.
    looked_ms: BTreeMap<u8, (i64, i64)>,
    /// When, in seconds.
    last: Option<(f64, Sight)>,
    /// Whether the sign showed go then.
    go: bool,
    /// When each follower's position was heard last, on the robot's clock in ms.
    heard_ms: BTreeMap<StationId, u64>,
}

impl Application {
    /// The sensors of the robot with this station id have somebody, at a place on the site, now: that adds them, and takes away
    /// nobody but people that they told of before. Somebody who comes like a vehicle hinders like one.
    pub fn perceive(&mut self, station: StationId, vru: &PerceivedVru) {
        // In a simulation there is nobody else.
        if matches!(self.road, Road::Known(_)) {
            return;
        }
        let seen = sighting(vru, 0.0);
        self.observe_one(ONE_BY_ONE, seen);
        if traffic::rides(&self.setup, &seen) {
            let vehicle = traffic::seen(&self.setup, 1 << 59 | u64::from(vru.id), &seen);
            self.step(Input::Vehicle(vehicle, Millis::ZERO));
        }
        self.step(Input::Heard(station, seen, Millis::ZERO));
    }

    /// Takes in a road user who comes alone, in place of what was known of the same.
    fn observe_one(&mut self, source: u8, seen: Sighting) {
        let is_same = |it: &Observed| it.source == source && it.sighting.id == seen.id;
        let of_source = |it: &Observed| it.source == source;
        let observed = &mut self.said.observed;
        let is_full = observed.iter().filter(|it| of_source(it)).count() >= ALONE_MAX;
        // The oldest stand first.
        let replaced = observed.iter().position(is_same);
        let replaced = replaced.or_else(|| observed.iter().position(of_source).filter(|_| is_full));
        if let Some(place) = replaced {
            observed.remove(place);
        }
        self.observe(source, self.at_s, &[seen]);
    }

    fn observe(&mut self, source: u8, at_s: f64, sightings: &[Sighting]) {
        let now_s = self.at_s;
        self.said.observed.retain(|it| it.is_there(now_s));
        let observed = sightings.iter().map(|sighting| Observed {
            source,
            at_s,
            sighting: *sighting,
        });
        self.said.observed.extend(observed);
    }

    /// Takes in the road users of a frame that was made `age` ago, unless a newer one of its source came before.
    fn observe_frame(&mut self, source: u8, age: Millis, sightings: &[Sighting]) {
        let at_s = self.at_s - f64::from(age.0) / 1e3;
        let newest_s = self.said.newest_s.entry(source).or_insert(at_s);
        if at_s < *newest_s {
            return;
        }
        *newest_s = at_s;
        self.said.observed.retain(|it| it.source != source);
        self.observe(source, at_s, sightings);
    }

    /// A sensor source delivered a frame at `now_s` that it made at `taken_ms`, on the same clock; below 0, before that began. Time
    /// comes first, and both are whole milliseconds: a frame that is repeated is no newer than it was, also one of a source whose
    /// clock is a little ahead.
    pub fn look_at(&mut self, now_s: f64, frame: &SensorFrame, taken_ms: i64) {
        self.advance(now_s);
        let read_ms = self.at_ms.cast_signed();
        let newest = self.said.looked_ms.entry(frame.source);
        let (named, looked) = newest.or_insert((i64::MIN, i64::MIN));
        if taken_ms > named.saturating_add(SAME_MS) {
            (*named, *looked) = (taken_ms, taken_ms.min(read_ms));
        }
        let age_ms = read_ms.saturating_sub(taken_ms.min(*looked));
        self.look(frame, Millis(u32::try_from(age_ms).unwrap_or(u32::MAX)));
    }

    /// A sensor source delivered a frame that it made `age` before the time that was told last.
    /// A robot without a zone takes its road users as reports of another station: the frame adds people, and clears no road.
    pub fn look(&mut self, frame: &SensorFrame, age: Millis) {
        // In a simulation there is nobody else.
        if matches!(self.road, Road::Known(_)) {
            return;
        }
        let seen: Vec<_> = frame.people.iter().map(Perceived::sighting).collect();
        let Road::Watched(zone) = &self.road else {
            // Apart from the source that a simulated street is.
            self.observe_frame(frame.source | 1 << 6, age, &seen);
            self.trouble(Cause::FrameDropped("no zone"), "a frame", 1);
            for (Perceived { vru, .. }, seen) in frame.people.iter().zip(&seen) {
                if traffic::rides(&self.setup, seen) {
                    let key = 1 << 60 | u64::from(frame.source) << 32 | u64::from(vru.id);
                    let vehicle = traffic::seen(&self.setup, key, seen);
                    self.step(Input::Vehicle(vehicle, age));
                }
                self.step(Input::Heard(StationId(0), *seen, age));
            }
            return;
        };
        let covers = zone.covered(frame.covers.as_ref());
        self.observe_frame(frame.source, age, &seen);
        self.step(Input::Frame(Frame {
            source: frame.source,
            age,
            covers,
            sightings: &seen,
        }));
    }

    /// A sensor source delivered something that is no frame, for this reason.
    pub fn look_in_vain(&mut self, why: impl Into<Cow<'static, str>>) {
        self.trouble(Cause::FrameDropped(FrameDrop::Malformed.name()), why, 1);
        self.step(Input::BadFrame);
    }

    /// Looks at the simulated street, if there is one that it counts on.
    pub(super) fn look_at_street(&mut self) {
        let street = match &self.road {
            Road::Known(street) => street,
            Road::Own(street) => {
                let shown = super::micros(self.at_s);
                street.look(shown, self.sign.shows_go(shown));
                if !self.counts {
                    return;
                }
                street
            }
            Road::Unknown | Road::Heard(_) | Road::Watched(_) => return,
        };
        let seen = street.sightings();
        self.observe_frame(0, Millis::ZERO, &seen);
        self.step(Input::Frame(Frame {
            source: 0,
            age: Millis::ZERO,
            covers: Coverage::ALL,
            sightings: &seen,
        }));
    }

    /// Takes in where the body is, and whether a fallback moves it.
    pub(super) fn feel_body(&mut self) {
        let pose = self.pose(&self.body.state().position);
        self.step(Input::Pose(pose, Millis::ZERO));
        self.step(Input::BodyIsFree(self.is_body_free()));
    }

    /// Takes in how the maneuver of the body goes.
    pub(super) fn feel_maneuver(&mut self, report: &Report) {
        let report = match *report {
            Report::InPosition(id) => BodyReport::InPosition(id),
            Report::Completed(id) => BodyReport::Completed(id),
            Report::Silent(_) => BodyReport::Gone,
            _ => return,
        };
        self.step(Input::Body(report));
    }

    pub(super) fn pose(&self, position: &Position) -> Option<Pose> {
        Some(Pose {
            at: self.at_point(position)?,
            error_cm: error_cm(position),
        })
    }

    fn at_point(&self, position: &Position) -> Option<Point> {
        let [latitude, longitude] = degrees(position)?;
        Some(point(self.site.place(latitude, longitude)))
    }

    /// Where a command leads, if it says that.
    pub(super) fn target(&self, parameters: &TaskParameters) -> Option<Point> {
        self.site.place_of(parameters.target).map(point)
    }

    /// Takes in what was heard of others at this moment: its followers, vehicles, and people.
    pub fn listen(&mut self, map: &LocalDynamicMap, robot: &Robot, moment: Moment) {
        let now_ms = moment.now_ms;
        if let Phase::Leading(leading) = robot.phase() {
            for member in leading.members.iter() {
                let known = map.get(Identity::Station(member.station.0));
                if let Some(known) = known {
                    let (pose, age) = (self.pose(&known.user.position), age(known, now_ms));
                    let is_new = self.said.heard_ms.insert(member.station, known.heard_ms)
                        != Some(known.heard_ms);
                    if is_new {
                        self.step(Input::FollowerAt(member.station, pose, age));
                    }
                }
            }
        }
        let is_news = |known: &&Neighbour| known.heard_ms == now_ms;
        for known in map.iter().filter(is_news) {
            if self.rides(known) {
                self.hear_vehicle(known, moment);
            }
        }
        if !matches!(self.road, Road::Known(_)) {
            for known in map.of_kind(Kind::Vru).filter(is_news) {
                self.hear_person(known);
            }
            self.hear_objects(map, now_ms);
        }
    }

    /// Whether somebody comes like a vehicle: may be one, a moped or a motorcycle, or is faster than people walk, whatever it is.
    fn rides(&self, known: &Neighbour) -> bool {
        let user = &known.user;
        let is_rider = matches!(user.station_type, Some(MOPED | MOTORCYCLE));
        match user.kind {
            Kind::Vehicle => true,
            Kind::Vru if is_rider => true,
            Kind::Vru | Kind::Object | Kind::Robot => known.is_either || self.is_fast(known),
            Kind::RoadSideUnit => false,
        }
    }

    /// Whether somebody is faster than people walk.
    pub(super) fn is_fast(&self, known: &Neighbour) -> bool {
        let walks_mps = f64::from(self.setup.sensors.speed_max_cmps) / 100.0;
        known.user.speed.is_some_and(|mps| mps > walks_mps)
    }

    fn hear_vehicle(&mut self, known: &Neighbour, moment: Moment) {
        let user = &known.user;
        let Some(at) = self.at_point(&user.position) else {
            return;
        };
        let speed = user.speed.map(|mps| velocity([mps, 0.0]).length_cm());
        let direction = user.heading.map(|heading| {
            let (east, north) = heading.to_radians().sin_cos();
            velocity([DIRECTION_M * east, DIRECTION_M * north])
        });
        let velocity = traffic::velocity(&self.setup, at, speed, direction);
        let seen = heard(known, at, RoadUser::Vehicle, Some(velocity));
        self.observe_one(HEARD, seen);
        let error_cm = match user.position.ellipse {
            Some(_) => seen.error_cm,
            None => UNSAID_ERROR_CM,
        };
        let length_cm = traffic::length_cm(&self.setup, user.length.map(centimetres));
        // A CAM says where the front is, a CPM where the middle of the bounding box (`PerceivedObject`, TS 102 894-2). The rear
        // of a vehicle that may back comes first.
        let front_cm = match user.identity {
            _ if user.kind == Kind::Vehicle && user.heading.is_none() => length_cm,
            Identity::Station(_) => 0,
            _ => length_cm / 2,
        };
        let vehicle = Vehicle {
            key: match user.identity {
                Identity::Station(id) => id.into(),
                Identity::Object { by, number } => {
                    1 << 62 | u64::from(by) << 16 | u64::from(number)
                }
                Identity::Unnumbered { by, place } => {
                    1 << 61 | u64::from(by) << 16 | u64::from(place)
                }
            },
            station: match user.identity {
                Identity::Station(id) => Some(StationId(id)),
                _ => None,
            },
            at,
            front_cm,
            length_cm,
            error_cm,
            velocity,
            goes_anywhere: direction.is_none(),
        };
        self.step(Input::Vehicle(vehicle, measured_ago(known, moment)));
    }

    /// A packet was dropped for this cause. Where there were too many, a vehicle may come that was not heard. Packets wait too long
    /// for a robot that was held up for a moment: that keeps go from beginning until vehicles have said again where they are, and
    /// takes none away that its lease still covers.
    pub(crate) fn miss(&mut self, cause: Cause) {
        let is_go = self.crossing.shows_go() > Millis::ZERO;
        let time = match cause {
            Cause::SocketFull | Cause::InboxFull => self.setup.traffic.keep,
            Cause::Rejected(why) if why == Rejected::TooManyNew.cause() => self.setup.traffic.keep,
            Cause::WaitedTooLong if !is_go => SAYS_AGAIN,
            _ => return,
        };
        self.step(Input::Missed(time));
    }

    fn hear_person(&mut self, known: &Neighbour) {
        let Some(at) = self.at_point(&known.user.position) else {
            return;
        };
        let what = match known.user.station_type {
            Some(CYCLIST) => RoadUser::Bicyclist,
            Some(MOPED | MOTORCYCLE) => RoadUser::Motorcyclist,
            _ => RoadUser::Pedestrian,
        };
        let seen = heard(known, at, what, None);
        let by = reporter(known.user.identity);
        self.step(Input::Heard(StationId(by), seen, Millis::ZERO));
    }

    /// The road users that the robot senses or hears now, if they have changed since the last sight. A sight is due after a
    /// period, when the number of people on the road changes, and when the sign begins to show go.
    pub fn next_sight(&mut self) -> Option<Sight> {
        let now_s = self.at_s;
        let shows_go = self.sign.shows_go(super::micros(now_s));
        let begins = !std::mem::replace(&mut self.said.go, shows_go) && shows_go;
        let period_s = SIGHT_PERIOD_S / self.time_scale();
        let is_early = |(said_s, said): &(f64, Sight)| {
            now_s - said_s < period_s && said.on_road() == self.on_road()
        };
        if !begins && self.said.last.as_ref().is_some_and(is_early) {
            return None;
        }
        let people = self.observed().map(|(sighting, conduct)| Seen {
            place: self.site.coordinates(place(sighting.at)),
            class: sighting.what,
            conduct,
        });
        let vehicles = self.there().filter(|it| it.what == RoadUser::Vehicle);
        let vehicles = vehicles.map(|sighting| SeenVehicle {
            place: self.site.coordinates(place(sighting.at)),
            velocity: sighting.velocity.map(metres_per_second),
        });
        let sight = Sight {
            people: people.collect(),
            vehicles: vehicles.take(VEHICLES_MAX).collect(),
        };
        let nobody = Sight::default();
        let said = self.said.last.as_ref().map_or(&nobody, |(_, said)| said);
        let is_new = *said != sight;
        is_new.then(|| {
            self.said.last = Some((now_s, sight.clone()));
            sight
        })
    }

    /// The road users in the newest frames and messages.
    fn there(&self) -> impl Iterator<Item = &Sighting> {
        let observed = self.said.observed.iter();
        let there = observed.filter(|it| it.is_there(self.at_s));
        there.map(|it| &it.sighting)
    }

    /// The people among them, each with the conduct that the robot takes it for.
    fn observed(&self) -> impl Iterator<Item = (&Sighting, Conduct)> {
        let people = self.there().filter(|it| it.what != RoadUser::Vehicle);
        people.map(|sighting| {
            let mut tracks = self.crossing.tracks().iter();
            let track = tracks.find(|track| track.at() == sighting.at && track.is_fresh());
            let conduct = track.map_or(Conduct::Elsewhere, |track| track.conduct(&self.setup));
            (sighting, conduct)
        })
    }

    /// How many people the sensors have on the road now.
    fn on_road(&self) -> usize {
        let observed = self.observed();
        observed
            .filter(|(_, conduct)| *conduct == Conduct::OnRoad)
            .count()
    }
}

/// A road user whose own message says where it is.
fn heard(known: &Neighbour, at: Point, what: RoadUser, velocity: Option<Way>) -> Sighting {
    Sighting {
        id: Some(key(known.user.identity)),
        at,
        error_cm: error_cm(&known.user.position),
        velocity,
        what,
        confidence: 100,
    }
}

/// Error of a position, in centimetres.
fn error_cm(position: &Position) -> u16 {
    centimetres(position.error_m())
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "casts of numbers saturate"
)]
fn centimetres(metres: f64) -> u16 {
    (metres * 100.0).ceil() as u16
}

/// How long before this moment somebody was measured, as their message says. A report that seems older than an object of a CPM can be
/// is of a station whose wall clock is another one than the robot's.
fn measured_ago(known: &Neighbour, moment: Moment) -> Millis {
    let ago_ms = moment.timestamp_its.saturating_sub(known.user.measured_its);
    Millis(u32::try_from(ago_ms.min(MEASURED_MS)).unwrap_or(u32::MAX))
}

/// The station that reports somebody, itself perhaps.
pub(super) const fn reporter(identity: Identity) -> u32 {
    let (Identity::Station(by) | Identity::Object { by, .. } | Identity::Unnumbered { by, .. }) =
        identity;
    by
}

/// How long ago somebody was heard.
pub(super) fn age(known: &Neighbour, now_ms: u64) -> Millis {
    Millis(u32::try_from(now_ms.saturating_sub(known.heard_ms)).unwrap_or(u32::MAX))
}

/// Number by which a road user is known.
fn key(identity: Identity) -> u32 {
    match identity {
        Identity::Station(id) => id,
        Identity::Object { by, number } => by.rotate_left(16) ^ u32::from(number) ^ 1 << 31,
        Identity::Unnumbered { by, place } => by.rotate_left(16) ^ u32::from(place) ^ 1 << 30,
    }
}
