//! The longest transition: five robots live through random inputs, and each step of each of them is timed
//! on copies of its state.
//!
//! `cargo run --release -p crossguard-protocol --example step_cost` prints the slowest steps by time.
//! With a number as argument it repeats the heaviest step that is known that often, and nothing else, so
//! that `valgrind --tool=callgrind` can count its instructions: take the difference of two numbers.

use std::hint::black_box;
use std::time::Instant;

use crossguard_protocol::{
    Availability, Config, Decimetres, Event, HelpRequest, Input, ManeuverId, Millis, Output,
    Outputs, Phase, Place, Robot, StationId, TaskSet, TaskType, Unavailability, Urgency,
};

const ROBOTS: usize = 5;
/// Inputs of the walk, and repetitions by which each step is timed: the best of this many batches.
const INPUTS: usize = 300_000;
const BATCHES: usize = 5;
const BATCH: u32 = 8;

fn main() {
    let config = Config::default();
    if let Some(times) = std::env::args().nth(1) {
        let times: u32 = times.parse().expect("a number");
        let (leader, input) = everything_due(&config);
        for _ in 0..times {
            black_box(black_box(leader.clone()).step(&config, black_box(input)));
        }
        return;
    }
    let (leader, input) = everything_due(&config);
    println!(
        "leading four, all timers due: {:.0} ns",
        nanoseconds(&config, &leader, input)
    );
    let mut worst: Vec<(f64, String)> = Vec::new();
    let mut total = 0.0;
    walk(&config, |robot, input| {
        let time = nanoseconds(&config, robot, input);
        total += time;
        if worst.len() < 5 || time > worst[4].0 {
            worst.push((
                time,
                format!("{}, {:?}: {input}", robot.role(), robot.state()),
            ));
            worst.sort_by(|a, b| b.0.total_cmp(&a.0));
            worst.truncate(5);
        }
    });
    #[expect(clippy::cast_precision_loss, reason = "a small number")]
    let mean = total / INPUTS as f64;
    println!("{INPUTS} steps of reachable states, {mean:.0} ns on average, the slowest:");
    for (time, step) in worst {
        println!("{time:.0} ns  {step}");
    }
}

/// Time of one step with a copy of the state, the best of some batches.
fn nanoseconds(config: &Config, robot: &Robot, input: Input) -> f64 {
    let batch = || {
        let start = Instant::now();
        for _ in 0..BATCH {
            black_box(black_box(robot.clone()).step(config, black_box(input)));
        }
        start.elapsed().as_secs_f64() * 1e9 / f64::from(BATCH)
    };
    (0..BATCHES).map(|_| batch()).fold(f64::INFINITY, f64::min)
}

/// A leader of four with a command outstanding for each, all of whose timers run out at once.
fn everything_due(config: &Config) -> (Robot, Input) {
    let mut street = Street::new();
    street.crowd(config);
    for follower in 2..=5 {
        let order = Event::CommandManeuver {
            follower: StationId(follower),
            task: TaskType::MOVE,
        };
        street.robots[0].step(config, Input::Local(order));
    }
    assert!(
        matches!(street.robots[0].phase(), Phase::Leading(leading) if leading.members.len() == 4)
    );
    (street.robots[0].clone(), Input::Elapsed(Millis(600)))
}

/// Robots that hear each other, or not.
struct Street {
    robots: Vec<Robot>,
    inbox: Vec<Input>,
    seed: u64,
}

impl Street {
    fn new() -> Self {
        let robots = (1..).take(ROBOTS).map(|id| Robot::new(StationId(id), 1));
        Self {
            robots: robots.collect(),
            inbox: Vec::new(),
            seed: 1,
        }
    }

    /// The first leads all others, who have joined.
    fn crowd(&mut self, config: &Config) {
        self.robots[0].step(config, Input::Local(Event::PedestrianDetected(request(4))));
        for round in 0..4 {
            for from in 0..ROBOTS {
                let ram = self.ram(from);
                for to in (0..ROBOTS).filter(|to| *to != from) {
                    self.robots[to].step(config, ram);
                }
            }
            if round == 0 {
                self.robots[0].step(config, Input::Elapsed(Millis(300)));
            }
        }
    }

    fn ram(&self, from: usize) -> Input {
        Input::Ram {
            ram: self.robots[from].ram(),
            distance: Decimetres(40),
        }
    }

    fn random(&mut self, below: usize) -> usize {
        self.seed = self
            .seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        usize::try_from(self.seed >> 33).expect("31 bits") % below
    }

    /// Any input for a robot: mostly what others say, and time; at times an event.
    fn input(&mut self, to: usize) -> Input {
        match self.random(16) {
            0..=6 => {
                let from = self.random(ROBOTS);
                self.ram(from)
            }
            7..=8 if !self.inbox.is_empty() => {
                let at = self.random(self.inbox.len());
                self.inbox[at]
            }
            9..=12 => {
                let times = [10, 20, 100, 300, 600, 2_000, 60_000];
                let at = if self.random(20) == 0 { times.len() } else { 4 };
                Input::Elapsed(Millis(times[self.random(at)]))
            }
            _ => Input::Local(self.event(to)),
        }
    }

    fn event(&mut self, to: usize) -> Event {
        let task = [TaskType::INITIAL_POS, TaskType::MOVE, TaskType::BLOCK][self.random(3)];
        let running = match self.robots[to].phase() {
            Phase::Following(following) => following.executing(),
            _ => None,
        };
        let id: Option<ManeuverId> = running.map(|maneuver| maneuver.id);
        let follower = u32::try_from(self.random(ROBOTS) + 1).expect("a few");
        match (self.random(40), id) {
            (0..=2, _) => {
                let followers = u8::try_from(self.random(4) + 1).expect("a few");
                Event::PedestrianDetected(request(followers))
            }
            (3..=22, None) => Event::CommandManeuver {
                follower: StationId(follower),
                task,
            },
            (3..=10, Some(id)) => Event::ManeuverCompleted(id),
            (11, Some(id)) => Event::ManeuverFailed(id),
            (23..=28, _) => Event::OpenCorridor,
            (29, _) => Event::CloseCorridor,
            (12..=22, Some(id)) => Event::InPosition(id),
            (33..=35, _) => Event::RoadClear,
            (30, _) => Event::TaskCompleted,
            (31, _) => Event::LeaveRequested,
            (32, _) => {
                Event::AvailabilityChanged(Availability::Unavailable(Unavailability::LowBattery))
            }
            _ => Event::AvailabilityChanged(Availability::Available),
        }
    }

    fn hear(&mut self, outputs: &Outputs) {
        for output in outputs.iter() {
            if let Output::SendRmcm(rmcm) = output {
                self.inbox.push(Input::Rmcm(*rmcm));
            }
        }
        if self.inbox.len() > 8 {
            self.inbox.remove(0);
        }
    }
}

fn request(followers: u8) -> HelpRequest {
    HelpRequest {
        urgency: Urgency::Medium,
        followers,
        tasks: TaskSet::of(&[TaskType::INITIAL_POS, TaskType::MOVE, TaskType::BLOCK]),
        place: Place(7),
    }
}

fn walk(config: &Config, mut visit: impl FnMut(&Robot, Input)) {
    let mut street = Street::new();
    for i in 0..INPUTS {
        // Numbers of one boot are used up at some time; and sessions of all should come again.
        if i % 10_000 == 0 {
            street.robots = Street::new().robots;
            street.inbox.clear();
        }
        if i % 2_000 == 0 {
            street.crowd(config);
        }
        let to = street.random(ROBOTS);
        let input = street.input(to);
        visit(&street.robots[to], input);
        let outputs = street.robots[to].step(config, input);
        street.hear(&outputs);
    }
}
