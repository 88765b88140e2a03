//! A simulated robot body: it walks to targets with limited speed and acceleration. Or the place of a real
//! one, which others move and which says where it is.
//!
//! Its time may run faster than the protocol's, so that a demonstration need not take as long as a
//! real crossing. How far a step really carries varies a little from maneuver to maneuver.

use crossguard_codec::{
    Battery, Capabilities, ControlMode, Dimensions, DriveDirection, JobRole, Position,
    RobotCategory, RobotState, SlowState, Target, TaskParameters,
};
use crossguard_protocol::{FallbackPolicy, Maneuver, ManeuverId, TaskSet, TaskType};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};

use crate::site::{Place, Site};

/// What kind of robot a body is.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Build {
    /// A humanoid on wheels, like ARI: 1.65 m tall.
    Humanoid,
    /// A robot dog, like Go2: 0.7 m long, 0.4 m tall.
    Quadruped,
}

impl Build {
    const fn category(self) -> RobotCategory {
        match self {
            Self::Humanoid => RobotCategory::Humanoid,
            Self::Quadruped => RobotCategory::Quadruped,
        }
    }

    const fn job(self) -> JobRole {
        match self {
            Self::Humanoid => JobRole::TrafficGuard,
            Self::Quadruped => JobRole::Escort,
        }
    }

    const fn dimensions(self) -> Dimensions {
        let (length, width, height) = match self {
            Self::Humanoid => (0.53, 0.75, 1.65),
            Self::Quadruped => (0.7, 0.31, 0.4),
        };
        Dimensions {
            length: Some(length),
            width: Some(width),
            height: Some(height),
        }
    }

    /// Largest speed in m/s.
    const fn speed_max(self) -> f64 {
        match self {
            Self::Humanoid => 1.0,
            Self::Quadruped => 1.6,
        }
    }
}

/// How fast a body gains and loses speed, in m/s².
const ACCELERATION: f64 = 1.2;

/// By how much the speed of a maneuver may differ from the one that was meant.
const GAIT_VARIATION: f64 = 0.03;

/// How near a body is to a place at which it stands, in metres.
const AT_PLACE_M: f64 = 0.05;

/// For how long a body is where it was said to be, in seconds.
const POSE_LASTS_S: f64 = 1.0;

/// Where a real body is, as whoever moves it says.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Pose {
    /// Where it is.
    pub place: Place,
    /// Where it faces, in degrees clockwise from north.
    pub heading_deg: f64,
    /// How fast it moves, in m/s.
    pub speed_mps: f64,
}

/// What a body reports.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Report {
    /// It is at the place from which it guards.
    InPosition(ManeuverId),
    /// It has finished this maneuver.
    Completed(ManeuverId),
}

/// How far a body is with its fallback.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Fallback {
    /// It is under way.
    UnderWay,
    /// It holds its place until the road is clear.
    Holding,
    /// It is finished: the body stands where its policy wants it.
    Finished,
}

/// A simulated body, or one that others move.
#[derive(Clone, Debug)]
pub struct Body {
    build: Build,
    site: Site,
    place: Place,
    heading_deg: f64,
    speed_mps: f64,
    acceleration_mps2: f64,
    /// The place to go to when contact is lost on the carriageway.
    safe_place: Place,
    motion: Option<Motion>,
    /// Where it set out for the maneuver, and where it leads.
    way: Option<(Place, Place)>,
    /// How far it is with a fallback, if it carries one out.
    fallback: Option<Fallback>,
    /// The maneuvers that hold a place until they are ended from outside.
    holding: TaskSet,
    /// How many seconds of the body's time pass in one second.
    time_scale: f64,
    gait: ChaCha8Rng,
    /// Of a body that others move: for how many seconds it is known yet where it is.
    known_s: Option<f64>,
}

#[derive(Clone, Copy, Debug)]
struct Motion {
    to: Place,
    speed_mps: f64,
    /// What the body reports when it arrives.
    report: Option<Report>,
}

impl Body {
    /// A body that stands at `place` and moves `time_scale` times as fast as real; `seed` is that of its gait.
    #[must_use]
    pub fn new(build: Build, site: Site, place: Place, time_scale: f64, seed: u64) -> Self {
        Self {
            build,
            site,
            place,
            heading_deg: 0.0,
            speed_mps: 0.0,
            acceleration_mps2: 0.0,
            safe_place: place,
            motion: None,
            way: None,
            fallback: None,
            holding: TaskSet::of(&[TaskType::BLOCK]),
            time_scale,
            gait: ChaCha8Rng::seed_from_u64(seed),
            known_s: None,
        }
    }

    /// The same body, moved by others: it goes nowhere by itself and finishes nothing, and where it is
    /// is known for a second after it was [told](Self::moved).
    #[must_use]
    pub fn moved_by_others(self) -> Self {
        Self {
            known_s: Some(0.0),
            time_scale: 1.0,
            ..self
        }
    }

    /// The same body, which guards from a place in these maneuvers instead of in a `block`.
    #[must_use]
    pub fn holding(self, holding: TaskSet) -> Self {
        Self { holding, ..self }
    }

    /// Others say where it is. One that moves by itself knows better.
    pub fn moved(&mut self, pose: Pose) {
        if let Some(known_s) = &mut self.known_s {
            *known_s = POSE_LASTS_S;
            self.place = pose.place;
            self.heading_deg = pose.heading_deg;
            self.speed_mps = pose.speed_mps;
        }
    }

    /// Sets out, if it moves by itself.
    fn set_out(&mut self, motion: Motion) {
        self.motion = self.known_s.is_none().then_some(motion);
    }

    /// Where the body is.
    #[must_use]
    pub const fn place(&self) -> Place {
        self.place
    }

    /// Carries the body back to where it is safe, as a person would between two trials.
    pub fn carry_to_safe_place(&mut self) {
        self.stop();
        self.place = self.safe_place;
    }

    /// How many seconds of the body's time pass in one second.
    #[must_use]
    pub const fn time_scale(&self) -> f64 {
        self.time_scale
    }

    /// Goes somewhere of its own accord.
    pub fn walk_to(&mut self, place: Place) {
        self.set_out(Motion {
            to: place,
            speed_mps: self.build.speed_max(),
            report: None,
        });
    }

    /// Whether the body stands at a place, as far as is known.
    #[must_use]
    pub fn stands_at(&self, place: Place) -> bool {
        let is_known = self.known_s.is_none_or(|left| left > 0.0);
        is_known && self.motion.is_none() && self.place.distance(place) < AT_PLACE_M
    }

    /// Begins a maneuver. Without a target it is done where the body stands. One that holds a place, like
    /// a `block`, goes on until it is ended from outside; the body reports when it is there.
    pub fn start(&mut self, maneuver: Maneuver, parameters: TaskParameters) {
        let to = match parameters.target {
            Some(Target::Position {
                latitude,
                longitude,
                ..
            }) => self.site.place(latitude, longitude),
            _ => self.place,
        };
        let limit = parameters
            .maximum_speed
            .unwrap_or(f64::INFINITY)
            .min(self.build.speed_max());
        let gait = 1.0 + self.gait.random_range(-GAIT_VARIATION..GAIT_VARIATION);
        self.fallback = None;
        self.way = Some((self.place, to));
        self.set_out(Motion {
            to,
            speed_mps: limit * gait,
            report: Some(if self.holding.contains(maneuver.task) {
                Report::InPosition(maneuver.id)
            } else {
                Report::Completed(maneuver.id)
            }),
        });
    }

    /// Ends the maneuver that runs, or the fallback.
    pub fn stop(&mut self) {
        self.fallback = None;
        self.way = None;
        self.stand_still();
    }

    /// Ends the maneuver that runs, by a policy. That takes time: see [`fallback`](Self::fallback).
    pub fn fall_back(&mut self, policy: FallbackPolicy) {
        let pace_mps = self.motion.map(|motion| motion.speed_mps);
        let way = self.way.take();
        let to = match policy {
            FallbackPolicy::StopInPlace | FallbackPolicy::HoldUntilClear => {
                self.where_it_can_stop()
            }
            FallbackPolicy::GoToSafePosition => self.safe_place,
            // The escort's way leads from one kerb to the other.
            FallbackPolicy::EscortToKerb => way.map_or(self.place, |(from, to)| {
                let (back, on) = (self.place.distance(from), self.place.distance(to));
                if back < on { from } else { to }
            }),
        };
        self.fallback = Some(match policy {
            FallbackPolicy::HoldUntilClear => Fallback::Holding,
            _ => Fallback::UnderWay,
        });
        let speed_mps = match policy {
            // At the pace of the person at its side.
            FallbackPolicy::EscortToKerb => pace_mps,
            FallbackPolicy::StopInPlace | FallbackPolicy::HoldUntilClear => Some(self.speed_mps),
            FallbackPolicy::GoToSafePosition => None,
        };
        self.set_out(Motion {
            to,
            speed_mps: speed_mps.unwrap_or(self.build.speed_max()),
            report: None,
        });
    }

    /// How far the body is with a fallback; `None` when it carries none out.
    #[must_use]
    pub const fn fallback(&self) -> Option<Fallback> {
        self.fallback
    }

    /// Whether it moves by itself because of a fallback.
    #[must_use]
    pub fn walks_back(&self) -> bool {
        self.fallback.is_some() && self.motion.is_some()
    }

    /// The driver of the body says that its fallback is finished. One that moves by itself knows better.
    pub fn finish_fallback(&mut self) {
        if self.known_s.is_some() && self.fallback == Some(Fallback::UnderWay) {
            self.fallback = Some(Fallback::Finished);
        }
    }

    /// The road is clear: the body need not hold any more.
    pub fn release(&mut self) {
        self.fallback = None;
    }

    /// Where the body comes to a stand if it brakes now.
    fn where_it_can_stop(&self) -> Place {
        let way = self.speed_mps * self.speed_mps / (2.0 * ACCELERATION);
        match self.motion {
            Some(motion) => self
                .place
                .towards(motion.to, way.min(self.place.distance(motion.to))),
            None => self.place,
        }
    }

    fn stand_still(&mut self) {
        self.motion = None;
        if self.known_s.is_none() {
            self.speed_mps = 0.0;
            self.acceleration_mps2 = 0.0;
        }
    }

    /// Lets `seconds` pass. Returns what the body reports meanwhile.
    pub fn advance(&mut self, seconds: f64) -> Option<Report> {
        if let Some(known_s) = &mut self.known_s {
            *known_s = (*known_s - seconds).max(0.0);
        }
        let mut left = seconds * self.time_scale;
        // Short enough that speed and place change smoothly.
        while left > 0.0 && self.motion.is_some() {
            let slice = left.min(0.02);
            left -= slice;
            if let Some(report) = self.advance_slice(slice) {
                return Some(report);
            }
        }
        None
    }

    fn advance_slice(&mut self, seconds: f64) -> Option<Report> {
        let motion = self.motion?;
        let way = self.place.distance(motion.to);
        // The speed from which the body can still stop at its target.
        let brake = (2.0 * ACCELERATION * way).sqrt();
        let speed = (self.speed_mps + ACCELERATION * seconds)
            .min(motion.speed_mps)
            .min(brake);
        let step = speed * seconds;
        if way <= step.max(0.005) {
            self.place = motion.to;
            self.stand_still();
            if self.fallback == Some(Fallback::UnderWay) {
                self.fallback = Some(Fallback::Finished);
            }
            return motion.report;
        }
        self.heading_deg = self.place.bearing(motion.to);
        self.acceleration_mps2 = (speed - self.speed_mps) / seconds;
        self.speed_mps = speed;
        self.place = self.place.towards(motion.to, step);
        None
    }

    /// What the body's sensors say.
    #[must_use]
    pub fn state(&self) -> RobotState {
        let is_known = self.known_s.is_none_or(|left| left > 0.0);
        RobotState {
            position: if is_known {
                self.site.position(self.place)
            } else {
                Position::default()
            },
            heading: is_known.then(|| self.heading_deg.into()),
            speed: is_known.then(|| self.speed_mps.into()),
            drive_direction: DriveDirection::Forward,
            longitudinal_acceleration: Some(self.acceleration_mps2.into()),
            dimensions: self.build.dimensions(),
            category: self.build.category(),
            job_role: self.build.job(),
            battery: Battery {
                state_of_charge: Some(80.0),
                charging: false,
            },
            control_mode: ControlMode::Autonomous,
            slow: Some(SlowState {
                capabilities: Capabilities::PEDESTRIAN_DETECTION
                    .union(Capabilities::LEADING)
                    .union(Capabilities::FOLLOWING),
                ..SlowState::default()
            }),
            ..RobotState::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use crossguard_protocol::{
        RequestId, SessionId, SessionNumber, StationId, TaskType, UniqueNumber,
    };

    use super::*;

    fn maneuver() -> Maneuver {
        let number = SessionNumber(UniqueNumber { boot: 1, count: 0 });
        let session = SessionId {
            leader: StationId(1),
            number,
        };
        let id = ManeuverId {
            session,
            request: RequestId(0),
        };
        Maneuver {
            id,
            task: TaskType::MOVE,
        }
    }

    fn walking(time_scale: f64) -> Body {
        let site = Site::default();
        let mut body = Body::new(Build::Quadruped, site, Place::default(), time_scale, 7);
        let parameters = TaskParameters {
            target: Some(site.target(Place::new(0.0, 5.0))),
            maximum_speed: Some(0.5),
            ..TaskParameters::default()
        };
        body.start(maneuver(), parameters);
        body
    }

    fn seconds_until_done(body: &mut Body) -> f64 {
        let mut seconds = 0.0;
        while body.advance(0.01).is_none() {
            seconds += 0.01;
            assert!(seconds < 60.0, "never arrives");
        }
        seconds
    }

    #[test]
    fn a_body_takes_the_time_that_its_speed_and_acceleration_allow() {
        let mut body = walking(1.0);
        let seconds = seconds_until_done(&mut body);
        // 5 m at 0.5 m/s, and 0.4 s for speeding up and slowing down; 3 % either way.
        assert!((10.0..11.0).contains(&seconds), "{seconds}");
        assert!(body.place().distance(Place::new(0.0, 5.0)) < 0.01);
    }

    #[test]
    fn a_body_whose_time_runs_faster_takes_less_of_ours() {
        let (slow, fast) = (
            seconds_until_done(&mut walking(1.0)),
            seconds_until_done(&mut walking(10.0)),
        );
        assert!((slow / fast - 10.0).abs() < 0.5, "{slow} against {fast}");
    }

    #[test]
    fn a_body_never_exceeds_the_speed_it_is_allowed() {
        let mut body = walking(1.0);
        while body.advance(0.05).is_none() {
            let speed = body.state().speed.unwrap().value;
            assert!(speed <= 0.5 * (1.0 + GAIT_VARIATION), "{speed}");
        }
    }

    #[test]
    fn a_body_that_others_move_is_where_they_say_and_finishes_nothing() {
        let site = Site::default();
        let body = Body::new(Build::Quadruped, site, Place::default(), 9.0, 7);
        let mut body = body.moved_by_others();
        body.start(maneuver(), TaskParameters::default());
        assert_eq!(body.state().position.latitude, None, "nobody has said it");
        let pose = Pose {
            place: Place::new(1.0, 2.0),
            heading_deg: 90.0,
            speed_mps: 0.5,
        };
        body.moved(pose);
        body.stop();
        let state = body.state();
        assert_eq!(state.position, site.position(pose.place));
        assert_eq!(state.speed.map(|speed| speed.value), Some(0.5));
        assert_eq!(body.advance(0.9), None);
        assert!(body.state().position.latitude.is_some());
        assert_eq!(body.advance(0.2), None);
        assert_eq!(body.state().position.latitude, None, "that was long ago");
        // One that moves by itself is not carried away.
        let mut own = walking(1.0);
        own.moved(pose);
        assert_eq!(own.place(), Place::default());
    }

    #[test]
    fn a_block_holds_its_place_until_it_is_ended() {
        let mut body = walking(1.0);
        let block = Maneuver {
            task: TaskType::BLOCK,
            ..maneuver()
        };
        let parameters = TaskParameters {
            target: Some(Site::default().target(Place::new(0.0, 5.0))),
            ..TaskParameters::default()
        };
        body.start(block, parameters);
        assert_eq!(body.advance(2.0), None, "it is under way");
        assert_eq!(body.advance(60.0), Some(Report::InPosition(block.id)));
        assert_eq!(body.advance(600.0), None);
        assert!(body.place().distance(Place::new(0.0, 5.0)) < 0.01);
    }

    fn fallen_back(after_s: f64, policy: FallbackPolicy) -> Body {
        let mut body = walking(1.0);
        assert_eq!(body.advance(after_s), None);
        body.fall_back(policy);
        body
    }

    #[test]
    fn going_to_safety_takes_its_time_and_finishes_no_maneuver() {
        let mut body = fallen_back(4.0, FallbackPolicy::GoToSafePosition);
        assert_eq!(body.advance(0.5), None);
        assert_eq!(body.fallback(), Some(Fallback::UnderWay));
        assert_eq!(body.advance(30.0), None);
        assert_eq!(body.fallback(), Some(Fallback::Finished));
        assert!(body.place().distance(Place::default()) < 0.01);
    }

    #[test]
    fn stopping_in_place_brakes() {
        let mut body = fallen_back(4.0, FallbackPolicy::StopInPlace);
        let before = body.place();
        body.advance(0.1);
        assert_eq!(body.fallback(), Some(Fallback::UnderWay));
        body.advance(30.0);
        assert_eq!(body.fallback(), Some(Fallback::Finished));
        let way = body.place().distance(before);
        assert!((0.05..0.2).contains(&way), "{way}");
    }

    #[test]
    fn an_escort_goes_to_the_nearer_kerb_at_the_pace_of_its_person() {
        for (after_s, kerb) in [(3.0, 0.0), (8.0, 5.0)] {
            let mut body = fallen_back(after_s, FallbackPolicy::EscortToKerb);
            body.advance(0.1);
            assert!(body.state().speed.unwrap().value <= 0.5 * (1.0 + GAIT_VARIATION));
            body.advance(30.0);
            assert_eq!(body.fallback(), Some(Fallback::Finished));
            assert!(body.place().distance(Place::new(0.0, kerb)) < 0.01);
        }
    }

    #[test]
    fn a_body_holds_until_it_is_released() {
        let mut body = fallen_back(4.0, FallbackPolicy::HoldUntilClear);
        body.advance(600.0);
        assert_eq!(body.fallback(), Some(Fallback::Holding));
        body.release();
        assert_eq!(body.fallback(), None);
    }
}
