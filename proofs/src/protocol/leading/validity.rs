//! The state of a leader stays valid.
//!
//! Of the timers [`firing`](crate::protocol::timers::firing) and what is beside it prove that, part by part. What
//! can come of an input is marked in [`conduct`](super::conduct).

use crossguard_protocol::laws::arbitrary::Kind;
use crossguard_protocol::laws::steps::keeps_the_state_valid;
use crossguard_protocol::{EventKind, Role};

of_each_input! { keeps_the_state_valid }
