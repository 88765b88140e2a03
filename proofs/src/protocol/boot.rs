//! The state in which a robot starts.

use crossguard_protocol::StationId;
use crossguard_protocol::laws::steps;

use super::stage::any_config;
use crate::harness::harnesses;
use crate::kani;

harnesses! {
    /// Every station id and boot counter.
    #[unwind(17)]
    fn boots_into_a_valid_state() {
        let config = any_config();
        steps::boots_into_a_valid_state(&config, StationId(kani::any()), kani::any());
        kani::cover!(config.settings().t_safety > config.settings().t_lease, "any configuration");
    }
}
