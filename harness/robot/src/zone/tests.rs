//! Who waits to cross, and who does not.

use super::*;

/// A street of 7 m that runs from west to east, with pavements of 2.5 m.
fn zone() -> Zone {
    let strip = |south: f64, north: f64| {
        let corners = [[-3.0, south], [5.0, south], [5.0, north], [-3.0, north]];
        Area::Polygon(corners.to_vec())
    };
    Zone {
        waiting: Some(strip(-2.5, 9.5)),
        ..Zone::of_road(strip(0.0, 7.0))
    }
}

fn person(id: u32, position_m: [f64; 2]) -> PerceivedVru {
    PerceivedVru {
        id,
        position_m,
        velocity_mps: [0.0; 2],
        class: VruClass::Pedestrian,
        confidence: 1.0,
    }
}

/// A crossing under watch.
struct Kerb {
    watched: Watched,
    now_s: f64,
}

impl Kerb {
    fn new() -> Self {
        Self {
            watched: Watched::new(zone()),
            now_s: 0.0,
        }
    }

    /// Somebody goes on as they do for some seconds, told ten times in each. The highest urgency meanwhile.
    fn sees(&mut self, vru: &mut PerceivedVru, seconds: f64) -> Option<Urgency> {
        let told = self.sees_at(vru, seconds, 0.1, true);
        told.into_iter().max().flatten()
    }

    /// The same, told at this interval, and with the velocity or without.
    fn sees_at(
        &mut self,
        vru: &mut PerceivedVru,
        seconds: f64,
        interval_s: f64,
        has_velocity: bool,
    ) -> Vec<Option<Urgency>> {
        let until_s = self.now_s + seconds - 1e-9;
        let mut urgencies = Vec::new();
        while self.now_s < until_s {
            let told = PerceivedVru {
                velocity_mps: if has_velocity {
                    vru.velocity_mps
                } else {
                    [0.0; 2]
                },
                ..*vru
            };
            self.watched.perceive(self.now_s, &told);
            urgencies.push(self.watched.urgency(self.now_s));
            self.now_s += interval_s;
            for axis in 0..2 {
                vru.position_m[axis] += vru.velocity_mps[axis] * interval_s;
            }
        }
        urgencies
    }

    fn conduct(&self, id: u32) -> Conduct {
        self.watched.conduct(self.now_s, id)
    }
}

#[test]
fn a_person_who_stands_at_the_kerb_waits_after_the_dwell_time() {
    let mut kerb = Kerb::new();
    let mut person = person(1, [1.0, -1.0]);
    assert_eq!(kerb.sees(&mut person, 0.9), None);
    assert_eq!(kerb.conduct(1), Conduct::Passing);
    assert_eq!(kerb.sees(&mut person, 0.3), Some(Urgency::Medium));
    assert_eq!(kerb.conduct(1), Conduct::Waiting);
    // However restless.
    person.velocity_mps = [0.9, 0.0];
    assert_eq!(kerb.sees(&mut person, 1.0), Some(Urgency::Medium));
    let middle = kerb.watched.middle(kerb.now_s).unwrap();
    assert!(middle.distance(Place::new(1.8, -1.0)) < 0.2, "{middle:?}");
}

#[test]
fn a_person_who_sways_waits_as_well() {
    let mut kerb = Kerb::new();
    let mut urgency = None;
    for step in 0..20_u8 {
        let sway = if step % 2 == 0 { 0.1 } else { -0.1 };
        let mut person = person(1, [1.0 + sway, -1.0]);
        person.velocity_mps = [sway * 3.0, 0.0];
        urgency = kerb.sees(&mut person, 0.1);
    }
    assert_eq!(urgency, Some(Urgency::Medium));
}

#[test]
fn a_person_who_walks_up_to_the_road_is_noticed_before_the_kerb() {
    let mut kerb = Kerb::new();
    let mut person = person(1, [1.0, -2.4]);
    person.velocity_mps = [0.0, 1.2];
    assert_eq!(kerb.sees(&mut person, 1.2), Some(Urgency::Medium));
    assert!(person.position_m[1] < 0.0, "not on the road yet");
}

#[test]
fn a_passer_by_along_the_kerb_does_not_wait() {
    for (speed_mps, has_velocity) in [(1.4, true), (0.8, true), (1.4, false), (0.8, false)] {
        for interval_s in [0.1, 0.25, 0.5] {
            let mut kerb = Kerb::new();
            let mut person = person(1, [-3.0, -0.6]);
            person.velocity_mps = [speed_mps, 0.0];
            let seconds = 7.9 / speed_mps;
            let told = kerb.sees_at(&mut person, seconds, interval_s, has_velocity);
            assert!(told.len() > 5);
            let nobody = told.iter().all(Option::is_none);
            assert!(
                nobody,
                "{speed_mps} m/s, {has_velocity}, {interval_s} s: {told:?}"
            );
        }
    }
}

#[test]
fn a_person_who_runs_across_without_waiting_is_no_call_and_does_not_wait_over_there() {
    let mut kerb = Kerb::new();
    let mut person = person(1, [1.0, -1.0]);
    person.velocity_mps = [0.0, 2.0];
    assert_eq!(kerb.sees(&mut person, 2.0), None);
    assert_eq!(kerb.conduct(1), Conduct::OnRoad);
    assert!(!kerb.watched.is_clear(kerb.now_s));
    kerb.sees(&mut person, 2.3);
    person.velocity_mps = [0.0; 2];
    assert_eq!(kerb.sees(&mut person, 3.0), None);
    assert_eq!(kerb.conduct(1), Conduct::Across);
    assert!(kerb.watched.is_clear(kerb.now_s));
    // A person who stays for long wants to go back.
    assert_eq!(kerb.sees(&mut person, ACROSS_S), Some(Urgency::Medium));
}

#[test]
fn a_step_on_the_road_and_back_is_no_crossing() {
    let mut kerb = Kerb::new();
    for north in [-0.2, 0.1, 0.2, -0.1] {
        kerb.sees(&mut person(1, [1.0, north]), 0.3);
    }
    assert_eq!(
        kerb.sees(&mut person(1, [1.0, -0.2]), 1.5),
        Some(Urgency::Medium)
    );
}

#[test]
fn vehicles_animals_and_riders_do_not_wait_and_a_cyclist_who_stands_does() {
    for class in [VruClass::Vehicle, VruClass::Motorcyclist, VruClass::Animal] {
        for place in [[1.0, -1.0], [1.0, 3.0]] {
            let mut kerb = Kerb::new();
            let mut standing = PerceivedVru {
                class,
                ..person(1, place)
            };
            assert_eq!(kerb.sees(&mut standing, 5.0), None, "{class:?}");
        }
    }
    let mut kerb = Kerb::new();
    let mut cyclist = PerceivedVru {
        class: VruClass::Bicyclist,
        velocity_mps: [3.0, 0.0],
        ..person(1, [-3.0, -0.5])
    };
    assert_eq!(kerb.sees(&mut cyclist, 2.5), None, "rides along");
    cyclist.velocity_mps = [0.0, 1.0];
    cyclist.position_m = [1.0, -2.4];
    assert_eq!(kerb.sees(&mut cyclist, 2.0), None, "rides to the road");
    cyclist.velocity_mps = [0.0; 2];
    cyclist.position_m = [1.0, -0.4];
    assert_eq!(kerb.sees(&mut cyclist, 1.5), Some(Urgency::Medium));
}

#[test]
fn a_wheelchair_user_is_more_urgent_and_a_person_who_stands_on_the_road_most() {
    let mut kerb = Kerb::new();
    let mut user = PerceivedVru {
        class: VruClass::WheelchairUser,
        ..person(1, [1.0, -1.0])
    };
    assert_eq!(kerb.sees(&mut user, 1.5), Some(Urgency::High));
    let mut kerb = Kerb::new();
    let mut stuck = person(1, [1.0, 3.0]);
    assert_eq!(kerb.sees(&mut stuck, 1.5), Some(Urgency::Emergency));
}

#[test]
fn stale_observations_are_nobody_who_waits() {
    let mut kerb = Kerb::new();
    kerb.watched.perceive(0.0, &person(1, [1.0, -1.0]));
    assert_eq!(kerb.watched.urgency(5.0), None, "one line");
    let seldom = kerb.sees_at(&mut person(1, [1.0, -1.0]), 9.0, 1.5, true);
    assert!(seldom.iter().all(Option::is_none), "a line now and then");
    kerb.sees(&mut person(1, [1.0, -1.0]), 1.5);
    assert!(kerb.watched.urgency(kerb.now_s).is_some());
    assert_eq!(kerb.watched.urgency(kerb.now_s + 1.1), None, "silence");
}

#[test]
fn uncertain_people_and_people_elsewhere_do_not_wait() {
    let mut kerb = Kerb::new();
    let mut unsure = PerceivedVru {
        confidence: 0.4,
        ..person(1, [1.0, -1.0])
    };
    assert_eq!(kerb.sees(&mut unsure, 2.0), None);
    unsure.confidence = 0.6;
    assert_eq!(kerb.sees(&mut unsure, 1.5), Some(Urgency::Medium));
    unsure.confidence = 0.3;
    assert_eq!(
        kerb.sees(&mut unsure, 0.5),
        Some(Urgency::Medium),
        "it is known"
    );
    let mut kerb = Kerb::new();
    assert_eq!(kerb.sees(&mut person(2, [1.0, -2.6]), 3.0), None);
    assert_eq!(kerb.conduct(2), Conduct::Elsewhere);
    let mut nobody_detects = Watched::new(Zone::of_road(Area::Polygon(vec![
        [-3.0, 0.0],
        [5.0, 0.0],
        [5.0, 7.0],
    ])));
    for tenth in 0..20_u8 {
        nobody_detects.perceive(f64::from(tenth) / 10.0, &person(1, [4.0, 1.0]));
    }
    assert_eq!(nobody_detects.urgency(2.0), None);
}

#[test]
fn a_zone_that_people_leave_is_deserted() {
    let mut kerb = Kerb::new();
    assert!(kerb.watched.is_deserted(0.0));
    let mut leaving = person(1, [4.0, -1.0]);
    kerb.sees(&mut leaving, 1.5);
    assert!(!kerb.watched.is_deserted(kerb.now_s));
    leaving.velocity_mps = [1.4, 0.0];
    kerb.sees(&mut leaving, 1.0);
    assert_eq!(kerb.conduct(1), Conduct::Elsewhere);
    assert!(!kerb.watched.is_deserted(kerb.now_s), "not at once");
    kerb.sees(&mut leaving, 3.0);
    assert!(kerb.watched.is_deserted(kerb.now_s));
}

#[test]
fn the_road_is_clear_once_everybody_was_seen_beside_it() {
    let mut watched = Watched::new(zone());
    assert!(!watched.is_clear(0.0), "nothing is known");
    watched.perceive(0.0, &person(1, [0.0, -1.0]));
    assert!(watched.is_clear(1.0) && !watched.is_clear(1.1));
    watched.perceive(2.0, &person(1, [0.0, 3.0]));
    watched.perceive(4.0, &person(2, [9.0, 3.0]));
    assert!(!watched.is_clear(4.0), "1 was seen last on the road");
    let car = PerceivedVru {
        class: VruClass::Vehicle,
        ..person(3, [2.0, 3.0])
    };
    watched.perceive(4.1, &car);
    watched.perceive(4.2, &person(1, [0.0, 7.5]));
    assert!(watched.is_clear(4.2), "a vehicle is nobody");
    assert!(!watched.is_clear(6.0), "silence");
    watched.perceive_nobody(6.0);
    assert!(watched.is_clear(6.0));
    watched.perceive(7.0, &person(4, [0.0, 3.0]));
    watched.perceive_nobody(9.0);
    assert!(!watched.is_clear(9.0), "4 was lost on the road");
    let without_road = Zone {
        road: None,
        ..zone()
    };
    let mut watched = Watched::new(without_road);
    watched.perceive(0.0, &person(1, [0.0, -1.0]));
    assert!(!watched.is_clear(0.0), "nobody says where the road is");
}

#[test]
fn more_people_than_can_be_kept_track_of_are_not_forgotten() {
    let mut watched = Watched::new(zone());
    let ids = 0..u32::try_from(TRACKED_MAX).unwrap() + 1;
    ids.clone()
        .for_each(|id| watched.perceive(0.0, &person(id, [0.5, 0.5])));
    ids.for_each(|id| watched.perceive(0.0, &person(id, [8.0, 0.5])));
    assert!(!watched.is_clear(0.0));
    watched.forget();
    assert!(watched.is_clear(0.0));
}
