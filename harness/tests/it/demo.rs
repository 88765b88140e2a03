//! `crossguard demo`, as its user runs it: each plan that comes with the kit, and what is said of it.

use std::collections::BTreeSet;
use std::process::{Output, Stdio};
use std::time::Duration;

use crossguard_judge::validate;
use crossguard_testkit::command::*;
use serde_json::Value;

fn demo(more: &str) -> Output {
    run_line(&format!("demo --port {} {more}", free_ports(17)))
}

/// Plans that come with the kit, with more arguments; who starts which tasks, the last after all others; how everybody is
/// in the end; and what the log has. Where two detect on busy cores, either may be the one that is led. The leader dies
/// slowly enough that the dog is on the road when its safety timer runs out.
const ROWS: &str = r#"
crossing      | --speed 50 --seed 2 --faults loss=0.2,burst=0.2x3,duplication=0.3,reordering=0.1,delay=1..20 | Go2 initialPos, Go2 move | ARI Idle, Go2 Idle | corridorOpened "taskCompleted" "loss" "burst
bilateral     | --speed 40                    | ARI-2 initialPos, ARI-2 block       | ARI Idle, ARI-2 Idle             | corridorOpened "taskCompleted"
trio          | --speed 40 --security enforce | ARI-2 block, Go2 move               | ARI Idle, ARI-2 Idle, Go2 Idle   | corridorOpened "taskCompleted"
team          | --speed 20 --loss 0.2 --seed 1 | ARI-2 block, ARI-3 block, Go2 move | ARI Idle, ARI-2 Idle, ARI-3 Idle, Go2 Idle | corridorOpened "taskCompleted"
follower-dies | --speed 5                     | Go2 move                            | ARI Idle, Go2 without power      | corridorClosed "noFollowers"
leader-dies   | --speed 5                     | Go2 move                            | ARI without power, Go2 Idle      | fallBack "contactLost"
vehicle       | --speed 40                    | ARI-2 initialPos, ARI-2 block       | ARI Idle, ARI-2 Idle             | corridorOpened "taskCompleted"
two-detect    | --speed 40                    | ANYBODY move                        | ARI Idle, ARI-2 Idle, Go2 Idle   | corridorOpened "taskCompleted"
"#;

/// Seventeen robots, which need the machine for themselves.
const LARGE: &str = r#"team | --speed 20 --followers 16 | ARI-2 block, Go2 move | ARI Idle, Go2 Idle | corridorOpened "taskCompleted""#;

/// The maneuvers that robots started, in order: who, and what.
fn started(log: &[Value]) -> Vec<(String, &'static str)> {
    let mut started = Vec::new();
    for record in log {
        for output in record["outputs"].as_array().into_iter().flatten() {
            if let Some(maneuver) = output.get("startManeuver") {
                let robot = record["robot"].as_str().unwrap().to_owned();
                let task = usize::try_from(maneuver["task"].as_u64().unwrap()).unwrap();
                started.push((robot, ["initialPos", "move", "block"][task]));
            }
        }
    }
    started
}

fn cross(row: &str) {
    let cells: Vec<_> = row.split('|').map(str::trim).collect();
    let [scenario, more, starts, ends, has] = cells[..] else {
        panic!("{row}");
    };
    let folder = tempfile::tempdir().unwrap();
    let log = folder.path().join("log").display().to_string();
    let output = demo(&format!("--scenario {scenario} --json --log {log} {more}"));
    let result = json(&output);
    assert_eq!(output.status.code(), Some(0), "{scenario}: {result:#}");
    assert_eq!(result["scenario"], scenario);
    let text = std::fs::read_to_string(&log).unwrap();
    validate::one(text.as_bytes()).unwrap();
    for end in ends.split(", ") {
        let (robot, state) = end.split_once(' ').unwrap();
        assert_eq!(result["finalStates"][robot], state, "{scenario}: {robot}");
    }
    let started = started(&records(&text));
    let when = starts.split(", ").map(|start| {
        let (robot, task) = start.split_once(' ').unwrap();
        let is_it = |it: &(String, _)| ["ANYBODY", &it.0].contains(&robot) && it.1 == task;
        let first = started.iter().position(is_it);
        first.unwrap_or_else(|| panic!("{scenario}: {robot} never starts {task}: {started:?}"))
    });
    let when: Vec<_> = when.collect();
    assert_eq!(when.iter().max(), when.last(), "{scenario}: {started:?}");
    for it in has.split(' ') {
        assert!(text.contains(it), "{scenario}: '{it}' is not in the log");
    }
}

#[test]
fn each_plan_ends_as_it_says_and_leaves_a_valid_log() {
    std::thread::scope(|scope| {
        for row in ROWS.trim().lines() {
            scope.spawn(move || cross(row));
        }
    });
    cross(LARGE);
}

/// Fields of RAM and RMCM that stay null in a demonstration: the paper's proof of concept (section III-A) does not name
/// them, or no robot there has what they tell.
const NULL: &[&str] = &[
    // Bodies are in two dimensions, are simulated, and have no lights.
    "curvature",
    "yawRate",
    "lateralAcceleration",
    "verticalAcceleration",
    "orientation",
    "exteriorLights",
    // Goes along each half second, and when another signal is shown.
    "robotLowFrequencyContainer",
    // A part in no session, before the first command, and nothing that ended.
    "robotLeaderFollowerOperationContainer",
    "role",
    "lastCommand",
    "farewell",
    "unavailability",
    // The crossing that requests are for may be any; commands and RAM name the road segment.
    "crossing",
    // Sensors deliver nobody without `--perceived`.
    "vruClusterInformationContainer",
    "vruMotionPredictionContainer",
    // Only guards face a way that their place does not say.
    "targetHeading",
    // No scenario asks for them.
    "minimumPedestrianDistance",
    "validityDuration",
    "estimatedTimeToCompletion",
    // Choices without a value.
    "accepted",
    "executing",
    "inPosition",
    "completed",
];

fn nulls(name: &str, value: &Value, found: &mut BTreeSet<String>) {
    match value {
        Value::Null => _ = found.insert(name.to_owned()),
        Value::Array(all) => all.iter().for_each(|it| nulls(name, it, found)),
        Value::Object(fields) => fields.iter().for_each(|(name, it)| nulls(name, it, found)),
        _ => {}
    }
}

/// Messages that robots sent, decoded by the command, with the sender's name.
fn sent(log: &str, kind: &str) -> Vec<(String, Value)> {
    let mut sent = records(log);
    sent.retain(|it| it["entry"] == "sent" && it["message"] == kind);
    let lines = sent.iter().map(|it| it["octets"].as_str().unwrap());
    let lines: Vec<_> = lines.collect();
    let decoded = run_with(&["codec", "decode", "--batch"], lines.join("\n").as_bytes());
    assert_code(&decoded, 0);
    let decoded = stdout(&decoded);
    let decoded = decoded.lines().map(|it| serde_json::from_str(it).unwrap());
    let robots = sent.iter().map(|it| it["robot"].as_str().unwrap().into());
    robots.zip(decoded).collect()
}

#[test]
fn robots_say_show_and_do_what_the_papers_proof_of_concept_has() {
    for scenario in ["crossing", "bilateral", "trio"] {
        let folder = tempfile::tempdir().unwrap();
        let log = folder.path().join("log").display().to_string();
        // At a higher speed a busy core leaves no time to tell of the sign while it shows go.
        let output = demo(&format!("--scenario {scenario} --speed 4 --log {log}"));
        assert_code(&output, 0);
        let chart = stdout(&output);
        for stage in 1..=5 {
            let begun = chart.matches(&format!("── Stage {stage}: ")).count();
            assert_eq!(begun, 1, "{chart}");
        }
        let both_sides = chart.contains("people on both sides see go and step on the road");
        assert_eq!(both_sides, scenario == "bilateral", "{chart}");
        let log = std::fs::read_to_string(&log).unwrap();
        let (rams, rmcms) = (sent(&log, "RAM"), sent(&log, "RMCM"));
        let mut found = BTreeSet::new();
        for (_, message) in rams.iter().chain(&rmcms) {
            nulls("", message, &mut found);
        }
        let is_excused = |name: &String| NULL.contains(&&**name);
        // A dog shows nothing.
        found.retain(|name| !is_excused(name) && name != "signalsShown");
        assert!(found.is_empty(), "{scenario}: {found:?}");
        // Commands name their road segment and, for guards, the way to face.
        let commands = rmcms.iter().map(|(_, it)| {
            let container = "/message/rmcm/rmcm/rmcmParameters/maneuverContainer";
            &it.pointer(container).unwrap()["leaderManeuverContainer"]
        });
        let mut commands = commands.filter(|it| it.is_object()).peekable();
        assert!(commands.peek().is_some(), "{scenario}");
        for container in commands {
            let id = container.pointer("/mapReference/roadsegment/id");
            assert_eq!(id.and_then(Value::as_u64), Some(12), "{container}");
            let is_block = container["commands"][0]["taskType"] == 2;
            let heading = &container["commands"][0]["targetHeading"];
            assert!(!is_block || heading == 900, "{container}");
        }
        let mut signs = Vec::new();
        let mut facing = Value::Null;
        for (robot, ram) in &rams {
            let ram = ram.pointer("/message/ram/ram/ramParameters").unwrap();
            let status = &ram["robotStatusContainer"]["helpStatus"];
            let slow = &ram["robotLowFrequencyContainer"];
            let shown = &slow["signalsShown"];
            let sees_and_follows_only = slow["capabilities"] == "a0";
            if robot == "ARI" {
                if shown["toPedestrians"] == "go" {
                    facing.clone_from(&ram["robotHighFrequencyContainer"]["heading"]["value"]);
                }
                let has_shown = shown.is_object().then(|| {
                    let to = |whom: &str| shown[whom].as_str().unwrap().to_owned();
                    (to("toVehicles"), to("toPedestrians"))
                });
                assert!(status != "needHelp" || has_shown.is_some() || !signs.is_empty());
                signs.extend(has_shown.filter(|it| signs.last() != Some(it)));
            }
            if slow.is_object() {
                assert_eq!(shown.is_null(), robot == "Go2", "{robot}: {ram}");
                assert_eq!(sees_and_follows_only, robot == "Go2", "{robot}: {ram}");
                assert!(slow["areaServed"].is_object(), "{robot}: {ram}");
            }
        }
        // People are told to wait before help is asked for, vehicles once there is a team, and all of it ends.
        let signs: Vec<_> = signs.iter().map(|(a, b)| [&**a, &**b]).collect();
        let expected = [
            ["none", "none"],
            ["none", "stop"],
            ["stop", "stop"],
            ["stop", "go"],
            ["stop", "stop"],
            ["none", "none"],
        ];
        let mut rest = signs.iter();
        for state in expected {
            let is_shown = rest.any(|it| *it == state);
            assert!(is_shown, "{scenario}: {state:?}: {signs:?}");
        }
        assert_eq!(facing, 2700, "{scenario}: ARI faces its lane's traffic");
    }
}

#[test]
fn the_results_have_the_papers_times_for_each_maneuver() {
    // At a higher speed a thread that is held for a moment makes a maneuver much longer.
    let result = json(&demo("--speed 10 --trials 3 --json"));
    assert_eq!(result["crossings"], 3);
    assert_eq!(result["traceValid"], true);
    let maneuvers = result["maneuvers"].as_array().unwrap();
    assert_eq!(maneuvers.len(), 2);
    for (maneuver, task) in maneuvers.iter().zip(["initialPos", "move"]) {
        assert_eq!(maneuver["task"], task);
        assert_eq!(maneuver["trials"], 3);
        let mean = |time: &str| maneuver[time]["mean"].as_f64().unwrap();
        let sd = maneuver["tExecS"]["sd"].as_f64();
        assert!(sd > Some(0.0), "no two walks are alike");
        assert!(mean("tNegS") > 0.0);
        assert!(mean("tNegS") < mean("roundTripS"), "T_neg is one way");
        assert!((mean("tTmctS") - mean("tNegS") - mean("tExecS")).abs() < 1e-9);
    }
    // Both are planned to take as long as the paper's, give or take the gait and the ticks of the body.
    let exec = |it: &Value| it["tExecS"]["mean"].as_f64().unwrap();
    let (position, escort) = (exec(&maneuvers[0]), exec(&maneuvers[1]));
    assert!((0.3..3.0).contains(&position), "{position}");
    assert!((20.0..25.0).contains(&escort), "{escort}");
    let paper = |maneuver: &Value, time: &str| maneuver["paper"][time]["mean"].as_f64();
    let of_paper = |maneuver| (paper(maneuver, "tNegS"), paper(maneuver, "tTmctS"));
    assert_eq!(of_paper(&maneuvers[0]), (Some(0.074), Some(0.574)));
    assert_eq!(of_paper(&maneuvers[1]), (Some(0.129), Some(21.729)));
}

#[test]
fn a_person_sees_the_chart_the_table_and_the_verdict_on_the_log() {
    let port = free_ports(3).to_string();
    let trio = ["demo", "--speed", "50", "--scenario", "trio", "--port"];
    let mut command = crossguard(&[&trio[..], &[&port]].concat());
    let command = command.env("COLUMNS", "100").stdin(Stdio::null());
    let output = command.output().unwrap();
    assert_code(&output, 0);
    let text = stdout(&output);
    text.must_have(&[
        "ARI leads and blocks a lane, ARI-2 blocks the other, and Go2 escorts.",
        "ARI-2 (station 3)",
        "pedestrian detected",
        "RAM needHelp",
        "RAM offerHelp",
        "RAM leader",
        "RMCM command 0: init",
        "RMCM ack 0",
        "corridor opened",
        "corridor closed",
        "T_TMCT [s]",
        "round trip [s]",
        "in the paper",
        "0.074 ± 0.015",
        "1 of 1 crossings completed; in the end ",
        "every step was one",
    ]);
    let chart = text.lines().skip_while(|line| !line.contains("t/s"));
    let mut chart = chart.take_while(|line| !line.is_empty());
    assert!(chart.all(|line| line.chars().count() <= 100), "{text}");
}

#[test]
fn a_second_demo_on_the_same_port_is_refused_and_the_first_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let log = folder.path().join("log");
    let port = two_free_ports().to_string();
    let mut first = crossguard(&["demo", "--speed", "5", "--port", &port, "--json", "--log"]);
    let mut first = first.arg(&log).stdout(Stdio::piped()).spawn().unwrap();
    wait_until_in(&log, "\"started\"");
    let second = run(&["demo", "--port", &port]);
    let cause = "is in use; is another robot or demo running there?";
    assert_refused(&second, cause);
    wait_for(&mut first, Duration::from_mins(1));
    let result = json(&first.wait_with_output().unwrap());
    assert_eq!(result["crossings"], 1);
}

#[test]
fn a_team_is_told_how_all_of_it_gets_certificates() {
    let folder = tempfile::tempdir().unwrap();
    let pki = folder.path().join("pki").display().to_string();
    let demo = |scenario| {
        let security = format!("--security enforce --pki {pki} --json");
        demo(&format!("--scenario {scenario} --speed 40 {security}"))
    };
    // The commands that are told are carried out, to the letter.
    let follow = |output: &Output| {
        let told = stderr(output);
        let commands = told.split("crossguard pki ").skip(1);
        let commands = commands.map(|it| it.lines().next().unwrap());
        let followed = commands.map(|it| run_well(&format!("pki {it}")));
        followed.count()
    };
    let refused = demo("crossing");
    assert_refused(&refused, "--robot ARI --robot Go2");
    assert_eq!(follow(&refused), 1);
    let refused = demo("team");
    assert_refused(&refused, "has nothing for ARI-2, ARI-3, who take part");
    assert_eq!(follow(&refused), 2);
    let output = demo("trio");
    assert_code(&output, 0);
}

#[test]
fn a_plan_and_a_site_of_ones_own_are_checked_and_demonstrated() {
    let folder = tempfile::tempdir().unwrap();
    let plans = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("robot/plans");
    let [site, plan] =
        ["site.toml", "two.toml"].map(|name| folder.path().join(name).display().to_string());
    let street = std::fs::read_to_string(plans.join("street.toml")).unwrap();
    std::fs::write(&site, street.replace("49.0101", "48.5")).unwrap();
    let text = std::fs::read_to_string(plans.join("bilateral.toml")).unwrap();
    std::fs::write(&plan, &text).unwrap();
    let files = format!("--site {site} --plan {plan}");
    let checked = run_well(&format!("site check {files}"));
    stdout(&checked).must_have(&["plan two: 2 roles, 2 stages; it fits"]);
    let shown = demo(&format!("--speed 40 --json {files}"));
    assert_eq!(json(&shown)["scenario"], "two", "{}", stderr(&shown));
    std::fs::write(&plan, text.replace("waits = \"far-pavement\"", "")).unwrap();
    assert_refused(&demo(&files), "role 'blocker' wants 'waits'");
}
