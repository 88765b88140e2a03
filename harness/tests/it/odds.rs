//! `crossguard odds` as its users run it.

use std::fs;

use crossguard_testkit::command::*;
use serde_json::Value;

#[test]
fn json_has_the_bounds_of_each_milestone_at_each_loss_rate() {
    let report = json(&run_well("odds --loss 0,0.3 --vary n_ack=1,3 --json"));
    assert_eq!(report["followers"], 1);
    assert_eq!(report["odds"].as_array().unwrap().len(), 2);
    for (odds, n_ack) in report["odds"].as_array().unwrap().iter().zip([1_i32, 3]) {
        assert_eq!(odds["nAck"], n_ack);
        assert!(odds["sizes"][0]["states"].as_u64().unwrap() > 100);
        let losses = odds["losses"].as_array().unwrap();
        assert_eq!(losses[0]["crossing"]["lower"], 1.0);
        let milestones = losses[1]["milestones"].as_array().unwrap();
        let names: Vec<_> = milestones
            .iter()
            .map(|it| it["milestone"].as_str().unwrap())
            .collect();
        assert_eq!(
            names,
            [
                "team",
                "received",
                "acknowledged",
                "open",
                "interrupted",
                "fell-back"
            ]
        );
        let received = &milestones[1]["probability"];
        let by_hand = 1.0 - 0.3_f64.powi(n_ack + 1);
        for bound in ["lower", "upper"] {
            assert!(
                (received[bound].as_f64().unwrap() - by_hand).abs() < 1e-8,
                "{received}"
            );
        }
        assert_eq!(milestones[1]["distribution"][0]["ms"], 50);
        assert!(milestones[0]["meanMs"]["lower"].as_f64().unwrap() > 300.0);
    }
}

#[test]
fn tables_say_what_was_asked_for() {
    let said = stdout(&run_well("odds --loss 0,0.1,0.2"));
    said.must_have(&[
        "ram_period=100 t_ack=600",
        "1 - 1.0e-4",
        "0.998400",
        "244 ms",
        "lost independently",
    ]);
}

#[test]
fn the_chains_are_written_for_other_tools_with_what_is_said_of_them() {
    let folder = tempfile::tempdir().unwrap();
    let to = folder.path().join("chains");
    run_well(&format!(
        "odds --loss 0.1 --hold 1000 --export {}",
        to.display()
    ));
    let figures: Value =
        serde_json::from_slice(&fs::read(to.join("figures.json")).unwrap()).unwrap();
    let stages = figures.as_array().unwrap().iter();
    for (stage, name) in stages.zip(["gathering", "commanding", "holding"]) {
        assert_eq!(stage["stage"], name);
        let drn = fs::read_to_string(to.join(name).with_extension("drn")).unwrap();
        assert!(drn.contains(&format!("@nr_states\n{}\n", stage["states"])));
    }
}
