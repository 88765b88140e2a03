//! The standard messages and services that the node uses: their fields, and the same as Rust structs.

pub(crate) mod definitions;

use serde::{Deserialize, Serialize};

use crate::message::{Message, Service};

/// A point in time: seconds since 1970 (UTC).
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
pub struct Time {
    /// Seconds.
    pub sec: i32,
    /// And nanoseconds.
    pub nanosec: u32,
}

/// A span of time.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
pub struct Duration {
    /// Seconds.
    pub sec: i32,
    /// And nanoseconds.
    pub nanosec: u32,
}

/// When something was so, and in which frame.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
pub struct Header {
    /// When.
    pub stamp: Time,
    /// In which frame; empty without one.
    pub frame_id: String,
}

/// A text.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(rename = "String")]
pub struct Text {
    /// It.
    pub data: String,
}

/// A point, in metres.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize, Deserialize)]
pub struct Point {
    /// To the east, in the site's frame.
    pub x: f64,
    /// To the north.
    pub y: f64,
    /// Up.
    pub z: f64,
}

/// A vector.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize, Deserialize)]
pub struct Vector3 {
    /// To the east, in the site's frame.
    pub x: f64,
    /// To the north.
    pub y: f64,
    /// Up.
    pub z: f64,
}

/// An orientation.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize, Deserialize)]
pub struct Quaternion {
    /// About the axis to the east, times the sine of half the angle.
    pub x: f64,
    /// The same, to the north.
    pub y: f64,
    /// The same, up.
    pub z: f64,
    /// The cosine of half the angle.
    pub w: f64,
}

/// A place and an orientation.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize, Deserialize)]
pub struct Pose {
    /// The place.
    pub position: Point,
    /// The orientation; none is to the east.
    pub orientation: Quaternion,
}

/// A pose, with when and in which frame.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize)]
pub struct PoseStamped {
    /// When, and in which frame.
    pub header: Header,
    /// It.
    pub pose: Pose,
}

/// How a battery is. What is not known is NaN.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize)]
pub struct BatteryState {
    /// When.
    pub header: Header,
    /// In V.
    pub voltage: f32,
    /// In degrees Celsius.
    pub temperature: f32,
    /// In A, discharging negative.
    pub current: f32,
    /// In Ah.
    pub charge: f32,
    /// In Ah.
    pub capacity: f32,
    /// In Ah.
    pub design_capacity: f32,
    /// Charge of the capacity, 0 to 1.
    pub percentage: f32,
    /// 0 unknown, 1 charging, 2 discharging, 3 not charging, 4 full.
    pub power_supply_status: u8,
    /// How well it is.
    pub power_supply_health: u8,
    /// Of what kind it is.
    pub power_supply_technology: u8,
    /// Whether there is one.
    pub present: bool,
    /// Of each cell, in V.
    pub cell_voltage: Vec<f32>,
    /// Of each cell, in degrees Celsius.
    pub cell_temperature: Vec<f32>,
    /// Where it is.
    pub location: String,
    /// Its number.
    pub serial_number: String,
}

impl BatteryState {
    /// The status of one that is being charged.
    pub const CHARGING: u8 = 1;
}

/// A value of a diagnostic, by its name.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
pub struct KeyValue {
    /// What it is of.
    pub key: String,
    /// The value.
    pub value: String,
}

/// How one component is.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
pub struct DiagnosticStatus {
    /// 0 well, 1 warning, 2 error, 3 stale.
    pub level: u8,
    /// The component.
    pub name: String,
    /// How it is.
    pub message: String,
    /// The hardware.
    pub hardware_id: String,
    /// Values.
    pub values: Vec<KeyValue>,
}

/// How several components are.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
pub struct DiagnosticArray {
    /// When.
    pub header: Header,
    /// They.
    pub status: Vec<DiagnosticStatus>,
}

/// A state of a lifecycle.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
pub struct State {
    /// Its number.
    pub id: u8,
    /// Its name.
    pub label: String,
}

/// A transition of a lifecycle.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
pub struct Transition {
    /// Its number.
    pub id: u8,
    /// Its name; where it has one, the number is not looked at.
    pub label: String,
}

/// A transition that is possible.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
pub struct TransitionDescription {
    /// It.
    pub transition: Transition,
    /// From where.
    pub start_state: State,
    /// Where to.
    pub goal_state: State,
}

/// A transition that happened.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
pub struct TransitionEvent {
    /// When, in nanoseconds since 1970 (UTC).
    pub timestamp: u64,
    /// It.
    pub transition: Transition,
    /// From where.
    pub start_state: State,
    /// Where to.
    pub goal_state: State,
}

/// What a request without fields carries.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
pub struct Empty {
    /// Nothing.
    pub structure_needs_at_least_one_member: u8,
}

/// To change the state of a lifecycle.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
pub struct ChangeStateRequest {
    /// By which transition.
    pub transition: Transition,
}

/// What came of it.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
pub struct ChangeStateResponse {
    /// Whether the state was changed.
    pub success: bool,
}

/// The state of a lifecycle.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
pub struct GetStateResponse {
    /// It.
    pub current_state: State,
}

/// All states of a lifecycle.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
pub struct GetAvailableStatesResponse {
    /// They.
    pub available_states: Vec<State>,
}

/// Transitions of a lifecycle.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
pub struct GetAvailableTransitionsResponse {
    /// They.
    pub available_transitions: Vec<TransitionDescription>,
}

macro_rules! messages {
    ($($kind:ty => $name:literal;)*) => {
        $(impl Message for $kind {
            const NAME: &'static str = $name;
        })*
    };
}

messages! {
    Text => "std_msgs/msg/String";
    PoseStamped => "geometry_msgs/msg/PoseStamped";
    BatteryState => "sensor_msgs/msg/BatteryState";
    DiagnosticArray => "diagnostic_msgs/msg/DiagnosticArray";
    TransitionEvent => "lifecycle_msgs/msg/TransitionEvent";
}

macro_rules! services {
    ($($(#[$about:meta])* $kind:ident => $name:literal, $request:ty, $response:ty;)*) => {
        $($(#[$about])*
        #[derive(Clone, Copy, Debug)]
        pub enum $kind {}

        impl Service for $kind {
            const NAME: &'static str = $name;
            type Request = $request;
            type Response = $response;
        })*
    };
}

services! {
    /// Changes the state of a lifecycle.
    ChangeState => "lifecycle_msgs/srv/ChangeState", ChangeStateRequest, ChangeStateResponse;
    /// Tells the state of a lifecycle.
    GetState => "lifecycle_msgs/srv/GetState", Empty, GetStateResponse;
    /// Tells all states of a lifecycle.
    GetAvailableStates => "lifecycle_msgs/srv/GetAvailableStates", Empty, GetAvailableStatesResponse;
    /// Tells transitions of a lifecycle.
    GetAvailableTransitions => "lifecycle_msgs/srv/GetAvailableTransitions", Empty,
        GetAvailableTransitionsResponse;
}
