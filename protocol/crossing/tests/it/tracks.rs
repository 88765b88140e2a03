//! People who wait to cross, and people who do not, whatever happens to ids (hazards D and E).

use crossguard_crossing::tracks::*;
use crossguard_crossing::*;
use crossguard_protocol::{Event, HelpRequest, Millis, StationId, Urgency};

use crate::scene::*;

fn watch() -> Scene {
    Scene::new(street())
}

#[test]
fn a_person_who_stands_at_the_kerb_waits_after_the_dwell_time() {
    let mut scene = watch();
    let mut who = person(1, 100, -100);
    assert_eq!(scene.sees(&mut who, 900), None);
    assert_eq!(scene.conducts(), [Conduct::Passing]);
    assert_eq!(scene.sees(&mut who, 300), Some(Urgency::Medium));
    assert_eq!(scene.conducts(), [Conduct::Waiting]);
    // However restless.
    who = walking(who, 90, 0);
    assert_eq!(scene.sees(&mut who, 1_000), Some(Urgency::Medium));
    let middle = scene.crossing.tracks().middle().unwrap();
    assert!(middle.distance_cm(Point::new(180, -100)) < 20, "{middle:?}");
}

#[test]
fn a_person_who_sways_waits_as_well() {
    let mut scene = watch();
    let mut urgency = None;
    for step in 0..20 {
        let sway = if step % 2 == 0 { 10 } else { -10 };
        let mut who = walking(person(1, 100 + sway, -100), sway * 3, 0);
        urgency = scene.sees(&mut who, 100);
    }
    assert_eq!(urgency, Some(Urgency::Medium));
    // By places alone, 20 cm of error and what somebody who stands goes in the dwell.
    for (sway, waits) in [(70, true), (71, false)] {
        let mut scene = watch();
        for step in 0..20 {
            let who = person(1, 100 + step % 2 * sway, -100);
            let velocity = None;
            scene.look(100, &[Sighting { velocity, ..who }]);
        }
        assert_eq!(scene.crossing.tracks().is_waiting(), waits, "{sway} cm");
    }
}

#[test]
fn a_person_who_walks_up_to_the_road_is_noticed_before_the_kerb() {
    let mut scene = watch();
    let mut who = walking(person(1, 100, -240), 0, 120);
    assert_eq!(scene.sees(&mut who, 1_200), Some(Urgency::Medium));
    assert!(who.at.north_cm() < 0, "not on the road yet");
}

#[test]
fn a_passer_by_along_the_kerb_does_not_wait() {
    for (speed, tells_velocity) in [(140, true), (80, true), (140, false), (80, false)] {
        for interval in [100, 250, 500] {
            let mut scene = watch();
            let mut who = walking(person(1, -300, -60), speed, 0);
            let ms = 790_000 / u32::try_from(speed).unwrap();
            let told = scene.sees_at(&mut who, ms, interval, tells_velocity);
            assert!(told.len() > 5);
            let nobody = told.iter().all(Option::is_none);
            assert!(
                nobody,
                "{speed} cm/s, {tells_velocity}, {interval} ms: {told:?}"
            );
        }
    }
}

#[test]
fn a_person_who_runs_across_without_waiting_is_no_call_and_does_not_wait_over_there() {
    let mut scene = watch();
    let mut who = walking(person(1, 100, -100), 0, 200);
    assert_eq!(scene.sees(&mut who, 2_000), None);
    assert_eq!(scene.conducts(), [Conduct::OnRoad]);
    assert!(!scene.is_clear());
    scene.sees(&mut who, 2_300);
    who = walking(who, 0, 0);
    assert_eq!(scene.sees(&mut who, 3_000), None);
    assert_eq!(scene.conducts(), [Conduct::Across]);
    assert!(scene.is_clear());
    // A person who stays for long wants to go back.
    assert_eq!(scene.sees(&mut who, ACROSS.0), Some(Urgency::Medium));
}

#[test]
fn a_step_on_the_road_and_back_is_no_crossing() {
    let mut scene = watch();
    for north in [-20, 10, 20, -10] {
        scene.sees(&mut person(1, 100, north), 300);
    }
    let urgency = scene.sees(&mut person(1, 100, -20), 1_500);
    assert_eq!(urgency, Some(Urgency::Medium));
}

#[test]
fn vehicles_animals_and_riders_do_not_wait_and_a_cyclist_who_stands_does() {
    for what in [RoadUser::Vehicle, RoadUser::Animal] {
        for north in [-100, 300] {
            let mut scene = watch();
            let mut standing = Sighting {
                what,
                ..person(1, 100, north)
            };
            assert_eq!(scene.sees(&mut standing, 5_000), None, "{what:?}");
        }
    }
    let mut scene = watch();
    let what = RoadUser::Bicyclist;
    let mut cyclist = Sighting {
        what,
        ..walking(person(1, -300, -50), 300, 0)
    };
    assert_eq!(scene.sees(&mut cyclist, 2_500), None, "rides along");
    cyclist = walking(cyclist, 0, 100);
    cyclist.at = Point::new(100, -240);
    assert_eq!(scene.sees(&mut cyclist, 2_000), None, "rides to the road");
    cyclist = walking(cyclist, 0, 0);
    assert_eq!(scene.sees(&mut cyclist, 1_500), Some(Urgency::Medium));
}

#[test]
fn a_wheelchair_user_is_more_urgent_and_a_person_who_stands_on_the_road_most() {
    let user = Sighting {
        what: RoadUser::WheelchairUser,
        ..person(1, 100, -100)
    };
    let stuck = person(1, 100, 300);
    for (mut who, urgency) in [(user, Urgency::High), (stuck, Urgency::Emergency)] {
        let mut scene = watch();
        assert_eq!(scene.sees(&mut who, 1_500), Some(urgency));
        let is_call = |it: &Event| {
            let request = HelpRequest {
                urgency,
                ..scene.setup.request
            };
            *it == Event::PedestrianDetected(request)
        };
        assert_eq!(scene.told(is_call), 1, "{urgency:?}");
    }
}

#[test]
fn stale_observations_are_nobody_who_waits() {
    let mut scene = watch();
    let mut who = person(1, 100, -100);
    scene.look(0, &[who]);
    scene.pass(5_000);
    assert_eq!(scene.crossing.tracks().urgency(), None, "one frame");
    let seldom = scene.sees_at(&mut who, 9_000, 1_500, true);
    assert!(seldom.iter().all(Option::is_none), "a frame now and then");
    scene.sees(&mut who, 1_500);
    assert!(scene.crossing.tracks().urgency().is_some());
    scene.pass(1_001);
    assert_eq!(scene.crossing.tracks().urgency(), None, "silence");
    assert!(!scene.crossing.tracks().is_waiting(), "without go");
}

#[test]
fn uncertain_people_and_people_elsewhere_do_not_wait() {
    let mut scene = watch();
    let mut unsure = person(1, 100, -100);
    for (confidence, ms, expected) in [
        (49, 2_000, None),
        (50, 1_500, Some(Urgency::Medium)),
        (25, 500, Some(Urgency::Medium)),
    ] {
        unsure.confidence = confidence;
        assert_eq!(scene.sees(&mut unsure, ms), expected, "{confidence} %");
    }
    let mut scene = watch();
    assert_eq!(scene.sees(&mut person(2, 100, -260), 3_000), None);
    assert_eq!(scene.conducts(), [Conduct::Elsewhere]);
    let mut setup = street();
    setup.ground.waiting = None;
    let mut scene = Scene::new(setup);
    assert_eq!(scene.sees(&mut person(1, 100, 100), 2_000), None);
}

#[test]
fn a_zone_that_people_leave_is_deserted() {
    let mut scene = watch();
    let mut leaving = person(1, 400, -100);
    scene.sees(&mut leaving, 1_500);
    assert!(scene.crossing.tracks().is_waiting());
    leaving = walking(leaving, 140, 0);
    scene.sees(&mut leaving, 1_000);
    assert_eq!(scene.conducts(), [Conduct::Elsewhere]);
    assert!(!scene.crossing.tracks().is_waiting());
}

/// Hazard E: a person whose id changes every 0.8 s was never detected.
#[test]
fn a_person_waits_whatever_happens_to_their_id() {
    type Id = fn(u32) -> Option<u32>;
    let ids: [(&str, Id); 4] = [
        ("changes every 0.8 s", |frame| Some(frame / 8)),
        ("changes in each frame", Some),
        ("is missing", |_| None),
        ("comes and goes", |frame| (frame % 3 == 0).then_some(frame)),
    ];
    for (name, id) in ids {
        let mut scene = watch();
        let mut waits_from = None;
        for frame in 0..30 {
            let who = Sighting {
                id: id(frame),
                ..person(0, 100, -100)
            };
            scene.look(100, &[who]);
            assert_eq!(scene.conducts().len(), 1, "{name}: one person");
            if scene.crossing.tracks().is_waiting() {
                waits_from = waits_from.or(Some(frame));
            }
        }
        assert_eq!(waits_from, Some(10), "{name}");
    }
}

/// Two people whose ids are swapped in each frame both wait.
#[test]
fn swapped_ids_of_people_out_of_reach_of_each_other_swap_nobody() {
    let mut scene = watch();
    for frame in 0..20 {
        let (first, second) = (frame % 2, (frame + 1) % 2);
        let people = [person(first, -200, -100), person(second, 300, -100)];
        scene.look(100, &people);
    }
    assert_eq!(scene.conducts(), [Conduct::Waiting; 2]);
    let middle = scene.crossing.tracks().middle();
    assert_eq!(middle, Some(Point::new(50, -100)));
}

/// A person who has crossed changes places with another one who waits over there.
#[test]
fn people_within_reach_of_each_other_keep_their_ids() {
    let mut scene = watch();
    let [left, right] = [100, 200];
    let mut crosses = walking(person(1, left, 20), 0, 200);
    scene.sees(&mut crosses, 3_500);
    let over_there = |[first, second]: [i32; 2]| [person(1, first, 720), person(2, second, 720)];
    (0..15).for_each(|_| drop(scene.look(100, &over_there([left, right]))));
    assert_eq!(scene.conducts(), [Conduct::Across, Conduct::Waiting]);
    scene.look(500, &over_there([right, left]));
    let mut people: Vec<_> = scene.crossing.tracks().iter().collect();
    people.sort_by_key(|it| it.at().east_cm());
    let conducts: Vec<_> = people.iter().map(|it| it.conduct(&scene.setup)).collect();
    assert_eq!(conducts, [Conduct::Waiting, Conduct::Across]);
}

/// A source takes a person for a vehicle now and then, and the other way round.
#[test]
fn a_person_is_no_vehicle_whatever_a_source_takes_them_for() {
    use RoadUser::{Pedestrian, Vehicle, WheelchairUser};
    for (before, after, expected) in [
        (Pedestrian, Vehicle, Pedestrian),
        (Vehicle, Pedestrian, Pedestrian),
        (Pedestrian, WheelchairUser, WheelchairUser),
        (Vehicle, Vehicle, Vehicle),
    ] {
        let mut scene = watch();
        scene.pass(2_001);
        let seen = |what| Sighting {
            what,
            ..person(1, 100, 300)
        };
        scene.look(100, &[seen(before)]);
        for _ in 0..9 {
            scene.look(100, &[seen(after)]);
        }
        let tracks: Vec<_> = scene.crossing.tracks().iter().map(Track::what).collect();
        assert_eq!(tracks, [expected], "{before:?}, {after:?}");
        assert_eq!(
            scene.is_clear(),
            expected == Vehicle,
            "{before:?}, {after:?}"
        );
    }
}

/// A vehicle passes beside a person who is out of sight.
#[test]
fn a_vehicle_does_not_take_a_person_along() {
    let mut scene = watch();
    scene.look(100, &[person(1, 100, 300)]);
    let car = Sighting {
        what: RoadUser::Vehicle,
        id: None,
        ..person(9, 150, 300)
    };
    scene.look(500, &[car]);
    let mut people = scene.crossing.tracks().iter();
    assert!(people.any(|it| it.at() == Point::new(100, 300) && it.is_on_road()));
}

/// A sensor that has one of them or the other took the two for somebody who walks to and fro.
#[test]
fn two_people_of_whom_one_is_hidden_in_turn_both_wait() {
    let mut scene = watch();
    let people = [person(1, 100, -100), person(2, 220, -100)];
    for frame in 0..14 {
        scene.look(100, &people[frame % 2..=frame % 2]);
    }
    assert_eq!(scene.conducts(), [Conduct::Waiting; 2]);
}

/// A person who comes to the kerb while another one steps off it unseen has not crossed.
#[test]
fn who_comes_where_somebody_left_for_the_road_is_somebody_else() {
    let mut scene = watch();
    let mut walker = walking(person(1, 100, 0), 0, 120);
    scene.sees(&mut walker, 2_500);
    let mut comer = person(2, 100, -10);
    assert_eq!(scene.sees(&mut comer, 1_500), Some(Urgency::Medium));
    assert_eq!(scene.conducts(), [Conduct::OnRoad, Conduct::Waiting]);
}

#[test]
fn another_id_is_the_same_person_there_and_somebody_else_elsewhere() {
    for (id, east, people) in [
        (Some(2), 160, 1),
        (Some(2), 280, 2),
        (Some(1), 280, 1),
        (None, 280, 1),
    ] {
        let mut scene = watch();
        scene.look(100, &[person(1, 100, -100)]);
        let who = person(1, east, -100);
        scene.look(500, &[Sighting { id, ..who }]);
        assert_eq!(scene.conducts().len(), people, "{id:?} at {east}");
    }
}

/// Hazard D: the tracker restarts and numbers from 1 again.
#[test]
fn an_id_that_jumps_is_somebody_else() {
    let mut setup = street();
    setup.sensors.speed_max_cmps = 2_000;
    let mut scene = Scene::new(setup);
    scene.sees(&mut person(1, 0, 300), 500);
    // The person who was lost comes within reach of the other one with time.
    scene.sees(&mut person(1, 400, -200), 500);
    assert_eq!(scene.conducts(), [Conduct::OnRoad, Conduct::Passing]);
}

/// Hazard D: two cameras number from 1, each for itself.
#[test]
fn ids_belong_to_their_source() {
    let mut scene = watch();
    for _ in 0..15 {
        scene.look(100, &[person(1, 0, 300)]);
        scene.frame(1, 0, 0b11, &[person(1, 400, -200)]);
    }
    assert_eq!(scene.conducts(), [Conduct::OnRoad, Conduct::Waiting]);
    assert!(!scene.is_clear());
}

#[test]
fn two_sources_that_see_one_person_have_one_person() {
    let mut scene = watch();
    for _ in 0..15 {
        scene.look(100, &[person(1, 100, -100)]);
        scene.frame(1, 50, 0b11, &[person(7, 110, -95)]);
    }
    assert_eq!(scene.conducts(), [Conduct::Waiting]);
}

/// There are too many people to keep track of: somebody waits.
#[test]
fn more_people_than_can_be_kept_track_of_are_a_crowd_that_waits() {
    let setup = street();
    let mut crossing = Crossing::<2>::default();
    let people: Vec<Sighting> = (0..4)
        .map(|id| person(id, 100 * i32::try_from(id).unwrap(), -100))
        .collect();
    let frame = |crossing: &mut Crossing<2>, people: &[Sighting]| {
        crossing.step(&setup, Input::Elapsed(Millis(100)));
        crossing.step(
            &setup,
            Input::Frame(Frame {
                source: 0,
                age: Millis(0),
                covers: Coverage::ALL,
                sightings: people,
            }),
        );
    };
    frame(&mut crossing, &people);
    assert_eq!(crossing.tracks().urgency(), Some(Urgency::Medium));
    assert!(crossing.tracks().is_waiting() && crossing.tracks().is_somebody_lost());
    (0..11).for_each(|_| frame(&mut crossing, &[]));
    assert!(!crossing.tracks().is_waiting() && !crossing.tracks().is_somebody_lost());
    // Vehicles, and people elsewhere, are no crowd.
    let what = RoadUser::Vehicle;
    let vehicles: Vec<_> = people.iter().map(|it| Sighting { what, ..*it }).collect();
    let elsewhere: Vec<_> = (0..4).map(|id| person(id, 600, -100)).collect();
    for seen in [vehicles, elsewhere] {
        frame(&mut crossing, &seen);
        assert!(!crossing.tracks().is_waiting(), "{seen:?}");
    }
}

/// Another station can add people, and take none away.
#[test]
fn nobody_ceases_to_wait_because_of_what_others_report() {
    let mut scene = watch();
    let mut who = person(1, 100, -20);
    scene.sees(&mut who, 1_500);
    for reported in [
        person(9, 100, 40),
        person(9, 100, -30),
        Sighting {
            confidence: 0,
            ..person(1, 100, -20)
        },
        walking(person(1, 100, -20), 300, 0),
    ] {
        scene.tell(Input::Heard(WITNESS, reported, Millis(0)));
        let own = scene.crossing.tracks().iter().next().unwrap();
        assert_eq!(own.conduct(&scene.setup), Conduct::Waiting, "{reported:?}");
    }
    // It calls for people whom only others see.
    let mut scene = watch();
    for _ in 0..12 {
        scene.pass(100);
        scene.tell(Input::Heard(WITNESS, person(9, 100, -50), Millis(50)));
    }
    assert_eq!(scene.conducts(), [Conduct::Waiting]);
}

#[test]
fn a_source_that_lags_takes_nobody_back_where_they_were() {
    let mut scene = watch();
    scene.look(100, &[person(1, 100, 20)]);
    scene.frame(1, 90, 0b11, &[person(1, 100, -20)]);
    assert_eq!(scene.conducts(), [Conduct::OnRoad]);
}

/// Hazard B: a person who waits under go is out of sight for a moment, and waits still when seen again.
#[test]
fn a_person_who_is_found_again_under_go_waits_still() {
    let mut scene = watch();
    scene.sees(&mut person(1, 100, -100), 1_500);
    for _ in 0..15 {
        scene.look(100, &[]);
        scene.tell(Input::CorridorOpen(Millis(1_900)));
        assert!(scene.crossing.tracks().is_waiting());
    }
    assert!(scene.crossing.tracks().is_somebody_lost());
    scene.look(100, &[person(2, 120, -100)]);
    assert!(scene.crossing.tracks().is_waiting());
    assert!(!scene.crossing.tracks().is_somebody_lost());
    assert_eq!(scene.conducts(), [Conduct::Waiting]);
    // Not without end.
    for _ in 0..31 {
        scene.look(100, &[]);
        scene.tell(Input::CorridorOpen(Millis(1_900)));
    }
    assert!(!scene.crossing.tracks().is_waiting());
}

/// A person who was lost on the road is on it until frames say that nobody is, and not for ever.
#[test]
fn who_was_lost_on_the_road_is_resolved_by_empty_frames() {
    let mut scene = watch();
    scene.sees(&mut person(1, 100, 300), 1_500);
    scene.pass(2_000);
    assert_eq!(scene.conducts(), [Conduct::OnRoad]);
    for frame in 1..=6 {
        assert_eq!(scene.conducts(), [Conduct::OnRoad], "before frame {frame}");
        scene.look(100, &[]);
    }
    assert_eq!(scene.conducts(), []);
}

/// A robot with sensors has room for two, and one of them is there.
#[test]
fn no_number_of_people_who_were_lost_on_the_road_takes_the_place_of_those_who_are_there() {
    let setup = street();
    let mut crossing = Crossing::<2>::default();
    let mut look = |ms, people: &[Sighting]| {
        crossing.step(&setup, Input::Elapsed(Millis(ms)));
        let (source, age, covers) = (0, Millis(0), Coverage::ALL);
        crossing.step(
            &setup,
            Input::Frame(Frame {
                source,
                age,
                covers,
                sightings: people,
            }),
        );
        let tracks = crossing.tracks();
        let conducts = tracks.iter().map(|it| it.conduct(&setup));
        (conducts.collect::<Vec<_>>(), tracks.is_somebody_lost())
    };
    let stays = person(1, -200, 300);
    for id in 2..7 {
        let lost = person(id, 100 * i32::try_from(id).unwrap(), 300);
        look(100, &[stays, lost]);
        look(800, &[stays]);
        look(300, &[stays]);
    }
    let comes = person(9, 100, -200);
    let expected = vec![Conduct::OnRoad, Conduct::Passing];
    assert_eq!(look(100, &[stays, comes]), (expected, false));
}

/// A robot with room for two sees one more person, or hears of one.
#[test]
fn a_person_too_many_takes_the_place_of_somebody_elsewhere_or_of_hearsay() {
    let setup = street();
    let [road, kerb, comes] = [(100, 300), (100, -100), (450, -100)];
    let elsewhere = (900, -100);
    let seen = |at| (true, at);
    let heard = |at| (false, at);
    for (before, newcomer, gone) in [
        ([seen(road), seen(elsewhere)], seen(comes), Some(elsewhere)),
        ([heard(kerb), seen(elsewhere)], seen(comes), Some(elsewhere)),
        ([heard(road), heard(kerb)], seen(comes), Some(kerb)),
        ([heard(road), heard(kerb)], heard(comes), None),
        ([heard(road), heard(kerb)], seen(elsewhere), None),
        ([seen(road), seen(kerb)], seen(comes), None),
    ] {
        let mut crossing = Crossing::<2>::default();
        for (id, (is_seen, (east, north))) in (0..).zip(before.into_iter().chain([newcomer])) {
            crossing.step(&setup, Input::Elapsed(Millis(10)));
            let who = person(id, east, north);
            let sightings = &[who];
            let frame = Frame {
                source: 0,
                age: Millis(0),
                covers: Coverage::ALL,
                sightings,
            };
            let heard = Input::Heard(WITNESS, who, Millis(0));
            let input = if is_seen { Input::Frame(frame) } else { heard };
            crossing.step(&setup, input);
        }
        let stays = |(east, north)| {
            let mut tracks = crossing.tracks().iter();
            tracks.any(|it| it.at() == Point::new(east, north))
        };
        for (_, at) in before {
            assert_eq!(stays(at), gone != Some(at), "{before:?}, {newcomer:?}");
        }
        assert_eq!(
            stays(newcomer.1),
            gone.is_some(),
            "{before:?}, {newcomer:?}"
        );
    }
}

/// Hazard: guards wait for a cyclist in the queue before them, who waits for the guards. The crossing ends at 3 m west.
#[test]
fn a_rider_is_a_person_on_the_crossing_and_traffic_beside_it() {
    for what in [RoadUser::Bicyclist, RoadUser::Motorcyclist] {
        for (east, is_person) in [(-530, false), (-490, true), (100, true)] {
            let mut scene = watch();
            let rider = Sighting {
                what,
                ..person(1, east, 200)
            };
            (0..60).for_each(|_| drop(scene.look(100, &[rider])));
            assert_eq!(scene.is_clear(), !is_person, "{what:?} at {east}");
            let tracks = scene.crossing.tracks();
            assert_eq!(tracks.is_on_road(), is_person, "{what:?} at {east}");
            assert!(
                is_person || tracks.urgency().is_none(),
                "{what:?} at {east}"
            );
        }
    }
}

/// A tracker gives everybody whom it has not confirmed the same number.
#[test]
fn two_new_people_with_one_number_are_two() {
    let mut scene = watch();
    let [beside, on_road] = [-30, 5].map(|north| person(0, 100, north));
    for people in [[beside, on_road], [on_road, beside]] {
        (0..40).for_each(|_| drop(scene.look(100, &[])));
        assert!(scene.is_clear());
        scene.look(100, &people);
        assert!(!scene.is_clear());
        assert_eq!(scene.conducts().len(), 2);
        scene.pass(1_000);
    }
}

/// A robot without sensors, in a busy place.
#[test]
fn a_crowd_elsewhere_takes_no_place_from_a_person_who_was_lost_on_the_road() {
    let mut scene = Scene::new(Setup {
        watches: false,
        ..street()
    });
    let hear = |scene: &mut Scene, station, who| {
        scene.tell(Input::Heard(StationId(station), who, Millis(0)));
    };
    hear(&mut scene, 9, person(1, 100, 300));
    scene.pass(1_100);
    for id in 0..70 {
        let east = 50_000 + 300 * i32::try_from(id).unwrap();
        hear(&mut scene, 10, person(id, east, 0));
    }
    assert!(scene.crossing.tracks().is_on_road());
}

/// Sensors say nothing of people whom others report where they do not look.
#[test]
fn people_whom_others_report_are_off_the_road_once_sensors_cover_it() {
    for (covers, expected) in [(0b01, true), (0b11, false)] {
        let mut scene = watch();
        scene.tell(Input::Heard(WITNESS, person(1, 100, 300), Millis(0)));
        for _ in 0..50 {
            scene.pass(100);
            scene.frame(0, 0, covers, &[]);
        }
        assert_eq!(scene.crossing.tracks().is_on_road(), expected, "{covers:b}");
    }
}

/// Hazard: a robot stays on the lane for ever for somebody whom a sensor saw there that has failed.
#[test]
fn another_sensor_or_a_person_knows_that_somebody_has_left_the_road() {
    for sees in [true, false] {
        let mut scene = watch();
        scene.frame(0, 0, 0b11, &[person(1, 100, 300)]);
        for _ in 0..50 {
            scene.pass(100);
            if sees {
                scene.frame(1, 0, 0b11, &[]);
            }
        }
        assert_eq!(scene.crossing.tracks().is_on_road(), !sees);
        scene.tell(Input::SaidClear);
        assert!(!scene.crossing.tracks().is_on_road());
    }
}
