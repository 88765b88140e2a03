//! A crossing that another program commands and watches by the operator port, beside programs that spoil it.

use std::io::{BufReader, Write};
use std::os::unix::net::UnixStream;
use std::path::Path;

use crossguard_testkit::command::*;

use crate::street::{ARI, Street, counted};

const HELLO: &str = r#"{"type": "hello", "crossguard": 1}"#;

fn say(to: &mut BufReader<UnixStream>, line: &str) {
    writeln!(to.get_mut(), "{line}").unwrap();
}

#[test]
fn a_program_commands_and_watches_a_crossing_whatever_others_say() {
    let mut street = Street::new(&[]);
    let listen = "[operator]\nlisten = \"unix:ARI.sock\"\n\n[link]";
    edit(&street.configs[ARI], &[("[link]", listen)]);
    let socket = Path::new(&street.configs[ARI]).with_extension("sock");
    let connected = || BufReader::new(connect(&socket));
    street.start(&[]);
    let mut program = connected();
    let hello = read_until(&mut program, |line| line["type"] == "hello");
    assert!(hello["robot"] == "ARI" && hello["station"] == 1, "{hello}");
    say(&mut program, HELLO);
    // One that talks nonsense, one whose line has no end, and one that never reads.
    let mut spoils = [(); 3].map(|()| connected());
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
    let [log, _] = street.end();
    // The line without an end, too.
    assert_eq!(counted(&log, "operator", "not understood"), 2);
    assert!(!socket.exists());
}
