//! The protocol's reasons as codes.

use crossguard_protocol::{
    CorridorClosure, Disengagement, EndReason, Failure, GoneReason, Ignored, Rejection,
    ReleaseReason, StationId, StopReason, Unavailability,
};

use crate::abi::{CrossguardReason as Reason, CrossguardUnavailability};

/// A reason, and what it is about.
#[derive(Clone, Copy)]
pub(crate) struct Why {
    pub(crate) reason: Reason,
    pub(crate) station: Option<StationId>,
    pub(crate) unavailability: Option<Unavailability>,
}

impl Why {
    const fn of(reason: Reason) -> Self {
        Self {
            reason,
            station: None,
            unavailability: None,
        }
    }

    const fn about(self, station: StationId) -> Self {
        Self {
            station: Some(station),
            ..self
        }
    }

    const fn unavailable(why: Unavailability) -> Self {
        Self {
            unavailability: Some(why),
            ..Self::of(Reason::Unavailable)
        }
    }
}

/// The code of why a robot is unavailable, if it is.
pub(crate) const fn unavailability(why: Option<Unavailability>) -> u8 {
    use CrossguardUnavailability as Code;
    let code = match why {
        None => Code::None,
        Some(Unavailability::LowBattery) => Code::LowBattery,
        Some(Unavailability::Teleoperated) => Code::Teleoperated,
        Some(Unavailability::EmergencyStop) => Code::EmergencyStop,
        Some(Unavailability::LocalFault) => Code::LocalFault,
        Some(Unavailability::NotSafe) => Code::NotSafe,
    };
    code as u8
}

impl From<StopReason> for Why {
    fn from(why: StopReason) -> Self {
        match why {
            StopReason::Superseded => Self::of(Reason::Superseded),
            StopReason::Released(why) => why.into(),
            StopReason::Unavailable(why) => Self::unavailable(why),
        }
    }
}

impl From<ReleaseReason> for Why {
    fn from(why: ReleaseReason) -> Self {
        Self::of(match why {
            ReleaseReason::TaskCompleted => Reason::TaskCompleted,
            ReleaseReason::SessionEnded => Reason::SessionEnded,
            ReleaseReason::NotListed => Reason::NotListed,
            ReleaseReason::ReservationExpired => Reason::ReservationExpired,
            ReleaseReason::ContactLost => Reason::ContactLost,
            ReleaseReason::LeaveRequested => Reason::LeaveRequested,
            ReleaseReason::Unavailable(why) => return Self::unavailable(why),
            ReleaseReason::IdentityLockLimit => Reason::IdentityLockLimit,
        })
    }
}

impl From<EndReason> for Why {
    fn from(why: EndReason) -> Self {
        Self::of(match why {
            EndReason::TaskCompleted => Reason::TaskCompleted,
            EndReason::NoHelp => Reason::NoHelp,
            EndReason::Withdrawn(station) => return Self::of(Reason::Withdrawn).about(station),
            EndReason::NoFollowers => Reason::NoFollowers,
            EndReason::LeaveRequested => Reason::LeaveRequested,
            EndReason::Unavailable(why) => return Self::unavailable(why),
            EndReason::IdentityLockLimit => Reason::IdentityLockLimit,
            EndReason::Renewed => Reason::Renewed,
        })
    }
}

impl From<GoneReason> for Why {
    fn from(why: GoneReason) -> Self {
        Self::of(match why {
            GoneReason::Left => Reason::Left,
            GoneReason::NoAcknowledgement => Reason::NoAcknowledgement,
            GoneReason::NoContact => Reason::NoContact,
        })
    }
}

impl From<Rejection> for Why {
    fn from(why: Rejection) -> Self {
        match why {
            Rejection::UnsupportedTask => Self::of(Reason::UnsupportedTask),
            Rejection::Unavailable(why) => Self::unavailable(why),
            Rejection::OnDuty => Self::of(Reason::OnDuty),
        }
    }
}

impl From<Failure> for Why {
    fn from(why: Failure) -> Self {
        match why {
            Failure::Maneuver => Self::of(Reason::ManeuverFailed),
            Failure::Unavailable(why) => Self::unavailable(why),
            Failure::ExecutionLimit => Self::of(Reason::ExecutionLimit),
        }
    }
}

impl From<Disengagement> for Why {
    fn from(why: Disengagement) -> Self {
        Self::of(match why {
            Disengagement::NoLease => Reason::NoLease,
            Disengagement::CommandOutstanding => Reason::CommandOutstanding,
            Disengagement::NotExecuting => Reason::NotExecuting,
            Disengagement::NotGuarding => Reason::NotGuarding,
            Disengagement::NotInPosition => Reason::NotInPosition,
            Disengagement::Completed => Reason::Completed,
            Disengagement::Failed(why) => return why.into(),
            Disengagement::SafeIdle => Reason::SafeIdle,
        })
    }
}

impl From<CorridorClosure> for Why {
    fn from(why: CorridorClosure) -> Self {
        Self::of(match why {
            CorridorClosure::NotEngaged(station, why) => return Self::from(why).about(station),
            CorridorClosure::FollowerMissing => Reason::FollowerMissing,
            CorridorClosure::SessionEnded => Reason::SessionEnded,
            CorridorClosure::Yielded(station) => return Self::of(Reason::Yielded).about(station),
            CorridorClosure::Application => Reason::Application,
        })
    }
}

impl From<Ignored> for Why {
    fn from(why: Ignored) -> Self {
        Self::of(match why {
            Ignored::OwnStation => Reason::OwnStation,
            Ignored::NotAddressed => Reason::NotAddressed,
            Ignored::OtherSession => Reason::OtherSession,
            Ignored::NothingNew => Reason::NothingNew,
            Ignored::AnsweringAnother => Reason::AnsweringAnother,
            Ignored::OldHeartbeat => Reason::OldHeartbeat,
            Ignored::EchoFromFuture => Reason::EchoFromFuture,
            Ignored::OldCommand => Reason::OldCommand,
            Ignored::NotAFollower => Reason::NotAFollower,
            Ignored::RolesAlreadyAssigned => Reason::RolesAlreadyAssigned,
            Ignored::NotOutstanding => Reason::NotOutstanding,
            Ignored::LowerPrecedence => Reason::LowerPrecedence,
            Ignored::FirstHeard => Reason::FirstHeard,
            Ignored::OtherPlace => Reason::OtherPlace,
            Ignored::Yielding => Reason::Yielding,
            Ignored::OldOffer => Reason::OldOffer,
            Ignored::OtherOffer => Reason::OtherOffer,
            Ignored::NeverOffered => Reason::NeverOffered,
            Ignored::TimersDoNotFit => Reason::TimersDoNotFit,
            Ignored::OnDuty => Reason::OnDuty,
            Ignored::RoadOccupied => Reason::RoadOccupied,
            Ignored::NotEnoughTime => Reason::NotEnoughTime,
            Ignored::InSession => Reason::InSession,
            Ignored::NotLeading => Reason::NotLeading,
            Ignored::NotInSession => Reason::NotInSession,
            Ignored::NotExecuting => Reason::NotExecuting,
            Ignored::Unavailable(why) => return Self::unavailable(why),
            Ignored::UnsupportedTask => Reason::UnsupportedTask,
            Ignored::ImpossibleRequest => Reason::ImpossibleRequest,
            Ignored::NotJoined => Reason::NotJoined,
            Ignored::CommandOutstanding => Reason::CommandOutstanding,
            Ignored::CorridorOpen => Reason::CorridorOpen,
            Ignored::CorridorClosed => Reason::CorridorClosed,
            Ignored::NotEngaged(station, why) => return Self::from(why).about(station),
            Ignored::FollowerMissing => Reason::FollowerMissing,
            Ignored::IdentityLocked => Reason::IdentityLocked,
            Ignored::IdentityLockLimit => Reason::IdentityLockLimit,
            Ignored::NumbersExhausted => Reason::NumbersExhausted,
            Ignored::TimerNotArmed => Reason::TimerNotArmed,
        })
    }
}
