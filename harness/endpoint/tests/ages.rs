//! A message that has waited in the robot for longer than `delay_max` is dropped under its own cause (rule 4 of the
//! integrator's guide), after the robot was told of time.

use crossguard_endpoint::cause::Cause;
use crossguard_endpoint::{Effect, Stimulus};
use crossguard_protocol::{Config, StationId};

use crate::support::{endpoint, handle, sent};

const DELAY_MAX_MS: u64 = 50;

#[test]
fn a_message_that_waited_longer_than_delay_max_is_dropped_under_its_own_cause() {
    let delay_max = Config::default().settings().delay_max;
    assert_eq!(u64::from(delay_max.0), DELAY_MAX_MS);
    let of_another = handle(&mut endpoint(StationId(9)), 200, Stimulus::Time);
    let packet = sent(&of_another, None)[0].0;
    for (waited_ms, is_taken) in [(0, true), (DELAY_MAX_MS, true), (DELAY_MAX_MS + 1, false)] {
        let (mut endpoint, sent_ms) = (endpoint(StationId(1)), 1_000 - waited_ms);
        let datagram = Stimulus::Datagram {
            packet,
            arrived_ms: sent_ms,
        };
        let effects = handle(&mut endpoint, 1_000, datagram);
        assert!(matches!(effects[0], Effect::Stepped { .. }));
        let heard = |effect: &Effect| matches!(effect, Effect::Heard { arrived_ms, told_ms: 1_000, .. } if *arrived_ms == sent_ms);
        assert_eq!(effects.iter().any(heard), is_taken, "{waited_ms}");
        let dropped = effects.iter().filter_map(|effect| match effect {
            Effect::Dropped { cause, detail, .. } => Some((*cause, &**detail)),
            _ => None,
        });
        let expected = (Cause::WaitedTooLong, "for 51 ms; delay_max is 50 ms");
        let expected = (!is_taken).then_some(expected);
        assert!(dropped.eq(expected), "{waited_ms}");
        let counted = endpoint.counters().of(Cause::WaitedTooLong);
        assert_eq!(counted, u64::from(!is_taken), "{waited_ms}");
    }
}
