//! The crossing machine with real robots, explored to the end: the rules hold, and each premise is met. P6 is
//! claimed where neither sensor, leader nor guard fails; weakenings are still to be shown.

use crossguard_crossing::Setup;
use crossguard_model_check::crossing::*;
use crossguard_protocol::Millis;

/// More steps than any street here has: an exploration that comes to it is not exhaustive.
const STEPS_MAX: usize = 10_000_000;

fn found(name: &str, street: Street, change: fn(&mut Setup)) -> Found {
    let found = explore(street, change, STEPS_MAX);
    println!(
        "{name}: {} states, depth {}, {:.1?}, premises met: {:?}",
        found.states, found.depth, found.time, found.met
    );
    for (rule, run) in &found.broken {
        println!(
            "{rule:?} is broken: {}\n  {}",
            rule.claim().statement,
            run.join("\n  ")
        );
    }
    assert!(found.exhaustive, "{name}");
    found
}

#[test]
fn every_rule_holds_in_every_street_and_every_premise_is_met() {
    let person = Street::PERSON;
    let streets = [
        ("a person", person),
        (
            "ids change",
            Street {
                id_changes: 2,
                ..person
            },
        ),
        ("the leader hangs", Street { hang: 1, ..person }),
        ("the sensor goes blind", Street { blind: 2, ..person }),
        (
            "the guard drifts",
            Street {
                drifts: 1,
                ..person
            },
        ),
        (
            "a vehicle comes",
            Street {
                vehicle: true,
                ..person
            },
        ),
    ];
    let mut met = Vec::new();
    for (name, street) in streets {
        let found = found(name, street, |_| ());
        let is_faulty = street.hang + street.blind + street.drifts > 0;
        let mut broken = found.broken.iter().map(|it| it.0);
        assert!(broken.all(|it| is_faulty && it == Rule::P6), "{name}");
        met.extend(found.met);
    }
    for rule in Rule::ALL {
        assert!(met.contains(&rule), "{}", rule.claim().premise);
    }
}
