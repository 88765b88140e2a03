//! Where on the map a command is for, and what a robot shows to people: from a robot's file and operator over the air to
//! the other robot and its log.

use crossguard_codec::{Identifiers, MapPlace, PublicSignal, SignalMeans, core, decode};
use crossguard_codec::{map_place_of, state_of};
use crossguard_testkit::command::*;
use serde_json::Value;

use crate::street::{ARI, GO2, PATIENCE, Street};

/// The octets of messages of a kind that a robot sent or heard, from its log.
fn messages(log: &str, entry: &str, kind: &str) -> Vec<Vec<u8>> {
    let is_meant = |it: &Value| it["entry"] == entry && it["message"] == kind;
    let octets = |it: Value| hex::decode(it["octets"].as_str().unwrap()).unwrap();
    records(log)
        .into_iter()
        .filter(is_meant)
        .map(octets)
        .collect()
}

#[test]
fn the_place_of_a_command_and_the_signals_of_its_leader_arrive() {
    // Slow enough for a RAM with the slow container in each stage.
    let street = Street::new(&[("speed = 40.0", "speed = 2.0")]);
    let said = "crossing = \"276:4711\"\nshows = [\"gesture\", \"display\"]\n\n[link]";
    edit(&street.configs[ARI], &[("\n[link]", said)]);
    let mut leader = Killed(start(&street.configs[ARI]));
    let script = "wait 0.3\nshow stop\ndetect\nuntil maneuver-executing 20\nuntil idle 30\nquit\n";
    type_to(&mut leader.0, script);
    let log = street.path("go2.jsonl");
    let follow = ["run", "--config", &street.configs[GO2], "--log", &log];
    let output = run_with(
        &follow,
        b"until maneuver-executing 20\nuntil idle 30\nquit\n",
    );
    let text = stdout(&output);
    assert_code(&output, 0);
    assert_eq!(wait_for(&mut leader.0, PATIENCE).code(), Some(0));

    // The person at the other robot reads it.
    text.must_have(&[
        "station 1 commands at intersection 276:4711",
        "station 1 shows stop to vehicles, stop to pedestrians",
        "station 1 shows stop to vehicles, go to pedestrians",
        " and serves intersection 276:4711",
    ]);
    // It is in the log.
    let crossing = Some(MapPlace::Intersection {
        region: Some(276),
        id: 4_711,
    });
    let ids = Identifiers::default();
    let heard = std::fs::read_to_string(&log).unwrap();
    let commands = messages(&heard, "heard", "RMCM");
    assert!(commands.len() >= 2);
    for octets in commands {
        let rmcm = decode::<core::rmcm::RMCM>(&ids, &octets).unwrap().message;
        assert_eq!(map_place_of(&rmcm), crossing);
    }
    let rams = messages(&heard, "heard", "RAM").into_iter();
    let slow = rams.filter_map(|octets| {
        let ram = decode::<core::ram::RAM>(&ids, &octets).unwrap().message;
        state_of(&ram).slow
    });
    let slow: Vec<_> = slow.collect();
    assert!(slow.len() > 2 && slow.iter().all(|it| it.area == crossing));
    let shown: Vec<_> = slow.into_iter().filter_map(|it| it.signals).collect();
    let means = SignalMeans::GESTURE.union(SignalMeans::DISPLAY);
    assert!(shown.iter().all(|it| it.means == means), "{shown:?}");
    // Before it leads, it shows nothing to pedestrians; then its sign says what.
    let to_pedestrians = |signal| shown.iter().any(|it| it.to_pedestrians == signal);
    assert!(to_pedestrians(PublicSignal::Stop) && to_pedestrians(PublicSignal::Go));
}
