//! The crossing machine with real robots, people, sensors, bodies and a vehicle, explored to the end.
//!
//! ```text
//!   people ──► sensor: misses, ids, lag, blindness ──► Crossing ◄──► Robot   leader
//!      ▲                                                               │ good channel
//!    sign ◄────────────────────────────────────────── Crossing ◄──► Robot   follower ──► body
//!      └───────────► truth: P1 to P3, P5 and P6, from people, bodies and the sign alone
//! ```
//!
//! Time passes in ticks of half a second. In each tick people and the vehicle move as they like, the sensor misses people
//! within the assumption `sees`, and what else a [`Scenario`] allows goes wrong. People step on the carriageway
//! under go alone, and are then on it for as long as they like, also beside the crossing. A run ends when everybody is
//! idle after the session: what follows is the same again. Heartbeats are taken relative to each other, and the
//! limits of a lock and of a command count as far away; nothing else is bounded.
//!
//! `truth` judges, and shares nothing with the machine. P4, about escorts, needs continuous geometry and is not here.

mod team;
mod truth;
mod world;

use std::time::{Duration, Instant};

use crossguard_crossing::Setup;
use stateright::{Checker, Model as _};

pub use truth::{Premise, Rule};
use world::Street;

/// What may go wrong in a run, and how often.
#[derive(Clone, Copy, Debug)]
pub struct Scenario {
    /// Its name.
    pub name: &'static str,
    /// How many people there are.
    pub people: usize,
    /// In how many consecutive frames the sensor misses somebody at most.
    pub misses: u8,
    /// How often ids change, or are swapped.
    pub id_changes: u8,
    /// How many ticks the leader's process hangs in all.
    pub hang: u8,
    /// How many ticks the sensor delivers nothing in all.
    pub blind: u8,
    /// How often the guard drifts off its place, or does not know any more where it is.
    pub drifts: u8,
    /// Whether a vehicle comes along.
    pub vehicle: bool,
    /// What is changed in the settings of both machines.
    pub change: fn(&mut Setup),
}

impl Scenario {
    /// One person, and a sensor that misses as much as it may.
    pub const PERSON: Self = Self {
        name: "a person",
        people: 1,
        misses: MISS_MAX,
        id_changes: 0,
        hang: 0,
        blind: 0,
        drifts: 0,
        vehicle: false,
        change: |_| (),
    };

    /// The scenarios in which every rule holds.
    pub const ALL: [Self; 7] = [
        Self::PERSON,
        Self {
            name: "ids change",
            id_changes: 2,
            ..Self::PERSON
        },
        Self {
            name: "a hang of two ticks",
            hang: 2,
            ..Self::PERSON
        },
        Self {
            name: "a sensor goes blind",
            blind: 2,
            ..Self::PERSON
        },
        Self {
            name: "a guard drifts",
            drifts: 1,
            ..Self::PERSON
        },
        Self {
            name: "a car",
            vehicle: true,
            ..Self::PERSON
        },
        Self {
            name: "two people",
            people: 2,
            ..Self::PERSON
        },
    ];
}

/// How many consecutive frames the sensors of a scenario may miss somebody in, as their machines assume.
pub const MISS_MAX: u8 = 1;

/// What an exploration found.
#[derive(Clone, Debug)]
pub struct Found {
    /// Distinct states.
    pub states: usize,
    /// Steps from the first to the farthest of them.
    pub depth: usize,
    /// Whether every state was explored.
    pub exhaustive: bool,
    /// The rules that are broken, each with a shortest run, as states in words.
    pub broken: Vec<(Rule, Vec<String>)>,
    /// The premises that were reached.
    pub reached: Vec<Premise>,
    /// How long it took.
    pub time: Duration,
}

/// Explores a scenario to the end.
#[must_use]
pub fn explore(scenario: &Scenario) -> Found {
    let begin = Instant::now();
    let street = Street::new(*scenario);
    let checker = street.checker().threads(2).spawn_bfs().join();
    let run = |rule: &Rule| {
        let path = checker.discovery(rule.name())?;
        let states = path.into_states().into_iter();
        Some((*rule, states.map(|state| state.to_string()).collect()))
    };
    let is_reached = |premise: &Premise| checker.discovery(premise.name()).is_some();
    Found {
        states: checker.unique_state_count(),
        depth: checker.max_depth(),
        exhaustive: checker.is_done(),
        broken: Rule::ALL.iter().filter_map(run).collect(),
        reached: Premise::ALL.into_iter().filter(is_reached).collect(),
        time: begin.elapsed(),
    }
}
