//! What peers of a leader can bring about, and how long it takes.

use crossguard_protocol::Role;
use crossguard_protocol::laws::arbitrary::{Happening, Kind, TimerKind};
use crossguard_protocol::laws::steps::of_peers;

of_each_input_and_timer! { of_peers }
