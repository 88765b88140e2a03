//! The port to a body: what it is to do goes in, in order, and where it is comes out.
//!
//! ```text
//!   application ── BodyAct ──► Body ──► motors, or the simulation
//!               ◄── Report, state ──
//! ```
//!
//! [`Simulated`] walks to targets by itself, [`Ported`] is another process, by lines on a socket. An act that a body does not
//! take is a fault that the robot announces.

#[cfg(feature = "full")]
mod port;
mod simulated;

use std::fmt;

use crossguard_codec::{
    ControlMode, Dimensions, JobRole, Position, RobotCategory, RobotState, SignalMeans, SlowState,
    TaskParameters,
};
use crossguard_endpoint::cause::Cause;
use crossguard_protocol::{FallbackPolicy, Maneuver, ManeuverId, StopReason};
use serde::{Deserialize, Serialize};

#[cfg(feature = "full")]
pub use self::port::{BodyPort, Ported, VERSION as PORT_VERSION};
pub use self::simulated::Simulated;
use crate::site::{Place, Site};

/// Kind of robot that a body is.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Build {
    /// A humanoid on wheels, like ARI: 1.65 m tall.
    Humanoid,
    /// A robot dog, like Go2: 0.7 m long, 0.4 m tall.
    Quadruped,
    /// On wheels.
    Wheeled,
    /// On tracks.
    Tracked,
    /// Flies.
    Aerial,
    /// Anything else.
    Other,
    /// Not known.
    Unknown,
}

impl Build {
    const fn category(self) -> RobotCategory {
        match self {
            Self::Humanoid => RobotCategory::Humanoid,
            Self::Quadruped => RobotCategory::Quadruped,
            Self::Wheeled => RobotCategory::Wheeled,
            Self::Tracked => RobotCategory::Tracked,
            Self::Aerial => RobotCategory::Aerial,
            Self::Other => RobotCategory::Other,
            Self::Unknown => RobotCategory::Unknown,
        }
    }

    const fn job(self) -> JobRole {
        match self {
            Self::Humanoid => JobRole::TrafficGuard,
            Self::Quadruped => JobRole::Escort,
            Self::Wheeled | Self::Tracked | Self::Aerial | Self::Other | Self::Unknown => {
                JobRole::None
            }
        }
    }

    const fn dimensions(self) -> Dimensions {
        let (length, width, height) = match self {
            Self::Humanoid => (0.53, 0.75, 1.65),
            Self::Quadruped => (0.7, 0.31, 0.4),
            // They differ too much to guess.
            Self::Wheeled | Self::Tracked | Self::Aerial | Self::Other | Self::Unknown => {
                return Dimensions {
                    length: None,
                    width: None,
                    height: None,
                };
            }
        };
        Dimensions {
            length: Some(length),
            width: Some(width),
            height: Some(height),
        }
    }

    /// By what a simulated body shows signals to people: a humanoid as in the paper (section III-A), stop gestures and
    /// spoken commands.
    #[must_use]
    pub fn means(self) -> Option<SignalMeans> {
        (self == Self::Humanoid).then(|| SignalMeans::GESTURE.union(SignalMeans::SPEECH))
    }

    /// Largest speed in m/s.
    const fn speed_max(self) -> f64 {
        match self {
            Self::Quadruped => 1.6,
            _ => 1.0,
        }
    }
}

/// Act for a body to carry out.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum BodyAct {
    /// Begin a maneuver. Without a target it is done where the body stands. One that holds a place, like a
    /// `block`, goes on until it is ended; the body reports when it is there.
    Start(Maneuver, TaskParameters),
    /// End the maneuver, or its fallback, and stand still.
    Stop(Maneuver, StopReason),
    /// End the maneuver by a policy, which takes time: see [`Body::fallback`].
    FallBack(Maneuver, FallbackPolicy),
    /// Stand still on the way, until it is to go on: the person at its side is behind, or a vehicle has to pass before it
    /// steps on the road.
    Wait,
    /// Go on with what it waits in.
    GoOn,
}

/// A body did not take what it was to do.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("the body does not take it: {0}")]
pub struct NotTaken(pub String);

/// A body.
pub trait Body: fmt::Debug + Send {
    /// Takes in what it is to do, without waiting for it to be done.
    ///
    /// # Errors
    /// When nobody will do it. The robot then says that it has a fault.
    fn act(&mut self, act: BodyAct) -> Result<(), NotTaken>;

    /// Lets `seconds` pass. Returns all that the body reports meanwhile, in order.
    fn advance(&mut self, seconds: f64) -> Vec<Report>;

    /// State of the robot, by the body's sensors.
    fn state(&self) -> RobotState;

    /// Where the body is, as far as is known.
    fn place(&self) -> Place;

    /// How far the body is with a fallback; `None` when it carries none out.
    fn fallback(&self) -> Option<Fallback>;

    /// The road is clear: the body need not hold any more.
    fn release(&mut self);

    /// Ends the motion, whatever it is, on the word of a person.
    fn halt(&mut self);

    /// A person says that its fallback is finished. A body that moves by itself knows better.
    fn finish_fallback(&mut self) {}

    /// Goes to the leader's place in a plan, or home, if it moves by itself, and faces this way there, in degrees clockwise
    /// from north, if that matters.
    fn walk_to(&mut self, _place: Place, _heading_deg: Option<f64>) {}

    /// Whether it moves by itself because of a fallback.
    fn walks_back(&self) -> bool {
        false
    }

    /// Something pushes it so far to the east and to the north, in metres. Only a simulated body can be.
    fn push(&mut self, _by_m: [f64; 2]) {}

    /// Carries the body back to where it is safe, as a person would between two trials.
    fn carry_to_safe_place(&mut self) {}

    /// How many seconds of the body's time pass in one second.
    fn time_scale(&self) -> f64 {
        1.0
    }
}

/// Where a real body is, as its driver says.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Pose {
    /// Where it is.
    pub place: Place,
    /// How far off that may be, in metres, with a confidence of 95 %.
    pub error_m: Option<f64>,
    /// Where it faces, in degrees clockwise from north.
    pub heading_deg: Option<f64>,
    /// How fast it moves, in m/s.
    pub speed_mps: Option<f64>,
}

/// Report of a body.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Report {
    /// It is at the place from which it guards.
    InPosition(ManeuverId),
    /// It has finished this maneuver.
    Completed(ManeuverId),
    /// It cannot finish this maneuver.
    Failed(ManeuverId),
    /// It is another process, which was not there yet.
    Absent,
    /// It is there.
    Here,
    /// It is lost, for this reason.
    Silent(String),
    /// It has a fault: this.
    Fault(String),
    /// Lines or connections were dropped: for which cause, what the first of them was, and how many there were.
    Dropped(Cause, String, u64),
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

/// State of a body of this build at a pose; `None` where its place is not known. Unknown values are
/// unavailable in messages.
fn state_of(
    build: Build,
    site: &Site,
    pose: Option<Pose>,
    acceleration_mps2: Option<f64>,
) -> RobotState {
    let position = |pose: Pose| site.position_within(pose.place, pose.error_m);
    RobotState {
        position: pose.map_or_else(Position::default, position),
        heading: pose.and_then(|pose| pose.heading_deg).map(Into::into),
        speed: pose.and_then(|pose| pose.speed_mps).map(Into::into),
        longitudinal_acceleration: acceleration_mps2.map(Into::into),
        dimensions: build.dimensions(),
        category: build.category(),
        job_role: build.job(),
        control_mode: ControlMode::Autonomous,
        slow: Some(SlowState::default()),
        ..RobotState::default()
    }
}
