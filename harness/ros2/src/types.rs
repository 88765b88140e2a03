//! The types that the node uses, and their hashes.
//!
//! A type hash (RIHS01, REP-2016) is the SHA-256 of the type's description as JSON in a fixed form: names
//! and types of its fields, and those of all types in them; no comments, no constants. `rmw_zenoh` puts it
//! into every key expression, so two nodes understand each other only where they have the same.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;

use sha2::{Digest, Sha256};

use crate::idl::{Array, Base, Definition, Field, IdlError, PRIMITIVES, parts_of_service};
use crate::standard::definitions::{MESSAGES, SERVICES};

/// Our own messages, by their names, as the package `crossguard_msgs` has them.
pub const OWN: [(&str, &str); 8] = [
    (
        "crossguard_msgs/msg/Command",
        include_str!("../crossguard_msgs/msg/Command.msg"),
    ),
    (
        "crossguard_msgs/msg/Corridor",
        include_str!("../crossguard_msgs/msg/Corridor.msg"),
    ),
    (
        "crossguard_msgs/msg/Event",
        include_str!("../crossguard_msgs/msg/Event.msg"),
    ),
    (
        "crossguard_msgs/msg/Follower",
        include_str!("../crossguard_msgs/msg/Follower.msg"),
    ),
    (
        "crossguard_msgs/msg/Person",
        include_str!("../crossguard_msgs/msg/Person.msg"),
    ),
    (
        "crossguard_msgs/msg/Session",
        include_str!("../crossguard_msgs/msg/Session.msg"),
    ),
    (
        "crossguard_msgs/msg/Status",
        include_str!("../crossguard_msgs/msg/Status.msg"),
    ),
    (
        "crossguard_msgs/msg/Task",
        include_str!("../crossguard_msgs/msg/Task.msg"),
    ),
];

/// What a message without fields has instead, because DDS wants one.
const EMPTY: &str = "uint8 structure_needs_at_least_one_member";

/// Definitions by name.
#[derive(Clone, Debug, Default)]
pub struct Types(BTreeMap<String, Definition>);

/// All types that the node uses.
///
/// # Panics
/// If a definition that comes along means nothing, which a test rules out.
pub static TYPES: LazyLock<Types> = LazyLock::new(|| Types::shipped().expect("a test parses them"));

impl Types {
    /// Types that come along: our own, and the standard ones.
    ///
    /// # Errors
    /// The first that means nothing.
    pub fn shipped() -> Result<Self, IdlError> {
        let mut types = Self::default();
        for (name, text) in OWN.iter().chain(&MESSAGES) {
            types.add_message(name, text)?;
        }
        for (name, text) in &SERVICES {
            types.add_service(name, text)?;
        }
        Ok(types)
    }

    /// Adds a message.
    ///
    /// # Errors
    /// When its text means nothing.
    pub fn add_message(&mut self, name: &str, text: &str) -> Result<(), IdlError> {
        let mut definition = Definition::parse(name, text)?;
        if definition.fields.is_empty() {
            definition.fields = Definition::parse(name, EMPTY)?.fields;
        }
        self.0.insert(name.to_owned(), definition);
        Ok(())
    }

    /// Adds a service: its request and response, the event that introspection has for it, and itself
    /// as a type of these three.
    ///
    /// # Errors
    /// When its text means nothing.
    pub fn add_service(&mut self, name: &str, text: &str) -> Result<(), IdlError> {
        let (request, response) = parts_of_service(name, text)?;
        self.add_message(&format!("{name}_Request"), request)?;
        self.add_message(&format!("{name}_Response"), response)?;
        let part = |field: &str, of: &str, array| Field {
            name: field.to_owned(),
            base: Base::Nested(of.to_owned()),
            array,
        };
        let [request, response, event] =
            ["Request", "Response", "Event"].map(|part| format!("{name}_{part}"));
        let event_fields = vec![
            part("info", "service_msgs/msg/ServiceEventInfo", Array::One),
            part("request", &request, Array::Bounded(1)),
            part("response", &response, Array::Bounded(1)),
        ];
        let fields = vec![
            part("request_message", &request, Array::One),
            part("response_message", &response, Array::One),
            part("event_message", &event, Array::One),
        ];
        for (name, fields) in [(event.as_str(), event_fields), (name, fields)] {
            let definition = Definition {
                name: name.to_owned(),
                fields,
                constants: Vec::new(),
            };
            self.0.insert(name.to_owned(), definition);
        }
        Ok(())
    }

    /// All definitions.
    pub fn iter(&self) -> impl Iterator<Item = &Definition> {
        self.0.values()
    }

    /// The definition of this name.
    ///
    /// # Errors
    /// When there is none.
    pub fn get(&self, name: &str) -> Result<&Definition, IdlError> {
        let found = self.0.get(name);
        found.ok_or_else(|| IdlError::Unknown(name.to_owned()))
    }

    /// The hash of a type, like `RIHS01_df66…`.
    ///
    /// # Errors
    /// When it, or a type in it, is not known.
    pub fn hash(&self, name: &str) -> Result<String, IdlError> {
        let digest = Sha256::digest(self.description(name)?.as_bytes());
        Ok(format!("RIHS01_{}", hex::encode(digest)))
    }

    /// The description that is hashed: JSON with one blank after each comma and colon.
    fn description(&self, name: &str) -> Result<String, IdlError> {
        let mut nested = BTreeSet::new();
        self.collect(name, &mut nested)?;
        let nested: Result<Vec<_>, _> = nested.iter().map(|name| self.individual(name)).collect();
        Ok(format!(
            r#"{{"type_description": {}, "referenced_type_descriptions": [{}]}}"#,
            self.individual(name)?,
            nested?.join(", ")
        ))
    }

    fn collect(&self, name: &str, nested: &mut BTreeSet<String>) -> Result<(), IdlError> {
        for field in &self.get(name)?.fields {
            if let Base::Nested(inner) = &field.base
                && nested.insert(inner.clone())
            {
                self.collect(inner, nested)?;
            }
        }
        Ok(())
    }

    fn individual(&self, name: &str) -> Result<String, IdlError> {
        let fields: Vec<_> = self.get(name)?.fields.iter().map(described).collect();
        Ok(format!(
            r#"{{"type_name": "{name}", "fields": [{}]}}"#,
            fields.join(", ")
        ))
    }
}

/// A field as `type_description_interfaces/msg/Field` has it, without its default value.
fn described(field: &Field) -> String {
    let (base_id, string_capacity, nested) = match &field.base {
        Base::Primitive(name) => {
            let primitive = PRIMITIVES.iter().find(|(it, _)| it == name);
            (primitive.map_or(0, |(_, id)| *id), 0, "")
        }
        Base::String(0) => (17, 0, ""),
        Base::String(bound) => (21, *bound, ""),
        Base::Nested(name) => (1, 0, name.as_str()),
    };
    let (offset, capacity) = match field.array {
        Array::One => (0, 0),
        Array::Fixed(size) => (48, size),
        Array::Bounded(bound) => (96, bound),
        Array::Unbounded => (144, 0),
    };
    format!(
        r#"{{"name": "{}", "type": {{"type_id": {}, "capacity": {capacity}, "string_capacity": {string_capacity}, "nested_type_name": "{nested}"}}}}"#,
        field.name,
        base_id + offset
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_type_that_is_not_known_is_named() {
        let mut types = Types::default();
        types.add_message("p/msg/M", "q/Other other").unwrap();
        let error = types.hash("p/msg/M").unwrap_err();
        assert_eq!(error.to_string(), "q/msg/Other is not defined");
    }

    #[test]
    fn comments_and_constants_do_not_change_a_hash_and_names_do() {
        let hash = |text: &str| {
            let mut types = Types::default();
            types.add_message("p/msg/M", text).unwrap();
            types.hash("p/msg/M").unwrap()
        };
        assert_eq!(hash("uint8 a"), hash("# it\nuint8 RED=1\nuint8 a # it"));
        for other in [
            "uint8 b",
            "int8 a",
            "uint8[] a",
            "uint8[2] a",
            "uint8[<=2] a",
        ] {
            assert_ne!(hash("uint8 a"), hash(other));
        }
    }
}
