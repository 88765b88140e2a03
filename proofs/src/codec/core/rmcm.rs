//! Containers of an RMCM.

use crossguard_codec::core::max_octets;
use crossguard_codec::core::rmcm::{
    FollowerManeuverContainer, ManeuverConstraints, ManeuverResponse, ManeuverTarget,
};

use super::{octets, values};
use crate::harness::harnesses;

harnesses! {
    /// All responses.
    #[unwind(2)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::never)]
    fn response_comes_back() {
        values::<ManeuverResponse, { max_octets::<ManeuverResponse>() }>(|value| matches!(value, ManeuverResponse::Rejected(_)));
    }

    /// Any octets, up to the maximum length, without extension additions.
    #[unwind(4)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::no_additions)]
    fn response_is_canonical() {
        octets::<ManeuverResponse, { max_octets::<ManeuverResponse>() }>();
    }

    /// All constraints.
    #[unwind(2)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::never)]
    fn constraints_comes_back() {
        values::<ManeuverConstraints, { max_octets::<ManeuverConstraints>() }>(|value| value.maximum_speed.is_some());
    }

    /// Any octets, up to the maximum length, without extension additions.
    #[unwind(6)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::no_additions)]
    fn constraints_is_canonical() {
        octets::<ManeuverConstraints, { max_octets::<ManeuverConstraints>() }>();
    }

    /// All targets.
    #[unwind(2)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::never)]
    fn target_comes_back() {
        values::<ManeuverTarget, { max_octets::<ManeuverTarget>() }>(|value| matches!(value, ManeuverTarget::Offset(_)));
    }

    /// Any octets, up to the maximum length, without extension additions.
    #[unwind(13)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::no_additions)]
    fn target_is_canonical() {
        octets::<ManeuverTarget, { max_octets::<ManeuverTarget>() }>();
    }

    /// All follower containers.
    #[unwind(2)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::never)]
    fn answer_comes_back() {
        values::<FollowerManeuverContainer, { max_octets::<FollowerManeuverContainer>() }>(|value| value.estimated_time_to_completion.is_some());
    }

    /// Any octets, up to the maximum length, without extension additions.
    #[unwind(17)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::no_additions)]
    fn answer_is_canonical() {
        octets::<FollowerManeuverContainer, { max_octets::<FollowerManeuverContainer>() }>();
    }
}
