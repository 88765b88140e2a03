//! Endpoints of a test in virtual time, and what stations say to them.

use crossguard_codec::geonet::{EgoPosition, Stack};
use crossguard_codec::{Identifiers, RobotState, Service, encode, ram_from};
use crossguard_endpoint::{Effect, Endpoint, Moment, Stimulus};
use crossguard_protocol::{
    Availability, Config, Coordination, Event, HelpRequest, Place, Ram, Robot, StationId, TaskSet,
    TaskType, Urgency,
};

pub(crate) fn endpoint(station: StationId) -> Endpoint {
    let robot = Robot::new(station, 1);
    Endpoint::new(robot, Config::default(), Identifiers::default(), 0)
}

/// A moment of 2026-01-05.
pub(crate) const fn moment(now_ms: u64) -> Moment {
    Moment::after(694_694_401_000, now_ms)
}

/// Effects of a stimulus.
pub(crate) fn handle(endpoint: &mut Endpoint, now_ms: u64, stimulus: Stimulus<'_>) -> Vec<Effect> {
    endpoint.handle(moment(now_ms), &RobotState::default(), stimulus)
}

/// Effects of a packet.
pub(crate) fn hear(endpoint: &mut Endpoint, now_ms: u64, packet: &[u8]) -> Vec<Effect> {
    let arrived_ms = now_ms;
    handle(endpoint, now_ms, Stimulus::Datagram { packet, arrived_ms })
}

/// The packets and messages that are sent of this kind, or of any.
pub(crate) fn sent(effects: &[Effect], of: Option<Service>) -> Vec<(&[u8], &[u8])> {
    let sent = effects.iter().filter_map(|effect| match effect {
        Effect::Transmit {
            kind,
            packet,
            octets,
            ..
        } if of.is_none_or(|of| of == *kind) => Some((&packet[..], &octets[..])),
        _ => None,
    });
    sent.collect()
}

/// The packet of a station's RAM.
pub(crate) fn ram(stack: &mut Stack, station: StationId, coordination: Coordination) -> Vec<u8> {
    let ram = Ram {
        station,
        coordination,
        farewell: None,
        on_duty: false,
    };
    let (ids, state) = (Identifiers::default(), RobotState::default());
    let ram = ram_from(&ids, &state, &ram, Availability::Available, 0, false).unwrap();
    let message = encode(&ids, &ram).unwrap();
    let ego = EgoPosition::default();
    stack.packet(&ego, Service::Ram, &message).unwrap()
}

/// A pedestrian who needs one follower for this task.
pub(crate) const fn detected(task: TaskType, place: Place) -> Event {
    Event::PedestrianDetected(HelpRequest {
        urgency: Urgency::Medium,
        followers: 1,
        tasks: TaskSet::of(&[task]),
        place,
    })
}
