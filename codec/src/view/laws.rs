//! Properties of the mapping as plain functions, one body for Kani, proptest and sweeps, as
//! [`core::laws`](crate::core::laws). A law returns nothing; it panics where it is broken.
//!
//! Words of the protocol come from `crossguard_protocol::laws::arbitrary`, a message from
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

use core::ops::RangeInclusive;

use crossguard_protocol::{
    Answer, Availability, Command, Config, Coordination, Failure, Farewell, MAX_FOLLOWERS, Millis,
    Progress, Ram, Report, Rmcm, Robot, SessionId, StationId,
};

use super::{
    ExecutionStatus, TaskParameters, availability_of, execution_of, map_place_of, ram_from,
    rmcm_from_answer, rmcm_from_commands, state_of, task_parameters_of, view_of_ram, views_of_rmcm,
};
use crate::core::ram::{RAM, RobotLeaderFollowerOperationContainer};
use crate::core::rmcm::{ManeuverCommand, ManeuverContainer, RMCM};
use crate::identifiers::Identifiers;
use crate::state::{Position, RobotState};

/// How many followers a RAM can ask for, whatever the robot that makes or hears it has room for: who asks is a rival, too.
const CAN_BE_ASKED_FOR: RangeInclusive<u8> = 1..=16;

/// True if a RAM can say this: its numbers have a place, and it does not contradict itself. The same
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
        Coordination::NeedHelp {
            number, request, ..
        } => (
            CAN_BE_ASKED_FOR.contains(&request.followers),
            Some(own(number)),
        ),
        Coordination::OfferHelp {
            session, t_safety, ..
        } => {
            let can_be_told = Millis(0) < t_safety && t_safety <= Millis::MAX_TIMER;
            (is_foreign(session) && can_be_told, Some(session))
        }
        Coordination::Leader {
            number, followers, ..
        } => {
            let stations = followers.iter().map(|follower| follower.station);
            let is_sound = !followers.is_empty() && are_others(view.station, stations);
            (is_sound, Some(own(number)))
        }
        Coordination::Follower { session, last, .. } => (
            is_foreign(session) && last.is_none_or(is_own),
            Some(session),
        ),
    };
    let past = view.farewell.map(|farewell| match farewell {
        Farewell::Ended(number, _) => own(number),
        Farewell::Left(session, _) => session,
    });
    let has_left_own =
        matches!(view.farewell, Some(Farewell::Left(session, _)) if !is_foreign(session));
    is_sound && !has_left_own && (past.is_none() || past != present)
}

/// True if a follower can report this of itself.
fn is_own(report: Report) -> bool {
    report.progress != Progress::Failed(Failure::ExecutionLimit)
}

/// True if no station is named twice, nor the leader.
fn are_others(leader: StationId, mut stations: impl Iterator<Item = StationId> + Clone) -> bool {
    while let Some(station) = stations.next() {
        if station == leader || stations.clone().any(|other| other == station) {
            return false;
        }
    }
    true
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
        assert!(said.on_duty == heard.on_duty);
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

/// Every RAM has a state; the RAM of that state has it too, and so on without drifting. What has two
/// names on the wire, as the antimeridian has, the first RAM tells by one.
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
        on_duty: false,
    };
    let (state, available) = (state_of(ram), Availability::Available);
    ram_from(&Identifiers::default(), &state, &view, available, 0, true).ok()
}

/// An RMCM can be made of commands exactly where they are of one session, for different followers,
/// at one place and not too many, and it has those commands in their order. The parameters have no target, since
/// not every target can be expressed.
pub fn commands_keep_the_view(commands: &[(Command, TaskParameters)]) {
    let place = commands
        .first()
        .and_then(|(_, parameters)| parameters.map_place);
    let belong_together = commands.first().is_some_and(|(first, _)| {
        let stations = commands.iter().map(|(command, _)| command.to);
        commands.len() <= MAX_FOLLOWERS
            && commands
                .iter()
                .all(|(command, it)| command.session == first.session && it.map_place == place)
            && are_others(first.session.leader, stations)
    });
    let said = rmcm_of(commands);
    assert!(said.is_some() == belong_together);
    let Some(said) = said else {
        return;
    };
    let views = views_of_rmcm(&said);
    assert!(views.is_ok_and(|views| views.len() == commands.len()));
    if let Ok(views) = views {
        for (view, (command, _)) in views.iter().zip(commands) {
            assert!(*view == Rmcm::Command(*command));
        }
    }
    assert!(map_place_of(&said) == place);
    assert!(execution_of(&said).is_none());
}

/// An RMCM can be made of every answer to another robot and has that answer, with the status.
pub fn answers_keep_the_view(answer: &Answer, status: ExecutionStatus) {
    let said = rmcm_of_answer(answer, status);
    assert!(said.is_some() == (answer.from != answer.session.leader));
    let Some(said) = said else {
        return;
    };
    let views = views_of_rmcm(&said);
    assert!(views.is_ok_and(|views| views.len() == 1));
    if let Ok(views) = views {
        for view in views.iter() {
            assert!(*view == Rmcm::Answer(*answer));
        }
    }
    let at_most_a_day = |time: Millis| time.min(Millis::MAX_TIMER);
    let expected = ExecutionStatus {
        time_to_completion: status.time_to_completion.map(at_most_a_day),
        ..status
    };
    assert!(execution_of(&said) == Some(expected));
    assert!(map_place_of(&said).is_none());
}

/// Every RMCM has views or contradicts itself, and the views have everything that it says of
/// commands and answers: made of them again it says the same.
pub fn hearing_an_rmcm_is_total(rmcm: &RMCM) {
    let Ok(views) = views_of_rmcm(rmcm) else {
        return;
    };
    let mut views = views.iter();
    let heard = &rmcm.rmcm.rmcm_parameters.maneuver_container;
    match heard {
        ManeuverContainer::LeaderManeuverContainer(heard) => {
            assert!(heard.commands.len() == views.clone().count());
            for (view, heard) in views.zip(heard.commands.iter()) {
                let Rmcm::Command(command) = view else {
                    panic!("a leader answers");
                };
                let said = rmcm_of(&[(*command, TaskParameters::default())]);
                let said = said.as_ref().and_then(the_command);
                assert!(said.is_some_and(|said| {
                    said.request_id == heard.request_id
                        && said.target_follower_station_id == heard.target_follower_station_id
                        && said.task_type == heard.task_type
                }));
            }
        }
        ManeuverContainer::FollowerManeuverContainer(_) => {
            let (Some(Rmcm::Answer(answer)), Some(status)) = (views.next(), execution_of(rmcm))
            else {
                panic!("a follower says something else than an answer and how far it is");
            };
            let said = rmcm_of_answer(answer, status);
            assert!(said.is_some_and(|said| {
                said.rmcm.rmcm_parameters.maneuver_container == *heard
                    && said.header.station_id == rmcm.header.station_id
            }));
        }
    }
}

/// Every command has parameters; the command with these parameters has them too, and so on without
/// drifting. The antimeridian has two names on the wire, of which the first command tells one.
pub fn parameters_are_told_as_they_were_read(rmcm: &RMCM) {
    let Ok(views) = views_of_rmcm(rmcm) else {
        return;
    };
    for view in views.iter() {
        if let Rmcm::Command(command) = view {
            let told = retold_command(rmcm, command);
            assert!(told.is_some());
            if let Some(told) = told {
                assert!(retold_command(&told, command) == Some(told));
            }
        }
    }
}

/// A command alone, with the parameters that it has in a message.
fn retold_command(rmcm: &RMCM, command: &Command) -> Option<RMCM> {
    let parameters = task_parameters_of(rmcm, command.to)?;
    rmcm_of(&[(*command, parameters)])
}

fn rmcm_of(commands: &[(Command, TaskParameters)]) -> Option<RMCM> {
    let (identifiers, position) = (Identifiers::default(), Position::default());
    rmcm_from_commands(&identifiers, &position, commands, 0).ok()
}

fn rmcm_of_answer(answer: &Answer, status: ExecutionStatus) -> Option<RMCM> {
    let (identifiers, position) = (Identifiers::default(), Position::default());
    rmcm_from_answer(&identifiers, &position, answer, status, 0).ok()
}

/// The first command of a leader.
fn the_command(rmcm: &RMCM) -> Option<&ManeuverCommand> {
    match &rmcm.rmcm.rmcm_parameters.maneuver_container {
        ManeuverContainer::LeaderManeuverContainer(container) => container.commands.first(),
        ManeuverContainer::FollowerManeuverContainer(_) => None,
    }
}
