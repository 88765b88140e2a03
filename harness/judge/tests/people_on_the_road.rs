//! Logs in which people cross: P1 to P4 are kept, or the record that breaks them is named. Each hazard stands
//! beside the same log without it.

use crossguard_codec::core::cdd::Latitude;
use crossguard_codec::core::ram::RAM;
use crossguard_codec::{Identifiers, Service, decode, encode};
use crossguard_endpoint::station::listen::overhear;
use crossguard_judge::sim::{Swarm, run_recorded};
use crossguard_judge::validate::{self, Validated};
use crossguard_protocol::{Event, Input, Output, TaskType};
use crossguard_robot::plan::{Leg, Stage, Who};
use crossguard_robot::sight::{Degrees, Outline, RoadUser, Seen, SeenVehicle, Sight};
use crossguard_robot::site::{Place, Site};
use crossguard_robot::trace::{self, Entry, Record};
use crossguard_robot::zone::Conduct;

const S: u64 = 1_000_000;

/// A crossing with a guard in the lane and an escort, on an undisturbed network.
struct Crossing(Vec<Record>);

impl Crossing {
    fn new() -> Self {
        let escort = Leg {
            speed_mps: 0.8,
            ..Leg::new(TaskType::MOVE, Place::new(1.0, 8.0))
        };
        Self::beside_a_guard(escort, 19.0)
    }

    /// Both robots hold their places, and people run across.
    fn of_guards() -> Self {
        Self::beside_a_guard(Leg::new(TaskType::BLOCK, Place::new(-2.0, 2.0)), 1.5)
    }

    fn beside_a_guard(leg: Leg, crossing_s: f64) -> Self {
        let mut swarm = Swarm::quiet(3);
        for robot in &mut swarm.robots {
            let kerb = Stage::everybody(Leg::new(TaskType::INITIAL_POS, Place::new(1.0, -1.0)));
            let guard = Leg::new(TaskType::BLOCK, Place::new(4.0, 2.0));
            let parts = vec![(Who::Role(0), leg), (Who::Role(1), guard)];
            robot.plan.crossing_s = crossing_s;
            robot.plan.site = Site::default();
            robot.plan.followers = 2;
            robot.plan.roles = vec![None, None];
            robot.plan.stages = vec![kerb, Stage { parts }];
        }
        let (outcome, records) = run_recorded(&swarm);
        assert!(outcome.finding.is_none(), "{:?}", outcome.finding);
        Self(records)
    }

    fn find(&self, is_it: impl Fn(&Input, &[Output]) -> bool) -> &Record {
        let found = self.0.iter().find(|record| match &record.entry {
            Entry::Step { input, outputs, .. } => {
                is_it(input, &outputs.iter().copied().collect::<Vec<_>>())
            }
            _ => false,
        });
        found.expect("the crossing has it")
    }

    /// The leader, and when go was shown.
    fn go(&self) -> (String, u64) {
        let is_go = |_: &Input, outputs: &[Output]| {
            outputs
                .iter()
                .any(|it| matches!(it, Output::CorridorOpened(_)))
        };
        let record = self.find(is_go);
        (record.robot.clone(), record.at_us)
    }

    /// When the leader's application said that the task is completed.
    fn done(&self) -> u64 {
        let is_done =
            |input: &Input, _: &[Output]| matches!(input, Input::Local(Event::TaskCompleted));
        self.find(is_done).at_us
    }

    fn who(&self, task: TaskType) -> String {
        let starts = |_: &Input, outputs: &[Output]| {
            let is_it = |it: &Output| matches!(it, Output::StartManeuver(m) if m.task == task);
            outputs.iter().any(is_it)
        };
        self.find(starts).robot.clone()
    }

    /// Where a robot says that it is, and when.
    fn ways(&self, robot: &str) -> Vec<(u64, Degrees)> {
        let sent = self.0.iter().filter(|record| record.robot == robot);
        let place = |record: &Record| match &record.entry {
            Entry::Sent {
                message: Service::Ram,
                octets,
                ..
            } => {
                let position = overhear(&Identifiers::default(), octets)
                    .ok()?
                    .state?
                    .position;
                Some((record.at_us, (position.latitude?, position.longitude?)))
            }
            _ => None,
        };
        sent.filter_map(place).collect()
    }

    /// The leader's sensors have these people from these times on.
    fn sees(&mut self, sights: &[(u64, &[[f64; 2]])]) {
        let (leader, _) = self.go();
        self.robot_sees(&leader, sights);
    }

    fn robot_sees(&mut self, robot: &str, sights: &[(u64, &[[f64; 2]])]) {
        let degrees =
            |[east, north]: [f64; 2]| Site::default().coordinates(Place::new(east, north));
        let sights: Vec<_> = sights
            .iter()
            .map(|(at_us, people)| (*at_us, people.iter().map(|it| degrees(*it)).collect()))
            .collect();
        self.robot_sees_at(robot, &sights);
    }

    fn robot_sees_at(&mut self, robot: &str, sights: &[(u64, Vec<Degrees>)]) {
        self.watches(robot, sights[0].0);
        for (at_us, people) in sights {
            let seen = |place: &Degrees| Seen {
                place: *place,
                class: RoadUser::Pedestrian,
                // A robot is not judged by what it makes of people.
                conduct: Conduct::Elsewhere,
            };
            let sight = Sight {
                people: people.iter().map(seen).collect(),
                vehicles: Vec::new(),
            };
            self.add(*at_us, robot, Entry::People(sight));
        }
    }

    /// A robot watches the crossing from this time on.
    fn watches(&mut self, robot: &str, from_us: u64) {
        let rectangle = |[south, north]: [f64; 2]| {
            let corners = [(-3.0, south), (5.0, south), (5.0, north), (-3.0, north)];
            let degrees = |(east, north)| Site::default().coordinates(Place::new(east, north));
            corners.map(degrees).to_vec()
        };
        let zone = Outline {
            waiting: rectangle([-2.5, 9.5]),
            road: rectangle([0.0, 7.0]),
            crossing: Vec::new(),
        };
        self.add(from_us, robot, Entry::Zone(zone));
    }

    /// A robot has a vehicle that comes from so far east at 10 m/s.
    fn has_vehicle(&mut self, robot: &str, at_us: u64, east_m: f64) {
        let vehicle = SeenVehicle {
            place: Site::default().coordinates(Place::new(east_m, 2.0)),
            velocity: Some([-10.0, 0.0]),
        };
        let sight = Sight {
            people: Vec::new(),
            vehicles: vec![vehicle],
        };
        self.add(at_us, robot, Entry::People(sight));
    }

    fn add(&mut self, at_us: u64, robot: &str, entry: Entry) {
        let robot = robot.to_owned();
        let place = self.0.partition_point(|record| record.at_us <= at_us);
        self.0.insert(
            place,
            Record {
                at_us,
                robot,
                entry,
            },
        );
    }

    /// A robot is so far to the north of where its RAM said, from then on.
    fn drifts(&mut self, robot: &str, from_us: u64, north_m: f64) {
        self.drifts_in(robot, from_us..u64::MAX, north_m);
    }

    fn drifts_in(&mut self, robot: &str, times_us: std::ops::Range<u64>, north_m: f64) {
        let identifiers = Identifiers::default();
        for place in 0..self.0.len() {
            let record = &self.0[place];
            let Entry::Sent {
                message: Service::Ram,
                octets,
                ..
            } = &record.entry
            else {
                continue;
            };
            if record.robot != robot || !times_us.contains(&record.at_us) {
                continue;
            }
            let before = octets.clone();
            let mut ram = decode::<RAM>(&identifiers, &before).unwrap().message;
            let position = &mut ram.ram.ram_parameters.basic_container.reference_position;
            let shifted = f64::from(position.latitude.get()) + north_m / 111_195.0 * 1e7;
            #[expect(clippy::cast_possible_truncation, reason = "degrees fit")]
            let latitude = Latitude::saturating(shifted as i32);
            position.latitude = latitude;
            let after = encode(&identifiers, &ram).unwrap();
            for record in &mut self.0 {
                if let Entry::Sent { octets, .. } | Entry::Heard { octets, .. } = &mut record.entry
                    && *octets == before
                {
                    octets.clone_from(&after);
                }
            }
        }
    }

    fn judged(&self) -> Result<Validated, String> {
        let mut log = Vec::new();
        for record in &self.0 {
            trace::write(&mut log, record).unwrap();
        }
        validate::one(&*log).map_err(|invalid| invalid.to_string())
    }

    /// Statement on a property of valid logs.
    fn kept(&self, id: &str) -> String {
        let validated = self.judged().unwrap_or_else(|refusal| panic!("{refusal}"));
        let said = validated.crossing.into_iter().find(|it| it.starts_with(id));
        said.expect("each property is mentioned")
    }

    /// Refused by the line of a record, whose robot is said to have broken this.
    #[track_caller]
    fn is_refused(&self, id: &str) {
        let refusal = self.judged().expect_err("the log is refused");
        let (line, why) = refusal.split_once(": ").unwrap();
        let line: usize = line.strip_prefix("line ").unwrap().parse().unwrap();
        let Record { robot, .. } = &self.0[line - 1];
        let expected = format!("{robot} broke {id}");
        assert!(why.starts_with(&expected), "{refusal}");
    }
}

/// A person walks from one kerb to the other at the side of the escort, as far as the escort has come.
fn beside(escort: &[(u64, Degrees)], go_us: u64) -> Vec<(u64, Vec<Degrees>)> {
    let ways = escort.iter().filter(|(at_us, _)| *at_us > go_us);
    ways.map(|(at_us, place)| (*at_us, vec![*place])).collect()
}

#[test]
fn a_crossing_beside_the_escort_keeps_all_three() {
    let mut log = Crossing::new();
    let escort = log.who(TaskType::MOVE);
    let ways = log.ways(&escort);
    let (_, go_us) = log.go();
    log.robot_sees_at(&escort, &beside(&ways, go_us));
    for id in ["P1", "P2", "P4"] {
        let said = log.kept(id);
        assert!(said.starts_with(&format!("{id} kept")), "{said}");
    }
}

#[test]
fn a_log_without_people_says_what_it_does_not_show() {
    let log = Crossing::new();
    assert_eq!(log.kept("P1"), "P1 not judged: no sight in the log");
    assert_eq!(log.kept("P4"), "P4 not judged: no sight in the log");
}

#[test]
fn hazard_a_a_person_on_the_road_is_forgotten_when_the_leader_completes_the_task() {
    let done_us = Crossing::new().done();
    let crossing = |north: f64| {
        let mut log = Crossing::new();
        let person: &[[f64; 2]] = &[[1.0, north]];
        log.sees(&[(done_us - S, person), (done_us - S / 2, &[])]);
        log
    };
    crossing(6.0).is_refused("P1");
    assert!(crossing(8.0).kept("P1").starts_with("P1 kept"));
}

#[test]
fn hazard_b_a_person_who_saw_go_and_was_out_of_sight_is_on_the_road_without_guards() {
    let done_us = Crossing::of_guards().done();
    let steps_after = |after_us: u64| {
        let mut log = Crossing::of_guards();
        let (waits, steps): (&[_], &[_]) = (&[[1.0, -1.0]], &[[1.0, 3.5]]);
        log.sees(&[
            (done_us - 3 * S, waits),
            (done_us - 2 * S, &[]),
            (done_us + after_us, steps),
        ]);
        log
    };
    steps_after(S / 10).is_refused("P1");
    // A person who steps on the road long after go was not let across.
    assert!(steps_after(5 * S).kept("P1").starts_with("P1 kept"));
}

#[test]
fn hazard_c_a_person_leaves_the_zone_sideways_and_is_still_between_the_kerbs() {
    let done_us = Crossing::new().done();
    let walks = |north: f64| {
        let mut log = Crossing::new();
        let way: Vec<_> = (0..10)
            .map(|step: u8| [[3.0 + f64::from(step), north]])
            .collect();
        let times = (0..10).map(|step| done_us - 5 * S + step * S / 2);
        let sights: Vec<_> = times
            .zip(&way)
            .map(|(at_us, it)| (at_us, &it[..]))
            .collect();
        log.sees(&sights);
        log
    };
    walks(6.0).is_refused("P1");
    assert!(walks(8.0).kept("P1").starts_with("P1 kept"));
}

#[test]
fn hazard_d_somebody_on_the_pavement_has_the_number_of_the_person_on_the_road() {
    let done_us = Crossing::new().done();
    let others = |then: &[[f64; 2]]| {
        let mut log = Crossing::new();
        log.sees(&[(done_us - S / 2, &[[1.0, 3.0]]), (done_us - S / 4, then)]);
        log
    };
    others(&[[1.0, 8.0]]).is_refused("P1");
    others(&[[1.0, 8.0], [1.0, 3.2]]).is_refused("P1");
    let mut log = Crossing::new();
    log.sees(&[
        (done_us - S / 2, &[[1.0, 6.5]]),
        (done_us - S / 4, &[[1.0, 7.2]]),
    ]);
    assert!(log.kept("P1").starts_with("P1 kept"));
}

#[test]
fn hazard_g_a_guard_is_not_at_its_place_any_more_and_go_is_shown() {
    let away = |north_m: f64| {
        let mut log = Crossing::new();
        let (_, go_us) = log.go();
        log.drifts(&log.who(TaskType::BLOCK), go_us + S, north_m);
        log
    };
    away(3.0).is_refused("P2");
    away(30.0).is_refused("P2");
    assert!(away(1.0).kept("P2").starts_with("P2 kept"));
}

#[test]
fn hazard_i_go_begins_before_a_vehicle_that_cannot_stop() {
    let comes = |east_m: f64| {
        let mut log = Crossing::new();
        let (leader, go_us) = log.go();
        log.watches(&leader, go_us - S);
        log.has_vehicle(&leader, go_us - S / 10, east_m);
        log
    };
    comes(41.0).is_refused("P3");
    for east_m in [42.0, -10.0] {
        let said = comes(east_m).kept("P3");
        assert!(said.starts_with("P3 kept 1 times"), "{said}");
    }
    assert!(Crossing::new().kept("P3").starts_with("P3 not judged"));
}

/// A robot that has gone home after its session is on the lane again all at once.
#[test]
fn a_robot_steps_on_the_lane_before_a_vehicle_that_cannot_stop() {
    let steps = |sights: &[(u64, f64)]| {
        let mut log = Crossing::of_guards();
        let guard = log.who(TaskType::BLOCK);
        let (steps_us, (latitude, _)) = *log.ways(&guard).last().unwrap();
        let kerb = Site::default().coordinates(Place::default());
        let north_m = (latitude - kerb.0) * 111_195.0;
        log.drifts_in(&guard, steps_us - 5 * S..steps_us, -2.0 - north_m);
        log.drifts(&guard, steps_us, 2.0 - north_m);
        log.watches(&guard, steps_us - 3 * S);
        for (before_us, east_m) in sights {
            log.has_vehicle(&guard, steps_us - before_us, *east_m);
        }
        log
    };
    steps(&[(2 * S, 40.0), (S / 2, 25.0)]).is_refused("P9");
    for sights in [
        // It could stop until a second ago, or can; it has passed; it came in sight a second ago.
        &[(2 * S, 60.0), (S, 40.0)][..],
        &[(2 * S, 60.0), (S / 2, 45.0)],
        &[(2 * S, 40.0), (S / 2, -10.0)],
        &[(S, 30.0)],
    ] {
        let said = steps(sights).kept("P9");
        assert!(said.starts_with("P9 kept 1 times"), "{sights:?}: {said}");
    }
    assert!(Crossing::new().kept("P9").starts_with("P9 not judged"));
}

#[test]
fn hazard_h_an_escort_goes_on_without_its_person() {
    let mut log = Crossing::new();
    let (escort, (_, go_us)) = (log.who(TaskType::MOVE), log.go());
    log.robot_sees(&escort, &[(go_us + S, &[[1.0, 0.5]])]);
    log.is_refused("P4");
}

#[test]
fn hazard_h_an_escort_completes_while_its_person_is_on_the_road() {
    let mut log = Crossing::new();
    let escort = log.who(TaskType::MOVE);
    let is_completion = |record: &&Record| {
        matches!(
            &record.entry,
            Entry::Step {
                input: Input::Local(Event::ManeuverCompleted(_)),
                ..
            }
        ) && record.robot == escort
    };
    let at_us = log.0.iter().rfind(is_completion).unwrap().at_us;
    log.sees(&[(at_us - S / 10, &[[1.0, 6.5]])]);
    log.is_refused("P1");
}
