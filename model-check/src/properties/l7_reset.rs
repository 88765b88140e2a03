//! L7: from every state some run leads to all robots being idle.
//!
//! It says that some run exists, so it does not hold for all settings of timers, as the others do. It is a fact
//! about the whole state graph, which the check looks up there.

use super::prelude::*;

property! {
    "L7", Authentication::NAMES;
    untimed S "from every state some run leads to all robots being idle",
        None,
        Rule::Reset,
        "FollowersWaitForEver";
}
