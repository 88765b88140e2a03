//! Options that take one of several names. The types are of crates that know no command line.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use crossguard_endpoint::station::Mode;
use crossguard_evaluation::grid::{Preset, Site};

/// A name, what it stands for, and what it means.
type Choice<T> = (&'static str, T, &'static str);

/// Takes one of these names.
fn one_of<T: Copy + Send + Sync + 'static>(
    choices: &'static [Choice<T>],
) -> impl TypedValueParser<Value = T> {
    let value = |(name, _, help): &Choice<T>| PossibleValue::new(*name).help(*help);
    PossibleValuesParser::new(choices.iter().map(value)).map(|given| {
        let mut choices = choices.iter();
        let choice = choices.find(|(name, ..)| *name == given);
        choice.expect("clap takes no other").1
    })
}

/// How much security there is.
pub(super) fn security() -> impl TypedValueParser<Value = Mode> {
    one_of(&[
        (
            "off",
            Mode::Off,
            "None: packets are not signed, and signed ones are dropped",
        ),
        (
            "sign",
            Mode::Sign,
            "Packets are signed; unsigned ones are taken as well, wrong signatures are not",
        ),
        (
            "enforce",
            Mode::Enforce,
            "Packets are signed; those without a valid signature are dropped",
        ),
    ])
}

/// Assumptions on the geometry of the street grid.
pub(super) fn preset() -> impl TypedValueParser<Value = Preset> {
    one_of(&[
        (
            "kerb",
            Preset::Kerb,
            "Two lanes per direction, sidewalks of 3 m, robots on the sidewalk at a corner",
        ),
        (
            "plain",
            Preset::Plain,
            "One lane per direction, sidewalks of 2 m, robots in the middle of the intersection",
        ),
    ])
}

/// Where at an intersection a robot stands.
pub(super) fn site() -> impl TypedValueParser<Value = Site> {
    one_of(&[
        ("center", Site::Center, "In its middle"),
        (
            "north-east",
            Site::NorthEast,
            "On the sidewalk of its north-eastern corner",
        ),
        (
            "north-west",
            Site::NorthWest,
            "On the sidewalk of its north-western corner",
        ),
        (
            "south-east",
            Site::SouthEast,
            "On the sidewalk of its south-eastern corner",
        ),
        (
            "south-west",
            Site::SouthWest,
            "On the sidewalk of its south-western corner",
        ),
    ])
}
