//! What has waited in the robot for longer than `delay_max` is thrown away, under its own cause (rule 4 of the
//! integrator's guide).

use crossguard_codec::{Identifiers, RobotState};
use crossguard_endpoint::cause::Cause;
use crossguard_endpoint::{Effect, Endpoint, Moment, Stimulus};
use crossguard_protocol::{Config, Robot, StationId};

const DELAY_MAX_MS: u64 = 50;

fn endpoint(station: u32) -> Endpoint {
    let robot = Robot::new(StationId(station), 1);
    Endpoint::new(robot, Config::default(), Identifiers::default(), 0)
}

fn handle(endpoint: &mut Endpoint, now_ms: u64, stimulus: Stimulus<'_>) -> Vec<Effect> {
    let timestamp_its = 694_694_401_000 + now_ms;
    let moment = Moment {
        now_ms,
        timestamp_its,
    };
    endpoint.handle(moment, &RobotState::default(), stimulus)
}

/// A RAM of another robot.
fn ram() -> Vec<u8> {
    let effects = handle(&mut endpoint(9), 200, Stimulus::Time);
    let mut packets = effects.into_iter().filter_map(|effect| match effect {
        Effect::Transmit { packet, .. } => Some(packet),
        _ => None,
    });
    packets.next().expect("it announces itself")
}

#[test]
fn a_message_that_waited_longer_than_delay_max_is_dropped_under_its_own_cause() {
    assert_eq!(
        u64::from(Config::default().settings().delay_max.0),
        DELAY_MAX_MS
    );
    let packet = ram();
    for (waited_ms, is_taken) in [(0, true), (DELAY_MAX_MS, true), (DELAY_MAX_MS + 1, false)] {
        let mut endpoint = endpoint(1);
        let datagram = Stimulus::Datagram {
            packet: &packet,
            arrived_ms: 1_000 - waited_ms,
        };
        let effects = handle(&mut endpoint, 1_000, datagram);
        let heard = |effect: &Effect| {
            matches!(effect, Effect::Heard { arrived_ms, told_ms: 1_000, .. }
                if *arrived_ms == 1_000 - waited_ms)
        };
        assert_eq!(effects.iter().any(heard), is_taken, "{waited_ms}");
        let dropped = effects.iter().filter_map(|effect| match effect {
            Effect::Dropped { cause, detail, .. } => Some((*cause, detail.clone())),
            _ => None,
        });
        let dropped: Vec<_> = dropped.collect();
        let counted = endpoint.counters().of(Cause::WaitedTooLong);
        assert_eq!(counted, u64::from(!is_taken), "{waited_ms}");
        if !is_taken {
            let detail = "for 51 ms; delay_max is 50 ms".to_owned();
            assert_eq!(dropped, [(Cause::WaitedTooLong, detail)]);
        }
    }
}

#[test]
fn a_message_that_waited_too_long_is_dropped_after_the_robot_was_told_of_time() {
    let (mut endpoint, packet) = (endpoint(1), ram());
    let datagram = Stimulus::Datagram {
        packet: &packet,
        arrived_ms: 500,
    };
    let effects = handle(&mut endpoint, 1_000, datagram);
    assert!(matches!(effects[0], Effect::Stepped { .. }));
    assert!(!effects.iter().any(|e| matches!(e, Effect::Heard { .. })));
}
