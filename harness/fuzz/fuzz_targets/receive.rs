//! The whole receive path of an endpoint: packets, each with its length in front, to a robot that asks
//! for help. The ordinary tests do the same with a bounded number of packets.
#![no_main]

use crossguard_codec::{RobotState, Identifiers};
use crossguard_endpoint::{Endpoint, Moment, Stimulus};
use crossguard_protocol::{Config, Event, HelpRequest, Place, Robot, StationId, TaskSet, Urgency};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|octets: &[u8]| {
    let robot = Robot::new(StationId(1), 1);
    let mut endpoint = Endpoint::new(robot, Config::default(), Identifiers::default(), 0);
    let state = RobotState::default();
    let mut now_ms = 200;
    let mut handle = |stimulus: Stimulus<'_>| {
        now_ms += 7;
        let moment = Moment {
            now_ms,
            timestamp_its: 694_694_401_000 + now_ms,
        };
        let _ = endpoint.handle(moment, &state, stimulus);
    };
    handle(Stimulus::Event(Event::PedestrianDetected(HelpRequest {
        urgency: Urgency::High,
        followers: 1,
        tasks: TaskSet(1),
        place: Place(7),
    })));
    let mut rest = octets;
    while let Some((length, behind)) = rest.split_first_chunk::<2>() {
        let length = usize::from(u16::from_be_bytes(*length)).min(behind.len());
        let (packet, behind) = behind.split_at(length);
        handle(Stimulus::Datagram {
            packet,
            // Later than any moment here: nothing has waited.
            arrived_ms: u64::MAX,
        });
        rest = behind;
    }
});
