//! The declarations of the core, in the notation of `asn1!`: the types that RAM and RMCM consist of.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use rasn_compiler::prelude::ir::{
    ASN1Type, ASN1Value, BitString, Choice, ChoiceOption, Constraint, Enumerated, Integer,
    Optionality, SequenceOrSet, SequenceOrSetMember, SequenceOrSetOf, ToplevelTypeDefinition,
};

use super::notation::{
    WIDTH, camel_of_pascal, doc, filled, number, pascal, screaming, snake, wrapped,
};
use super::syntax::{Module, absent, range, reference};
use super::table::{LIMITS, MESSAGES, NAMED};

/// The types by name, and what is known of them from where they are used.
struct Core<'a> {
    types: BTreeMap<&'a str, &'a ToplevelTypeDefinition>,
    /// The types that the messages consist of, with the alternatives that they leave out.
    used: BTreeMap<&'a str, BTreeSet<&'a str>>,
    /// The named values of INTEGERs that are defaults.
    defaults: BTreeSet<(&'a str, String)>,
}

/// The files of the core, and the list of its types for the tests.
pub(crate) fn generate(modules: &[Module]) -> Vec<(String, String)> {
    let core = Core::of(modules);
    let used: Vec<_> = modules
        .iter()
        .filter(|module| core.types_of(module).next().is_some())
        .collect();
    let files = used.iter().map(|module| {
        let file = file_of(module.name);
        (format!("src/core/{file}.rs"), core.file(module))
    });
    let mut files: Vec<_> = files.collect();
    files.push(("tests/it/support/types.rs".into(), core.list(&used)));
    files
}

fn file_of(module: &str) -> String {
    module.to_lowercase()
}

impl<'a> Core<'a> {
    fn of(modules: &'a [Module]) -> Self {
        let types = modules.iter().flat_map(|module| &module.types);
        let mut core = Self {
            types: types.map(|one| (one.name.as_str(), one)).collect(),
            used: BTreeMap::new(),
            defaults: BTreeSet::new(),
        };
        for message in MESSAGES {
            core.visit(message, &BTreeSet::new());
        }
        core
    }

    /// Visits a type, which is used without some of its alternatives, and what it consists of.
    fn visit(&mut self, name: &'a str, left_out: &BTreeSet<&'a str>) {
        if let Some(before) = self.used.get(name) {
            assert_eq!(before, left_out, "{name} is used in two ways");
            return;
        }
        self.used.insert(name, left_out.clone());
        let definition = *self.types.get(name).expect(name);
        match &definition.ty {
            ASN1Type::Sequence(sequence) => {
                for member in &sequence.members {
                    self.visit_member(member);
                }
            }
            ASN1Type::SequenceOf(list) => self.visit_type(&list.element_type, &[]),
            ASN1Type::Choice(choice) => {
                let there = choice.options.iter();
                for option in there.filter(|option| !left_out.contains(option.name.as_str())) {
                    self.visit_type(&option.ty, &option.constraints);
                }
            }
            _ => {}
        }
    }

    fn visit_member(&mut self, member: &'a SequenceOrSetMember) {
        self.visit_type(&member.ty, &member.constraints);
        let default = match (&member.optionality, reference(&member.ty)) {
            (Optionality::Default(value), Some(ty)) => self.default(ty, value),
            _ => None,
        };
        self.defaults.extend(default);
    }

    fn visit_type(&mut self, ty: &'a ASN1Type, constraints: &'a [Constraint]) {
        if let ASN1Type::SequenceOf(list) = ty {
            self.visit_type(&list.element_type, &[]);
        }
        if let Some(name) = reference(ty) {
            let own = ty.constraints().into_iter().flatten();
            self.visit(name, &absent(own.chain(constraints)).collect());
        }
    }

    /// The INTEGER whose named value is a default, and the name.
    fn default(&self, ty: &'a str, value: &ASN1Value) -> Option<(&'a str, String)> {
        let ASN1Type::Integer(integer) = &self.types[ty].ty else {
            return None;
        };
        Some((ty, name_of_value(integer, value)))
    }

    fn types_of(&self, module: &'a Module) -> impl Iterator<Item = &'a ToplevelTypeDefinition> {
        let types = module.types.iter();
        types.filter(|one| self.used.contains_key(one.name.as_str()))
    }

    /// One file of the core.
    fn file(&self, module: &'a Module) -> String {
        let name = module.name;
        let mut text = doc(&module.about, "", "//!");
        let _ = writeln!(
            text,
            "//!\n//! Generated from `asn1/Crossguard-{name}.asn` by `tests/generated`; do not edit.\n\n\
             use super::notation::prelude::*;"
        );
        for limit in &LIMITS {
            if self.types_of(module).any(|one| one.name == limit.list) {
                let doc = doc(limit.doc, "", "///");
                let _ = writeln!(
                    text,
                    "\n{doc}pub const {}: usize = {};",
                    limit.name, limit.items
                );
            }
        }
        let mut named = BTreeSet::new();
        for definition in self.types_of(module) {
            for (name, declaration) in inner(definition) {
                if named.insert(name) {
                    text += &declaration;
                }
            }
            text += &self.declaration(definition);
        }
        text
    }

    fn declaration(&self, definition: &ToplevelTypeDefinition) -> String {
        let name = &definition.name;
        let comment = match LIMITS.iter().find(|limit| limit.list == name) {
            Some(limit) => format!(
                "{} In a RAM it has at most {} items.",
                definition.comments, limit.items
            ),
            None => definition.comments.clone(),
        };
        let body = match &definition.ty {
            ASN1Type::Boolean(_) => {
                return format!("\n{}pub type {name} = bool;\n", doc(&comment, "", "///"));
            }
            ASN1Type::Integer(one) => integer(one, &self.constants(name, one)),
            ASN1Type::BitString(one) => bit_string(one),
            ASN1Type::Enumerated(one) => enumerated(one, name),
            ASN1Type::SequenceOf(one) => list(one, name),
            ASN1Type::Sequence(one) => self.sequence(name, one),
            ASN1Type::Choice(one) => choice(one, &self.used[name.as_str()]),
            other => panic!("asn1! has no {}", other.as_str()),
        };
        assignment(name, &comment, &body)
    }

    /// The named values of an INTEGER that Rust needs.
    fn constants(&self, name: &str, integer: &Integer) -> Vec<String> {
        let values = integer.distinguished_values.iter().flatten();
        let defaults = values.filter(|value| {
            let defaults = &self.defaults;
            defaults
                .iter()
                .any(|(ty, default)| *ty == name && *default == value.name)
        });
        let constants = defaults.map(|value| {
            let value_number = i64::try_from(value.value).expect("a number");
            format!("{}({})", screaming(&value.name), number(value_number))
        });
        constants.collect()
    }

    fn sequence(&self, name: &str, sequence: &SequenceOrSet) -> String {
        if let Some(root) = sequence.extensible {
            assert_eq!(
                root,
                sequence.members.len(),
                "asn1! has no additions to {name}"
            );
        }
        let members = sequence.members.iter();
        let rows: Vec<_> = members.map(|member| self.component(name, member)).collect();
        braces("SEQUENCE", rows, sequence.extensible.is_some())
    }

    /// A component in Rust's spelling, and its type.
    fn component(&self, sequence: &str, member: &SequenceOrSetMember) -> (String, String) {
        let ty = match type_of(&member.ty) {
            Some(ty) => ty,
            None => named(sequence, &member.name).0,
        };
        let keyword = match &member.optionality {
            Optionality::Required => String::new(),
            Optionality::Optional => " OPTIONAL".to_owned(),
            Optionality::Default(value) => match &self.types[ty].ty {
                ASN1Type::Integer(one) => {
                    format!(" DEFAULT {}", screaming(&name_of_value(one, value)))
                }
                ASN1Type::Enumerated(_) => match value {
                    ASN1Value::EnumeratedValue { enumerable, .. } => {
                        format!(" DEFAULT {}", pascal(enumerable))
                    }
                    other => panic!("{other:?} is no default of {ty}"),
                },
                other => panic!("asn1! has no DEFAULT for {}", other.as_str()),
            },
        };
        (snake(&member.name), format!("{ty}{keyword}"))
    }

    /// The list of types that the tests go through.
    fn list(&self, modules: &[&'a Module]) -> String {
        let mut text = "//! The types of the core, by module.\n//!\n\
             //! Generated from `asn1/*.asn` by `tests/generated`; do not edit.\n\n\
             /// Calls a macro with the modules of the core and their types.\n\
             #[macro_export]\nmacro_rules! for_all_types {\n    ($callback:ident) => {\n        \
             $callback! {\n"
            .to_owned();
        for module in modules {
            let names = self.types_of(module).map(|one| one.name.as_str());
            let names = wrapped(names, &" ".repeat(16));
            let _ = writeln!(text, "            {}:\n{names};", file_of(module.name));
        }
        text + "        }\n    };\n}\n"
    }
}

/// The declarations of the types that a SEQUENCE writes out.
fn inner(definition: &ToplevelTypeDefinition) -> Vec<(&'static str, String)> {
    let ASN1Type::Sequence(sequence) = &definition.ty else {
        return Vec::new();
    };
    let written_out = sequence
        .members
        .iter()
        .filter(|one| type_of(&one.ty).is_none());
    let declarations = written_out.map(|member| {
        let (name, doc) = named(&definition.name, &member.name);
        let body = match &member.ty {
            ASN1Type::Integer(one) => integer(one, &[]),
            ASN1Type::SequenceOf(one) => list(one, name),
            other => panic!("asn1! has no {} here", other.as_str()),
        };
        (name, assignment(name, doc, &body))
    });
    declarations.collect()
}

/// The name and the documentation of what a component writes out.
fn named(sequence: &str, component: &str) -> (&'static str, &'static str) {
    let wanted = format!("{sequence} {component} ");
    let mut lines = NAMED.lines();
    let found = lines.find_map(|line| line.strip_prefix(&wanted)?.split_once(' '));
    found.unwrap_or_else(|| panic!("give {component} of {sequence} a name in table.rs"))
}

fn assignment(name: &str, comment: &str, body: &str) -> String {
    let doc = doc(comment, "    ", "///");
    format!("\nasn1! {{\n{doc}    {name} ::= {body}\n}}\n")
}

/// The type of a component, if it is not written out.
fn type_of(ty: &ASN1Type) -> Option<&str> {
    match ty {
        ASN1Type::Boolean(_) => Some("bool"),
        ASN1Type::Null => Some("Null"),
        ty => reference(ty),
    }
}

/// The name of a default. The parser has looked its number up.
fn name_of_value(integer: &Integer, value: &ASN1Value) -> String {
    let wanted = match value {
        ASN1Value::LinkedNestedValue { value, .. } => return name_of_value(integer, value),
        ASN1Value::LinkedIntValue { value, .. } => value,
        other => panic!("{other:?} is no number with a name"),
    };
    let mut values = integer.distinguished_values.iter().flatten();
    let named = values.find(|named| named.value == *wanted);
    named.expect("a default has a name").name.clone()
}

/// The Rust type of numbers from `min` to `max`: the smallest that has them.
fn storage(min: i64, max: i64) -> (&'static str, bool) {
    let types = [
        ("u8", 0, i64::from(u8::MAX)),
        ("u16", 0, i64::from(u16::MAX)),
        ("u32", 0, i64::from(u32::MAX)),
        ("i8", i64::from(i8::MIN), i64::from(i8::MAX)),
        ("i16", i64::from(i16::MIN), i64::from(i16::MAX)),
        ("i32", i64::from(i32::MIN), i64::from(i32::MAX)),
    ];
    let mut types = types.iter();
    let (rust, low, high) = types
        .find(|(_, low, high)| *low <= min && max <= *high)
        .expect("at most 32 bits");
    (rust, min == *low && max == *high)
}

fn integer(integer: &Integer, constants: &[String]) -> String {
    let (min, max, extensible) = range(&integer.constraints);
    let (rust, is_every_number) = storage(min, max);
    let keyword = if is_every_number && !extensible {
        "is"
    } else {
        "as"
    };
    let names = match constants {
        [] => String::new(),
        names => format!("{{ {} }} ", names.join(", ")),
    };
    let marker = if extensible { ", ..." } else { "" };
    let (min, max) = (number(min), number(max));
    format!("INTEGER {names}({min}..{max}{marker}) {keyword} {rust}")
}

fn bit_string(string: &BitString) -> String {
    let (min, max, extensible) = range(&string.constraints);
    assert!(
        min == max && !extensible,
        "asn1! has bit strings of one size"
    );
    let rust = match max {
        ..=8 => "u8",
        9..=16 => "u16",
        _ => "u32",
    };
    format!("BIT STRING (SIZE({max})) as {rust}")
}

fn enumerated(enumerated: &Enumerated, name: &str) -> String {
    let members = &enumerated.members;
    let root = enumerated.extensible.unwrap_or(members.len());
    assert_eq!(
        root,
        members.len(),
        "asn1! has no additions to an ENUMERATED"
    );
    let in_order = members
        .iter()
        .zip(0..)
        .all(|(one, index)| one.index == index);
    assert!(in_order, "asn1! counts the values of an ENUMERATED from 0");
    let values = members.iter().map(|member| {
        let rust = pascal(&member.name);
        // The name in ASN.1, where that in Rust does not tell.
        match member.name.as_str() {
            name if name == camel_of_pascal(&rust) => rust,
            name => format!("{rust} \"{name}\""),
        }
    });
    let mut values: Vec<_> = values.collect();
    values.extend(enumerated.extensible.map(|_| "...".to_owned()));
    let line = format!("ENUMERATED {{ {} }}", values.join(", "));
    if format!("    {name} ::= {line}").len() <= WIDTH {
        return line;
    }
    format!("ENUMERATED {{\n{}\n    }}", filled(&values, 8))
}

fn list(list: &SequenceOrSetOf, name: &str) -> String {
    let (min, max, extensible) = range(&list.constraints);
    let marker = if extensible { ", ..." } else { "" };
    let item = type_of(&list.element_type).expect("an item with a name");
    let limit = LIMITS.iter().find(|limit| limit.list == name);
    let limit = limit.map_or_else(String::new, |limit| format!(" AT MOST {}", limit.name));
    format!("SEQUENCE (SIZE({min}..{max}{marker})) OF {item}{limit}")
}

fn choice(choice: &Choice, left_out: &BTreeSet<&str>) -> String {
    let root = choice.extensible.unwrap_or(choice.options.len());
    let (options, additions) = choice.options.split_at(root);
    let (there, gone) = options.split_at(root - left_out.len());
    assert!(
        gone.iter()
            .all(|option| left_out.contains(option.name.as_str())),
        "asn1! leaves out the last alternatives of the root only"
    );
    let row = |option: &ChoiceOption| {
        let ty = type_of(&option.ty).expect("an alternative with a name");
        (pascal(&option.name), ty.to_owned())
    };
    let mut rows: Vec<_> = there.iter().map(row).collect();
    if !gone.is_empty() {
        rows.push((format!("{} ABSENT", gone.len()), String::new()));
    }
    if !additions.is_empty() {
        rows.push(("...".to_owned(), String::new()));
        rows.extend(additions.iter().map(row));
        return braces("CHOICE", rows, false);
    }
    braces("CHOICE", rows, choice.extensible.is_some())
}

/// Rows of two columns between braces, with an extension marker.
fn braces(keyword: &str, rows: Vec<(String, String)>, extensible: bool) -> String {
    let named = rows.iter().filter(|(_, ty)| !ty.is_empty());
    let width = named.map(|(name, _)| name.len()).max().unwrap_or_default();
    let rows = rows.into_iter().map(|(name, ty)| match ty.as_str() {
        "" => format!("        {name}"),
        ty => format!("        {name:width$} {ty}"),
    });
    let rows: Vec<_> = rows
        .chain(extensible.then(|| "        ...".to_owned()))
        .collect();
    format!("{keyword} {{\n{}\n    }}", rows.join(",\n"))
}
