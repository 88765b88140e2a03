//! A crossing with streams of people and vehicles: waiting, delay and conflicts follow from who comes and how they behave.

use crossguard_judge::sim::{Arrival, Demand, Habits, Measured, Swarm};

/// So many who come one after the other, by turns from either side.
fn every(seconds: u64, count: u64, away_m: f64) -> Vec<Arrival> {
    let arrival = |number| Arrival {
        at_us: number * seconds * 1_000_000,
        away_m,
        comes_back: number % 2 == 1,
        speed_mps: 1.3,
    };
    (0..count).map(arrival).collect()
}

fn people() -> Vec<Arrival> {
    every(25, 12, 20.0)
}

fn cars() -> Vec<Arrival> {
    every(6, 50, 220.0)
}

fn measured(robots: usize, people: &[Arrival], cars: &[Arrival], habits: Habits) -> Measured {
    let demand = Demand::draw(1, people, cars, habits);
    Measured::of(&Swarm::at_place(1, robots, demand))
}

fn mean(of: &[f64]) -> f64 {
    let count = u32::try_from(of.len()).unwrap();
    of.iter().sum::<f64>() / f64::from(count)
}

#[test]
fn nobody_waits_without_vehicles_and_no_vehicle_without_people_and_robots() {
    let free = measured(0, &people(), &[], Habits::default());
    assert_eq!((free.by_gap, free.waited_s.len()), (12, 12));
    assert!(free.waited_s.iter().all(|it| *it <= 0.1), "{free:?}");
    // Vehicles so far apart that none follows another.
    let alone = measured(0, &[], &every(60, 6, 220.0), Habits::default());
    assert_eq!(alone.delays_s.len(), 6);
    assert!(alone.delays_s.iter().all(|it| it.abs() < 0.5), "{alone:?}");
}

#[test]
fn a_team_lets_people_cross_at_its_sign_at_once_and_vehicles_wait() {
    let (none, two) = (
        measured(0, &people(), &cars(), Habits::default()),
        measured(2, &people(), &cars(), Habits::default()),
    );
    assert_eq!((two.finding.clone(), two.left_alone, two.hit), (None, 0, 0));
    assert!(two.at_sign >= 10 && none.at_sign == 0, "{two:?}");
    assert!(mean(&two.waited_s) < mean(&none.waited_s));
    assert!(mean(&two.delays_s) > mean(&none.delays_s) + 5.0);
    // Phones are silent where robots tell of people.
    assert!(two.vams < none.vams && two.silent_vams > 0 && none.silent_vams == 0);
    assert!(none.packets.is_empty() && !two.packets.is_empty());
}

/// All vehicles are connected. The leader asks each that comes within ten seconds.
#[test]
fn vehicles_that_are_asked_stop_and_those_that_refuse_are_waited_for() {
    let asks = Habits {
        connected_share: 1.0,
        asks_vehicles_s: 10.0,
        ..Habits::default()
    };
    let unheeding = Habits {
        heeding_share: 0.0,
        ..asks
    };
    let run = |habits| measured(2, &people(), &cars(), habits);
    let (asked, refused) = (run(asks), run(unheeding));
    for all in [&asked, &refused] {
        assert_eq!((all.finding.clone(), all.left_alone, all.hit), (None, 0, 0));
    }
    assert!(asked.at_sign >= 10, "{asked:?}");
    assert!(refused.at_sign < asked.at_sign && mean(&refused.waited_s) > mean(&asked.waited_s));
}

#[test]
fn one_robot_finds_no_help_and_lets_nobody_cross() {
    let one = measured(1, &people(), &cars(), Habits::default());
    assert_eq!((one.finding.clone(), one.at_sign), (None, 0));
    let none = measured(0, &people(), &cars(), Habits::default());
    assert!(mean(&one.waited_s) > mean(&none.waited_s));
}

/// Drivers who brake for nobody, and people who trust the sign.
#[test]
fn drivers_who_never_brake_hit_people_and_robots() {
    let blind = Habits {
        yielding_share: 0.0,
        heeding_share: 0.0,
        reaction_s: 1e6,
        distracted_reaction_s: 1e6,
        ..Habits::default()
    };
    let seeing = measured(2, &people(), &cars(), Habits::default());
    let unseeing = measured(2, &people(), &cars(), blind);
    assert!(unseeing.robots_hit > seeing.robots_hit, "{unseeing:?}");
    // People who take any gap.
    let daring = Habits {
        start_up_s: 0.0,
        gap_spread: 1.0,
        ..blind
    };
    let daring = measured(0, &every(5, 60, 20.0), &cars(), daring);
    assert!(daring.hit > 0 && daring.ttc >= daring.hit && daring.pet >= daring.hit);
    let patient = measured(
        0,
        &every(5, 60, 20.0),
        &cars(),
        Habits {
            gap_spread: 0.0,
            ..blind
        },
    );
    assert_eq!(patient.hit, 0, "who waits for the gap is not hit");
}

#[test]
fn the_same_seed_gives_the_same_run() {
    let run = || measured(2, &people()[..4], &cars(), Habits::default());
    assert_eq!(run(), run());
}
