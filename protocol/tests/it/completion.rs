//! Completion is read from the follower's RAM, and a stale RAM completes nothing newer.

use crossguard_protocol::*;

use crate::script::*;

fn progress_known_to_ari(street: &Street) -> Option<Progress> {
    street
        .leading(ARI)
        .member(GO2)
        .unwrap()
        .order
        .unwrap()
        .progress
}

#[test]
fn a_stale_ram_does_not_undo_a_completion() {
    let mut street = Street::executing(TaskType::MOVE);
    let stale = street[GO2].ram();
    let id = street.maneuver(GO2, 0);
    street.tell(GO2, Event::ManeuverCompleted(id));
    assert_ignored(&street.hears_ram(ARI, stale), Ignored::NothingNew);
    assert_eq!(progress_known_to_ari(&street), Some(Progress::Completed));
}

#[test]
fn a_ram_of_another_session_completes_nothing() {
    let mut street = Street::executing(TaskType::MOVE);
    let id = street.maneuver(GO2, 0);
    street.tell(GO2, Event::ManeuverCompleted(id));
    let of_the_first = street[GO2].ram();
    street.tell(ARI, Event::TaskCompleted);
    street.establish_roles(ARI, 1);
    street.tell(ARI, order(GO2, TaskType::MOVE));
    street.hears_ram(ARI, of_the_first);
    assert_eq!(progress_known_to_ari(&street), Some(Progress::Executing));
}

#[test]
fn completion_waits_for_the_acknowledgement_of_its_own_command() {
    let mut street = Street::executing(TaskType::BLOCK);
    // The next command gets lost; the follower's RAM still speaks of the first.
    street.cut(ARI, GO2);
    street.tell(ARI, order(GO2, TaskType::MOVE));
    let first = street.maneuver(GO2, 0);
    street.tell(GO2, Event::ManeuverCompleted(first));
    assert!(street.was_told(ARI, Notice::ManeuverCompleted(GO2, first)));
    assert!(
        street
            .leading(ARI)
            .member(GO2)
            .unwrap()
            .outstanding
            .is_some()
    );
}

#[test]
fn a_ram_that_reports_the_outstanding_command_stands_for_its_lost_acknowledgement() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    street.cut(GO2, ARI);
    street.tell(ARI, order(GO2, TaskType::MOVE));
    let id = street.maneuver(GO2, 0);
    street.heal();
    street.forget();
    street.pass(100);
    let acknowledged = Output::Notify(Notice::CommandAcknowledged(GO2, id));
    let reported = Output::Notify(Notice::ManeuverReported(GO2, id));
    assert!(street.has_put_out(ARI, acknowledged) && street.has_put_out(ARI, reported));
    assert_eq!(street.leading(ARI).member(GO2).unwrap().outstanding, None);
    street.pass(1_000);
    assert_eq!(
        street.count(ARI, sends_rmcm),
        0,
        "nothing is left to repeat"
    );
}

#[test]
fn failure_is_reported_with_its_reason() {
    let mut street = Street::executing(TaskType::MOVE);
    let id = street.maneuver(GO2, 0);
    street.tell(GO2, Event::ManeuverFailed(id));
    assert!(street.was_told(ARI, Notice::ManeuverFailed(GO2, id, Failure::Maneuver)));
    assert_eq!(
        street.states([ARI, GO2]),
        [State::RoleEstablished, State::RoleEstablished]
    );
}

#[test]
fn only_the_running_maneuver_can_be_finished() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    let early = street.maneuver(GO2, 0);
    let outputs = street.tell(GO2, Event::ManeuverCompleted(early));
    assert_ignored(&outputs, Ignored::NotExecuting);
    street.tell(ARI, order(GO2, TaskType::INITIAL_POS));
    street.tell(ARI, order(GO2, TaskType::MOVE));
    for event in [
        Event::ManeuverCompleted(early),
        Event::ManeuverFailed(early),
    ] {
        assert_ignored(&street.tell(GO2, event), Ignored::NotExecuting);
    }
    let other_session = SessionId {
        leader: SPOT,
        ..street.session_of(GO2)
    };
    let elsewhere = ManeuverId {
        session: other_session,
        request: RequestId(1),
    };
    let outputs = street.tell(GO2, Event::ManeuverCompleted(elsewhere));
    assert_ignored(&outputs, Ignored::NotExecuting);
    let outputs = street.tell(ARI, Event::ManeuverCompleted(early));
    assert_eq!(
        outputs.ignored(),
        Some(Ignored::NotExecuting),
        "a leader executes nothing"
    );
    let current = street.maneuver(GO2, 1);
    assert_eq!(
        street
            .tell(GO2, Event::ManeuverCompleted(current))
            .ignored(),
        None
    );
    assert_eq!(
        street
            .tell(GO2, Event::ManeuverCompleted(current))
            .ignored(),
        Some(Ignored::NotExecuting),
        "finished once"
    );
}
