//! Inputs that a requester or a leader ignores whatever they say. Of each kind a harness of its stage proves that it is ignored,
//! changes nothing and is counted under a cause that is so (`ignores`); what the other laws say of such a step is proved here
//! once for all of them.

use crossguard_protocol::laws::steps::of_an_ignored_input;

use super::stage::OF_LEADERS;
use super::{leading, requesting};
use crate::harness::harnesses;
use crate::kani;

harnesses! {
    /// Whatever a requester ignores.
    #[unwind(6)]
    fn a_requester_goes_on() {
        let step = requesting::FROM.any_ignored([&requesting::IGNORED, &OF_LEADERS], of_an_ignored_input);
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// Whatever a leader ignores.
    #[unwind(6)]
    fn a_leader_goes_on() {
        let step = leading::FROM.any_ignored([&leading::IGNORED, &[]], of_an_ignored_input);
        kani::cover!(step.is_ignored(), "ignored");
    }
}
