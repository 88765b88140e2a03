//! Execution limit: a command that takes longer than `T_exec` counts as failed.

use crossguard_protocol::*;

use crate::script::*;

#[test]
fn a_command_fails_when_its_own_limit_is_reached() {
    for (task, limit) in [(TaskType::INITIAL_POS, 5_000), (TaskType::MOVE, 60_000)] {
        let mut street = Street::executing(task);
        let id = street.maneuver(GO2, 0);
        street.pass(limit - 1);
        assert_eq!(street[ARI].state(), State::ManeuverExecuting);
        street.pass(1);
        assert!(street.was_told(
            ARI,
            Notice::ManeuverFailed(GO2, id, Failure::ExecutionLimit)
        ));
        assert_eq!(street[ARI].state(), State::RoleEstablished);
        // What the follower says afterwards does not make it a success.
        street.forget();
        street.tell(GO2, Event::ManeuverCompleted(id));
        let completed = Notice::ManeuverCompleted(GO2, id);
        assert!(!street.has_put_out(ARI, Output::Notify(completed)));
    }
}

#[test]
fn the_limit_counts_from_the_acknowledgement_and_ends_with_the_maneuver() {
    let mut street = Street::executing(TaskType::INITIAL_POS);
    let id = street.maneuver(GO2, 0);
    street.pass(4_000);
    street.tell(GO2, Event::ManeuverCompleted(id));
    street.pass(10_000);
    assert_eq!(
        street.count(ARI, |o| matches!(
            o,
            Output::Notify(Notice::ManeuverFailed(..))
        )),
        0
    );
}

#[test]
fn the_limit_also_covers_a_command_that_is_acknowledged_and_never_reported() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    street.part(ARI, GO2);
    street.tell(ARI, order(GO2, TaskType::INITIAL_POS));
    let session = street.session_of(ARI);
    let (request, verdict) = (RequestId(0), Verdict::Accepted);
    street.hears_rmcm(
        ARI,
        Rmcm::Answer(Answer {
            from: GO2,
            session,
            request,
            verdict,
        }),
    );
    assert_eq!(street[ARI].state(), State::ManeuverExecuting);
    street.pass(5_000);
    assert!(street.was_told(
        ARI,
        Notice::ManeuverFailed(GO2, street.maneuver(ARI, 0), Failure::ExecutionLimit)
    ));
}
