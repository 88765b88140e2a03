//! A simulated robot body: it walks to targets with limited speed and acceleration. Or the place of a real
//! one, which others move and which says where it is.
//!
//! Its time may run faster than the protocol's, so that a demonstration need not take as long as a
//! real crossing. How far a step really carries varies a little from maneuver to maneuver.

use crossguard_codec::{
    Battery, Capabilities, ControlMode, Dimensions, DriveDirection, JobRole, Position,
    RobotCategory, RobotState, SlowState, Target, TaskParameters,
};
use crossguard_protocol::{FallbackPolicy, Maneuver, ManeuverId, TaskType};
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
    /// The maneuver that is finished when the body arrives; `None` on the way to safety, or to where
    /// it blocks.
    maneuver: Option<ManeuverId>,
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
        self.stand_still();
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
            maneuver: None,
        });
    }

    /// Begins a maneuver. Without a target it is done where the body stands. A `block` goes on until
    /// it is ended from outside.
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
        self.set_out(Motion {
            to,
            speed_mps: limit * gait,
            maneuver: (maneuver.task != TaskType::BLOCK).then_some(maneuver.id),
        });
    }

    /// Ends the maneuver that runs.
    pub fn stop(&mut self) {
        self.stand_still();
    }

    /// Ends the maneuver that runs, by a policy.
    pub fn fall_back(&mut self, policy: FallbackPolicy) {
        self.stand_still();
        if policy == FallbackPolicy::GoToSafePosition {
            self.walk_to(self.safe_place);
        }
    }

    fn stand_still(&mut self) {
        self.motion = None;
        if self.known_s.is_none() {
            self.speed_mps = 0.0;
            self.acceleration_mps2 = 0.0;
        }
    }

    /// Lets `seconds` pass. Returns the maneuver that was finished meanwhile.
    pub fn advance(&mut self, seconds: f64) -> Option<ManeuverId> {
        if let Some(known_s) = &mut self.known_s {
            *known_s = (*known_s - seconds).max(0.0);
        }
        let mut left = seconds * self.time_scale;
        // Short enough that speed and place change smoothly.
        while left > 0.0 && self.motion.is_some() {
            let slice = left.min(0.02);
            left -= slice;
            if let Some(finished) = self.advance_slice(slice) {
                return Some(finished);
            }
        }
        None
    }

    fn advance_slice(&mut self, seconds: f64) -> Option<ManeuverId> {
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
            return motion.maneuver;
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
        assert_eq!(body.advance(600.0), None);
        assert!(body.place().distance(Place::new(0.0, 5.0)) < 0.01);
    }

    #[test]
    fn a_body_that_falls_back_goes_to_safety_and_finishes_nothing() {
        let mut body = walking(1.0);
        assert_eq!(body.advance(4.0), None);
        body.fall_back(FallbackPolicy::GoToSafePosition);
        assert_eq!(body.advance(30.0), None);
        assert!(body.place().distance(Place::default()) < 0.01);

        let mut body = walking(1.0);
        body.advance(4.0);
        let before = body.place();
        body.fall_back(FallbackPolicy::StopInPlace);
        body.advance(30.0);
        assert_eq!(body.place(), before);
    }
}
