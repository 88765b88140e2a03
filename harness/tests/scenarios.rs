//! Teams of robots with sockets of their own, as `crossguard demo --scenario` runs them: each ends as
//! it should and leaves a log that is valid.

use std::collections::{BTreeMap, BTreeSet};
use std::process::Output;

use crossguard_testkit::command::*;
use serde_json::Value;

/// Runs a scenario with more arguments. What came of it, and its log, which `crossguard validate` has
/// found valid.
fn scenario(name: &str, more: &[&str]) -> (Value, Vec<Value>) {
    let port = free_ports(4).to_string();
    let folder = tempfile::tempdir().unwrap();
    let log = folder.path().join("log");
    let log = log.to_str().unwrap();
    let arguments = ["demo", "--scenario", name, "--port", &port, "--json"];
    let output = run(&[&arguments, &["--log", log][..], more].concat());
    let result = json(&output);
    assert_eq!(output.status.code(), Some(0), "{result:#}");
    assert_eq!(result["scenario"], name);
    let verdict = run(&["validate", log]);
    assert_eq!(verdict.status.code(), Some(0), "{}", stdout(&verdict));
    (result, records(&std::fs::read_to_string(log).unwrap()))
}

/// The outputs of the transition function with this name, in order: at which robot, and what.
fn outputs<'a>(log: &'a [Value], name: &str) -> Vec<(&'a str, &'a Value)> {
    let mut found = Vec::new();
    for record in log {
        let robot = record["robot"].as_str().unwrap();
        for output in record["outputs"].as_array().into_iter().flatten() {
            let notice = output.get("notify").unwrap_or(output);
            if output == name || notice == name {
                found.push((robot, output));
            } else if let Some(what) = notice.get(name) {
                found.push((robot, what));
            }
        }
    }
    found
}

/// The maneuvers that robots started, in order: who, and what.
fn started(log: &[Value]) -> Vec<(&str, u64)> {
    let task = |(robot, maneuver): (_, &Value)| (robot, maneuver["task"].as_u64().unwrap());
    let outputs = outputs(log, "startManeuver").into_iter();
    outputs.map(task).collect()
}

/// How many maneuvers of each task robots completed: as their bodies said or, of a block, by the end of its session.
fn completed(log: &[Value]) -> BTreeMap<u64, u64> {
    let started = outputs(log, "startManeuver").into_iter();
    let task = |maneuver: &Value| maneuver["task"].as_u64().unwrap();
    let tasks: BTreeMap<_, _> = started
        .map(|(robot, maneuver)| ((robot, maneuver["id"].to_string()), task(maneuver)))
        .collect();
    let mut ends = BTreeSet::new();
    for record in log {
        if let Some(id) = record["input"]["local"].get("maneuverCompleted") {
            ends.insert((record["robot"].as_str().unwrap(), id.to_string()));
        }
    }
    for (robot, stopped) in outputs(log, "stopManeuver") {
        if stopped[1]["released"] == "taskCompleted" && task(&stopped[0]) == BLOCK {
            ends.insert((robot, stopped[0]["id"].to_string()));
        }
    }
    let mut completed = BTreeMap::new();
    for end in ends {
        *completed.entry(tasks[&end]).or_default() += 1;
    }
    completed
}

/// The robots at which the transition function put this out, in order.
fn at<'a>(log: &'a [Value], name: &str) -> Vec<&'a str> {
    let outputs = outputs(log, name).into_iter();
    outputs.map(|(robot, _)| robot).collect()
}

const INITIAL_POS: u64 = 0;
const MOVE: u64 = 1;
const BLOCK: u64 = 2;

#[test]
fn two_humanoids_block_both_directions() {
    let (result, log) = scenario("bilateral", &["--speed", "20", "--trials", "2"]);
    assert_eq!(result["crossings"], 2);
    let once = [("ARI-2", INITIAL_POS), ("ARI-2", BLOCK)];
    assert_eq!(started(&log), [once, once].concat());
    assert_eq!(at(&log, "corridorOpened"), ["ARI", "ARI"]);
    let block = &result["maneuvers"][1];
    assert_eq!(
        (&block["task"], &block["trials"]),
        (&"block".into(), &2.into())
    );
}

#[test]
fn a_dog_escorts_while_two_humanoids_block() {
    let (result, log) = scenario("trio", &["--speed", "20", "--security", "enforce"]);
    let started = started(&log);
    let when = |robot, task| started.iter().position(|one| *one == (robot, task));
    assert!(
        when("ARI-2", BLOCK).unwrap() < when("Go2", MOVE).unwrap(),
        "{started:?}"
    );
    assert_eq!(at(&log, "corridorOpened"), ["ARI"]);
    assert_eq!(result["security"], "enforce");
}

#[test]
fn a_team_of_four_takes_commands_of_one_leader_also_when_messages_get_lost() {
    let (result, log) = scenario("team", &["--speed", "20", "--loss", "0.2"]);
    let started = started(&log);
    for part in [("ARI-2", BLOCK), ("ARI-3", BLOCK), ("Go2", MOVE)] {
        assert!(started.contains(&part), "{started:?}");
    }
    let states = result["final_states"].as_object().unwrap();
    assert_eq!(states.len(), 4);
    assert!(states.values().all(|state| state == "Idle"), "{states:?}");
    // Each is timed by itself, although the leader counts its commands for each alike. Three go to a place, one moves and two
    // block; more where messages get lost so that a follower is gone, comes back and is commanded once more.
    let completed = completed(&log);
    let at_least = BTreeMap::from([(INITIAL_POS, 3), (MOVE, 1), (BLOCK, 2)]);
    assert!(completed.keys().eq(at_least.keys()), "{completed:?}");
    assert!(
        at_least
            .iter()
            .all(|(task, count)| completed[task] >= *count)
    );
    let times = |maneuver: &Value| (maneuver["task"].clone(), maneuver["trials"].clone());
    let maneuvers = result["maneuvers"].as_array().unwrap().iter().map(times);
    let expected = [
        ("initialPos", INITIAL_POS),
        ("move", MOVE),
        ("block", BLOCK),
    ];
    let expected = expected.map(|(name, task)| (name.into(), completed[&task].into()));
    assert_eq!(maneuvers.collect::<Vec<_>>(), expected);
    let losses = &result["counters"]["Go2"]["simulated"]["loss"];
    assert!(losses.as_u64() > Some(0), "{result:#}");
}

#[test]
fn sixteen_followers_take_commands_of_one_leader_and_the_pedestrian_crosses() {
    let (result, log) = scenario("team", &["--followers", "16", "--speed", "20"]);
    let states = result["final_states"].as_object().unwrap();
    assert_eq!(states.len(), 17);
    assert!(states.values().all(|state| state == "Idle"), "{states:?}");
    assert_eq!(at(&log, "corridorOpened"), ["ARI"]);
    let started = started(&log);
    let blocks = started.iter().filter(|(_, task)| *task == BLOCK).count();
    assert_eq!(blocks, 15, "{started:?}");
    let team = &result["teams"][0];
    assert_eq!(team["followers"], 16, "{team}");
    for time in ["formed_s", "all_acknowledged_s"] {
        assert!(team[time]["mean"].as_f64() > Some(0.0), "{team}");
    }
    assert_refused(
        &run(&["demo", "--scenario", "team", "--followers", "17"]),
        "a whole number from 1 to 16 is wanted",
    );
    let (alone, _) = scenario("team", &["--followers", "1", "--speed", "20"]);
    assert_eq!(alone["teams"][0]["followers"], 1, "{alone}");
    let crossing = run(&["demo", "--followers", "2"]);
    assert_refused(&crossing, "--followers 2: plan crossing has roles for 1");
}

#[test]
fn when_the_follower_dies_the_corridor_closes_and_the_leader_gives_up() {
    let (result, log) = scenario("follower-dies", &["--speed", "5"]);
    assert_eq!(result["final_states"]["Go2"], "without power");
    assert_eq!(result["final_states"]["ARI"], "Idle");
    assert_eq!(at(&log, "corridorClosed"), ["ARI"]);
    let (_, end) = outputs(&log, "sessionEnded")[0];
    assert_eq!(end[1], "noFollowers");
    assert_eq!(result["trace"]["cut_off"], serde_json::json!(["Go2"]));
}

#[test]
fn when_the_leader_dies_the_follower_falls_back_and_leaves() {
    // Slow enough that the dog is on the road when its safety timer runs out.
    let (result, log) = scenario("leader-dies", &["--speed", "5"]);
    assert_eq!(result["final_states"]["ARI"], "without power");
    assert_eq!(result["final_states"]["Go2"], "Idle");
    assert_eq!(at(&log, "fallBack"), ["Go2"]);
    let (_, released) = outputs(&log, "released")[0];
    assert_eq!(released[1], "contactLost");
}

#[test]
fn of_two_that_detect_the_same_pedestrian_one_leads() {
    let (_, log) = scenario("two-detect", &["--speed", "20"]);
    // Between requests the lower station id goes before, but one that has got its help by then leads.
    let leaders = at(&log, "rolesEstablished");
    assert!(leaders == ["ARI"] || leaders == ["ARI-2"], "{leaders:?}");
    let escorts = started(&log).into_iter().filter(|(_, task)| *task == MOVE);
    assert_eq!(escorts.count(), 1, "the pedestrian is escorted once");
}

#[test]
fn a_person_sees_every_robot_in_the_chart_and_packets_in_the_capture() {
    let folder = tempfile::tempdir().unwrap();
    let pcap = folder.path().join("trio.pcap");
    let pcap = pcap.to_str().unwrap();
    let port = free_ports(3).to_string();
    let arguments = [
        "demo",
        "--scenario",
        "trio",
        "--speed",
        "30",
        "--port",
        &port,
    ];
    let output = run(&[&arguments[..], &["--pcap", pcap]].concat());
    let text = stdout(&output);
    assert_eq!(output.status.code(), Some(0), "{text}");
    for expected in [
        "ARI leads and blocks a lane, ARI-2 blocks the other, and Go2 escorts.",
        "ARI-2 (station 3)",
        "Go2 (station 2)",
        "block to 3",
        "corridor opened",
        "1 of 1 crossings completed",
        "every step was one",
    ] {
        assert!(text.contains(expected), "'{expected}' is not in:\n{text}");
    }
    let seen = stdout(&run(&["sniff", pcap]));
    for expected in ["needHelp 1#", "leader 1#1.0 of 2, 3", "follower 1#1.0"] {
        assert!(seen.contains(expected), "'{expected}' is not in:\n{seen}");
    }
}

#[test]
fn a_picture_shows_where_a_robot_lost_power() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (log, picture, port) = (path("log"), path("picture"), free_ports(2).to_string());
    let demo = ["demo", "--scenario", "follower-dies", "--speed", "5"];
    let output = run(&[&demo[..], &["--port", &port, "--log", &log, "--json"]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    run(&["export", &log, "--mermaid", &picture]);
    let picture = std::fs::read_to_string(picture).unwrap();
    let line = |part: &str| picture.lines().position(|line| line.contains(part));
    let end = "its records end here";
    assert_eq!(picture.matches(end).count(), 1, "{picture}");
    // It loses power as soon as the pedestrian is on the road, with or without a record after the corridor opened.
    assert!(line("start move") < line(end), "{picture}");
    assert!(line(end) < line("corridor closed"), "{picture}");
}

#[test]
fn a_team_is_told_how_all_of_it_gets_certificates() {
    let folder = tempfile::tempdir().unwrap();
    let pki = folder.path().join("pki");
    let pki = pki.to_str().unwrap();
    let port = free_ports(3).to_string();
    let demo = |scenario| {
        let demo = ["demo", "--scenario", scenario, "--speed", "40", "--port"];
        let security = ["--security", "enforce", "--pki", pki, "--json"];
        run(&[&demo[..], &[&port], &security[..]].concat())
    };
    // What is told is done, to the letter.
    let follow = |output: &Output| {
        let told = stderr(output);
        let commands = told.split("crossguard pki ").skip(1);
        let mut followed = 0;
        for command in commands
            .map(str::lines)
            .filter_map(|mut lines| lines.next())
        {
            let words: Vec<_> = command.split_whitespace().collect();
            let output = run(&[&["pki"], &words[..]].concat());
            assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
            followed += 1;
        }
        followed
    };
    let refused = demo("crossing");
    assert_refused(&refused, "--robot ARI --robot Go2");
    assert_eq!(follow(&refused), 1);
    let refused = demo("team");
    assert_refused(&refused, "has nothing for ARI-2, ARI-3, who take part");
    assert_eq!(follow(&refused), 2);
    let output = demo("trio");
    assert_eq!(output.status.code(), Some(0), "{}", stdout(&output));
}

#[test]
fn what_there_is_not_is_refused() {
    let all = "[possible values: crossing, bilateral, trio, team, follower-dies, leader-dies, two-detect]";
    assert_refused(&run(&["demo", "--scenario", "parade"]), all);
    assert_refused(
        &run(&["demo", "--scenario", "leader-dies", "--trials", "2"]),
        "--trials 2: ARI loses power in this scenario, so there is one crossing",
    );
}
