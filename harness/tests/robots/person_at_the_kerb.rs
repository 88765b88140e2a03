//! A person who comes to the kerb starts a whole crossing of two robots, and nobody types anything.
//!
//! The person is a thread that writes frames, as a sensor would, into a pipe, and looks at the leader's log for the
//! sign, as people look at signs.

use std::fs::{self, File};
use std::io::Write;
use std::process::Command;
use std::time::{Duration, Instant, SystemTime};

use crossguard_testkit::command::*;
use serde_json::{Value, json};

use crate::street::{ARI, PATIENCE, Street, counted};

/// The crossing between the kerbs of the shipped street, with the pavements behind them.
const ZONE: &str = "\n[zone]\npavement_m = 2.5\n";

/// A person in front of ARI, and the street.
struct Person {
    pipe: File,
    /// Of Go2, whose sensors have no frames.
    of_guard: File,
    street: Street,
}

impl Person {
    fn is_at(&mut self, place: [f64; 2], velocity: [f64; 2]) {
        let unix = SystemTime::UNIX_EPOCH.elapsed().unwrap();
        let line = json!({
            "unix_s": unix.as_secs_f64(),
            "people": [{
                "id": 7, "position_m": place, "velocity_mps": velocity, "class": "pedestrian", "confidence": 0.9,
            }],
        });
        writeln!(self.pipe, "{line}").unwrap();
        std::thread::sleep(Duration::from_millis(100));
    }

    fn walk(&mut self, from: [f64; 2], to: [f64; 2]) {
        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
        let seconds = dx.hypot(dy) / 1.5;
        let began = Instant::now();
        while began.elapsed().as_secs_f64() < seconds {
            let share = began.elapsed().as_secs_f64() / seconds;
            let place = [from[0] + dx * share, from[1] + dy * share];
            self.is_at(place, [dx / seconds, dy / seconds]);
        }
    }

    /// Stands until the robot's log has something.
    fn stand(&mut self, place: [f64; 2], until: &str) {
        let deadline = Instant::now() + PATIENCE;
        while !self.street.log(ARI).contains(until) {
            assert!(Instant::now() < deadline, "never '{until}'");
            self.is_at(place, [0.0, 0.0]);
        }
    }
}

/// A person comes to the kerb, waits for the sign, crosses and walks away, and sensors say what is no frame. The records of
/// both robots, none where the crossing was not completed.
fn crossing() -> Option<[Vec<Value>; 2]> {
    let mut street = Street::new(&[("speed = 40.0", "speed = 5.0")]);
    let [ari, go2] = &street.configs;
    fs::write(ari, fs::read_to_string(ari).unwrap() + ZONE).unwrap();
    let pipes = ["pipe", "of_guard"].map(|name| street.path(name));
    let made = Command::new("mkfifo").args(&pipes).status().unwrap();
    assert!(made.success());
    let robots = [ari, go2].into_iter().zip(&pipes);
    let robots = robots.map(|(config, pipe)| start_with(config, &["--perceived", pipe]));
    street.robots = robots.map(Killed).collect();
    let [pipe, of_guard] = pipes.map(|pipe| File::create(pipe).unwrap());
    let mut person = Person {
        pipe,
        of_guard,
        street,
    };
    person.walk([1.0, -6.0], [1.0, -0.8]);
    person.stand([1.0, -0.8], "corridorOpened");
    write!(person.pipe, "{LINES}").unwrap();
    write!(person.of_guard, "{LINES}").unwrap();
    person.walk([1.0, -0.8], [1.0, 1.0]);
    person.walk([1.0, 1.0], [1.0, 8.0]);
    person.stand([1.0, 8.0], "sessionEnded");
    person.walk([1.0, 8.0], [9.0, 8.0]);
    let logs = person.street.end();
    let mut records = logs[ARI].iter();
    let is_completed = records.any(|it| it.to_string().contains("\"taskCompleted\""));
    is_completed.then_some(logs)
}

/// How often robots begin anew where the machine was so slow that they lost each other: then a session ends in order,
/// and the crossing is not completed.
const ATTEMPTS: usize = 3;

/// Lines that are no frames.
const LINES: &str = "{\"unix_s\": 1, \"people\": [{\"id\": -1, \"position_m\": [NaN, 2]}]}\nnull\n";

/// Hazard F: a line that is no frame ended the process, also that of a guard on the road.
#[test]
fn a_person_at_the_kerb_is_helped_across_and_nobody_types() {
    let mut tries = (0..ATTEMPTS).filter_map(|_| crossing());
    let logs = tries.next().expect("no crossing was completed");
    let malformed = |log: &Vec<Value>| counted(log, "perception", "malformed");
    assert_eq!(logs.each_ref().map(malformed), [2, 2]);
    let [log, _] = logs;
    let detected = log
        .iter()
        .filter(|it| it["input"]["local"].get("pedestrianDetected").is_some());
    assert_eq!(detected.count(), 1);
    let of = |entry: &'static str| log.iter().filter(move |it| it["entry"] == entry);
    assert_eq!(of("zone").count(), 1);
    let people: String = of("people").map(Value::to_string).collect();
    people.must_have(&[
        "\"elsewhere\"",
        "\"passing\"",
        "\"waiting\"",
        "\"onRoad\"",
        "\"across\"",
    ]);
    // The track number of a person stays in the robot.
    assert!(!people.contains("\"id\""));
}
