//! L7: from every state some run leads to all robots being idle.
//!
//! It says that some run exists, so it does not hold for all settings of timers, as the others do. It is a fact
//! about the whole state graph, which the check looks up there.

use super::authentication::Authentication;
use super::property::{Claim, Kind, Property, Rule};

pub(super) const PROPERTY: Property = Property {
    id: "L7",
    authentication: Authentication::NAMES,
    untimed: Some(Claim {
        kind: Kind::S,
        statement: "from every state some run leads to all robots being idle",
        premise: None,
        rule: Rule::Reset,
        weakening: "FollowersWaitForEver",
    }),
    timed: None,
};
