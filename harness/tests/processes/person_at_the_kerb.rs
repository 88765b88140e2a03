//! A person who comes to the kerb starts a whole crossing of two robots, and nobody types anything.
//!
//! The person is a thread that writes what a sensor would tell into a pipe, and looks at the leader's log for the
//! sign, as people look at signs.

use std::fs::File;
use std::io::Write;
use std::path::Path;
use std::process::{Child, Command};
use std::time::{Duration, Instant};

use crossguard_testkit::command::*;
use serde_json::Value;

const PATIENCE: Duration = Duration::from_mins(1);

/// The crossing between the kerbs of the shipped street, with the pavements behind them.
const ZONE: &str = "\n[zone]\npavement_m = 2.5\n";

/// What the sensors of a robot have, through a pipe.
struct Sensors {
    pipe: File,
    config: String,
}

impl Sensors {
    /// The robot reads the pipe since it has started.
    fn of(config: &str) -> (Child, Self) {
        let pipe = Path::new(config).with_extension("pipe");
        let made = Command::new("mkfifo").arg(&pipe).status().unwrap();
        assert!(made.success());
        let path = pipe.to_str().unwrap();
        let robot = start_with(config, &["--perceived", path]);
        let pipe = File::create(&pipe).unwrap();
        let config = config.to_owned();
        (robot, Self { pipe, config })
    }

    fn tell(&mut self, class: &str, place: [f64; 2], velocity: [f64; 2]) {
        let line = serde_json::json!({
            "id": 7, "position_m": place, "velocity_mps": velocity, "class": class, "confidence": 0.9,
        });
        writeln!(self.pipe, "{line}").unwrap();
    }

    /// Somebody walks by these places, and is observed ten times a second.
    fn walk(&mut self, class: &str, way: &[[f64; 2]], speed_mps: f64) {
        for leg in way.windows(2) {
            let (dx, dy) = (leg[1][0] - leg[0][0], leg[1][1] - leg[0][1]);
            let seconds = dx.hypot(dy) / speed_mps;
            let began = Instant::now();
            while began.elapsed().as_secs_f64() < seconds {
                let share = began.elapsed().as_secs_f64() / seconds;
                let place = [leg[0][0] + dx * share, leg[0][1] + dy * share];
                self.tell(class, place, [dx / seconds, dy / seconds]);
                std::thread::sleep(Duration::from_millis(100));
            }
        }
    }

    /// Somebody stands until the robot's log has something.
    fn stand(&mut self, place: [f64; 2], until: &str) {
        let deadline = Instant::now() + PATIENCE;
        while !log_of(&self.config).contains(until) {
            assert!(Instant::now() < deadline, "never '{until}'");
            self.tell("pedestrian", place, [0.0, 0.0]);
            std::thread::sleep(Duration::from_millis(100));
        }
    }
}

/// A leader that watches the zone, and a dog, each with its configuration. Both move five times as fast as real.
fn robots(folder: &Path) -> (String, String) {
    let port = two_free_ports();
    let ari = robot_file(folder, "ARI", 1, port, port + 1);
    let go2 = robot_file(folder, "Go2", 2, port + 1, port);
    for robot in [&ari, &go2] {
        edit(robot, &[("speed = 40.0", "speed = 5.0")]);
    }
    let text = std::fs::read_to_string(&ari).unwrap() + ZONE;
    std::fs::write(&ari, text).unwrap();
    (ari, go2)
}

fn stop(robot: &mut Child) {
    signal(robot, "-INT");
    assert_eq!(wait_for(robot, PATIENCE).code(), Some(0));
}

/// The records of a kind.
fn of_kind<'a>(records: &'a [Value], kind: &str) -> Vec<&'a Value> {
    records.iter().filter(|it| it["entry"] == kind).collect()
}

/// How often robots begin anew where the machine was so slow that they lost each other: messages that waited for
/// longer than `delay_max` are dropped, and then a session ends in order.
const ATTEMPTS: usize = 3;

/// A person comes to the kerb, waits for the sign, crosses, and walks away. The configurations of the two robots.
fn crossing(folder: &Path) -> (String, String) {
    let (ari, go2) = robots(folder);
    let mut dog = start(&go2);
    let (mut humanoid, mut sensors) = Sensors::of(&ari);
    sensors.walk("pedestrian", &[[1.0, -6.0], [1.0, -0.8]], 1.5);
    sensors.stand([1.0, -0.8], "corridorOpened");
    sensors.walk("pedestrian", &[[1.0, -0.8], [1.0, 8.0]], 1.5);
    sensors.stand([1.0, 8.0], "sessionEnded");
    sensors.walk("pedestrian", &[[1.0, 8.0], [9.0, 8.0]], 1.5);
    stop(&mut humanoid);
    stop(&mut dog);
    (ari, go2)
}

#[test]
fn a_person_at_the_kerb_is_helped_across_and_nobody_types() {
    let folders: Vec<_> = (0..ATTEMPTS)
        .map(|_| tempfile::tempdir().unwrap())
        .collect();
    let completed = folders.iter().find_map(|folder| {
        let robots = crossing(folder.path());
        let log = log_of(&robots.0);
        let is_completed = log.contains("\"taskCompleted\"");
        let is_late =
            log.contains("waited too long") || log_of(&robots.1).contains("waited too long");
        assert!(is_completed || is_late, "{log}");
        is_completed.then_some((folder, robots, log))
    });
    let (folder, (ari, go2), log) = completed.expect("no crossing was completed");
    let all = records(&log);
    let detected = all.iter().filter(|record| {
        let event = &record["input"]["local"];
        event.get("pedestrianDetected").is_some()
    });
    assert_eq!(detected.count(), 1);
    assert_eq!(of_kind(&all, "zone").len(), 1);
    let people = of_kind(&all, "people");
    let did = |conduct: &str| {
        let is = |seen: &Value| seen["conduct"] == conduct;
        people
            .iter()
            .any(|sight| sight["people"].as_array().unwrap().iter().any(is))
    };
    for conduct in ["elsewhere", "passing", "waiting", "onRoad", "across"] {
        assert!(did(conduct), "nobody is {conduct}");
    }
    // What tracks a person stays in the robot.
    assert!(
        people
            .iter()
            .all(|sight| !sight.to_string().contains("\"id\""))
    );
    let logs = [&ari, &go2].map(|config| Path::new(config).with_extension("log"));
    let logs: Vec<_> = logs.iter().map(|path| path.to_str().unwrap()).collect();
    let judged = run(&[&["validate"], &logs[..]].concat());
    assert_eq!(judged.status.code(), Some(0), "{}", stderr(&judged));
    they_are_in_the_report_and_the_recording(folder.path(), &logs);
}

/// The zone, the person at each part of the crossing, the cluster and the corridor.
fn they_are_in_the_report_and_the_recording(folder: &Path, logs: &[&str]) {
    let (page, recording) = (folder.join("page.html"), folder.join("crossing.mcap"));
    let (page, recording) = (page.to_str().unwrap(), recording.to_str().unwrap());
    for command in [
        ["report", "--output", page],
        ["export", "--mcap", recording],
    ] {
        let output = run(&[&command[..], logs].concat());
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    }
    let page = std::fs::read_to_string(page).unwrap();
    for expected in [
        "<path class=\"zone\"",
        "<path class=\"zone-road\"",
        "<path class=\"cluster\"",
        "<circle class=\"person waiting\"",
        "<circle class=\"person on-road\"",
        "<circle class=\"person across\"",
        "<section id=\"people\"",
        "<div class=\"who\">people wait</div>",
        "<div class=\"who\">corridor</div>",
    ] {
        assert!(page.contains(expected), "'{expected}' is not on the page");
    }
    // The sign showed go for a while, and the timeline has that.
    let open = page
        .split("<div class=\"open\" style=\"left:")
        .nth(1)
        .unwrap();
    let width = open
        .split("width:")
        .nth(1)
        .and_then(|rest| rest.split('%').next());
    let width: f64 = width.unwrap().parse().unwrap();
    assert!(width > 5.0, "{width} % of the time");
    let recording = std::fs::read(recording).unwrap();
    let has = |text: &str| {
        recording
            .windows(text.len())
            .any(|it| it == text.as_bytes())
    };
    for topic in ["/ARI/people", "/ARI/crossing", "crossguard.People"] {
        assert!(has(topic), "{topic}");
    }
}

#[test]
fn nobody_is_called_for_a_passer_by_and_a_vehicle() {
    let folder = tempfile::tempdir().unwrap();
    let (ari, _) = robots(folder.path());
    let (mut humanoid, mut sensors) = Sensors::of(&ari);
    sensors.walk("pedestrian", &[[-6.0, -0.8], [8.0, -0.8]], 2.8);
    sensors.walk("vehicle", &[[1.0, 3.0], [1.0, 3.2]], 0.1);
    stop(&mut humanoid);
    let log = log_of(&ari);
    assert!(
        log.contains("\"conduct\":\"passing\""),
        "it was seen: {log}"
    );
    assert!(!log.contains("pedestrianDetected"), "{log}");
}
