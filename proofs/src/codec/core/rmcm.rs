//! Containers of an RMCM.

use crossguard_codec::core::rmcm::{
    FollowerManeuverContainer, ManeuverConstraints, ManeuverResponse, ManeuverTarget,
};

use super::containers;

containers! {
    comes_back {
        response_comes_back(ManeuverResponse, 2, |value| matches!(value, ManeuverResponse::Rejected(_)));
        constraints_comes_back(ManeuverConstraints, 2, |value| value.maximum_speed.is_some());
        target_comes_back(ManeuverTarget, 2, |value| matches!(value, ManeuverTarget::Offset(_)));
        answer_comes_back(FollowerManeuverContainer, 2, |value| value.estimated_time_to_completion.is_some());
    }
    is_canonical {
        response_is_canonical(ManeuverResponse, 4);
        constraints_is_canonical(ManeuverConstraints, 6);
        target_is_canonical(ManeuverTarget, 13);
        answer_is_canonical(FollowerManeuverContainer, 17);
    }
}
