//! A run at one time.

use crossguard_endpoint::counters::CauseName;
use crossguard_model_check::names::Names;
use crossguard_protocol::{State, StationId, TaskType};
use crossguard_robot::zone::Conduct;
use serde::Serialize;

use super::messages::{MessageRow, Rows};
use super::tracks::Track;
use super::{Metres, Playback};

/// For how long a robot's way is shown, in µs, and its most points.
const TRAIL_US: u64 = 10_000_000;
const TRAIL_MAX: usize = 120;

/// How many people of a robot are shown.
const PEOPLE_MAX: usize = 300;

/// How many rows of messages are given before the time and after it.
const ROWS: [usize; 2] = [80, 40];

/// How many moments a saved run has between those at which something was said, how many at most, and how many rows.
const SAVED_STEPS: u64 = 500;
const SAVED_MOMENTS_MAX: usize = 2_000;
const SAVED_ROWS_MAX: usize = 20_000;

/// A run for a page without a server: the moments at which something was said and others between them,
/// and all messages and notes, without RAM that repeat what is known.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct SavedRun {
    moments: Vec<SavedMoment>,
    rows: Vec<MessageRow>,
    /// How many there are for which a page has no room.
    pub rows_left_out: usize,
}

/// The robots at one time.
#[derive(Debug, Serialize)]
struct SavedMoment {
    at: u64,
    robots: Vec<RobotMoment>,
}

/// A stretch of a run, in µs since its first record.
#[derive(Clone, Copy, Debug)]
pub struct Stretch {
    /// Its first moment.
    pub from: u64,
    /// Its last moment.
    pub to: u64,
}

/// A run at one time.
#[derive(Debug, Serialize)]
pub struct Moment {
    /// The time, in µs since the first record.
    pub at: u64,
    /// The robots, in the order of the overview.
    pub robots: Vec<RobotMoment>,
    /// The messages and notes next to the time.
    pub messages: Rows,
}

/// A robot at one time.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct RobotMoment {
    /// Whether it has booted and not stopped.
    pub is_running: bool,
    /// Its station id.
    pub station: Option<StationId>,
    /// Its state in the paper's model.
    pub state: Option<State>,
    /// Its role.
    pub role: String,
    /// The session that it has a part in.
    pub session: String,
    /// The task that it executes.
    pub executes: String,
    /// Its duty on the road.
    pub duty: String,
    /// Whether it is available, and if not, why.
    pub availability: String,
    /// The followers of a leader, each in a few words.
    pub followers: Vec<FollowerMoment>,
    /// The armed timers: name, and the milliseconds that it has left.
    pub timers: Vec<(String, u64)>,
    /// For how many milliseconds its sign goes on to show go, and for how many it was told to; `None` where it shows
    /// stop.
    pub sign: Option<[u64; 2]>,
    /// Where its body is.
    pub body: Option<BodyMoment>,
    /// Where it was in the seconds before.
    pub trail: Vec<Metres>,
    /// The people that its sensors have seen.
    pub people: Vec<PersonMoment>,
    /// The vehicles that it has seen or heard.
    pub vehicles: Vec<VehicleMoment>,
    /// The people that its RAM announces as one.
    pub cluster: Option<ClusterMoment>,
    /// Where its followers are to be.
    pub areas: Vec<AreaMoment>,
    /// How many messages and inputs had no effect so far, by the causes of the overview.
    pub drops: Vec<u64>,
}

/// A follower, as its leader knows it.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct FollowerMoment {
    /// The follower.
    pub station: StationId,
    /// Its task and how far it is with it; empty before its first command.
    pub task: String,
    /// Whether the lease on it stands.
    pub has_lease: bool,
}

/// A body.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct BodyMoment {
    /// Its middle.
    pub place: Metres,
    /// Degrees clockwise from north.
    pub heading: Option<f64>,
    /// m/s.
    pub speed: Option<f64>,
    /// Metres along the body.
    pub length: Option<f64>,
    /// Metres across it.
    pub width: Option<f64>,
    /// How long ago its RAM said so, in ms.
    pub age_ms: u64,
}

/// A road user.
#[derive(Debug, Serialize)]
pub struct PersonMoment {
    /// Where.
    pub place: Metres,
    /// Its conduct at the crossing.
    pub conduct: Conduct,
}

/// A vehicle.
#[derive(Debug, Serialize)]
pub struct VehicleMoment {
    /// Where.
    pub place: Metres,
    /// m/s to the east and to the north, where it is known.
    pub velocity: Option<[f64; 2]>,
}

/// People who are announced as one.
#[derive(Debug, Serialize)]
pub struct ClusterMoment {
    /// How many.
    pub count: u8,
    /// Corners of the area around them.
    pub corners: Vec<Metres>,
}

/// Where a follower is to be.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct AreaMoment {
    /// Its task.
    pub task: String,
    /// The follower.
    pub follower: StationId,
    /// Whether people are escorted along the way to it.
    pub is_escort: bool,
    /// Where it stood when it was commanded.
    pub from: Option<Metres>,
    /// Where it is to be.
    pub to: Metres,
}

impl Playback {
    /// The run at a time, with the messages of a stretch of it; RAM that repeat what is known only if they are wanted.
    #[must_use]
    pub fn moment(&self, at: u64, span: Option<Stretch>, with_repeats: bool) -> Moment {
        let absolute = |since: u64| self.from_us.saturating_add(since);
        let at_us = absolute(at).min(self.to_us);
        let span = span.map_or((self.from_us, self.to_us), |span| {
            (absolute(span.from), absolute(span.to))
        });
        let messages = self
            .messages
            .around(at_us, self.from_us, span, ROWS, with_repeats);
        let causes = self.causes();
        let robots = self.robots.iter();
        Moment {
            at: self.since(at_us),
            robots: robots.map(|it| self.robot_at(it, at_us, &causes)).collect(),
            messages,
        }
    }

    /// The run for a page without a server.
    #[must_use]
    pub fn saved(&self) -> SavedRun {
        let whole = (self.from_us, self.to_us);
        let mut rows = (self.messages)
            .around(self.to_us, self.from_us, whole, [usize::MAX, 0], false)
            .rows;
        let rows_left_out = rows.len().saturating_sub(SAVED_ROWS_MAX);
        rows.truncate(SAVED_ROWS_MAX);
        let lasted = self.since(self.to_us);
        let step = usize::try_from(lasted / SAVED_STEPS + 1).unwrap_or(usize::MAX);
        let mut times: Vec<u64> = (0..=lasted).step_by(step).collect();
        times.extend(rows.iter().map(|row| row.at));
        times.push(lasted);
        times.sort_unstable();
        times.dedup();
        let step = times.len().div_ceil(SAVED_MOMENTS_MAX).max(1);
        let causes = self.causes();
        let moment = |at: u64| SavedMoment {
            at,
            robots: (self.robots.iter())
                .map(|it| self.robot_at(it, self.from_us.saturating_add(at), &causes))
                .collect(),
        };
        SavedRun {
            moments: times.into_iter().step_by(step).map(moment).collect(),
            rows,
            rows_left_out,
        }
    }

    fn robot_at(&self, track: &Track, at_us: u64, causes: &[&CauseName]) -> RobotMoment {
        let is_running = track.is_running.at(at_us).is_some_and(|(_, it)| *it);
        let view = track.views.at(at_us).map(|(_, view)| view);
        let text = |text: Option<String>| text.unwrap_or_default();
        let count = |cause: &&CauseName| {
            let series = track.drops.get(*cause).and_then(|it| it.at(at_us));
            series.map_or(0, |(_, count)| *count)
        };
        let names = &self.messages.names;
        RobotMoment {
            is_running,
            station: view.map(|view| view.station),
            state: view.map(|view| view.state),
            role: text(view.map(|view| view.role.to_string())),
            session: text(view.and_then(|view| Some(names.tell(view.session?)))),
            executes: text(view.and_then(|view| Some(view.executes?.to_string()))),
            duty: text(view.map(|view| names.tell(&view.duty))),
            availability: text(view.map(|view| view.availability.clone())),
            followers: view.map_or_else(Vec::new, followers),
            timers: timers(names, track, at_us),
            sign: sign(track, at_us).filter(|_| is_running),
            body: self.body(track, at_us),
            trail: self.trail(track, at_us),
            people: self.people(track, at_us),
            vehicles: self.vehicles(track, at_us),
            cluster: self.cluster(track, at_us),
            areas: self.areas(track, at_us),
            drops: causes.iter().map(count).collect(),
        }
    }

    fn body(&self, track: &Track, at_us: u64) -> Option<BodyMoment> {
        let (since_us, placed) = track.places.at(at_us)?;
        Some(BodyMoment {
            place: self.metres(placed.degrees()),
            heading: placed.heading,
            speed: placed.speed,
            length: placed.dimensions.length,
            width: placed.dimensions.width,
            age_ms: (at_us - since_us) / 1_000,
        })
    }

    fn trail(&self, track: &Track, at_us: u64) -> Vec<Metres> {
        let places = track
            .places
            .within(at_us.saturating_sub(TRAIL_US).max(self.from_us), at_us);
        let step = places.len().div_ceil(TRAIL_MAX).max(1);
        let mut trail: Vec<_> = places.iter().step_by(step).collect();
        trail.extend(places.last());
        let mut trail: Vec<_> = trail
            .into_iter()
            .map(|(_, placed)| self.metres(placed.degrees()))
            .collect();
        trail.dedup();
        trail
    }

    fn people(&self, track: &Track, at_us: u64) -> Vec<PersonMoment> {
        let sight = track.sights.at(at_us);
        let people = sight.map_or(&[][..], |(_, sight)| &sight.people);
        let shown = people.iter().take(PEOPLE_MAX);
        shown
            .map(|seen| PersonMoment {
                place: self.metres(seen.place),
                conduct: seen.conduct,
            })
            .collect()
    }

    fn vehicles(&self, track: &Track, at_us: u64) -> Vec<VehicleMoment> {
        let sight = track.sights.at(at_us);
        let vehicles = sight.map_or(&[][..], |(_, sight)| &sight.vehicles);
        let shown = vehicles.iter().map(|seen| VehicleMoment {
            place: self.metres(seen.place),
            velocity: seen.velocity,
        });
        shown.collect()
    }

    fn cluster(&self, track: &Track, at_us: u64) -> Option<ClusterMoment> {
        let cluster = track.clusters.at(at_us)?.1.as_ref()?;
        let corners = cluster.corners.iter();
        Some(ClusterMoment {
            count: cluster.cardinality,
            corners: corners.map(|corner| self.metres(*corner)).collect(),
        })
    }

    fn areas(&self, track: &Track, at_us: u64) -> Vec<AreaMoment> {
        let areas = track.areas.at(at_us).map_or(&[][..], |(_, areas)| areas);
        let shown = areas.iter().map(|area| AreaMoment {
            task: area.task.to_string(),
            follower: area.follower,
            is_escort: area.task == TaskType::MOVE,
            from: area.from.map(|from| self.metres(from)),
            to: self.metres(area.to),
        });
        shown.collect()
    }
}

fn followers(view: &crate::facts::View) -> Vec<FollowerMoment> {
    let followers = view.followers.iter().map(|follower| {
        let task = follower.task.map(|task| task.to_string());
        let words = [task.unwrap_or_default(), follower.progress.clone()];
        FollowerMoment {
            station: follower.station,
            task: words.join(" ").trim().to_owned(),
            has_lease: follower.has_lease,
        }
    });
    followers.collect()
}

/// The timers of the newest step, which have run since.
fn timers(names: &Names, track: &Track, at_us: u64) -> Vec<(String, u64)> {
    let Some((since_us, timers)) = track.timers.at(at_us) else {
        return Vec::new();
    };
    let passed_ms = (at_us - since_us) / 1_000;
    let left = |left: u32| u64::from(left).saturating_sub(passed_ms);
    let shown = timers
        .iter()
        .map(|(timer, ms)| (names.tell(timer), left(*ms)));
    shown.collect()
}

/// Time that the sign has left, and time that it was told, in ms.
fn sign(track: &Track, at_us: u64) -> Option<[u64; 2]> {
    let (since_us, told) = track.sign.at(at_us)?;
    let told = u64::from((*told)?);
    let left = told.saturating_sub((at_us - since_us) / 1_000);
    (left > 0).then_some([left, told])
}
