//! The example of an on-board unit as a process of its own. Cargo builds no example for a test alone, so this program is one.

#[path = "../../examples/unit.rs"]
mod unit;

/// The environment variable with the arguments of a unit.
pub(crate) const ARGUMENTS: &str = "CROSSGUARD_EXAMPLE_UNIT";

/// The arguments with which this program is a unit.
pub(crate) const AS_UNIT: [&str; 4] = [
    "--exact",
    "unit_process::a_unit_in_a_process_of_its_own",
    "--ignored",
    "--nocapture",
];

#[test]
#[ignore = "the other tests start it, as a process of its own"]
fn a_unit_in_a_process_of_its_own() {
    let arguments = std::env::var(ARGUMENTS).unwrap();
    let arguments: Vec<_> = arguments.split(' ').map(str::to_owned).collect();
    unit::serve(&arguments).unwrap();
}
