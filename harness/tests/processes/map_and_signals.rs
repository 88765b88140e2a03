//! Where on the map a command is for, and what a robot shows to people: from a robot's file and operator over
//! the air to the other robot, its log and the report.

use std::time::Duration;

use crossguard_codec::{Identifiers, SignalMeans, core};
use crossguard_codec::{MapPlace, PublicSignal, RobotState, decode, map_place_of, state_of};
use crossguard_testkit::command::{
    assert_refused, edit, log_of, records, robot_file, run, run_with, start, stderr, stdout,
    two_free_ports, type_to, wait_for,
};
use serde_json::Value;

const PATIENCE: Duration = Duration::from_mins(1);

/// The octets of messages of a kind that a robot sent or heard, from its log.
fn messages(log: &str, entry: &str, kind: &str) -> Vec<Vec<u8>> {
    let is_meant = |it: &Value| it["entry"] == entry && it["message"] == kind;
    let octets = |it: &Value| hex::decode(it["octets"].as_str().unwrap()).unwrap();
    records(log)
        .iter()
        .filter(|it| is_meant(it))
        .map(octets)
        .collect()
}

#[test]
fn the_place_of_a_command_and_the_signals_of_its_leader_arrive() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let ari = robot_file(folder.path(), "ARI", 1, port, port + 1);
    let go2 = robot_file(folder.path(), "Go2", 2, port + 1, port);
    // Slow enough for a RAM with the slow container in each stage.
    let slower = ("speed = 40.0", "speed = 4.0");
    edit(&go2, &[slower]);
    let said = "crossing = \"276:4711\"\nshows = [\"gesture\", \"display\"]\n\n[link]";
    edit(&ari, &[slower, ("\n[link]", said)]);

    let mut leader = start(&ari);
    let script = "wait 0.3\nshow stop\ndetect\nuntil maneuver-executing\nuntil idle\nquit\n";
    type_to(&mut leader, script);
    let log = folder.path().join("go2.jsonl").display().to_string();
    let follow = ["run", "--config", &go2, "--log", &log];
    let output = run_with(&follow, b"until maneuver-executing\nuntil idle 30\nquit\n");
    let text = stdout(&output);
    assert_eq!(output.status.code(), Some(0), "{text}{}", stderr(&output));
    assert_eq!(wait_for(&mut leader, PATIENCE).code(), Some(0));

    // The person at the other robot reads it.
    for line in [
        "station 1 commands at intersection 276:4711",
        "station 1 shows stop to vehicles, stop to pedestrians",
        "station 1 shows stop to vehicles, go to pedestrians",
        " and serves intersection 276:4711",
    ] {
        assert!(text.contains(line), "'{line}' is not in:\n{text}");
    }
    // It is in the logs of both.
    let crossing = Some(MapPlace::Intersection {
        region: Some(276),
        id: 4_711,
    });
    let ids = Identifiers::default();
    let heard = std::fs::read_to_string(&log).unwrap();
    for (log, entry) in [(log_of(&ari), "sent"), (heard.clone(), "heard")] {
        let commands = messages(&log, entry, "RMCM");
        assert!(commands.len() >= 2, "{entry}");
        for octets in commands {
            let rmcm = decode::<core::rmcm::RMCM>(&ids, &octets).unwrap().message;
            assert_eq!(map_place_of(&rmcm), crossing);
        }
    }
    let rams = messages(&heard, "heard", "RAM");
    let states = rams.iter().map(|octets| {
        let ram = decode::<core::ram::RAM>(&ids, octets).unwrap().message;
        state_of(&ram)
    });
    let states: Vec<_> = states.collect();
    let areas = states
        .iter()
        .filter_map(|state| Some(state.slow.as_ref()?.area));
    assert!(areas.clone().count() > 2 && areas.into_iter().all(|area| area == crossing));
    let signals = |state: RobotState| state.slow.and_then(|slow| slow.signals);
    let shown: Vec<_> = states.into_iter().filter_map(signals).collect();
    let means = SignalMeans::GESTURE.union(SignalMeans::DISPLAY);
    assert!(shown.iter().all(|it| it.means == means), "{shown:?}");
    // Before it leads, it shows nothing to pedestrians; then its sign says what.
    let to_pedestrians = |signal| shown.iter().any(|it| it.to_pedestrians == signal);
    assert!(to_pedestrians(PublicSignal::Stop) && to_pedestrians(PublicSignal::Go));

    let page = folder.path().join("page.html").display().to_string();
    let report = run(&["report", "--output", &page, &log]);
    assert_eq!(report.status.code(), Some(0), "{}", stderr(&report));
    let page = std::fs::read_to_string(page).unwrap();
    for expected in ["at intersection 276:4711", "shows stop to vehicles"] {
        assert!(page.contains(expected), "{expected}");
    }
}

#[test]
fn a_file_that_names_no_place_or_means_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |line: &str, cause: &str| {
        let config = robot_file(folder.path(), "ARI", 1, 47_001, 47_002);
        edit(&config, &[("\n[link]", &format!("{line}\n\n[link]"))]);
        assert_refused(&run(&["run", "--config", &config]), cause);
    };
    refused("map_place = \"bridge 3\"", "map_place: no place of a map");
    refused("map_place = \"segment 70000\"", "like 'segment 276:12'");
    refused("shows = [\"whistle\"]", "unknown variant `whistle`");
}
