//! How fast streets are simulated, against the number of robots: robots that all hear each other, and up
//! to 250 teams of four that do not hear other teams. Real packets, 10 % loss, every property judged; one
//! thread. Times are processor times, so that they hold on a busy machine as well.
//!
//! `cargo bench -p crossguard-judge --bench simulator`

use std::time::Duration;

use crossguard_judge::sim::{Deed, Happening, Outcome, RobotDraw, Swarm, run};
use crossguard_protocol::{Config, StationId};
use crossguard_robot::body::Build;
use crossguard_robot::plan::Plan;
use crossguard_robot::site::{Place, Site};
use crossguard_robot::transport::{Delay, Faults};
use nix::time::{ClockId, clock_gettime};

/// How long a street is simulated before it comes to rest, in seconds, and how often somebody wants to
/// cross.
const SECONDS: u64 = 60;
const CROSSINGS: u64 = 3;

const TEAM: usize = 4;

/// A street with teams of four that hear each other; in the first of each, a pedestrian is detected again
/// and again.
fn street(seed: u64, robots: usize) -> Swarm {
    let site = Site::default();
    let station = |place: usize| StationId(u32::try_from(place).unwrap_or(0) + 1);
    let robot = |place: usize| RobotDraw {
        name: format!("R{}", station(place)),
        station: station(place),
        boot: 1,
        config: Config::default(),
        plan: Plan {
            followers: u8::try_from(TEAM.min(robots) - 1).unwrap_or(1),
            ..Plan::crossing(site)
        },
        corner: place / TEAM,
        build: Build::Quadruped,
        place: Place::new(f64::from(station(place).0) % 20.0, -2.0),
        time_scale: 3.0,
        drift_ppm: 100,
    };
    let mut script: Vec<_> = (0..robots)
        .map(|place| Happening {
            at_us: place as u64 * 1_000,
            place,
            deed: Deed::Boot,
        })
        .collect();
    for round in 0..CROSSINGS {
        for place in (0..robots).step_by(TEAM) {
            let at_us = (1 + round * SECONDS / CROSSINGS) * 1_000_000 + place as u64 * 50_000;
            script.push(Happening {
                at_us,
                place,
                deed: Deed::Detect,
            });
        }
    }
    script.sort_by_key(|happening| happening.at_us);
    let faults = Faults {
        loss: 0.1,
        delay: Delay {
            min_ms: 2,
            max_ms: 20,
            mean_ms: None,
        },
        ..Faults::default()
    };
    Swarm {
        seed,
        robots: (0..robots).map(robot).collect(),
        ways: vec![faults; robots * robots],
        script,
        heals_us: SECONDS * 1_000_000,
        late_max_us: 1_000,
        ..Swarm::default()
    }
}

#[derive(Default)]
struct Sum {
    robots: usize,
    robot_s: f64,
    steps: u64,
    packets: u64,
}

impl Sum {
    #[expect(clippy::cast_precision_loss, reason = "runs take minutes")]
    fn add(&mut self, outcome: &Outcome) {
        assert_eq!(outcome.finding, None, "a property is broken");
        self.robots += outcome.robots;
        self.robot_s += outcome.robots as f64 * outcome.virtual_ms as f64 / 1e3;
        self.steps += outcome.steps;
        self.packets += outcome.packets;
    }

    #[expect(clippy::cast_precision_loss, reason = "they are few enough")]
    fn tell(&self, what: &str, took: Duration) {
        let per_s = |count: f64| count / took.as_secs_f64();
        println!(
            "| {what} | {} | {:.0} | {:.2} | {:.0} | {:.0} | {:.0} |",
            self.robots,
            self.robot_s,
            took.as_secs_f64(),
            per_s(self.robot_s),
            per_s(self.steps as f64),
            per_s(self.packets as f64)
        );
    }
}

/// How long this process has had a processor.
fn processor_time() -> Duration {
    let time = clock_gettime(ClockId::CLOCK_PROCESS_CPUTIME_ID);
    time.expect("the system has this clock").into()
}

fn main() {
    println!(
        "| street | robots | robot-seconds | took [s] | robot-seconds per s | steps per s | packets per s |"
    );
    println!("|---|--:|--:|--:|--:|--:|--:|");
    for robots in [2, 4, 8, 16, 32] {
        let began = processor_time();
        let mut sum = Sum::default();
        sum.add(&run(&street(1, robots), None));
        sum.tell("one, all hear all", processor_time().saturating_sub(began));
    }
    for teams in [1, 10, 50, 250] {
        let began = processor_time();
        let mut sum = Sum::default();
        for team in 0..teams {
            sum.add(&run(&street(team, TEAM), None));
        }
        sum.tell(
            &format!("{teams} teams apart"),
            processor_time().saturating_sub(began),
        );
    }
}
