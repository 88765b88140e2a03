//! Two robots and two radios: each robot in a network namespace of its own, attached to an on-board unit of its own by the
//! attachment protocol; the units speak Ethernet over veth with loss and delay, and measure a channel that is full. Packets
//! are signed, the crossing is from site and plan files, and two Python processes are the bodies.

use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use crossguard_testkit::command::*;
use serde_json::{Value, json};

use crate::unit_process::AS_UNIT;

/// Runs `two_radios/street.sh` in namespaces of its own, with bodies that are so many times as fast as real ones.
fn street(arguments: &[&str], pace: &str) -> Output {
    let tests = concat!(env!("CARGO_MANIFEST_DIR"), "/tests");
    let unit = std::env::current_exe().unwrap();
    let as_unit = AS_UNIT.join(" ");
    Command::new("unshare")
        .args(["--user", "--map-root-user", "--net", "--pid", "--fork"])
        .args(["--kill-child", "--mount-proc", "sh"])
        .arg(format!("{tests}/two_radios/street.sh"))
        .args(arguments)
        .env("PROGRAM", env!("CARGO_BIN_EXE_crossguard"))
        .env("UNIT", format!("{} {as_unit}", unit.display()))
        .env("TESTS", tests)
        .env("PACE", pace)
        .stdin(Stdio::null())
        .output()
        .unwrap()
}

/// Whether this machine permits namespaces; if not, it says that the test is skipped.
fn is_possible(test: &str) -> bool {
    let tried = street(&["try"], "1");
    let python = Command::new("python3").arg("--version").output();
    let missing = match (tried.status.success(), python) {
        (true, Ok(_)) => return true,
        (false, _) => format!(
            "this machine permits no network namespaces: {}",
            stderr(&tried).trim()
        ),
        (_, Err(error)) => format!("there is no python3: {error}"),
    };
    // Not by eprintln!, which the test runner would capture.
    let _ = writeln!(std::io::stderr(), "SKIPPED {test}: {missing}");
    false
}

/// Files of a site, a plan, two robots and their certificates.
fn prepare(folder: &Path) {
    let plans = Path::new(env!("CARGO_MANIFEST_DIR")).join("robot/plans");
    for (from, to) in [("street.toml", "site.toml"), ("crossing.toml", "plan.toml")] {
        std::fs::copy(plans.join(from), folder.join(to)).unwrap();
    }
    for (name, station, build) in [("ARI", 1, "humanoid"), ("Go2", 2, "quadruped")] {
        let text = format!(
            "name = \"{name}\"\nstation = {station}\nbuild = \"{build}\"\nboot_file = \"{name}.boot\"\n\
             autopilot = true\nspeed = 10.0\nsite_file = \"site.toml\"\nplan_file = \"plan.toml\"\n\n\
             [body]\nlisten = \"unix:{name}.sock\"\n\n[link]\nunit = \"127.0.0.1:4747\"\n"
        );
        std::fs::write(folder.join(format!("{name}.toml")), text).unwrap();
    }
    let pki = folder.join("pki").display().to_string();
    let made = run(&["pki", "init", &pki, "--robot", "ARI=1", "--robot", "Go2=2"]);
    assert!(made.status.success(), "{}", stderr(&made));
}

/// What both robots wrote, after they did this; each log is valid, and so are both together.
fn logs(happens: &str, pace: &str) -> [Vec<Value>; 2] {
    let folder = tempfile::tempdir().unwrap();
    prepare(folder.path());
    let path = |name: &str| folder.path().join(name).display().to_string();
    let output = street(&[&path(""), happens], pace);
    let read = |name| std::fs::read_to_string(path(name)).unwrap_or_default();
    let logs = ["ARI.log", "Go2.log"].map(read);
    let said = stderr(&output);
    assert_eq!(output.status.code(), Some(0), "{said}\n{}", logs[0]);
    let verdict = run(&["validate", &path("ARI.log"), &path("Go2.log")]);
    assert_eq!(verdict.status.code(), Some(0), "{}", stdout(&verdict));
    let counts = read("air.txt");
    let counts: Vec<u32> = counts.split(' ').map(|it| it.parse().unwrap()).collect();
    assert!(counts[0] > 20 && counts[1] > 0, "relayed, lost: {counts:?}");
    logs.map(|log| records(&log))
}

/// When this was put out first, in µs on the log's clock.
fn when(log: &[Value], output: &str) -> Option<u64> {
    let has = |it: &&Value| {
        let outputs = it["outputs"].as_array().into_iter().flatten();
        outputs
            .into_iter()
            .any(|it| it == output || it.get(output).is_some())
    };
    log.iter().find(has).and_then(|it| it["atUs"].as_u64())
}

fn count(log: &[Value], layer: &str, reason: &str) -> u64 {
    let last = log.last().unwrap();
    assert_eq!(last["entry"], "stopped", "{last}");
    last["counters"][layer][reason].as_u64().unwrap_or(0)
}

/// When RAM were sent, in µs.
fn rams(log: &[Value]) -> Vec<u64> {
    let sent = log.iter().filter(|it| it["entry"] == "sent");
    let rams = sent.filter(|it| it["message"] == "RAM");
    rams.filter_map(|it| it["atUs"].as_u64()).collect()
}

/// The corridor was open, closed before the follower fell back, and the session ended without a completed crossing.
fn assert_closed_in_order([ari, go2]: &[Vec<Value>; 2]) {
    let opened = when(ari, "corridorOpened").unwrap();
    let closed = when(ari, "corridorClosed").expect("the corridor closes");
    assert!(opened < closed);
    let text = |log: &[Value]| log.iter().map(Value::to_string).collect::<String>();
    assert!(text(ari).contains("sessionEnded"));
    assert!(!text(go2).contains("\"taskCompleted\""));
}

#[test]
fn two_robots_with_two_radios_cross_on_a_full_channel_with_loss_delay_and_signatures() {
    if !is_possible(
        "two_robots_with_two_radios_cross_on_a_full_channel_with_loss_delay_and_signatures",
    ) {
        return;
    }
    let [ari, go2] = logs("whole", "10");
    let text = |log: &[Value]| log.iter().map(Value::to_string).collect::<String>();
    for log in [&ari, &go2] {
        assert!(text(log).contains("taskCompleted"));
        assert_eq!(
            count(log, "body", "silent") + count(log, "body", "not understood"),
            0
        );
        let full = |it: &&Value| it["busyRatio"] == 0.8 && it["intervalMs"] == 1_000;
        assert!(
            log.iter().any(|it| full(&it)),
            "the channel is known to be full"
        );
    }
    // Both stages of the plan, at the places of the site.
    let starts = go2
        .iter()
        .filter(|it| it.to_string().contains("\"startManeuver\""));
    assert_eq!(starts.count(), 2);
    assert_eq!(ari[0]["station"], json!(1), "the station of its ticket");

    // A full channel holds RAM back outside of the session, and nothing within it.
    let began = when(&ari, "lockIdentity").unwrap_or(u64::MAX);
    let before: Vec<_> = rams(&ari).into_iter().filter(|at| *at < began).collect();
    let measured = ari.iter().find(|it| it["intervalMs"] == 1_000);
    let measured = measured.and_then(|it| it["atUs"].as_u64()).unwrap();
    let held: Vec<_> = before.iter().filter(|at| **at > measured).collect();
    assert!(
        held.windows(2).all(|two| two[1] - two[0] >= 990_000),
        "{held:?}"
    );
    let (opened, closed) = (when(&ari, "corridorOpened"), when(&ari, "corridorClosed"));
    let (opened, closed) = (
        opened.unwrap(),
        closed.unwrap_or(ari.last().unwrap()["atUs"].as_u64().unwrap()),
    );
    let within = rams(&ari)
        .into_iter()
        .filter(|at| (opened..closed).contains(at))
        .count();
    let beats = (closed - opened) / 100_000;
    assert!(
        within as u64 * 2 > beats,
        "{within} RAM in {beats} heartbeats"
    );
}

/// Hazard: the body of the robot that shields the pedestrian is gone, and its robot goes on promising.
#[test]
fn a_body_that_is_killed_behind_a_radio_closes_the_corridor() {
    if !is_possible("a_body_that_is_killed_behind_a_radio_closes_the_corridor") {
        return;
    }
    let logs = logs("kill-body", "1.5");
    assert_closed_in_order(&logs);
    let [_, go2] = &logs;
    assert_eq!(count(go2, "body", "silent"), 1);
    let last = go2.iter().rev().find_map(|it| it.get("state")).unwrap();
    assert_eq!(
        last["availability"],
        json!({"unavailable": "emergencyStop"})
    );
}

/// Hazard: the radio of a follower is gone, and the leader goes on showing go.
#[test]
fn a_radio_that_is_killed_closes_the_corridor_before_the_follower_falls_back() {
    if !is_possible("a_radio_that_is_killed_closes_the_corridor_before_the_follower_falls_back") {
        return;
    }
    let logs = logs("kill-unit", "1.5");
    assert_closed_in_order(&logs);
    let [ari, go2] = &logs;
    // Both clocks are of one machine: each log says when it began.
    let began = |log: &[Value]| {
        log[0]["unixMs"].as_u64().unwrap() * 1_000 - log[0]["atUs"].as_u64().unwrap()
    };
    let closed = began(ari) + when(ari, "corridorClosed").unwrap();
    let fell_back = began(go2) + when(go2, "fallBack").expect("the follower falls back");
    assert!(closed < fell_back, "{closed} {fell_back}");
    assert!(count(go2, "link", "failed") > 0, "the operator is told");
    // It is at the kerb, and on duty until a person says that the road is clear.
    let last = go2.iter().rev().find_map(|it| it.get("state")).unwrap();
    assert!(!last["duty"].is_null(), "{last}");
}
