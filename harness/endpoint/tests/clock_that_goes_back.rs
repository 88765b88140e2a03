//! A stack that keeps rule 1 of the integrator's guide badly: its clock goes back, as a wall clock does that is put.

use crossguard_endpoint::cause::Cause;
use crossguard_endpoint::{Effect, Endpoint, Stimulus};
use crossguard_protocol::{Event, ManeuverId, Output, Phase};

use crate::same_request::team_with_a_command;
use crate::support::{handle, hear, sent};

fn opens(effects: &[Effect]) -> bool {
    let opens = |it: &Effect| matches!(it, Effect::Act(Output::CorridorOpened(_), _));
    effects.iter().any(opens)
}

/// A leader whose guard is in position, and when.
fn leader_with_a_guard() -> (Endpoint, u64) {
    let ([mut leader, mut guard], command, mut now_ms) = team_with_a_command();
    let id = ManeuverId::of(command.session, command.request);
    let mut said = handle(&mut guard, now_ms, Stimulus::Event(Event::InPosition(id)));
    for _ in 0..10 {
        now_ms += 100;
        let mut heard = handle(&mut leader, now_ms, Stimulus::Time);
        for (packet, _) in sent(&said, None) {
            heard.extend(hear(&mut leader, now_ms, packet));
        }
        said = handle(&mut guard, now_ms, Stimulus::Time);
        for (packet, _) in sent(&heard, None) {
            said.extend(hear(&mut guard, now_ms, packet));
        }
    }
    (leader, now_ms)
}

/// Hazard: the guard is gone for ten minutes, its lease stands still with the clock, and go is shown by it.
#[test]
fn go_does_not_begin_while_the_clock_is_behind() {
    for (behind_ms, expected) in [(0, true), (1, false), (600_000, false)] {
        let (mut leader, now_ms) = leader_with_a_guard();
        let back_ms = now_ms.saturating_sub(behind_ms);
        let event = Stimulus::Event(Event::OpenCorridor);
        let effects = handle(&mut leader, back_ms, event);
        assert_eq!(opens(&effects), expected, "{behind_ms}: {effects:?}");
        let counted = leader.counters().of(Cause::ClockWentBack);
        assert_eq!(counted, u64::from(!expected), "{behind_ms}");
        // An end is told at any time.
        let event = Stimulus::Event(Event::LeaveRequested);
        handle(&mut leader, back_ms, event);
        let leads = matches!(leader.robot().phase(), Phase::Leading(_));
        assert!(!leads, "{behind_ms}");
    }
}
