//! Containers of a RAM.

use crossguard_codec::core::ram::{
    BatteryStatus, CommandProgress, CommandReport, ConfirmedFollowers, HelperRole, PublicSignal,
    RequestUrgency, RequesterRole, RobotDimensions, RobotStatusContainer, SessionFarewell,
    SignalsShown,
};

use super::containers;

containers! {
    comes_back {
        dimensions_comes_back(RobotDimensions, 2, |value| value.height.get() > 1);
        battery_comes_back(BatteryStatus, 2, |value| value.charging);
        status_container_comes_back(RobotStatusContainer, 2, |value| value.unavailability.is_some());
        farewell_comes_back(SessionFarewell, 2, |value| matches!(value, SessionFarewell::Left(_)));
        command_report_comes_back(CommandReport, 2, |value| matches!(value.progress, CommandProgress::Failed(_)));
        requester_comes_back(RequesterRole, 2, |value| value.urgency == RequestUrgency::Emergency);
        helper_comes_back(HelperRole, 2, |value| value.offer_number.0 > 1);
        confirmed_followers_comes_back(ConfirmedFollowers, 18, |value| value.len() == 16);
        signals_comes_back(SignalsShown, 2, |value| value.to_vehicles == PublicSignal::Stop);
    }
    is_canonical {
        dimensions_is_canonical(RobotDimensions, 5);
        battery_is_canonical(BatteryStatus, 4);
        status_container_is_canonical(RobotStatusContainer, 7);
        farewell_is_canonical(SessionFarewell, 15);
        command_report_is_canonical(CommandReport, 5);
        requester_is_canonical(RequesterRole, 19);
        helper_is_canonical(HelperRole, 22);
        signals_is_canonical(SignalsShown, 4);
    }
}
