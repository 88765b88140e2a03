//! Commands: acknowledged before they start, repeated, given up, rejected, superseded.

use crossguard_protocol::*;

use crate::script::*;

fn command(street: &Street, request: u8, task: TaskType) -> Rmcm {
    let session = street.session_of(ARI);
    Rmcm::Command(Command {
        session,
        to: GO2,
        request: RequestId(request),
        task,
    })
}

fn answer(street: &Street, request: u8, verdict: Verdict) -> Rmcm {
    let session = street.session_of(ARI);
    Rmcm::Answer(Answer {
        from: GO2,
        session,
        request: RequestId(request),
        verdict,
    })
}

#[test]
fn a_repeated_command_is_acknowledged_again_and_not_executed_again() {
    let mut street = Street::executing(TaskType::MOVE);
    let repeated = command(&street, 0, TaskType::MOVE);
    street.cut(GO2, ARI);
    for _ in 0..3 {
        let outputs = street.hears_rmcm(GO2, repeated);
        let acknowledgement = answer(&street, 0, Verdict::Accepted);
        assert!(outputs.iter().eq(&[Output::SendRmcm(acknowledgement)]));
    }
    // Not even when it has been finished meanwhile.
    let id = street.maneuver(GO2, 0);
    street.tell(GO2, Event::ManeuverCompleted(id));
    assert!(!street.hears_rmcm(GO2, repeated).iter().any(starts));
    assert_eq!(street[GO2].state(), State::RoleEstablished);
}

#[test]
fn an_older_command_changes_nothing() {
    let mut street = Street::executing(TaskType::INITIAL_POS);
    let older = command(&street, 0, TaskType::INITIAL_POS);
    street.tell(ARI, order(GO2, TaskType::MOVE));
    assert_eq!(street.executes(GO2).task, TaskType::MOVE);
    assert_ignored(&street.hears_rmcm(GO2, older), Ignored::OldCommand);
    assert_eq!(street.executes(GO2).task, TaskType::MOVE);
}

#[test]
fn a_newer_command_supersedes_the_one_that_runs() {
    let mut street = Street::executing(TaskType::BLOCK);
    let running = street.executes(GO2);
    street.tell(ARI, order(GO2, TaskType::MOVE));
    let id = street.maneuver(GO2, 1);
    let start = Output::StartManeuver(Maneuver {
        id,
        task: TaskType::MOVE,
    });
    let stop = Output::StopManeuver(running, StopReason::Superseded);
    let outputs = street.outputs_of(GO2);
    let of_interest: Vec<_> = outputs
        .into_iter()
        .filter(|o| sends_rmcm(o) || *o == stop || *o == start)
        .collect();
    let acknowledgement = Output::SendRmcm(answer(&street, 1, Verdict::Accepted));
    assert_eq!(of_interest, [acknowledgement, stop, start]);
}

#[test]
fn the_leader_repeats_the_same_command_and_then_gives_the_follower_up() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    street.part(ARI, GO2);
    street.tell(ARI, order(GO2, TaskType::MOVE));
    let first = command(&street, 0, TaskType::MOVE);
    let session = street.session_of(ARI);
    assert_eq!(street.outputs_of(ARI), [Output::SendRmcm(first)]);
    for repeat in 1..=3 {
        street.pass(599);
        assert_eq!(street.count(ARI, sends_rmcm), 0, "before repeat {repeat}");
        street.pass(1);
        assert!(
            street.has_put_out(ARI, Output::SendRmcm(first)),
            "repeat {repeat}"
        );
        street.forget();
    }
    street.pass(600);
    assert_eq!(street.count(ARI, sends_rmcm), 0);
    assert!(street.was_told(
        ARI,
        Notice::FollowerGone(GO2, GoneReason::NoAcknowledgement)
    ));
    assert!(street.was_told(ARI, Notice::SessionEnded(session, EndReason::NoFollowers)));
    assert_eq!(street[ARI].role(), Role::None);
}

#[test]
fn a_lost_acknowledgement_costs_one_repeat() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    street.cut(GO2, ARI);
    street.tell(ARI, order(GO2, TaskType::MOVE));
    assert_eq!(street[GO2].state(), State::ManeuverExecuting);
    assert_eq!(street[ARI].state(), State::RoleEstablished);
    street.pass(599);
    street.heal();
    street.forget();
    street.pass(1);
    assert_eq!(street[ARI].state(), State::ManeuverExecuting);
    assert_eq!(street.count(GO2, starts), 0);
}

#[test]
fn an_acknowledgement_that_is_not_the_outstanding_one_changes_nothing() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    street.cut(ARI, GO2);
    let nothing_outstanding = answer(&street, 0, Verdict::Accepted);
    let ignored = street.hears_rmcm(ARI, nothing_outstanding).ignored();
    assert_eq!(ignored, Some(Ignored::NotOutstanding));
    street.tell(ARI, order(GO2, TaskType::MOVE));
    let rejected = Verdict::Rejected(Rejection::UnsupportedTask);
    for wrong in [1, 127, 255] {
        for verdict in [Verdict::Accepted, rejected] {
            let ignored = street
                .hears_rmcm(ARI, answer(&street, wrong, verdict))
                .ignored();
            assert_eq!(ignored, Some(Ignored::NotOutstanding));
        }
    }
    let right = answer(&street, 0, Verdict::Accepted);
    assert_eq!(street.hears_rmcm(ARI, right).ignored(), None);
    assert_ignored(&street.hears_rmcm(ARI, right), Ignored::NotOutstanding);
}

#[test]
fn one_command_is_outstanding_per_follower() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    street.part(ARI, GO2);
    street.tell(ARI, order(GO2, TaskType::INITIAL_POS));
    let second = street.tell(ARI, order(GO2, TaskType::MOVE));
    assert_ignored(&second, Ignored::CommandOutstanding);
}

#[test]
fn a_command_of_somebody_who_is_not_the_leader_is_not_addressed() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    let Rmcm::Command(to_go2) = command(&street, 0, TaskType::MOVE) else {
        unreachable!()
    };
    let elsewhere = Rmcm::Command(Command { to: SPOT, ..to_go2 });
    assert_ignored(&street.hears_rmcm(GO2, elsewhere), Ignored::NotAddressed);
}

#[test]
fn a_task_that_the_follower_cannot_do_is_rejected() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    let unknown = TaskType::new(9).unwrap();
    street.tell(ARI, order(GO2, unknown));
    let id = street.maneuver(ARI, 0);
    assert!(street.was_told(
        ARI,
        Notice::CommandRejected(GO2, id, Rejection::UnsupportedTask)
    ));
    assert_eq!(street.count(GO2, starts), 0);
    assert_eq!(street[ARI].state(), State::RoleEstablished);
    // The next command has a number of its own.
    street.tell(ARI, order(GO2, TaskType::MOVE));
    assert_eq!(street.executes(GO2).id.request, RequestId(1));
}

#[test]
fn a_rejected_command_is_rejected_again_even_when_it_could_be_done_by_then() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    street.cut(ARI, GO2);
    street.cut(GO2, ARI);
    // Executing, so that unavailability does not make it leave.
    street.hears_rmcm(GO2, command(&street, 0, TaskType::BLOCK));
    let unavailable = Availability::Unavailable(Unavailability::Teleoperated);
    street.tell(GO2, Event::AvailabilityChanged(unavailable));
    let refused = command(&street, 1, TaskType::MOVE);
    street.hears_rmcm(GO2, refused);
    street.tell(GO2, Event::AvailabilityChanged(Availability::Available));
    let outputs = street.hears_rmcm(GO2, refused);
    let reason = Rejection::Unavailable(Unavailability::Teleoperated);
    let rejection = answer(&street, 1, Verdict::Rejected(reason));
    assert!(outputs.iter().eq(&[Output::SendRmcm(rejection)]));
    // A newer one is taken on, and the refused one is old from then on.
    assert!(
        street
            .hears_rmcm(GO2, command(&street, 2, TaskType::MOVE))
            .iter()
            .any(starts)
    );
    assert_ignored(&street.hears_rmcm(GO2, refused), Ignored::OldCommand);
}

#[test]
fn a_rejected_command_leaves_the_running_one_alone() {
    let mut street = Street::executing(TaskType::BLOCK);
    street.tell(ARI, order(GO2, TaskType::new(9).unwrap()));
    assert_eq!(street.executes(GO2).task, TaskType::BLOCK);
    assert_eq!(street[ARI].state(), State::ManeuverExecuting);
    let id = street.maneuver(GO2, 0);
    street.tell(GO2, Event::ManeuverCompleted(id));
    assert!(street.was_told(ARI, Notice::ManeuverCompleted(GO2, id)));
}

#[test]
fn a_command_overtakes_neither_the_confirmation_nor_the_role() {
    let mut street = Street::asking(&[ARI, GO2], 1);
    street.part(ARI, GO2);
    street.pass(300);
    // The leader has confirmed, but has not heard that the follower took its role.
    let early = street.tell(ARI, order(GO2, TaskType::MOVE));
    assert_ignored(&early, Ignored::NotJoined);
    // A command that arrives before the confirmation is not executed, and does not undo the offer.
    let outputs = street.hears_rmcm(GO2, command(&street, 0, TaskType::MOVE));
    assert_ignored(&outputs, Ignored::NotJoined);
    assert_eq!(street[GO2].role(), Role::Helper);
}

#[test]
fn only_a_leader_commands_and_only_its_followers() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    let by_follower = order(ARI, TaskType::MOVE);
    assert_ignored(&street.tell(GO2, by_follower), Ignored::NotLeading);
    let to_stranger = order(SPOT, TaskType::MOVE);
    assert_ignored(&street.tell(ARI, to_stranger), Ignored::NotAFollower);
    let stranger = Answer {
        from: SPOT,
        session: street.session_of(ARI),
        request: RequestId(0),
        verdict: Verdict::Accepted,
    };
    let ignored = street.hears_rmcm(ARI, Rmcm::Answer(stranger)).ignored();
    assert_eq!(ignored, Some(Ignored::NotAFollower));
    let ignored = street.hears_rmcm(GO2, Rmcm::Answer(stranger)).ignored();
    assert_eq!(ignored, Some(Ignored::NotAddressed));
}

#[test]
fn request_numbers_wrap_without_confusion() {
    let settings = Settings {
        first_request: RequestId(254),
        ..Settings::default()
    };
    let mut street = Street::with_roles_and_settings(&[ARI, GO2], settings);
    for expected in [254, 255, 0, 1] {
        street.tell(ARI, order(GO2, TaskType::BLOCK));
        assert_eq!(street.executes(GO2).id.request, RequestId(expected));
    }
    let older = street.hears_rmcm(GO2, command(&street, 255, TaskType::BLOCK));
    assert_ignored(&older, Ignored::OldCommand);
}

#[test]
fn a_session_is_renewed_before_half_the_request_numbers_are_used() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    let first = street.session_of(ARI);
    for request in 0..RequestId::MAX_PER_SESSION {
        street.tell(ARI, order(GO2, TaskType::BLOCK));
        assert_eq!(street.executes(GO2).id.request, RequestId(request));
        street.forget();
    }
    street.tell(ARI, order(GO2, TaskType::BLOCK));
    assert!(street.was_told(ARI, Notice::SessionEnded(first, EndReason::Renewed)));
    assert_eq!(street[ARI].role(), Role::Requester);
    assert_ne!(street.session_of(ARI), first);
    // Its guard holds until the road is clear; then it hears the need in the second session, and helps again.
    assert_eq!(street[GO2].role(), Role::None);
    street.tell(GO2, Event::RoadClear);
    street.pass(500);
    assert_eq!(street.roles([ARI, GO2]), [Role::Leader, Role::Follower]);
    street.tell(ARI, order(GO2, TaskType::BLOCK));
    assert_eq!(street.executes(GO2).id.request, RequestId(0));
}

#[test]
fn a_session_is_not_ended_for_one_that_cannot_be_opened() {
    let mut street = Street::new(&[ARI, GO2]);
    // All but one of the numbers of this boot.
    for _ in 0..u16::MAX - 1 {
        street.step(ARI, Input::Local(Event::PedestrianDetected(escort(1))));
        street.step(ARI, Input::Local(Event::TaskCompleted));
        street.forget();
    }
    street.pass(1_000);
    street.establish_roles(ARI, 1);
    for _ in 0..RequestId::MAX_PER_SESSION {
        street.tell(ARI, order(GO2, TaskType::BLOCK));
        street.forget();
    }
    let ignored = street.tell(ARI, order(GO2, TaskType::BLOCK)).ignored();
    assert_eq!(ignored, Some(Ignored::NumbersExhausted));
    assert_eq!(street[ARI].role(), Role::Leader);
}

#[test]
fn a_leap_of_half_the_request_numbers_is_not_newer_than_what_was_accepted() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    let unsupported = TaskType::new(9).unwrap();
    street.hears_rmcm(GO2, command(&street, 0, TaskType::MOVE));
    street.hears_rmcm(GO2, command(&street, 100, unsupported));
    // Newer than the refused 100, and not newer than the accepted 0.
    for task in [unsupported, TaskType::BLOCK] {
        let leap = street.hears_rmcm(GO2, command(&street, 200, task));
        assert_ignored(&leap, Ignored::OldCommand);
    }
}
