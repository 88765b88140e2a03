//! Containers of a RAM.

use crossguard_codec::core::max_octets;
use crossguard_codec::core::ram::{
    BatteryStatus, CommandProgress, CommandReport, ConfirmedFollowers, HelperRole, PublicSignal,
    RequestUrgency, RequesterRole, RobotDimensions, RobotStatusContainer, SessionFarewell,
    SignalsShown,
};

use super::{octets, values};
use crate::harness::harnesses;

harnesses! {
    /// All dimensions.
    #[unwind(2)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::never)]
    fn dimensions_comes_back() {
        values::<RobotDimensions, { max_octets::<RobotDimensions>() }>(|value| value.height.get() > 1);
    }

    /// Any octets, up to the maximum length, without extension additions.
    #[unwind(5)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::no_additions)]
    fn dimensions_is_canonical() {
        octets::<RobotDimensions, { max_octets::<RobotDimensions>() }>();
    }

    /// All states of a battery.
    #[unwind(2)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::never)]
    fn battery_comes_back() {
        values::<BatteryStatus, { max_octets::<BatteryStatus>() }>(|value| value.charging);
    }

    /// Any octets, up to the maximum length, without extension additions.
    #[unwind(4)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::no_additions)]
    fn battery_is_canonical() {
        octets::<BatteryStatus, { max_octets::<BatteryStatus>() }>();
    }

    /// All status containers.
    #[unwind(2)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::never)]
    fn status_container_comes_back() {
        values::<RobotStatusContainer, { max_octets::<RobotStatusContainer>() }>(|value| value.unavailability.is_some());
    }

    /// Any octets, up to the maximum length, without extension additions.
    #[unwind(7)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::no_additions)]
    fn status_container_is_canonical() {
        octets::<RobotStatusContainer, { max_octets::<RobotStatusContainer>() }>();
    }

    /// All farewells.
    #[unwind(2)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::never)]
    fn farewell_comes_back() {
        values::<SessionFarewell, { max_octets::<SessionFarewell>() }>(|value| matches!(value, SessionFarewell::Left(_)));
    }

    /// Any octets, up to the maximum length, without extension additions.
    #[unwind(15)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::no_additions)]
    fn farewell_is_canonical() {
        octets::<SessionFarewell, { max_octets::<SessionFarewell>() }>();
    }

    /// All reports of a command.
    #[unwind(2)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::never)]
    fn command_report_comes_back() {
        values::<CommandReport, { max_octets::<CommandReport>() }>(|value| matches!(value.progress, CommandProgress::Failed(_)));
    }

    /// Any octets, up to the maximum length, without extension additions.
    #[unwind(5)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::no_additions)]
    fn command_report_is_canonical() {
        octets::<CommandReport, { max_octets::<CommandReport>() }>();
    }

    /// All requesters.
    #[unwind(2)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::never)]
    fn requester_comes_back() {
        values::<RequesterRole, { max_octets::<RequesterRole>() }>(|value| value.urgency == RequestUrgency::Emergency);
    }

    /// Any octets, up to the maximum length, without extension additions.
    #[unwind(19)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::no_additions)]
    fn requester_is_canonical() {
        octets::<RequesterRole, { max_octets::<RequesterRole>() }>();
    }

    /// All helpers.
    #[unwind(2)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::never)]
    fn helper_comes_back() {
        values::<HelperRole, { max_octets::<HelperRole>() }>(|value| value.offer_number.0 > 1);
    }

    /// Any octets, up to the maximum length, without extension additions.
    #[unwind(22)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::no_additions)]
    fn helper_is_canonical() {
        octets::<HelperRole, { max_octets::<HelperRole>() }>();
    }

    /// All lists of followers.
    #[unwind(18)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::never)]
    fn confirmed_followers_comes_back() {
        values::<ConfirmedFollowers, { max_octets::<ConfirmedFollowers>() }>(|value| value.len() == 16);
    }

    /// All signals.
    #[unwind(2)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::never)]
    fn signals_comes_back() {
        values::<SignalsShown, { max_octets::<SignalsShown>() }>(|value| value.to_vehicles == PublicSignal::Stop);
    }

    /// Any octets, up to the maximum length, without extension additions.
    #[unwind(4)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::no_additions)]
    fn signals_is_canonical() {
        octets::<SignalsShown, { max_octets::<SignalsShown>() }>();
    }
}
