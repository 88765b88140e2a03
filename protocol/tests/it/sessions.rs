//! Sessions: a message of another session never changes a role, and only naming ends one.

use crossguard_protocol::*;

use crate::script::*;

/// A session of `leader` that is not the present one.
fn other_session(leader: StationId) -> SessionId {
    SessionId {
        leader,
        number: SessionNumber(UniqueNumber { boot: 0, count: 9 }),
    }
}

fn following_state(street: &Street) -> Following {
    street.following(GO2).clone()
}

#[test]
fn a_rebooted_leader_never_reuses_a_session_number() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    let before = street.session_of(ARI);
    street.reboot(ARI);
    street.cut(ARI, GO2);
    street.tell(ARI, Event::PedestrianDetected(escort(1)));
    let after = street.session_of(ARI);
    assert_ne!(after, before);
    assert!(after.number > before.number);
}

#[test]
fn no_offer_to_a_session_has_the_number_of_another_one() {
    let mut street = Street::new(&[ARI, GO2]);
    let mut seen = Vec::new();
    for _ in 0..3 {
        street.tell(ARI, Event::PedestrianDetected(escort(1)));
        let session = street.session_of(ARI);
        for _ in 0..2 {
            let offer = (session, street.offer_of(GO2));
            assert!(!seen.contains(&offer));
            seen.push(offer);
            street.tell(GO2, Event::LeaveRequested);
            street.pass(100);
        }
        street.tell(ARI, Event::TaskCompleted);
        street.pass(1_000);
    }
}

#[test]
fn a_leader_that_lists_nobody_in_another_session_moves_no_follower() {
    let mut street = Street::executing(TaskType::MOVE);
    let before = following_state(&street);
    let stale = leader(other_session(ARI), 500, Followers::EMPTY);
    assert_ignored(&street.hears_ram(GO2, stale), Ignored::NotAddressed);
    assert_eq!(following_state(&street), before);
}

#[test]
fn a_bare_none_releases_nobody() {
    let mut street = Street::executing(TaskType::MOVE);
    let bare = ram(ARI, Coordination::None);
    assert_ignored(&street.hears_ram(GO2, bare), Ignored::NothingNew);
    assert_eq!(street[GO2].state(), State::ManeuverExecuting);
    let bare = ram(GO2, Coordination::None);
    assert_ignored(&street.hears_ram(ARI, bare), Ignored::NothingNew);
    assert_eq!(street[ARI].state(), State::ManeuverExecuting);
}

#[test]
fn only_the_end_of_the_own_session_releases() {
    let mut street = Street::executing(TaskType::MOVE);
    let session = street.session_of(GO2);
    let ended = |station, number| farewell(station, Farewell::Ended(number, Ending::Completed));
    let of_another_number = ended(ARI, other_session(ARI).number);
    assert_ignored(
        &street.hears_ram(GO2, of_another_number),
        Ignored::OtherSession,
    );
    let of_another_leader = ended(SPOT, session.number);
    assert_ignored(
        &street.hears_ram(GO2, of_another_leader),
        Ignored::OtherSession,
    );
    assert_eq!(street[GO2].state(), State::ManeuverExecuting);

    let maneuver = street.executes(GO2);
    let outputs = street.hears_ram(GO2, ended(ARI, session.number));
    let stop = StopReason::Released(ReleaseReason::TaskCompleted);
    assert!(
        outputs
            .iter()
            .any(|o| *o == Output::StopManeuver(maneuver, stop))
    );
    assert_eq!(street[GO2].state(), State::Idle);
}

#[test]
fn the_end_frees_a_helper_that_was_not_confirmed_yet() {
    let mut street = Street::asking(&[ARI, GO2], 1);
    assert_eq!(street[GO2].role(), Role::Helper);
    street.tell(ARI, Event::LeaveRequested);
    assert_eq!(street[GO2].role(), Role::None);
}

#[test]
fn a_command_of_another_session_is_not_executed() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    for leader in [ARI, SPOT] {
        let before = following_state(&street);
        let command = Command {
            session: other_session(leader),
            to: GO2,
            request: RequestId(77),
            task: TaskType::MOVE,
        };
        let outputs = street.hears_rmcm(GO2, Rmcm::Command(command));
        assert_ignored(&outputs, Ignored::OtherSession);
        assert_eq!(following_state(&street), before);
    }
}

#[test]
fn an_answer_of_another_session_changes_nothing() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    street.cut(GO2, ARI);
    street.tell(ARI, order(GO2, TaskType::MOVE));
    let answer = |session| {
        Rmcm::Answer(Answer {
            from: GO2,
            session,
            request: RequestId(0),
            verdict: Verdict::Accepted,
        })
    };
    let other = street.hears_rmcm(ARI, answer(other_session(ARI)));
    assert_ignored(&other, Ignored::OtherSession);
    let foreign = street.hears_rmcm(ARI, answer(other_session(SPOT)));
    assert_ignored(&foreign, Ignored::NotAddressed);
    assert!(
        street
            .leading(ARI)
            .member(GO2)
            .unwrap()
            .outstanding
            .is_some()
    );
    let own = answer(street.session_of(ARI));
    assert_eq!(street.hears_rmcm(ARI, own).ignored(), None);
}

#[test]
fn a_robot_that_follows_in_a_session_that_is_over_is_told_so() {
    let mut street = Street::executing(TaskType::MOVE);
    let session = street.session_of(GO2);
    street.reboot(ARI);
    // The follower's next RAM names a session that the rebooted leader does not know.
    street.pass(100);
    assert_eq!(street[ARI].farewell(), Some(aborted(session)));
    assert_eq!(street[GO2].state(), State::Idle);
    // It stands for a while and is not started anew by every RAM.
    let stale = follower(GO2, session, 0);
    assert_ignored(&street.hears_ram(ARI, stale), Ignored::NothingNew);
}

#[test]
fn a_session_that_somebody_named_before_it_was_opened_is_not_named_as_over() {
    let mut street = Street::new(&[ARI, GO2]);
    let session = SessionId {
        leader: ARI,
        number: SessionNumber(street[ARI].next_number()),
    };
    street.hears_ram(ARI, offer_to(session));
    assert_eq!(street[ARI].farewell(), Some(aborted(session)));
    street.tell(ARI, Event::PedestrianDetected(escort(1)));
    assert_eq!(street.session_of(ARI), session);
    assert_eq!(street[ARI].farewell(), None);
    assert_eq!(street[GO2].role(), Role::Helper);
}

#[test]
fn a_robot_that_offers_to_a_session_that_is_over_is_told_so() {
    let mut street = Street::asking(&[ARI, GO2], 1);
    street.reboot(ARI);
    street.pass(100);
    assert_eq!(street[GO2].role(), Role::None);
}

#[test]
fn a_robot_that_claims_a_part_that_nobody_gave_it_does_not_end_the_session() {
    let mut street = Street::asking(&[ARI], 1);
    let session = street.session_of(ARI);
    let claim = follower(GO2, session, 0);
    assert_ignored(&street.hears_ram(ARI, claim), Ignored::NotAFollower);
    assert_eq!(street[ARI].role(), Role::Requester);
}

/// What `GO2` says when it has a part in an older session of `ARI`.
fn offer_to(session: SessionId) -> Ram {
    offer(GO2, session, FIRST_OFFER, &[TaskType::MOVE], 0)
}

#[test]
fn an_offer_to_an_older_session_is_not_taken_for_the_present_one() {
    for established in [false, true] {
        let mut street = Street::asking(&[ARI, SPOT], 1);
        if established {
            street.pass(400);
        }
        let before = street[ARI].phase().clone();
        street.hears_ram(ARI, offer_to(other_session(ARI)));
        assert_eq!(*street[ARI].phase(), before);
        let ended = Farewell::Ended(other_session(ARI).number, Ending::Aborted);
        assert_eq!(street[ARI].farewell(), Some(ended), "who offers is told");
    }
}

#[test]
fn a_helper_is_not_moved_by_another_session_of_the_same_leader() {
    let mut street = Street::asking(&[ARI, GO2], 1);
    street.part(ARI, GO2);
    let Coordination::OfferHelp { offer, .. } = street[GO2].ram().coordination else {
        panic!()
    };
    let before = street[GO2].phase().clone();
    let me = Confirmation {
        station: GO2,
        offer,
    };
    for followers in [Followers::EMPTY, [me].into_iter().collect()] {
        street.hears_ram(GO2, leader(other_session(ARI), 0, followers));
        assert_eq!(*street[GO2].phase(), before);
    }
    let (request, task) = (RequestId(0), TaskType::MOVE);
    let command = Command {
        session: other_session(ARI),
        to: GO2,
        request,
        task,
    };
    assert_ignored(
        &street.hears_rmcm(GO2, Rmcm::Command(command)),
        Ignored::OtherSession,
    );
    assert_eq!(
        street[GO2].farewell(),
        Some(Farewell::Left(other_session(ARI), offer)),
        "it said so when it was listed"
    );
    assert_eq!(*street[GO2].phase(), before);
}

#[test]
fn who_leaves_an_older_session_keeps_its_offer_to_the_present_one() {
    let mut street = Street::asking(&[ARI, GO2], 1);
    let left = farewell(GO2, Farewell::Left(other_session(ARI), FIRST_OFFER));
    assert_ignored(&street.hears_ram(ARI, left), Ignored::OtherSession);
    street.pass(300);
    assert_eq!(street[ARI].role(), Role::Leader);
}

#[test]
fn a_timer_that_is_not_armed_does_not_expire() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    for (who, timer) in [
        (ARI, Timer::Help),
        (ARI, Timer::Acknowledgement(GO2)),
        (ARI, Timer::Lost(GO2)),
        (GO2, Timer::Leave),
        (GO2, Timer::Farewell),
    ] {
        let outputs = street.step(who, Input::Expired(timer));
        assert_eq!(outputs.ignored(), Some(Ignored::TimerNotArmed), "{timer}");
    }
}

#[test]
fn a_rebooted_follower_is_not_drawn_back_by_a_late_confirmation() {
    let mut street = Street::asking(&[ARI, GO2], 1);
    let need_help = street[ARI].ram();
    street.pass(400);
    let confirmation = street[ARI].ram();
    let session = street.session_of(GO2);

    // GO2 loses its memory, then hears the old request and after it the old confirmation.
    street.reboot(GO2);
    street.part(ARI, GO2);
    street.hears_ram(GO2, need_help);
    assert_eq!(street[GO2].role(), Role::Helper);
    let outputs = street.hears_ram(GO2, confirmation);
    let released = Notice::Released(session, ReleaseReason::NotListed);
    assert!(outputs.notices().any(|notice| notice == released));
    assert_eq!(street[GO2].role(), Role::None);
    assert_eq!(street[GO2].farewell(), Some(left(session)));

    // The leader learns it.
    street.heal();
    street.pass(100);
    assert_eq!(street[ARI].role(), Role::None);
}

#[test]
fn a_rebooted_follower_that_is_still_listed_says_that_it_left() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    let session = street.session_of(ARI);
    street.reboot(GO2);
    street.pass(100);
    assert_eq!(street[GO2].farewell(), Some(left(session)));
    assert!(street.was_told(ARI, Notice::FollowerGone(GO2, GoneReason::Left)));
    assert!(street.was_told(ARI, Notice::SessionEnded(session, EndReason::NoFollowers)));
}

#[test]
fn a_robot_has_one_part_in_one_session_at_a_time() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    for who in [ARI, GO2] {
        let detected = street.tell(who, Event::PedestrianDetected(escort(1)));
        assert_ignored(&detected, Ignored::InSession);
        let urgent = HelpRequest {
            urgency: Urgency::Emergency,
            ..escort(1)
        };
        let other = need_help(SPOT, 9, 0, urgent);
        assert_ignored(&street.hears_ram(who, other), Ignored::InSession);
    }
}

#[test]
fn messages_with_the_own_station_id_are_ignored() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    for who in [ARI, GO2] {
        let own = street[who].ram();
        assert_ignored(&street.hears_ram(who, own), Ignored::OwnStation);
    }
    let session = street.session_of(ARI);
    let (request, task) = (RequestId(0), TaskType::MOVE);
    let command = Rmcm::Command(Command {
        session,
        to: GO2,
        request,
        task,
    });
    assert_ignored(&street.hears_rmcm(ARI, command), Ignored::OwnStation);
    let answer = Answer {
        from: ARI,
        session,
        request,
        verdict: Verdict::Accepted,
    };
    let outputs = street.hears_rmcm(ARI, Rmcm::Answer(answer));
    assert_ignored(&outputs, Ignored::OwnStation);
}

#[test]
fn a_boot_whose_numbers_are_used_up_opens_no_session_and_makes_no_offer() {
    let mut street = Street::new(&[ARI]);
    let need_help = |count| need_help(SPOT, count, 0, escort(1));
    for count in 0..u16::MAX {
        assert_eq!(street.hears_ram(ARI, need_help(count)).ignored(), None);
        street.tell(ARI, Event::LeaveRequested);
        street.forget();
    }
    let exhausted = Some(Ignored::NumbersExhausted);
    assert_eq!(street.hears_ram(ARI, need_help(0)).ignored(), exhausted);
    let detected = street.tell(ARI, Event::PedestrianDetected(escort(1)));
    assert_eq!(detected.ignored(), exhausted);
}
