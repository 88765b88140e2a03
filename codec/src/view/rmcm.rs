//! RMCM: commands and answers to a message, and back.

use crossguard_protocol::{
    Answer, Command, List, MAX_FOLLOWERS, Millis, Rejection, RequestId, Rmcm, StationId, Verdict,
};

use super::task::{ExecutionStatus, MapPlace, TaskParameters, duration};
use super::{all_of, check_followers};
use crate::containers::basic_container;
use crate::core::Uper;
use crate::core::cdd::GenerationDeltaTime;
use crate::core::common;
use crate::core::rmcm::{
    FollowerManeuverContainer, LeaderManeuverContainer, ManeuverCommand, ManeuverCommands,
    ManeuverContainer, ManeuverResponse, RMCM, RejectionReason, RmcmParameters,
    RobotManeuverCoordination,
};
use crate::error::ViewError;
use crate::identifiers::Identifiers;
use crate::message::header;
use crate::state::Position;
use crate::wire::{
    reason, reason_of, session, session_of, station, station_of, task_type, task_type_of,
};

const _: () = assert!(ManeuverCommands::CAPACITY >= MAX_FOLLOWERS);

/// The RMCM of a leader at `position` that gives these commands, 1 to [`MAX_FOLLOWERS`] of one
/// session to different followers, which take place at one place of a map.
///
/// `generation_delta_time` is that of the position; the validity of a command counts from it.
///
/// # Errors
/// When the commands do not belong into one message, or a target cannot be expressed.
pub fn rmcm_from_commands(
    identifiers: &Identifiers,
    position: &Position,
    commands: &[(Command, TaskParameters)],
    generation_delta_time: u16,
) -> Result<RMCM, ViewError> {
    let count_error = ViewError::CommandCount(commands.len());
    let (first, parameters) = commands.first().ok_or(count_error)?;
    let place = parameters.map_place;
    if commands.len() > MAX_FOLLOWERS {
        return Err(count_error);
    }
    for (command, parameters) in commands {
        if parameters.map_place != place {
            return Err(ViewError::MapPlacesDiffer(command.to));
        }
        if command.session != first.session {
            return Err(ViewError::SessionsDiffer(first.session, command.session));
        }
    }
    let leader = first.session.leader;
    check_followers(leader, commands.iter().map(|(command, _)| command.to))?;
    let mut wire = [ManeuverCommand::LOWEST; MAX_FOLLOWERS];
    for (slot, (command, parameters)) in wire.iter_mut().zip(commands) {
        *slot = command_from(command, parameters)?;
    }
    let wire = wire.into_iter().take(commands.len());
    let container = LeaderManeuverContainer {
        session: session(first.session),
        map_reference: place.map(MapPlace::to_wire),
        commands: ManeuverCommands::collect(wire).ok_or(count_error)?,
    };
    let container = ManeuverContainer::LeaderManeuverContainer(container);
    Ok(rmcm(
        identifiers,
        leader,
        position,
        &container,
        generation_delta_time,
    ))
}

/// The RMCM of a follower at `position` that answers a command and tells how far it is with it.
///
/// # Errors
/// When the follower answers itself.
pub fn rmcm_from_answer(
    identifiers: &Identifiers,
    position: &Position,
    answer: &Answer,
    status: ExecutionStatus,
    generation_delta_time: u16,
) -> Result<RMCM, ViewError> {
    if answer.from == answer.session.leader {
        return Err(ViewError::OwnSession(answer.from));
    }
    let response = match answer.verdict {
        Verdict::Accepted => ManeuverResponse::Accepted(()),
        Verdict::Rejected(Rejection::UnsupportedTask) => {
            ManeuverResponse::Rejected(RejectionReason::UnsupportedTask(()))
        }
        Verdict::Rejected(Rejection::Unavailable(why)) => {
            ManeuverResponse::Rejected(RejectionReason::Unavailable(reason(why)))
        }
        Verdict::Rejected(Rejection::OnDuty) => {
            ManeuverResponse::Rejected(RejectionReason::OnDuty(()))
        }
    };
    let container = FollowerManeuverContainer {
        session: session(answer.session),
        job_advice_id: common::RequestId(answer.request.0),
        response,
        execution_status: status.progression,
        estimated_time_to_completion: status.time_to_completion.map(duration),
    };
    let container = ManeuverContainer::FollowerManeuverContainer(container);
    Ok(rmcm(
        identifiers,
        answer.from,
        position,
        &container,
        generation_delta_time,
    ))
}

/// The protocol's views of an RMCM: an answer, or one command per follower, in their order.
///
/// # Errors
/// How the message contradicts itself.
pub fn views_of_rmcm(rmcm: &RMCM) -> Result<List<Rmcm, MAX_FOLLOWERS>, ViewError> {
    let sender = station_of(rmcm.header.station_id);
    match &rmcm.rmcm.rmcm_parameters.maneuver_container {
        ManeuverContainer::LeaderManeuverContainer(container) => commands_of(container, sender),
        ManeuverContainer::FollowerManeuverContainer(container) => {
            let answer = answer_of(container, sender);
            if answer.session.leader == sender {
                return Err(ViewError::OwnSession(sender));
            }
            Ok([Rmcm::Answer(answer)].into_iter().collect())
        }
    }
}

/// The parameters of the command for `follower`, if the message has one.
#[must_use]
pub fn task_parameters_of(rmcm: &RMCM, follower: StationId) -> Option<TaskParameters> {
    let container = leader_container(rmcm)?;
    container
        .commands
        .iter()
        .find(|command| target(command) == follower)
        .map(|command| TaskParameters::read(command, map_place_of(rmcm)))
}

/// Where the maneuvers of a leader's message take place, if it says so.
#[must_use]
pub fn map_place_of(rmcm: &RMCM) -> Option<MapPlace> {
    leader_container(rmcm)?
        .map_reference
        .map(MapPlace::from_wire)
}

/// How far a follower is with the command that its message answers; `None` for a leader's message.
#[must_use]
pub fn execution_of(rmcm: &RMCM) -> Option<ExecutionStatus> {
    match &rmcm.rmcm.rmcm_parameters.maneuver_container {
        ManeuverContainer::LeaderManeuverContainer(_) => None,
        ManeuverContainer::FollowerManeuverContainer(container) => {
            let time = container.estimated_time_to_completion;
            Some(ExecutionStatus {
                progression: container.execution_status,
                time_to_completion: time.map(|time| Millis(time.get())),
            })
        }
    }
}

fn leader_container(rmcm: &RMCM) -> Option<&LeaderManeuverContainer> {
    match &rmcm.rmcm.rmcm_parameters.maneuver_container {
        ManeuverContainer::LeaderManeuverContainer(container) => Some(container),
        ManeuverContainer::FollowerManeuverContainer(_) => None,
    }
}

fn rmcm(
    identifiers: &Identifiers,
    sender: StationId,
    position: &Position,
    container: &ManeuverContainer,
    generation_delta_time: u16,
) -> RMCM {
    RMCM {
        header: header::<RMCM>(identifiers, sender),
        rmcm: RobotManeuverCoordination {
            generation_delta_time: GenerationDeltaTime(generation_delta_time),
            rmcm_parameters: RmcmParameters {
                basic_container: basic_container(identifiers.robot_station_type, position),
                maneuver_container: *container,
            },
        },
    }
}

fn command_from(
    command: &Command,
    parameters: &TaskParameters,
) -> Result<ManeuverCommand, ViewError> {
    let wire = ManeuverCommand {
        request_id: common::RequestId(command.request.0),
        target_follower_station_id: station(command.to),
        task_type: task_type(command.task),
        ..Uper::LOWEST
    };
    parameters.write(wire, command.to)
}

fn target(command: &ManeuverCommand) -> StationId {
    station_of(command.target_follower_station_id)
}

fn commands_of(
    container: &LeaderManeuverContainer,
    sender: StationId,
) -> Result<List<Rmcm, MAX_FOLLOWERS>, ViewError> {
    let session = session_of(container.session);
    if session.leader != sender {
        return Err(ViewError::NotOwnSession { sender, session });
    }
    check_followers(sender, container.commands.iter().map(target))?;
    let view = |command: &ManeuverCommand| {
        Rmcm::Command(Command {
            session,
            to: target(command),
            request: RequestId(command.request_id.0),
            task: task_type_of(command.task_type),
        })
    };
    let commands = container.commands.iter().map(view);
    all_of(commands).ok_or(ViewError::CommandCount(container.commands.len()))
}

fn answer_of(container: &FollowerManeuverContainer, sender: StationId) -> Answer {
    let verdict = match container.response {
        ManeuverResponse::Accepted(()) => Verdict::Accepted,
        ManeuverResponse::Rejected(RejectionReason::UnsupportedTask(())) => {
            Verdict::Rejected(Rejection::UnsupportedTask)
        }
        ManeuverResponse::Rejected(RejectionReason::Unavailable(why)) => {
            Verdict::Rejected(Rejection::Unavailable(reason_of(why)))
        }
        ManeuverResponse::Rejected(RejectionReason::OnDuty(())) => {
            Verdict::Rejected(Rejection::OnDuty)
        }
    };
    Answer {
        from: sender,
        session: session_of(container.session),
        request: RequestId(container.job_advice_id.0),
        verdict,
    }
}
