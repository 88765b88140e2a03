//! Two groups that do not hear each other lead at one crossing, each with its own corridor. Once they hear each
//! other, one shows stop at once, keeps its guard until the road is clear, and ends.

use crossguard_judge::sim::{self, Deed, Happening, RobotDraw, Swarm};
use crossguard_protocol::{
    self as protocol, Config, CorridorClosure, EndReason, Notice, Output, StationId, TaskType,
};
use crossguard_robot::body::Build;
use crossguard_robot::plan::{Leg, Plan, Stage};
use crossguard_robot::site::{Place, Site};
use crossguard_robot::trace::{Entry, Record};
use crossguard_robot::transport::{Faults, Outage};

const MEET_MS: u64 = 4_000;

/// Two leaders, 1 and 2, and for each a helper that only it hears until they meet.
fn swarm(crossings: [u32; 2]) -> Swarm {
    let robot = |place: usize| {
        let station = StationId(u32::try_from(place).unwrap() + 1);
        let site = Site {
            crossing: protocol::Place(crossings[place % 2]),
            ..Site::default()
        };
        let at = Place::new(f64::from(station.0), 0.0);
        RobotDraw {
            name: format!("R{station}"),
            station,
            boot: 1,
            config: Config::default(),
            plan: Plan {
                stages: vec![Stage::everybody(Leg::new(TaskType::BLOCK, at))],
                crossing_s: 6.0,
                ..Plan::crossing(site)
            },
            // Where the two references may be of one crossing, they are.
            corner: usize::from(place % 2 == 1 && crossings == [7, 8]),
            build: Build::Humanoid,
            place: at,
            time_scale: 1.0,
            drift_ppm: 0,
        }
    };
    let apart = Faults {
        outages: vec![Outage {
            from_ms: 0,
            until_ms: MEET_MS,
        }],
        ..Faults::default()
    };
    let way = |from: usize, to: usize| {
        if from % 2 == to % 2 {
            Faults::default()
        } else {
            apart.clone()
        }
    };
    let ways = (0..4).flat_map(|from| (0..4).map(move |to| (from, to)));
    let deed = |at_us, place, deed| Happening { at_us, place, deed };
    let mut script: Vec<_> = (0..4).map(|place| deed(0, place, Deed::Boot)).collect();
    script.extend((0..2).map(|place| deed(500_000, place, Deed::Detect)));
    Swarm {
        seed: 1,
        robots: (0..4).map(robot).collect(),
        ways: ways.map(|(from, to)| way(from, to)).collect(),
        script,
        heals_us: 20_000_000,
        late_max_us: 0,
        ..Swarm::default()
    }
}

/// What the robot of this name put out, with the time in ms.
fn outputs(swarm: &Swarm, name: &str) -> Vec<(u64, Output)> {
    let mut outputs = Vec::new();
    let outcome = sim::run(
        swarm,
        Some(&mut |record: Record| {
            if let (true, Entry::Step { outputs: step, .. }) = (record.robot == name, record.entry)
            {
                outputs.extend(step.iter().map(|output| (record.at_us / 1_000, *output)));
            }
        }),
    );
    assert_eq!(outcome.finding, None);
    outputs
}

fn first(outputs: &[(u64, Output)], is: impl Fn(&Output) -> bool) -> Option<u64> {
    let found = outputs.iter().find(|(_, output)| is(output));
    found.map(|(at_ms, _)| *at_ms)
}

#[test]
fn the_leader_behind_shows_stop_at_once_and_ends_when_the_road_is_clear() {
    for crossings in [[7, 7], [7, 0]] {
        let swarm = swarm(crossings);
        let (ahead, behind) = (outputs(&swarm, "R1"), outputs(&swarm, "R2"));
        for leader in [&ahead, &behind] {
            let opened_ms = first(leader, |it| matches!(it, Output::CorridorOpened(_)));
            assert!(opened_ms.is_some_and(|at_ms| at_ms < MEET_MS), "both open");
        }
        let yielded = CorridorClosure::Yielded(StationId(1));
        let stop_ms = first(&behind, |it| *it == Output::CorridorClosed(yielded)).unwrap();
        // It hears the other twice.
        assert!((MEET_MS..MEET_MS + 500).contains(&stop_ms), "{stop_ms}");
        let ended_ms = first(&behind, |it| {
            matches!(
                it,
                Output::Notify(Notice::SessionEnded(_, EndReason::Withdrawn(StationId(1))))
            )
        });
        let ended_ms = ended_ms.expect("it ends");
        assert!(
            ended_ms >= stop_ms,
            "its guard stays until the road is clear"
        );
        let completed = |it: &Output| {
            matches!(
                it,
                Output::Notify(Notice::SessionEnded(_, EndReason::TaskCompleted))
            )
        };
        assert!(first(&ahead, completed).is_some(), "the other one goes on");
        assert_eq!(first(&behind, completed), None);
    }
}

#[test]
fn leaders_at_two_places_do_not_concern_each_other() {
    let swarm = swarm([7, 8]);
    for leader in ["R1", "R2"] {
        let yielded = |it: &Output| matches!(it, Output::Notify(Notice::Yielded(_)));
        assert_eq!(first(&outputs(&swarm, leader), yielded), None);
    }
}
