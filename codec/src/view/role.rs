//! The operation container of a RAM: parts in a session, reports, farewells.

use crossguard_protocol::{
    Confirmation, Coordination, Failure, Farewell, Heartbeat, HelpRequest, MAX_FOLLOWERS, Millis,
    OfferNumber, Place, Progress, Ram, Report, RequestId, SessionId, StationId, UniqueNumber,
};

use super::all_of;
use crate::core::common;
use crate::core::ram::{
    self, CommandProgress, CommandReport, ConfirmedFollower, ConfirmedFollowers, CrossingNumber,
    CrossingReference, EndedSession, FailureReason, FollowerRole, HelperRole, LeaderRole,
    LeftSession, RequestedFollowers, RequesterRole, SafetyTimeout, SessionFarewell, SessionRole,
};
use crate::error::ViewError;
use crate::wire::{
    ending, ending_of, reason, reason_of, session, session_number, session_number_of, session_of,
    station, station_of, task_set, tasks_of, urgency, urgency_of,
};

const _: () = assert!(ConfirmedFollowers::CAPACITY >= MAX_FOLLOWERS);
const _: () = assert!(RequestedFollowers::MAX as usize >= MAX_FOLLOWERS);
const _: () = assert!(SafetyTimeout::MAX == Millis::MAX_TIMER.0);

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
        Coordination::NeedHelp {
            number,
            heartbeat,
            request,
        } => SessionRole::Requester(RequesterRole {
            session: own_session(number),
            heartbeat: ram::Heartbeat(heartbeat.0),
            urgency: urgency(request.urgency),
            crossing: crossing(request.place),
            follower_count: RequestedFollowers::new(request.followers)
                .ok_or(ViewError::FollowerCount(request.followers))?,
            requested_tasks: task_set(request.tasks),
        }),
        Coordination::OfferHelp {
            session: offered,
            offer,
            capabilities,
            echo,
            t_safety,
        } => SessionRole::Helper(HelperRole {
            session: session(offered),
            offer_number: offer_number(offer),
            capabilities: task_set(capabilities),
            heartbeat_echo: ram::Heartbeat(echo.0),
            safety_timeout: SafetyTimeout::new(t_safety.0)
                .ok_or(ViewError::SafetyTimeout(t_safety))?,
        }),
        Coordination::Leader {
            number,
            heartbeat,
            followers,
            urgency: of_request,
            place,
            yields,
        } => SessionRole::Leader(LeaderRole {
            session: own_session(number),
            heartbeat: ram::Heartbeat(heartbeat.0),
            urgency: urgency(of_request),
            crossing: crossing(place),
            yields,
            followers: ConfirmedFollowers::collect(followers.iter().copied().map(confirmation))
                .ok_or(ViewError::NoFollowers)?,
        }),
        Coordination::Follower {
            session: followed,
            echo,
            last,
        } => SessionRole::Follower(FollowerRole {
            session: session(followed),
            heartbeat_echo: ram::Heartbeat(echo.0),
            last_command: last.map(report).transpose()?,
        }),
    }))
}

/// The meaning of `role` when `sender` has it.
pub(super) fn role_of(role: &SessionRole, sender: StationId) -> Result<Coordination, ViewError> {
    let own = |session| {
        let session = session_of(session);
        if session.leader == sender {
            Ok(session.number)
        } else {
            Err(ViewError::NotOwnSession { sender, session })
        }
    };
    Ok(match role {
        SessionRole::Requester(requester) => Coordination::NeedHelp {
            number: own(requester.session)?,
            heartbeat: Heartbeat(requester.heartbeat.0),
            request: HelpRequest {
                urgency: urgency_of(requester.urgency),
                followers: requester.follower_count.get(),
                tasks: tasks_of(requester.requested_tasks),
                place: place_of(requester.crossing)?,
            },
        },
        SessionRole::Helper(helper) => Coordination::OfferHelp {
            session: session_of(helper.session),
            offer: offer_of(helper.offer_number),
            capabilities: tasks_of(helper.capabilities),
            echo: Heartbeat(helper.heartbeat_echo.0),
            t_safety: Millis(helper.safety_timeout.get()),
        },
        SessionRole::Leader(leader) => Coordination::Leader {
            number: own(leader.session)?,
            heartbeat: Heartbeat(leader.heartbeat.0),
            followers: all_of(leader.followers.iter().copied().map(confirmation_of))
                .ok_or(ViewError::MemberCount(leader.followers.len()))?,
            urgency: urgency_of(leader.urgency),
            place: place_of(leader.crossing)?,
            yields: leader.yields,
        },
        SessionRole::Follower(follower) => Coordination::Follower {
            session: session_of(follower.session),
            echo: Heartbeat(follower.heartbeat_echo.0),
            last: follower.last_command.map(report_of),
        },
    })
}

fn offer_number(offer: OfferNumber) -> common::OfferNumber {
    common::OfferNumber(offer.0.to_u32())
}

fn offer_of(number: common::OfferNumber) -> OfferNumber {
    OfferNumber(UniqueNumber::from_u32(number.0))
}

fn confirmation(confirmation: Confirmation) -> ConfirmedFollower {
    ConfirmedFollower {
        station_id: station(confirmation.station),
        offer_number: offer_number(confirmation.offer),
    }
}

fn confirmation_of(follower: ConfirmedFollower) -> Confirmation {
    Confirmation {
        station: station_of(follower.station_id),
        offer: offer_of(follower.offer_number),
    }
}

fn report(report: Report) -> Result<CommandReport, ViewError> {
    let progress = match report.progress {
        Progress::Executing => CommandProgress::Executing(()),
        Progress::InPosition => CommandProgress::InPosition(()),
        Progress::Completed => CommandProgress::Completed(()),
        Progress::SafeIdle => CommandProgress::SafeIdle(()),
        Progress::Failed(failure) => CommandProgress::Failed(match failure {
            Failure::Maneuver => FailureReason::Maneuver(()),
            Failure::Unavailable(why) => FailureReason::Unavailable(reason(why)),
            Failure::ExecutionLimit => return Err(ViewError::ExecutionLimit),
        }),
    };
    Ok(CommandReport {
        request_id: common::RequestId(report.request.0),
        progress,
    })
}

fn report_of(report: CommandReport) -> Report {
    let progress = match report.progress {
        CommandProgress::Executing(()) => Progress::Executing,
        CommandProgress::InPosition(()) => Progress::InPosition,
        CommandProgress::Completed(()) => Progress::Completed,
        CommandProgress::SafeIdle(()) => Progress::SafeIdle,
        CommandProgress::Failed(FailureReason::Maneuver(())) => Progress::Failed(Failure::Maneuver),
        CommandProgress::Failed(FailureReason::Unavailable(why)) => {
            Progress::Failed(Failure::Unavailable(reason_of(why)))
        }
    };
    Report {
        request: RequestId(report.request_id.0),
        progress,
    }
}

pub(super) fn farewell_from(farewell: Farewell) -> SessionFarewell {
    match farewell {
        Farewell::Ended(number, how) => SessionFarewell::Ended(EndedSession {
            session_number: session_number(number),
            ending: ending(how),
        }),
        Farewell::Left(left, offer) => SessionFarewell::Left(LeftSession {
            session: session(left),
            offer_number: offer_number(offer),
        }),
    }
}

pub(super) fn farewell_of(farewell: SessionFarewell) -> Farewell {
    match farewell {
        SessionFarewell::Ended(ended) => {
            let number = session_number_of(ended.session_number);
            Farewell::Ended(number, ending_of(ended.ending))
        }
        SessionFarewell::Left(left) => {
            Farewell::Left(session_of(left.session), offer_of(left.offer_number))
        }
    }
}

/// An unknown place is left out.
fn crossing(place: Place) -> Option<CrossingReference> {
    let Place(number) = place;
    (place != Place::UNKNOWN).then_some(CrossingReference {
        regulator: CrossingNumber((number >> 16) as u16),
        intersection: CrossingNumber((number & 0xffff) as u16),
    })
}

/// The place of a message. One that spells the unknown place out is refused: there is one way to say it.
fn place_of(crossing: Option<CrossingReference>) -> Result<Place, ViewError> {
    let Some(crossing) = crossing else {
        return Ok(Place::UNKNOWN);
    };
    let (regulator, intersection) = (crossing.regulator.0, crossing.intersection.0);
    match Place(u32::from(regulator) << 16 | u32::from(intersection)) {
        Place::UNKNOWN => Err(ViewError::UnknownCrossing),
        place => Ok(place),
    }
}
