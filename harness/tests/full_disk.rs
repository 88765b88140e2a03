//! Disks that are full: without a boot counter on the disk a robot does not start; without a log it goes
//! on, and says so.

use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::Duration;

use crossguard_testkit::command::*;

const PROGRAM: &str = env!("CARGO_BIN_EXE_crossguard");

fn shell(script: &str, arguments: &[&str]) -> Output {
    Command::new("sh")
        .args(["-c", script, "sh"])
        .args(arguments)
        .stdin(Stdio::null())
        .output()
        .unwrap()
}

fn counter(folder: &Path) -> String {
    fs::read_to_string(folder.join("ARI.boot")).unwrap()
}

/// Starts a robot that stops again at once.
fn start_and_stop(config: &str) -> Output {
    run_with(&["run", "--config", config], b"quit\n")
}

#[test]
fn a_robot_whose_counter_cannot_be_written_does_not_start_and_keeps_the_old_one() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let config = robot_file(folder.path(), "ARI", 1, port, port + 1);
    assert_eq!(start_and_stop(&config).status.code(), Some(0));
    // No file may grow: the limit of a process stands for that of a disk.
    let limited = "trap '' XFSZ; ulimit -f 0; exec \"$1\" run --config \"$2\"";
    let output = shell(limited, &[PROGRAM, &config]);
    assert_refused(&output, "the boot counter cannot be kept in");
    assert_refused(&output, "File too large");
    assert_eq!(counter(folder.path()), "crossguard boot counter 1\n");
    // A process that does not handle the signal dies of it, and leaves the old counter too.
    let killed = shell(
        "ulimit -f 0; exec \"$1\" run --config \"$2\"",
        &[PROGRAM, &config],
    );
    assert_eq!(killed.status.code(), None, "{}", stderr(&killed));
    assert_eq!(counter(folder.path()), "crossguard boot counter 1\n");
    assert_eq!(start_and_stop(&config).status.code(), Some(0));
    assert_eq!(counter(folder.path()), "crossguard boot counter 2\n");
}

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

fn small_disk(arguments: &[&str]) -> Output {
    Command::new("unshare")
        .args([
            "--user",
            "--map-root-user",
            "--mount",
            "sh",
            "-c",
            SMALL_DISK,
            "disk",
        ])
        .args(arguments)
        .stdin(Stdio::null())
        .output()
        .unwrap()
}

#[test]
fn on_a_disk_that_is_full_a_robot_does_not_start_and_does_when_there_is_room_again() {
    let folder = tempfile::tempdir().unwrap();
    let disk = folder.path().to_str().unwrap();
    let tried = small_disk(&[disk, "try"]);
    if !tried.status.success() {
        // Not by eprintln!, which the test runner would capture.
        let _ = writeln!(
            std::io::stderr(),
            "SKIPPED on_a_disk_that_is_full_…: this machine permits no mount namespaces: {}",
            stderr(&tried).trim()
        );
        return;
    }
    let elsewhere = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let config = robot_file(elsewhere.path(), "ARI", 1, port, port + 1);
    let config = fs::read_to_string(config).unwrap();
    let output = small_disk(&[disk, PROGRAM, &config]);
    let said = stderr(&output);
    assert_eq!(output.status.code(), Some(0), "{}{said}", stdout(&output));
    assert!(
        said.contains("the boot counter cannot be kept in"),
        "{said}"
    );
    assert!(said.contains("No space left on device"), "{said}");
    let counters = "crossguard boot counter 1\ncrossguard boot counter 2\n";
    assert_eq!(stdout(&output), counters);
}

#[test]
fn a_robot_whose_log_cannot_be_written_crosses_all_the_same_and_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let ari = robot_file(folder.path(), "ARI", 1, port, port + 1);
    let go2 = robot_file(folder.path(), "Go2", 2, port + 1, port);
    let mut dog = start(&go2);
    let script = "wait 0.3\ndetect\nuntil maneuver-executing 20\nuntil idle 30\nquit\n";
    let arguments = ["run", "--config", &ari, "--log", "/dev/full"];
    let output = run_with(&arguments, script.as_bytes());
    let (said, error) = (stdout(&output), stderr(&output));
    assert!(
        said.contains("1#1.0 ended: task completed"),
        "{said}{error}"
    );
    assert!(
        error.contains("/dev/full: No space left on device"),
        "{error}"
    );
    assert!(error.contains("the robot goes on"), "{error}");
    assert_eq!(output.status.code(), Some(3), "the log is incomplete");
    type_to(&mut dog, "quit\n");
    let dog = wait_for(&mut dog, Duration::from_mins(1));
    assert_eq!(dog.code(), Some(0));
}
