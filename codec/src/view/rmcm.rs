//! RMCM: commands and answers to a message, and back.

use crossguard_protocol::{
    Answer, Command, List, MAX_FOLLOWERS, Millis, Rejection, RequestId, Rmcm, StationId, TaskType,
    Verdict,
};

use super::check_followers;
use super::task::{ExecutionStatus, MapPlace, TaskParameters, duration};
use crate::asn1::cdd::{self, GenerationDeltaTime};
use crate::asn1::common;
use crate::asn1::rmcm::{
    FollowerManeuverContainer, LeaderManeuverContainer, ManeuverCommand, ManeuverContainer,
    ManeuverResponse, RMCM, RejectionReason, RmcmParameters, RobotManeuverCoordination,
};
use crate::containers::basic_container;
use crate::error::ViewError;
use crate::identifiers::Identifiers;
use crate::message::header;
use crate::state::{Position, TaskProgression};
use crate::wire::{reason, reason_of, session, session_of};

/// The RMCM of a leader at `position` that gives these commands, 1 to [`MAX_FOLLOWERS`] of one
/// session to different followers. `place` is where the maneuvers take place.
///
/// `generation_delta_time` is that of the position; the validity of a command counts from it.
///
/// # Errors
/// When the commands do not belong into one message, or a target cannot be expressed.
pub fn rmcm_from_commands(
    identifiers: &Identifiers,
    position: &Position,
    place: Option<MapPlace>,
    commands: &[(Command, TaskParameters)],
    generation_delta_time: u16,
) -> Result<RMCM, ViewError> {
    let count_error = ViewError::CommandCount(commands.len());
    let (first, _) = commands.first().ok_or(count_error)?;
    if commands.len() > MAX_FOLLOWERS {
        return Err(count_error);
    }
    for (command, _) in commands {
        if command.session != first.session {
            return Err(ViewError::SessionsDiffer(first.session, command.session));
        }
    }
    let leader = first.session.leader;
    check_followers(leader, commands.iter().map(|(command, _)| command.to))?;
    let commands = commands
        .iter()
        .map(|(command, parameters)| command_from(command, parameters));
    let container = LeaderManeuverContainer::new(
        session(first.session),
        place.map(MapPlace::to_wire),
        commands.collect::<Result<_, _>>()?,
    );
    let container = ManeuverContainer::leaderManeuverContainer(container);
    Ok(rmcm(
        identifiers,
        leader,
        position,
        container,
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
        Verdict::Accepted => ManeuverResponse::accepted(()),
        Verdict::Rejected(Rejection::UnsupportedTask) => {
            ManeuverResponse::rejected(RejectionReason::unsupportedTask(()))
        }
        Verdict::Rejected(Rejection::Unavailable(why)) => {
            ManeuverResponse::rejected(RejectionReason::unavailable(reason(why)))
        }
    };
    let container = FollowerManeuverContainer::new(
        session(answer.session),
        common::RequestId(answer.request.0),
        response,
        status.progression.to_wire(),
        status.time_to_completion.map(duration),
    );
    let container = ManeuverContainer::followerManeuverContainer(container);
    Ok(rmcm(
        identifiers,
        answer.from,
        position,
        container,
        generation_delta_time,
    ))
}

/// The protocol's views of an RMCM: an answer, or one command per follower, in their order.
///
/// # Errors
/// How the message contradicts itself.
pub fn views_of_rmcm(rmcm: &RMCM) -> Result<List<Rmcm, MAX_FOLLOWERS>, ViewError> {
    let sender = StationId(rmcm.header.station_id.0);
    match &rmcm.rmcm.rmcm_parameters.maneuver_container {
        ManeuverContainer::leaderManeuverContainer(container) => commands_of(container, sender),
        ManeuverContainer::followerManeuverContainer(container) => {
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
    let is_for = |command: &&ManeuverCommand| command.target_follower_station_id.0 == follower.0;
    container
        .commands
        .iter()
        .find(is_for)
        .map(TaskParameters::read)
}

/// Where the maneuvers of a leader's message take place, if it says so.
#[must_use]
pub fn map_place_of(rmcm: &RMCM) -> Option<MapPlace> {
    leader_container(rmcm)?
        .map_reference
        .as_ref()
        .map(MapPlace::from_wire)
}

/// How far a follower is with the command that its message answers; `None` for a leader's message.
#[must_use]
pub fn execution_of(rmcm: &RMCM) -> Option<ExecutionStatus> {
    match &rmcm.rmcm.rmcm_parameters.maneuver_container {
        ManeuverContainer::leaderManeuverContainer(_) => None,
        ManeuverContainer::followerManeuverContainer(container) => {
            let time = container.estimated_time_to_completion.as_ref();
            Some(ExecutionStatus {
                progression: TaskProgression::from_wire(container.execution_status),
                time_to_completion: time.map(|time| Millis(time.0)),
            })
        }
    }
}

fn leader_container(rmcm: &RMCM) -> Option<&LeaderManeuverContainer> {
    match &rmcm.rmcm.rmcm_parameters.maneuver_container {
        ManeuverContainer::leaderManeuverContainer(container) => Some(container),
        ManeuverContainer::followerManeuverContainer(_) => None,
    }
}

fn rmcm(
    identifiers: &Identifiers,
    sender: StationId,
    position: &Position,
    container: ManeuverContainer,
    generation_delta_time: u16,
) -> RMCM {
    let parameters = RmcmParameters::new(
        basic_container(identifiers.robot_station_type, position),
        container,
    );
    let generation_delta_time = GenerationDeltaTime(generation_delta_time);
    let coordination = RobotManeuverCoordination::new(generation_delta_time, parameters);
    RMCM::new(header::<RMCM>(identifiers, sender.0), coordination)
}

fn command_from(
    command: &Command,
    parameters: &TaskParameters,
) -> Result<ManeuverCommand, ViewError> {
    let mut wire = ManeuverCommand::new(
        common::RequestId(command.request.0),
        cdd::StationId(command.to.0),
        common::TaskType(command.task.value()),
        None,
        None,
        None,
        None,
    );
    parameters.write(&mut wire, command.to)?;
    Ok(wire)
}

fn commands_of(
    container: &LeaderManeuverContainer,
    sender: StationId,
) -> Result<List<Rmcm, MAX_FOLLOWERS>, ViewError> {
    let session = session_of(&container.session);
    if session.leader != sender {
        return Err(ViewError::NotOwnSession { sender, session });
    }
    let target = |command: &ManeuverCommand| StationId(command.target_follower_station_id.0);
    check_followers(sender, container.commands.iter().map(target))?;
    let count_error = ViewError::CommandCount(container.commands.len());
    if container.commands.is_empty() {
        return Err(count_error);
    }
    let mut views = List::EMPTY;
    for command in &container.commands {
        let view = Command {
            session,
            to: target(command),
            request: RequestId(command.request_id.0),
            task: TaskType::new(command.task_type.0)
                .ok_or(ViewError::TaskType(command.task_type.0))?,
        };
        views.push(Rmcm::Command(view)).map_err(|_| count_error)?;
    }
    Ok(views)
}

fn answer_of(container: &FollowerManeuverContainer, sender: StationId) -> Answer {
    let verdict = match &container.response {
        ManeuverResponse::accepted(()) => Verdict::Accepted,
        ManeuverResponse::rejected(RejectionReason::unsupportedTask(())) => {
            Verdict::Rejected(Rejection::UnsupportedTask)
        }
        ManeuverResponse::rejected(RejectionReason::unavailable(why)) => {
            Verdict::Rejected(Rejection::Unavailable(reason_of(*why)))
        }
    };
    Answer {
        from: sender,
        session: session_of(&container.session),
        request: RequestId(container.job_advice_id.0),
        verdict,
    }
}
