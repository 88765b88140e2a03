//! A walk shows what the model does, and is followed again like a counterexample.

use crossguard_model_check::model::Model;
use crossguard_model_check::names::Names;
use crossguard_model_check::scenario::{Bounds, Scenario};
use crossguard_model_check::sequence::{ChartPlace, ChartStep, Fate};
use crossguard_model_check::walk::{Chances, Goal, PersonFrame, Stray, Walk, next_step, search};
use crossguard_protocol::{Role, State};

fn scenario(name: &str) -> Scenario {
    Scenario::load(name).unwrap()
}

/// Goes on with the first step that `is_wanted`, until there is none.
fn walk(
    name: &str,
    steps_max: usize,
    mut is_wanted: impl FnMut(&ChartStep) -> bool,
) -> (Vec<ChartStep>, Walk) {
    let mut steps = Vec::new();
    loop {
        let walk = Walk::along(scenario(name), &steps);
        assert_eq!(walk.stray, None);
        assert_eq!(walk.frames.len(), steps.len() + 1);
        let next = walk.possible.iter().find(|step| is_wanted(step));
        match next {
            Some(step) if steps.len() < steps_max => steps.push(step.clone()),
            _ => return (steps, walk),
        }
    }
}

#[test]
fn what_may_happen_is_what_the_model_lets_happen() {
    let model = Model::new(scenario("pair"));
    let mut state = model.initial();
    let mut steps = Vec::new();
    for choice in [0, 1, 2, 1, 0, 3, 1, 0, 2, 1] {
        let mut actions = Vec::new();
        model.actions_in(&state, &mut actions);
        actions.retain(|action| model.successor(&state, *action).is_some());
        let walk = Walk::along(model.scenario().clone(), &steps);
        assert_eq!(walk.possible.len(), actions.len());
        let choice = choice % actions.len();
        steps.push(walk.possible[choice].clone());
        state = model.successor(&state, actions[choice]).unwrap().0;
        let names = Names::of(model.scenario());
        let walk = Walk::along(model.scenario().clone(), &steps);
        let words = walk
            .frames
            .last()
            .unwrap()
            .robots
            .iter()
            .map(|it| &it.words);
        let told: Vec<_> = model.nodes(&state).map(|it| names.tell(it)).collect();
        assert!(words.eq(&told), "{told:?}");
    }
}

#[test]
fn a_lost_request_is_on_air_and_then_gone() {
    let (steps, walk) = walk("pair", 1, |step| step.action.contains("detect"));
    let frame = walk.frames.last().unwrap();
    assert_eq!(frame.robots[0].state, "HelpRequested");
    assert_eq!(frame.robots[0].role, "requester");
    assert_eq!((frame.on_air.len(), frame.on_air[0].to), (1, 1));
    let is_lost =
        |place: ChartPlace| matches!(place, ChartPlace::Between { fate, .. } if fate == Fate::Lost);
    let lost = walk.possible.iter().find(|step| is_lost(step.place));
    let steps = [steps, vec![lost.unwrap().clone()]].concat();
    let frame = Walk::along(scenario("pair"), &steps).frames.pop().unwrap();
    assert!(frame.on_air.is_empty());
    assert_eq!(frame.robots[1].state, "Idle");
    assert_eq!(frame.left.losses, Some(0));
}

#[test]
fn a_step_that_cannot_happen_ends_the_walk_with_its_number() {
    let (mut steps, _) = walk("pair", 4, |_| true);
    steps[2].action = "timer Nobody expires".to_owned();
    let walk = Walk::along(scenario("pair"), &steps);
    let cannot = Stray {
        step: 2,
        puts_out: None,
    };
    assert_eq!((walk.stray, walk.frames.len()), (Some(cannot), 3));

    let (mut steps, _) = walk_to_offer();
    let outputs = std::mem::replace(&mut steps[0].outputs, vec!["sends nothing".to_owned()]);
    let walk = Walk::along(scenario("pair"), &steps);
    let otherwise = Stray {
        step: 0,
        puts_out: Some(outputs),
    };
    assert_eq!(walk.stray, Some(otherwise));
}

fn walk_to_offer() -> (Vec<ChartStep>, Walk) {
    walk("pair", 2, |step| !step.action.contains("change"))
}

#[test]
fn the_search_finds_a_shortest_way_and_the_walk_gets_there() {
    let leads = Goal::Robot {
        place: 0,
        state: State::RoleEstablished,
        role: Some(Role::Leader),
    };
    let found = search(scenario("crossing"), leads, 100_000);
    let steps = found.steps.unwrap();
    let walk = Walk::along(scenario("crossing"), &steps);
    let is_there = |frame: &crossguard_model_check::walk::WalkFrame| {
        (frame.robots[0].state, frame.robots[0].role) == ("RoleEstablished", "leader")
    };
    assert!(is_there(walk.frames.last().unwrap()));
    assert!(!walk.frames[..steps.len()].iter().any(is_there));

    // A blockade guards from its place, and an escort by going with the person.
    for (name, escorts) in [("crossing", false), ("pair", true)] {
        let found = search(scenario(name), Goal::PersonOnRoad, 100_000);
        let walk = Walk::along(scenario(name), &found.steps.unwrap());
        let frame = walk.frames.last().unwrap();
        assert_eq!(frame.person, PersonFrame::OnRoad(Some(0)));
        assert!(frame.robots[0].shows_go);
        let other = &frame.robots[1];
        assert_eq!((other.guards, other.escorts), (true, escorts));
        assert!(frame.met.contains(&"W1"), "{:?}", frame.met);
    }
}

#[test]
fn a_search_says_whether_it_has_seen_everything() {
    // The robot dog detects nobody, so it never asks.
    let asks = Goal::Robot {
        place: 1,
        state: State::HelpRequested,
        role: Some(Role::Requester),
    };
    let found = search(scenario("crossing"), asks, 100_000);
    assert!(found.steps.is_none() && found.is_complete);
    let found = search(scenario("crossing"), asks, 50);
    assert!(found.steps.is_none() && !found.is_complete);
}

/// Hazard: the page that lets the protocol run by itself never shows anybody cross.
#[test]
fn a_run_by_itself_shows_a_person_cross_and_ends() {
    const STEPS_MAX: usize = 400;
    let cross = |name: &str, seed| {
        let mut steps = Vec::new();
        let mut was_on_road = false;
        let chances = Chances {
            seed,
            loss: 20,
            delay: 10,
            breakdowns: false,
        };
        while let Some(step) = next_step(roomy(name), &steps, chances) {
            was_on_road |= step.action.contains("steps on the road");
            steps.push(step);
            if steps.len() > STEPS_MAX {
                return (was_on_road, None);
            }
        }
        (was_on_road, Some(steps.len()))
    };
    for name in ["pair", "bilateral", "trio-corridor"] {
        let runs: Vec<_> = (1..=20).map(|seed| cross(name, seed)).collect();
        let crossed = runs.iter().filter(|(was_on_road, _)| *was_on_road).count();
        let ended = runs.iter().filter(|(_, ended)| ended.is_some()).count();
        assert!(crossed >= 19 && ended >= 18, "{name}: {runs:?}");
    }
}

/// A scenario of the kit in which things may happen as often as in the page.
fn roomy(name: &str) -> Scenario {
    let mut scenario = scenario(name);
    scenario.bounds = Bounds {
        detections: 200,
        commands: 200,
        disturbances: 200,
        ..Bounds::default()
    };
    scenario
}
