//! A simulated robot body: it walks to targets with limited speed and acceleration.
//!
//! Its time may run faster than the protocol's, so that a demonstration need not take as long as a
//! real crossing. How far a step really carries varies a little from maneuver to maneuver.

use crossguard_codec::{Battery, DriveDirection, RobotState, TaskParameters};
use crossguard_protocol::{FallbackPolicy, Maneuver, TaskSet, TaskType};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::{Body, BodyAct, Build, Fallback, NotTaken, Pose, Report, state_of};
use crate::site::{Place, SIMULATED_ERROR_M, Site};

/// How fast a body gains and loses speed, in m/s².
const ACCELERATION: f64 = 1.2;

/// The battery of a simulated body, unless somebody says another one.
const SIMULATED_BATTERY: Battery = Battery {
    state_of_charge: Some(80.0),
    charging: false,
};

/// By how much the speed of a maneuver may differ from the one that was meant.
const GAIT_VARIATION: f64 = 0.03;

/// A simulated body.
#[derive(Clone, Debug)]
pub struct Simulated {
    build: Build,
    site: Site,
    place: Place,
    heading_deg: f64,
    speed_mps: f64,
    acceleration_mps2: f64,
    /// The place to go to when contact is lost on the carriageway.
    safe_place: Place,
    motion: Option<Motion>,
    /// Whether it stands on its way until it is to go on.
    waits: bool,
    /// Where it set out for the maneuver, and where it leads.
    way: Option<(Place, Place)>,
    /// How far it is with a fallback, if it carries one out.
    fallback: Option<Fallback>,
    /// The maneuvers that hold a place until they are ended from outside.
    holding: TaskSet,
    /// How many seconds of the body's time pass in one second.
    time_scale: f64,
    gait: ChaCha8Rng,
}

#[derive(Clone, Debug)]
struct Motion {
    to: Place,
    speed_mps: f64,
    /// Which way it faces there, if that matters.
    heading_deg: Option<f64>,
    /// Report of the body on its arrival.
    report: Option<Report>,
}

impl Simulated {
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
            waits: false,
            way: None,
            fallback: None,
            holding: TaskSet::of(&[TaskType::BLOCK]),
            time_scale,
            gait: ChaCha8Rng::seed_from_u64(seed),
        }
    }

    /// The same body, which guards from a place in these maneuvers instead of in a `block`.
    #[must_use]
    pub fn holding(self, holding: TaskSet) -> Self {
        Self { holding, ..self }
    }

    /// The same body, which stands elsewhere than where it is safe.
    #[must_use]
    pub fn at(self, place: Place) -> Self {
        Self { place, ..self }
    }

    fn start(&mut self, maneuver: Maneuver, parameters: TaskParameters) {
        let to = self.site.place_of(parameters.target).unwrap_or(self.place);
        let limit = parameters
            .maximum_speed
            .unwrap_or(f64::INFINITY)
            .min(self.build.speed_max());
        let gait = 1.0 + self.gait.random_range(-GAIT_VARIATION..GAIT_VARIATION);
        (self.fallback, self.waits) = (None, false);
        self.way = Some((self.place, to));
        self.motion = Some(Motion {
            to,
            speed_mps: limit * gait,
            heading_deg: parameters.heading,
            report: Some(if self.holding.contains(maneuver.task) {
                Report::InPosition(maneuver.id)
            } else {
                Report::Completed(maneuver.id)
            }),
        });
    }

    fn stop(&mut self) {
        self.fallback = None;
        self.way = None;
        self.stand_still();
    }

    fn fall_back(&mut self, policy: FallbackPolicy) {
        let pace_mps = self.motion.as_ref().map(|motion| motion.speed_mps);
        let way = self.way.take();
        self.waits = false;
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
        self.motion = Some(Motion {
            to,
            speed_mps: speed_mps.unwrap_or(self.build.speed_max()),
            heading_deg: None,
            report: None,
        });
    }

    /// Where the body comes to a stand if it brakes now.
    fn where_it_can_stop(&self) -> Place {
        let way = self.speed_mps * self.speed_mps / (2.0 * ACCELERATION);
        match &self.motion {
            Some(motion) => self
                .place
                .towards(motion.to, way.min(self.place.distance(motion.to))),
            None => self.place,
        }
    }

    fn stand_still(&mut self) {
        (self.motion, self.waits) = (None, false);
        self.speed_mps = 0.0;
        self.acceleration_mps2 = 0.0;
    }

    fn advance_slice(&mut self, seconds: f64) -> Option<Report> {
        let &Motion { to, speed_mps, .. } = self.motion.as_ref()?;
        let way = self.place.distance(to);
        // The speed from which the body can still stop at its target.
        let brake = (2.0 * ACCELERATION * way).sqrt();
        let speed = if self.waits {
            (self.speed_mps - ACCELERATION * seconds).max(0.0)
        } else {
            (self.speed_mps + ACCELERATION * seconds).min(speed_mps)
        };
        let speed = speed.min(brake);
        let step = speed * seconds;
        if way <= step.max(0.005) {
            let arrived = self.motion.take()?;
            self.place = to;
            self.heading_deg = arrived.heading_deg.unwrap_or(self.heading_deg);
            self.stand_still();
            if self.fallback == Some(Fallback::UnderWay) {
                self.fallback = Some(Fallback::Finished);
            }
            return arrived.report;
        }
        self.heading_deg = self.place.bearing(to);
        self.acceleration_mps2 = (speed - self.speed_mps) / seconds;
        self.speed_mps = speed;
        self.place = self.place.towards(to, step);
        None
    }
}

impl Body for Simulated {
    fn act(&mut self, act: BodyAct) -> Result<(), NotTaken> {
        match act {
            BodyAct::Start(maneuver, parameters) => self.start(maneuver, parameters),
            BodyAct::Stop(..) => self.stop(),
            BodyAct::FallBack(_, policy) => self.fall_back(policy),
            BodyAct::Wait => self.waits = self.motion.is_some(),
            BodyAct::GoOn => self.waits = false,
        }
        Ok(())
    }

    fn advance(&mut self, seconds: f64) -> Vec<Report> {
        let mut left = seconds * self.time_scale;
        // Short enough that speed and place change smoothly.
        while left > 0.0 && self.motion.is_some() {
            let slice = left.min(0.02);
            left -= slice;
            if let Some(report) = self.advance_slice(slice) {
                return vec![report];
            }
        }
        Vec::new()
    }

    fn state(&self) -> RobotState {
        let pose = Pose {
            place: self.place,
            error_m: Some(SIMULATED_ERROR_M),
            heading_deg: Some(self.heading_deg),
            speed_mps: Some(self.speed_mps),
        };
        let state = state_of(
            self.build,
            &self.site,
            Some(pose),
            Some(self.acceleration_mps2),
        );
        RobotState {
            battery: SIMULATED_BATTERY,
            drive_direction: DriveDirection::Forward,
            ..state
        }
    }

    fn place(&self) -> Place {
        self.place
    }

    fn fallback(&self) -> Option<Fallback> {
        self.fallback
    }

    fn release(&mut self) {
        self.fallback = None;
    }

    fn halt(&mut self) {
        self.stop();
    }

    fn walk_to(&mut self, place: Place, heading_deg: Option<f64>) {
        self.waits = false;
        self.motion = Some(Motion {
            to: place,
            speed_mps: self.build.speed_max(),
            heading_deg,
            report: None,
        });
    }

    fn walks_back(&self) -> bool {
        self.fallback.is_some() && self.motion.is_some()
    }

    fn push(&mut self, [east, north]: [f64; 2]) {
        self.place = Place::new(self.place.east + east, self.place.north + north);
    }

    fn carry_to_safe_place(&mut self) {
        self.stop();
        self.place = self.safe_place;
    }

    fn time_scale(&self) -> f64 {
        self.time_scale
    }
}

#[cfg(test)]
mod tests {
    use crossguard_protocol::TaskType;

    use super::*;
    use crate::table::maneuver;

    const ESCORT: Maneuver = maneuver(TaskType::MOVE);

    fn walking(time_scale: f64) -> Simulated {
        let site = Site::default();
        let mut body = Simulated::new(Build::Quadruped, site, Place::default(), time_scale, 7);
        let parameters = TaskParameters {
            target: Some(site.target(Place::new(0.0, 5.0))),
            maximum_speed: Some(0.5),
            ..TaskParameters::default()
        };
        body.start(ESCORT, parameters);
        body
    }

    fn seconds_until_done(body: &mut Simulated) -> f64 {
        let mut seconds = 0.0;
        while body.advance(0.01).is_empty() {
            seconds += 0.01;
            assert!(seconds < 60.0, "never arrives");
            let speed = body.state().speed.unwrap().value;
            assert!(speed <= 0.5 * (1.0 + GAIT_VARIATION), "{speed}");
        }
        seconds
    }

    #[test]
    fn a_body_takes_the_time_that_its_speed_acceleration_and_time_scale_allow() {
        for time_scale in [1.0, 10.0] {
            let mut body = walking(time_scale);
            let seconds = seconds_until_done(&mut body) * time_scale;
            // 5 m at 0.5 m/s, and 0.4 s for speeding up and slowing down; 3 % either way.
            assert!((10.0..11.0).contains(&seconds), "{seconds}");
            assert!(body.place().distance(Place::new(0.0, 5.0)) < 0.01);
        }
    }

    #[test]
    fn a_block_holds_its_place_until_it_is_ended() {
        let mut body = walking(1.0);
        let block = Maneuver {
            task: TaskType::BLOCK,
            ..ESCORT
        };
        let parameters = TaskParameters {
            target: Some(Site::default().target(Place::new(0.0, 5.0))),
            ..TaskParameters::default()
        };
        body.start(block, parameters);
        assert_eq!(body.advance(2.0).pop(), None, "it is under way");
        assert_eq!(body.advance(60.0).pop(), Some(Report::InPosition(block.id)));
        assert_eq!(body.advance(600.0).pop(), None);
        assert!(body.place().distance(Place::new(0.0, 5.0)) < 0.01);
    }

    #[test]
    fn an_escort_that_waits_stands_until_it_goes_on_with_the_same_maneuver() {
        let mut body = walking(1.0);
        assert_eq!(body.advance(4.0).pop(), None);
        let before = body.place();
        body.act(BodyAct::Wait).unwrap();
        assert_eq!(body.advance(60.0).pop(), None);
        let waits_at = body.place();
        let braking_m = before.distance(waits_at);
        assert!((0.05..0.2).contains(&braking_m), "{braking_m}");
        assert!(body.state().speed.unwrap().value < 0.01);
        assert_eq!(body.advance(60.0).pop(), None);
        assert_eq!(body.place(), waits_at);
        body.act(BodyAct::GoOn).unwrap();
        assert_eq!(body.advance(60.0).pop(), Some(Report::Completed(ESCORT.id)));
        assert!(body.place().distance(Place::new(0.0, 5.0)) < 0.01);
    }

    #[test]
    fn a_body_that_waits_falls_back_and_begins_another_maneuver_all_the_same() {
        let waiting = || {
            let mut body = walking(1.0);
            body.advance(3.0);
            body.act(BodyAct::Wait).unwrap();
            body.advance(5.0);
            body
        };
        let mut body = waiting();
        body.fall_back(FallbackPolicy::EscortToKerb);
        body.advance(30.0);
        assert_eq!(body.fallback(), Some(Fallback::Finished));
        assert!(body.place().distance(Place::default()) < 0.01);
        let mut body = waiting();
        body.start(ESCORT, TaskParameters::default());
        assert_eq!(body.advance(1.0).pop(), Some(Report::Completed(ESCORT.id)));
    }

    fn fallen_back(after_s: f64, policy: FallbackPolicy) -> Simulated {
        let mut body = walking(1.0);
        assert_eq!(body.advance(after_s).pop(), None);
        body.fall_back(policy);
        body
    }

    #[test]
    fn a_fallback_to_a_place_takes_its_time_there_and_finishes_no_maneuver() {
        for (after_s, policy, north) in [
            (4.0, FallbackPolicy::GoToSafePosition, 0.0),
            // An escort goes to the nearer kerb.
            (3.0, FallbackPolicy::EscortToKerb, 0.0),
            (8.0, FallbackPolicy::EscortToKerb, 5.0),
        ] {
            let mut body = fallen_back(after_s, policy);
            assert_eq!(body.advance(0.1).pop(), None);
            assert_eq!(body.fallback(), Some(Fallback::UnderWay));
            let is_at_persons_pace =
                body.state().speed.unwrap().value <= 0.5 * (1.0 + GAIT_VARIATION);
            assert!(is_at_persons_pace || policy != FallbackPolicy::EscortToKerb);
            assert_eq!(body.advance(30.0).pop(), None);
            assert_eq!(body.fallback(), Some(Fallback::Finished));
            assert!(body.place().distance(Place::new(0.0, north)) < 0.01);
        }
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
    fn a_body_holds_until_it_is_released() {
        let mut body = fallen_back(4.0, FallbackPolicy::HoldUntilClear);
        body.advance(600.0);
        assert_eq!(body.fallback(), Some(Fallback::Holding));
        body.release();
        assert_eq!(body.fallback(), None);
    }
}
