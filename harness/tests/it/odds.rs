//! `crossguard odds` as its users run it.

use crossguard_testkit::command::*;

#[test]
fn json_has_the_bounds_of_each_milestone_at_each_loss_rate() {
    let odds = json(&run_well("odds --loss 0,0.3 --json"));
    assert_eq!((&odds["followers"], &odds["nAck"]), (&1.into(), &3.into()));
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
    let by_hand = 1.0 - 0.3_f64.powi(4);
    for bound in ["lower", "upper"] {
        assert!(
            (received[bound].as_f64().unwrap() - by_hand).abs() < 1e-8,
            "{received}"
        );
    }
    assert_eq!(milestones[1]["distribution"][0]["ms"], 50);
    assert!(milestones[0]["meanMs"]["lower"].as_f64().unwrap() > 300.0);
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
