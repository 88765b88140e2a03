//! Data that cross the boundary: numbers, and structs of numbers.
//!
//! Every pattern of bits is a value of these types, so nothing that C leaves in them can be wrong before
//! it is looked at. Codes are octets, and the enumerations of `codes` say what they mean. A quantity that is
//! not known is NaN, a time that there is not `CROSSGUARD_NONE_MS`.

use core::ffi::c_char;

pub use crate::codes::*;

/// The version of this interface. It grows with every change that a program must be compiled for.
pub const CROSSGUARD_ABI_VERSION: u32 = 4;
/// Eight-octet words in a `CrossguardRobot`.
pub const CROSSGUARD_ROBOT_WORDS: usize = 2_560;
/// How many outputs one call can have.
pub const CROSSGUARD_OUTPUTS_MAX: usize = 96;
/// How many followers a leader can have.
pub const CROSSGUARD_FOLLOWERS_MAX: usize = 16;
/// How many task types there are.
pub const CROSSGUARD_TASKS: usize = 16;
/// Octets of a robot's name, with the NUL at its end.
pub const CROSSGUARD_NAME_LEN: usize = 32;
/// Octets of the name of a cause, with the NUL at its end.
pub const CROSSGUARD_CAUSE_LEN: usize = 64;
/// Octets that the packets of every call fit into; a call with less room is refused.
pub const CROSSGUARD_PACKETS_LEN: usize = 32_768;
/// Octets that the log lines of nearly every call fit into. A line that does not fit is left out as a
/// whole, and counted.
pub const CROSSGUARD_LOG_LEN: usize = 32_768;
/// A time in milliseconds that there is not.
pub const CROSSGUARD_NONE_MS: u32 = 0xFFFF_FFFF;
/// A lane that is not given.
pub const CROSSGUARD_NO_LANE: i8 = -128;

/// The memory of one robot. It is the caller's, may be copied and moved, and holds no address; what is in it is
/// the library's. Robots in different memory may be used from different threads at the same time.
#[repr(C)]
pub struct CrossguardRobot {
    /// Not for use.
    pub words: [u64; CROSSGUARD_ROBOT_WORDS],
}

/// A coordination session: who leads it, and its number there.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
#[repr(C)]
pub struct CrossguardSession {
    /// Station id of the leader.
    pub leader: u32,
    /// Boot counter in the upper half, count in the lower.
    pub number: u32,
}

/// Timers, limits and capabilities, as `Settings` of the protocol. Times are in milliseconds.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
#[repr(C)]
pub struct CrossguardSettings {
    /// Interval of RAM in a session.
    pub ram_period_ms: u32,
    /// How long a requester gathers offers, counted from the first.
    pub t_select_ms: u32,
    /// How long a helper stays reserved after the newest heartbeat of its requester.
    pub t_offer_ms: u32,
    /// How long a request for help stands.
    pub t_help_ms: u32,
    /// How long a leader waits for an acknowledgement before it repeats the command.
    pub t_ack_ms: u32,
    /// How long a follower goes on without a newer heartbeat or command.
    pub t_safety_ms: u32,
    /// How long a lease stands after the leader sent the newest echoed heartbeat.
    pub t_lease_ms: u32,
    /// How long a follower stays in the session after `t_safety_ms` ran out.
    pub t_leave_ms: u32,
    /// How long a robot names a session as over.
    pub t_farewell_ms: u32,
    /// How long the identity may stay locked, farewells included.
    pub t_lock_ms: u32,
    /// How long a pedestrian needs to cross at most.
    pub t_cross_ms: u32,
    /// `T_exec` by task type: how long a maneuver may run.
    pub t_exec_ms: [u32; CROSSGUARD_TASKS],
    /// Largest error of the robot's clock rate, in parts per million.
    pub drift_ppm: u32,
    /// Longest time by which the robot is told late that time has passed.
    pub delay_max_ms: u32,
    /// The maneuvers that the robot can do: bit *n* stands for task type *n*.
    pub capabilities: u16,
    /// The maneuvers under which a pedestrian may cross.
    pub guarding: u16,
    /// The maneuvers that guard from a place: the corridor opens only once the follower has reported
    /// that it is in position.
    pub holding: u16,
    /// `CrossguardFallback` by task type.
    pub fallback: [u8; CROSSGUARD_TASKS],
    /// How often a leader repeats a command, 1..15.
    pub n_ack: u8,
    /// Not used.
    pub reserved: [u8; 1],
}

/// The identifiers of one message, which no standard has assigned.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
#[repr(C)]
pub struct CrossguardMessageIdentifiers {
    /// ITS-AID (PSID).
    pub its_aid: u32,
    /// Destination port of BTP.
    pub btp_port: u16,
    /// `messageId` of the header.
    pub message_id: u8,
    /// `protocolVersion` of the header.
    pub protocol_version: u8,
}

/// Configuration of a robot.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C)]
pub struct CrossguardConfig {
    /// Its station id.
    pub station: u32,
    /// Its boot counter: larger than at any boot before, and persisted before the robot is started.
    pub boot: u16,
    /// Station type in basic container and address; 12, `lightVruVehicle`, by default.
    pub station_type: u8,
    /// Not used.
    pub reserved: u8,
    /// Its name in logs, UTF-8 that ends with NUL.
    pub name: [c_char; CROSSGUARD_NAME_LEN],
    /// Message identifiers of RAM.
    pub ram: CrossguardMessageIdentifiers,
    /// Message identifiers of RMCM.
    pub rmcm: CrossguardMessageIdentifiers,
    /// Timers, limits and capabilities.
    pub settings: CrossguardSettings,
}

/// State of the robot's body at the time of a call. NaN is *not known*.
#[derive(Clone, Copy, PartialEq, Debug)]
#[repr(C)]
pub struct CrossguardBody {
    /// Degrees, north positive.
    pub latitude_deg: f64,
    /// Degrees, east positive.
    pub longitude_deg: f64,
    /// Metres above the WGS84 ellipsoid.
    pub altitude_m: f64,
    /// Radius in metres of the circle that holds the position with 95 %.
    pub accuracy_m: f64,
    /// Direction of motion, degrees clockwise from north.
    pub heading_deg: f64,
    /// Speed over ground in m/s, not negative.
    pub speed_mps: f64,
    /// Longitudinal acceleration in m/s².
    pub acceleration_mps2: f64,
    /// Degrees per second, to the left positive.
    pub yaw_rate_dps: f64,
    /// Direction of the body, degrees clockwise from north, where it is not that of the motion.
    pub orientation_deg: f64,
    /// Metres along the body.
    pub length_m: f64,
    /// Metres across the body.
    pub width_m: f64,
    /// Metres above ground.
    pub height_m: f64,
    /// Percent of the usable battery capacity.
    pub battery_percent: f64,
    /// Whether the battery is being charged: 0 or 1.
    pub charging: u8,
    /// Build: 0 unknown, 1 humanoid, 2 quadruped, 3 wheeled, 4 tracked, 5 aerial, 6 other.
    pub category: u8,
    /// Job: 0 none, 1 traffic guard, 2 escort, 3 patrol, 4 delivery, 5 maintenance, 6 other.
    pub job_role: u8,
    /// Steered by: 0 itself, 1 a person, 2 nobody (emergency stop), 3 nobody (fault), 4 unavailable.
    pub control_mode: u8,
    /// Abilities besides maneuvers: bit 0 detects pedestrians, 1 leads, 2 follows, 3 gestures, 4
    /// has a display, 5 speaks.
    pub abilities: u8,
    /// Means of its signals to people, as its RAM tell: bit 0 gestures, 1 a display, 2 lights, 3 voice. 0
    /// for a robot that cannot; then the next two do not count.
    pub signal_means: u8,
    /// Sign to vehicles: 0 nothing, 1 stop, 2 go, 3 take care.
    pub to_vehicles: u8,
    /// Sign to pedestrians, likewise. Go is for an open corridor alone.
    pub to_pedestrians: u8,
    /// The place of the map that it is there for: 0 none, 1 a road segment, 2 an intersection.
    pub map_kind: u8,
    /// 1 where that place has a region.
    pub has_map_region: u8,
    /// The region in which its number is unique.
    pub map_region: u16,
    /// Its number.
    pub map_id: u16,
    /// Not used.
    pub reserved: [u8; 2],
}

/// Where and how a maneuver is to be done. NaN, and 0 or -128 where said, leave it to the follower.
#[derive(Clone, Copy, PartialEq, Debug)]
#[repr(C)]
pub struct CrossguardTaskParameters {
    /// Target, degrees, north positive. NaN for none.
    pub latitude_deg: f64,
    /// Target, degrees, east positive. NaN for none.
    pub longitude_deg: f64,
    /// Target, metres above the WGS84 ellipsoid. NaN if open.
    pub altitude_m: f64,
    /// Which way to face at the target, degrees clockwise from north.
    pub heading_deg: f64,
    /// Largest speed in m/s.
    pub maximum_speed_mps: f64,
    /// Smallest distance to the pedestrian in metres, 51.1 at most.
    pub pedestrian_distance_m: f64,
    /// How long the command may be executed, in milliseconds from the message on. 0 if open.
    pub validity_ms: u32,
    /// Lane instead of a position, -1..14; -128 for none.
    pub lane: i8,
    /// 1 where the position is an offset from the leader's, in degrees and metres.
    pub is_offset: u8,
    /// The place of the map where the maneuver takes place: 0 none, 1 a road segment, 2 an intersection.
    pub map_kind: u8,
    /// 1 where that place has a region.
    pub has_map_region: u8,
    /// The region in which its number is unique.
    pub map_region: u16,
    /// Its number.
    pub map_id: u16,
    /// Not used.
    pub reserved: [u8; 4],
}

/// Something that happened in the robot itself; `kind` says which fields count.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
#[repr(C)]
pub struct CrossguardEvent {
    /// `CrossguardEventKind`.
    pub kind: u8,
    /// `CrossguardUrgency`.
    pub urgency: u8,
    /// How many followers are asked for, 1..16: at most `CROSSGUARD_FOLLOWERS_MAX`.
    pub followers: u8,
    /// Task type, 0..15.
    pub task: u8,
    /// Task types that followers are asked for: bit *n* stands for task type *n*.
    pub tasks: u16,
    /// `requestID` of a maneuver.
    pub request: u8,
    /// `CrossguardUnavailability`.
    pub unavailability: u8,
    /// A station id.
    pub station: u32,
    /// Session of a maneuver.
    pub session: CrossguardSession,
    /// The crossing that the help is for, as `IntersectionReferenceID` of ISO/TS 19091: road regulator in
    /// the upper 16 bits, intersection in the lower. 0 if it is not known, which may be any.
    pub place: u32,
    /// A boot counter.
    pub boot: u16,
    /// Not used.
    pub reserved: [u8; 6],
    /// Where and how.
    pub parameters: CrossguardTaskParameters,
}

/// One output; `kind` says which fields count.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
#[repr(C)]
pub struct CrossguardOutput {
    /// `CrossguardOutputKind`.
    pub kind: u8,
    /// `CrossguardNotice`.
    pub notice: u8,
    /// `CrossguardReason`.
    pub reason: u8,
    /// `CrossguardUnavailability`.
    pub unavailability: u8,
    /// `CrossguardFallback`.
    pub policy: u8,
    /// Task type, 0..15.
    pub task: u8,
    /// `requestID` of a command.
    pub request: u8,
    /// `CrossguardMessage`.
    pub message: u8,
    /// The station that it is about.
    pub station: u32,
    /// The session that it is about.
    pub session: CrossguardSession,
    /// Where the packet begins among the packets of the turn, in octets.
    pub packet_offset: u32,
    /// Its octets: a whole `GeoNetworking` packet.
    pub packet_length: u32,
    /// Where the message in it begins, for a stack that makes packets itself.
    pub message_offset: u32,
    /// Its octets: UPER.
    pub message_length: u32,
    /// Destination port of BTP-B.
    pub port: u16,
    /// Traffic class: 0..3 for DCC profiles DP0..DP3.
    pub traffic_class: u16,
    /// For how long from now the corridor may be shown open, in milliseconds.
    pub open_ms: u32,
    /// Not used.
    pub reserved: [u8; 4],
    /// Where and how a maneuver is to be done.
    pub parameters: CrossguardTaskParameters,
}

/// The station that was heard.
#[derive(Clone, Copy, PartialEq, Debug)]
#[repr(C)]
pub struct CrossguardHeard {
    /// Degrees, north positive.
    pub latitude_deg: f64,
    /// Degrees, east positive.
    pub longitude_deg: f64,
    /// Direction of motion, degrees clockwise from north.
    pub heading_deg: f64,
    /// m/s.
    pub speed_mps: f64,
    /// How far away, in metres.
    pub distance_m: f64,
    /// Station id.
    pub station: u32,
    /// `CrossguardMessage`; `None` if nothing was understood, and then nothing else counts.
    pub message: u8,
    /// `CrossguardUnavailability` by its RAM.
    pub unavailability: u8,
    /// 1 where its RAM says that it still has a duty on the road.
    pub on_duty: u8,
    /// As in `CrossguardBody`, by its RAM; 0 where this one says nothing of it, as most do.
    pub signal_means: u8,
    /// Its sign to vehicles, as in `CrossguardBody`.
    pub to_vehicles: u8,
    /// Its sign to pedestrians, as in `CrossguardBody`.
    pub to_pedestrians: u8,
    /// The place of the map that it is there for, as in `CrossguardBody`; 0 where its RAM says nothing of it, as
    /// most do.
    pub map_kind: u8,
    /// As in `CrossguardBody`.
    pub has_map_region: u8,
    /// As in `CrossguardBody`.
    pub map_region: u16,
    /// As in `CrossguardBody`.
    pub map_id: u16,
}

/// Inputs of a call from the caller, and its outputs from the library. Buffers are the
/// caller's, and may not overlap each other or the turn.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct CrossguardTurn {
    /// In: `TimestampIts` now: milliseconds since 2004-01-01 (TAI), for messages and packets.
    pub timestamp_its: u64,
    /// In: the body now.
    pub body: CrossguardBody,
    /// In: where packets go.
    pub packets: *mut u8,
    /// In: octets there, `CROSSGUARD_PACKETS_LEN` at least.
    pub packets_capacity: usize,
    /// In: where log lines go; null for no log.
    pub log: *mut c_char,
    /// In: octets there.
    pub log_capacity: usize,
    /// In: microseconds on the log's clock, which never goes back. Give the reading by which the robot was
    /// told of time last: `crossguard validate` holds the log's clock against what the robot was told.
    pub log_at_us: u64,
    /// In: for how long the packet or message that is given has waited in this machine, in milliseconds;
    /// `CROSSGUARD_NONE_MS` if that is not known. One that waited for longer than `delay_max` is dropped.
    pub waited_ms: u32,
    /// Not used.
    pub reserved: u32,
    /// Out: octets of packets.
    pub packets_length: usize,
    /// Out: octets of log lines; each ends with a newline.
    pub log_length: usize,
    /// Out: who was heard.
    pub heard: CrossguardHeard,
    /// Out: why a packet was dropped, ends with NUL; empty if it did not.
    pub dropped: [c_char; CROSSGUARD_CAUSE_LEN],
    /// Out: how many outputs there are.
    pub outputs_length: u32,
    /// Out: how many lines did not fit into the log.
    pub log_lost: u32,
    /// Out: what the robot is to do, in this order.
    pub outputs: [CrossguardOutput; CROSSGUARD_OUTPUTS_MAX],
}

/// A leader's record of one follower.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
#[repr(C)]
pub struct CrossguardFollower {
    /// Station id.
    pub station: u32,
    /// 1 once it has taken its role.
    pub has_joined: u8,
    /// 1 while the leader's lease on it stands.
    pub has_lease: u8,
    /// 1 while a command is not acknowledged.
    pub is_outstanding: u8,
    /// `CrossguardProgress` of the newest acknowledged command.
    pub progress: u8,
    /// `requestID` of that command.
    pub request: u8,
    /// Its task type.
    pub task: u8,
    /// Not used.
    pub reserved: [u8; 2],
}

/// State of a robot.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
#[repr(C)]
pub struct CrossguardView {
    /// Station id.
    pub station: u32,
    /// Milliseconds until the robot must be told that time has passed; `CROSSGUARD_NONE_MS` if no timer
    /// is armed. At most `delay_max_ms` later.
    pub next_due_ms: u32,
    /// Milliseconds until its next periodic RAM; `CROSSGUARD_NONE_MS` outside of a session, where the
    /// caller announces the robot.
    pub next_ram_ms: u32,
    /// The session, if `has_session`.
    pub session: CrossguardSession,
    /// Boot counter.
    pub boot: u16,
    /// `CrossguardState`.
    pub state: u8,
    /// `CrossguardRole`.
    pub role: u8,
    /// `CrossguardUnavailability`.
    pub unavailability: u8,
    /// 1 while the identity is locked.
    pub is_locked: u8,
    /// 1 while it has a part in a session.
    pub has_session: u8,
    /// Leader: `CrossguardCorridor`.
    pub corridor: u8,
    /// Leader: 1 once it has yielded the place to another leader.
    pub has_yielded: u8,
    /// Follower: 1 while contact with the leader is lost.
    pub is_contact_lost: u8,
    /// Follower: `CrossguardProgress` of the newest accepted command.
    pub progress: u8,
    /// Follower: its `requestID`.
    pub request: u8,
    /// Follower: its task type.
    pub task: u8,
    /// `CrossguardDuty`: what it still does on the road, or must find clear.
    pub duty: u8,
    /// `requestID` of the maneuver whose fallback is its duty.
    pub duty_request: u8,
    /// Task type of that maneuver.
    pub duty_task: u8,
    /// Not used.
    pub reserved: [u8; 1],
    /// Session of its duty.
    pub duty_session: CrossguardSession,
    /// Leader: the leader that it has yielded the place to, if `has_yielded`.
    pub yields_to: u32,
    /// Leader: how many followers there are.
    pub followers_length: u32,
    /// Leader: the followers.
    pub followers: [CrossguardFollower; CROSSGUARD_FOLLOWERS_MAX],
}
