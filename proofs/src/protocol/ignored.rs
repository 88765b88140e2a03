//! Inputs that a requester or a leader ignores whatever they say. Of each kind a harness of its stage proves that it is ignored,
//! changes nothing and is counted under a cause that is so (`ignores`); what the other laws say of such a step is proved here
//! once for all of them.

use crossguard_protocol::laws::arbitrary::{Happening, Kind};
use crossguard_protocol::laws::steps::of_an_ignored_input;

use super::{leading, requesting};
use crate::harness::harnesses;
use crate::kani;

/// What a requester ignores.
pub(super) const BY_A_REQUESTER: [Kind; 11] = [
    Kind::Command,
    Kind::Answer,
    Kind::Local(Happening::PedestrianDetected),
    Kind::Local(Happening::CommandManeuver),
    Kind::Local(Happening::OpenCorridor),
    Kind::Local(Happening::CloseCorridor),
    Kind::Local(Happening::ManeuverCompleted),
    Kind::Local(Happening::ManeuverFailed),
    Kind::Local(Happening::IdentityChanged),
    Kind::Local(Happening::InPosition),
    Kind::Local(Happening::RoadClear),
];

/// What a leader ignores.
pub(super) const BY_A_LEADER: [Kind; 8] = [
    Kind::RamNeedHelp,
    Kind::Command,
    Kind::Local(Happening::PedestrianDetected),
    Kind::Local(Happening::ManeuverCompleted),
    Kind::Local(Happening::ManeuverFailed),
    Kind::Local(Happening::IdentityChanged),
    Kind::Local(Happening::InPosition),
    Kind::Local(Happening::AllAnswered),
];

harnesses! {
    /// Whatever a requester ignores.
    #[unwind(6)]
    #[solver(cadical)]
    fn a_requester_goes_on() {
        let step = requesting::FROM.any_ignored(&BY_A_REQUESTER, of_an_ignored_input);
        kani::cover!(step.is_ignored(), "ignored");
    }

    /// Whatever a leader ignores.
    #[unwind(6)]
    #[solver(cadical)]
    fn a_leader_goes_on() {
        let step = leading::FROM.any_ignored(&BY_A_LEADER, of_an_ignored_input);
        kani::cover!(step.is_ignored(), "ignored");
    }
}
