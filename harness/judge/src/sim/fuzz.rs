//! Many runs, one for each seed, and what they amount to.

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};

use crossguard_model_check::node::{Protocol, Rules};
use crossguard_model_check::parallel::in_parallel;
use crossguard_robot::plan::Plan;
use crossguard_robot::transport::Faults;
use serde::Serialize;

use super::swarm::{Hazard, Swarm};
use super::times::Worst;
use super::world::{Finding, Outcome, Waits, run_with};

/// Setup of the runs.
#[derive(Clone, Copy, Debug)]
pub struct Fuzz<'a> {
    /// The first seed.
    pub first: u64,
    /// How many seeds.
    pub seeds: u64,
    /// How many robots at most.
    pub robots: usize,
    /// The faults of every way, in place of drawn ones.
    pub faults: Option<&'a Faults>,
    /// The plan of every leader, in place of a drawn one.
    pub plan: Option<&'a Planned>,
    /// In which share of the seeds, from 0 to 1, robots see people by sensors of their own.
    pub sensors: f64,
    /// In which share of the seeds, from 0 to 1, an insider lies.
    pub liars: f64,
    /// How many threads work.
    pub threads: usize,
    /// After how many failures it is enough.
    pub failures_max: usize,
}

impl Default for Fuzz<'_> {
    /// The first seed, with 6 robots at most and without sensors and liars, in one thread up to the first failure.
    fn default() -> Self {
        Self {
            first: 1,
            seeds: 1,
            robots: 6,
            faults: None,
            plan: None,
            sensors: 0.0,
            liars: 0.0,
            threads: 1,
            failures_max: 1,
        }
    }
}

/// A plan from a file.
#[derive(Clone, Debug)]
pub struct Planned {
    /// The plan.
    pub plan: Plan,
    /// The arguments of `crossguard fuzz` that say so.
    pub arguments: String,
}

/// A seed whose run was wrong.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct Failure {
    /// The seed.
    pub seed: u64,
    /// The fault.
    #[serde(flatten)]
    pub finding: Finding,
}

/// Totals of the runs.
#[derive(Clone, Debug, Default, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Totals {
    /// How many seeds were run.
    pub seeds: u64,
    /// How many of them showed something wrong.
    pub violations: u64,
    /// Which, in order.
    pub failures: Vec<Failure>,
    /// How many robots there were in all.
    pub robots: u64,
    /// How many steps of the transition function.
    pub steps: u64,
    /// How many packets were sent.
    pub packets: u64,
    /// How long the runs were together, in seconds of virtual time.
    pub virtual_s: u64,
    /// In how many runs the premise of each property was met, or a time of it measured.
    pub premises: BTreeMap<PropertyName, u64>,
    /// How many runs had each hazard.
    pub hazards: BTreeMap<Hazard, u64>,
    /// In how many runs each of these was not judged, because the faults of the run leave it open.
    pub left_out: BTreeMap<&'static str, u64>,
    /// The longest times in any run.
    pub worst: Worst,
    /// Crossings and waiting times of the people in front of sensors: of arrivals while there were faults, and after.
    pub people: [Waits; 2],
}

/// A property's id as a key.
type PropertyName = String;

impl Totals {
    fn add(&mut self, seed: u64, outcome: &Outcome) {
        self.seeds += 1;
        self.robots += outcome.robots as u64;
        self.steps += outcome.steps;
        self.packets += outcome.packets;
        self.virtual_s += outcome.virtual_ms / 1_000;
        self.worst.add(outcome.worst);
        for (all, waits) in self.people.iter_mut().zip(&outcome.waits) {
            all.add(waits);
        }
        for id in &outcome.premises {
            *self.premises.entry(id.clone()).or_default() += 1;
        }
        for hazard in &outcome.hazards {
            *self.hazards.entry(*hazard).or_default() += 1;
        }
        for name in &outcome.left_out {
            *self.left_out.entry(name).or_default() += 1;
        }
        if let Some(finding) = &outcome.finding {
            let finding = finding.clone();
            self.violations += 1;
            self.failures.push(Failure { seed, finding });
            self.failures.sort_by_key(|failure| failure.seed);
        }
    }
}

impl Fuzz<'_> {
    /// The swarm of a seed.
    #[must_use]
    pub fn swarm(&self, seed: u64) -> Swarm {
        let mut swarm = Swarm::draw(seed, self.robots, self.faults).with_sensors(self.sensors);
        if let Some(planned) = self.plan {
            swarm = swarm.with_plan(&planned.plan);
        }
        swarm.with_insider(self.liars)
    }

    /// The command that runs one seed alone.
    #[must_use]
    pub fn reproduce(&self, seed: u64) -> String {
        let robots = self.robots;
        let faults = self.faults.map(|faults| format!(" --faults '{faults}'"));
        let faults = faults.unwrap_or_default();
        let plan = self.plan.map(|it| format!(" {}", it.arguments));
        let plan = plan.unwrap_or_default();
        let swarm = self.swarm(seed);
        let liars = u8::from(swarm.insider.is_some());
        let sensors = u8::from(swarm.sensing.is_some());
        format!(
            "crossguard fuzz --seeds 1 --robots {robots} --seed {seed} --sensors {sensors} --liars {liars}{faults}{plan}"
        )
    }

    /// Runs all seeds. `progress` is told what they amount to so far; when it says `false`, what runs
    /// is ended and the rest is left out.
    pub fn run(&self, progress: &(dyn Fn(&Totals) -> bool + Sync)) -> Totals {
        self.run_with(&Protocol, progress)
    }

    /// [`run`](Self::run) with another transition function in place of the kit's.
    pub fn run_with(
        &self,
        rules: &'static dyn Rules,
        progress: &(dyn Fn(&Totals) -> bool + Sync),
    ) -> Totals {
        let mut totals = Totals::default();
        let seeds = usize::try_from(self.seeds).unwrap_or(usize::MAX);
        let seed = |number: usize| self.first.wrapping_add(number as u64);
        let run = |number| self.one(seed(number), rules);
        in_parallel(self.threads, seeds, run, |number, outcome| {
            totals.add(seed(number), &outcome);
            progress(&totals) && totals.failures.len() < self.failures_max
        });
        totals
    }

    /// One run; a panic in it is a finding as well.
    fn one(&self, seed: u64, rules: &'static dyn Rules) -> Outcome {
        let swarm = self.swarm(seed);
        let outcome = catch_unwind(AssertUnwindSafe(|| run_with(&swarm, rules, None)));
        outcome.unwrap_or_else(|_| Outcome {
            finding: Some(Finding {
                property: "panic".to_owned(),
                statement: "nothing panics; what did is on standard error".to_owned(),
                at_ms: 0,
                robot: String::new(),
            }),
            robots: swarm.robots.len(),
            hazards: swarm.hazards().collect(),
            ..Outcome::default()
        })
    }
}
