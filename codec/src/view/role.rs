//! The operation container of a RAM: parts in a session, reports, farewells.

use crossguard_protocol::{
    Confirmation, Coordination, Failure, Farewell, Followers, Heartbeat, HelpRequest, OfferNumber,
    Progress, Ram, Report, RequestId, SessionId, StationId, UniqueNumber, Urgency,
};

use crate::asn1::ram::{
    self, CommandProgress, CommandReport, ConfirmedFollower, FailureReason, FollowerRole,
    HelperRole, LeaderRole, RequestUrgency, RequesterRole, SessionFarewell, SessionRole,
};
use crate::asn1::{cdd, common};
use crate::error::ViewError;
use crate::wire::{reason, reason_of, session, session_number_of, session_of, task_set, tasks_of};

/// The part in a session that `view` tells.
pub(super) fn role_from(view: &Ram) -> Result<Option<SessionRole>, ViewError> {
    let own_session = |number| {
        session(SessionId {
            leader: view.station,
            number,
        })
    };
    Ok(Some(match view.coordination {
        Coordination::None => return Ok(None),
        Coordination::NeedHelp { number, request } => SessionRole::requester(RequesterRole::new(
            own_session(number),
            urgency(request.urgency),
            request.followers,
            task_set(request.tasks),
        )),
        Coordination::OfferHelp {
            session: offered,
            offer,
            capabilities,
        } => SessionRole::helper(HelperRole::new(
            session(offered),
            common::OfferNumber(offer.0.to_u32()),
            task_set(capabilities),
        )),
        Coordination::Leader {
            number,
            heartbeat,
            followers,
        } => SessionRole::leader(LeaderRole::new(
            own_session(number),
            ram::Heartbeat(heartbeat.0),
            followers.iter().copied().map(confirmation).collect(),
        )),
        Coordination::Follower {
            session: followed,
            echo,
            last,
        } => SessionRole::follower(FollowerRole::new(
            session(followed),
            ram::Heartbeat(echo.0),
            last.map(report).transpose()?,
        )),
    }))
}

/// What `role` means when `sender` has it.
pub(super) fn role_of(role: &SessionRole, sender: StationId) -> Result<Coordination, ViewError> {
    let own = |session: &common::CoordinationSession| {
        let session = session_of(session);
        if session.leader == sender {
            Ok(session.number)
        } else {
            Err(ViewError::NotOwnSession { sender, session })
        }
    };
    Ok(match role {
        SessionRole::requester(requester) => Coordination::NeedHelp {
            number: own(&requester.session)?,
            request: HelpRequest {
                urgency: urgency_of(requester.urgency),
                followers: requester.follower_count,
                tasks: tasks_of(&requester.requested_tasks),
            },
        },
        SessionRole::helper(helper) => Coordination::OfferHelp {
            session: session_of(&helper.session),
            offer: offer_of(&helper.offer_number),
            capabilities: tasks_of(&helper.capabilities),
        },
        SessionRole::leader(leader) => Coordination::Leader {
            number: own(&leader.session)?,
            heartbeat: Heartbeat(leader.heartbeat.0),
            followers: followers_of(&leader.followers)?,
        },
        SessionRole::follower(follower) => Coordination::Follower {
            session: session_of(&follower.session),
            echo: Heartbeat(follower.heartbeat_echo.0),
            last: follower.last_command.as_ref().map(report_of),
        },
    })
}

fn offer_of(number: &common::OfferNumber) -> OfferNumber {
    OfferNumber(UniqueNumber::from_u32(number.0))
}

fn confirmation(confirmation: Confirmation) -> ConfirmedFollower {
    ConfirmedFollower::new(
        cdd::StationId(confirmation.station.0),
        common::OfferNumber(confirmation.offer.0.to_u32()),
    )
}

fn followers_of(named: &[ConfirmedFollower]) -> Result<Followers, ViewError> {
    let mut followers = Followers::EMPTY;
    for follower in named {
        let pushed = followers.push(confirmation_of(follower));
        pushed.map_err(|_| ViewError::TooManyFollowers(named.len()))?;
    }
    Ok(followers)
}

fn confirmation_of(follower: &ConfirmedFollower) -> Confirmation {
    Confirmation {
        station: StationId(follower.station_id.0),
        offer: offer_of(&follower.offer_number),
    }
}

fn report(report: Report) -> Result<CommandReport, ViewError> {
    let progress = match report.progress {
        Progress::Executing => CommandProgress::executing(()),
        Progress::Completed => CommandProgress::completed(()),
        Progress::SafeIdle => CommandProgress::safeIdle(()),
        Progress::Failed(failure) => CommandProgress::failed(match failure {
            Failure::Maneuver => FailureReason::maneuver(()),
            Failure::Unavailable(why) => FailureReason::unavailable(reason(why)),
            Failure::ExecutionLimit => return Err(ViewError::ExecutionLimit),
        }),
    };
    Ok(CommandReport::new(
        common::RequestId(report.request.0),
        progress,
    ))
}

fn report_of(report: &CommandReport) -> Report {
    let progress = match &report.progress {
        CommandProgress::executing(()) => Progress::Executing,
        CommandProgress::completed(()) => Progress::Completed,
        CommandProgress::safeIdle(()) => Progress::SafeIdle,
        CommandProgress::failed(FailureReason::maneuver(())) => Progress::Failed(Failure::Maneuver),
        CommandProgress::failed(FailureReason::unavailable(why)) => {
            Progress::Failed(Failure::Unavailable(reason_of(*why)))
        }
    };
    Report {
        request: RequestId(report.request_id.0),
        progress,
    }
}

pub(super) fn farewell_from(farewell: Farewell) -> SessionFarewell {
    match farewell {
        Farewell::Ended(number) => SessionFarewell::ended(common::SessionNumber(number.0.to_u32())),
        Farewell::Left(left) => SessionFarewell::left(session(left)),
    }
}

pub(super) fn farewell_of(farewell: &SessionFarewell) -> Farewell {
    match farewell {
        SessionFarewell::ended(number) => Farewell::Ended(session_number_of(number)),
        SessionFarewell::left(left) => Farewell::Left(session_of(left)),
    }
}

fn urgency(urgency: Urgency) -> RequestUrgency {
    match urgency {
        Urgency::Low => RequestUrgency::low,
        Urgency::Medium => RequestUrgency::medium,
        Urgency::High => RequestUrgency::high,
        Urgency::Emergency => RequestUrgency::emergency,
    }
}

fn urgency_of(urgency: RequestUrgency) -> Urgency {
    match urgency {
        RequestUrgency::low => Urgency::Low,
        RequestUrgency::medium => Urgency::Medium,
        RequestUrgency::high => Urgency::High,
        RequestUrgency::emergency => Urgency::Emergency,
    }
}
