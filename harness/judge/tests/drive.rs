//! Runs of the model checker, taken by real endpoints with real octets: after every step the robots are
//! as the model says.

use crossguard_judge::drive::{Disagreement, drive};
use crossguard_model_check::check::{Options, check};
use crossguard_model_check::model::{Action, Delivery, Model};
use crossguard_model_check::node::Rules;
use crossguard_model_check::properties::PropertyId;
use crossguard_model_check::replay::{Followed, Replay};
use crossguard_model_check::scenario::Scenario;
use crossguard_protocol::*;
use crossguard_testkit::rules::StartsRepeatedCommands;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

fn model(name: &str) -> Model {
    Model::new(Scenario::load(name).unwrap())
}

/// A run through a model that chooses at random, but mostly lets a message arrive at once. It goes on until
/// nothing can happen any more, or for this many steps.
fn walk(model: &Model, seed: u64, steps: usize) -> Vec<Action> {
    let mut state = model.initial();
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let (mut actions, mut run) = (Vec::new(), Vec::new());
    while run.len() < steps {
        actions.clear();
        model.actions_in(&state, &mut actions);
        actions.retain(|action| model.successor(&state, *action).is_some());
        if actions.is_empty() {
            break;
        }
        let arrives = matches!(
            actions[0],
            Action::Deliver {
                how: Delivery::AtOnce,
                ..
            }
        );
        let action = if arrives && random.random_bool(0.9) {
            actions[0]
        } else {
            actions[random.random_range(0..actions.len())]
        };
        state = model.successor(&state, action).unwrap().0;
        run.push(action);
    }
    run
}

#[test]
fn random_runs_of_every_scenario_are_those_of_endpoints() {
    for name in Scenario::shipped() {
        let scenario = Scenario::load(name).unwrap();
        // On a monotone channel messages that differ in names alone cannot be told apart here, and insiders that lie
        // are no endpoints.
        let lies = scenario.liars().next().is_some();
        if scenario.timed.is_some() || scenario.channel.monotone || lies {
            continue;
        }
        let model = Model::new(scenario);
        let (mut datagrams, mut starts) = (0, 0);
        for seed in 0..800 {
            let replay = Replay::along(&model, &walk(&model, seed, 150));
            let driven = drive(&model, &replay);
            if let Some(disagreement) = &driven.disagreement {
                let step = replay.steps[driven.steps].clone();
                panic!(
                    "{name}, seed {seed}, step {}: {step:?}: {disagreement}",
                    driven.steps
                );
            }
            assert_eq!(driven.steps, replay.steps.len());
            assert_eq!(driven.followed, Followed::ToTheEnd(Vec::new()));
            datagrams += driven.datagrams;
            let outputs = replay.steps.iter().flat_map(|step| &step.outputs);
            starts += outputs.filter(|output| output.starts_with("start")).count();
        }
        assert!(datagrams > 1_000, "{name}: {datagrams}");
        let commands = model.scenario().bounds.commands;
        assert!(starts > 0 || commands == 0, "{name}: {starts}");
    }
}

/// A run that breaks a property where `rules` takes the protocol's place.
fn counterexample(scenario: &str, rules: impl Rules + 'static, id: PropertyId) -> Replay {
    let weakened = Model::with_rules(Scenario::load(scenario).unwrap(), rules);
    let options = Options {
        until_broken: vec![id],
        ..Options::default()
    };
    let report = check(&weakened, &options, &mut |_| ());
    let property = report.properties.iter().find(|p| p.id == id.to_string());
    let replay = Replay::of(&report, property.unwrap()).expect("it is broken");
    // As a user keeps it.
    let file = serde_json::to_string(&replay).unwrap();
    serde_json::from_str(&file).unwrap()
}

#[test]
fn endpoints_take_the_run_of_a_weakened_protocol_up_to_where_the_rule_counts_and_survive_it() {
    let replay = counterexample("pair", StartsRepeatedCommands, PropertyId::I4);
    let driven = drive(&model("pair"), &replay);
    assert_eq!(driven.disagreement, None);
    let last = replay.steps.len() - 1;
    let Followed::OtherwiseAt(step, outputs) = driven.followed else {
        panic!("{:?}", driven.followed);
    };
    assert_eq!(step, last, "it starts a second time in the last step");
    assert_eq!(driven.steps, replay.steps.len());
    let starts = |outputs: &[String]| outputs.iter().any(|o| o.starts_with("start"));
    assert!(
        starts(&replay.steps[last].outputs),
        "{:?}",
        replay.steps[last]
    );
    assert!(!starts(&outputs), "{outputs:?}");
}

#[test]
fn an_endpoint_that_does_something_else_than_the_model_is_noticed() {
    let forgetful = Model::with_rules(Scenario::load("pair").unwrap(), ForgetsOffers);
    let runs = (0..50).map(|seed| Replay::along(&forgetful, &walk(&forgetful, seed, 60)));
    let noticed = runs.filter(|replay| {
        let driven = drive(&forgetful, replay);
        matches!(driven.disagreement, Some(Disagreement::State { .. }))
            && driven.steps < replay.steps.len()
    });
    assert!(noticed.count() > 10);
}

/// A requester forgets each offer.
struct ForgetsOffers;

impl Rules for ForgetsOffers {
    fn step(&self, robot: &mut Robot, config: &Config, input: Input) -> Outputs {
        let before = robot.clone();
        let outputs = robot.step(config, input);
        if let Input::Ram { ram, .. } = input
            && matches!(ram.coordination, Coordination::OfferHelp { .. })
        {
            *robot = before;
        }
        outputs
    }
}
