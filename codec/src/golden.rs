//! The golden vectors of this crate, for the tests of crates that build on it.
//!
//! A file has a line `name: hexadecimal digits` for each vector; other lines are comments.

/// CAM, CPM, and VAM of the older dictionary.
pub const ITS: &str = include_str!("../tests/golden/its.txt");
/// VAM of the dictionary v2.4.1.
pub const VAM: &str = include_str!("../tests/golden/vam.txt");
/// Whole `GeoNetworking` packets.
pub const PACKETS: &str = include_str!("../tests/golden/packets.txt");

/// All vectors of a file: names and hexadecimal digits.
pub fn vectors(file: &'static str) -> impl Iterator<Item = (&'static str, &'static str)> {
    let lines = file.lines().filter(|line| !line.starts_with('#'));
    lines.filter_map(|line| line.split_once(": "))
}

/// The hexadecimal digits of one vector.
///
/// # Panics
/// When the file has no vector of that name.
#[must_use]
pub fn vector(file: &'static str, name: &str) -> &'static str {
    let found = vectors(file).find(|(known, _)| *known == name);
    found.expect("a vector of that name").1
}
