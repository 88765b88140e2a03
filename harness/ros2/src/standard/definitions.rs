//! The fields of the standard messages and services.
//!
//! Fields and ids are those of ROS 2 Jazzy; comments and constants, which do not change a hash, are not
//! repeated here.

/// The fields of the standard messages, by their names.
pub(crate) const MESSAGES: [(&str, &str); 18] = [
    ("builtin_interfaces/msg/Time", "int32 sec\nuint32 nanosec"),
    (
        "builtin_interfaces/msg/Duration",
        "int32 sec\nuint32 nanosec",
    ),
    (
        "std_msgs/msg/Header",
        "builtin_interfaces/Time stamp\nstring frame_id",
    ),
    ("std_msgs/msg/String", "string data"),
    ("geometry_msgs/msg/Point", "float64 x\nfloat64 y\nfloat64 z"),
    (
        "geometry_msgs/msg/Vector3",
        "float64 x\nfloat64 y\nfloat64 z",
    ),
    (
        "geometry_msgs/msg/Quaternion",
        "float64 x\nfloat64 y\nfloat64 z\nfloat64 w",
    ),
    (
        "geometry_msgs/msg/Pose",
        "Point position\nQuaternion orientation",
    ),
    (
        "geometry_msgs/msg/PoseStamped",
        "std_msgs/Header header\nPose pose",
    ),
    (
        "sensor_msgs/msg/BatteryState",
        "std_msgs/Header header\nfloat32 voltage\nfloat32 temperature\nfloat32 current\nfloat32 charge\n\
         float32 capacity\nfloat32 design_capacity\nfloat32 percentage\nuint8 power_supply_status\n\
         uint8 power_supply_health\nuint8 power_supply_technology\nbool present\nfloat32[] cell_voltage\n\
         float32[] cell_temperature\nstring location\nstring serial_number",
    ),
    ("diagnostic_msgs/msg/KeyValue", "string key\nstring value"),
    (
        "diagnostic_msgs/msg/DiagnosticStatus",
        "byte level\nstring name\nstring message\nstring hardware_id\nKeyValue[] values",
    ),
    (
        "diagnostic_msgs/msg/DiagnosticArray",
        "std_msgs/Header header\nDiagnosticStatus[] status",
    ),
    ("lifecycle_msgs/msg/State", "uint8 id\nstring label"),
    ("lifecycle_msgs/msg/Transition", "uint8 id\nstring label"),
    (
        "lifecycle_msgs/msg/TransitionDescription",
        "Transition transition\nState start_state\nState goal_state",
    ),
    (
        "lifecycle_msgs/msg/TransitionEvent",
        "uint64 timestamp\nTransition transition\nState start_state\nState goal_state",
    ),
    (
        "service_msgs/msg/ServiceEventInfo",
        "uint8 event_type\nbuiltin_interfaces/Time stamp\nchar[16] client_gid\nint64 sequence_number",
    ),
];

/// The fields of the standard services, by their names.
pub(crate) const SERVICES: [(&str, &str); 4] = [
    (
        "lifecycle_msgs/srv/ChangeState",
        "lifecycle_msgs/Transition transition\n---\nbool success",
    ),
    (
        "lifecycle_msgs/srv/GetState",
        "---\nlifecycle_msgs/State current_state",
    ),
    (
        "lifecycle_msgs/srv/GetAvailableStates",
        "---\nlifecycle_msgs/State[] available_states",
    ),
    (
        "lifecycle_msgs/srv/GetAvailableTransitions",
        "---\nlifecycle_msgs/TransitionDescription[] available_transitions",
    ),
];
