//! `crossguard check --large` and `--workers`, as their user runs them.

use crossguard_model_check::scenario::Scenario;
use crossguard_testkit::command::*;

#[test]
fn large_scenarios_are_explored_by_workers() {
    let output = run_line("check --large --max-states 2000 --json");
    assert_code(&output, 3);
    let report = json(&output);
    let explored = report["scenarios"].as_array().unwrap();
    assert!(Scenario::large().eq(explored.iter().map(|it| it["name"].as_str().unwrap())));
    assert!(!explored.is_empty());
    for scenario in explored {
        assert_eq!(scenario["cutOff"], "state-limit");
        assert_eq!(scenario["engines"][0], "crossguard-workers");
    }
}
