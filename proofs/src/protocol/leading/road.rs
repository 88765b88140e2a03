//! What a leader offers, tells and ends, and the road.

use crossguard_protocol::Role;
use crossguard_protocol::laws::arbitrary::{Happening, Kind, TimerKind};
use crossguard_protocol::laws::steps::of_the_road;

of_each_input_and_timer! { of_the_road }
