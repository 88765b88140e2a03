//! The definitions of messages, their hashes, and the structs that stand for them.

use std::collections::BTreeMap;

use crossguard_ros2::idl::{Array, Base, Definition};
use crossguard_ros2::types::{OWN, TYPES, Types};
use crossguard_ros2::{msgs, standard};
use serde::de::DeserializeOwned;
use serde_reflection::{ContainerFormat, Format, Named, Samples, Tracer, TracerConfig};

/// Hashes that others have published: the design document of `rmw_zenoh` for the first two, `natnet_zenoh`
/// for the third (its `char` is an octet), and ROS 2 Jazzy by its `rosbags` 0.11 for the others.
const PUBLISHED: [(&str, &str); 15] = [
    (
        "std_msgs/msg/String",
        "df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18",
    ),
    (
        "example_interfaces/srv/AddTwoInts",
        "e118de6bf5eeb66a2491b5bda11202e7b68f198d6f67922cf30364858239c81a",
    ),
    (
        "service_msgs/msg/ServiceEventInfo",
        "41bcbbe07a75c9b52bc96bfd5c24d7f0fc0a08c0cb7921b3373c5732345a6f45",
    ),
    (
        "std_msgs/msg/Header",
        "f49fb3ae2cf070f793645ff749683ac6b06203e41c891e17701b1cb597ce6a01",
    ),
    (
        "builtin_interfaces/msg/Time",
        "b106235e25a4c5ed35098aa0a61a3ee9c9b18d197f398b0e4206cea9acf9c197",
    ),
    (
        "builtin_interfaces/msg/Duration",
        "e8d009f659816f758b75334ee1a9ca5b5c0b859843261f14c7f937349599d93b",
    ),
    (
        "geometry_msgs/msg/Vector3",
        "cc12fe83e4c02719f1ce8070bfd14aecd40f75a96696a67a2a1f37f7dbb0765d",
    ),
    (
        "geometry_msgs/msg/PoseStamped",
        "10f3786d7d40fd2b54367835614bff85d4ad3b5dab62bf8bca0cc232d73b4cd8",
    ),
    (
        "diagnostic_msgs/msg/KeyValue",
        "d68081eaa540288c5440753baecef0c4e16e81a5f78ad68902ded5100413bb42",
    ),
    (
        "diagnostic_msgs/msg/DiagnosticStatus",
        "b0e3e692ea2d54a8af2f4ef1930e81556a2db55216b771f8a7d2724ed47bf0e4",
    ),
    (
        "diagnostic_msgs/msg/DiagnosticArray",
        "5a8a36efb05fb25070fa0fb3810290c0e6cd4862b54a8fb975a1ee8dc55a333e",
    ),
    (
        "lifecycle_msgs/msg/State",
        "dd2d02b82f3ebc858e53c431b1e6e91f3ffc71436fc81d0715214ac6ee2107a0",
    ),
    (
        "lifecycle_msgs/msg/Transition",
        "c65d7b31ea134cba4f54fc867b817979be799f7452035cd35fac9b7421fb3424",
    ),
    (
        "lifecycle_msgs/msg/TransitionDescription",
        "c5f1cd4bb1ad2ba0e3329d4ac7015c52a674a72c1faf7974c37a33f4f6048b28",
    ),
    (
        "lifecycle_msgs/msg/TransitionEvent",
        "d5f8873a2f0146498f812d7885c7327ce27e463d36811d8792f35ee38c0d6c38",
    ),
];

#[test]
fn hashes_are_those_that_others_have_published() {
    let mut types = Types::shipped().unwrap();
    let two_ints = "int64 a\nint64 b\n---\nint64 sum\n";
    types
        .add_service("example_interfaces/srv/AddTwoInts", two_ints)
        .unwrap();
    for (name, hash) in PUBLISHED {
        assert_eq!(types.hash(name), Ok(format!("RIHS01_{hash}")), "{name}");
    }
}

#[test]
fn every_type_that_comes_along_has_a_hash_of_its_own() {
    let hashes: BTreeMap<_, _> = TYPES
        .iter()
        .map(|it| (TYPES.hash(&it.name).unwrap(), &it.name))
        .collect();
    assert_eq!(hashes.len(), TYPES.iter().count(), "{hashes:?}");
}

/// Whether a field of a definition and a field of a struct are the same on the wire.
fn is_same(base: &Base, array: Array, format: &Format) -> bool {
    if array == Array::Unbounded {
        return matches!(format, Format::Seq(inner) if is_same(base, Array::One, inner));
    }
    let is_known = match (base, format) {
        (Base::Nested(name), Format::TypeName(other)) => name.ends_with(&format!("/{other}")),
        (Base::String(0), Format::Str) => true,
        (Base::Primitive(name), format) => match format {
            Format::Bool => *name == "bool",
            Format::U8 => ["uint8", "byte"].contains(name),
            Format::U16 => *name == "uint16",
            Format::U32 => *name == "uint32",
            Format::U64 => *name == "uint64",
            Format::I32 => *name == "int32",
            Format::F32 => *name == "float32",
            Format::F64 => *name == "float64",
            _ => false,
        },
        _ => false,
    };
    is_known && array == Array::One
}

fn assert_same(definition: &Definition, fields: &[Named<Format>]) {
    let name = &definition.name;
    assert_eq!(definition.fields.len(), fields.len(), "{name}");
    for (field, other) in definition.fields.iter().zip(fields) {
        assert_eq!(field.name, other.name, "{name}");
        assert!(
            is_same(&field.base, field.array, &other.value),
            "{name}: '{field}' in the definition is {:?} in the struct",
            other.value
        );
    }
}

/// Compares a struct, and those in it, with definitions.
fn compare<T: DeserializeOwned>(name: &str) {
    let mut tracer = Tracer::new(TracerConfig::default());
    tracer.trace_type::<T>(&Samples::new()).unwrap();
    let (_, simple) = name.rsplit_once('/').unwrap();
    for (nested, container) in &tracer.registry().unwrap() {
        // The structs of services have names of their own.
        let is_part = ["Request", "Response", "Empty"]
            .iter()
            .any(|it| nested.ends_with(it));
        let is_it = |known: &&Definition| {
            if is_part || nested == simple {
                known.name == name
            } else {
                known.name.ends_with(&format!("/msg/{nested}"))
            }
        };
        let definition = TYPES.iter().find(is_it);
        let definition = definition.unwrap_or_else(|| panic!("{nested} is not defined"));
        let ContainerFormat::Struct(fields) = container else {
            panic!("{nested}: {container:?}")
        };
        assert_same(definition, fields);
    }
}

#[test]
fn structs_and_definitions_say_the_same() {
    compare::<msgs::Command>("crossguard_msgs/msg/Command");
    compare::<msgs::Corridor>("crossguard_msgs/msg/Corridor");
    compare::<msgs::Event>("crossguard_msgs/msg/Event");
    compare::<msgs::Follower>("crossguard_msgs/msg/Follower");
    compare::<msgs::Person>("crossguard_msgs/msg/Person");
    compare::<msgs::Session>("crossguard_msgs/msg/Session");
    compare::<msgs::Status>("crossguard_msgs/msg/Status");
    compare::<msgs::Task>("crossguard_msgs/msg/Task");
    compare::<standard::Text>("std_msgs/msg/String");
    compare::<standard::PoseStamped>("geometry_msgs/msg/PoseStamped");
    compare::<standard::BatteryState>("sensor_msgs/msg/BatteryState");
    compare::<standard::DiagnosticArray>("diagnostic_msgs/msg/DiagnosticArray");
    compare::<standard::TransitionEvent>("lifecycle_msgs/msg/TransitionEvent");
    compare::<standard::ChangeStateRequest>("lifecycle_msgs/srv/ChangeState_Request");
    compare::<standard::ChangeStateResponse>("lifecycle_msgs/srv/ChangeState_Response");
    compare::<standard::Empty>("lifecycle_msgs/srv/GetState_Request");
    compare::<standard::GetStateResponse>("lifecycle_msgs/srv/GetState_Response");
    let states = "lifecycle_msgs/srv/GetAvailableStates_Response";
    compare::<standard::GetAvailableStatesResponse>(states);
    let transitions = "lifecycle_msgs/srv/GetAvailableTransitions_Response";
    compare::<standard::GetAvailableTransitionsResponse>(transitions);
}

#[test]
fn constants_are_the_same_in_rust() {
    let mut of_files = Vec::new();
    for (name, text) in OWN {
        for constant in Definition::parse(name, text).unwrap().constants {
            assert_eq!(constant.base, Base::Primitive("uint8"), "{}", constant.name);
            let value: u8 = constant.value.parse().unwrap();
            of_files.push((name.to_owned(), constant.name, value));
        }
    }
    let of_rust = msgs::CONSTANTS.iter();
    let mut of_rust: Vec<_> = of_rust
        .map(|(of, name, value)| ((*of).to_owned(), (*name).to_owned(), *value))
        .collect();
    of_files.sort();
    of_rust.sort();
    assert_eq!(of_files, of_rust);
}

#[test]
fn the_package_for_ros_builds_all_messages_and_names_what_they_use() {
    let cmake = include_str!("../crossguard_msgs/CMakeLists.txt");
    let package = include_str!("../crossguard_msgs/package.xml");
    assert_eq!(cmake.matches(".msg\"").count(), OWN.len());
    for (name, text) in OWN {
        let (_, simple) = name.rsplit_once('/').unwrap();
        assert!(cmake.contains(&format!("\"msg/{simple}.msg\"")), "{name}");
        for field in Definition::parse(name, text).unwrap().fields {
            let Base::Nested(of) = &field.base else {
                continue;
            };
            let used = of.split('/').next().unwrap();
            let is_named = package.contains(&format!("<depend>{used}</depend>"));
            assert!(is_named || used == "crossguard_msgs", "{name}: {used}");
        }
    }
}
