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
const A: Classes = Classes(1);
const B: Classes = Classes(2);

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

fn weak(classes: Classes) -> Fairness {
    Fairness {
        weak: classes,
        strong: NONE,
    }
}

fn strong(classes: Classes) -> Fairness {
    Fairness {
        weak: NONE,
        strong: classes,
    }
}

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

#[test]
fn a_run_may_stutter_unless_fairness_forbids_it() {
    let two = system(2, &[(0, 1, A)]);
    assert!(!holds(&two, UNFAIR, 1));
    assert!(holds(&two, weak(A), 1));
    assert!(holds(&two, strong(A), 1));
}

#[test]
fn a_state_without_a_way_out_is_a_stutter() {
    let dead_end = system(3, &[(0, 1, A), (0, 2, A)]);
    assert!(!holds(&dead_end, strong(A), 1));
}

#[test]
fn a_cycle_in_which_the_class_is_always_enabled_is_unfair() {
    // 0 and 1 may go round for ever, and A leads out of both.
    let ring = system(3, &[(0, 1, B), (1, 0, B), (0, 2, A), (1, 2, A)]);
    assert!(!holds(&ring, UNFAIR, 2));
    assert!(!holds(&ring, weak(B), 2));
    assert!(holds(&ring, weak(A), 2));
}

#[test]
fn a_cycle_in_which_the_class_is_enabled_now_and_then_is_unfair_only_strongly() {
    let ring = system(3, &[(0, 1, B), (1, 0, B), (1, 2, A)]);
    assert!(!holds(&ring, weak(A | B), 2));
    // Under strong fairness to A alone the run may still stutter in 0.
    assert!(!holds(&ring, strong(A), 2));
    let moving = Fairness { weak: B, strong: A };
    assert!(holds(&ring, moving, 2));
}

#[test]
fn a_fair_cycle_inside_a_larger_component_is_found() {
    // The whole is one component that enables A in 2; the fair cycle is 0 and 1 alone.
    let nested = system(
        4,
        &[(0, 1, B), (1, 0, B), (1, 2, NONE), (2, 0, NONE), (2, 3, A)],
    );
    let fairness = Fairness { weak: B, strong: A };
    let LeadsTo::Broken(lasso) = check(&nested, fairness, 3) else {
        panic!("0 and 1 go round for ever, and never enable A");
    };
    assert!(lasso.cycle.iter().all(|edge| edge.to != 2), "{lasso:?}");
}

#[test]
fn a_cycle_behind_a_join_is_found() {
    // Two ways lead to 3, and one of them visits the goal first. stateright's `eventually` remembers
    // for each state only the way on which it was first found, and so overlooks the other.
    let join = system(
        5,
        &[
            (0, 1, A),
            (0, 2, A),
            (1, 4, A),
            (4, 3, A),
            (2, 3, A),
            (3, 3, A),
        ],
    );
    assert!(!holds(&join, strong(A), 4));
}

#[test]
fn a_goal_on_every_way_is_reached() {
    let diamond = system(4, &[(0, 1, A), (0, 2, B), (1, 3, A), (2, 3, B)]);
    assert!(holds(&diamond, weak(A | B), 3));
    assert!(!holds(&diamond, weak(A), 3), "2 may be left by B alone");
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
            .map(|(from, to, class)| (from, to, Classes(class)))
            .chain(to_all)
            .collect();
        let small = Small { states: 6, transitions };
        let fairness = Fairness { weak: Classes(weak), strong: Classes(strong) };
        let broken = !holds(&small, fairness, goal);
        prop_assert_eq!(broken, breaks_by_brute_force(&small, fairness, goal));
    }
}
