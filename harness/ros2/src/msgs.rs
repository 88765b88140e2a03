//! The messages of the package `crossguard_msgs` as Rust structs. What their fields mean, with units and
//! constants, is in the `.msg` files; a test compares the two.
#![expect(
    missing_docs,
    reason = "the .msg files say what fields mean, once, and a test holds these structs against them"
)]

use serde::{Deserialize, Serialize};

use crate::message::Message;
use crate::standard::{Duration, Header, Point, Vector3};

/// A coordination session.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
pub struct Session {
    pub leader: u32,
    pub boot: u16,
    pub count: u16,
}

/// The kind of a maneuver.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct Task {
    pub r#type: u8,
}

/// What a leader knows of one follower.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
pub struct Follower {
    pub station: u32,
    pub has_joined: bool,
    pub task: Task,
    pub progress: u8,
    pub has_lease: bool,
}

/// How a robot is.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
pub struct Status {
    pub header: Header,
    pub robot: String,
    pub station: u32,
    pub boot: u16,
    pub state: u8,
    pub role: u8,
    pub availability: u8,
    pub in_session: bool,
    pub session: Session,
    pub followers: Vec<Follower>,
    pub executes: Task,
    pub corridor: u8,
    pub has_yielded: bool,
    pub yields_to: u32,
    pub duty: u8,
    pub duty_session: Session,
    pub duty_request: u8,
}

/// Whether a pedestrian may cross.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
pub struct Corridor {
    pub header: Header,
    pub station: u32,
    pub open: bool,
    pub valid_for: Duration,
    pub reason: u8,
    pub follower: u32,
    pub leader: u32,
    pub road_occupied: bool,
    pub in_session: bool,
    pub session: Session,
    pub text: String,
}

/// Something that happened at a robot.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize)]
pub struct Event {
    pub header: Header,
    pub kind: u8,
    pub in_session: bool,
    pub session: Session,
    pub station: u32,
    pub request: u8,
    pub task: Task,
    pub has_target: bool,
    pub target: Point,
    pub maximum_speed: f64,
    pub map_place: String,
    pub policy: u8,
    pub text: String,
}

/// What the application of a robot tells it.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize)]
pub struct Command {
    pub kind: u8,
    pub followers: u8,
    pub urgency: u8,
    pub tasks: Vec<Task>,
    pub place: u32,
    pub follower: u32,
    pub task: Task,
    pub has_target: bool,
    pub target: Point,
    pub maximum_speed: f64,
    pub map_place: String,
    pub session: Session,
    pub request: u8,
    pub availability: u8,
    pub to_vehicles: u8,
    pub to_pedestrians: u8,
    pub signal_means: u8,
    pub job_role: u8,
}

/// A person that the robot's sensors report.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize, Deserialize)]
pub struct Person {
    pub id: u32,
    pub position: Point,
    pub velocity: Vector3,
    pub kind: u8,
    pub confidence: f32,
}

macro_rules! messages {
    ($($kind:ty => $name:literal { $($constant:ident = $value:expr),* $(,)? })*) => {
        $(impl Message for $kind {
            const NAME: &'static str = concat!("crossguard_msgs/msg/", $name);
        }

        impl $kind {
            $(pub const $constant: u8 = $value;)*
        })*

        /// The constants of the messages: name of the message, name of the constant, value.
        pub const CONSTANTS: &[(&str, &str, u8)] = &[
            $($((<$kind>::NAME, stringify!($constant), $value),)*)*
        ];
    };
}

messages! {
    Session => "Session" {}
    Task => "Task" {
        NONE = 255,
        // <named tasks>
        INITIAL_POS = 0,
        MOVE = 1,
        BLOCK = 2,
        // </named tasks>
    }
    Follower => "Follower" {
        PROGRESS_NONE = 0, PROGRESS_EXECUTING = 1, PROGRESS_COMPLETED = 2, PROGRESS_FAILED = 3,
        PROGRESS_SAFE_IDLE = 4, PROGRESS_IN_POSITION = 5,
    }
    Status => "Status" {
        STATE_INACTIVE = 0, STATE_IDLE = 1, STATE_HELP_REQUESTED = 2, STATE_ROLE_ESTABLISHED = 3,
        STATE_MANEUVER_EXECUTING = 4,
        ROLE_NONE = 0, ROLE_REQUESTER = 1, ROLE_HELPER = 2, ROLE_LEADER = 3, ROLE_FOLLOWER = 4,
        AVAILABLE = 0, LOW_BATTERY = 1, TELEOPERATED = 2, EMERGENCY_STOP = 3, LOCAL_FAULT = 4,
        NOT_SAFE = 5,
        CORRIDOR_CLEAR = 0, CORRIDOR_OPEN = 1, CORRIDOR_CLEARING = 2,
        DUTY_NONE = 0, DUTY_FALLING_BACK = 1, DUTY_CROSSING = 2,
    }
    Corridor => "Corridor" {
        REASON_NONE = 0, REASON_INACTIVE = 1, REASON_NOT_LEADING = 2, REASON_NOT_OPENED = 3,
        REASON_NOT_ENGAGED = 4, REASON_FOLLOWER_MISSING = 5, REASON_SESSION_ENDED = 6,
        REASON_APPLICATION = 7, REASON_STALE = 8, REASON_YIELDED = 9,
    }
    Event => "Event" {
        START_MANEUVER = 1, STOP_MANEUVER = 2, FALL_BACK = 3, LOCK_IDENTITY = 4, UNLOCK_IDENTITY = 5,
        ROLES_ESTABLISHED = 20, FOLLOWER_JOINED = 21, FOLLOWER_GONE = 22, LEASE_GRANTED = 23,
        LEASE_EXPIRED = 24, COMMAND_ACKNOWLEDGED = 25, COMMAND_REJECTED = 26, MANEUVER_REPORTED = 27,
        MANEUVER_COMPLETED = 28, MANEUVER_FAILED = 29, FOLLOWER_SAFE_IDLE = 30, SESSION_ENDED = 31,
        MANEUVER_IN_POSITION = 32, OFFER_LAPSED = 33, YIELDED = 34,
        OFFERING = 40, JOINED = 41, RELEASED = 42, CONTACT_LOST = 43, CONTACT_REGAINED = 44,
        COMMAND_IGNORED = 60, COMMAND_REFUSED = 61,
        POLICY_NONE = 0, POLICY_STOP_IN_PLACE = 1, POLICY_GO_TO_SAFE_POSITION = 2,
        POLICY_HOLD_UNTIL_CLEAR = 3, POLICY_ESCORT_TO_KERB = 4,
    }
    Command => "Command" {
        DETECT = 1, ORDER = 2, DONE = 3, FAIL = 4, OPEN_CORRIDOR = 5, CLOSE_CORRIDOR = 6,
        TASK_COMPLETED = 7, LEAVE = 8, SET_AVAILABILITY = 9, IN_POSITION = 10, ROAD_CLEAR = 11,
        SHOW = 12, JOB = 13, SERVE = 14,
        URGENCY_LOW = 0, URGENCY_MEDIUM = 1, URGENCY_HIGH = 2, URGENCY_EMERGENCY = 3,
        SIGNAL_NONE = 0, SIGNAL_STOP = 1, SIGNAL_GO = 2, SIGNAL_CAUTION = 3,
        MEANS_GESTURE = 1, MEANS_DISPLAY = 2, MEANS_LIGHTS = 4, MEANS_SPEECH = 8,
        ROLE_NONE = 0, ROLE_TRAFFIC_GUARD = 1, ROLE_ESCORT = 2, ROLE_PATROL = 3, ROLE_DELIVERY = 4,
        ROLE_MAINTENANCE = 5, ROLE_OTHER = 6,
    }
    Person => "Person" {
        PEDESTRIAN = 0, BICYCLIST = 1, MOTORCYCLIST = 2, ANIMAL = 3, WHEELCHAIR_USER = 4, VEHICLE = 5,
    }
}

impl Default for Task {
    /// No maneuver.
    fn default() -> Self {
        Self { r#type: Self::NONE }
    }
}
