//! The crossing machine with real robots, explored to the end: the rules hold, each premise is reached, and each weakening
//! breaks the rule that it should.

use crossguard_crossing::Setup;
use crossguard_model_check::crossing::*;
use crossguard_protocol::Millis;

fn found(scenario: &Scenario) -> Found {
    let found = explore(scenario);
    println!(
        "{}: {} states, depth {}, {:.1?}, exhaustive: {}, reached: {:?}",
        scenario.name, found.states, found.depth, found.time, found.exhaustive, found.reached
    );
    for (rule, run) in &found.broken {
        println!("{rule:?} is broken:");
        run.iter().for_each(|state| println!("  {state}"));
    }
    found
}

#[test]
fn every_rule_holds_in_every_scenario_and_every_premise_is_reached() {
    let mut reached = Vec::new();
    for scenario in &Scenario::ALL {
        let found = found(scenario);
        assert!(found.exhaustive, "{}", scenario.name);
        assert!(found.broken.is_empty(), "{}", scenario.name);
        reached.extend(found.reached);
    }
    for premise in Premise::ALL {
        assert!(reached.contains(&premise), "{premise:?}");
    }
}

/// Each breaks its rule, and no other.
#[test]
fn each_weakening_breaks_its_rule() {
    type Weakening = (
        &'static str,
        Rule,
        fn(&Scenario) -> Scenario,
        fn(&mut Setup),
    );
    let weakenings: [Weakening; 5] = [
        (
            "one empty frame is enough",
            Rule::P1,
            |it| *it,
            |setup| {
                setup.sensors.miss_max = 0;
            },
        ),
        (
            "in position is believed for ever",
            Rule::P2,
            |it| Scenario { drifts: 1, ..*it },
            |setup| setup.position.lease = Millis(1_000_000),
        ),
        (
            "drivers react at once and brake hard",
            Rule::P3,
            |it| Scenario {
                vehicle: true,
                ..*it
            },
            |setup| {
                setup.traffic.reaction = Millis(0);
                setup.traffic.deceleration_cmps2 = 1_000;
            },
        ),
        (
            "nobody waits before a minute",
            Rule::P5,
            |it| *it,
            |setup| {
                setup.waiting.dwell = Millis(60_000);
            },
        ),
        (
            "no number of frames is enough",
            Rule::P6,
            |it| *it,
            |setup| {
                setup.sensors.miss_max = u8::MAX;
            },
        ),
    ];
    for (name, rule, scenario, change) in weakenings {
        let scenario = Scenario {
            name,
            change,
            ..scenario(&Scenario::PERSON)
        };
        let broken: Vec<Rule> = found(&scenario).broken.iter().map(|it| it.0).collect();
        assert_eq!(broken, [rule], "{name}");
    }
}
