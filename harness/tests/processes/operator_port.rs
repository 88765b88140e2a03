//! A crossing that another program commands and watches by the operator port, beside programs that spoil it.

use std::io::{BufReader, Write};
use std::os::unix::net::UnixStream;
use std::path::Path;
use std::time::Duration;

use crossguard_testkit::command::*;

const PATIENCE: Duration = Duration::from_mins(1);

/// Connects to the operator port of a robot, as soon as it is there.
fn connect(file: &str) -> BufReader<UnixStream> {
    let socket = Path::new(file).with_extension("sock");
    BufReader::new(crossguard_testkit::command::connect(socket))
}

const HELLO: &str = r#"{"type": "hello", "crossguard": 1}"#;

fn say(to: &mut BufReader<UnixStream>, line: &str) {
    writeln!(to.get_mut(), "{line}").unwrap();
}

#[test]
fn a_program_commands_and_watches_a_crossing_whatever_others_say() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let ari = robot_file(folder.path(), "ARI", 1, port, port + 1);
    let go2 = robot_file(folder.path(), "Go2", 2, port + 1, port);
    let listen = "[operator]\nlisten = \"unix:ARI.sock\"\n\n[link]";
    edit(&ari, &[("[link]", listen)]);
    let mut robots = [start(&ari), start(&go2)];
    let mut program = connect(&ari);
    let hello = read_until(&mut program, |line| line["type"] == "hello");
    assert!(hello["robot"] == "ARI" && hello["station"] == 1, "{hello}");
    say(&mut program, HELLO);
    // One that talks nonsense, one whose line has no end, and one that never reads.
    let mut spoils = [connect(&ari), connect(&ari), connect(&ari)];
    say(&mut spoils[0], "no json");
    // It may be sent away meanwhile.
    let _ = spoils[1].get_mut().write_all(&vec![b'x'; 100_000]);
    say(&mut spoils[2], HELLO);
    read_until(&mut program, |line| {
        line["type"] == "map" && line["kinds"][0]["count"] == 1
    });
    say(&mut program, r#"{"type": "command", "line": "detect"}"#);
    read_until(&mut program, |line| line["output"] == "corridorOpened");
    let open = read_until(&mut program, |line| line["type"] == "state");
    assert!(
        open["corridor"] == "open" && open["role"] == "leader",
        "{open}"
    );
    assert!(open["openMs"].as_u64() > Some(0), "{open}");
    let ended = read_until(&mut program, |line| line["notice"] == "sessionEnded");
    assert_eq!(ended["reason"], "taskCompleted");
    say(&mut program, r#"{"type": "command", "line": "quit"}"#);
    read_until(&mut program, |line| line["type"] == "stopped");
    type_to(&mut robots[1], "quit\n");
    for robot in &mut robots {
        assert_eq!(wait_for(robot, PATIENCE).code(), Some(0));
    }
    let log = log_of(&ari);
    crossguard_judge::validate::one(log.as_bytes()).unwrap();
    let last = records(&log).pop().unwrap();
    // The line without an end, too.
    assert_eq!(last["counters"]["operator"]["not understood"], 2, "{last}");
    assert!(!Path::new(&ari).with_extension("sock").exists());
}
