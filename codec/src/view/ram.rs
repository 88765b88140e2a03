//! RAM: state and view to a message, and back.

use crossguard_protocol::{Availability, Coordination, Farewell, Progress, Ram, SessionId};

use super::check_followers;
use super::role::{farewell_from, farewell_of, role_from, role_of};
use crate::containers::{
    basic_container, battery, battery_of, high_frequency, low_frequency, position_of,
    read_high_frequency, slow_state_of,
};
use crate::core::cdd::GenerationDeltaTime;
use crate::core::ram::{
    HelpStatus, RAM, RamParameters, RobotAwareness, RobotLeaderFollowerOperationContainer,
    RobotStatusContainer,
};
use crate::error::ViewError;
use crate::identifiers::Identifiers;
use crate::message::header;
use crate::state::{RobotState, TaskProgression};
use crate::wire::{reason, reason_of, station_of};

/// The RAM of a robot in this `state` whose part in coordination is `view`.
///
/// `generation_delta_time` is that of the position. The low-frequency container is there if it is
/// asked for and the state has a [`slow`](RobotState::slow) part. Containers for clusters and motion
/// prediction are the caller's to add.
///
/// # Errors
/// When the view is one that no message can carry.
pub fn ram_from(
    identifiers: &Identifiers,
    state: &RobotState,
    view: &Ram,
    availability: Availability,
    generation_delta_time: u16,
    with_low_frequency: bool,
) -> Result<RAM, ViewError> {
    check(view)?;
    let role = role_from(view)?;
    let farewell = view.farewell.map(farewell_from);
    let progression = reported_progression(view).unwrap_or(state.task_progression);
    let status = RobotStatusContainer {
        robot_category: state.category,
        operational_job_role: state.job_role,
        task_progression: progression,
        battery_status: battery(&state.battery),
        control_mode: state.control_mode,
        help_status: help_status(&view.coordination),
        unavailability: match availability {
            Availability::Available => None,
            Availability::Unavailable(why) => Some(reason(why)),
        },
        on_duty: view.on_duty,
    };
    let is_part = role.is_some() || farewell.is_some();
    let operation = is_part.then_some(RobotLeaderFollowerOperationContainer { role, farewell });
    let slow = state.slow.as_ref().filter(|_| with_low_frequency);
    Ok(RAM {
        header: header::<RAM>(identifiers, view.station),
        ram: RobotAwareness {
            generation_delta_time: GenerationDeltaTime(generation_delta_time),
            ram_parameters: RamParameters {
                basic_container: basic_container(identifiers.robot_station_type, &state.position),
                robot_high_frequency_container: high_frequency(state),
                robot_low_frequency_container: slow
                    .map(|slow| low_frequency(slow, &state.position)),
                robot_status_container: status,
                robot_leader_follower_operation_container: operation,
                vru_cluster_information_container: None,
                vru_motion_prediction_container: None,
            },
        },
    })
}

/// The protocol's view of a RAM.
///
/// # Errors
/// How the message contradicts itself.
pub fn view_of_ram(ram: &RAM) -> Result<Ram, ViewError> {
    let parameters = &ram.ram.ram_parameters;
    let operation = parameters
        .robot_leader_follower_operation_container
        .as_ref();
    let role = operation.and_then(|operation| operation.role.as_ref());
    let farewell = operation.and_then(|operation| operation.farewell);
    let sender = station_of(ram.header.station_id);
    let view = Ram {
        station: sender,
        coordination: role.map_or(Ok(Coordination::None), |role| role_of(role, sender))?,
        farewell: farewell.map(farewell_of),
        on_duty: parameters.robot_status_container.on_duty,
    };
    check(&view)?;
    let status = &parameters.robot_status_container;
    let (found, expected) = (status.help_status, help_status(&view.coordination));
    if found != expected {
        return Err(ViewError::HelpStatus { found, expected });
    }
    let found = status.task_progression;
    match reported_progression(&view) {
        Some(expected) if expected != found => Err(ViewError::TaskProgression { found, expected }),
        _ => Ok(view),
    }
}

/// Availability of the sender of a RAM for coordination.
#[must_use]
pub fn availability_of(ram: &RAM) -> Availability {
    match ram.ram.ram_parameters.robot_status_container.unavailability {
        None => Availability::Available,
        Some(why) => Availability::Unavailable(reason_of(why)),
    }
}

/// The state of the sender of a RAM, in SI units.
#[must_use]
pub fn state_of(ram: &RAM) -> RobotState {
    let parameters = &ram.ram.ram_parameters;
    let status = &parameters.robot_status_container;
    let position = position_of(&parameters.basic_container);
    let slow = parameters.robot_low_frequency_container.as_ref();
    let mut state = RobotState {
        position,
        category: status.robot_category,
        job_role: status.operational_job_role,
        task_progression: status.task_progression,
        battery: battery_of(status.battery_status),
        control_mode: status.control_mode,
        slow: slow.map(|slow| slow_state_of(slow, &position)),
        ..RobotState::default()
    };
    read_high_frequency(&parameters.robot_high_frequency_container, &mut state);
    state
}

/// Checks what holds for the view of every RAM, beyond the numbers that its fields can hold.
fn check(view: &Ram) -> Result<(), ViewError> {
    let sender = view.station;
    let own_session = |number| SessionId {
        leader: sender,
        number,
    };
    let present = match view.coordination {
        Coordination::None => None,
        Coordination::NeedHelp { number, .. } => Some(own_session(number)),
        Coordination::Leader {
            number, followers, ..
        } => {
            check_followers(sender, followers.iter().map(|follower| follower.station))?;
            Some(own_session(number))
        }
        Coordination::OfferHelp { session, .. } | Coordination::Follower { session, .. } => {
            if session.leader == sender {
                return Err(ViewError::OwnSession(sender));
            }
            Some(session)
        }
    };
    let past = match view.farewell {
        None => return Ok(()),
        Some(Farewell::Left(session, _)) if session.leader == sender => {
            return Err(ViewError::OwnSession(sender));
        }
        Some(Farewell::Left(session, _)) => session,
        Some(Farewell::Ended(number, _)) => own_session(number),
    };
    if present == Some(past) {
        return Err(ViewError::FarewellToPresent(past));
    }
    Ok(())
}

/// The status that goes with a part in a session.
fn help_status(coordination: &Coordination) -> HelpStatus {
    match coordination {
        Coordination::None => HelpStatus::None,
        Coordination::NeedHelp { .. } => HelpStatus::NeedHelp,
        Coordination::OfferHelp { .. } => HelpStatus::OfferHelp,
        Coordination::Leader { .. } | Coordination::Follower { .. } => HelpStatus::RoleConfirmed,
    }
}

/// The progress of its task that a follower reports.
fn reported_progression(view: &Ram) -> Option<TaskProgression> {
    let Coordination::Follower {
        last: Some(report), ..
    } = view.coordination
    else {
        return None;
    };
    Some(match report.progress {
        Progress::Executing => TaskProgression::Executing,
        Progress::InPosition => TaskProgression::InPosition,
        Progress::Completed => TaskProgression::Completed,
        Progress::Failed(_) => TaskProgression::Failed,
        Progress::SafeIdle => TaskProgression::SafeIdle,
    })
}
