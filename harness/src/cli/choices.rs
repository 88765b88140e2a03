//! Options that take one of several names.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use crossguard_endpoint::station::Mode;

/// How much security there is.
pub(super) fn security() -> impl TypedValueParser<Value = Mode> {
    let names = [
        (
            "off",
            "None: packets are not signed, and signed ones are dropped",
        ),
        (
            "sign",
            "Packets are signed; unsigned ones are taken as well, wrong signatures are not",
        ),
        (
            "enforce",
            "Packets are signed; those without a valid signature are dropped",
        ),
    ];
    let names = names.map(|(name, help)| PossibleValue::new(name).help(help));
    PossibleValuesParser::new(names).map(|name| match &*name {
        "off" => Mode::Off,
        "sign" => Mode::Sign,
        _ => Mode::Enforce,
    })
}
