//! Properties of the mapping as plain functions, one body for Kani, proptest and sweeps, as
//! [`core::laws`](crate::core::laws). A law returns nothing; it panics where it is broken.
//!
//! What the protocol says comes from `crossguard_protocol::laws::arbitrary`, a message from
//! [`Uper::arbitrary`](crate::core::Uper::arbitrary), each with a source of that crate.
//!
//! ```text
//!              rams_keep_the_view, commands_keep_.., answers_keep_..
//!         view ───────────────► message ───────────────► the same view
//!
//!              hearing_a_ram_is_total, hearing_an_rmcm_is_total
//!      message ───► view ───────► message with the same containers, or a contradiction
//! ```
//!
//! The laws of views have no floating point but that of constants: positions and states in them are
//! unavailable. Those of states and parameters are about conversions by [`si`](crate::si).
//!
//! No loop has more turns than there are followers in a session, but for
//! [`states_are_told_as_they_were_read`], which goes along the path of a robot.

#![allow(clippy::missing_panics_doc, reason = "a law panics where it is broken")]

use crossguard_protocol::{
    Answer, Availability, Command, Config, Coordination, Failure, Farewell, MAX_FOLLOWERS, Millis,
    Progress, Ram, Report, Rmcm, Robot, SessionId, StationId,
};

use super::{
    ExecutionStatus, MapPlace, TaskParameters, availability_of, execution_of, map_place_of,
    ram_from, rmcm_from_answer, rmcm_from_commands, state_of, task_parameters_of, view_of_ram,
    views_of_rmcm,
};
use crate::core::ram::{RAM, RobotLeaderFollowerOperationContainer};
use crate::core::rmcm::{ManeuverContainer, RMCM};
use crate::identifiers::Identifiers;
use crate::state::{Position, RobotState};

/// Whether a RAM can say this: its numbers have a place, and it does not contradict itself. The same
/// as the mapping finds, put plainly.
#[must_use]
pub fn can_be_said(view: &Ram) -> bool {
    let own = |number| SessionId {
        leader: view.station,
        number,
    };
    let is_foreign = |session: SessionId| session.leader != view.station;
    let (is_sound, present) = match view.coordination {
        Coordination::None => (true, None),
        Coordination::NeedHelp { number, request } => {
            let count = usize::from(request.followers);
            (0 < count && count <= MAX_FOLLOWERS, Some(own(number)))
        }
        Coordination::OfferHelp { session, .. } => (is_foreign(session), Some(session)),
        Coordination::Leader {
            number, followers, ..
        } => {
            let stations = followers.iter().map(|follower| follower.station);
            let is_sound = !followers.is_empty() && are_others(view.station, stations);
            (is_sound, Some(own(number)))
        }
        Coordination::Follower { session, last, .. } => {
            (is_foreign(session) && last.is_none_or(is_own), Some(session))
        }
    };
    let past = view.farewell.map(|farewell| match farewell {
        Farewell::Ended(number) => own(number),
        Farewell::Left(session) => session,
    });
    let has_left_own = matches!(view.farewell, Some(Farewell::Left(session)) if !is_foreign(session));
    is_sound && !has_left_own && (past.is_none() || past != present)
}

/// Whether a follower can report this of itself.
fn is_own(report: Report) -> bool {
    report.progress != Progress::Failed(Failure::ExecutionLimit)
}

/// Whether no station is named twice, nor the leader.
fn are_others(leader: StationId, stations: impl Iterator<Item = StationId> + Clone) -> bool {
    stations.clone().enumerate().all(|(index, station)| {
        let earlier = stations.clone().take(index);
        station != leader && !earlier.into_iter().any(|other| other == station)
    })
}

fn ram_of(view: &Ram, availability: Availability) -> Option<RAM> {
    let (identifiers, state) = (Identifiers::default(), RobotState::default());
    ram_from(&identifiers, &state, view, availability, 0, false).ok()
}

/// A RAM can be made of a view exactly where [`can_be_said`] says so, and has that view.
pub fn rams_keep_the_view(view: &Ram, availability: Availability) {
    let said = ram_of(view, availability);
    assert!(said.is_some() == can_be_said(view));
    if let Some(said) = said {
        assert!(view_of_ram(&said) == Ok(*view));
        assert!(availability_of(&said) == availability);
    }
}

/// Whatever a robot in a valid state has to say, a RAM says it.
pub fn a_valid_robot_can_say_what_it_is(config: &Config, robot: &Robot) {
    if robot.is_valid(config) {
        let view = robot.ram();
        assert!(can_be_said(&view));
        rams_keep_the_view(&view, Availability::Available);
    }
}

/// Every RAM has a view or contradicts itself, and the view has everything that it says of
/// coordination: made of the view again it says the same.
pub fn hearing_a_ram_is_total(ram: &RAM) {
    let Ok(view) = view_of_ram(ram) else {
        return;
    };
    assert!(can_be_said(&view));
    let again = ram_of(&view, availability_of(ram));
    assert!(again.is_some());
    if let Some(again) = again {
        let (heard, said) = (&ram.ram.ram_parameters, &again.ram.ram_parameters);
        assert!(again.header.station_id == ram.header.station_id);
        assert!(
            part(said.robot_leader_follower_operation_container.as_ref())
                == part(heard.robot_leader_follower_operation_container.as_ref())
        );
        let (heard, said) = (&heard.robot_status_container, &said.robot_status_container);
        assert!(said.help_status == heard.help_status);
        assert!(said.unavailability == heard.unavailability);
    }
}

/// An operation container without role and farewell says as much as none.
fn part(
    container: Option<&RobotLeaderFollowerOperationContainer>,
) -> RobotLeaderFollowerOperationContainer {
    let nothing = RobotLeaderFollowerOperationContainer {
        role: None,
        farewell: None,
    };
    container.copied().unwrap_or(nothing)
}

/// Every RAM has a state; the RAM of that state has it too, and so on without drifting.
pub fn states_are_told_as_they_were_read(ram: &RAM) {
    let told = retold(ram);
    assert!(told.is_some());
    if let Some(told) = told {
        assert!(retold(&told) == Some(told));
    }
}

/// The RAM of a robot in the state that a RAM says, without a part in a session.
fn retold(ram: &RAM) -> Option<RAM> {
    let view = Ram {
        station: StationId(0),
        coordination: Coordination::None,
        farewell: None,
    };
    let (state, available) = (state_of(ram), Availability::Available);
    ram_from(&Identifiers::default(), &state, &view, available, 0, true).ok()
}

/// An RMCM can be made of commands exactly where they are of one session, for different followers,
/// and not too many, and it has those commands in their order.
pub fn commands_keep_the_view(commands: &[Command], place: Option<MapPlace>) {
    let mut told = [None; MAX_FOLLOWERS];
    for (slot, command) in told.iter_mut().zip(commands) {
        *slot = Some((*command, TaskParameters::default()));
    }
    let belong_together = commands.first().is_some_and(|first| {
        let leader = first.session.leader;
        commands.len() <= MAX_FOLLOWERS
            && commands.iter().all(|command| command.session == first.session)
            && are_others(leader, commands.iter().map(|command| command.to))
    });
    // Commands that are too many are as good as none.
    let told = match (commands.len(), told) {
        (1, [Some(a), ..]) => rmcm_of(&[a], place),
        (2, [Some(a), Some(b), ..]) => rmcm_of(&[a, b], place),
        (3, [Some(a), Some(b), Some(c), ..]) => rmcm_of(&[a, b, c], place),
        (4, [Some(a), Some(b), Some(c), Some(d)]) => rmcm_of(&[a, b, c, d], place),
        _ => None,
    };
    assert!(told.is_some() == belong_together);
    let Some(told) = told else {
        return;
    };
    let views = views_of_rmcm(&told);
    assert!(views.is_ok());
    if let Ok(views) = views {
        assert!(views.len() == commands.len());
        for (view, command) in views.iter().zip(commands) {
            assert!(*view == Rmcm::Command(*command));
            assert!(task_parameters_of(&told, command.to) == Some(TaskParameters::default()));
        }
    }
    assert!(map_place_of(&told) == place);
    assert!(execution_of(&told).is_none());
}
