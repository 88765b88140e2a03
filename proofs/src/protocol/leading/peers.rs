//! The effects that peers of a leader can have, and how long they take.

use crossguard_protocol::laws::arbitrary::Kind;
use crossguard_protocol::laws::steps::of_peers;
use crossguard_protocol::{EventKind, Role, TimerKind};

of_each_input! { of_peers }
