//! The paper's crossing from beginning to end, on a channel that loses nothing.

use crossguard_protocol::*;

use crate::script::*;

#[test]
fn two_robots_help_a_pedestrian_across() {
    let mut street = Street::new(&[ARI, GO2]);

    // Stage 2: need and offer.
    street.tell(ARI, Event::PedestrianDetected(escort(1)));
    assert_eq!(street[ARI].role(), Role::Requester);
    assert_eq!(street[GO2].role(), Role::Helper);
    assert_eq!(
        street.states([ARI, GO2]),
        [State::HelpRequested, State::HelpRequested]
    );

    // Stage 3: the leader confirms, the follower takes its role.
    street.pass(300);
    assert_eq!(street.roles([ARI, GO2]), [Role::Leader, Role::Follower]);
    assert!(street.leading(ARI).members.iter().all(Member::has_joined));
    assert_eq!(street[ARI].state(), State::RoleEstablished);

    // Stage 4: initialPos, then move.
    for (request, task) in [(0, TaskType::INITIAL_POS), (1, TaskType::MOVE)] {
        street.forget();
        street.tell(ARI, order(GO2, task));
        let id = street.maneuver(ARI, request);
        let started = street.outputs_of(GO2);
        let acknowledged = started.iter().position(sends_rmcm).unwrap();
        let start = started
            .iter()
            .position(|o| *o == Output::StartManeuver(Maneuver { id, task }));
        assert!(acknowledged < start.unwrap(), "acknowledged before started");
        assert!(street.was_told(ARI, Notice::CommandAcknowledged(GO2, id)));
        assert!(street.was_told(ARI, Notice::ManeuverReported(GO2, id)));

        street.pass(2_000);
        street.tell(GO2, Event::ManeuverCompleted(id));
        assert!(street.was_told(ARI, Notice::ManeuverCompleted(GO2, id)));
        assert_eq!(street[ARI].state(), State::RoleEstablished);
    }

    // Stage 5: the session ends and both are idle.
    let session = street.session_of(ARI);
    street.tell(ARI, Event::TaskCompleted);
    assert_eq!(street.states([ARI, GO2]), [State::Idle, State::Idle]);
    assert!(street.was_told(GO2, Notice::Released(session, ReleaseReason::TaskCompleted)));

    // The farewell passes, the identities are unlocked.
    street.pass(1_000);
    for who in [ARI, GO2] {
        assert_eq!(street[who].identity(), Identity::Unlocked);
        assert_eq!(
            street[who].next_due(),
            None,
            "an idle robot waits for nothing"
        );
    }
}

#[test]
fn a_second_crossing_is_a_session_of_its_own() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    let first = street.session_of(ARI);
    street.tell(ARI, Event::TaskCompleted);
    street.establish_roles(ARI, 1);
    assert_ne!(street.session_of(ARI), first);
    assert_eq!(street.session_of(GO2), street.session_of(ARI));
}

#[test]
fn roles_may_change_from_one_crossing_to_the_next() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    street.tell(ARI, Event::TaskCompleted);
    street.establish_roles(GO2, 1);
    assert_eq!(street.roles([GO2, ARI]), [Role::Leader, Role::Follower]);
}
