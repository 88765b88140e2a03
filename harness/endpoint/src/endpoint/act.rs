//! Acts that an endpoint wants of the application.

use crossguard_codec::TaskParameters;
use crossguard_protocol::{
    CorridorClosure, Event, FallbackPolicy, Ignored, Maneuver, Millis, Notice, Output, StationId,
    StopReason,
};

/// Act for the application to carry out, or notice for it to know.
#[derive(Clone, Debug, PartialEq)]
pub enum Act {
    /// Start a maneuver with these parameters.
    Start(Maneuver, TaskParameters),
    /// Stop a maneuver.
    Stop(Maneuver, StopReason),
    /// Stop a maneuver by the policy of its task. The robot is on duty until it is told that the road is
    /// clear.
    FallBack(Maneuver, FallbackPolicy),
    /// Show *go* for this long, and no longer unless it is extended.
    OpenCorridor(Millis),
    /// Show *go* for this long from now on.
    ExtendCorridor(Millis),
    /// Hold the pedestrian back.
    CloseCorridor(CorridorClosure),
    /// Keep the pseudonym, or let it change.
    LockIdentity(bool),
    /// Persist a larger boot counter, and tell [`Event::EpochRenewed`].
    RenewEpoch,
    /// Know that a vehicle says that it will stop, as it was asked the last time; `false`: that it will not.
    VehicleAnswered(StationId, bool),
    /// Know this.
    Notice(Notice),
    /// Know that the event that was told had no effect.
    Ignored(Event, Ignored),
}

/// Act of the application for an output, if there is one.
pub(super) fn act(output: Output, parameters: TaskParameters) -> Option<Act> {
    Some(match output {
        Output::StartManeuver(maneuver) => Act::Start(maneuver, parameters),
        Output::StopManeuver(maneuver, why) => Act::Stop(maneuver, why),
        Output::FallBack(maneuver, policy) => Act::FallBack(maneuver, policy),
        Output::CorridorOpened(time) => Act::OpenCorridor(time),
        Output::CorridorExtended(time) => Act::ExtendCorridor(time),
        Output::CorridorClosed(why) => Act::CloseCorridor(why),
        Output::LockIdentity => Act::LockIdentity(true),
        Output::UnlockIdentity => Act::LockIdentity(false),
        Output::RenewEpoch => Act::RenewEpoch,
        Output::Notify(notice) => Act::Notice(notice),
        Output::SendRam | Output::SendRmcm(_) | Output::Ignored(_) => return None,
    })
}
