//! A disk that is full: without a boot counter on it a robot does not start, and does when there is room again. Its other
//! files are incomplete.

use std::fs;
use std::io::Read as _;
use std::process::Stdio;
use std::time::Duration;

use crossguard_testkit::command::*;

/// Runs the robot three times on a small disk of its own: with room, without, and with room again.
const SMALL_DISK: &str = r#"
set -e
mount -t tmpfs -o size=16k tmpfs "$1"
[ "$2" = try ] && exit 0
printf '%s' "$3" > "$1/ARI.toml"
start() { echo quit | "$2" run --config "$1/ARI.toml" > /dev/null; }
start "$1" "$2"
dd if=/dev/zero of="$1/full" bs=1k status=none 2>/dev/null || true
start "$1" "$2" && exit 90 || [ $? = 2 ]
cat "$1/ARI.boot"
rm "$1/full"
start "$1" "$2"
cat "$1/ARI.boot"
"#;

#[test]
fn on_a_disk_that_is_full_a_robot_does_not_start_and_does_when_there_is_room_again() {
    let folder = tempfile::tempdir().unwrap();
    let disk = folder.path().to_str().unwrap();
    let elsewhere = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let config = robot_file(elsewhere.path(), "ARI", 1, port, port + 1);
    let config = fs::read_to_string(config).unwrap();
    let arguments = [disk, env!("CARGO_BIN_EXE_crossguard"), &config];
    let Some(output) = unshared(&["--mount"], SMALL_DISK, &[disk, "try"], &arguments) else {
        return;
    };
    let said = stderr(&output);
    assert_code(&output, 0);
    said.must_have(&[
        "the boot counter cannot be kept in",
        "No space left on device",
    ]);
    let counters = "crossguard boot counter 1\ncrossguard boot counter 2\n";
    assert_eq!(stdout(&output), counters);
}

#[test]
fn a_capture_for_which_there_is_no_room_is_incomplete_and_says_why() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let config = robot_file(folder.path(), "ARI", 1, port, port + 1);
    let pcap = folder.path().join("ari.pcap").display().to_string();
    // Half a KiB for each file: a header, and the first packets.
    let small = "trap '' XFSZ; ulimit -f 1; exec \"$@\"";
    let mut shell = std::process::Command::new("sh");
    let run = [env!("CARGO_BIN_EXE_crossguard"), "run", "--config", &config];
    let robot = shell.args(["-c", small, "sh"]).args(run);
    let robot = robot.args(["--pcap", &pcap]).stdin(Stdio::piped());
    let mut robot = Killed(robot.stderr(Stdio::piped()).spawn().unwrap());
    type_to(&mut robot.0, "detect\nwait 3\nquit\n");
    let ended = wait_for(&mut robot.0, Duration::from_mins(1));
    let mut said = String::new();
    let mut told = robot.0.stderr.take().unwrap();
    told.read_to_string(&mut said).unwrap();
    said.must_have(&["ari.pcap: not all packets were written: File too large"]);
    assert_eq!(ended.code(), Some(3), "{said}");
}
