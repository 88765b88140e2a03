//! `examples/follower.rs`, a stack that embeds the endpoint, follows a robot of `crossguard run` through a
//! crossing.

#[path = "../../examples/follower.rs"]
mod follower;
use std::fs::File;
use std::io::BufReader;
use std::time::Duration;

use crossguard_judge::validate::{self, Log};
use crossguard_testkit::command::*;

#[test]
fn a_stack_with_an_endpoint_follows_and_its_log_is_valid() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let ari = robot_file(folder.path(), "ARI", 1, port, port + 1);
    let path = |name: &str| folder.path().join(name).display().to_string();
    let arguments = [
        "2".to_owned(),
        (port + 1).to_string(),
        port.to_string(),
        path("follower.boot"),
        path("follower.jsonl"),
    ];
    let embedded = std::thread::spawn(move || follower::follow(&arguments).unwrap());
    let mut humanoid = start(&ari);
    let script = "wait 0.3\ndetect\nuntil maneuver-executing\nuntil idle\nquit\n";
    type_to(&mut humanoid, script);
    let status = wait_for(&mut humanoid, Duration::from_mins(1));
    assert_eq!(status.code(), Some(0));
    // On a busy machine its leader hears that it is done before it hears it at its place, and sends it there again.
    let maneuvers = embedded.join().unwrap();
    assert!(maneuvers >= 2, "{maneuvers} maneuvers");
    let followers = Log {
        name: "follower".to_owned(),
        lines: Box::new(BufReader::new(File::open(path("follower.jsonl")).unwrap())),
    };
    let leaders = Log {
        name: "ARI".to_owned(),
        lines: Box::new(std::io::Cursor::new(log_of(&ari))),
    };
    let validated = validate::all(vec![followers, leaders]).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!((validated.robots, validated.from_strangers), (2, 0));
    let is_judged = validated.properties.iter().any(|id| id == "I6");
    assert!(is_judged, "{validated:?}");
}
