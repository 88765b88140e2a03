//! The crossing machine with real robots, people, a sensor, a body, a sign and a vehicle, explored to the end by stateright.
//!
//! ```text
//!   people ──► sensor: misses, ids, blindness ──► Crossing ◄──► Robot   leader
//!      ▲                                                          │ good channel
//!    sign ◄───────────────────────────────────── Crossing ◄──► Robot   follower ──► body
//!      └───────────► truth: P1 to P3, P5 and P6, from people, bodies and the sign alone
//! ```
//!
//! Time passes in ticks of half a second. In each tick people and the vehicle move as they like, the sensor misses people
//! within the assumption `sees`, and at most one of the things happens that a [`Street`] allows. People step on the
//! carriageway under go alone, and are then on it for as long as they like, also beside the crossing. A vehicle, changes of
//! ids, hangs, blindness and drifts are bounded for a run, and no run is as long as `T_lock` or `T_exec`; nothing else is
//! bounded. `truth` judges, and shares nothing with the machine. P4, about escorts, needs finer geometry and is not here.

mod rules;
mod street;
mod team;
mod truth;

use std::time::{Duration, Instant};

use crossguard_crossing::Setup;
use stateright::{Checker, Model as _};

use rules::Rules;
use street::World;
pub use truth::{Rule, RuleClaim};

/// In how many consecutive frames the machines assume that the sensor misses somebody at most.
pub const MISS_MAX: u8 = 1;

/// What may happen in a run, and how often.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Street {
    /// How many people there are, at most two.
    pub people: u8,
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
}

impl Street {
    /// One person, and a sensor that misses as much as it may.
    pub const PERSON: Self = Self {
        people: 1,
        misses: MISS_MAX,
        id_changes: 0,
        hang: 0,
        blind: 0,
        drifts: 0,
        vehicle: false,
    };
}

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
    /// The rules whose premises were met.
    pub met: Vec<Rule>,
    /// How long it took.
    pub time: Duration,
}

/// Explores a street until nothing is left, or about `states_max` steps have been taken. `change` changes the settings of
/// both machines.
#[must_use]
pub fn explore(street: Street, change: fn(&mut Setup), states_max: usize) -> Found {
    let begin = Instant::now();
    let world = World {
        street,
        rules: Rules::new(change),
    };
    let checker = world.checker().threads(2).target_state_count(states_max);
    let checker = checker.spawn_bfs().join();
    let run = |rule: &Rule| {
        let path = checker.discovery(rule.claim().id)?;
        let states = path.into_states().into_iter();
        Some((*rule, states.map(|state| state.to_string()).collect()))
    };
    let is_met = |rule: &Rule| checker.discovery(rule.claim().premise_id).is_some();
    Found {
        states: checker.unique_state_count(),
        depth: checker.max_depth(),
        // stateright says that it is done where it stops at the limit as well.
        exhaustive: checker.state_count() < states_max,
        broken: Rule::ALL.iter().filter_map(run).collect(),
        met: Rule::ALL.into_iter().filter(is_met).collect(),
        time: begin.elapsed(),
    }
}
