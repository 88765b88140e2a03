//! The corridor is open only while every required follower is engaged.

use crossguard_protocol::*;

use crate::script::*;

fn refusal(street: &mut Street) -> Option<Ignored> {
    street.tell(ARI, Event::OpenCorridor).ignored()
}

/// `GO2` escorts, the corridor is open.
fn open() -> Street {
    let mut street = Street::executing(TaskType::MOVE);
    assert_eq!(refusal(&mut street), None);
    assert_eq!(street.corridor(ARI), Corridor::Open);
    street.forget();
    street
}

fn assert_closed(street: &Street, why: CorridorClosure) {
    assert!(
        street.has_put_out(ARI, Output::CorridorClosed(why)),
        "{why:?}"
    );
    assert_eq!(
        street.count(ARI, |o| matches!(o, Output::CorridorClosed(_))),
        1
    );
}

fn not_engaged(why: Disengagement) -> CorridorClosure {
    CorridorClosure::NotEngaged(GO2, why)
}

#[test]
fn it_opens_when_the_follower_is_engaged_and_says_why_not_before() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    let not = |why| Some(Ignored::NotEngaged(GO2, why));
    assert_eq!(refusal(&mut street), not(Disengagement::NotExecuting));

    // Commanded, not acknowledged.
    street.cut(GO2, ARI);
    street.tell(ARI, order(GO2, TaskType::MOVE));
    assert_eq!(refusal(&mut street), not(Disengagement::CommandOutstanding));

    // Acknowledged, not reported.
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
    assert_eq!(refusal(&mut street), not(Disengagement::NotExecuting));

    // Reported, and the lease stands.
    street.heal();
    street.pass(100);
    assert_eq!(refusal(&mut street), None);
    assert_eq!(street.count(ARI, opens), 1);
    assert_eq!(refusal(&mut street), Some(Ignored::CorridorOpen));
}

#[test]
fn a_task_that_guards_nobody_does_not_hold_it() {
    let mut street = Street::executing(TaskType::INITIAL_POS);
    assert_eq!(
        refusal(&mut street),
        Some(Ignored::NotEngaged(GO2, Disengagement::NotGuarding))
    );
}

#[test]
fn it_closes_when_the_lease_runs_out() {
    let mut street = open();
    street.part(ARI, GO2);
    street.pass(1_900);
    assert_closed(&street, not_engaged(Disengagement::NoLease));
    assert_eq!(
        refusal(&mut street),
        Some(Ignored::NotEngaged(GO2, Disengagement::NoLease))
    );
    // It does not open again by itself when the lease is back.
    street.heal();
    street.pass(50);
    assert_eq!(street.corridor(ARI), Corridor::Clearing);
}

#[test]
fn it_closes_when_the_follower_is_done_or_fails_or_falls_back() {
    let mut street = open();
    let id = street.maneuver(GO2, 0);
    street.tell(GO2, Event::ManeuverCompleted(id));
    assert_closed(&street, not_engaged(Disengagement::Completed));

    let mut street = open();
    street.tell(GO2, Event::ManeuverFailed(id));
    assert_closed(
        &street,
        not_engaged(Disengagement::Failed(Failure::Maneuver)),
    );

    let mut street = open();
    let reason = Unavailability::EmergencyStop;
    street.tell(
        GO2,
        Event::AvailabilityChanged(Availability::Unavailable(reason)),
    );
    let failure = Failure::Unavailable(reason);
    assert_closed(&street, not_engaged(Disengagement::Failed(failure)));

    let mut street = open();
    let mut stale = street[GO2].ram();
    let Coordination::Follower { last, .. } = &mut stale.coordination else {
        unreachable!()
    };
    *last = Some(Report {
        request: RequestId(0),
        progress: Progress::SafeIdle,
    });
    street.hears_ram(ARI, stale);
    assert_closed(&street, not_engaged(Disengagement::SafeIdle));
}

#[test]
fn no_command_takes_a_guard_off_the_road() {
    let mut street = open();
    for _ in 0..2 {
        let outputs = street.tell(ARI, order(GO2, TaskType::INITIAL_POS));
        assert_ignored(&outputs, Ignored::RoadOccupied);
        street.tell(ARI, Event::CloseCorridor);
    }
    assert_eq!(street.executes(GO2).task, TaskType::MOVE);
    street.tell(ARI, Event::RoadClear);
    assert_eq!(street.corridor(ARI), Corridor::Clear);
    assert_eq!(
        street
            .tell(ARI, order(GO2, TaskType::INITIAL_POS))
            .ignored(),
        None
    );
}

#[test]
fn nor_does_one_that_its_execution_limit_has_been_reached() {
    let mut street = open();
    street.pass(60_000);
    assert_eq!(street[GO2].state(), State::ManeuverExecuting, "it goes on");
    let outputs = street.tell(ARI, order(GO2, TaskType::INITIAL_POS));
    assert_ignored(&outputs, Ignored::RoadOccupied);
}

#[test]
fn it_closes_when_the_follower_leaves_or_the_session_ends() {
    let mut street = open();
    street.tell(GO2, Event::LeaveRequested);
    assert_closed(&street, CorridorClosure::SessionEnded);

    for event in [
        Event::TaskCompleted,
        Event::LeaveRequested,
        Event::AvailabilityChanged(Availability::Unavailable(Unavailability::LocalFault)),
    ] {
        let mut street = open();
        street.tell(ARI, event);
        assert_closed(&street, CorridorClosure::SessionEnded);
    }
}

#[test]
fn it_closes_when_the_execution_limit_is_reached() {
    let mut street = open();
    street.pass(60_000);
    let failure = Failure::ExecutionLimit;
    assert_closed(&street, not_engaged(Disengagement::Failed(failure)));
}

#[test]
fn the_application_may_close_it_and_open_it_again() {
    let mut street = open();
    street.tell(ARI, Event::CloseCorridor);
    assert_closed(&street, CorridorClosure::Application);
    let again = street.tell(ARI, Event::CloseCorridor);
    assert_ignored(&again, Ignored::CorridorClosed);
    assert_eq!(refusal(&mut street), None);
}

#[test]
fn only_a_leader_has_one() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    for event in [Event::OpenCorridor, Event::CloseCorridor] {
        assert_ignored(&street.tell(GO2, event), Ignored::NotLeading);
    }
}

#[test]
fn every_required_follower_must_be_engaged() {
    let mut street = Street::with_roles(&[ARI, GO2, SPOT]);
    street.tell(ARI, order(GO2, TaskType::BLOCK));
    street.in_position(GO2);
    let not_executing = Disengagement::NotExecuting;
    assert_eq!(
        refusal(&mut street),
        Some(Ignored::NotEngaged(SPOT, not_executing))
    );
    street.tell(ARI, order(SPOT, TaskType::BLOCK));
    street.in_position(SPOT);
    assert_eq!(refusal(&mut street), None);
    street.forget();
    // One leaves: the other is still engaged, but one is not enough.
    street.tell(SPOT, Event::LeaveRequested);
    assert_closed(&street, CorridorClosure::FollowerMissing);
    assert_eq!(refusal(&mut street), Some(Ignored::FollowerMissing));
}
