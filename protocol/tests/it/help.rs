//! Request and offer: reservation, selection, time limits.

use crossguard_protocol::*;

use crate::script::*;

fn offer_from(station: StationId, session: SessionId, tasks: &[TaskType]) -> Ram {
    offer(station, session, FIRST_OFFER, tasks, 0)
}

fn confirmed(street: &Street) -> Vec<StationId> {
    street
        .leading(ARI)
        .members
        .iter()
        .map(|member| member.station)
        .collect()
}

/// `ARI` has asked for `followers` robots and heard these offers, in this order.
fn select_among(followers: u8, offers: &[(StationId, &[TaskType], u16)]) -> Vec<StationId> {
    let mut street = Street::asking(&[ARI], followers);
    let session = street.session_of(ARI);
    for &(station, tasks, distance) in offers {
        let ram = offer_from(station, session, tasks);
        street.step(
            ARI,
            Input::Ram {
                ram,
                distance: Decimetres(distance),
            },
        );
    }
    street.pass(300);
    confirmed(&street)
}

const BOTH: &[TaskType] = &[TaskType::INITIAL_POS, TaskType::MOVE];

#[test]
fn an_idle_robot_offers_to_one_requester_and_stays_with_it() {
    let mut street = Street::new(&[ARI, GO2, SPOT]);
    street.part(ARI, SPOT);
    street.tell(ARI, Event::PedestrianDetected(escort(1)));
    assert_eq!(street.session_of(GO2), street.session_of(ARI));
    street.tell(SPOT, Event::PedestrianDetected(escort(1)));
    assert_eq!(
        street.session_of(GO2),
        street.session_of(ARI),
        "reserved for the first"
    );
    let again = street[ARI].ram();
    assert_ignored(&street.hears_ram(GO2, again), Ignored::OldHeartbeat);
    let other = street[SPOT].ram();
    assert_ignored(&street.hears_ram(GO2, other), Ignored::InSession);
}

#[test]
fn the_reservation_ends_after_t_offer() {
    let mut street = Street::new(&[ARI, GO2]);
    street.cut(GO2, ARI);
    street.tell(ARI, Event::PedestrianDetected(escort(1)));
    let session = street.session_of(ARI);
    street.part(ARI, GO2);
    street.pass(2_999);
    assert_eq!(street[GO2].role(), Role::Helper);
    street.pass(1);
    assert_eq!(street[GO2].role(), Role::None);
    assert!(street.was_told(
        GO2,
        Notice::Released(session, ReleaseReason::ReservationExpired)
    ));
    assert_eq!(
        street[GO2].farewell(),
        None,
        "an offer that ran out is not a session that it left"
    );
}

#[test]
fn too_few_offers_do_not_make_a_team() {
    let mut street = Street::asking(&[ARI, GO2], 2);
    street.pass(9_000);
    assert_eq!(street[ARI].role(), Role::Requester);
    street.pass(1_000);
    assert_eq!(street.roles([ARI, GO2]), [Role::None, Role::None]);
}

#[test]
fn the_requester_gathers_offers_before_it_selects() {
    let mut street = Street::asking(&[ARI, GO2], 1);
    street.pass(299);
    assert_eq!(street[ARI].role(), Role::Requester);
    street.pass(1);
    assert_eq!(street[ARI].role(), Role::Leader);
    assert!(street.was_told(ARI, Notice::RolesEstablished(street.session_of(ARI))));
}

#[test]
fn an_offer_that_comes_when_too_few_were_there_is_taken_into_the_next_selection() {
    let mut street = Street::new(&[ARI, GO2, SPOT]);
    street.cut(ARI, SPOT);
    street.tell(ARI, Event::PedestrianDetected(escort(2)));
    street.pass(500);
    assert_eq!(street[ARI].role(), Role::Requester);
    street.heal();
    street.pass(400);
    assert_eq!(confirmed(&street), [GO2, SPOT]);
}

#[test]
fn capability_goes_before_distance_and_distance_before_station_id() {
    let one: &[TaskType] = &[TaskType::MOVE];
    assert_eq!(
        select_among(1, &[(GO2, one, 10), (SPOT, BOTH, 500)]),
        [SPOT]
    );
    assert_eq!(
        select_among(1, &[(GO2, BOTH, 50), (SPOT, BOTH, 40)]),
        [SPOT]
    );
    assert_eq!(select_among(1, &[(SPOT, BOTH, 40), (GO2, BOTH, 40)]), [GO2]);
    assert_eq!(
        select_among(2, &[(NAO, BOTH, 90), (GO2, one, 1), (SPOT, BOTH, 80)]),
        [SPOT, NAO],
        "as many as are required, best first"
    );
}

#[test]
fn the_order_in_which_offers_arrive_does_not_matter() {
    let offers = [
        (GO2, BOTH, 60),
        (SPOT, BOTH, 20),
        (NAO, BOTH, 40),
        (PEPPER, BOTH, 80),
    ];
    for rotation in 0..offers.len() {
        let mut offers = offers;
        offers.rotate_left(rotation);
        assert_eq!(select_among(2, &offers), [SPOT, NAO]);
    }
}

#[test]
fn a_better_offer_displaces_the_worst_of_a_full_list() {
    let many = [
        (GO2, BOTH, 60),
        (SPOT, BOTH, 70),
        (NAO, BOTH, 80),
        (PEPPER, BOTH, 90),
        (StationId(6), BOTH, 10),
    ];
    assert_eq!(select_among(4, &many), [StationId(6), GO2, SPOT, NAO]);
}

#[test]
fn a_helper_that_moved_is_ranked_by_its_new_distance() {
    let mut street = Street::asking(&[ARI], 1);
    let session = street.session_of(ARI);
    let hears = |street: &mut Street, station, echo, distance| {
        let ram = offer(station, session, FIRST_OFFER, BOTH, echo);
        let distance = Decimetres(distance);
        street.step(ARI, Input::Ram { ram, distance });
    };
    hears(&mut street, GO2, 0, 10);
    hears(&mut street, SPOT, 0, 20);
    street.pass(100);
    hears(&mut street, GO2, 1, 30);
    street.pass(200);
    assert_eq!(confirmed(&street), [SPOT]);
}

#[test]
fn a_helper_that_is_not_listed_becomes_free() {
    let mut street = Street::asking(&[ARI, GO2, SPOT], 1);
    assert_eq!(street.roles([GO2, SPOT]), [Role::Helper, Role::Helper]);
    let session = street.session_of(ARI);
    street.pass(300);
    assert_eq!(street.roles([GO2, SPOT]), [Role::Follower, Role::None]);
    assert!(street.was_told(SPOT, Notice::Released(session, ReleaseReason::NotListed)));
}

#[test]
fn a_leader_takes_no_more_offers() {
    let mut street = Street::with_roles(&[ARI, GO2]);
    let late = offer_from(SPOT, street.session_of(ARI), BOTH);
    let ignored = street.hears_ram(ARI, late).ignored();
    assert_eq!(ignored, Some(Ignored::RolesAlreadyAssigned));
}

#[test]
fn an_offer_to_somebody_else_is_not_taken() {
    let mut street = Street::asking(&[ARI], 1);
    let session = SessionId {
        leader: SPOT,
        ..street.session_of(ARI)
    };
    let outputs = street.hears_ram(ARI, offer_from(GO2, session, BOTH));
    assert_ignored(&outputs, Ignored::NotAddressed);
    street.pass(1_000);
    assert_eq!(street[ARI].role(), Role::Requester);
}

#[test]
fn a_repeated_offer_changes_nothing() {
    let mut street = Street::asking(&[ARI, GO2], 1);
    let offer = street[GO2].ram();
    assert_ignored(&street.hears_ram(ARI, offer), Ignored::OldHeartbeat);
}

#[test]
fn a_robot_that_can_do_nothing_of_what_is_asked_for_does_not_offer() {
    let capabilities = TaskSet::of(&[TaskType::BLOCK]);
    let settings = Settings {
        capabilities,
        ..Settings::default()
    };
    let mut street = Street::with_settings(&[GO2], settings);
    let ram = need_help(ARI, 0, 0, escort(1));
    assert_ignored(&street.hears_ram(GO2, ram), Ignored::UnsupportedTask);
    assert_eq!(street[GO2].role(), Role::None);
}

#[test]
fn an_offer_names_what_the_helper_can_do_of_what_is_asked_for() {
    let capabilities = TaskSet::of(&[TaskType::MOVE, TaskType::BLOCK]);
    let mut street = Street::with_settings(
        &[ARI, GO2],
        Settings {
            capabilities,
            ..Settings::default()
        },
    );
    street.tell(ARI, Event::PedestrianDetected(escort(1)));
    let Coordination::OfferHelp { capabilities, .. } = street[GO2].ram().coordination else {
        panic!("no offer")
    };
    assert_eq!(capabilities, TaskSet::of(&[TaskType::MOVE]));
}

#[test]
fn an_impossible_request_opens_no_session() {
    let mut street = Street::new(&[ARI]);
    for request in [
        escort(0),
        escort(17),
        HelpRequest {
            tasks: TaskSet::EMPTY,
            ..escort(1)
        },
    ] {
        let outputs = street.tell(ARI, Event::PedestrianDetected(request));
        assert_ignored(&outputs, Ignored::ImpossibleRequest);
    }
    assert_eq!(street[ARI].role(), Role::None);
}

#[test]
fn a_late_request_of_the_own_session_does_not_move_a_follower() {
    let mut street = Street::asking(&[ARI, GO2], 1);
    let need_help = street[ARI].ram();
    street.pass(400);
    assert_eq!(street[GO2].role(), Role::Follower);
    assert_ignored(&street.hears_ram(GO2, need_help), Ignored::NothingNew);
}

#[test]
fn an_offer_that_ran_out_before_the_confirmation_is_answered() {
    let mut street = Street::asking(&[ARI, GO2], 1);
    let session = street.session_of(ARI);
    street.part(ARI, GO2);
    street.pass(3_000);
    assert_eq!(street.roles([ARI, GO2]), [Role::Leader, Role::None]);
    street.heal();
    street.pass(100);
    assert_eq!(street[GO2].farewell(), Some(left(session)));
    assert_eq!(street[ARI].role(), Role::None, "its only follower is gone");
}

#[test]
fn a_helper_that_left_may_come_back_with_a_new_offer() {
    let mut street = Street::asking(&[ARI, GO2], 1);
    street.tell(GO2, Event::LeaveRequested);
    assert_eq!(
        street[GO2].farewell(),
        Some(Farewell::Left(street.session_of(ARI), FIRST_OFFER))
    );
    street.pass(100);
    assert_eq!(street[GO2].role(), Role::Helper);
    assert_eq!(
        street[GO2].farewell(),
        None,
        "it no longer says that it left"
    );
    street.pass(300);
    assert_eq!(street[GO2].role(), Role::Follower);
}

#[test]
fn while_it_asks_for_help_a_robot_repeats_its_ram() {
    let mut street = Street::asking(&[ARI], 1);
    street.forget();
    street.pass(1_000);
    assert_eq!(street.count(ARI, sends_ram), 10);
}
