//! Definitions of messages and services, as `.msg` and `.srv` files have them.
//!
//! Understood is what the messages here use: primitive types, bounded and unbounded strings, arrays of
//! all three kinds, constants, nested messages, comments. There are no default values.

use std::fmt;

/// A message: its fields in order, and its constants.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Definition {
    /// Its full name, like `std_msgs/msg/Header`.
    pub name: String,
    /// Its fields, in order.
    pub fields: Vec<Field>,
    /// Its constants, in order.
    pub constants: Vec<Constant>,
}

/// A field of a message.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Field {
    /// Its name.
    pub name: String,
    /// Its type, or that of its elements.
    pub base: Base,
    /// Whether it is one value or several.
    pub array: Array,
}

/// A constant of a message.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Constant {
    /// Its name.
    pub name: String,
    /// Its type.
    pub base: Base,
    /// Its value, as it is written.
    pub value: String,
}

/// The type of a value.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Base {
    /// One of [`PRIMITIVES`], by its name.
    Primitive(&'static str),
    /// A string of this many characters at most; 0 is any number.
    String(u32),
    /// Another message, by its full name.
    Nested(String),
}

/// How many values there are.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Array {
    /// One.
    One,
    /// This many.
    Fixed(u32),
    /// Up to this many.
    Bounded(u32),
    /// Any number.
    Unbounded,
}

/// The names of primitive types, with their ids in `type_description_interfaces/msg/FieldType`.
/// `char` is an unsigned octet in ROS 2.
pub const PRIMITIVES: [(&str, u8); 14] = [
    ("bool", 15),
    ("byte", 16),
    ("char", 3),
    ("int8", 2),
    ("uint8", 3),
    ("int16", 4),
    ("uint16", 5),
    ("int32", 6),
    ("uint32", 7),
    ("int64", 8),
    ("uint64", 9),
    ("float32", 10),
    ("float64", 11),
    ("wstring", 18),
];

/// Why a definition means nothing.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum IdlError {
    /// A line is not understood.
    #[error("{name}: '{line}' is not a field or a constant that is understood here")]
    Line {
        /// The message.
        name: String,
        /// The line.
        line: String,
    },
    /// A service has no line of three dashes, or several.
    #[error("{0}: a service has one line '---'")]
    Separator(String),
    /// A type is not known.
    #[error("{0} is not defined")]
    Unknown(String),
}

impl Definition {
    /// Understands the text of a `.msg` file.
    ///
    /// # Errors
    /// The first line that means nothing.
    pub fn parse(name: &str, text: &str) -> Result<Self, IdlError> {
        let mut definition = Self {
            name: name.to_owned(),
            fields: Vec::new(),
            constants: Vec::new(),
        };
        for line in text.lines() {
            let line = line.split('#').next().unwrap_or_default().trim();
            if !line.is_empty() && definition.line(line).is_none() {
                return Err(IdlError::Line {
                    name: name.to_owned(),
                    line: line.to_owned(),
                });
            }
        }
        Ok(definition)
    }

    fn line(&mut self, line: &str) -> Option<()> {
        let (kind, rest) = line.split_once(char::is_whitespace)?;
        let (base, array) = self.kind(kind)?;
        if let Some((name, value)) = rest.split_once('=') {
            self.constants.push(Constant {
                name: identifier(name)?,
                base,
                value: value.trim().to_owned(),
            });
        } else {
            self.fields.push(Field {
                name: identifier(rest)?,
                base,
                array,
            });
        }
        Some(())
    }

    fn kind(&self, kind: &str) -> Option<(Base, Array)> {
        let (base, array) = match kind.strip_suffix(']').and_then(|it| it.split_once('[')) {
            None => (kind, Array::One),
            Some((base, "")) => (base, Array::Unbounded),
            Some((base, size)) => match size.strip_prefix("<=") {
                Some(bound) => (base, Array::Bounded(bound.parse().ok()?)),
                None => (base, Array::Fixed(size.parse().ok()?)),
            },
        };
        let primitive = PRIMITIVES.iter().find(|(name, _)| *name == base);
        let base = match (primitive, base.split_once("<=")) {
            (Some((name, _)), _) => Base::Primitive(name),
            (None, Some(("string", bound))) => Base::String(bound.parse().ok()?),
            (None, Some(_)) => return None,
            (None, None) if base == "string" => Base::String(0),
            (None, None) => Base::Nested(self.full_name(base)?),
        };
        Some((base, array))
    }

    /// A message that is named in this one; one without a package is of the same.
    fn full_name(&self, name: &str) -> Option<String> {
        let parts: Vec<String> = name.split('/').map(identifier).collect::<Option<_>>()?;
        let package = self.name.split('/').next()?;
        match parts.as_slice() {
            [name] => Some(format!("{package}/msg/{name}")),
            [package, name] => Some(format!("{package}/msg/{name}")),
            [package, msg, name] if msg == "msg" => Some(format!("{package}/msg/{name}")),
            _ => None,
        }
    }
}

fn identifier(text: &str) -> Option<String> {
    let text = text.trim();
    let begins_well = text.starts_with(|it: char| it.is_ascii_alphabetic());
    let goes_on_well = |it: char| it.is_ascii_alphanumeric() || it == '_';
    (begins_well && text.chars().all(goes_on_well)).then(|| text.to_owned())
}

/// Splits the text of a `.srv` file into request and response.
///
/// # Errors
/// When there is not one line of three dashes.
pub fn parts_of_service<'a>(name: &str, text: &'a str) -> Result<(&'a str, &'a str), IdlError> {
    let mut parts = text.split("---\n");
    match (parts.next(), parts.next(), parts.next()) {
        (Some(request), Some(response), None) => Ok((request, response)),
        _ => Err(IdlError::Separator(name.to_owned())),
    }
}

impl fmt::Display for Field {
    /// As a `.msg` file has it.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.base {
            Base::Primitive(name) => f.write_str(name)?,
            Base::String(0) => f.write_str("string")?,
            Base::String(bound) => write!(f, "string<={bound}")?,
            Base::Nested(name) => f.write_str(name)?,
        }
        match self.array {
            Array::One => {}
            Array::Fixed(size) => write!(f, "[{size}]")?,
            Array::Bounded(bound) => write!(f, "[<={bound}]")?,
            Array::Unbounded => f.write_str("[]")?,
        }
        write!(f, " {}", self.name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_constants_and_comments_are_told_apart() {
        let text = "# what it is\nuint8 RED=1 # a colour\nuint8[<=3] a\nstring<=9[4] b\nHeader[] c\n\
                    geometry_msgs/Point d\nfloat64 e";
        let parsed = Definition::parse("p/msg/M", text).unwrap();
        let fields: Vec<_> = parsed.fields.iter().map(ToString::to_string).collect();
        assert_eq!(
            fields,
            [
                "uint8[<=3] a",
                "string<=9[4] b",
                "p/msg/Header[] c",
                "geometry_msgs/msg/Point d",
                "float64 e"
            ]
        );
        let [red] = parsed.constants.as_slice() else {
            panic!("{parsed:?}")
        };
        assert_eq!((red.name.as_str(), red.value.as_str()), ("RED", "1"));
    }

    #[test]
    fn a_line_that_means_nothing_is_named() {
        for line in ["uint8", "uint8 9a", "uint8[x] a", "float<=3 a", "a/b/c/D e"] {
            let error = Definition::parse("p/msg/M", line).unwrap_err();
            assert!(error.to_string().contains(line), "{error}");
        }
        assert!(parts_of_service("p/srv/S", "uint8 a\n").is_err());
    }
}
