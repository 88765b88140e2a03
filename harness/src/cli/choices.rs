//! Options that take one of several names. The types are of crates that know no command line.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use crossguard_endpoint::station::Mode;

/// A name, what it stands for, and what it means.
pub(super) type Choice<T> = (&'static str, T, &'static str);

/// Takes one of these names.
pub(super) fn one_of<T: Copy + Send + Sync + 'static>(
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
