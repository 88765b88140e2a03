//! Hazard: split brain. A lost request makes two leaders at one crossing, each with an open corridor, and both
//! stay. The one behind yields: it stops at once, keeps its guards until its road is clear, and ends.

use crossguard_protocol::*;

use crate::script::*;

fn at(place: Place, urgency: Urgency) -> HelpRequest {
    HelpRequest {
        place,
        urgency,
        ..escort(1)
    }
}

/// `ARI` with `GO2` and `SPOT` with `NAO`, parted, each with an open corridor.
fn two_teams(first: HelpRequest, second: HelpRequest) -> Street {
    let mut street = Street::new(&[ARI, GO2, SPOT, NAO]);
    for a in [ARI, GO2] {
        for b in [SPOT, NAO] {
            street.part(a, b);
        }
    }
    street.tell(ARI, Event::PedestrianDetected(first));
    street.tell(SPOT, Event::PedestrianDetected(second));
    street.pass(400);
    for (leader, guard) in [(ARI, GO2), (SPOT, NAO)] {
        street.tell(leader, order(guard, TaskType::MOVE));
        assert_eq!(street.tell(leader, Event::OpenCorridor).ignored(), None);
    }
    street.pass(1_000);
    assert!(street.shows_go(ARI) && street.shows_go(SPOT));
    street.forget();
    street.heal();
    street
}

const MEDIUM: Urgency = Urgency::Medium;

#[test]
fn the_one_behind_stops_at_once_keeps_its_guards_and_ends() {
    let mut street = two_teams(at(CROSSING, MEDIUM), at(CROSSING, MEDIUM));
    let session = street.session_of(SPOT);
    street.pass(200);
    assert!(street.shows_go(ARI) && !street.shows_go(SPOT));
    assert!(street.was_told(SPOT, Notice::Yielded(ARI)));
    assert!(street.has_put_out(SPOT, Output::CorridorClosed(CorridorClosure::Yielded(ARI))));
    assert_eq!(street.leading(SPOT).yields_to, Some(ARI));

    // People on the road stay guarded, and nobody follows them.
    street.pass(5_000);
    assert_eq!(street[NAO].state(), State::ManeuverExecuting);
    assert_eq!(street.count(NAO, falls_back) + street.count(NAO, stops), 0);
    let again = street.tell(SPOT, Event::OpenCorridor);
    assert_ignored(&again, Ignored::Yielding);

    street.tell(SPOT, Event::RoadClear);
    assert!(street.was_told(
        SPOT,
        Notice::SessionEnded(session, EndReason::Withdrawn(ARI))
    ));
    assert_eq!(street.roles([SPOT, NAO]), [Role::None, Role::None]);
    assert_eq!(street[SPOT].duty(), None, "its road is clear");
    assert_eq!(street.corridor(ARI), Corridor::Open);
    assert_eq!(street.count(ARI, closes), 0);
}

#[test]
fn urgency_goes_before_the_station_id() {
    let mut street = two_teams(at(CROSSING, MEDIUM), at(CROSSING, Urgency::High));
    street.pass(200);
    assert!(!street.shows_go(ARI) && street.shows_go(SPOT));
}

#[test]
fn leaders_at_different_places_do_not_disturb_each_other() {
    let mut street = two_teams(at(Place(7), MEDIUM), at(Place(8), MEDIUM));
    street.pass(5_000);
    assert!(street.shows_go(ARI) && street.shows_go(SPOT));
    let elsewhere = street[ARI].ram();
    assert_ignored(&street.hears_ram(SPOT, elsewhere), Ignored::OtherPlace);
}

#[test]
fn an_unknown_place_may_be_any_place() {
    for (first, second) in [(Place(7), Place::UNKNOWN), (Place::UNKNOWN, Place(7))] {
        let mut street = two_teams(at(first, MEDIUM), at(second, MEDIUM));
        street.pass(200);
        assert!(street.shows_go(ARI) && !street.shows_go(SPOT));
    }
}

#[test]
fn a_late_message_of_a_leader_that_is_gone_closes_no_corridor() {
    let mut street = two_teams(at(CROSSING, MEDIUM), at(CROSSING, MEDIUM));
    let late = street[ARI].ram();
    street.remove(ARI);
    for _ in 0..5 {
        street.hears_ram(SPOT, late);
    }
    assert_eq!(street.corridor(SPOT), Corridor::Open);
}

#[test]
fn a_leader_with_a_clear_road_ends_at_once() {
    let mut street = two_teams(at(CROSSING, MEDIUM), at(CROSSING, MEDIUM));
    street.tell(SPOT, Event::CloseCorridor);
    street.tell(SPOT, Event::RoadClear);
    street.pass(200);
    assert_eq!(street[SPOT].role(), Role::None);
    let (number, ending) = match street[SPOT].farewell() {
        Some(Farewell::Ended(number, ending)) => (number, ending),
        other => panic!("{other:?}"),
    };
    assert_eq!((number.0.boot, ending), (1, Ending::Aborted));
    // Its escort was under way: it brings its person to the kerb.
    assert_eq!(street.count(NAO, falls_back), 1);
}

#[test]
fn a_leader_that_yields_tells_so_and_moves_nobody() {
    let mut street = two_teams(at(CROSSING, MEDIUM), at(CROSSING, MEDIUM));
    street.pass(200);
    let yielding = street[SPOT].ram();
    let Coordination::Leader { yields, .. } = yielding.coordination else {
        panic!("{yielding}")
    };
    assert!(yields);
    let mut other = Street::new(&[PEPPER]);
    other.tell(PEPPER, Event::PedestrianDetected(escort(1)));
    assert_ignored(&other.hears_ram(PEPPER, yielding), Ignored::Yielding);
}

#[test]
fn a_requester_withdraws_for_a_leader_whatever_its_urgency() {
    let mut street = Street::with_roles(&[SPOT, NAO]);
    let mut late = Street::new(&[ARI]);
    late.tell(
        ARI,
        Event::PedestrianDetected(at(CROSSING, Urgency::Emergency)),
    );
    late.hears_ram(ARI, street[SPOT].ram());
    assert_eq!(late[ARI].role(), Role::Requester, "heard once");
    street.pass(100);
    late.hears_ram(ARI, street[SPOT].ram());
    assert_eq!(late[ARI].role(), Role::None);
}

/// Two that do not hear each other, and so do not settle it, are heard in turns by a third.
#[test]
fn two_that_go_before_do_not_hide_each_other() {
    let mut street = Street::new(&[ARI, GO2, SPOT]);
    for (a, b) in [(ARI, GO2), (ARI, SPOT), (GO2, SPOT)] {
        street.part(a, b);
    }
    for requester in [ARI, GO2, SPOT] {
        street.tell(requester, Event::PedestrianDetected(at(CROSSING, MEDIUM)));
    }
    street.pass(400);
    assert_eq!(street[SPOT].role(), Role::Requester);
    street.heal();
    street.part(ARI, GO2);
    street.pass(400);
    let withdrew = |output: &Output| {
        matches!(
            output,
            Output::Notify(Notice::SessionEnded(_, EndReason::Withdrawn(_)))
        )
    };
    assert_eq!(street.count(SPOT, withdrew), 1);
    assert_eq!(street.count(ARI, withdrew) + street.count(GO2, withdrew), 0);
}
