//! Stages 3 and 4: a leader, with one or two followers. The laws of its steps are proved in two parts, each of
//! which takes less than half as long as both.

pub mod conduct;
pub mod validity;

use crossguard_protocol::laws::arbitrary::Stage;

use super::stage::From;

/// How many followers the leader has, at most: one that a message is about, and another.
const FOLLOWERS: usize = 2;

/// A RAM says nothing but its sender's part in a session, unless it says nothing but a farewell.
const FROM: From = From {
    peers: (1, FOLLOWERS),
    farewells: false,
    ..From::stage(Stage::Leading)
};
