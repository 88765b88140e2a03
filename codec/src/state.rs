//! State of a robot, as its RAM says it, in SI units.
//!
//! Plain values for the application, and the enumerations of the messages. [`ram_from`](crate::ram_from)
//! and [`state_of`](crate::state_of) convert quantities by the tables of [`si`](crate::si).

use ::core::fmt;

use crossguard_protocol::{Availability, Config, Robot, State, TaskSet, Unavailability};
use serde::{Deserialize, Serialize};

use crate::view::MapPlace;
use crate::wire::bit_set;

pub use crate::core::cdd::DriveDirection;
pub use crate::core::common::TaskProgression;
/// A traffic guard holds traffic back, an escort walks along with pedestrians, a patrol walks its rounds.
pub use crate::core::ram::OperationalJobRole as JobRole;
pub use crate::core::ram::{ControlMode, PublicSignal, RobotCategory};

/// The state of a robot. What is `None` is unavailable.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default, deny_unknown_fields)]
pub struct RobotState {
    /// Where it is.
    pub position: Position,
    /// Direction of motion, in degrees clockwise from north.
    pub heading: Option<Measurement>,
    /// Speed over ground in m/s, not negative.
    pub speed: Option<Measurement>,
    /// Its direction along its body: forward or backward.
    pub drive_direction: DriveDirection,
    /// In m/s², speeding up positive.
    pub longitudinal_acceleration: Option<Measurement>,
    /// In m/s², to the left positive.
    pub lateral_acceleration: Option<Measurement>,
    /// In m/s², upwards positive.
    pub vertical_acceleration: Option<Measurement>,
    /// In 1/m, to the left positive.
    pub curvature: Option<Measurement>,
    /// In degrees/s, to the left positive.
    pub yaw_rate: Option<Measurement>,
    /// Direction of the body in degrees clockwise from north, where it is not that of the motion.
    pub orientation: Option<Measurement>,
    /// The box around the robot and what it carries.
    pub dimensions: Dimensions,
    /// Its build.
    pub category: RobotCategory,
    /// The job that it is there for.
    pub job_role: JobRole,
    /// How far it is with its task. In the RAM of a follower that has accepted a command, the
    /// progress of the command stands here instead.
    pub task_progression: TaskProgression,
    /// Its battery's charge, and whether it is being charged.
    pub battery: Battery,
    /// The control over it: none in an emergency stop or with a fault.
    pub control_mode: ControlMode,
    /// Slow part of its state; absent from a RAM without low-frequency container.
    pub slow: Option<SlowState>,
}

impl RobotState {
    /// Sets what the protocol knows better than the application: how far the robot is with its task,
    /// who steers it where it is unavailable for that reason, and the maneuvers that it can do.
    pub fn correct(&mut self, robot: &Robot, config: &Config) {
        self.task_progression = match robot.state() {
            State::ManeuverExecuting => TaskProgression::Executing,
            _ => TaskProgression::Idle,
        };
        if let Availability::Unavailable(reason) = robot.availability() {
            self.control_mode = match reason {
                Unavailability::Teleoperated => ControlMode::Teleoperated,
                Unavailability::EmergencyStop => ControlMode::EmergencyStop,
                Unavailability::LocalFault => ControlMode::Fault,
                Unavailability::LowBattery | Unavailability::NotSafe => self.control_mode,
            };
        }
        if let Some(slow) = &mut self.slow {
            slow.supported_tasks = config.settings().capabilities;
            if slow.supported_tasks != TaskSet::EMPTY {
                slow.capabilities = slow.capabilities.union(Capabilities::FOLLOWING);
            }
        }
    }
}

/// A quantity and the half width of its 95 % interval, in the same unit.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct Measurement {
    /// The quantity, in the unit of the field that it stands in.
    pub value: f64,
    /// Half width of its 95 % interval; infinite where a RAM says that it is out of range, and then
    /// the quantity is not to be relied on.
    #[serde(default)]
    pub confidence: Option<f64>,
}

impl From<f64> for Measurement {
    /// A quantity of unknown confidence.
    fn from(value: f64) -> Self {
        Self {
            value,
            confidence: None,
        }
    }
}

/// A position with its confidence.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default, deny_unknown_fields)]
pub struct Position {
    /// In degrees, north positive.
    pub latitude: Option<f64>,
    /// In degrees, east positive.
    pub longitude: Option<f64>,
    /// In metres above the WGS84 ellipsoid.
    pub altitude: Option<f64>,
    /// Horizontal confidence.
    pub ellipse: Option<ConfidenceEllipse>,
    /// Half width of the altitude's 95 % interval, in metres.
    pub altitude_confidence: Option<f64>,
}

/// Error of a position that does not tell its confidence, in metres.
pub(crate) const UNKNOWN_ERROR_M: f64 = 1.0;

impl Position {
    /// How far the place may be from this position, in any direction, in metres: infinite where that is out of range.
    #[must_use]
    pub fn error_m(&self) -> f64 {
        self.ellipse
            .map_or(UNKNOWN_ERROR_M, |ellipse| ellipse.semi_major)
    }

    /// A horizontal position of unknown confidence, in degrees.
    #[must_use]
    pub fn at(latitude: f64, longitude: f64) -> Self {
        Self {
            latitude: Some(latitude),
            longitude: Some(longitude),
            ..Self::default()
        }
    }
}

/// The ellipse that holds a position with a confidence of 95 %.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct ConfidenceEllipse {
    /// Larger half axis, in metres.
    pub semi_major: f64,
    /// Smaller half axis, in metres.
    pub semi_minor: f64,
    /// Direction of the larger axis, in degrees clockwise from north.
    pub orientation: f64,
}

/// The box around a robot, in metres.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Dimensions {
    /// Along its body, in metres.
    pub length: Option<f64>,
    /// Across its body, in metres.
    pub width: Option<f64>,
    /// Above ground, in metres.
    pub height: Option<f64>,
}

/// The battery of a robot.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default, deny_unknown_fields)]
pub struct Battery {
    /// Percent of the usable capacity, 0..100.
    pub state_of_charge: Option<f64>,
    /// True if it is being charged.
    pub charging: bool,
}

/// Slow part of the state of a robot.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default, deny_unknown_fields)]
pub struct SlowState {
    /// Its abilities besides maneuvers.
    pub capabilities: Capabilities,
    /// The maneuvers that it can do at all.
    pub supported_tasks: TaskSet,
    /// Where it came from, newest first. A RAM takes the first 23 points, and ends at the first one
    /// that is more than 0.0131071 degrees from the one before it. Only with the feature `std`.
    #[cfg(feature = "std")]
    pub path: Vec<PastPosition>,
    /// Lights that are on; `None` for a robot without lights.
    pub lights: Option<Lights>,
    /// The signals that it shows to people; `None` for a robot that cannot show anything.
    pub signals: Option<SignalsShown>,
    /// The road segment or intersection that it is there for; `None` where that is not known.
    pub area: Option<MapPlace>,
}

/// A position that a robot came from.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct PastPosition {
    /// In degrees, north positive.
    pub latitude: f64,
    /// In degrees, east positive.
    pub longitude: f64,
    /// In metres above the WGS84 ellipsoid.
    #[serde(default)]
    pub altitude: Option<f64>,
    /// Seconds from there to the newer position before it in the list.
    #[serde(default)]
    pub duration: Option<f64>,
}

/// Signals that a robot shows to people.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct SignalsShown {
    /// To drivers.
    pub to_vehicles: PublicSignal,
    /// To pedestrians.
    pub to_pedestrians: PublicSignal,
    /// By which means.
    pub means: SignalMeans,
}

impl SignalsShown {
    /// True if anything is shown to anybody.
    #[must_use]
    pub const fn is_anything(&self) -> bool {
        !matches!(
            (self.to_vehicles, self.to_pedestrians),
            (PublicSignal::None, PublicSignal::None)
        )
    }
}

impl fmt::Display for SignalsShown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (vehicles, pedestrians) = (self.to_vehicles, self.to_pedestrians);
        write!(f, "{vehicles} to vehicles, {pedestrians} to pedestrians")?;
        let means = [
            (SignalMeans::GESTURE, "gesture"),
            (SignalMeans::DISPLAY, "display"),
            (SignalMeans::LIGHTS, "lights"),
            (SignalMeans::SPEECH, "speech"),
        ];
        let mut means = means.iter().filter(|(it, _)| self.means.contains(*it));
        if let Some((_, first)) = means.next() {
            write!(f, ", by {first}")?;
        }
        means.try_for_each(|(_, it)| write!(f, " and {it}"))
    }
}

impl fmt::Display for PublicSignal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::None => "none",
            Self::Stop => "stop",
            Self::Go => "go",
            Self::Caution => "caution",
        })
    }
}

bit_set! {
    /// Abilities of a robot besides maneuvers.
    Capabilities {
        /// Detects pedestrians who need help.
        PEDESTRIAN_DETECTION = 0,
        /// Leads a session.
        LEADING = 1,
        /// Follows in a session.
        FOLLOWING = 2,
        /// Shows signals by gestures.
        GESTURES = 3,
        /// Shows signals on a display.
        DISPLAY = 4,
        /// Speaks.
        SPEECH = 5,
    }
}

bit_set! {
    /// Lights that are on (TS 102 894-2, `ExteriorLights`).
    Lights {
        /// Low beam.
        LOW_BEAM = 0,
        /// High beam.
        HIGH_BEAM = 1,
        /// Left turn signal.
        LEFT_TURN_SIGNAL = 2,
        /// Right turn signal.
        RIGHT_TURN_SIGNAL = 3,
        /// Daytime running lights.
        DAYTIME_RUNNING = 4,
        /// Reverse light.
        REVERSE = 5,
        /// Fog light.
        FOG = 6,
        /// Parking lights.
        PARKING = 7,
    }
}

bit_set! {
    /// How a signal is shown.
    SignalMeans {
        /// By a gesture.
        GESTURE = 0,
        /// On a display.
        DISPLAY = 1,
        /// By lights.
        LIGHTS = 2,
        /// By voice.
        SPEECH = 3,
    }
}
