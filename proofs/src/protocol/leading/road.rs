//! Offers, news and ends of a leader, and the road.

use crossguard_protocol::laws::arbitrary::Kind;
use crossguard_protocol::laws::steps::of_the_road;
use crossguard_protocol::{EventKind, Role, TimerKind};

of_each_input! { of_the_road }
