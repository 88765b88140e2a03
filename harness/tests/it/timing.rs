//! `crossguard timing`: the paper's times from the logs of two processes.

use std::path::Path;
use std::time::Duration;

use crossguard_testkit::command::*;

/// The configurations of two robots that have done a crossing, each with its log.
fn crossing(folder: &Path) -> (String, String) {
    let port = two_free_ports();
    let ari = robot_file(folder, "ARI", 1, port, port + 1);
    let go2 = robot_file(folder, "Go2", 2, port + 1, port);
    let mut dog = start(&go2);
    let mut humanoid = start(&ari);
    type_to(
        &mut humanoid,
        "wait 0.3\ndetect\nuntil maneuver-executing\nuntil idle\nquit\n",
    );
    assert_eq!(
        wait_for(&mut humanoid, Duration::from_mins(1)).code(),
        Some(0)
    );
    type_to(&mut dog, "quit\n");
    assert_eq!(wait_for(&mut dog, Duration::from_mins(1)).code(), Some(0));
    (ari, go2)
}

fn log(config: &str) -> String {
    let path = Path::new(config).with_extension("log");
    path.to_str().unwrap().to_owned()
}

/// Puts the clock of a log forward, as if it came from another machine.
fn put_forward(log: &str, by_ms: u64) {
    let text = std::fs::read_to_string(log).unwrap();
    let lines: Vec<_> = text
        .lines()
        .map(|line| {
            let mut record: serde_json::Value = serde_json::from_str(line).unwrap();
            if let Some(unix_ms) = record.get("unixMs").and_then(serde_json::Value::as_u64) {
                record["unixMs"] = (unix_ms + by_ms).into();
            }
            record.to_string() + "\n"
        })
        .collect();
    std::fs::write(log, lines.concat()).unwrap();
}

#[test]
fn the_logs_of_two_processes_give_the_papers_times_and_the_offset_of_their_clocks() {
    let folder = tempfile::tempdir().unwrap();
    let (ari, go2) = crossing(folder.path());
    let (ari, go2) = (log(&ari), log(&go2));
    put_forward(&go2, 2_500);
    let output = run(&["timing", &ari, &go2, "--speed", "20", "--json"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let result = json(&output);
    let clocks = result["clocks"].as_array().unwrap();
    assert_eq!(clocks.len(), 1, "{result}");
    assert_eq!(clocks[0]["follower"], go2.as_str());
    let us = |name: &str| clocks[0][name].as_i64().unwrap();
    assert!(
        (us("offset_us") - 2_500_000).abs() <= us("bound_us") + 20_000,
        "a busy machine may put a pause between the two clocks that a log begins with: {result}"
    );
    for (maneuver, task) in result["maneuvers"]
        .as_array()
        .unwrap()
        .iter()
        .zip(["initialPos", "move"])
    {
        assert_eq!(maneuver["task"], task);
        let mean = |time: &str| maneuver[time]["mean"].as_f64().unwrap();
        assert!(mean("t_neg_s").abs() < 0.5, "without the offset: {result}");
        assert!(mean("round_trip_s") > 0.0);
        assert!(maneuver["paper"]["t_neg_s"]["mean"].is_number());
    }
    let text = stdout(&run(&["timing", &ari, &go2]));
    for expected in [
        "T_neg [s]",
        "in the paper",
        "The clock of ",
        "ms ahead of that of",
    ] {
        assert!(text.contains(expected), "'{expected}' is not in:\n{text}");
    }
    // A follower's times are in its own log.
    let alone = run(&["timing", &ari]);
    assert_eq!(alone.status.code(), Some(0));
    assert!(stdout(&alone).starts_with("No maneuver was completed"));
    assert_refused(&run(&["timing", "no-such.log"]), "no-such.log: ");
    assert_refused(
        &run(&["timing", &ari, "--speed", "0"]),
        "a number from 1 to 100",
    );
}
