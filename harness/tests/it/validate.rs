//! `crossguard validate`: logs of real robots, and what somebody has altered in them.

use std::path::Path;
use std::time::Duration;

use crossguard_testkit::command::*;
use serde_json::{Value, json};

const PATIENCE: Duration = Duration::from_mins(1);

/// Two processes do the crossing; the paths of their logs.
fn crossing(folder: &Path) -> [String; 2] {
    let port = two_free_ports();
    let ari = robot_file(folder, "ARI", 1, port, port + 1);
    let go2 = robot_file(folder, "Go2", 2, port + 1, port);
    let (mut dog, mut humanoid) = (start(&go2), start(&ari));
    let script = "wait 0.3\ndetect\nuntil maneuver-executing\nuntil idle\nquit\n";
    type_to(&mut humanoid, script);
    assert_eq!(wait_for(&mut humanoid, PATIENCE).code(), Some(0));
    type_to(&mut dog, "quit\n");
    assert_eq!(wait_for(&mut dog, PATIENCE).code(), Some(0));
    ["ARI", "Go2"].map(|name| path_in(folder, &format!("{name}.log")))
}

fn path_in(folder: &Path, name: &str) -> String {
    folder.join(name).display().to_string()
}

fn write(path: &str, lines: &[Value]) {
    let lines: Vec<_> = lines.iter().map(ToString::to_string).collect();
    std::fs::write(path, lines.join("\n") + "\n").unwrap();
}

#[test]
fn logs_of_two_processes_are_valid_together_and_alone_and_not_when_altered() {
    let folder = tempfile::tempdir().unwrap();
    let [ari, go2] = crossing(folder.path());
    let output = run(&["validate", &ari, &go2, "--json"]);
    assert_code(&output, 0);
    let report = json(&output);
    assert_eq!(report["valid"], true);
    assert_eq!(report["robots"], 2);
    assert_eq!(report["fromStrangers"], 0);
    assert_eq!(report["cutOff"], json!([]));
    assert!(report["heard"].as_u64().unwrap() > 20, "{report}");
    let why = "I10: no two robots share a clock, and clocks of different logs are not compared";
    assert_eq!(report["notJudged"], json!([why]));
    let alone = run(&["validate", &go2, "--json"]);
    assert_code(&alone, 0);
    // A follower's times are in its own log.
    assert_eq!(json(&alone)["times"]["maneuvers"], json!([]));

    // The dog's log says that it acknowledged another command.
    let mut lines = records(&std::fs::read_to_string(&go2).unwrap());
    let is_ack = |line: &Value| line["outputs"].to_string().contains("accepted");
    let at = lines.iter().position(is_ack).unwrap();
    let outputs = lines[at]["outputs"].to_string();
    let altered = outputs.replace("\"request\":0", "\"request\":1");
    assert_ne!(outputs, altered);
    lines[at]["outputs"] = serde_json::from_str(&altered).unwrap();
    write(&go2, &lines);
    let output = run(&["validate", &ari, &go2]);
    assert_code(&output, 1);
    let said = stdout(&output);
    let position = format!("{go2}, line {}: Go2 on 'RMCM command", at + 1);
    said.must_have(&[&position, "the protocol puts out"]);
}

/// Where an altered log is refused, given where it was altered.
#[derive(Clone, Copy, Debug)]
enum Where {
    /// At the altered line.
    There,
    /// There, or at the next line of that robot.
    ThereOrNext,
    /// There or at the next line of that robot, or where another robot hears what was not sent.
    AsHeard,
    /// At the latest where that robot first has a part in a session, whose number has the boot counter in it.
    AtItsPart,
    /// There or later, wherever it shows first.
    FromThereOn,
    /// Where that robot stops and says what it has counted.
    AtTheEnd,
}

/// A kind of alteration: its name, the line that it is made to, what it does with the lines from there
/// on, where it is noticed, and a part of the reason.
#[derive(Clone, Copy)]
struct Alteration {
    name: &'static str,
    line: fn(&Value) -> bool,
    alter: fn(&mut Vec<Value>, usize),
    refused: Where,
    reason: &'static str,
}

fn is(line: &Value, entry: &str) -> bool {
    line["entry"] == entry
}

/// A step in which something is sent, in the middle of a session.
fn is_busy_step(line: &Value) -> bool {
    let acts = !line["outputs"].as_array().is_none_or(Vec::is_empty);
    is(line, "step") && acts && line["state"]["phase"].is_object()
}

fn is_heard_in_session(line: &Value) -> bool {
    is(line, "heard") && line["message"] == "RMCM"
}

/// The last octet but eight, which is past the message's header.
fn flip_octet(line: &mut Value) {
    let octets = line["octets"].as_str().unwrap();
    let at = octets.len() - 16;
    let digit = if octets.as_bytes()[at] == b'0' {
        "f"
    } else {
        "0"
    };
    let flipped = format!("{}{digit}{}", &octets[..at], &octets[at + 1..]);
    line["octets"] = flipped.into();
}

/// All times of a log, altered. When messages arrived is left out, so that only what was told is left to judge.
fn alter_times(lines: &mut [Value], alter: fn(u64) -> u64) {
    for line in lines {
        line["atUs"] = alter(line["atUs"].as_u64().unwrap()).into();
        line.as_object_mut().unwrap().remove("reception");
    }
}

/// A message that arrived when the robot's clock showed more than a tenth of a second.
fn is_heard_later(line: &Value) -> bool {
    let arrived_us = line["reception"]["arrivedUs"].as_u64();
    is(line, "heard") && arrived_us.is_some_and(|arrived_us| arrived_us > 100_000)
}

/// The message arrived this many ms earlier, and was told this many earlier.
fn shift_reception(line: &mut Value, arrived_ms: u64, told_ms: u64) {
    for (name, ms) in [("arrivedUs", arrived_ms), ("toldUs", told_ms)] {
        let time = &mut line["reception"][name];
        *time = (time.as_u64().unwrap() - ms * 1_000).into();
    }
}

/// The next line of the same robot.
fn next_of_robot(lines: &[Value], at: usize) -> usize {
    next_of(&lines[at]["robot"], lines, at)
}

/// The next line of a robot after this one, which may not be its own any more.
fn next_of(robot: &Value, lines: &[Value], at: usize) -> usize {
    let same = |i: &usize| lines[*i]["robot"] == *robot;
    (at + 1..lines.len()).find(same).unwrap_or(lines.len() - 1)
}

/// A table of alterations: the name, where it is noticed, a part of the reason, the line, and what is done.
macro_rules! alterations {
    ($($name:literal $refused:ident $reason:literal: $line:expr => $alter:expr;)*) => {
        &[$(Alteration { name: $name, line: $line, alter: $alter, refused: Where::$refused, reason: $reason }),*]
    };
}

const ALTERATIONS: &[Alteration] = alterations! {
    "settings that break an inequality" There "was started although the settings break 'lease-within-safety'":
        |line| is(line, "started") => |lines, at| lines[at]["settings"]["tLease"] = 1_999.into();
    "another boot counter" AtItsPart "went into a state that the protocol does not lead to":
        |line| is(line, "started") => |lines, at| lines[at]["boot"] = 7.into();
    "another event" There "the protocol puts out":
        |line| line["input"]["local"].get("pedestrianDetected").is_some() => |lines, at| lines[at]["input"] = json!({"local": "leaveRequested"});
    "more time than has passed" There "was told that":
        |line| is(line, "step") && line["input"].get("elapsed").is_some() => |lines, at| lines[at]["input"]["elapsed"] = 60_000.into();
    "an output less" There "the protocol puts out":
        is_busy_step => |lines, at| {
            lines[at]["outputs"].as_array_mut().unwrap().pop();
        };
    "an output more" There "corridor opened":
        is_busy_step => |lines, at| {
            let outputs = lines[at]["outputs"].as_array_mut().unwrap();
            outputs.push(serde_json::json!({"corridorOpened": 1}));
        };
    "another state" There "went into a state that the protocol does not lead to":
        is_busy_step => |lines, at| lines[at]["state"]["nextCount"] = 9.into();
    "another message sent" AsHeard "":
        |line| is(line, "sent") && line["trigger"] == "protocol" => |lines, at| flip_octet(&mut lines[at]);
    "another kind of message sent" There "recorded octets that are not the RMCM it says":
        |line| is(line, "sent") && line["message"] == "RAM" => |lines, at| lines[at]["message"] = "RMCM".into();
    "another message heard" ThereOrNext "":
        is_heard_in_session => |lines, at| flip_octet(&mut lines[at]);
    "another sender" There "recorded octets that are not the RMCM of station":
        is_heard_in_session => |lines, at| lines[at]["from"] = 77.into();
    "another cause of a loss" AtTheEnd "times, and its log has it":
        |line| is(line, "dropped") => |lines, at| lines[at]["cause"] = "rain".into();
    "another count" There "counted 'protocol: nothing new' 999 times, and its log has it":
        |line| is(line, "stopped") => |lines, at| lines[at]["counters"]["protocol"]["nothing new"] = 999.into();
    "a step less" ThereOrNext "":
        is_busy_step => |lines, at| {
            lines.remove(at);
        };
    "a transmission less" AsHeard "":
        |line| is(line, "sent") && line["message"] == "RMCM" => |lines, at| {
            lines.remove(at);
        };
    "a line twice" ThereOrNext "":
        is_busy_step => |lines, at| {
            let line = lines[at].clone();
            lines.insert(at, line);
        };
    "two lines of a robot in each other's place" ThereOrNext "":
        is_busy_step => |lines, at| {
            let next = next_of_robot(lines, at);
            lines.swap(at, next);
        };
    "an earlier time" There "has a clock that went back from":
        is_busy_step => |lines, at| lines[at]["atUs"] = 1.into();
    "all times twenty times as long" FromThereOn "ms at its record before":
        |line| is(line, "started") => |lines, _| alter_times(lines, |us| us * 20);
    "all times a twentieth" FromThereOn "ms passed since it was started, and it was":
        |line| is(line, "started") => |lines, _| alter_times(lines, |us| us / 20);
    "a message that had waited for too long" There "ms; delay_max is 50 ms":
        is_heard_later => |lines, at| shift_reception(&mut lines[at], 80, 0);
    "a message that was taken in at another time than the robot was told" There "µs, and was told of the time until":
        is_heard_later => |lines, at| shift_reception(&mut lines[at], 40, 40);
};

#[test]
fn every_kind_of_alteration_is_refused_with_position_and_reason() {
    let folder = tempfile::tempdir().unwrap();
    let log = path_in(folder.path(), "log");
    let port = free_ports(3).to_string();
    let demo = ["demo", "--scenario", "trio", "--speed", "50", "--json"];
    let more = ["--loss", "0.2", "--port", &port, "--log", &log];
    assert_eq!(run(&[demo, more].concat()).status.code(), Some(0));
    let whole = records(&std::fs::read_to_string(&log).unwrap());
    let output = run(&["validate", &log, "--json"]);
    assert_code(&output, 0);
    assert_eq!(json(&output)["ofUnknownAge"], 0);
    let mut wrong = Vec::new();
    for Alteration {
        name,
        line,
        alter,
        refused,
        reason,
    } in ALTERATIONS.iter().copied()
    {
        let at = whole.iter().position(line);
        let at = at.unwrap_or_else(|| panic!("nothing to make it to: {name}"));
        let mut lines = whole.clone();
        alter(&mut lines, at);
        write(&log, &lines);
        let output = run(&["validate", &log, "--json"]);
        let said = format!("{} {}", stderr(&output), stdout(&output));
        assert_eq!(output.status.code(), Some(1), "{name}: {said}");
        let report = json(&output);
        let found = usize::try_from(report["line"].as_u64().unwrap()).unwrap();
        let said = report["error"].as_str().unwrap();
        let (there, next) = (at + 1, next_of(&whole[at]["robot"], &lines, at) + 1);
        let is_there = match refused {
            Where::There => found == there,
            Where::ThereOrNext => (there..=next).contains(&found),
            Where::AsHeard => {
                (there..=next).contains(&found) || found > there && is(&lines[found - 1], "heard")
            }
            Where::AtItsPart => {
                let is_part = |line: &&Value| {
                    line["robot"] == lines[at]["robot"] && line["state"]["phase"].is_object()
                };
                let first = lines.iter().position(|line| is_part(&line)).unwrap();
                (there..=first + 1).contains(&found)
            }
            Where::FromThereOn => found >= there,
            Where::AtTheEnd => is(&lines[found - 1], "stopped"),
        };
        let begin = format!("{log}, line {found}: ");
        if !is_there || !said.starts_with(&begin) || !said.contains(reason) {
            wrong.push(format!("{name}, at line {there}: {said}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
