//! Results of `crossguard odds` against frequencies: real endpoints with real packets in virtual time, and a radio that
//! loses packets by the throw of a die. Nothing of the Markov model has a part in it.

use crossguard_codec::{Identifiers, RobotState};
use crossguard_endpoint::{Effect, Endpoint, Moment, Stimulus};
use crossguard_protocol::{
    Config, Corridor, Event, HelpRequest, Member, Output, Phase, Place, Robot, StationId, TaskSet,
    TaskType, Urgency,
};
use crossguard_testkit::command::*;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde_json::Value;

const LOSS: f64 = 0.4;

/// Behaviour of packets and clocks.
#[derive(Clone, Copy)]
struct Air {
    /// The shortest time of a packet, too; the longest is that of the model.
    tick_ms: u64,
    /// How much faster the clock of each robot runs, in millionths. The first two are as far off as the settings allow.
    drift_ppm: [i64; 3],
}

const DELAY_MS: u64 = 50;

/// As the model assumes.
const EXACT: Air = Air {
    tick_ms: DELAY_MS,
    drift_ppm: [0; 3],
};

/// Jitter that reorders packets, and clocks that drift apart.
const ROUGH: Air = Air {
    tick_ms: 10,
    drift_ppm: [1_000, -1_000, 0],
};

/// A packet on its way to one robot.
struct Flying {
    at_ms: u64,
    to: usize,
    packet: Vec<u8>,
}

/// A team whose packets get lost.
struct Street {
    air: Air,
    robots: Vec<Endpoint>,
    flying: Vec<Flying>,
    dice: ChaCha8Rng,
    now_ms: u64,
    fell_back: bool,
}

impl Street {
    fn new(air: Air, seed: u64, followers: u32) -> Self {
        let start = |station| {
            let robot = Robot::new(StationId(station), 1);
            Endpoint::new(robot, Config::default(), Identifiers::default(), 0)
        };
        Self {
            air,
            robots: (1..=followers + 1).map(start).collect(),
            flying: Vec::new(),
            dice: ChaCha8Rng::seed_from_u64(seed),
            now_ms: 0,
            fell_back: false,
        }
    }

    /// The clock of a robot, in ms from the beginning.
    fn clock_ms(&self, me: usize) -> u64 {
        let now_ms = i64::try_from(self.now_ms).unwrap();
        u64::try_from(now_ms + now_ms * self.air.drift_ppm[me] / 1_000_000).unwrap()
    }

    fn handle(&mut self, me: usize, stimulus: Stimulus<'_>) {
        let moment = Moment::after(694_694_400_000, self.clock_ms(me));
        for effect in self.robots[me].handle(moment, &RobotState::default(), stimulus) {
            match effect {
                Effect::Transmit { packet, .. } => {
                    for to in (0..self.robots.len()).filter(|to| *to != me) {
                        if !self.dice.random_bool(LOSS) {
                            let ticks = 1..=DELAY_MS / self.air.tick_ms;
                            let delay_ms = self.dice.random_range(ticks) * self.air.tick_ms;
                            let (at_ms, packet) = (self.now_ms + delay_ms, packet.clone());
                            self.flying.push(Flying { at_ms, to, packet });
                        }
                    }
                }
                Effect::Act(Output::FallBack(..), _) => self.fell_back = true,
                _ => {}
            }
        }
    }

    fn tick(&mut self) {
        self.now_ms += self.air.tick_ms;
        for me in 0..self.robots.len() {
            self.handle(me, Stimulus::Time);
        }
        let now_ms = self.now_ms;
        let (due, rest) = std::mem::take(&mut self.flying)
            .into_iter()
            .partition(|it: &Flying| it.at_ms <= now_ms);
        self.flying = rest;
        for Flying { to, packet, .. } in due {
            let arrived_ms = self.clock_ms(to);
            let packet = &packet;
            self.handle(to, Stimulus::Datagram { packet, arrived_ms });
        }
    }

    fn phase(&self, me: usize) -> &Phase {
        self.robots[me].robot().phase()
    }

    fn is_team(&self) -> bool {
        let followers = self.robots.len() - 1;
        matches!(self.phase(0), Phase::Leading(it)
            if it.members.len() == followers && it.members.iter().all(Member::has_joined))
    }

    fn is_acknowledged(&self) -> bool {
        matches!(self.phase(0), Phase::Leading(it) if it.members.len() == self.robots.len() - 1
            && it.members.iter().all(|member| member.outstanding.is_none() && member.order.is_some()))
    }

    fn has_jobs(&self) -> bool {
        (1..self.robots.len())
            .all(|me| matches!(self.phase(me), Phase::Following(it) if it.job.is_some()))
    }

    fn is_open(&self) -> bool {
        matches!(self.phase(0), Phase::Leading(it) if it.corridor == Corridor::Open)
    }
}

/// When what was reached in a run, in ms from the beginning of its stage.
#[derive(Default)]
struct Reached {
    team: Option<u64>,
    received: Option<u64>,
    acknowledged: Option<u64>,
    open: Option<u64>,
    interrupted: Option<u64>,
}

fn run(air: Air, seed: u64, followers: u32) -> Reached {
    let mut street = Street::new(air, seed, followers);
    let mut reached = Reached::default();
    // The helpers are there already, and have said so: what they say is not counted here.
    let request = HelpRequest {
        urgency: Urgency::Medium,
        followers: u8::try_from(followers).unwrap(),
        tasks: TaskSet::of(&[TaskType::MOVE]),
        place: Place(1),
    };
    street.handle(0, Stimulus::Event(Event::PedestrianDetected(request)));
    while !street.is_team() {
        street.tick();
        if matches!(street.phase(0), Phase::Idle) {
            return reached;
        }
    }
    reached.team = Some(street.now_ms);
    let began_ms = street.now_ms;
    for follower in 0..followers {
        let follower = StationId(follower + 2);
        let task = TaskType::MOVE;
        let command = Event::CommandManeuver { follower, task };
        street.handle(0, Stimulus::Event(command));
    }
    let since = |street: &Street| Some(street.now_ms - began_ms);
    while !street.is_open() {
        street.tick();
        if reached.received.is_none() && street.has_jobs() {
            reached.received = since(&street);
        }
        let is_led = matches!(street.phase(0), Phase::Leading(it) if it.members.len() == street.robots.len() - 1);
        if !is_led || street.fell_back {
            return reached;
        }
        if street.is_acknowledged() {
            reached.acknowledged = reached.acknowledged.or(since(&street));
            street.handle(0, Stimulus::Event(Event::OpenCorridor));
        }
    }
    reached.open = since(&street);
    let opened_ms = street.now_ms;
    while street.now_ms < opened_ms + HOLD_MS {
        street.tick();
        if !street.is_open() {
            reached.interrupted = Some(street.now_ms - opened_ms);
            break;
        }
    }
    reached
}

const HOLD_MS: u64 = 5_000;

/// How many standard deviations a frequency may be off: of 26 frequencies hardly one in a thousand runs is beyond, and
/// the seeds are always the same.
const DEVIATIONS: f64 = 4.0;

/// The probability that a milestone has been reached by `ms`, as the command says it.
fn said(report: &Value, milestone: &str, ms: u64) -> f64 {
    let milestones = report["losses"][0]["milestones"].as_array().unwrap();
    let of = milestones
        .iter()
        .find(|it| it["milestone"] == milestone)
        .unwrap();
    let points = of["distribution"].as_array().unwrap();
    let before = points
        .iter()
        .rev()
        .find(|point| point["ms"].as_u64().unwrap() <= ms);
    before.map_or(0.0, |point| point["lower"].as_f64().unwrap())
}

/// Compares the frequencies of events with what the command says of them. In rough air each milestone is reached as often, and
/// at most a tick of the model later.
fn compare(air: Air, followers: u32, seeds: u64) {
    let odds = format!("odds --loss {LOSS} --hold {HOLD_MS} --followers {followers} --json");
    let report = json(&run_well(&odds));
    let runs: Vec<Reached> = (0..seeds).map(|seed| run(air, seed, followers)).collect();
    let is_exact = air.tick_ms == EXACT.tick_ms;
    let late_ms = EXACT.tick_ms - air.tick_ms;
    let mut wrong = Vec::new();
    let mut judge = |milestone: &str,
                     ms: u64,
                     began: fn(&Reached) -> bool,
                     when: fn(&Reached) -> Option<u64>| {
        let begun: Vec<_> = runs.iter().filter(|run| began(run)).collect();
        let count = begun
            .iter()
            .filter(|run| when(run).is_some_and(|at| at <= ms + late_ms))
            .count();
        #[expect(clippy::cast_precision_loss, reason = "runs are few")]
        let (count, all) = (count as f64, begun.len() as f64);
        let (frequency, probability) = (count / all, said(&report, milestone, ms));
        let deviation = (probability * (1.0 - probability) / all).sqrt();
        let line = format!(
            "{milestone} within {ms} ms: {frequency:.5} of {all} runs, said {probability:.5}, {:.2} deviations off",
            (frequency - probability) / deviation.max(1e-12)
        );
        println!("{line}");
        // A run more or less does not matter where hardly any is expected.
        let off = frequency - probability;
        let off = match milestone {
            _ if is_exact => off.abs(),
            "interrupted" => off,
            _ => -off,
        };
        if off > DEVIATIONS * deviation + 1.0 / all {
            wrong.push(line);
        }
    };
    for ms in [200, 300, 400, 500, 700, 1_000, 2_000] {
        judge("team", ms, |_| true, |run| run.team);
    }
    let has_team = |run: &Reached| run.team.is_some();
    for ms in [50, 650, 1_250, 1_850] {
        judge("received", ms, has_team, |run| run.received);
    }
    for ms in [100, 150, 250, 700, 1_300, 3_000] {
        judge("acknowledged", ms, has_team, |run| run.acknowledged);
        judge("open", ms, has_team, |run| run.open);
    }
    for ms in [2_000, 3_500, HOLD_MS] {
        let was_open = |run: &Reached| run.open.is_some();
        judge("interrupted", ms, was_open, |run| run.interrupted);
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

fn seeds() -> u64 {
    let seeds = std::env::var("CROSSGUARD_SEEDS").ok();
    seeds.map_or(400, |seeds| seeds.parse().expect("a number of seeds"))
}

#[test]
fn endpoints_of_a_pair_do_as_often_as_the_odds_say() {
    compare(EXACT, 1, seeds());
}

#[test]
fn endpoints_of_a_trio_do_as_often_as_the_odds_say() {
    compare(EXACT, 2, seeds());
}

#[test]
fn jitter_and_drift_make_endpoints_of_a_trio_no_worse_than_the_odds_say() {
    compare(ROUGH, 2, seeds());
}
