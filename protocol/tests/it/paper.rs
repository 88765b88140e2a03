//! The hazards of the paper's wording, one script each: the protocol survives every one of them. The runs that
//! break the wording itself are in `model-check/doc/paper-literal.md`, under the same ids.

use crossguard_protocol::*;

use crate::script::*;

/// What `who` has sent as an RMCM since the script last asked.
fn rmcm_of(street: &mut Street, who: StationId) -> Rmcm {
    let sent = street
        .outputs_of(who)
        .into_iter()
        .find_map(|output| match output {
            Output::SendRmcm(rmcm) => Some(rmcm),
            _ => None,
        });
    sent.expect("an RMCM")
}

/// The progress of the newest acknowledged command of `ARI`'s only follower.
fn progress(street: &Street) -> Option<Progress> {
    street.leading(ARI).member(GO2)?.order?.progress
}

/// `GO2` obeys a command, its answer is late, and it falls back before the answer arrives. Its RAM arrive.
fn falls_back_before_its_answer_arrives() -> (Street, Rmcm) {
    let mut street = Street::with_roles(&[ARI, GO2]);
    street.cut(GO2, ARI);
    street.tell(ARI, order(GO2, TaskType::MOVE));
    let answer = rmcm_of(&mut street, GO2);
    street.cut(ARI, GO2);
    for _ in 0..20 {
        street.pass(100);
        let ram = street[GO2].ram();
        street.hears_ram(ARI, ram);
    }
    assert_eq!(street.count(GO2, falls_back), 1);
    (street, answer)
}

#[test]
fn p1_late_acknowledgement_after_fallback() {
    let (mut street, answer) = falls_back_before_its_answer_arrives();
    assert_ignored(&street.hears_rmcm(ARI, answer), Ignored::NotOutstanding);
    assert_eq!(progress(&street), Some(Progress::SafeIdle));
    assert!(street.tell(ARI, Event::OpenCorridor).ignored().is_some());
    street.heal();
    street.pass(2_000);
    assert_eq!(
        street.following(GO2).executing(),
        None,
        "nothing given up is resumed"
    );
}

#[test]
fn p2_completion_from_a_stale_ram() {
    let mut street = Street::executing(TaskType::INITIAL_POS);
    let first = street.maneuver(GO2, 0);
    street.tell(GO2, Event::ManeuverCompleted(first));
    let stale = street[GO2].ram();
    street.tell(ARI, order(GO2, TaskType::BLOCK));
    street.in_position(GO2);
    street.tell(ARI, Event::OpenCorridor);
    street.hears_ram(ARI, stale);
    assert_eq!(progress(&street), Some(Progress::InPosition));
    assert_eq!(street.corridor(ARI), Corridor::Open);
}

#[test]
fn p3_release_that_is_the_idle_default() {
    let mut street = Street::new(&[ARI, GO2]);
    let idle = street[ARI].ram();
    street.establish_roles(ARI, 1);
    street.tell(ARI, order(GO2, TaskType::MOVE));
    street.hears_ram(GO2, idle);
    assert_eq!(street[GO2].state(), State::ManeuverExecuting);
}

#[test]
fn p4_safety_timeout_that_aborts_a_long_move() {
    let mut street = Street::executing(TaskType::MOVE);
    street.pass(21_600);
    assert_eq!(
        street[GO2].state(),
        State::ManeuverExecuting,
        "as long as the paper's"
    );
    assert_eq!(street.count(GO2, falls_back), 0);
    assert_eq!(
        street.count(ARI, sends_rmcm),
        0,
        "nothing was commanded anew"
    );
}

#[test]
fn p5_two_requesters_that_wait_for_each_other() {
    let mut street = Street::new(&[ARI, GO2]);
    street.part(ARI, GO2);
    street.tell(ARI, Event::PedestrianDetected(escort(1)));
    street.tell(GO2, Event::PedestrianDetected(escort(1)));
    street.heal();
    street.pass(1_000);
    assert_eq!(street.roles([ARI, GO2]), [Role::Leader, Role::Follower]);
}

#[test]
fn p6_duplicated_command_that_is_executed_twice() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    street.tell(ARI, order(GO2, TaskType::MOVE));
    let started = street.count(GO2, starts);
    let command = rmcm_of(&mut street, ARI);
    street.hears_rmcm(GO2, command);
    assert_eq!((started, street.count(GO2, starts)), (1, 1));
    let completed = street.maneuver(GO2, 0);
    street.tell(GO2, Event::ManeuverCompleted(completed));
    street.hears_rmcm(GO2, command);
    assert_eq!(street.count(GO2, starts), 1, "nor when it is over");
}

#[test]
fn p7_two_leaders_of_one_follower() {
    let mut street = Street::new(&[ARI, GO2, NAO]);
    street.part(ARI, GO2);
    street.tell(ARI, Event::PedestrianDetected(escort(1)));
    street.tell(GO2, Event::PedestrianDetected(escort(1)));
    let offer = street[NAO].ram();
    assert_ignored(&street.hears_ram(GO2, offer), Ignored::NotAddressed);
    street.pass(1_000);
    assert_eq!(street.following(NAO).session, street.session_of(ARI));
    assert_eq!(street[GO2].role(), Role::Requester);
}

#[test]
fn p8_request_without_end() {
    let mut street = Street::asking(&[ARI], 1);
    let session = street.session_of(ARI);
    street.pass(9_999);
    assert_eq!(street[ARI].role(), Role::Requester);
    street.pass(1);
    assert_eq!(street[ARI].role(), Role::None);
    let aborted = Farewell::Ended(session.number, Ending::Aborted);
    assert_eq!(street[ARI].farewell(), Some(aborted));
    let ended = Notice::SessionEnded(session, EndReason::NoHelp);
    assert!(
        street.has_put_out(ARI, Output::Notify(ended)),
        "its application is told"
    );
}

#[test]
fn p9_offer_without_end() {
    let mut street = Street::asking(&[ARI, GO2], 1);
    street.remove(ARI);
    street.pass(3_000);
    assert_eq!(street[GO2].state(), State::Idle);
}

#[test]
fn p11_acknowledgement_of_an_earlier_association() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    street.tell(ARI, order(GO2, TaskType::MOVE));
    let answer = rmcm_of(&mut street, GO2);
    street.tell(GO2, Event::ManeuverCompleted(street.maneuver(GO2, 0)));
    street.tell(ARI, Event::TaskCompleted);
    street.establish_roles(ARI, 1);
    street.cut(ARI, GO2);
    street.tell(ARI, order(GO2, TaskType::MOVE));
    assert_ignored(&street.hears_rmcm(ARI, answer), Ignored::OtherSession);
    assert_eq!(progress(&street), None);
}

#[test]
fn p12_follower_that_broke_down_and_is_counted_on_for_ever() {
    let mut street = Street::open(&[ARI, GO2], TaskType::MOVE);
    street.remove(GO2);
    street.pass(1_900);
    assert_ne!(
        street.corridor(ARI),
        Corridor::Open,
        "the lease has run out"
    );
    street.pass(10_000);
    assert_eq!(street[ARI].state(), State::Idle);
}

#[test]
fn p13_follower_that_asks_a_lost_leader_for_leave() {
    let mut street = Street::executing(TaskType::MOVE);
    street.remove(ARI);
    street.pass(2_000);
    street.tell(GO2, Event::LeaveRequested);
    assert_eq!(street[GO2].state(), State::Idle, "nobody has to answer");
}

#[test]
fn p14_old_acknowledgement_of_a_reissued_command() {
    let (mut street, answer) = falls_back_before_its_answer_arrives();
    street.tell(ARI, order(GO2, TaskType::MOVE));
    assert_ignored(&street.hears_rmcm(ARI, answer), Ignored::NotOutstanding);
    assert_eq!(progress(&street), Some(Progress::SafeIdle));
    street.heal();
    street.pass(2_000);
    let reissued = street.maneuver(ARI, 1);
    let acknowledged = Notice::CommandAcknowledged(GO2, reissued);
    assert!(street.has_put_out(ARI, Output::Notify(acknowledged)));
    assert_eq!(
        street.executes(GO2).id,
        reissued,
        "under a number of its own"
    );
    assert_eq!(street.count(GO2, starts), 1);
}
