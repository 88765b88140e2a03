//! Inputs that a leader ignores whatever they say. That each is ignored, and for a cause that is so, is proved kind by kind; what
//! follows of it once for all.

use crossguard_protocol::laws::arbitrary::{Happening, Kind};
use crossguard_protocol::laws::steps::{ignores, of_an_ignored_input};

use super::FROM;
use crate::harness::harnesses;
use crate::protocol::stage::steps;
use crate::kani;

