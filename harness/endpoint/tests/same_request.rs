//! A command that comes again with another target under its requestID is no repetition.

use crossguard_codec::geonet::{EgoPosition, Stack};
use crossguard_codec::{
    Identifiers, Position, Service, TaskParameters, encode, rmcm_from_commands,
};
use crossguard_endpoint::cause::Cause;
use crossguard_endpoint::{Effect, Endpoint, Stimulus};
use crossguard_protocol::{
    Command, Output, Phase, Place, RequestId, SessionId, StationId, TaskType,
};

use crate::support::{detected, endpoint, handle, hear, sent};

const LEADER: StationId = StationId(1);
const FOLLOWER: StationId = StationId(2);
const TASK: TaskType = TaskType::BLOCK;

fn at(speed: f64) -> TaskParameters {
    TaskParameters {
        maximum_speed: Some(speed),
        ..TaskParameters::default()
    }
}

fn packets(effects: &[Effect]) -> Vec<Vec<u8>> {
    let sent = sent(effects, None).into_iter();
    sent.map(|(packet, _)| packet.to_vec()).collect()
}

/// A leader and a follower that carries a command out, the command, and when that is.
pub(crate) fn team_with_a_command() -> ([Endpoint; 2], Command, u64) {
    let mut robots = [LEADER, FOLLOWER].map(endpoint);
    let mut on_air = vec![Vec::new(), Vec::new()];
    let detected = Stimulus::Event(detected(TASK, Place::UNKNOWN));
    on_air[0] = packets(&handle(&mut robots[0], 0, detected));
    for now_ms in (100..20_000).step_by(100) {
        let mut sent = vec![Vec::new(), Vec::new()];
        for (robot, other) in [(0, 1), (1, 0)] {
            for packet in &on_air[other] {
                sent[robot].extend(packets(&hear(&mut robots[robot], now_ms, packet)));
            }
            sent[robot].extend(packets(&handle(&mut robots[robot], now_ms, Stimulus::Time)));
        }
        if matches!(robots[0].robot().phase(), Phase::Leading(_)) {
            let command = Stimulus::Command {
                follower: FOLLOWER,
                task: TASK,
                parameters: at(1.0),
            };
            sent[0].extend(packets(&handle(&mut robots[0], now_ms, command)));
        }
        on_air = sent;
        if let Phase::Following(following) = robots[1].robot().phase()
            && let Some(job) = following.job
        {
            let (session, request) = (following.session, job.request);
            return (robots, command(session, request, TASK), now_ms);
        }
    }
    panic!("nothing was commanded");
}

fn command(session: SessionId, request: RequestId, task: TaskType) -> Command {
    let to = FOLLOWER;
    Command {
        session,
        to,
        request,
        task,
    }
}

/// Hazard: a guard stands at its first place, and its leader holds the acknowledgement for one of another place.
#[test]
fn point_7_another_target_under_the_same_request_id_is_refused() {
    let ([_, mut follower], known, now_ms) = team_with_a_command();
    let ids = Identifiers::default();
    let mut leader = Stack::of_robot(ids, LEADER);
    let mut say = |command: Command, parameters: TaskParameters| {
        let rmcm = rmcm_from_commands(&ids, &Position::default(), &[(command, parameters)], 0);
        let message = encode(&ids, &rmcm.unwrap()).unwrap();
        let packet = leader.packet(&EgoPosition::default(), Service::Rmcm, &message);
        let effects = hear(&mut follower, now_ms, &packet.unwrap());
        let starts = |effect: &Effect| matches!(effect, Effect::Act(Output::StartManeuver(_), _));
        let refused = Cause::Contradictory("another command under its requestID");
        let is_refused =
            |effect: &Effect| matches!(effect, Effect::Dropped { cause, .. } if *cause == refused);
        (
            sent(&effects, Some(Service::Rmcm)).len(),
            effects.iter().any(starts),
            effects.iter().any(is_refused),
        )
    };
    let running_down = TaskParameters {
        validity: Some(crossguard_protocol::Millis(5_000)),
        ..at(1.0)
    };
    let next = Command {
        request: known.request.next(),
        ..known
    };
    let other_task = Command {
        task: TaskType::MOVE,
        ..known
    };
    // Acknowledged again; refused; and a command that may differ.
    assert_eq!(say(known, at(1.0)), (1, false, false));
    assert_eq!(say(known, running_down), (1, false, false));
    assert_eq!(say(known, at(0.5)), (0, false, true));
    assert_eq!(say(other_task, at(1.0)), (0, false, true));
    assert_eq!(say(next, at(0.5)), (1, true, false));
    assert_eq!(say(next, at(1.0)), (0, false, true));
}
