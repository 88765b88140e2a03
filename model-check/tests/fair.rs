//! The leads-to check, on small systems whose verdicts are known.

use std::collections::{HashMap, VecDeque};

use crossguard_model_check::fair::{Classes, Edge, Fairness, Lasso, LeadsTo, System, leads_to};
use proptest::prelude::*;

/// Transitions as (from, to, class); each class enabled where one of its transitions begins.
#[derive(Clone, Debug)]
struct Small {
    states: u32,
    transitions: Vec<(u32, u32, Classes)>,
}

const NONE: Classes = Classes::NONE;
const A: Classes = Classes::one(0);
const B: Classes = Classes::one(1);

fn system(states: u32, transitions: &[(u32, u32, Classes)]) -> Small {
    Small {
        states,
        transitions: transitions.to_vec(),
    }
}

impl System for Small {
    fn states(&self) -> u32 {
        self.states
    }

    fn edge(&self, state: u32, place: usize) -> Option<Edge> {
        let mut out = self.transitions.iter().filter(|(from, ..)| *from == state);
        let &(_, to, taken) = out.nth(place)?;
        Some(Edge { to, taken })
    }

    fn enabled(&self, state: u32) -> Classes {
        let out = self.transitions.iter().filter(|(from, ..)| *from == state);
        out.fold(NONE, |all, &(_, _, taken)| all | taken)
    }

    fn run_to(&self, state: u32) -> Vec<u32> {
        let mut came_from = HashMap::from([(0, 0)]);
        let mut todo = VecDeque::from([0]);
        while let Some(at) = todo.pop_front() {
            for &(_, to, _) in self.transitions.iter().filter(|(from, ..)| *from == at) {
                came_from.entry(to).or_insert_with(|| {
                    todo.push_back(to);
                    at
                });
            }
        }
        let mut run = vec![state];
        while run[run.len() - 1] != 0 {
            run.push(came_from[&run[run.len() - 1]]);
        }
        run.reverse();
        run
    }
}

const UNFAIR: Fairness = Fairness {
    weak: NONE,
    strong: NONE,
};

/// Whether the start of `system` leads to `goal`.
fn check(system: &Small, fairness: Fairness, goal: u32) -> LeadsTo {
    let result = leads_to(system, fairness, |state| state == 0, |state| state == goal);
    if let LeadsTo::Broken(lasso) = &result {
        assert_is_fair_run(system, fairness, goal, lasso);
    }
    result
}

fn holds(system: &Small, fairness: Fairness, goal: u32) -> bool {
    match check(system, fairness, goal) {
        LeadsTo::Holds => true,
        LeadsTo::Broken(_) => false,
        LeadsTo::Vacuous => panic!("state 0 is there"),
    }
}

/// Asserts that a lasso is a run of the system, avoids the goal, and is fair, by the definitions.
fn assert_is_fair_run(system: &Small, fairness: Fairness, goal: u32, lasso: &Lasso) {
    let has = |from: u32, to: u32, taken: Option<Classes>| {
        system
            .transitions
            .iter()
            .any(|t| t.0 == from && t.1 == to && taken.is_none_or(|taken| t.2 == taken))
    };
    assert_eq!(lasso.stem[0], 0);
    for pair in lasso.stem.windows(2) {
        assert!(has(pair[0], pair[1], None), "{lasso:?}");
    }
    let entry = lasso.stem[lasso.stem.len() - 1];
    let (mut at, mut seen, mut taken) = (entry, vec![entry], NONE);
    for edge in &lasso.cycle {
        assert!(has(at, edge.to, Some(edge.taken)), "{lasso:?}");
        at = edge.to;
        seen.push(at);
        taken |= edge.taken;
    }
    assert_eq!(at, entry, "the cycle comes back: {lasso:?}");
    assert!(lasso.stem.iter().chain(&seen).all(|&state| state != goal));
    let enabled = |state: u32| system.enabled(state);
    for class in [A, B] {
        let is_taken = taken & class != NONE;
        let always = seen.iter().all(|&state| enabled(state) & class != NONE);
        let sometimes = seen.iter().any(|&state| enabled(state) & class != NONE);
        assert!(is_taken || !always || fairness.weak & class == NONE);
        assert!(is_taken || !sometimes || fairness.strong & class == NONE);
    }
}

#[test]
fn what_is_never_visited_says_nothing() {
    let two = system(2, &[(0, 1, A)]);
    let result = leads_to(&two, UNFAIR, |_| false, |_| true);
    assert_eq!(result, LeadsTo::Vacuous);
}

/// Whether some fair run from state 0 avoids `goal`, by trying out every set of states and
/// transitions that a run could repeat for ever.
fn breaks_by_brute_force(system: &Small, fairness: Fairness, goal: u32) -> bool {
    let inside: Vec<_> = system
        .transitions
        .iter()
        .filter(|t| t.0 != goal && t.1 != goal)
        .collect();
    let mut reached = vec![false; system.states as usize];
    reached[0] = goal != 0;
    for _ in 0..system.states {
        for t in &inside {
            reached[t.1 as usize] |= reached[t.0 as usize];
        }
    }
    (1_u32..1 << system.states).any(|set| {
        let member = |state: u32| set >> state & 1 == 1;
        let members: Vec<u32> = (0..system.states).filter(|&s| member(s)).collect();
        if !members.iter().all(|&s| reached[s as usize]) {
            return false;
        }
        let within: Vec<_> = inside
            .iter()
            .filter(|t| member(t.0) && member(t.1))
            .collect();
        let connected = members.iter().all(|&from| {
            let mut seen = 1_u32 << from;
            for _ in 0..system.states {
                for t in &within {
                    seen |= (seen >> t.0 & 1) << t.1;
                }
            }
            seen & set == set
        });
        let taken = within.iter().fold(NONE, |all, t| all | t.2);
        let enabled = |s: u32| system.enabled(s);
        let always = members.iter().fold(!NONE, |all, &s| all & enabled(s));
        let sometimes = members.iter().fold(NONE, |all, &s| all | enabled(s));
        connected
            && fairness.weak & always & !taken == NONE
            && fairness.strong & sometimes & !taken == NONE
    })
}

proptest! {
    #[test]
    fn verdicts_are_those_of_brute_force(
        transitions in proptest::collection::vec((0_u32..6, 0_u32..6, 0_u128..4), 1..14),
        weak in 0_u128..4,
        strong in 0_u128..4,
        goal in 1_u32..6,
    ) {
        // State 0 has a transition to all others, so that all are reached.
        let to_all = (1..6).map(|to| (0, to, NONE));
        let transitions: Vec<_> = transitions
            .into_iter()
            .map(|(from, to, class)| (from, to, Classes::from_bits_retain(class)))
            .chain(to_all)
            .collect();
        let small = Small { states: 6, transitions };
        let fairness = Fairness { weak: Classes::from_bits_retain(weak), strong: Classes::from_bits_retain(strong) };
        let broken = !holds(&small, fairness, goal);
        prop_assert_eq!(broken, breaks_by_brute_force(&small, fairness, goal));
    }
}
