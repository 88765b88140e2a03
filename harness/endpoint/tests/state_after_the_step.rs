//! The RAM that a step sends says how the robot is after the step, not before it: a receiver must not take a
//! robot that has just been stopped for one that drives itself, until the next RAM comes.

use crossguard_codec::core::ram::{HelpStatus, RAM};
use crossguard_codec::{ControlMode, Identifiers, Position, RobotState, Service, decode, state_of};
use crossguard_endpoint::{Endpoint, Stimulus};
use crossguard_protocol::{Availability, Event, Place, StationId, TaskType, Unavailability};

use crate::support::{endpoint, moment, sent};

const DETECTED: Event = crate::support::detected(TaskType::MOVE, Place(7));

/// The RAM that are sent when this happens.
fn rams(endpoint: &mut Endpoint, now_ms: u64, event: Event) -> Vec<RAM> {
    let state = RobotState {
        position: Position::at(48.7, 9.1),
        control_mode: ControlMode::Autonomous,
        ..RobotState::default()
    };
    let effects = endpoint.handle(moment(now_ms), &state, Stimulus::Event(event));
    let sent = sent(&effects, Some(Service::Ram)).into_iter();
    let read = sent.map(|(_, octets)| decode::<RAM>(&Identifiers::default(), octets).unwrap());
    read.map(|ram| ram.message).collect()
}

/// The control modes in the RAM that are sent when this happens.
fn modes(endpoint: &mut Endpoint, now_ms: u64, event: Event) -> Vec<ControlMode> {
    let rams = rams(endpoint, now_ms, event);
    rams.iter().map(|ram| state_of(ram).control_mode).collect()
}

#[test]
fn the_ram_of_a_step_has_the_help_status_after_the_step() {
    let mut endpoint = endpoint(StationId(1));
    let mut said = |now_ms, event| {
        let rams = rams(&mut endpoint, now_ms, event);
        let status = |ram: &RAM| ram.ram.ram_parameters.robot_status_container.help_status;
        rams.iter().map(status).collect::<Vec<_>>()
    };
    let asked = said(10, DETECTED);
    assert_eq!(asked.last(), Some(&HelpStatus::NeedHelp), "{asked:?}");
    assert_eq!(said(20, Event::LeaveRequested), [HelpStatus::None]);
}

#[test]
fn a_robot_that_becomes_unavailable_says_at_once_who_steers_it() {
    let mut endpoint = endpoint(StationId(1));
    let first = modes(&mut endpoint, 10, DETECTED);
    assert_eq!(first.last(), Some(&ControlMode::Autonomous));
    let stop = Availability::Unavailable(Unavailability::EmergencyStop);
    let stopped = modes(&mut endpoint, 20, Event::AvailabilityChanged(stop));
    assert!(!stopped.is_empty(), "it ends its session at once");
    assert!(
        stopped
            .iter()
            .all(|mode| *mode == ControlMode::EmergencyStop),
        "{stopped:?}"
    );
    // The application's word counts again as soon as it is available.
    let back = Event::AvailabilityChanged(Availability::Available);
    modes(&mut endpoint, 30, back);
    let again = modes(&mut endpoint, 2_000, DETECTED);
    assert_eq!(again.last(), Some(&ControlMode::Autonomous), "{again:?}");
}
