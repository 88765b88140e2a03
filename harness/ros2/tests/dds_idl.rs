//! The messages as IDL, for nodes on DDS: the committed file is what the `.msg` files make. `CROSSGUARD_BLESS=1` writes
//! it.
//!
//! Names of modules and types are those of ROS 2 on DDS (`package::msg::dds_::Name_`), by which its nodes find each
//! other; names of fields are not on the wire.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::Path;

use crossguard_ros2::idl::{Array, Base, Definition, Field};
use crossguard_ros2::types::{OWN, TYPES};

/// The standard messages that go along.
const STANDARD: [&str; 2] = [
    "geometry_msgs/msg/PoseStamped",
    "diagnostic_msgs/msg/DiagnosticArray",
];

/// The type that is called so, as IDL has it.
fn primitive(name: &str) -> &str {
    match name {
        "bool" => "boolean",
        "byte" => "octet",
        "char" => "uint8",
        "float32" => "float",
        "float64" => "double",
        "wstring" => panic!("no message has one"),
        integer => integer,
    }
}

fn member(field: &Field) -> String {
    let base = match &field.base {
        Base::Primitive(name) => primitive(name).to_owned(),
        Base::String(0) => "string".to_owned(),
        Base::String(bound) => format!("string<{bound}>"),
        Base::Nested(name) => scoped(name),
    };
    let name = &field.name;
    match field.array {
        Array::One => format!("{base} {name}"),
        Array::Fixed(size) => format!("{base} {name}[{size}]"),
        Array::Bounded(bound) => format!("sequence<{base}, {bound}> {name}"),
        Array::Unbounded => format!("sequence<{base}> {name}"),
    }
}

/// `package/msg/Name` as IDL names it.
fn scoped(name: &str) -> String {
    let [package, kind, simple] = parts(name);
    format!("{package}::{kind}::dds_::{simple}_")
}

fn parts(name: &str) -> [&str; 3] {
    let parts: Vec<_> = name.split('/').collect();
    parts.try_into().unwrap()
}

/// Adds a definition behind the ones that it is made of.
fn add(name: &str, done: &mut BTreeSet<String>, text: &mut String) {
    if !done.insert(name.to_owned()) {
        return;
    }
    let definition: &Definition = TYPES.get(name).unwrap();
    for field in &definition.fields {
        if let Base::Nested(inner) = &field.base {
            add(inner, done, text);
        }
    }
    let [package, kind, simple] = parts(name);
    write!(
        text,
        "\nmodule {package} {{ module {kind} {{ module dds_ {{\n"
    )
    .unwrap();
    if !definition.constants.is_empty() {
        writeln!(text, "  module {simple}_Constants {{").unwrap();
        for constant in &definition.constants {
            let Base::Primitive(base) = constant.base else {
                panic!("{constant:?}")
            };
            let (base, name, value) = (primitive(base), &constant.name, &constant.value);
            writeln!(text, "    const {base} {name} = {value};").unwrap();
        }
        text.push_str("  };\n");
    }
    writeln!(text, "  @final struct {simple}_ {{").unwrap();
    for field in &definition.fields {
        writeln!(text, "    {};", member(field)).unwrap();
    }
    text.push_str("  };\n}; }; };\n");
}

#[test]
fn the_idl_is_what_the_messages_make() {
    let mut text = String::from(
        "// Generated from the messages of crossguard_msgs, and the standard ones that go along, by the test dds_idl;\n\
         // cargo xtask bless crossguard_msgs.idl writes it. Units and meanings are in the .msg files.\n",
    );
    let mut done = BTreeSet::new();
    for name in OWN.iter().map(|(name, _)| *name).chain(STANDARD) {
        add(name, &mut done, &mut text);
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("dds/crossguard_msgs.idl");
    if std::env::var_os("CROSSGUARD_BLESS").is_some() {
        std::fs::write(&path, &text).unwrap();
    }
    let committed = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        committed == text,
        "dds/crossguard_msgs.idl is not what the messages make; run: cargo xtask bless crossguard_msgs.idl"
    );
}
